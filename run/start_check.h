/* What a start at rest left: how far from balance it was found, and how fast the solid is after the first steps. */
#ifndef RUN_START_CHECK_H
#define RUN_START_CHECK_H

#include "core/sim.h"

#include <stdio.h>

enum { START_CHECK_STEPS = 10 };

/* What the first steps showed; doubles, as they are checkpointed. */
struct start_motion {
  double speed; /* m/s, largest of a point in the first steps */
  double fall;  /* m/s, what a point in free fall has after them; 0: not there yet */
};

/* As it goes into the summary. */
struct start_record {
  bool                computed; /* the run started at rest, with a solid that moves, under gravity */
  bool                settled;  /* in balance */
  bool                still;    /* nothing but gravity acts in the first steps, so they tell whether it is */
  bool                moves;    /* still, and yet faster than the limit */
  int                 steps;    /* of the static solve */
  double              column, unbalanced;
  struct start_motion motion;
};

/** After every step: takes part in the first START_CHECK_STEPS ones. */
void start_check_step(const struct sim *sim, struct start_motion *motion);
void start_check_fill(const struct sim *sim, const struct start_motion *motion, struct start_record *record);
/** One line: how the start was found; with the motion, where it is known. Nothing where it was not computed. */
void start_check_print(const struct start_record *record, FILE *out);

#endif
