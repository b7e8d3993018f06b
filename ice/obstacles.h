/* Rigid bodies that the liquid flows around: what they leave open of cells and faces. theory 4.14 */
#ifndef ICE_OBSTACLES_H
#define ICE_OBSTACLES_H

#include "ice/ice.h"
#include "ice/shares.h"

struct obstacles {
  struct places places;   /* of those that are there */
  double       *raw;      /* [size] open share of a cell */
  double       *past;     /* [size] ... a step ago */
  double       *open;     /* [size] the same with what smaller cells lend to it, 0 in those; at the start of the step */
  double       *next;     /* [size] ... at its end */
  double       *face;     /* [dim][size] open share of a face, at the end of the step */
  double       *slice;    /* [size][SHARE_PARTS] open volume of a cell's slices against gravity, over a cell's */
  bool         *lends;    /* [size] whether a cell is closed and lends the little room that it has */
  long         *master;   /* [size] the cell that one with little room lends it to; -1: none */
  int           up, sign; /* axis that gravity is nearest to, and the way up: 1 or -1; 0: no gravity */
};

/** Needs fields of the liquid's surface: a scene that has obstacles and no advection is refused. */
enum status obstacles_create(struct sim *sim, struct ice *ice) MUST_CHECK;
void        obstacles_destroy(struct ice *ice);
/** Whether some obstacle stands in the liquid at some time. */
bool obstacles_present(const struct scene *scene);
/** Whether one of these moves, comes or goes. */
bool obstacles_change(const struct scene *scene);

#endif
