/* Places of the water points, corrected where a node holds more than its room. theory_twopoint 8 */
#include "twopoint/twopoint.h"

#include "core/parallel.h"
#include "mpm/mpm.h"

#include <math.h>

static const double longest = 0.02; /* h, of one correction */

/* share of a room that water in balance may exceed it by: points at rest stay where they are */
static const double tolerated = 1e-3;

/* e = max(0, V/R - 1) at nodes; whether there is any */
static bool find_excess(struct sim *sim, struct twopoint *w)
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
  double       *x = w->x_w + p * g->dim, to[3], square = 0, factor = -w->params->shifting * g->h * g->h;
  const double *slope = w->slope_w + p * g->dim;
  for (int d = 0; d < g->dim; d++) square += slope[d] * slope[d];
  if (square == 0) return;
  factor = fmax(factor, -longest * g->h / sqrt(square));
  for (int d = 0; d < g->dim; d++) to[d] = x[d] + factor * slope[d];
  for (int d = 0; d < g->dim && points_inside(g, to); d++) x[d] = to[d];
}

enum status twopoint_shift_points(struct sim *sim, double dt)
{
  (void)dt;
  struct twopoint   *w = twopoint_of(sim);
  struct gather_args args = {.n = 1, .x = w->x_w, .node = {w->excess_nc}, .gradient = {w->slope_w}};
  if (!find_excess(sim, w)) return OK;
  FOR_RUNS_READING(w->points, run, group)
  {
    w->kernels->gather(&w->kernel_grid, &run, &args);
    for (long p = run.begin; p < run.end; p++) shift(&sim->grid, w, p);
  }
  return OK;
}
