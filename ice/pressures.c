/* New pressures of cells with several fluids. The volume equation is a straight line in dP and a gas is none. theory
 * 4.15 */
#include "ice/equilibrium.h"
#include "ice/ice.h"

#include "core/parallel.h"

#include <math.h>

/* change of the softest fluid's density, relative, up to which dP is as good */
static const double straight = 1e-3;
/* by how much a step may compress the softest fluid: what is left stays in the defect */
static const double most_squeezed = 0.5;

/* Pressure at which the fluids of a cell have changed their volume by what the equation says; returns the steps of
 * Newton's method, 0 where none was needed */
static int advance(const struct sim *sim, struct ice *ice, long c)
{
  double dP = fmin(ice->dP_cc[c], most_squeezed / ice->soft_cc[c]), m[MAX_FLUIDS];
  double room = ice->porosity_cc[c] * ice->open_cc[c] * grid_cell_volume(&sim->grid);
  double volume = room * (1 + ice->defect_cc[c]) * (1 - ice->kappa_cc[c] * dP);
  if (fabs(ice->dP_cc[c]) * ice->soft_cc[c] < straight) {
    ice->P_cc[c] += ice->dP_cc[c];
    return 0;
  }
  for (int k = 0; k < ice->n_fluids; k++) m[k] = ice->mass_cc[k * sim->grid.size + c];
  return ice_equilibrium(sim->scene, m, NULL, volume, &ice->P_cc[c]);
}

void ice_advance_pressures(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  long               solved = 0, steps = 0;
  PARALLEL_FOR
  for (long r = 0; r < box_rows(&cells); r++) {
    long c0 = box_row(g, &cells, r), row_solved = 0, row_steps = 0;
    for (long c = c0; c < c0 + box_length(&cells); c++) {
      int own = advance(sim, ice, c);
      row_solved += own > 0;
      row_steps += own;
    }
    if (row_solved > 0) {
#pragma omp atomic
      solved += row_solved;
#pragma omp atomic
      steps += row_steps;
    }
  }
  sim->solver.equilibria += solved;
  sim->solver.equilibrium_steps += steps;
}
