/* The water as a second set of points: its stages, when each is needed, its fields and parameters. Read this first. */
#include "twopoint/twopoint.h"

#include "mpm/mpm.h"

static const struct param params[] = {
    {"averaging_interval", PARAM_INTEGER, offsetof(struct twopoint_params, averaging_interval), "-", 0, 1e6, "10", NULL,
     "steps between two averages of the pressure that are fed back into the state; 0: never"},
    {"average_increment", PARAM_FLAG, offsetof(struct twopoint_params, average_increment), "-", 0, 1, "true", NULL,
     "whether the increment of volume is averaged in every step"},
    {"tension", PARAM_FLAG, offsetof(struct twopoint_params, tension), "-", 0, 1, "false", NULL,
     "whether water pulls even where it does not fill the space around it"},
    {"max_expansion", PARAM_NUMBER, offsetof(struct twopoint_params, max_expansion), "-", 0, 1, "1e-3", NULL,
     "largest relative expansion of a water point beyond its volume without pressure"},
    {"shifting", PARAM_NUMBER, offsetof(struct twopoint_params, shifting), "-", 0, 0.4, "0.1", NULL,
     "how fast points leave nodes that hold more than their room: diffusion in h2 per step; 0: they stay"},
    {"shear", PARAM_FLAG, offsetof(struct twopoint_params, shear), "-", 0, 1, "true", NULL,
     "whether the viscosity of the water resists shear, not only in drag"},
    {"surface_fill", PARAM_NUMBER, offsetof(struct twopoint_params, surface_fill), "-", 0, 0.9, "0", NULL,
     "nodes with less of their room filled are at a free surface: averages of the pressure are 0 there; 0: none are"},
    {"as_printed", PARAM_FLAG, offsetof(struct twopoint_params, as_printed), "-", 0, 1, "false", NULL,
     "the forms of the two-point paper, for comparison: they do not work where soil and free water meet"},
    {"jitter", PARAM_NUMBER, offsetof(struct twopoint_params, jitter), "-", 0, 0.5, "0", NULL,
     "largest random displacement of a water point at the start along each axis, over the spacing; see seed"},
    PARAM_END,
};

static const struct field fields[] = {
#define FIELD(...) FIELD_ROW(struct twopoint, __VA_ARGS__)
#include "twopoint/fields.def"
#undef FIELD
};

static const struct twopoint_params *params_of(const struct scene *sc)
{
  return scene_module_params(sc, &module_twopoint);
}

static bool skeleton(const struct scene *sc) { return sc->n_solids > 0; }
static bool bare(const struct scene *sc) { return sc->n_solids == 0; }
static bool moving(const struct scene *sc) { return mpm_solid_moves(sc); }
static bool held(const struct scene *sc) { return skeleton(sc) && !mpm_solid_moves(sc); }
static bool still(const struct scene *sc) { return !mpm_solid_moves(sc); }
static bool affine(const struct scene *sc) { return mpm_transfer_affine(sc); }
static bool plain(const struct scene *sc) { return !mpm_transfer_affine(sc); }
static bool shear(const struct scene *sc) { return params_of(sc)->shear && sc->fluid.viscosity > 0; }
static bool printed(const struct scene *sc) { return params_of(sc)->as_printed; }
static bool filled(const struct scene *sc) { return skeleton(sc) && !printed(sc); }
static bool printed_skeleton(const struct scene *sc) { return skeleton(sc) && printed(sc); }
static bool printed_moving(const struct scene *sc) { return moving(sc) && printed(sc); }
static bool printed_held(const struct scene *sc) { return held(sc) && printed(sc); }
/* the increment of volume comes with the water's own velocity gradient */
static bool own(const struct scene *sc) { return bare(sc) || printed(sc); }
static bool flux_alone(const struct scene *sc) { return !own(sc) && !shear(sc); }
static bool flux_shear(const struct scene *sc) { return !own(sc) && shear(sc); }
static bool own_alone(const struct scene *sc) { return own(sc) && !shear(sc); }
static bool own_shear(const struct scene *sc) { return own(sc) && shear(sc); }
static bool increment(const struct scene *sc) { return params_of(sc)->average_increment && !printed(sc); }
static bool no_increment(const struct scene *sc) { return !increment(sc); }
static bool increment_alone(const struct scene *sc) { return no_increment(sc) && !printed(sc); }
static bool averaging(const struct scene *sc) { return params_of(sc)->averaging_interval > 0 && !printed(sc); }
static bool surface(const struct scene *sc) { return params_of(sc)->surface_fill > 0; }
static bool increment_still(const struct scene *sc) { return increment(sc) && !(params_of(sc)->shifting > 0); }
static bool increment_shift(const struct scene *sc) { return increment(sc) && params_of(sc)->shifting > 0; }
static bool shift_alone(const struct scene *sc) { return !increment(sc) && params_of(sc)->shifting > 0; }

#define TO_NODES "x_w vel_w mass_w volume_w P_w averaged_w? shear_w? water_fill_nc"
#define AT_NODES "push_w water_mass_nc water_mom_nc water_force_nc water_vel_nc"
#define MOVE "water_vel_nc water_vel_new_nc x_w vel_w"
#define STATE_OF "dlnJ_w J_w mass_w porosity_w"

static const struct stage stages[] = {
    {"twopoint.sort_points", SLOT_sort, "x_w", "x_w", "twopoint 3", "always", NULL, twopoint_sort_points, NULL},
    {"twopoint.find_porosity", SLOT_fluid_to_nodes,
     "solid_nc bulk_nc room_nc water_room_nc water_volume_nc water_pores_nc",
     "skeleton_porosity_nc porosity_nc water_fill_nc", "twopoint 2", "only with a skeleton", filled,
     twopoint_find_porosity, NULL},
    {"twopoint.find_porosity_printed", SLOT_fluid_to_nodes,
     "x_p volume_p volume_solid_p solid_nc water_room_nc water_volume_nc water_pores_nc",
     "medium_porosity_p skeleton_porosity_nc porosity_nc water_fill_nc", "twopoint 14", "only as printed",
     printed_skeleton, twopoint_find_porosity_printed, NULL},
    {"twopoint.find_fill", SLOT_fluid_to_nodes, "water_room_nc water_volume_nc", "water_fill_nc", "twopoint 2",
     "only without a skeleton", bare, twopoint_find_fill, NULL},
    {"twopoint.points_to_nodes", SLOT_fluid_to_nodes, TO_NODES " affine_w", AT_NODES, "twopoint 3",
     "only with APIC or AFLIP", affine, twopoint_points_to_nodes, NULL},
    {"twopoint.points_to_nodes_plain", SLOT_fluid_to_nodes, TO_NODES, AT_NODES, "twopoint 3", "only with PIC or FLIP",
     plain, twopoint_points_to_nodes, NULL},
    {"twopoint.predict_nodes", SLOT_predict,
     "water_mass_nc water_force_nc water_vel_nc porosity_nc mass_nc force_nc vel_nc", "water_star_nc solid_star_nc",
     "twopoint 4", "only when a solid moves", moving, twopoint_predict_nodes, NULL},
    {"twopoint.predict_water", SLOT_predict, "water_mass_nc water_force_nc water_vel_nc", "water_star_nc", "twopoint 4",
     "only when no solid moves", still, twopoint_predict_nodes, NULL},
    {"twopoint.resist_nodes", SLOT_drag,
     "water_star_nc solid_star_nc water_mass_nc water_volume_nc porosity_nc solid_nc bulk_nc mass_nc", "drag_nc",
     "twopoint 5", "only when a solid moves", moving, twopoint_resist_nodes, NULL},
    {"twopoint.resist_water", SLOT_drag, "water_star_nc water_mass_nc water_volume_nc porosity_nc solid_nc bulk_nc",
     "drag_nc", "twopoint 5", "only when the skeleton is held", held, twopoint_resist_nodes, NULL},
    {"twopoint.exchange_momentum", SLOT_to_solid,
     "water_star_nc solid_star_nc drag_nc water_force_nc water_mass_nc porosity_nc mass_nc", "water_vel_new_nc dmom_nc",
     "twopoint 5", "only when a solid moves", moving, twopoint_exchange_momentum, NULL},
    {"twopoint.slow_water", SLOT_to_solid, "water_star_nc drag_nc water_mass_nc", "water_vel_new_nc", "twopoint 5",
     "only when the skeleton is held", held, twopoint_exchange_momentum, NULL},
    {"twopoint.advance_water", SLOT_to_solid, "water_star_nc", "water_vel_new_nc", "twopoint 4",
     "only without a skeleton", bare, twopoint_exchange_momentum, NULL},
    {"twopoint.meet_walls", SLOT_to_solid, "x_w vel_w volume_w skin_w water_mass_nc water_vel_nc water_vel_new_nc",
     "water_vel_new_nc water_room_nc", "twopoint 13", "only with obstacles in the water", twopoint_walled,
     twopoint_meet_walls, twopoint_walls_dt},
    {"twopoint.strain_water", SLOT_fluid_points, "x_w water_vel_new_nc vel_new_nc? skeleton_porosity_nc porosity_nc",
     "flux_nc gradq_w dlnJ_w porosity_w", "twopoint 6", "only with a skeleton", filled, twopoint_strain_water, NULL},
    {"twopoint.strain_solid_printed", SLOT_fluid_points, "x_w vel_new_nc skeleton_porosity_nc",
     "gradq_w solid_dlnJ_w porosity_w", "twopoint 14", "only as printed, when a solid moves", printed_moving,
     twopoint_strain_solid_printed, NULL},
    {"twopoint.see_porosity_printed", SLOT_fluid_points, "x_w skeleton_porosity_nc", "porosity_w", "twopoint 14",
     "only as printed, when the skeleton is held", printed_held, twopoint_strain_solid_printed, NULL},
    {"twopoint.nodes_to_points", SLOT_fluid_points, MOVE, "x_w vel_w", "twopoint 3",
     "only with a skeleton, without shear", flux_alone, twopoint_nodes_to_points, twopoint_speed_limit},
    {"twopoint.move_and_shear", SLOT_fluid_points, MOVE, "x_w vel_w shear_w", "twopoint 3",
     "only with a skeleton and shear", flux_shear, twopoint_nodes_to_points, twopoint_shear_limit},
    {"twopoint.move_and_strain", SLOT_fluid_points, MOVE, "x_w vel_w dlnJ_w", "twopoint 3",
     "only without a skeleton and shear", own_alone, twopoint_nodes_to_points, twopoint_speed_limit},
    {"twopoint.move_strain_and_shear", SLOT_fluid_points, MOVE, "x_w vel_w dlnJ_w shear_w", "twopoint 3",
     "only without a skeleton, with shear", own_shear, twopoint_nodes_to_points, twopoint_shear_limit},
    {"twopoint.expel_points", SLOT_fluid_points, "x_w vel_w", "x_w vel_w", "twopoint 13",
     "only with obstacles in the water", twopoint_walled, twopoint_expel_points, NULL},
    {"twopoint.sort_moved", SLOT_fluid_points, "x_w", "x_w", "twopoint 3", "always", NULL, twopoint_sort_points, NULL},
    {"twopoint.gather_volumes", SLOT_fluid_points, "x_w volume_w porosity_w", "water_volume_nc water_pores_nc?",
     "twopoint 2", "only without averages of the increment", no_increment, twopoint_gather_water, NULL},
    {"twopoint.gather_water", SLOT_fluid_points, "x_w volume_w porosity_w dlnJ_w",
     "water_volume_nc water_pores_nc? average_nc", "twopoint 7", "only with averages of the increment", increment,
     twopoint_gather_water, NULL},
    {"twopoint.update_pressure", SLOT_fluid_points, STATE_OF, "J_w P_w volume_w", "twopoint 6",
     "only without averages of the increment", increment_alone, twopoint_update_pressure, twopoint_wave_limit},
    {"twopoint.average_and_update", SLOT_fluid_points, STATE_OF " x_w average_nc water_volume_nc",
     "dlnJ_w J_w P_w volume_w", "twopoint 7", "only with averages of the increment, without shifting", increment_still,
     twopoint_average_and_update, twopoint_wave_limit},
    {"twopoint.average_update_and_shift", SLOT_fluid_points, STATE_OF " x_w average_nc water_volume_nc water_room_nc",
     "dlnJ_w J_w P_w volume_w excess_nc slope_w x_w", "twopoint 8", "only with averages of the increment and shifting",
     increment_shift, twopoint_average_and_update, twopoint_wave_limit},
    {"twopoint.update_pressure_printed", SLOT_fluid_points, STATE_OF " x_w P_w volume_w solid_dlnJ_w?",
     "weight_nc average_nc averaged_w J_w P_w volume_w", "twopoint 14", "only as printed", printed,
     twopoint_update_pressure_printed, twopoint_wave_limit},
    {"twopoint.find_surface", SLOT_fluid_points, "water_volume_nc water_room_nc", "surface_nc", "twopoint 7",
     "only with a fill of surfaces", surface, twopoint_find_surface, NULL},
    {"twopoint.average_push_printed", SLOT_fluid_points, "x_w volume_w P_w surface_nc?",
     "weight_nc average_nc averaged_w", "twopoint 14", "only as printed", printed, twopoint_average_push_printed, NULL},
    {"twopoint.average_pressure", SLOT_fluid_points, "x_w volume_w P_w gradP_w surface_nc?",
     "weight_nc average_nc P_w gradP_w J_w volume_w", "twopoint 7", "only with an averaging interval", averaging,
     twopoint_average_pressure, NULL},
    {"twopoint.shift_points", SLOT_fluid_points, "x_w water_volume_nc water_room_nc", "excess_nc slope_w x_w",
     "twopoint 8", "only with shifting, without averages of the increment", shift_alone, twopoint_shift_points, NULL},
};

static enum status count(const struct scene *scene, long n[], int groups[])
{
  TRY(twopoint_check(scene));
  struct shape parts[1 + MAX_OBSTACLES], region = twopoint_region(scene, parts);
  n[SET_WATER] = mpm_fill_shape(scene, &region, NULL);
  groups[SET_WATER] = 1;
  if (n[SET_WATER] == 0)
    return FAIL(ERR_INPUT, "fluid.region: no water point lies inside; enlarge the region or refine grid.h");
  return OK;
}

const struct module module_twopoint = {
    .name = "twopoint",
    .is_fluid_path = true,
    .meets_at = AT_NODE,
    .params = params,
    .params_size = sizeof(struct twopoint_params),
    .fields = fields,
    .n_fields = sizeof fields / sizeof *fields,
    .stages = stages,
    .n_stages = sizeof stages / sizeof *stages,
    .state_size = sizeof(struct twopoint),
    .count = count,
    .create = twopoint_create,
    .destroy = twopoint_destroy,
    .numbers_offset = offsetof(struct twopoint, now),
    .n_numbers = sizeof(struct twopoint_numbers) / sizeof(double),
    .measure = twopoint_measure,
};
