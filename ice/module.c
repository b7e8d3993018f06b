/* Fluid path: fluids in cells with an implicit pressure. Its stages, when each is needed, its fields. Read this
 * first. */
#include "ice/heat.h"
#include "ice/obstacles.h"
#include "ice/shock.h"

#include "core/memory.h"
#include "core/parallel.h"
#include "eos/eos.h"
#include "mpm/mpm.h"

#include <math.h>

static bool warm(const struct scene *sc) { return fluid_has_energy(&sc->fluid); }
static bool skeleton(const struct scene *sc) { return sc->n_solids > 0; }
static bool advects(const struct scene *sc)
{
  const struct ice_params *params = scene_module_params(sc, &module_ice);
  return params->advection && !params->shocks && !sc->fluid.prescribed;
}
static bool shocks(const struct scene *sc)
{
  const struct ice_params *params = scene_module_params(sc, &module_ice);
  return params->shocks;
}
static bool prescribed(const struct scene *sc) { return sc->fluid.prescribed; }
static bool driven(const struct scene *sc) { return !prescribed(sc); }
static bool calm(const struct scene *sc) { return !shocks(sc) && driven(sc); }
static bool cold_shocks(const struct scene *sc) { return shocks(sc) && !warm(sc); }
static bool warm_shocks(const struct scene *sc) { return shocks(sc) && warm(sc); }
static bool several(const struct scene *sc) { return sc->n_fluids > 1 && advects(sc); }
static bool separate(const struct scene *sc) { return several(sc) && isfinite(sc->fluid.exchange); }
static bool together(const struct scene *sc) { return driven(sc) && !separate(sc); }
static bool share_velocity(const struct scene *sc) { return several(sc) && !separate(sc); }
static bool several_shocks(const struct scene *sc) { return sc->n_fluids > 1 && shocks(sc); }
static bool one_shocks(const struct scene *sc) { return sc->n_fluids < 2 && shocks(sc); }
static bool alone(const struct scene *sc) { return !several(sc) && !several_shocks(sc); }
static bool one_advects(const struct scene *sc) { return advects(sc) && alone(sc); }
static bool sharp(const struct scene *sc) { return one_advects(sc) || prescribed(sc); }
static bool carries_cold(const struct scene *sc) { return one_advects(sc) && !warm(sc); }
static bool carries_warm(const struct scene *sc) { return one_advects(sc) && warm(sc); }
static bool exchanges(const struct scene *sc) { return carries_warm(sc) && heat_has_grains(sc); }
static bool conducts(const struct scene *sc)
{
  return carries_warm(sc) && !heat_has_grains(sc) && sc->fluid.conductivity > 0;
}
static bool turbulent(const struct scene *sc)
{
  const struct ice_params *params = scene_module_params(sc, &module_ice);
  return advects(sc) && params->smagorinsky > 0;
}
static bool viscous(const struct scene *sc)
{
  const struct ice_params *params = scene_module_params(sc, &module_ice);
  bool                     any = turbulent(sc);
  for (int k = 0; k < sc->n_fluids; k++) any = any || scene_fluid(sc, k)->viscosity > 0;
  return advects(sc) && params->shear && any;
}
static bool no_trend(const struct scene *sc) { return !advects(sc) && driven(sc); }
static bool rests(const struct scene *sc) { return no_trend(sc) && !shocks(sc); }
static bool moving(const struct scene *sc) { return mpm_solid_moves(sc); }

static const struct field fields[] = {
#define FIELD(...) FIELD_ROW(struct ice, __VA_ARGS__)
#include "ice/fields.def"
#undef FIELD
};

static const struct stage stages[] = {
    {"ice.move_obstacles", SLOT_volume_fractions, "mass_cc vel_cc P_cc", "mass_cc vel_cc P_cc", "4.14",
     "only when an obstacle in the liquid moves, comes or goes", obstacles_change, ice_move_obstacles,
     ice_obstacles_dt},
    {"ice.update_properties", SLOT_volume_fractions, "P_cc T_cc? mass_cc wet_cc vel_cc", "rho_cc defect_cc", "4.1",
     "only with one fluid", alone, ice_update_properties, NULL},
    {"ice.mix_fluids", SLOT_volume_fractions, "P_cc mass_cc wet_cc vel_cc",
     "rho_cc alpha_cc mixture_cc kappa_cc soft_cc defect_cc lower_fc vel_start_cc pore_cc", "4.15",
     "only with several fluids", several, ice_mix_fluids, NULL},
    {"ice.find_surface", SLOT_volume_fractions, "rho_cc mass_cc", "alpha_cc wet_cc P_cc defect_cc vel_start_cc", "4.10",
     "only with numerics.ice.advection and one fluid", sharp, ice_find_surface, NULL},
    {"ice.find_sound", SLOT_volume_fractions, "P_cc T_cc?", "sound_cc slack_cc", "4.13",
     "only with numerics.ice.shocks and one fluid", one_shocks, ice_find_sound, NULL},
    {"ice.mix_shock", SLOT_volume_fractions, "P_cc T_cc? mass_cc wet_cc vel_cc",
     "rho_cc alpha_cc mixture_cc yield_cc sound_cc slack_cc defect_cc liquid_fc", "4.13",
     "only with numerics.ice.shocks and several fluids", several_shocks, ice_mix_shock, NULL},
    {"ice.measure_eddies", SLOT_volume_fractions, "wet_cc rho_cc vel_cc", "mu_cc", "4.11",
     "only with numerics.ice.smagorinsky", turbulent, ice_measure_eddies, NULL},
    {"ice.diffuse_momentum", SLOT_volume_fractions, "wet_cc mass_cc vel_cc", "viscous_cc vel_cc", "4.11",
     "only with numerics.ice.advection and shear, and a viscosity", viscous, ice_diffuse_momentum, ice_viscous_dt},
    {"ice.predict_faces", SLOT_predict, "P_cc mass_cc vel_cc beyond_fc rho_cc", "gradP_fc u_old_fc s_old_fc", "4.2",
     "only without numerics.ice.shocks", calm, ice_predict_faces, ice_dt_limit},
    {"ice.predict_solid", SLOT_predict, "mass_nc force_nc vel_nc solid_nc room_nc gradP_fc", "vel_star_nc s_old_fc",
     "4.2", "only when a solid moves", moving, ice_predict_solid, NULL},
    {"ice.predict_shock", SLOT_predict, "P_cc vel_cc rho_cc sound_cc slack_cc",
     "gradP_fc u_old_fc s_old_fc flux_fc water_fc press_fc", "4.13", "only with numerics.ice.shocks", shocks,
     ice_predict_shock, ice_shock_dt},
    {"ice.resist_faces", SLOT_drag, "u_old_fc s_old_fc porosity_fc fill_fc medium_porosity_fc", "drag_fc", "2.2",
     "only when there is a skeleton", skeleton, ice_resist_faces, NULL},
    {"ice.eliminate_drag", SLOT_eliminate, "u_old_fc s_old_fc gradP_fc rho_cc", "u_fc s_fc u_reply_fc s_reply_fc",
     "4.3", "not with a prescribed motion, nor with a finite fluid.exchange", together, ice_eliminate_drag, NULL},
    {"ice.predict_each", SLOT_eliminate, "each_cc vel_cc mass_cc alpha_cc u_old_fc", "each_cc each_old_fc cut_fc",
     "4.17", "only with a finite fluid.exchange", separate, ice_predict_each, NULL},
    {"ice.eliminate_each", SLOT_eliminate, "each_old_fc each_cc s_old_fc gradP_fc mass_cc alpha_cc",
     "each_fc each_reply_fc u_fc s_fc u_reply_fc s_reply_fc", "4.17", "only with a finite fluid.exchange", separate,
     ice_eliminate_each, NULL},
    {"ice.solve_pressure", SLOT_pressure, "u_fc s_fc u_reply_fc s_reply_fc flux_fc defect_cc",
     "coupling_fc diagonal_cc rhs_cc dP_cc flux_fc", "4.4", "not with a prescribed motion", driven, ice_solve_pressure,
     NULL},
    {"ice.correct_faces", SLOT_correct, "dP_cc u_reply_fc s_reply_fc water_fc",
     "u_fc s_fc flux_fc water_fc carried_fc P_cc", "4.4", "only without numerics.ice.advection", no_trend,
     ice_correct_faces, NULL},
    {"ice.correct_faces_and_trend", SLOT_correct, "dP_cc u_reply_fc s_reply_fc water_fc",
     "u_fc s_fc flux_fc water_fc trend_fc carried_fc P_cc", "4.10", "only with numerics.ice.advection", advects,
     ice_correct_faces, NULL},
    {"ice.correct_each", SLOT_correct, "dP_cc each_reply_fc carried_fc", "each_fc first_fc", "4.17",
     "only with a finite fluid.exchange", separate, ice_correct_each, NULL},
    {"ice.move_defect", SLOT_defect, "defect_cc diagonal_cc coupling_fc carried_fc", "shift_cc carried_fc", "4.5",
     "only when a solid moves", moving, ice_move_defect, NULL},
    {"ice.update_cells", SLOT_cells, "u_fc u_old_fc carried_fc mass_cc vel_cc", "mass_cc vel_cc beyond_fc", "4.6",
     "only without numerics.ice.advection", rests, ice_update_cells, NULL},
    {"ice.accelerate_cells", SLOT_cells, "u_fc u_old_fc mass_cc vel_cc", "vel_cc beyond_fc", "4.10",
     "only with numerics.ice.advection", advects, ice_accelerate_cells, NULL},
    {"ice.centre_diffusion", SLOT_cells, "wet_cc mass_cc vel_cc viscous_cc", "momentum_cc vel_cc", "4.11",
     "only with numerics.ice.advection and shear, and a viscosity", viscous, ice_centre_diffusion, NULL},
    {"ice.advect", SLOT_cells, "carried_fc trend_fc vel_start_cc alpha_cc rho_cc mass_cc vel_cc",
     "pore_cc liquid_fc momentum_cc alpha_cc mass_cc vel_cc forecast_cc", "4.10",
     "only with numerics.ice.advection, one fluid, no energy", carries_cold, ice_advect, NULL},
    {"ice.advect_with_heat", SLOT_cells, "carried_fc trend_fc vel_start_cc alpha_cc rho_cc mass_cc vel_cc T_cc",
     "pore_cc liquid_fc momentum_cc warmth_cc alpha_cc mass_cc vel_cc T_cc forecast_cc", "4.12",
     "only with numerics.ice.advection, one fluid and energy", carries_warm, ice_advect, NULL},
    {"ice.conduct_heat", SLOT_cells, "mass_cc wet_cc P_cc T_cc", "T_cc warming_cc swell_cc", "4.12",
     "only with energy and fluid.conductivity, no grains with heat", conducts, ice_conduct_heat, ice_heat_dt},
    {"ice.conduct_and_exchange_heat", SLOT_cells,
     "mass_cc wet_cc alpha_cc P_cc T_cc x_p mass_p volume_p volume_solid_p temperature_p",
     "T_cc T_solid_cc temperature_p warming_cc swell_cc", "4.12", "only with energy, in fluid and grains", exchanges,
     ice_conduct_heat, ice_heat_dt},
    {"ice.carry_prescribed", SLOT_cells, "water_fc alpha_cc rho_cc mass_cc",
     "pore_cc carried_fc liquid_fc alpha_cc mass_cc", "4.16", "only with fluid.motion prescribed", prescribed,
     ice_carry_prescribed, ice_prescribed_dt},
    {"ice.push_shock", SLOT_cells, "press_fc dP_cc carried_fc rho_cc yield_cc? mass_cc vel_cc", "press_fc vel_cc",
     "4.13", "only with numerics.ice.shocks, no energy", cold_shocks, ice_push_shock, NULL},
    {"ice.push_shock_with_energy", SLOT_cells, "press_fc dP_cc carried_fc rho_cc yield_cc? mass_cc vel_cc T_cc",
     "press_fc vel_cc energy_cc inner_cc", "4.13", "only with numerics.ice.shocks and energy", warm_shocks,
     ice_push_shock, NULL},
    {"ice.carry_shock", SLOT_cells, "carried_fc rho_cc yield_cc? liquid_fc? mass_cc vel_cc",
     "room_cc part_cc dense_cc flat_cc volume_fc mass_fc momentum_fc mass_cc vel_cc rho_cc P_cc", "4.13",
     "only with numerics.ice.shocks, no energy", cold_shocks, ice_carry_shock, NULL},
    {"ice.carry_shock_with_energy", SLOT_cells,
     "carried_fc rho_cc yield_cc? liquid_fc? mass_cc vel_cc energy_cc inner_cc T_cc",
     "room_cc part_cc dense_cc inner_cc flat_cc volume_fc mass_fc momentum_fc heat_fc energy_fc mass_cc vel_cc rho_cc "
     "T_cc P_cc",
     "4.13", "only with numerics.ice.shocks and energy", warm_shocks, ice_carry_shock, NULL},
    {"ice.advect_fluids", SLOT_cells, "carried_fc trend_fc vel_start_cc alpha_cc rho_cc mixture_cc mass_cc vel_cc",
     "pore_cc liquid_fc passed_fc through_cc alpha_cc mass_cc vel_cc forecast_cc", "4.15",
     "only with several fluids with one velocity", share_velocity, ice_advect, NULL},
    {"ice.advect_each", SLOT_cells, "carried_fc first_fc trend_fc vel_start_cc alpha_cc rho_cc mass_cc vel_cc each_cc",
     "pore_cc liquid_fc passed_fc each_through_cc alpha_cc mass_cc vel_cc each_cc forecast_cc", "4.17",
     "only with a finite fluid.exchange", separate, ice_advect, NULL},
    {"ice.push_solid", SLOT_to_solid, "s_fc s_old_fc gradP_fc mass_nc solid_nc", "dmom_nc", "4.6",
     "only when a solid moves", moving, ice_push_solid, NULL},
};

static const struct param params[] = {
    {"advection", PARAM_FLAG, offsetof(struct ice_params, advection), "-", 0, 0, "false", NULL,
     "the liquid carries its momentum, and its surface goes where it flows; without, a surface stays in its cell"},
    {"shocks", PARAM_FLAG, offsetof(struct ice_params, shocks), "-", 0, 0, "false", NULL,
     "a fluid at any speed, to shocks, that fills the grid: total energy is conserved where energy is solved"},
    {"acoustic_courant", PARAM_NUMBER, offsetof(struct ice_params, acoustic_courant), "-", 0, 1e6, "0", NULL,
     "cells that a wave of sound may go per step; 0: the step does not know of sound"},
    {"shear", PARAM_FLAG, offsetof(struct ice_params, shear), "-", 0, 0, "true", NULL,
     "the moving liquid has a viscous stress; without, drag is all that viscosity does, as in Darcy's law"},
    {"memory", PARAM_NUMBER, offsetof(struct ice_params, memory), "-", 0, 1, "0.99", NULL,
     "share of what a face velocity had beyond the mean of its cells that is kept for the next step"},
    {"smagorinsky", PARAM_NUMBER, offsetof(struct ice_params, smagorinsky), "-", 0, 1, "0", NULL,
     "C of the eddies that the grid does not show: they add density (C h)^2 |S| to the viscosity; with advection"},
    {"defect_share", PARAM_NUMBER, offsetof(struct ice_params, defect_share), "-", 0, 1, "1", NULL,
     "share of the volume defect that a step makes good"},
    {"defect_tolerance", PARAM_NUMBER, offsetof(struct ice_params, defect_tolerance), "-", 0, 1, "1e-9", NULL,
     "volume that the defect's solve may leave, over the volume of a cell"},
    PARAM_END};

static void destroy(void *state)
{
  struct ice *ice = state;
  linear_destroy(&ice->linear);
  memory_free(&ice->kind);
  memory_free(&ice->rim);
  memory_free(&ice->only);
  obstacles_destroy(ice);
  plic_destroy(&ice->plic);
  memory_free(&ice->one);
  ice_heat_destroy(&ice->heat);
  memory_free(&ice->fill);
}

/* J: what compression of a cell's fluid k has stored, to the second order from the reference pressure; one liquid
 * counts from zero pressure and fills the cell */
static double compression(const struct sim *sim, const struct ice *ice, int k, long c)
{
  const struct fluid *fluid = scene_fluid(sim->scene, k);
  double              kappa, rho, P_ref = 0, P = ice->P_cc[c];
  fluid->eos->compressibility(fluid->eos_params, 1, &P, ice_temperature(ice, c), &kappa);
  if (!ice->several) return 0.5 * kappa * P * P * ice->porosity_cc[c] * ice->open_cc[c] * grid_cell_volume(&sim->grid);
  fluid->eos->density(fluid->eos_params, 1, &P, NULL, &rho);
  fluid->eos->pressure(fluid->eos_params, 1, &fluid->density, NULL, &P_ref);
  return 0.5 * kappa * (P - P_ref) * (P - P_ref) * ice->mass_cc[k * sim->grid.size + c] / rho;
}

static void measure_fluid(const struct sim *sim, const struct ice *ice, int k, struct ledger *l)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             gravity[3];
  sim_gravity(sim, sim->t, gravity);
  ice_measure_fill(sim, ice);
  FOR_BOX_SERIAL(g, cells, c)
  {
    double x[3], m = ice->mass_cc[k * g->size + c];
    if (m == 0) continue;
    ice_liquid_centre(sim, ice, c, x);
    l->v[k == 0 ? LEDGER_mass_fluid : LEDGER_mass_others] += m;
    if (!ice->params->shocks) l->v[LEDGER_compression] += compression(sim, ice, k, c);
    for (int d = 0; d < g->dim; d++) {
      double v = ice->vel_cc[c * g->dim + d];
      l->v[LEDGER_momentum_x + d] += m * v;
      l->v[LEDGER_kinetic_fluid] += 0.5 * m * v * v;
      l->v[LEDGER_potential] -= m * gravity[d] * x[d];
    }
  }
}

static void measure(const struct sim *sim, struct ledger *l)
{
  const struct ice *ice = ice_of(sim);
  for (int k = 0; k < ice->n_fluids; k++) measure_fluid(sim, ice, k, l);
  if (ice->params->shocks) shock_measure(sim, l);
  for (int d = 0; d < sim->grid.dim; d++) l->v[LEDGER_shear_x + d] += ice->now.shear[d];
  if (ice->T_cc) ice_heat_measure(sim, l);
  l->v[LEDGER_mass_fluid_out] += ice->now.mass_out;
  l->v[LEDGER_mass_others_out] += ice->now.others_out;
  l->v[LEDGER_volume_defect_rms] = ice->now.defect_rms;
  l->v[LEDGER_volume_defect_max] = ice->now.defect_max;
}

const struct module module_ice = {
    .name = "ice",
    .is_fluid_path = true,
    .several_fluids = true,
    .meets_at = AT_FACE,
    .params = params,
    .params_size = sizeof(struct ice_params),
    .fields = fields,
    .n_fields = sizeof fields / sizeof *fields,
    .stages = stages,
    .n_stages = sizeof stages / sizeof *stages,
    .state_size = sizeof(struct ice),
    .create = ice_create,
    .destroy = destroy,
    .numbers_offset = offsetof(struct ice, now),
    .n_numbers = sizeof(struct ice_numbers) / sizeof(double),
    .measure = measure,
};
