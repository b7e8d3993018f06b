/* Heat goes with the mass, by the same fluxes. The heat capacity is one number, so mass times temperature is carried,
 * and a uniform temperature stays uniform whatever the flow does to density and mass. theory 4.12 */
#include "ice/advect.h"
#include "ice/heat.h"

#include "core/parallel.h"
#include "eos/eos.h"

void ice_heat_beyond(const struct sim *sim, struct ice *ice, int side, long f)
{
  const struct fluid     *fluid = &sim->scene->fluid;
  const struct heat_side *own = &sim->scene->heat_side[side];
  long                    step = sim->grid.stride[side / 2], inside = side % 2 ? f - step : f;
  long                    beyond = side % 2 ? f : f - step;
  double                  x[3];
  ice->T_cc[beyond] = ice->T_cc[inside];
  if (own->kind != HEAT_TEMPERATURE) return;
  grid_face(&sim->grid, f, side / 2, x);
  ice->T_cc[beyond] = function_value(&own->value, x, sim->t);
  fluid->eos->density(fluid->eos_params, 1, &ice->P_cc[inside], &ice->T_cc[beyond], &ice->rho_cc[beyond]);
}

/* kg K through a face, upwards, above T: a cell that nearly empties shall not lose its temperature to round-off */
static double carried(const struct sim *sim, const struct ice *ice, int axis, long f, double T)
{
  const struct grid *g = &sim->grid;
  long               q = axis * g->size + f;
  bool               up = ice->liquid_fc[q] > 0;
  long               from = up ? f - g->stride[axis] : f;
  double             mass = advect_mass(ice, g, axis, f);
  if (mass == 0) return 0;
  if (!advect_is_smooth(g, ice, axis, f)) return mass * (ice->T_cc[from] - T);
  double slope = advect_slope(g, ice, axis, from, 1, ice->T_cc), coming = ice->warming_cc ? ice->warming_cc[from] : 0;
  double part = (up ? 0.5 : -0.5) * (1 - advect_courant(g, ice, axis, f, from));
  return mass * (ice->T_cc[from] - T + part * slope + 0.5 * coming);
}

/* J that leaves through the sides of the grid that an axis has, net */
static double leaving(const struct sim *sim, const struct ice *ice, int axis)
{
  const struct grid *g = &sim->grid;
  double             out = 0;
  for (int high = 0; high < 2 && !g->periodic[axis]; high++) {
    struct box side = grid_side_faces(g, 2 * axis + high);
    FOR_BOX_SERIAL(g, side, f) out += (high ? 1 : -1) * carried(sim, ice, axis, f, 0);
  }
  return out * ice_heat_capacity(sim);
}

void ice_heat_gather(const struct sim *sim, struct ice *ice, int axis)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX(g, cells, c)
  ice->warmth_cc[c] =
      carried(sim, ice, axis, c, ice->T_cc[c]) - carried(sim, ice, axis, c + g->stride[axis], ice->T_cc[c]);
  ice->now.heat_out += leaving(sim, ice, axis);
}

/* densities follow temperatures from sweep to sweep: else the mass that the next one carries would not fit its heat */
static void follow(const struct sim *sim, struct ice *ice)
{
  const struct fluid *fluid = &sim->scene->fluid;
  const struct grid  *g = &sim->grid;
  struct box          cells = grid_cells(g);
  PARALLEL_FOR
  for (long r = 0; r < box_rows(&cells); r++) {
    long c0 = box_row(g, &cells, r);
    fluid->eos->density(fluid->eos_params, g->n[0], ice->P_cc + c0, ice->T_cc + c0, ice->rho_cc + c0);
  }
  grid_fill_periodic(g, 1, ice->rho_cc);
}

void ice_heat_settle(const struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             V = grid_cell_volume(g);
  FOR_BOX(g, cells, c)
  if (ice->mass_cc[c] > advect_least_mass * ice->rho_cc[c] * ice->pore_cc[c] * V)
    ice->T_cc[c] += ice->warmth_cc[c] / ice->mass_cc[c];
  grid_fill_periodic(g, 1, ice->T_cc);
  follow(sim, ice);
}
