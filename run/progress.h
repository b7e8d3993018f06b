/* Tells how far a run is and when it will end, and hears when it is asked to stop. */
#ifndef RUN_PROGRESS_H
#define RUN_PROGRESS_H

#include <stdbool.h>
#include <stdio.h>

struct progress {
  FILE  *out;
  bool   quiet, terminal;
  double t_first, t_end;         /* s of simulated time: where this process started, where it ends */
  double wall_first, wall_shown; /* s of the monotonic clock */
  long   step_first, step_shown;
  long   strays; /* points that left the grid since the start of the run; -1: not counted yet */
};

/** s of the monotonic clock. */
double progress_clock(void);
/** One rewritten line on a terminal, plain lines at most every 10 s elsewhere, nothing when quiet. */
void progress_start(struct progress *progress, FILE *out, bool quiet, double t, double t_end, long step);
/** To be called after every step; shows something only when it is time to. */
void progress_step(struct progress *progress, double t, double dt, long step);
/** Ends the line. */
void progress_end(struct progress *progress, double t, long step);

/** From now on SIGINT and SIGTERM only raise a flag; the second one ends the program at once. */
void progress_catch_signals(void);
/** Whether the run is asked to stop. */
bool progress_stop_asked(void);

#endif
