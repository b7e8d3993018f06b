/* Cells of the fluid at any speed: pressures of their faces give them momentum, and the work of these pressures energy.
 * theory 4.13 */
#include "ice/shock.h"

#include "core/parallel.h"
#include "eos/eos.h"

#include <math.h>

double shock_sound(const struct sim *sim, const struct ice *ice, long c)
{
  const struct fluid *fluid = &sim->scene->fluid;
  double              sound;
  if (ice->T_cc)
    eos_adiabatic_sound_speed(fluid->eos, fluid->eos_params, 1, &ice->P_cc[c], &ice->T_cc[c], &sound);
  else
    fluid->eos->sound_speed(fluid->eos_params, 1, &ice->P_cc[c], NULL, &sound);
  return sound;
}

double shock_internal_energy(const struct sim *sim, const struct ice *ice, long c, double rho)
{
  double e = 0;
  if (ice->T_cc) sim->scene->fluid.eos->energy(sim->scene->fluid.eos_params, 1, &rho, &ice->T_cc[c], &e);
  return e;
}

void shock_settle(struct sim *sim, struct ice *ice)
{
  const struct fluid *fluid = &sim->scene->fluid;
  struct box          cells = grid_cells(&sim->grid);
  double              V = grid_cell_volume(&sim->grid);
  FOR_BOX(&sim->grid, cells, c)
  {
    if (!(ice->wet_cc[c] > 0)) continue;
    ice->rho_cc[c] = ice->mass_cc[c] / V;
    fluid->eos->pressure(fluid->eos_params, 1, &ice->rho_cc[c], ice_temperature(ice, c), &ice->P_cc[c]);
  }
}

enum status ice_find_sound(struct sim *sim, double dt)
{
  (void)dt;
  struct ice *ice = ice_of(sim);
  struct box  cells = grid_cells(&sim->grid);
  FOR_BOX(&sim->grid, cells, c) ice->sound_cc[c] = ice->wet_cc[c] > 0 ? shock_sound(sim, ice, c) : 0;
  grid_fill_periodic(&sim->grid, 1, ice->sound_cc);
  if (ice->T_cc) grid_fill_periodic(&sim->grid, 1, ice->T_cc);
  return OK;
}

/* pressures of the step at the faces: what they started with and theta times the change, weighted as M(54) */
static void press_faces(struct sim *sim, struct ice *ice, int axis)
{
  const struct grid *g = &sim->grid;
  struct box         faces = grid_faces(g, axis);
  double             theta = sim->scene->numerics.theta;
  FOR_BOX(g, faces, f)
  {
    long           low = f - g->stride[axis], q = axis * g->size + f;
    enum face_kind kind = ice->kind[q];
    double         l = ice->rho_cc[low], h = ice->rho_cc[f];
    if (kind == FACE_INNER)
      ice->press_fc[q] += theta * (h * ice->dP_cc[low] + l * ice->dP_cc[f]) / (l + h);
    else if (kind != FACE_PRESSURE)
      ice->press_fc[q] += theta * ice->dP_cc[ice->wet_cc[f] > 0 ? f : low];
  }
}

/* what weight does while mass flows through a cell, J */
static double work_of_weight(const struct sim *sim, const struct ice *ice, long c, const double *gravity, double dt)
{
  const struct grid *g = &sim->grid;
  double             sum = 0;
  for (int d = 0; d < g->dim; d++)
    sum += gravity[d] *
           (shock_carried_weight(sim, ice, d, c, dt) + shock_carried_weight(sim, ice, d, c + g->stride[d], dt));
  return 0.5 * g->h * sum;
}

static double square(const double *v, int dim)
{
  double sum = 0;
  for (int d = 0; d < dim; d++) sum += v[d] * v[d];
  return sum;
}

/* velocity and total energy of one cell; the pressures of both faces of an axis do the work of its carried fluxes */
static void push_cell(const struct sim *sim, struct ice *ice, long c, const double *gravity, double dt)
{
  const struct grid *g = &sim->grid;
  double             m = ice->mass_cc[c], area = ice_face_area(g), *v = &ice->vel_cc[c * g->dim], work = 0;
  if (ice->T_cc) {
    work = m * (shock_internal_energy(sim, ice, c, ice->rho_cc[c]) + 0.5 * square(v, g->dim));
    work += work_of_weight(sim, ice, c, gravity, dt);
  }
  for (int d = 0; d < g->dim; d++) {
    long   low = d * g->size + c, high = low + g->stride[d];
    double flux = ice->press_fc[low] * ice->carried_fc[low] - ice->press_fc[high] * ice->carried_fc[high];
    v[d] += dt * (area * (ice->press_fc[low] - ice->press_fc[high]) / m + gravity[d]);
    work += dt * area * flux;
  }
  if (ice->T_cc) ice->energy_cc[c] = work;
}

/* fastest fluid, and how fast cells are squeezed or swell, 1/s */
static enum status watch(const struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             fastest = 0, most = 0;
  FOR_BOX_SERIAL(g, cells, c)
  {
    double swells = 0;
    for (int d = 0; d < g->dim; d++) {
      long   low = d * g->size + c, high = low + g->stride[d];
      double most_here = fmax(fabs(ice->carried_fc[low]), fabs(ice->carried_fc[high]));
      fastest = isfinite(most_here) ? fmax(fastest, most_here) : INFINITY;
      swells += ice->carried_fc[high] - ice->carried_fc[low];
    }
    most = fmax(most, fabs(swells) / g->h);
  }
  ice->now.speed = fastest;
  ice->now.squeeze = most;
  if (fastest < INFINITY) return OK;
  return FAIL(ERR_DIVERGED, "ice: a fluid velocity is not finite at t = %g s; lower numerics.dt_factor", sim->t);
}

enum status ice_push_shock(struct sim *sim, double dt)
{
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             gravity[3];
  sim_gravity(sim, sim->t + 0.5 * dt, gravity);
  TRY(watch(sim, ice));
  for (int axis = 0; axis < g->dim; axis++) press_faces(sim, ice, axis);
  FOR_BOX(g, cells, c)
  if (ice->wet_cc[c] > 0) push_cell(sim, ice, c, gravity, dt);
  return OK;
}

static enum status check_cell(const struct sim *sim, const struct ice *ice, long c)
{
  double x[3];
  grid_centre(&sim->grid, c, x);
  if (!(ice->wet_cc[c] > 0))
    return FAIL(
        ERR_INPUT,
        "numerics.ice.shocks: the cell at (%g, %g, %g) is empty at the start, where a fluid at any speed has no "
        "surface; let fluid.region fill the grid",
        x[0], x[1], x[2]);
  return OK;
}

enum status shock_create(struct sim *sim, struct ice *ice)
{
  const struct scene *scene = sim->scene;
  struct box          cells = grid_cells(&sim->grid);
  if (scene->n_solids > 0)
    return FAIL(ERR_INPUT, "numerics.ice.shocks: a fluid at any speed does not meet solids yet; remove solids, or set "
                           "numerics.ice.shocks false");
  if (scene->fluid.viscosity > 0)
    return FAIL(ERR_INPUT,
                "numerics.ice.shocks: the fluid at any speed has no viscosity; set fluid.viscosity to 0, "
                "not %g",
                scene->fluid.viscosity);
  if (isinf(scene->fluid.bulk_modulus))
    return FAIL(ERR_INPUT, "numerics.ice.shocks: no sound in an incompressible fluid; give fluid.bulk_modulus");
  FOR_BOX_SERIAL(&sim->grid, cells, c) TRY(check_cell(sim, ice, c));
  return OK;
}

void shock_measure(const struct sim *sim, struct ledger *l)
{
  const struct ice   *ice = ice_of(sim);
  const struct fluid *fluid = &sim->scene->fluid;
  struct box          cells = grid_cells(&sim->grid);
  double              V = grid_cell_volume(&sim->grid);
  FOR_BOX_SERIAL(&sim->grid, cells, c)
  {
    double rho = ice->mass_cc[c] / V, e;
    fluid->eos->energy(fluid->eos_params, 1, &rho, ice_temperature(ice, c), &e);
    l->v[LEDGER_compression] += ice->mass_cc[c] * e;
  }
}
