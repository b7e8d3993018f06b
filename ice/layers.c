/* Several fluids at the start: who fills what, and pressures at rest. theory 4.15 */
#include "ice/ice.h"

#include "core/memory.h"
#include "core/parallel.h"
#include "eos/eos.h"
#include "ice/shares.h"
#include "mpm/at_rest.h"

#include <math.h>

/* room that fluids may leave in a cell, over the cell: sampled regions are not exact */
static const double smallest_gap = 1e-9;

static double pressure_at_reference(const struct fluid *fluid)
{
  double P;
  fluid->eos->pressure(fluid->eos_params, 1, &fluid->density, NULL, &P);
  return P;
}

/* shares of a cell: each fluid takes its region as far as there is room */
static enum status fill_cell(struct sim *sim, struct ice *ice, long c)
{
  const struct grid *g = &sim->grid;
  double             left = 1, x[3];
  grid_centre(g, c, x);
  for (int k = 0; k < ice->n_fluids; k++) {
    struct places region = places_of(&scene_fluid(sim->scene, k)->region);
    double        share = fmin(left, share_inside(g, &region, x, -1));
    if (left - share < smallest_gap) share = left;
    ice->alpha_cc[k * g->size + c] = share;
    left -= share;
  }
  if (left > 0)
    return FAIL(ERR_INPUT,
                "fluids: %.3g of the cell at (%.6g, %.6g, %.6g) is empty; with several fluids they fill the "
                "whole grid: leave the region of the last one out",
                left, x[0], x[1], x[2]);
  ice->wet_cc[c] = 1;
  ice->P_cc[c] = sim->scene->start == START_AT_REST ? ice->ambient : function_value(&sim->scene->fluid.pressure, x, 0);
  return OK;
}

enum status ice_fill_several(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  if (ice->obstacles)
    return FAIL(ERR_INPUT,
                "obstacles: they stand in one fluid only; leave \"fluids\" out or make them solids of model rigid");
  if (!ice->advects && !ice->params->shocks)
    return FAIL(ERR_INPUT, "fluids: several fluids need numerics.ice.advection or numerics.ice.shocks; set one true");
  ice->ambient = pressure_at_reference(scene_fluid(sim->scene, ice->n_fluids - 1));
  FOR_BOX_SERIAL(g, cells, c) TRY(fill_cell(sim, ice, c));
  grid_fill_periodic(g, 1, ice->wet_cc);
  for (int k = 0; k < ice->n_fluids; k++) grid_fill_periodic(g, 1, ice->alpha_cc + k * g->size);
  return OK;
}

/* ---- rest ---- */

/* what the first and the other fluids of a cell weigh at a pressure, kg/m3 */
static void densities(const struct sim *sim, const struct ice *ice, long c, double P, double *first, double *others)
{
  long   size = sim->grid.size;
  double sum = 0, share = 0;
  for (int k = 0; k < ice->n_fluids; k++) {
    const struct fluid *fluid = scene_fluid(sim->scene, k);
    double              rho, alpha = ice->alpha_cc[k * size + c];
    fluid->eos->density(fluid->eos_params, 1, &P, NULL, &rho);
    if (k == 0)
      *first = rho;
    else {
      sum += alpha * rho;
      share += alpha;
    }
  }
  *others = share > 0 ? sum / share : 0;
}

/* mass in the half of a cell that holds `share` of the first fluid, over its pore volume, kg/m3 */
static double half_density(const struct sim *sim, const struct ice *ice, long c, double P, double share)
{
  double first, others;
  densities(sim, ice, c, P, &first, &others);
  return share * first + (0.5 - share) * others;
}

/* pressure of a cell below a place of the pressure `outside`, half a cell up */
static double pressure_under_top(const struct sim *sim, const struct ice *ice, long c, double outside, double weight)
{
  double P = outside, first, others, share = ice->alpha_cc[c];
  for (int i = 0; i < 30; i++) {
    densities(sim, ice, c, P, &first, &others);
    P = outside + 0.5 * weight * (share * first + (1 - share) * others);
  }
  return P;
}

/* pressure of cell c under the cell `up`; the face has a half of each */
static double pressure_under_cell(const struct sim *sim, const struct ice *ice, long c, long up, int code,
                                  double weight)
{
  const struct grid *g = &sim->grid;
  int                axis = code / 2;
  double             lower_c = ice_lower_share(g, ice, axis, c), lower_up = ice_lower_share(g, ice, axis, up);
  double             own = code % 2 ? lower_c : ice->alpha_cc[c] - lower_c,
         above = code % 2 ? ice->alpha_cc[up] - lower_up : lower_up;
  double P = ice->P_cc[up], top = half_density(sim, ice, up, P, above);
  for (int i = 0; i < 30; i++) P = ice->P_cc[up] + weight * (top + half_density(sim, ice, c, P, own));
  return P;
}

/* at the top of a closed box the fluid there has its reference pressure */
static double top_pressure(const struct sim *sim, const struct ice *ice, long c, int axis, long f)
{
  int most = 0;
  if (ice->kind[axis * sim->grid.size + f] == FACE_PRESSURE) return ice_outside_pressure(sim, ice, axis, f, 0);
  for (int k = 1; k < ice->n_fluids; k++)
    if (ice->alpha_cc[k * sim->grid.size + c] > ice->alpha_cc[most * sim->grid.size + c]) most = k;
  return pressure_at_reference(scene_fluid(sim->scene, most));
}

enum status ice_rest_several(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  double             gravity;
  int                code = ice_gravity_axis(sim, &gravity), axis = code / 2;
  if (sim->scene->start != START_AT_REST || gravity == 0) return OK;
  if (code < 0)
    return FAIL(ERR_INPUT, "fluids: several fluids start at rest under a gravity along an axis only; use \"start\": "
                           "\"zero\"");
  ice_open_rooms(sim, ice);
  plic_begin(&ice->plic, ice->alpha_cc);
  for (int k = 0; k < g->n[axis]; k++) {
    struct box plane = grid_cells(g);
    plane.lo[axis] = code % 2 ? k : g->n[axis] - 1 - k;
    plane.hi[axis] = plane.lo[axis] + 1;
    FOR_BOX(g, plane, c)
    {
      long up = c + (code % 2 ? -g->stride[axis] : g->stride[axis]), f = code % 2 ? c : up;
      ice->P_cc[c] = k == 0 ? pressure_under_top(sim, ice, c, top_pressure(sim, ice, c, axis, f), gravity * g->h)
                            : pressure_under_cell(sim, ice, c, up, code, gravity * g->h);
    }
  }
  return OK;
}
