/* Places of the water points, corrected where a node holds more than its room. theory_twopoint 8 */
#include "twopoint/twopoint.h"

#include "core/parallel.h"
#include "mpm/mpm.h"

#include <math.h>

static const double longest = 0.02; /* h, of one correction */

/* share of a room that water in balance may exceed it by: points at rest stay where they are */
static const double tolerated = 1e-3;

/* e = max(0, V/R - 1) at nodes; whether there is any */
bool twopoint_find_excess(struct sim *sim, struct twopoint *w)
{
  struct box all = grid_all(&sim->grid);
  int        any = 0;
  FOR_BOX(&sim->grid, all, i)
  {
    double room = w->water_room_nc[i], e = room > 0 ? fmax(0, w->water_volume_nc[i] / room - 1 - tolerated) : 0;
    w->excess_nc[i] = e;
    if (e > 0) {
#pragma omp atomic write
      any = 1;
    }
  }
  boundary_ghosts(&w->kernel_grid, w->sides, 1, sim->t, w->excess_nc);
  return any;
}

/* -strength h2 sum e grad w, at most `longest`; no point leaves the grid by it */
static void shift(const struct grid *g, struct twopoint *w, long p)
{
  double       *x = w->x_w + p * g->dim, square = 0, factor = -w->params->shifting * g->h * g->h;
  const double *slope = w->slope_w + p * g->dim, limit = longest * g->h;
  for (int d = 0; d < g->dim; d++) square += slope[d] * slope[d];
  if (square * factor * factor > limit * limit) factor = -limit / sqrt(square);
  for (int d = 0; d < g->dim; d++) {
    double to = x[d] + factor * slope[d];
    if (to > g->min[d] && to < g->min[d] + g->n[d] * g->h) x[d] = to;
  }
}

void twopoint_shift_run(const struct sim *sim, struct twopoint *w, long begin, long end)
{
  for (long p = begin; p < end; p++) shift(&sim->grid, w, p);
}

/* alone: where the increment is averaged the slope comes with it, and points move in that stage */
enum status twopoint_shift_points(struct sim *sim, double dt)
{
  (void)dt;
  struct twopoint   *w = twopoint_of(sim);
  struct gather_args args = {.n = 1, .x = w->x_w, .node = {w->excess_nc}, .gradient = {w->slope_w}};
  if (!twopoint_find_excess(sim, w)) return OK;
  FOR_RUNS_READING(w->points, run, group)
  {
    w->kernels->gather(&w->kernel_grid, &run, &args);
    twopoint_shift_run(sim, w, run.begin, run.end);
  }
  return OK;
}
