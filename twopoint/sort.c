/* Order of the water points, and those that left the grid: through an open side they are gone, elsewhere
 * numerics.mpm.stray decides. theory_twopoint 3 */
#include "twopoint/twopoint.h"

#include "mpm/mpm.h"

#include <math.h>

static enum status stop_run(const struct sim *sim, const struct twopoint *w, long p)
{
  int           dim = sim->grid.dim;
  const double *x = w->x_w + p * dim, *v = w->vel_w + p * dim;
  return FAIL(ERR_DIVERGED,
              "twopoint: a water point left the grid at (%.6g, %.6g, %.6g) with the velocity (%.3g, %.3g, %.3g) m/s at "
              "t = %.6g s; extend grid.min/grid.max, open the side, lower numerics.dt_factor, or let "
              "numerics.mpm.stray be clamp or delete",
              x[0], x[1], dim == 3 ? x[2] : 0.0, v[0], v[1], dim == 3 ? v[2] : 0.0, sim->t);
}

/* whether every side that x lies behind lets water out */
static bool left_by_open_side(const struct grid *g, const struct twopoint *w, const double *x)
{
  for (int d = 0; d < g->dim; d++) {
    bool low = !(x[d] >= g->min[d]), high = !(x[d] <= g->min[d] + g->n[d] * g->h);
    if ((low || high) && w->sides[2 * d + high].kind != SIDE_OPEN) return false;
  }
  return true;
}

/* momentum and energy of a point to what has left: sign -1 takes away what stays */
static void account(const struct sim *sim, struct twopoint *w, long p, double sign)
{
  struct ledger l = {{0}};
  twopoint_measure_point(sim, w, p, &l);
  for (int d = 0; d < 3; d++) w->now.momentum_out[d] += sign * l.v[LEDGER_momentum_x + d];
  w->now.energy_out += sign * (l.v[LEDGER_kinetic_fluid] + l.v[LEDGER_potential] + l.v[LEDGER_compression]);
}

/* just inside, without the velocity that led it out */
static void put_back(const struct sim *sim, struct twopoint *w, long p)
{
  const struct grid *g = &sim->grid;
  account(sim, w, p, 1);
  for (int d = 0; d < g->dim; d++) {
    double *x = w->x_w + p * g->dim + d, *v = w->vel_w + p * g->dim + d;
    double  to = fmin(fmax(*x, g->min[d] + 1e-6 * g->h), g->min[d] + (g->n[d] - 1e-6) * g->h);
    if (to == *x) continue;
    *v = to > *x ? fmax(*v, 0) : fmin(*v, 0);
    *x = to;
  }
  account(sim, w, p, -1);
  w->now.put_back++;
}

static void take_leave(const struct sim *sim, struct twopoint *w, long p, bool open)
{
  account(sim, w, p, 1);
  *(open ? &w->now.flowed_out : &w->now.deleted) += 1;
  w->now.mass_out += w->mass_w[p];
}

/* deals with every point outside; gone: some are to be taken out of the set */
static enum status handle_strays(const struct sim *sim, struct twopoint *w, bool *gone)
{
  int stray = mpm_params(sim->scene)->stray;
  *gone = false;
  for (long p = 0; p < w->points->n; p++) {
    const double *x = w->x_w + p * sim->grid.dim;
    if (points_inside(&sim->grid, x)) continue;
    bool open = left_by_open_side(&sim->grid, w, x);
    for (int d = 0; d < sim->grid.dim; d++)
      if (!isfinite(x[d]) || (!open && stray == STRAY_STOP)) return stop_run(sim, w, p);
    if (open || stray == STRAY_DELETE) {
      take_leave(sim, w, p, open);
      *gone = true;
    } else
      put_back(sim, w, p);
  }
  return OK;
}

static void permute(const struct sim *sim, struct twopoint *w)
{
  points_permute_fields(w->points, sim->scene, AT_WATER, module_twopoint.fields, module_twopoint.n_fields, w);
  points_sorted(w->points);
}

enum status twopoint_sort_now(struct sim *sim, struct twopoint *w)
{
  bool gone;
  TRY(handle_strays(sim, w, &gone));
  if (gone) {
    points_keep_inside(&sim->grid, w->points, w->x_w);
    permute(sim, w);
  }
  TRY(points_sort(&sim->grid, w->points, w->x_w));
  permute(sim, w);
  return OK;
}

enum status twopoint_sort_points(struct sim *sim, double dt)
{
  (void)dt;
  struct twopoint *w = twopoint_of(sim);
  return points_need_sort(&sim->grid, w->points, w->x_w) ? twopoint_sort_now(sim, w) : OK;
}
