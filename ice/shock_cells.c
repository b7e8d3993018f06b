/* Cells of the fluid at any speed: pressures of their faces give them momentum, and the work of these pressures energy.
 * theory 4.13 */
#include "ice/shock.h"

#include "core/parallel.h"
#include "eos/eos.h"

#include <math.h>

/* pressures of the step at the faces: what they started with and theta times the change, weighted by impedances, which
 * is M(54) where both sides have one speed of sound */
static void press_faces(struct sim *sim, struct ice *ice, int axis)
{
  const struct grid *g = &sim->grid;
  struct box         faces = grid_faces(g, axis);
  double             theta = sim->scene->numerics.theta;
  FOR_BOX(g, faces, f)
  {
    long           low = f - g->stride[axis], q = axis * g->size + f;
    enum face_kind kind = ice->kind[q];
    double         l = ice->filling_cc[low] * ice->sound_cc[low], h = ice->filling_cc[f] * ice->sound_cc[f];
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

/* What the internal energy of a cell gains beyond that of its fluids goes to them as they give way. */
static void warm_fluids(const struct sim *sim, struct ice *ice, long c)
{
  const struct grid *g = &sim->grid;
  double gained = ice->energy_cc[c] - 0.5 * ice_cell_mass(g, ice, c) * square(&ice->vel_cc[c * g->dim], g->dim);
  for (int k = 0; k < ice->n_fluids; k++) gained -= ice->mass_cc[k * g->size + c] * ice->inner_cc[k * g->size + c];
  for (int k = 0; k < ice->n_fluids; k++) {
    long own = k * g->size + c;
    if (ice->mass_cc[own] > 0) ice->inner_cc[own] += shock_yield(g, ice, k, c) * gained / ice->mass_cc[own];
  }
}

/* velocity and energies of one cell; the pressures of both faces of an axis do the work of its carried fluxes */
static void push_cell(const struct sim *sim, struct ice *ice, long c, const double *gravity, double dt)
{
  const struct grid *g = &sim->grid;
  double             m = ice_cell_mass(g, ice, c), area = ice_face_area(g), *v = &ice->vel_cc[c * g->dim], work = 0;
  for (int k = 0; k < ice->n_fluids && ice->T_cc; k++) {
    long own = k * g->size + c;
    ice->inner_cc[own] = ice->mass_cc[own] > 0 ? shock_internal_energy(sim, ice, k, c) : 0;
    work += ice->mass_cc[own] * ice->inner_cc[own];
  }
  if (ice->T_cc) work += 0.5 * m * square(v, g->dim) + work_of_weight(sim, ice, c, gravity, dt);
  for (int d = 0; d < g->dim; d++) {
    long   low = d * g->size + c, high = low + g->stride[d];
    double flux = ice->press_fc[low] * ice->carried_fc[low] - ice->press_fc[high] * ice->carried_fc[high];
    v[d] += dt * (area * (ice->press_fc[low] - ice->press_fc[high]) / m + gravity[d]);
    work += dt * area * flux;
  }
  if (!ice->T_cc) return;
  ice->energy_cc[c] = work;
  warm_fluids(sim, ice, c);
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

/* whole cells may be behind obstacles that stay; all others are full */
static enum status check_cell(const struct sim *sim, const struct ice *ice, long c)
{
  double x[3], open = ice->open_cc[c];
  grid_centre(&sim->grid, c, x);
  if (open > 0 && open < 1)
    return FAIL(
        ERR_INPUT,
        "numerics.ice.shocks: an obstacle leaves %g of the cell at (%g, %g, %g); in a fluid at any speed it must end "
        "on the sides of cells: choose grid.h so",
        open, x[0], x[1], x[2]);
  if (open > 0 && !(ice->wet_cc[c] > 0))
    return FAIL(
        ERR_INPUT,
        "numerics.ice.shocks: the cell at (%g, %g, %g) is empty at the start, where a fluid at any speed has no "
        "surface; let fluid.region fill the grid",
        x[0], x[1], x[2]);
  return OK;
}

static enum status check_scene(const struct scene *scene)
{
  if (scene->n_solids > 0)
    return FAIL(ERR_INPUT, "numerics.ice.shocks: a fluid at any speed does not meet solids yet; remove solids, or set "
                           "numerics.ice.shocks false");
  for (int k = 0; k < scene->n_obstacles; k++) {
    const struct obstacle *o = &scene->obstacles[k];
    for (int d = 0; d < 3; d++)
      if (o->from > 0 || o->until < scene->time_end || o->velocity[d].expression || o->velocity[d].constant != 0)
        return FAIL(ERR_INPUT,
                    "numerics.ice.shocks: the obstacle %s moves, comes or goes, which a fluid at any speed does "
                    "not feel yet; let it stay",
                    o->name);
  }
  if (scene->n_fluids > MAX_SHOCK_FLUIDS)
    return FAIL(ERR_INPUT, "numerics.ice.shocks: %d fluids are too many; at most %d", scene->n_fluids,
                MAX_SHOCK_FLUIDS);
  if (scene->n_fluids > 1 && isfinite(scene->fluid.exchange))
    return FAIL(ERR_INPUT, "numerics.ice.shocks: fluids at any speed have one velocity; leave fluid.exchange out");
  if (scene->fluid.conductivity > 0)
    return FAIL(ERR_INPUT,
                "numerics.ice.shocks: a fluid at any speed does not conduct heat; set fluid.conductivity to 0, "
                "not %g",
                scene->fluid.conductivity);
  for (int k = 0; k < scene->n_fluids; k++) {
    const struct fluid *fluid = scene_fluid(scene, k);
    if (fluid->viscosity > 0)
      return FAIL(ERR_INPUT,
                  "numerics.ice.shocks: a fluid at any speed has no viscosity; set that of fluid %d to 0, not %g",
                  k + 1, fluid->viscosity);
    if (isinf(fluid->bulk_modulus))
      return FAIL(ERR_INPUT,
                  "numerics.ice.shocks: no sound in an incompressible fluid; give the bulk_modulus of fluid "
                  "%d",
                  k + 1);
  }
  return OK;
}

/* masses of several fluids from their shares, the pressure and the temperature, which is the same for all */
static void weigh_fluids(const struct sim *sim, struct ice *ice, long c)
{
  const struct grid *g = &sim->grid;
  double             x[3], mass = 0, momentum[3] = {0};
  grid_centre(g, c, x);
  for (int k = 0; k < ice->n_fluids; k++) {
    const struct fluid *fluid = scene_fluid(sim->scene, k);
    long                own = k * g->size + c;
    if (ice->T_cc) ice->T_cc[own] = ice->T_cc[c];
    fluid->eos->density(fluid->eos_params, 1, &ice->P_cc[c], ice_temperature(ice, own), &ice->rho_cc[own]);
    ice->mass_cc[own] = ice->alpha_cc[own] * ice->rho_cc[own] * grid_cell_volume(g);
    mass += ice->mass_cc[own];
    for (int d = 0; d < g->dim; d++) momentum[d] += ice->mass_cc[own] * function_value(&fluid->velocity[d], x, 0);
  }
  for (int d = 0; d < g->dim; d++) ice->vel_cc[c * g->dim + d] = momentum[d] / mass;
  ice->mixture_cc[c] = mass / grid_cell_volume(g);
}

enum status shock_create(struct sim *sim, struct ice *ice)
{
  struct box cells = grid_cells(&sim->grid);
  TRY(check_scene(sim->scene));
  FOR_BOX_SERIAL(&sim->grid, cells, c)
  {
    TRY(check_cell(sim, ice, c));
    if (ice->n_fluids > 1 && ice->wet_cc[c] > 0) weigh_fluids(sim, ice, c);
  }
  return ice->n_fluids > 1 ? plic_create(&sim->grid, ice->room_cc, &ice->plic) : OK;
}

void shock_measure(const struct sim *sim, struct ledger *l)
{
  const struct ice  *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  for (int k = 0; k < ice->n_fluids; k++) FOR_BOX_SERIAL(g, cells, c)
  if (ice->mass_cc[k * g->size + c] > 0)
    l->v[LEDGER_compression] += ice->mass_cc[k * g->size + c] * shock_internal_energy(sim, ice, k, c);
}
