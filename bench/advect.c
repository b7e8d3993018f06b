/* Sharp surfaces in prescribed flows: error, thickness, and ns per cell and step (all sweeps of a step) on one thread.
 */
#include "tests/ice/advect.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

struct job {
  const struct flow *flow;
  int                n;
  double             end;
};

static const struct job jobs[] = {
    {&flow_zalesak, 100, 1},  {&flow_zalesak, 200, 1},  {&flow_reversed, 50, 2},
    {&flow_reversed, 100, 2}, {&flow_reversed, 200, 2}, {&flow_reversed, 100, 8},
    {&flow_ball_3d, 32, 1.5}, {&flow_ball_3d, 64, 1.5}, {&flow_ball_3d, 64, 3},
};

static double now(void)
{
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}

static enum status measure(const struct job *job)
{
  struct tank t;
  const int   n[3] = {job->n, job->n, job->n};
  TRY(tank_open(job->flow->dim, n, 1.0 / job->n, (const bool[]){false, false, false}, &t));
  tank_fill(&t, job->flow);
  int steps = tank_run(&t, job->flow, job->end, 0.5);
  /* the last step again and again, as it stands: what a step costs without the rest of the loop */
  struct tank_result r = tank_result(&t);
  double             best = INFINITY;
  for (int i = 0; i < 20; i++) {
    double begin = now();
    plic_begin(&t.plic, t.fill);
    for (int axis = 0; axis < t.grid.dim; axis++)
      plic_sweep(&t.plic, axis, job->end / steps, t.flux[axis], t.fill, t.passed);
    best = fmin(best, now() - begin);
  }
  printf("%-24s n %3d  T %g  %4d steps  L1 %6.3f %%  drift %8.1e  fill %8.1e to 1 %+8.1e  thickness %.2f  %5.1f ns\n",
         job->flow->name, job->n, job->end, steps, 100 * r.error, r.drift, t.least, t.most - 1, r.thickness,
         1e9 * best / pow(job->n, t.grid.dim));
  tank_close(&t);
  return OK;
}

int main(void)
{
  parallel_set_threads(1);
  for (size_t i = 0; i < sizeof jobs / sizeof *jobs; i++)
    if (measure(&jobs[i]) != OK) {
      fprintf(stderr, "bench_advect: %s\n", status_message());
      return EXIT_FAILURE;
    }
  return EXIT_SUCCESS;
}
