/* What carrying will do to the full liquid in this step, so that faces end where cells will, and pressure balances the
 * liquid's own motion: what it did in the last step. theory 4.10 */
#include "ice/advect.h"

#include "core/parallel.h"

#include <string.h>

static bool is_full(const struct grid *g, const struct ice *ice, long c)
{
  if (ice->several) return ice_only_fluid(ice, c) >= 0;
  return ice->alpha_cc[c] > advect_full && ice->open_cc[c] >= 1 && !ice_has_surface(g, ice, c);
}

/* change of velocity component d across a face, upwards, that its flow carries into the cells beside it; nothing comes
 * through walls, and from outside only what a side prescribes, half a cell away */
static double step_across(const struct sim *sim, const struct ice *ice, int axis, long f, int d)
{
  const struct grid *g = &sim->grid;
  long               low = f - g->stride[axis];
  int                place[3];
  enum face_kind     kind = ice->kind[axis * g->size + f];
  if (kind == FACE_INNER) return ice->vel_cc[f * g->dim + d] - ice->vel_cc[low * g->dim + d];
  if (kind != FACE_INLET) return 0;
  double given = ice_inlet_velocity(sim, axis, d, f, sim->t);
  grid_place(g, f, place);
  return 2 * (place[axis] == 0 ? ice->vel_cc[f * g->dim + d] - given : given - ice->vel_cc[low * g->dim + d]);
}

/* -(u . grad) u by central differences */
static double central_change(const struct sim *sim, const struct ice *ice, long c, int d)
{
  const struct grid *g = &sim->grid;
  double             sum = 0;
  for (int axis = 0; axis < g->dim; axis++) {
    const double *flux = ice->water_fc + axis * g->size;
    long          up = c + g->stride[axis];
    sum += flux[c] * step_across(sim, ice, axis, c, d) + flux[up] * step_across(sim, ice, axis, up, d);
  }
  return -0.5 * sum / (g->h * ice->porosity_cc[c]);
}

void ice_start_forecast(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX(g, cells, c)
  for (int d = 0; d < g->dim && is_full(g, ice, c); d++)
    ice->forecast_cc[c * g->dim + d] = central_change(sim, ice, c, d);
  grid_fill_periodic(g, g->dim, ice->forecast_cc);
}

void ice_begin_forecast(struct sim *sim, struct ice *ice)
{
  memcpy(ice->forecast_cc, ice->vel_cc, (size_t)(sim->grid.size * sim->grid.dim) * sizeof(double));
}

void ice_end_forecast(struct sim *sim, struct ice *ice, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX(g, cells, c)
  {
    bool known = is_full(g, ice, c);
    for (int d = 0; d < g->dim; d++) {
      double *a = &ice->forecast_cc[c * g->dim + d];
      *a = known ? (ice->vel_cc[c * g->dim + d] - *a) / dt : 0;
    }
  }
  grid_fill_periodic(g, g->dim, ice->forecast_cc);
}

double ice_face_forecast(const struct sim *sim, const struct ice *ice, int axis, long f)
{
  const struct grid *g = &sim->grid;
  if (!ice->forecast_cc || !advect_is_smooth(&sim->grid, ice, axis, f)) return 0;
  return 0.5 * (ice->forecast_cc[f * g->dim + axis] + ice->forecast_cc[(f - g->stride[axis]) * g->dim + axis]);
}
