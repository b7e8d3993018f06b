/* Back to the water points: velocity, affine matrix, position; their speed limits the step. theory_twopoint 3, 8 */
#include "twopoint/twopoint.h"

#include "core/parallel.h"
#include "mpm/mpm.h"

#include <math.h>

static double point_speed(const struct twopoint *w, int dim, long p)
{
  double square = 0;
  for (int d = 0; d < dim; d++) square += w->vel_w[p * dim + d] * w->vel_w[p * dim + d];
  return sqrt(square);
}

enum status twopoint_find_speed(struct sim *sim, struct twopoint *w)
{
  int  dim = sim->grid.dim;
  long bad = 0;
  PARALLEL_FOR
  for (long r = 0; r < w->points->n_runs; r++) {
    long lost = 0;
    w->run_speed[r] = 0;
    for (long p = w->points->start[r]; p < w->points->start[r + 1]; p++) {
      double speed = point_speed(w, dim, p);
      lost += !isfinite(speed);
      w->run_speed[r] = fmax(w->run_speed[r], speed);
    }
    if (lost > 0) {
#pragma omp atomic
      bad += lost;
    }
  }
  if (bad > 0)
    return FAIL(ERR_DIVERGED,
                "twopoint: %ld water points have no finite velocity at t = %g s; lower numerics.dt_factor", bad,
                sim->t);
  w->now.speed = 0;
  for (long r = 0; r < w->points->n_runs; r++) w->now.speed = fmax(w->now.speed, w->run_speed[r]);
  return OK;
}

/* points that left a periodic axis come back at its other end */
static void wrap(const struct grid *g, long n, double *x)
{
  for (int d = 0; d < g->dim; d++) {
    if (!g->periodic[d]) continue;
    double length = g->n[d] * g->h;
    PARALLEL_FOR
    for (long p = 0; p < n; p++) {
      double *own = x + p * g->dim + d;
      if (*own < g->min[d]) *own += length;
      if (*own >= g->min[d] + length) *own -= length;
    }
  }
}

enum status twopoint_nodes_to_points(struct sim *sim, double dt)
{
  struct twopoint      *w = twopoint_of(sim);
  const struct g2p_args args = {.dt = dt,
                                .beta = mpm_blend(sim, dt),
                                .vel_old_nc = w->water_vel_nc,
                                .vel_nc = w->water_vel_new_nc,
                                .x = w->x_w,
                                .vel = w->vel_w,
                                .affine = w->affine_w};
  FOR_RUNS(w->points, &sim->grid, run, group) w->kernels->g2p(&w->kernel_grid, &run, &args);
  wrap(&sim->grid, w->points->n, w->x_w);
  return twopoint_find_speed(sim, w);
}

double twopoint_dt_limit(const struct sim *sim)
{
  const struct twopoint *w = twopoint_of(sim);
  double                 h = sim->grid.h;
  double                 wave = sim->scene->numerics.dt_factor * mpm_basis_step(sim->scene) * h / w->fast_wave;
  return fmin(wave, w->now.speed > 0 ? 0.5 * h / w->now.speed : INFINITY);
}
