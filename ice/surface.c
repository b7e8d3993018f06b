/* Where the liquid ends now: saturation of the cells, which of them have a pressure, what every face is. theory 4.10 */
#include "ice/ice.h"

#include "core/parallel.h"
#include "eos/eos.h"

#include <math.h>
#include <string.h>

/* a cell filled to more than this share has a pressure; others fall freely */
static const double pressure_share = 0.5;

static void saturate(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             V = grid_cell_volume(g);
  FOR_BOX(g, cells, c)
  {
    double room = ice->porosity_cc[c] * ice->open_cc[c] * V;
    ice->alpha_cc[c] = room > 0 ? ice->mass_cc[c] / (ice->rho_cc[c] * room) : 0;
    ice->wet_cc[c] = ice_level(ice, c) > pressure_share;
    if (!(ice->wet_cc[c] > 0)) ice->P_cc[c] = 0;
  }
  grid_fill_periodic(g, 1, ice->alpha_cc);
  grid_fill_periodic(g, 1, ice->wet_cc);
  grid_fill_periodic(g, 1, ice->P_cc);
}

/* What must go: all that is beyond the pores; what is short only inside the liquid, and slowly: such a void closes by
 * the pressure around it. Less than a void is the pressure's own inaccuracy, and goes as it came, as does all of liquid
 * without a surface: else its pressure would rise. */
static double defect_of(const struct grid *g, const struct ice *ice, long c)
{
  static const double void_share = 0.1, least_void = -1e-3;
  double              D = ice->alpha_cc[c] - 1 - (ice->swell_cc ? ice->swell_cc[c] : 0);
  if (!(ice->wet_cc[c] > 0)) return 0;
  return D > 0 || !ice->surface ? D : ice_has_surface(g, ice, c) ? 0 : D < least_void ? void_share * D : D;
}

enum status ice_find_surface(struct sim *sim, double dt)
{
  (void)dt;
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  saturate(sim, ice);
  ice_classify_faces(sim, ice);
  FOR_BOX(g, cells, c) ice->defect_cc[c] = defect_of(g, ice, c);
  memcpy(ice->vel_start_cc, ice->vel_cc, (size_t)(g->size * g->dim) * sizeof(double));
  return OK;
}

/* ---- where its weight is ---- */

void ice_measure_fill(const struct sim *sim, const struct ice *ice)
{
  const struct fluid *fluid = &sim->scene->fluid;
  const struct grid  *g = &sim->grid;
  struct box          cells = grid_cells(g);
  double              V = grid_cell_volume(g);
  if (!ice->fill) return;
  FOR_BOX_SERIAL(g, cells, c)
  {
    double rho, room = ice->porosity_cc[c] * ice->open_cc[c] * V;
    fluid->eos->density(fluid->eos_params, 1, &ice->P_cc[c], ice_temperature(ice, c), &rho);
    ice->fill[c] = room > 0 ? ice->mass_cc[c] / (rho * room) : 0;
  }
  grid_fill_periodic(g, 1, ice->fill);
}

void ice_liquid_centre(const struct sim *sim, const struct ice *ice, long cell, double x[3])
{
  struct plane plane;
  double       centroid[3];
  grid_centre(&sim->grid, cell, x);
  if (!ice->fill || !plic_mixed(ice->fill[cell]) || ice->open_cc[cell] < 1) return;
  plic_reconstruct(&ice->plic, ice->fill, cell, &plane);
  plic_centroid(&plane, centroid);
  for (int d = 0; d < sim->grid.dim; d++) x[d] += sim->grid.h * centroid[d];
}
