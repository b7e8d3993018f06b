/* Viscous stress between cells, explicit. theory 4.11 */
#include "ice/ice.h"

#include "core/parallel.h"

#include <math.h>
#include <string.h>

/* whether a face passes shear: between two cells with a pressure */
static bool sheared(const struct ice *ice, const struct grid *g, int axis, long f)
{
  return ice->kind[axis * g->size + f] == FACE_INNER;
}

/* velocity, component d, that a side forces on the liquid along it; false: it lets it slide */
static bool side_drags(const struct sim *sim, int axis, long f, int d, double *velocity)
{
  const struct grid *g = &sim->grid;
  int                place[3];
  grid_place(g, f, place);
  if (g->periodic[axis] || (place[axis] != 0 && place[axis] != g->n[axis])) return false;
  const struct side_condition *side = &sim->scene->fluid_side[2 * axis + (place[axis] > 0)];
  if (side->kind != SIDE_NO_SLIP && side->kind != SIDE_VELOCITY) return false;
  *velocity = side->kind == SIDE_VELOCITY ? ice_inlet_velocity(sim, axis, d, f, sim->t) : 0;
  return true;
}

/* d u_d/dx_axis at a face, upwards; a wall is half a cell away */
static double shear_rate(const struct sim *sim, const struct ice *ice, int axis, long f, int d)
{
  const struct grid *g = &sim->grid;
  long               low = f - g->stride[axis];
  double             wall, h = g->h;
  if (sheared(ice, g, axis, f)) return (ice->vel_cc[f * g->dim + d] - ice->vel_cc[low * g->dim + d]) / h;
  if (!side_drags(sim, axis, f, d, &wall)) return 0;
  int place[3];
  grid_place(g, f, place);
  return place[axis] == 0 ? 2 * (ice->vel_cc[f * g->dim + d] - wall) / h
                          : 2 * (wall - ice->vel_cc[low * g->dim + d]) / h;
}

enum status ice_diffuse_momentum(struct sim *sim, double dt)
{
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  int                dim = g->dim;
  double             mu = sim->scene->fluid.viscosity, V = grid_cell_volume(g), area = V / g->h;
  grid_fill_periodic(g, dim, ice->vel_cc);
  FOR_BOX(g, cells, c)
  for (int d = 0; d < dim; d++) {
    double force = 0;
    for (int axis = 0; axis < dim && ice->wet_cc[c] > 0; axis++)
      for (int high = 0; high < 2; high++) {
        long   f = c + high * g->stride[axis];
        double n = ice->porosity_fc[axis * g->size + f];
        force += (high ? 1 : -1) * n * mu * area * shear_rate(sim, ice, axis, f, d);
      }
    ice->momentum_cc[c * dim + d] = force;
  }
  FOR_BOX(g, cells, c)
  for (int d = 0; d < dim && ice->wet_cc[c] > 0; d++)
    ice->vel_cc[c * dim + d] += dt * ice->momentum_cc[c * dim + d] / ice->mass_cc[c];
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
