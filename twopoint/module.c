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
    PARAM_END,
};

static const struct field fields[] = {
#define FIELD(...) FIELD_ROW(struct twopoint, __VA_ARGS__)
#include "twopoint/fields.def"
#undef FIELD
};

static bool skeleton(const struct scene *sc) { return sc->n_solids > 0; }
static bool bare(const struct scene *sc) { return sc->n_solids == 0; }
static bool moving(const struct scene *sc) { return mpm_solid_moves(sc); }
static bool held(const struct scene *sc) { return skeleton(sc) && !mpm_solid_moves(sc); }
static bool still(const struct scene *sc) { return !mpm_solid_moves(sc); }
static bool affine(const struct scene *sc) { return mpm_transfer_affine(sc); }
static bool plain(const struct scene *sc) { return !mpm_transfer_affine(sc); }

#define TO_NODES "x_w vel_w mass_w volume_w P_w water_fill_nc"
#define AT_NODES "push_w water_mass_nc water_mom_nc water_force_nc water_vel_nc"
#define RATE "x_w J_w P_w porosity_w volume_w water_vel_new_nc"
#define NEW_STATE "flux_nc gradq_w dlnJ_w weight_nc average_nc J_w P_w gradP_w"

static const struct stage stages[] = {
    {"twopoint.sort_points", SLOT_sort, "x_w", "x_w", "twopoint 3", "always", NULL, twopoint_sort_points, NULL},
    {"twopoint.find_porosity", SLOT_fluid_to_nodes, "x_w mass_w J_w porosity_w solid_nc bulk_nc room_nc water_room_nc",
     "skeleton_porosity_nc volume_w water_volume_nc porosity_nc water_fill_nc", "twopoint 2", "only with a skeleton",
     skeleton, twopoint_find_porosity, NULL},
    {"twopoint.find_volumes", SLOT_fluid_to_nodes, "x_w mass_w J_w porosity_w water_room_nc",
     "volume_w water_volume_nc water_fill_nc", "twopoint 2", "only without a skeleton", bare, twopoint_find_porosity,
     NULL},
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
    {"twopoint.update_pressure", SLOT_fluid_points, RATE " skeleton_porosity_nc porosity_nc vel_new_nc",
     NEW_STATE " porosity_w", "twopoint 6", "only when a solid moves", moving, twopoint_update_pressure, NULL},
    {"twopoint.update_pressure_held", SLOT_fluid_points, RATE " skeleton_porosity_nc porosity_nc",
     NEW_STATE " porosity_w", "twopoint 6", "only when the skeleton is held", held, twopoint_update_pressure, NULL},
    {"twopoint.update_pressure_bare", SLOT_fluid_points, RATE, NEW_STATE, "twopoint 6", "only without a skeleton", bare,
     twopoint_update_pressure, NULL},
    {"twopoint.nodes_to_points", SLOT_fluid_points, "water_vel_nc water_vel_new_nc x_w vel_w", "x_w vel_w",
     "twopoint 3", "always", NULL, twopoint_nodes_to_points, twopoint_dt_limit},
};

static enum status count(const struct scene *scene, long n[], int groups[])
{
  TRY(twopoint_check(scene));
  n[SET_WATER] = mpm_fill_shape(scene, &scene->fluid.region, NULL);
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
