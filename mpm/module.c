/* The solid as material points: its stages, when each is needed, its fields. Read this first. */
#include "mpm/absorb.h"
#include "mpm/create.h"
#include "mpm/heat.h"
#include "mpm/rub.h"
#include "mpm/settle.h"
#include "mpm/sides.h"
#include "mpm/stages.h"
#include "mpm/walls.h"

#include "constitutive/constitutive.h"
#include "core/memory.h"

bool mpm_solid_moves(const struct scene *scene)
{
  for (int s = 0; s < scene->n_solids; s++)
    if (!scene->materials[scene->solids[s].material].model->held) return true;
  return false;
}

bool mpm_transfer_affine(const struct scene *scene)
{
  return scene->numerics.transfer == TRANSFER_APIC || scene->numerics.transfer == TRANSFER_AFLIP;
}

static const struct param params[] = {
    {"damping", PARAM_NUMBER, offsetof(struct mpm_params, damping), "-", 0, 0.99, "0", NULL,
     "local damping: share of the force on a node that acts against its motion"},
    {"smoothing", PARAM_NUMBER, offsetof(struct mpm_params, smoothing), "-", 0, 1, "0", NULL,
     "hybrid strain smoothing: share of the smoothed velocity gradient in what strains the points; 0: none"},
    {"stray", PARAM_CHOICE, offsetof(struct mpm_params, stray), "-", 0, 0, "stop", STRAY_WORDS,
     "points that leave the grid: the run stops, they are put back inside, or they are deleted"},
    {"max_expansion", PARAM_NUMBER, offsetof(struct mpm_params, max_expansion), "-", 0, INFINITY, "infinite", NULL,
     "a point whose volume grew by more than this share carries no stress until it is compressed again"},
    PARAM_END,
};

static bool needed(const struct scene *sc)
{
  return mpm_solid_moves(sc) || (sc->n_solids > 0 && sc->fluid.present) || heat_flows(sc);
}
static bool moves_affine(const struct scene *sc) { return mpm_solid_moves(sc) && mpm_transfer_affine(sc); }
static bool moves_plain(const struct scene *sc) { return mpm_solid_moves(sc) && !mpm_transfer_affine(sc); }
static bool loaded(const struct scene *sc) { return mpm_solid_moves(sc) && sc->n_loads > 0; }
static bool marked(const struct scene *sc) { return mpm_solid_moves(sc) && sc->n_loads + sc->n_tracers > 0; }
static bool touching(const struct scene *sc) { return mpm_solid_moves(sc) && sc->n_bodies > 1; }
static bool watched(const struct scene *sc) { return mpm_solid_moves(sc) && sides_watched(sc); }
static bool rubbed(const struct scene *sc) { return mpm_solid_moves(sc) && rub_present(sc); }
static bool walled(const struct scene *sc) { return mpm_solid_moves(sc) && walls_present(sc); }
static bool pushed(const struct scene *sc) { return touching(sc) && sc->fluid.present; }
static bool damped(const struct scene *sc) { return mpm_solid_moves(sc) && mpm_params(sc)->damping > 0; }
static bool absorbing(const struct scene *sc) { return mpm_solid_moves(sc) && absorb_present(sc); }
static bool smooth(const struct scene *sc) { return mpm_solid_moves(sc) && mpm_params(sc)->smoothing > 0; }
static bool smooth_usl(const struct scene *sc) { return smooth(sc) && sc->numerics.stress_timing == STRESS_LAST; }
static bool smooth_musl(const struct scene *sc) { return smooth(sc) && sc->numerics.stress_timing == STRESS_MUSL; }
static bool working(const struct scene *sc) { return mpm_solid_moves(sc) && sc->n_history > 0 && heat_solved(sc); }
static bool touching_cold(const struct scene *sc) { return touching(sc) && !heat_solved(sc); }
static bool rubbing(const struct scene *sc) { return touching(sc) && heat_solved(sc); }
static bool quiet(const struct scene *sc) { return heat_flows(sc) && !rubbing(sc); }
static bool fluxed(const struct scene *sc) { return heat_flows(sc) && heat_has_side(sc, HEAT_FLUX); }
static bool unfluxed(const struct scene *sc) { return heat_flows(sc) && !heat_has_side(sc, HEAT_FLUX); }
static bool parting(const struct scene *sc) { return mpm_solid_moves(sc) && mpm_params(sc)->max_expansion < INFINITY; }
static bool musl(const struct scene *sc) { return mpm_solid_moves(sc) && sc->numerics.stress_timing == STRESS_MUSL; }

/* some law knows nothing but F, or contact or parting looks at it */
static bool deformed(const struct scene *sc)
{
  for (int s = 0; s < sc->n_solids; s++)
    if (scene_material(sc, s)->model->total) return true;
  return touching(sc) || parting(sc);
}
/* nothing comes between motion and stress, and nobody else looks at the velocity gradient */
static bool at_once(const struct scene *sc)
{
  return mpm_solid_moves(sc) && !musl(sc) && !smooth(sc) && !deformed(sc) && !working(sc);
}
static bool moved_first(const struct scene *sc) { return mpm_solid_moves(sc) && !at_once(sc); }
static bool at_once_plain(const struct scene *sc) { return at_once(sc) && sc->n_history == 0; }
static bool at_once_historic(const struct scene *sc) { return at_once(sc) && sc->n_history > 0; }
static bool plain_law(const struct scene *sc) { return moved_first(sc) && sc->n_history == 0; }
static bool historic(const struct scene *sc) { return moved_first(sc) && sc->n_history > 0 && !working(sc); }
static bool deformed_later(const struct scene *sc) { return moved_first(sc) && deformed(sc); }

static const struct field fields[] = {
#define FIELD(...) FIELD_ROW(struct mpm, __VA_ARGS__)
#include "mpm/fields.def"
#undef FIELD
};

#define POINT_STATE "x_p vel_p mass_p volume_p stress_p"
#define MOTION "vel_nc vel_new_nc x_p vel_p mass_p"
#define STRAIN "gradv_p F_p? stress_p volume_p vel_p"
#define SMOOTHED "x_p volume_p vel_new_nc", "share_nc rate_nc rate_p share_cc gradv_cc smooth_p"

static const struct stage stages[] = {
    {"mpm.sort_points", SLOT_sort, "x_p", "x_p", "3.1", "only when a solid moves", mpm_solid_moves, mpm_sort_points,
     NULL},
    {"mpm.clear_heat_source", SLOT_clear, "", "heat_source_nc", "3.8", "only with heat, when bodies are in contact",
     rubbing, mpm_clear_heat_source, NULL},
    {"mpm.points_to_nodes", SLOT_points_to_nodes, POINT_STATE " affine_p", "mass_nc mom_nc force_nc", "3.1",
     "only when a solid moves, APIC or AFLIP", moves_affine, mpm_points_to_nodes, NULL},
    {"mpm.points_to_nodes_plain", SLOT_points_to_nodes, POINT_STATE, "mass_nc mom_nc force_nc", "3.1",
     "only when a solid moves, PIC or FLIP", moves_plain, mpm_points_to_nodes, NULL},
    {"mpm.heat_to_nodes", SLOT_points_to_nodes, "x_p mass_p temperature_p", "capacity_nc temperature_nc", "3.8",
     "only when a material has a heat capacity and heat flows, no side with a flux", unfluxed, mpm_heat_to_nodes, NULL},
    {"mpm.fill_sides", SLOT_points_to_nodes, "x_p volume_p", "filled_nc conductance_nc", "3.8",
     "only when a side has a heat flux", fluxed, mpm_fill_sides, NULL},
    {"mpm.heat_to_nodes_with_flux", SLOT_points_to_nodes, "x_p mass_p temperature_p filled_nc conductance_nc",
     "capacity_nc slope_nc temperature_nc", "3.8", "only when a side has a heat flux", fluxed, mpm_heat_to_nodes, NULL},
    {"mpm.fold_nodes", SLOT_fold, "mass_nc mom_nc force_nc", "mass_nc mom_nc force_nc vel_nc", "3.2",
     "only when a solid moves", mpm_solid_moves, mpm_fold_nodes, NULL},
    {"mpm.load_surfaces", SLOT_fold, "x_m mass_nc", "force_nc", "3.3", "only when the scene has loads", loaded,
     mpm_load_surfaces, NULL},
    {"mpm.hold_sides", SLOT_fold, "reaction_nc mass_nc", "force_nc", "3.9", "only when a side absorbs", absorbing,
     mpm_hold_sides, NULL},
    {"mpm.press_sides", SLOT_fold, "x_p volume_p stress_p", NULL, "3.12", "only when a side rubs in a fluid", rubbed,
     mpm_press_sides, NULL},
    {"mpm.join_bodies", SLOT_fold, "mass_nc mom_nc force_nc", "mass_nc mom_nc force_nc vel_nc", "3.4",
     "only when bodies are in contact", touching, mpm_join_bodies, NULL},
    {"mpm.share_push", SLOT_nodes, "mass_nc force_nc", "force_nc", "3.4", "only when bodies are in contact in a fluid",
     pushed, mpm_share_push, NULL},
    {"mpm.damp_nodes", SLOT_nodes, "mass_nc force_nc vel_nc", "force_nc", "3.5",
     "only when numerics.mpm.damping is above 0", damped, mpm_damp_nodes, NULL},
    {"mpm.absorb_waves", SLOT_nodes, "reaction_nc mass_nc force_nc vel_nc", "force_nc", "3.9",
     "only when a side absorbs", absorbing, mpm_absorb_waves, NULL},
    {"mpm.advance_nodes", SLOT_nodes, "mass_nc force_nc vel_nc", "vel_new_nc", "3.1", "only when a solid moves",
     mpm_solid_moves, mpm_advance_nodes, NULL},
    {"mpm.watch_sides", SLOT_nodes, "mass_nc mom_nc force_nc vel_nc vel_new_nc", NULL, "3.2",
     "only when a side moves or has a gauge", watched, mpm_watch_sides, NULL},
    {"mpm.rub_sides", SLOT_nodes, "mass_nc vel_nc vel_new_nc", "vel_new_nc", "3.12", "only when a side rubs in a fluid",
     rubbed, mpm_rub_sides, NULL},
    {"mpm.resolve_contact", SLOT_nodes, "x_p volume_p F_p mass_nc vel_nc vel_new_nc", "vel_new_nc", "3.4",
     "only when bodies are in contact, no heat", touching_cold, mpm_resolve_contact, NULL},
    {"mpm.resolve_contact_and_warm", SLOT_nodes, "x_p volume_p F_p mass_nc vel_nc vel_new_nc heat_source_nc",
     "vel_new_nc heat_source_nc", "3.4", "only when bodies are in contact, with heat", rubbing, mpm_resolve_contact,
     NULL},
    {"mpm.meet_walls", SLOT_nodes, "x_p volume_p skin_p mass_nc vel_nc vel_new_nc", "vel_new_nc", "3.11",
     "only when the scene has obstacles or a side has friction", walled, mpm_meet_walls, mpm_walls_dt},
    {"mpm.join_velocities", SLOT_nodes, "mass_nc vel_new_nc", "vel_new_nc", "3.4", "only when bodies are in contact",
     touching, mpm_join_velocities, NULL},
    {"mpm.smooth_strain", SLOT_nodes, SMOOTHED, "3.6", "only with numerics.mpm.smoothing, usl", smooth_usl,
     mpm_smooth_strain, NULL},
    {"mpm.conduct_heat", SLOT_nodes, "x_p mass_p temperature_p temperature_nc", "unseen_p heat_flow_p heat_nc", "3.8",
     "only when a material has a heat capacity and heat flows", heat_flows, mpm_conduct_heat, mpm_heat_dt},
    {"mpm.heat_sides", SLOT_nodes, "filled_nc heat_nc", "heat_nc", "3.8", "only when a side has a heat flux", fluxed,
     mpm_heat_sides, NULL},
    {"mpm.warm_nodes", SLOT_nodes, "heat_nc capacity_nc", "heat_nc warming_nc", "3.8",
     "only when heat flows, no bodies in contact", quiet, mpm_warm_nodes, NULL},
    {"mpm.warm_nodes_with_sources", SLOT_nodes, "heat_nc heat_source_nc capacity_nc", "heat_nc warming_nc", "3.8",
     "only with heat, when bodies are in contact", rubbing, mpm_warm_nodes, NULL},
    {"mpm.heat_to_points", SLOT_nodes_to_points, "x_p mass_p unseen_p warming_nc temperature_p",
     "warming_p temperature_p", "3.8", "only when a material has a heat capacity and heat flows", heat_flows,
     mpm_heat_to_points, NULL},
    {"mpm.nodes_to_points", SLOT_nodes_to_points, MOTION, "x_p vel_p displacement_p gradv_p", "3.1",
     "only with musl, smoothing, F or work that heats", moved_first, mpm_nodes_to_points, NULL},
    {"mpm.move_and_strain", SLOT_nodes_to_points, MOTION " stress_p volume_p",
     "x_p vel_p displacement_p stress_p volume_p", "3.1", "only when nothing comes between, no law with history",
     at_once_plain, mpm_move_and_strain, mpm_stress_dt},
    {"mpm.move_and_strain_with_history", SLOT_nodes_to_points, MOTION " stress_p volume_p history_p",
     "x_p vel_p displacement_p stress_p volume_p history_p", "3.1",
     "only when nothing comes between, and a law has a history", at_once_historic, mpm_move_and_strain, mpm_stress_dt},
    {"mpm.move_markers", SLOT_nodes_to_points, "x_m x0_m mass_nc vel_new_nc", "x_m", "3.3",
     "only with loads or tracers", marked, mpm_move_markers, NULL},
    {"mpm.expel_points", SLOT_nodes_to_points, "x_p vel_p mass_p", "x_p vel_p", "3.11",
     "only when the scene has obstacles or a side has friction", walled, mpm_expel_points, NULL},
    {"mpm.remap_momentum", SLOT_remap, "x_p vel_p mass_p", "x_p mass_nc mom_nc vel_new_nc gradv_p", "3.1",
     "only when numerics.stress_timing is musl", musl, mpm_remap_momentum, NULL},
    {"mpm.smooth_strain_again", SLOT_remap, SMOOTHED, "3.6", "only with numerics.mpm.smoothing, musl", smooth_musl,
     mpm_smooth_strain_again, NULL},
    {"mpm.take_smoothed", SLOT_remap, "gradv_p smooth_p", "gradv_p", "3.6", "only with numerics.mpm.smoothing", smooth,
     mpm_take_smoothed, NULL},
    {"mpm.deform_points", SLOT_stress, "gradv_p F_p", "F_p", "1.3", "only when a law, contact or parting looks at F",
     deformed_later, mpm_deform_points, NULL},
    {"mpm.update_stress", SLOT_stress, STRAIN, "stress_p volume_p", "1.3", "only after mpm.nodes_to_points", plain_law,
     mpm_update_stress, mpm_stress_dt},
    {"mpm.update_stress_and_history", SLOT_stress, STRAIN " history_p", "stress_p volume_p history_p", "1.3",
     "only after mpm.nodes_to_points, when a law has a history, no heat", historic, mpm_update_stress, mpm_stress_dt},
    {"mpm.update_stress_and_heat", SLOT_stress, STRAIN " history_p", "stress_p volume_p history_p heat_p", "1.3",
     "only when a law of the scene has a history, with heat", working, mpm_update_stress, mpm_stress_dt},
    {"mpm.part_points", SLOT_stress, "gradv_p F_p stress_p volume_p parted_p", "F_p stress_p parted_p", "3.10",
     "only when numerics.mpm.max_expansion is finite", parting, mpm_part_points, NULL},
    {"mpm.heat_by_work", SLOT_stress, "heat_p mass_p volume_p temperature_p", "temperature_p", "3.8",
     "only when a law of the scene has a history, with heat", working, mpm_heat_by_work, NULL},
};

static enum status count(const struct scene *scene, long n[], int groups[])
{
  n[SET_SOLID] = mpm_place_points(scene, NULL, NULL);
  n[COUNT_MARKERS] = mpm_count_markers(scene);
  groups[SET_SOLID] = scene->n_solids;
  return OK;
}

static enum status create(struct sim *sim, void *state)
{
  struct mpm *m = state;
  m->points = sim->points[SET_SOLID];
  m->kernels = kernels_find(sim->grid.dim, sim->scene->numerics.basis);
  m->moves = mpm_solid_moves(sim->scene);
  sides_of_solid(sim->scene, m->sides);
  kernel_grid_create(&sim->grid, &sim->scene->numerics, m->sides, &m->kernel_grid);
  TRY(mpm_create_bodies(sim, m));
  if (watched(sim->scene)) TRY(sides_create(sim, m));
  struct box all = grid_all(&sim->grid);
  TRY(NEW(&m->run_seen, N_SEEN * m->points->n_runs));
  TRY(NEW(&m->row_work, box_rows(&all)));
  TRY(NEW(&m->run_parted, 2 * m->points->n_runs));
  TRY(mpm_create_points(sim, m));
  TRY(mpm_start_stress(sim, m));
  TRY(mpm_create_markers(sim, m));
  TRY(mpm_create_heat(sim, m));
  TRY(mpm_sort_now(sim, m));
  if (walled(sim->scene)) TRY(walls_create(sim, m));
  if (rubbed(sim->scene)) TRY(rub_create(sim, m));
  m->mass_floor = INFINITY;
  for (long p = 0; p < m->points->n && m->mass_p; p++) m->mass_floor = fmin(m->mass_floor, 1e-12 * m->mass_p[p]);
  if (!m->moves) return OK;
  TRY(mpm_first_speeds(sim, m));
  TRY(absorb_create(sim, m));
  TRY(mpm_settle(sim, m));
  return mpm_first_speeds(sim, m);
}

static void destroy(void *state)
{
  struct mpm *m = state;
  memory_free(&m->run_seen);
  memory_free(&m->row_work);
  memory_free(&m->run_parted);
  memory_free(&m->run_heat);
  memory_free(&m->marker_end);
  memory_free(&m->marker_area);
  memory_free(&m->marker_normal);
  memory_free(&m->marker_body);
  mpm_destroy_bodies(m);
  sides_destroy(m);
  rub_destroy(m);
  walls_destroy(m);
  absorb_destroy(m);
}

/* momentum, angular momentum (affine part counted) and kinetic energy of point p */
static void measure_motion(const struct sim *sim, const struct mpm *m, long p, struct ledger *l)
{
  int           dim = sim->grid.dim;
  double        mass = m->mass_p[p], D = m->kernels->moment * sim->grid.h * sim->grid.h, square = 0;
  const double *v = m->vel_p + p * dim, *x = m->x_p + p * dim;
  for (int d = 0; d < dim; d++) {
    l->v[LEDGER_momentum_x + d] += mass * v[d];
    square += v[d] * v[d];
  }
  l->v[LEDGER_angular_z] += mass * (x[0] * v[1] - x[1] * v[0]);
  if (m->affine_p) {
    const double *C = m->affine_p + p * dim * dim;
    l->v[LEDGER_angular_z] += mass * D * (C[dim] - C[1]);
    for (int q = 0; q < dim * dim; q++) square += D * C[q] * C[q];
  }
  l->v[LEDGER_kinetic_solid] += 0.5 * mass * square;
}

void mpm_measure_point(const struct sim *sim, const struct mpm *m, const double gravity[3], long p, struct ledger *l)
{
  const struct material *material = scene_material(sim->scene, m->points->group[p]);
  int                    dim = sim->grid.dim;
  l->v[LEDGER_mass_solid] += m->mass_p[p];
  if (m->temperature_p) l->v[LEDGER_heat] += m->mass_p[p] * material->heat_capacity * m->temperature_p[p];
  for (int d = 0; d < dim; d++) l->v[LEDGER_potential] -= m->mass_p[p] * gravity[d] * m->x_p[p * dim + d];
  if (material->model->held) return;
  double F[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, energy = 0;
  for (int q = 0; q < dim * dim && m->F_p; q++) F[q / dim * 3 + q % dim] = m->F_p[p * dim * dim + q];
  material->model->energy(material->model_params, 1, F, m->stress_p + 6 * p,
                          m->history_p ? m->history_p + sim->scene->n_history * p : NULL, &energy);
  if (!m->parted_p || m->parted_p[p] == 0) l->v[LEDGER_elastic] += energy * m->volume_p[p];
  measure_motion(sim, m, p, l);
}

/* Velocities live half a step before positions and stresses (kick, then drift). Energies are all counted at the time of
 * the velocities: from elastic and potential energy half a step of their rate is taken back, else the sum would swing
 * by omega dt/2. */
static double half_step_work(const struct sim *sim, const struct mpm *m, const double gravity[3])
{
  int    dim = sim->grid.dim;
  double power = m->now.power;
  if (sim->step == 0) return 0;
  for (long p = 0; p < m->points->n && m->moves; p++)
    for (int d = 0; d < dim && !scene_material(sim->scene, m->points->group[p])->model->held; d++)
      power -= m->mass_p[p] * gravity[d] * m->vel_p[p * dim + d];
  return 0.5 * sim->dt * power;
}

static void measure(const struct sim *sim, struct ledger *l)
{
  const struct mpm *m = mpm_of(sim);
  double            gravity[3];
  sim_gravity(sim, sim->t, gravity);
  for (long p = 0; p < m->points->n && m->mass_p; p++) mpm_measure_point(sim, m, gravity, p, l);
  l->v[LEDGER_elastic] -= half_step_work(sim, m, gravity);
  l->v[LEDGER_work_loads] += m->now.work_loads;
  l->v[LEDGER_work_walls] += m->now.work_walls;
  l->v[LEDGER_plastic] += m->now.plastic;
  l->v[LEDGER_friction] += m->now.friction;
  l->v[LEDGER_elastic] += m->now.contact;
  l->v[LEDGER_damping] += m->now.damping;
  l->v[LEDGER_heat_sides] += m->now.heat_sides;
  l->v[LEDGER_absorbed] += m->now.absorbed;
  l->v[LEDGER_mass_solid_out] += m->now.strays.mass_out;
  l->v[LEDGER_mass_solid_lost] += m->now.strays.mass_lost;
  for (int d = 0; d < 3; d++) l->v[LEDGER_momentum_out_x + d] += m->now.strays.momentum[d];
  l->v[LEDGER_energy_out] += m->now.strays.energy;
}

const struct module module_mpm = {
    .name = "mpm",
    .needed = needed,
    .params = params,
    .params_size = sizeof(struct mpm_params),
    .fields = fields,
    .n_fields = sizeof fields / sizeof *fields,
    .stages = stages,
    .n_stages = sizeof stages / sizeof *stages,
    .state_size = sizeof(struct mpm),
    .count = count,
    .create = create,
    .destroy = destroy,
    .numbers_offset = offsetof(struct mpm, now),
    .n_numbers = sizeof(struct mpm_numbers) / sizeof(double),
    .measure = measure,
};
