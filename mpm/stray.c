/* Points that left the grid: the run stops, or they are put back, or deleted with what they carried. theory 3.7 */
#include "mpm/stages.h"

#include <math.h>
#include <string.h>

static bool finite_place(const struct sim *sim, const double *x)
{
  for (int d = 0; d < sim->grid.dim; d++)
    if (!isfinite(x[d])) return false;
  return true;
}

static enum status stop_run(const struct sim *sim, const struct mpm *m, long p)
{
  int           dim = sim->grid.dim;
  const double *x = m->x_p + p * dim, *v = m->vel_p + p * dim;
  return FAIL(ERR_DIVERGED,
              "solids.%s: a point left the grid at (%.6g, %.6g, %.6g) with the velocity (%.3g, %.3g, %.3g) m/s at t = "
              "%.6g s; extend grid.min/grid.max, close the side, lower numerics.dt_factor, or let numerics.mpm.stray "
              "be clamp or delete",
              sim->scene->solids[m->points->group[p]].name, x[0], x[1], dim == 3 ? x[2] : 0.0, v[0], v[1],
              dim == 3 ? v[2] : 0.0, sim->t);
}

static void note_last(const struct sim *sim, struct mpm *m, long p)
{
  struct mpm_strays *s = &m->now.strays;
  s->last_t = sim->t;
  s->last_solid = m->points->group[p];
  for (int d = 0; d < sim->grid.dim; d++) s->last_x[d] = m->x_p[p * sim->grid.dim + d];
}

/* momentum, energy and heat of a point to what has left: sign -1 takes away what stays */
static void account(const struct sim *sim, struct mpm *m, long p, double sign)
{
  struct ledger l = {{0}};
  double        gravity[3];
  sim_gravity(sim, sim->t, gravity);
  mpm_measure_point(sim, m, gravity, p, &l);
  for (int d = 0; d < 3; d++) m->now.strays.momentum[d] += sign * l.v[LEDGER_momentum_x + d];
  m->now.heat_sides -= sign * l.v[LEDGER_heat];
  m->now.strays.energy += sign * (l.v[LEDGER_kinetic_solid] + l.v[LEDGER_potential] + l.v[LEDGER_elastic]);
}

/* just inside, without the velocity that led it out */
static void put_back(const struct sim *sim, struct mpm *m, long p)
{
  const struct grid *g = &sim->grid;
  account(sim, m, p, 1);
  for (int d = 0; d < g->dim; d++) {
    double *x = m->x_p + p * g->dim + d, *v = m->vel_p + p * g->dim + d;
    double  low = g->min[d] + 1e-6 * g->h, high = g->min[d] + (g->n[d] - 1e-6) * g->h, to = fmin(fmax(*x, low), high);
    if (to == *x) continue;
    *v = to > *x ? fmax(*v, 0) : fmin(*v, 0);
    m->displacement_p[p * g->dim + d] += to - *x;
    *x = to;
  }
  account(sim, m, p, -1);
  m->now.strays.put_back++;
}

static bool left_by_open_side(const struct sim *sim, const double *x)
{
  const struct grid *g = &sim->grid;
  for (int d = 0; d < g->dim; d++) {
    bool low = x[d]<g->min[d], high = x[d]> g->min[d] + g->n[d] * g->h;
    if ((low || high) && sim->scene->solid_side[2 * d + high].kind != SIDE_OPEN) return false;
  }
  return true;
}

static void take_leave(const struct sim *sim, struct mpm *m, long p)
{
  struct mpm_strays *s = &m->now.strays;
  account(sim, m, p, 1);
  if (left_by_open_side(sim, m->x_p + p * sim->grid.dim)) {
    s->flowed_out++;
    s->mass_out += m->mass_p[p];
  } else {
    s->deleted++;
    s->mass_lost += m->mass_p[p];
  }
}

enum status mpm_handle_strays(struct sim *sim, struct mpm *m)
{
  int  stray = mpm_params(sim->scene)->stray, dim = sim->grid.dim;
  bool leave = false;
  for (long p = 0; p < m->points->n; p++) {
    const double *x = m->x_p + p * dim;
    if (points_inside(&sim->grid, x)) continue;
    if (stray == STRAY_STOP || !finite_place(sim, x)) return stop_run(sim, m, p);
    note_last(sim, m, p);
    leave = stray == STRAY_DELETE;
    if (leave)
      take_leave(sim, m, p);
    else
      put_back(sim, m, p);
  }
  if (!leave) return OK;
  points_keep_inside(&sim->grid, m->points, m->x_p);
  points_permute_fields(m->points, sim->scene, AT_SOLID, module_mpm.fields, module_mpm.n_fields, m);
  points_sorted(m->points);
  return OK;
}
