/* What the cells of a fluid at any speed hold: one fluid, or several that take their room at one pressure. theory 4.13
 */
#include "ice/shock.h"

#include "core/parallel.h"
#include "eos/eos.h"

#include <math.h>

/* share of a cell below which a fluid is a trace that the others take over: no more than the round-off of fluxes */
static const double least_trace = 1e-14;
/* pressures of a cell are equal when they differ by less, over rho c2 */
static const double equal = 1e-13;
enum { MOST_ROUNDS = 60 };

/* Pa, m/s of fluid k; T: its temperature, NULL where energy is not solved */
static double pressure_of(const struct fluid *fluid, double rho, const double *T)
{
  double P;
  fluid->eos->pressure(fluid->eos_params, 1, &rho, T, &P);
  return P;
}

static double sound_of(const struct fluid *fluid, double P, const double *T)
{
  double c;
  if (T)
    eos_adiabatic_sound_speed(fluid->eos, fluid->eos_params, 1, &P, T, &c);
  else
    fluid->eos->sound_speed(fluid->eos_params, 1, &P, NULL, &c);
  return c;
}

static double temperature_of(const struct fluid *fluid, double rho, double e)
{
  double T;
  fluid->eos->temperature(fluid->eos_params, 1, &rho, &e, &T);
  return T;
}

double shock_internal_energy(const struct sim *sim, const struct ice *ice, int k, long c)
{
  const struct fluid *fluid = scene_fluid(sim->scene, k);
  double              e;
  long                own = k * sim->grid.size + c;
  fluid->eos->energy(fluid->eos_params, 1, &ice->rho_cc[own], ice_temperature(ice, own), &e);
  return e;
}

double shock_share(const struct grid *g, const struct ice *ice, int k, long c)
{
  return ice->n_fluids == 1 ? 1 : ice->alpha_cc[k * g->size + c];
}

double shock_yield(const struct grid *g, const struct ice *ice, int k, long c)
{
  return ice->n_fluids == 1 ? 1 : ice->yield_cc[k * g->size + c];
}

/* ---- the start of a step ---- */

/* Pa: what the pressure of a fluid of density rho can fall by until it is next to nothing */
static double slack_of(const struct fluid *fluid, double P, double rho, const double *T)
{
  static const double nothing = 1e-3; /* of the density */
  return P - pressure_of(fluid, nothing * rho, T);
}

double shock_sound(const struct sim *sim, const struct ice *ice, long c)
{
  const struct grid *g = &sim->grid;
  double             softness = 0, V = grid_cell_volume(g);
  if (ice->n_fluids == 1) return sound_of(&sim->scene->fluid, ice->P_cc[c], ice_temperature(ice, c));
  for (int k = 0; k < ice->n_fluids; k++) {
    long own = k * g->size + c;
    if (!(ice->mass_cc[own] > 0)) continue;
    double sound = sound_of(scene_fluid(sim->scene, k), ice->P_cc[c], ice_temperature(ice, own)),
           rho = ice->rho_cc[own];
    softness += ice->mass_cc[own] / (rho * V) / (rho * sound * sound);
  }
  return sqrt(V / (ice_cell_mass(g, ice, c) * softness));
}

/* densities and shares of a cell's fluids at its pressure, and how they share a change of its volume */
static void mix_cell(const struct sim *sim, struct ice *ice, long c)
{
  const struct grid *g = &sim->grid;
  double             V = grid_cell_volume(g), volume = 0, softness = 0;
  ice->slack_cc[c] = INFINITY;
  for (int k = 0; k < ice->n_fluids; k++) {
    const struct fluid *fluid = scene_fluid(sim->scene, k);
    long                own = k * g->size + c;
    const double       *T = ice_temperature(ice, own);
    fluid->eos->density(fluid->eos_params, 1, &ice->P_cc[c], T, &ice->rho_cc[own]);
    double rho = ice->rho_cc[own], sound = sound_of(fluid, ice->P_cc[c], T);
    if (ice->mass_cc[own] > 0) ice->slack_cc[c] = fmin(ice->slack_cc[c], slack_of(fluid, ice->P_cc[c], rho, T));
    ice->alpha_cc[own] = ice->mass_cc[own] / (rho * V);
    ice->yield_cc[own] = ice->alpha_cc[own] / (rho * sound * sound);
    volume += ice->alpha_cc[own];
    softness += ice->yield_cc[own];
  }
  for (int k = 0; k < ice->n_fluids; k++) {
    ice->alpha_cc[k * g->size + c] /= volume;
    ice->yield_cc[k * g->size + c] /= softness;
  }
  ice->mixture_cc[c] = ice_cell_mass(g, ice, c) / V;
  ice->sound_cc[c] = sqrt(volume / (ice->mixture_cc[c] * softness));
  ice->defect_cc[c] = 0;
}

enum status ice_mix_shock(struct sim *sim, double dt)
{
  (void)dt;
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX(g, cells, c)
  if (ice->wet_cc[c] > 0) mix_cell(sim, ice, c);
  for (int k = 0; k < ice->n_fluids; k++) {
    grid_fill_periodic(g, 1, ice->rho_cc + k * g->size);
    grid_fill_periodic(g, 1, ice->mass_cc + k * g->size);
  }
  grid_fill_periodic(g, 1, ice->P_cc);
  grid_fill_periodic(g, 1, ice->mixture_cc);
  grid_fill_periodic(g, 1, ice->sound_cc);
  grid_fill_periodic(g, 1, ice->slack_cc);
  grid_fill_periodic(g, g->dim, ice->vel_cc);
  return ice_check_range(sim, ice);
}

enum status ice_find_sound(struct sim *sim, double dt)
{
  (void)dt;
  struct ice *ice = ice_of(sim);
  struct box  cells = grid_cells(&sim->grid);
  FOR_BOX(&sim->grid, cells, c)
  {
    if (!(ice->wet_cc[c] > 0)) continue;
    ice->sound_cc[c] = shock_sound(sim, ice, c);
    ice->slack_cc[c] = slack_of(&sim->scene->fluid, ice->P_cc[c], ice->rho_cc[c], ice_temperature(ice, c));
  }
  grid_fill_periodic(&sim->grid, 1, ice->sound_cc);
  grid_fill_periodic(&sim->grid, 1, ice->slack_cc);
  return OK;
}

/* ---- the end of a step ---- */

/* fluid k of a cell in the room that it has now: density, temperature, pressure and volume over rho c2 */
static double press_fluid(const struct sim *sim, struct ice *ice, int k, long c, double *softness)
{
  const struct fluid *fluid = scene_fluid(sim->scene, k);
  long                own = k * sim->grid.size + c;
  double              rho = ice->mass_cc[own] / (ice->part_cc[own] * grid_cell_volume(&sim->grid));
  if (ice->T_cc) ice->T_cc[own] = temperature_of(fluid, rho, ice->inner_cc[own]);
  const double *T = ice_temperature(ice, own);
  double        P = pressure_of(fluid, rho, T), sound = sound_of(fluid, P, T);
  ice->rho_cc[own] = rho;
  *softness = ice->part_cc[own] / (rho * sound * sound);
  return P;
}

/* Fluid k gives way by the volume d, over that of a cell, at the pressure P of all. Works that sum up to nothing. */
static void yield_fluid(const struct sim *sim, struct ice *ice, int k, long c, double d, double P)
{
  long own = k * sim->grid.size + c;
  ice->part_cc[own] += d;
  if (ice->T_cc) ice->inner_cc[own] -= P * d * grid_cell_volume(&sim->grid) / ice->mass_cc[own];
}

/* one round: the mean pressure by softness, towards which every fluid of the cell swells or shrinks; returns how far
 * pressures were apart over rho c2 */
static double level_cell(const struct sim *sim, struct ice *ice, long c, const bool *there)
{
  static const double most = 0.5; /* share of its room by which a fluid changes in a round */
  double              own[MAX_SHOCK_FLUIDS], soft[MAX_SHOCK_FLUIDS], softness = 0, sum = 0, share = 1, apart = 0;
  for (int k = 0; k < ice->n_fluids; k++) {
    if (!there[k]) continue;
    own[k] = press_fluid(sim, ice, k, c, &soft[k]);
    softness += soft[k];
    sum += soft[k] * own[k];
  }
  double P = sum / softness;
  for (int k = 0; k < ice->n_fluids; k++) {
    if (!there[k]) continue;
    double part = ice->part_cc[k * sim->grid.size + c], d = fabs(soft[k] * (own[k] - P));
    apart = fmax(apart, d / part);
    if (d > most * part) share = fmin(share, most * part / d);
  }
  for (int k = 0; k < ice->n_fluids; k++)
    if (there[k]) yield_fluid(sim, ice, k, c, share * soft[k] * (own[k] - P), P);
  ice->P_cc[c] = P;
  return apart;
}

/* fluids that are there; traces give their energy to the others, and all together fill the cell */
static int find_fluids(const struct sim *sim, struct ice *ice, long c, bool *there)
{
  const struct grid *g = &sim->grid;
  double             lost = 0, mass = 0, volume = 0;
  int                n = 0;
  for (int k = 0; k < ice->n_fluids; k++) {
    long own = k * g->size + c;
    there[k] = ice->n_fluids == 1 || (ice->part_cc[own] > least_trace && ice->mass_cc[own] > 0);
    if (there[k]) {
      n++;
      mass += ice->mass_cc[own];
      volume += ice->part_cc[own];
      continue;
    }
    if (ice->T_cc) lost += ice->mass_cc[own] * ice->inner_cc[own];
    ice->part_cc[own] = ice->mass_cc[own] = 0;
  }
  for (int k = 0; k < ice->n_fluids; k++) {
    long own = k * g->size + c;
    if (!there[k]) continue;
    ice->part_cc[own] /= volume;
    if (ice->T_cc) ice->inner_cc[own] += lost / mass;
  }
  return n;
}

static bool settle_cell(const struct sim *sim, struct ice *ice, long c)
{
  bool there[MAX_SHOCK_FLUIDS];
  int  n = find_fluids(sim, ice, c, there), round = 0;
  if (ice->n_fluids > 1) ice->mixture_cc[c] = ice_cell_mass(&sim->grid, ice, c) / grid_cell_volume(&sim->grid);
  while (level_cell(sim, ice, c, there) > equal && n > 1)
    if (++round == MOST_ROUNDS) return false;
  return true;
}

enum status shock_settle(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  long               bad = 0;
  PARALLEL_FOR
  for (long r = 0; r < box_rows(&cells); r++) {
    long c0 = box_row(g, &cells, r), lost = 0;
    for (long c = c0; c < c0 + box_length(&cells); c++) lost += ice->wet_cc[c] > 0 && !settle_cell(sim, ice, c);
    if (lost > 0) {
#pragma omp atomic
      bad += lost;
    }
  }
  for (int k = 0; k < ice->n_fluids && ice->T_cc; k++) grid_fill_periodic(g, 1, ice->T_cc + k * g->size);
  if (bad == 0) return OK;
  return FAIL(ERR_DIVERGED,
              "ice: the fluids of %ld cells find no common pressure at t = %g s; lower "
              "numerics.ice.acoustic_courant or numerics.dt_factor",
              bad, sim->t);
}

/* ---- surfaces between the first fluid and the others ---- */

/* behind sides that let something through a full room, filled like the cell inside */
static void open_rooms(const struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  for (int side = 0; side < 2 * g->dim; side++) {
    int        axis = side / 2, high = side % 2;
    struct box faces = grid_side_faces(g, side);
    if (g->periodic[axis]) continue;
    FOR_BOX_SERIAL(g, faces, f)
    {
      long inside = high ? f - g->stride[axis] : f, beyond = high ? f : f - g->stride[axis];
      ice->room_cc[beyond] = ice->kind[axis * g->size + f] != FACE_CLOSED;
      ice->alpha_cc[beyond] = ice->alpha_cc[inside];
    }
  }
}

void shock_cut(struct sim *sim, struct ice *ice, int axis, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  long               base = axis * g->size;
  FOR_BOX(g, cells, c) ice->alpha_cc[c] = fmin(1, fmax(0, ice->part_cc[c] / ice->room_cc[c]));
  open_rooms(sim, ice);
  plic_begin(&ice->plic, ice->alpha_cc);
  plic_sweep(&ice->plic, axis, dt, ice->carried_fc + base, ice->alpha_cc, ice->liquid_fc + base);
}
