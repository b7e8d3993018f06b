/* Viscous stress between cells, explicit. theory 4.11 */
#include "ice/ice.h"

#include "core/parallel.h"

#include <math.h>

/* the side that face f lies on, 2 axis or 2 axis + 1; -1: none */
static int side_of(const struct grid *g, int axis, long f)
{
  int place[3];
  grid_place(g, f, place);
  bool low = place[axis] == 0, high = place[axis] == g->n[axis];
  return g->periodic[axis] || !(low || high) ? -1 : 2 * axis + high;
}

/* d u_d/dx_axis at a face, upwards: between cells with a pressure, and to a side that holds the liquid, half a cell
 * away. No other face passes shear. */
static double shear_rate(const struct sim *sim, const struct ice *ice, int axis, long f, int d)
{
  const struct grid *g = &sim->grid;
  const double      *u = ice->vel_cc + d;
  long               low = (f - g->stride[axis]) * g->dim, here = f * g->dim;
  int                side = side_of(g, axis, f), kind = side < 0 ? SIDE_SLIP : sim->scene->fluid_side[side].kind;
  if (ice->kind[axis * g->size + f] == FACE_INNER) return (u[here] - u[low]) / g->h;
  if (kind != SIDE_NO_SLIP && kind != SIDE_VELOCITY) return 0;
  double wall = kind == SIDE_VELOCITY ? ice_inlet_velocity(sim, axis, d, f, sim->t) : 0;
  return side % 2 ? 2 * (wall - u[low]) / g->h : 2 * (u[here] - wall) / g->h;
}

enum status ice_diffuse_momentum(struct sim *sim, double dt)
{
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  int                dim = g->dim;
  double             mu = sim->scene->fluid.viscosity, area = ice_face_area(g);
  grid_fill_periodic(g, dim, ice->vel_cc);
  FOR_BOX(g, cells, c)
  for (int d = 0; d < dim; d++) {
    double gained = 0;
    for (int axis = 0; axis < dim && ice->wet_cc[c] > 0; axis++)
      for (int high = 0; high < 2; high++) {
        long   f = c + high * g->stride[axis];
        double n = ice->porosity_fc[axis * g->size + f];
        gained += (high ? dt : -dt) * n * mu * area * shear_rate(sim, ice, axis, f, d);
      }
    ice->momentum_cc[c * dim + d] = gained;
  }
  FOR_BOX(g, cells, c)
  for (int d = 0; d < dim && ice->wet_cc[c] > 0; d++)
    ice->vel_cc[c * dim + d] += ice->momentum_cc[c * dim + d] / ice->mass_cc[c];
  grid_fill_periodic(g, dim, ice->vel_cc);
  return OK;
}

/* s: explicit diffusion in every direction */
double ice_viscous_dt(const struct sim *sim)
{
  const struct fluid *fluid = &sim->scene->fluid;
  double              nu = fluid->viscosity / fluid->density, h = sim->grid.h;
  return nu > 0 ? sim->scene->numerics.dt_factor * h * h / (2 * sim->grid.dim * nu) : INFINITY;
}
