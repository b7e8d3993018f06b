/* What may stand in a scene: the tables of the scene's own structs. Entries are read in this order. */
#include "run/scene_tables.h"

#include "constitutive/constitutive.h"
#include "core/scene.h"
#include "coupling/drag.h"
#include "eos/eos.h"
#include "references/reference.h"

#define AT(type, member) offsetof(struct type, member)
#define VALUE(name, kind, type, member, fallback, unit, meaning)                                                       \
  {                                                                                                                    \
    name, ENTRY_VALUE, &value_##kind, NULL, AT(type, member), 0, fallback, NULL, NULL, unit, meaning, false            \
  }
#define SECTION(name, table, offset, fallback, meaning)                                                                \
  {                                                                                                                    \
    name, ENTRY_SECTION, NULL, &table, offset, 0, fallback, NULL, NULL, "-", meaning, false                            \
  }
#define MAP(name, table, member, meaning)                                                                              \
  {                                                                                                                    \
    name, ENTRY_MAP, NULL, &table, AT(scene, member), AT(scene, n_##member), "{}", NULL, NULL, "-", meaning, false     \
  }
#define ENTRY_END                                                                                                      \
  {                                                                                                                    \
    .name = NULL                                                                                                       \
  }
#define ZERO_DEFAULT "0"

/* ---- registered laws ---- */

bool constitutive_row(int i, struct row *row)
{
  const struct constitutive_model *m = constitutive_models[i];
  if (m) *row = (struct row){m->name, m->source, m->params, m->param_size, m};
  return m != NULL;
}

bool eos_row(int i, struct row *row)
{
  const struct eos *e = eos_laws[i];
  if (e) *row = (struct row){e->name, e->source, e->params, e->param_size, e};
  return e != NULL;
}

bool drag_row(int i, struct row *row)
{
  const struct drag_law *d = drag_laws[i];
  if (d) *row = (struct row){d->name, d->source, d->params, d->param_size, d};
  return d != NULL;
}

bool reference_row(int i, struct row *row)
{
  const struct reference *r = references[i];
  if (r) *row = (struct row){r->name, r->source, r->params, r->param_size, r};
  return r != NULL;
}

/* ---- grid, time ---- */

static const struct param grid_params[] = {
    {"min", PARAM_VECTOR, AT(scene, min), "m", -1e9, 1e9, NULL, NULL,
     "lower corner; two or three numbers set the dimension"},
    {"max", PARAM_VECTOR, AT(scene, max), "m", -1e9, INFINITY, NULL, NULL,
     "upper corner; null: this axis is one cell wide whatever h is"},
    {"h", PARAM_NUMBER, AT(scene, h), "m", 1e-9, 1e6, NULL, NULL, "width of a cell"},
    PARAM_END};
static const struct section grid_section = {.meaning = "uniform grid that the whole scene lies in",
                                            .params = grid_params};

static const struct param time_params[] = {
    {"end", PARAM_NUMBER, AT(scene, time_end), "s", 1e-12, 1e12, NULL, NULL, "time at which the run ends"}, PARAM_END};
static const struct section time_section = {.meaning = "span of time", .params = time_params};

/* ---- materials and solids ---- */

static const struct param material_params[] = {
    {"density", PARAM_NUMBER, AT(material, density), "kg/m3", 1e-6, 1e6, NULL, NULL, "density of the grains"},
    {"porosity", PARAM_NUMBER, AT(material, porosity), "-", 0, 0.99, "0", NULL,
     "pore volume over total volume at the start"},
    {"permeability", PARAM_NUMBER, AT(material, permeability), "m/s", 0, 1e3, "0", NULL,
     "hydraulic conductivity; 0: not given"},
    {"grain_diameter", PARAM_NUMBER, AT(material, grain_diameter), "m", 0, 100, "0", NULL,
     "diameter of a grain; 0: not given"},
    {"lateral_ratio", PARAM_NUMBER, AT(material, lateral_ratio), "-", -1, 10, "-1", NULL,
     "lateral over vertical effective stress of a start at rest, such as 1 on smooth slopes; negative: the law's own"},
    {"heat_capacity", PARAM_NUMBER, AT(material, heat_capacity), "J/(kg K)", 0, 1e9, "0", NULL,
     "of the grains; where it is given, heat is solved"},
    {"conductivity", PARAM_NUMBER, AT(material, conductivity), "W/(m K)", 0, 1e9, "0", NULL,
     "of heat, in the grains; a medium has the share of its grains"},
    {"work_to_heat", PARAM_NUMBER, AT(material, work_to_heat), "-", 0, 1, "1", NULL,
     "share of plastic work that becomes heat"},
    PARAM_END};
static const struct choice model_choice = {
    "model",          NULL, "skeleton law", constitutive_row, AT(material, model), AT(material, model_params),
    "docs/theory.md", NULL};
static const struct section material_section = {
    .meaning = "material", .size = sizeof(struct material), .params = material_params, .choice = &model_choice};

static const struct param solid_params[] = {
    {"part_of", PARAM_TEXT, AT(solid, part_of), "-", 0, 0, "", NULL,
     "in a scene with contact: solids with the same word here are one body; empty: a body of its own"},
    {"velocity", PARAM_FUNCTION3, AT(solid, velocity), "m/s", 0, 0, ZERO_DEFAULT, NULL, "velocity at the start"},
    {"temperature", PARAM_FUNCTION, AT(solid, temperature), "K", 0, 0, "293.15", NULL,
     "at the start, where heat is solved"},
    PARAM_END};
static const struct param contact_params[] = {
    {"friction", PARAM_NUMBER, AT(contact, friction), "-", 0, INFINITY, "0", NULL,
     "Coulomb coefficient between bodies; \"infinite\": what touches sticks"},
    {"normal", PARAM_CHOICE, AT(contact, normal), "-", 0, 0, "weighted", "weighted|difference",
     "normal at a node: of both bodies' volume gradients weighted with their squares, or of their difference"},
    {"detection", PARAM_CHOICE, AT(contact, detection), "-", 0, 0, "reach", "reach|approach",
     "reach: bodies meet where their points overlap, and are pushed apart; approach: wherever they approach at a node "
     "they share, which stops them"},
    PARAM_END};
static const struct section contact_section = {.meaning = "contact between bodies", .params = contact_params};

static const struct entry solid_entries[] = {
    VALUE("material", material, solid, material, NULL, "-", "name of its material"),
    VALUE("shape", shape, solid, shape, NULL, "-", "region that it fills at the start"), ENTRY_END};
static const struct section solid_section = {
    .meaning = "body", .size = sizeof(struct solid), .params = solid_params, .entries = solid_entries};

/* ---- fluid ---- */

static const char *const    eos_given[] = {"reference_density", "density", "bulk_modulus", "bulk_modulus", NULL};
static const struct choice  eos_choice = {"law",          "linear_water",        "equation of state", eos_row,
                                          AT(fluid, eos), AT(fluid, eos_params), "docs/theory.md",    eos_given};
static const struct section eos_section = {.meaning = "equation of state", .choice = &eos_choice, .word = true};
static const struct choice  drag_choice = {
     "law", "darcy", "drag law", drag_row, AT(fluid, drag), AT(fluid, drag_params), "docs/theory.md", NULL};
static const struct section drag_section = {
    .meaning = "drag between the fluid and a skeleton", .choice = &drag_choice, .word = true};

static const struct param fluid_params[] = {
    {"density", PARAM_NUMBER, AT(fluid, density), "kg/m3", 1e-6, 1e6, "1000", NULL,
     "density at the reference pressure"},
    {"bulk_modulus", PARAM_NUMBER, AT(fluid, bulk_modulus), "Pa", 1e-6, INFINITY, "2.2e9", NULL,
     "bulk modulus; \"infinite\": incompressible"},
    {"viscosity", PARAM_NUMBER, AT(fluid, viscosity), "Pa s", 0, 1e6, "1e-3", NULL, "dynamic viscosity"},
    {"exchange", PARAM_NUMBER, AT(fluid, exchange), "kg/m3/s", 0, INFINITY, "infinite", NULL,
     "momentum that two fluids at one place exchange per volume and difference of velocity; \"infinite\": all fluids "
     "share "
     "one velocity"},
    {"velocity", PARAM_FUNCTION3, AT(fluid, velocity), "m/s", 0, 0, ZERO_DEFAULT, NULL, "velocity at the start"},
    {"motion", PARAM_CHOICE, AT(fluid, prescribed), "-", 0, 0, "free", "free|prescribed",
     "prescribed: the velocity, times the strength, is that of all times and carries the fluid, which has no pressure"},
    {"strength", PARAM_FUNCTION, AT(fluid, strength), "-", 0, 0, "1", NULL,
     "factor, of t, from -1 to 1, on the velocity of a prescribed motion"},
    {"pressure", PARAM_FUNCTION, AT(fluid, pressure), "Pa", 0, 0, ZERO_DEFAULT, NULL,
     "gauge pressure at the start, where the start is \"zero\""},
    {"temperature", PARAM_FUNCTION, AT(fluid, temperature), "K", 0, 0, ZERO_DEFAULT, NULL,
     "at the start; where it is given, the fluid's energy is solved"},
    {"conductivity", PARAM_NUMBER, AT(fluid, conductivity), "W/(m K)", 0, 1e9, "0", NULL,
     "of heat, where the fluid's energy is solved"},
    {"heat_exchange", PARAM_NUMBER, AT(fluid, heat_exchange), "W/(m3 K)", 0, 1e15, "1e6", NULL,
     "heat that goes over to the grains of a medium, per volume of it and difference of temperature"},
    PARAM_END};
static const struct entry fluid_entries[] = {
    VALUE("path", fluid_path, fluid, path, "null", "-", "fluid path: the method that moves the fluid"),
    SECTION("eos", eos_section, 0, "{}", "equation of state"), SECTION("drag", drag_section, 0, "{}", "drag law"),
    VALUE("region", shape, fluid, region, "everywhere", "-", "region that it fills at the start, pores included"),
    ENTRY_END};
static const struct choice  gas_choice = {"law",          "ideal_gas",           "equation of state", eos_row,
                                          AT(fluid, eos), AT(fluid, eos_params), "docs/theory.md",    eos_given};
static const struct section gas_section = {.meaning = "equation of state", .choice = &gas_choice, .word = true};
static const struct param   other_params[] = {
      {"density", PARAM_NUMBER, AT(fluid, density), "kg/m3", 1e-6, 1e6, "1.1766", NULL,
       "density at the reference pressure"},
      {"bulk_modulus", PARAM_NUMBER, AT(fluid, bulk_modulus), "Pa", 1e-6, INFINITY, "2.2e9", NULL,
       "bulk modulus; \"infinite\": incompressible; not used by gases"},
      {"viscosity", PARAM_NUMBER, AT(fluid, viscosity), "Pa s", 0, 1e6, "1.845e-5", NULL, "dynamic viscosity"},
      {"velocity", PARAM_FUNCTION3, AT(fluid, velocity), "m/s", 0, 0, ZERO_DEFAULT, NULL, "velocity at the start"},
      PARAM_END};
static const struct entry other_entries[] = {
    SECTION("eos", gas_section, 0, "{}", "equation of state; gases want absolute pressures of the whole scene"),
    VALUE("region", shape, fluid, region, "everywhere", "-",
          "region that it fills at the start, as far as earlier fluids leave room"),
    ENTRY_END};
static const struct section other_section = {.meaning = "fluid beside the first",
                                             .size = sizeof(struct fluid),
                                             .params = other_params,
                                             .entries = other_entries};
static const struct section fluid_section = {.meaning = "liquid", .params = fluid_params, .entries = fluid_entries};

/* ---- sides ---- */

const char *const side_names[] = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

#define SIDE_3D(name, kind, side, fallback, meaning)                                                                   \
  {                                                                                                                    \
    name, ENTRY_VALUE, &value_##kind, NULL, AT(scene, side), 0, fallback, NULL, NULL, "-", meaning, true               \
  }
#define SIDES_OF(kind, member, fallback)                                                                               \
  VALUE("x_min", kind, scene, member[X_MIN], fallback, "-", "side at the lowest x"),                                   \
      VALUE("x_max", kind, scene, member[X_MAX], fallback, "-", "side at the highest x"),                              \
      VALUE("y_min", kind, scene, member[Y_MIN], fallback, "-", "side at the lowest y"),                               \
      VALUE("y_max", kind, scene, member[Y_MAX], fallback, "-", "side at the highest y"),                              \
      SIDE_3D("z_min", kind, member[Z_MIN], fallback, "side at the lowest z"),                                         \
      SIDE_3D("z_max", kind, member[Z_MAX], fallback, "side at the highest z"), ENTRY_END

static const struct entry   solid_sides[] = {SIDES_OF(side_solid, solid_side, "slip")};
static const struct entry   fluid_sides[] = {SIDES_OF(side_fluid, fluid_side, "slip")};
static const struct entry   heat_sides[] = {SIDES_OF(side_heat, heat_side, "insulated")};
static const struct section solid_sides_section = {.meaning = "what the sides of the grid do to solids",
                                                   .entries = solid_sides};
static const struct section fluid_sides_section = {.meaning = "what the sides of the grid do to the fluid",
                                                   .entries = fluid_sides};
static const struct section heat_sides_section = {
    .meaning =
        "what the sides of the grid do to the heat of solids: insulated, {\"temperature\": K} or {\"flux\": W/m2 "
        "into the solid}",
    .entries = heat_sides};
static const struct entry boundary_entries[] = {
    SECTION("solid", solid_sides_section, 0, "{}", "what the sides of the grid do to solids"),
    SECTION("fluid", fluid_sides_section, 0, "{}", "what the sides of the grid do to the fluid"),
    SECTION("heat", heat_sides_section, 0, "{}", "what the sides of the grid do to the heat of solids"), ENTRY_END};
static const struct section boundary_section = {.meaning = "conditions at the sides of the grid",
                                                .entries = boundary_entries};

/* ---- loads, tracers, gauges ---- */

static const struct param load_params[] = {
    {"traction", PARAM_FUNCTION3, AT(load, traction), "Pa", 0, 0, ZERO_DEFAULT, NULL, "force on the solid per area"},
    {"pressure", PARAM_FUNCTION, AT(load, pressure), "Pa", 0, 0, ZERO_DEFAULT, NULL,
     "pressure against the outward normal"},
    PARAM_END};
static const struct entry load_entries[] = {
    VALUE("on", shape, load, patch, NULL, "-", "surface: a box of zero width along one axis, or in 2D a circle"),
    ENTRY_END};
static const struct section load_section = {.meaning = "traction on a surface that rides on the solid",
                                            .size = sizeof(struct load),
                                            .params = load_params,
                                            .entries = load_entries};

static const struct param obstacle_params[] = {
    {"friction", PARAM_NUMBER, AT(obstacle, friction), "-", 0, INFINITY, "0", NULL,
     "Coulomb coefficient; \"infinite\": rough, what presses on it does not slide"},
    {"velocity", PARAM_FUNCTION3, AT(obstacle, velocity), "m/s", 0, 0, ZERO_DEFAULT, NULL,
     "velocity of the whole, functions of t"},
    {"from", PARAM_NUMBER, AT(obstacle, from), "s", 0, 1e15, "0", NULL, "time at which it appears"},
    {"until", PARAM_NUMBER, AT(obstacle, until), "s", 0, INFINITY, "null", NULL,
     "time at which it vanishes; 0: a gate that the start leans on; null: never"},
    PARAM_END};
static const struct entry obstacle_entries[] = {
    VALUE("shape", shape, obstacle, shape, NULL, "-", "region that it fills at t = 0; it may reach beyond the grid"),
    ENTRY_END};
static const struct section obstacle_section = {.meaning = "rigid body that the solid meets",
                                                .size = sizeof(struct obstacle),
                                                .params = obstacle_params,
                                                .entries = obstacle_entries};

static const struct param   tracer_params[] = {{"at", PARAM_VECTOR, AT(tracer, x), "m", -1e9, INFINITY, NULL, NULL,
                                                "place at the start; null: the middle of that axis"},
                                               PARAM_END};
static const struct section tracer_section = {.meaning = "massless point that moves with the solid",
                                              .size = sizeof(struct tracer),
                                              .params = tracer_params,
                                              .bare = true};

#define GAUGE_OF                                                                                                       \
  {                                                                                                                    \
    "of", PARAM_TEXT, AT(gauge, of), "-", 0, 0, NULL, NULL, "output field with component, such as P or displacement_y" \
  }
#define GAUGE_ON                                                                                                       \
  {                                                                                                                    \
    "on", PARAM_TEXT, AT(gauge, on), "-", 0, 0, NULL, NULL, "name of the tracer, load, obstacle or side"               \
  }
#define GAUGE_MINUS                                                                                                    \
  {                                                                                                                    \
    "minus", PARAM_TEXT, AT(gauge, minus), "-", 0, 0, "", NULL, "name of a gauge whose number is taken off"            \
  }
static const struct param gauge_point[] = {
    GAUGE_OF,
    {"at", PARAM_VECTOR, AT(gauge, x), "m", -1e9, INFINITY, NULL, NULL, "place; null: the middle of that axis"},
    GAUGE_MINUS,
    PARAM_END};
static const struct param gauge_line[] = {
    GAUGE_OF,
    {"from", PARAM_VECTOR, AT(gauge, x), "m", -1e9, INFINITY, NULL, NULL, "first sample"},
    {"to", PARAM_VECTOR, AT(gauge, to), "m", -1e9, INFINITY, NULL, NULL, "last sample"},
    {"samples", PARAM_INTEGER, AT(gauge, n), "-", 2, 10000, "20", NULL, "number of samples"},
    PARAM_END};
static const struct param gauge_region[] = {
    {"of", PARAM_TEXT, AT(gauge, of), "-", 0, 0, NULL, NULL, "output field with component, or an entry of the ledger"},
    GAUGE_MINUS,
    PARAM_END};
static const struct param gauge_load[] = {GAUGE_OF, GAUGE_ON, GAUGE_MINUS, PARAM_END};
static const struct param gauge_extent[] = {
    {"of", PARAM_TEXT, AT(gauge, of), "-", 0, 0, NULL, NULL,
     "end of an axis, such as x_max or y_min: the farthest point that way"},
    {"on", PARAM_TEXT, AT(gauge, on), "-", 0, 0, "", NULL, "name of a solid, or water; empty: every solid"},
    {"connected", PARAM_FLAG, AT(gauge, connected), "-", 0, 0, "true", NULL,
     "points count that hang together: those of the largest cluster of cells, face to face, that hold some"},
    GAUGE_MINUS,
    PARAM_END};
static const struct param gauge_wall[] = {
    {"of", PARAM_TEXT, AT(gauge, of), "-", 0, 0, NULL, NULL,
     "force_x of it on the solid over the last step, impulse_x since the start, or displacement_x of an obstacle; "
     "heat, W,"
     " into the grid through a side over the last step, where the fluid conducts"},
    GAUGE_ON,
    GAUGE_MINUS,
    PARAM_END};
static const struct param gauge_tracer[] = {
    GAUGE_OF,
    GAUGE_ON,
    {"at", PARAM_VECTOR, AT(gauge, x), "m", -1e9, 1e9, "0", NULL, "where its distance is taken from"},
    GAUGE_MINUS,
    PARAM_END};

#define GAUGE_AXIS                                                                                                     \
  {                                                                                                                    \
    "of", PARAM_TEXT, AT(gauge, of), "-", 0, 0, NULL, NULL,                                                            \
        "axis along which the length of the liquid is taken: x, y, z"                                                  \
  }
static const struct param gauge_level[] = {GAUGE_AXIS,
                                           {"at", PARAM_VECTOR, AT(gauge, x), "m", -1e9, INFINITY, NULL, NULL,
                                            "place of the line along that axis; null: the middle of an axis"},
                                           GAUGE_MINUS,
                                           PARAM_END};
static const struct param gauge_levels[] = {
    GAUGE_AXIS,
    {"from", PARAM_VECTOR, AT(gauge, x), "m", -1e9, INFINITY, NULL, NULL, "place of the first line along that axis"},
    {"to", PARAM_VECTOR, AT(gauge, to), "m", -1e9, INFINITY, NULL, NULL, "place of the last"},
    {"samples", PARAM_INTEGER, AT(gauge, n), "-", 2, 10000, "20", NULL, "number of samples"},
    PARAM_END};

/* in the order of enum gauge_kind */
static bool gauge_row(int i, struct row *row)
{
  static const struct row rows[] = {{"point", NULL, gauge_point, 0, NULL},     {"line", NULL, gauge_line, 0, NULL},
                                    {"integral", NULL, gauge_region, 0, NULL}, {"mean", NULL, gauge_region, 0, NULL},
                                    {"tracer", NULL, gauge_tracer, 0, NULL},   {"load", NULL, gauge_load, 0, NULL},
                                    {"wall", NULL, gauge_wall, 0, NULL},       {"extent", NULL, gauge_extent, 0, NULL},
                                    {"level", NULL, gauge_level, 0, NULL},     {"levels", NULL, gauge_levels, 0, NULL}};
  bool                    found = i < (int)(sizeof rows / sizeof *rows);
  if (found) *row = rows[i];
  return found;
}

static const struct choice  gauge_choice = {"kind", NULL, "kind of gauge: " GAUGE_WORDS, gauge_row, AT(gauge, kind), 0,
                                            NULL,   NULL};
static const struct entry   gauge_entries[] = {{"region", ENTRY_VALUE, &value_shape, NULL, AT(gauge, region), 0,
                                                "everywhere", NULL, "integral|mean|extent", "-",
                                                "region that is summed over, or whose points count", false},
                                               ENTRY_END};
static const struct section gauge_section = {.meaning = "number sampled over time",
                                             .size = sizeof(struct gauge),
                                             .entries = gauge_entries,
                                             .choice = &gauge_choice};

/* ---- references and metrics ---- */

static const struct choice  reference_choice = {"kind",
                                                NULL,
                                                "reference",
                                                reference_row,
                                                AT(reference_use, reference),
                                                AT(reference_use, params),
                                                "docs/references.md",
                                                NULL};
static const struct section reference_section = {
    .meaning = "exact solution to compare with; a number may be \"=key.path\", what stands there",
    .size = sizeof(struct reference_use),
    .choice = &reference_choice,
    .links = true};

static const struct param metric_params[] = {
    {"measure", PARAM_CHOICE, AT(metric, measure), "-", 0, 0, NULL, MEASURE_WORDS, "how the difference is measured"},
    {"field", PARAM_TEXT, AT(metric, field), "-", 0, 0, "", NULL, "output field with component, at the time \"at\""},
    {"over", PARAM_TEXT, AT(metric, over), "-", 0, 0, "", NULL,
     "gauge whose number at the same time, or at \"to\", the result is divided by"},
    {"gauge", PARAM_TEXT, AT(metric, gauge), "-", 0, 0, "", NULL, "gauge, over the time \"from\" to \"to\""},
    {"reference", PARAM_TEXT, AT(metric, reference), "-", 0, 0, "", NULL,
     "\"name.quantity\" of a reference; empty: \"expected\""},
    {"expected", PARAM_FUNCTION, AT(metric, expected), "SI", 0, 0, ZERO_DEFAULT, NULL,
     "what it is compared with where there is no reference"},
    {"at", PARAM_NUMBER, AT(metric, at), "s", 0, INFINITY, "null", NULL, "time of a field; null: the end"},
    {"from", PARAM_NUMBER, AT(metric, from), "s", 0, 1e15, "0", NULL, "start of the span of a gauge"},
    {"to", PARAM_NUMBER, AT(metric, to), "s", 0, INFINITY, "null", NULL, "end of the span of a gauge; null: the end"},
    {"scale", PARAM_NUMBER, AT(metric, scale), "SI", 0, 1e300, "0", NULL,
     "result is divided by it; 0: by the reference's own scale"},
    {"offset", PARAM_NUMBER, AT(metric, offset), "SI", -1e300, 1e300, "0", NULL, "added to the gauge before comparing"},
    {"share", PARAM_NUMBER, AT(metric, share), "-", 0, 1, "0.95", NULL,
     "reach: of the way from the first to the last sample in the span"},
    {"shift", PARAM_NUMBER, AT(metric, shift), "s", 0, 1e12, "0", NULL,
     "fit: largest shift in time of the gauge against the rows of the table \"expected\""},
    PARAM_END};
static const struct entry metric_entries[] = {
    VALUE("time", time_unit, metric, scaled_time, "seconds", "-",
          "scaled: at, from, to count in the reference's unit of time"),
    VALUE("region", shape, metric, region, "everywhere", "-", "where a field is compared"),
    VALUE("profile", profile, metric, profile, "null", "-", "profile: file with columns t in s, place in m, value"),
    ENTRY_END};
static const struct section metric_section = {.meaning = "number of a run that is compared",
                                              .size = sizeof(struct metric),
                                              .params = metric_params,
                                              .entries = metric_entries,
                                              .links = true};

/* ---- numerics and output ---- */

static const struct param numerics_params[] = {
    {"basis", PARAM_CHOICE, AT(numerics, basis), "-", 0, 0, "quadratic", BASIS_WORDS,
     "functions between points and nodes"},
    {"transfer", PARAM_CHOICE, AT(numerics, transfer), "-", 0, 0, "aflip", TRANSFER_WORDS,
     "how points take velocities from nodes"},
    {"aflip_beta", PARAM_NUMBER, AT(numerics, aflip_beta), "-", 0, 1, "1", NULL, "blend of aflip: 1 apic, 0 flip"},
    {"stress_timing", PARAM_CHOICE, AT(numerics, stress_timing), "-", 0, 0, "usl", "usl|musl",
     "musl gathers momentum again before the stress"},
    {"wall_basis", PARAM_CHOICE, AT(numerics, wall_basis), "-", 0, 0, "mirrored", "mirrored|modified",
     "basis functions at the sides of the grid"},
    {"dt_factor", PARAM_NUMBER, AT(numerics, dt_factor), "-", 1e-6, 1e6, "0.8", NULL, "time step over its limit"},
    {"dt_max", PARAM_NUMBER, AT(numerics, dt_max), "s", 1e-15, INFINITY, "null", NULL, "largest time step; null: none"},
    {"theta", PARAM_NUMBER, AT(numerics, theta), "-", 0.5, 1, "1", NULL,
     "weight of the new pressure: 1 damps sound, 0.5 keeps it"},
    {"rest_tolerance", PARAM_NUMBER, AT(numerics, rest_tolerance), "-", 1e-12, INFINITY, "1e-3", NULL,
     "start at rest: rms acceleration of the solid's nodes that may be left, over that of its weight"},
    {"rest_steps", PARAM_INTEGER, AT(numerics, rest_steps), "-", 0, 2147483647, "20000", NULL,
     "start at rest: most steps of the static solve; 0: columns are weighed and that is all"},
    {"pressure_solver", PARAM_CHOICE, AT(numerics, pressure_solver), "-", 0, 0, "auto", "auto|hypre|direct",
     "solver of the pressure equation"},
    {"pressure_tolerance", PARAM_NUMBER, AT(numerics, pressure_tolerance), "-", 1e-16, 1e-2, "1e-10", NULL,
     "residual of the pressure equation over its largest right-hand side; at least 1e-13 of a cell's volume per step"},
    PARAM_END};
static const struct entry numerics_entries[] = {
    {"points_per_cell", ENTRY_VALUE, &value_points_per_cell, NULL, 0, 0, "4", "8", NULL, "-",
     "points in a full cell: a square (2D) or cube (3D), or a list per axis", false},
    ENTRY_END};
static const struct section numerics_section = {.meaning = "numerical choices; a section per module",
                                                .params = numerics_params,
                                                .entries = numerics_entries,
                                                .modules = true};

static const struct param output_params[] = {{"interval", PARAM_NUMBER, AT(output, interval), "s", 0, 1e12, "0", NULL,
                                              "time between snapshots; 0: chosen from time.end"},
                                             {"gauge_interval", PARAM_NUMBER, AT(output, gauge_interval), "s", 0, 1e12,
                                              "0", NULL, "time between samples; 0: chosen from time.end"},
                                             {"checkpoint_interval", PARAM_NUMBER, AT(output, checkpoint_interval), "s",
                                              0, 1e9, "300", NULL,
                                              "wall time between checkpoints; 0: only when interrupted"},
                                             PARAM_END};
static const struct entry output_entries[] = {
    {"times", ENTRY_VALUE, &value_times, NULL, 0, 0, "[]", NULL, NULL, "s", "more snapshots at these times", false},
    ENTRY_END};
static const struct section output_section = {
    .meaning = "what is written, and when", .params = output_params, .entries = output_entries};

/* ---- the scene ---- */

static const struct param scene_params[] = {
    {"gravity", PARAM_FUNCTION3, AT(scene, gravity), "m/s2", 0, 0, ZERO_DEFAULT, NULL, "gravity, a function of t"},
    {"start", PARAM_CHOICE, AT(scene, start), "-", 0, 0, "at_rest", "at_rest|zero",
     "at_rest computes hydrostatic pressure and geostatic stress; zero starts without"},
    {"seed", PARAM_INTEGER, AT(scene, seed), "-", 0, 2147483647, "1", NULL, "of everything random"},
    PARAM_END};
static const struct entry scene_entries[] = {
    VALUE("title", title, scene, title, "", "-", "one line"),
    VALUE("notes", notes, scene, title, "", "-", "free text, not used"),
    VALUE("start_from", folder, scene, start_from, "", "-",
          "output folder, from where the program runs, of a run whose end is the start at t = 0, in place of "
          "\"start\"; the same grid, solids, "
          "tracers, "
          "places of loads and fluid path; what is counted since the start goes on counting"),
    SECTION("grid", grid_section, 0, "{}", "uniform grid"),
    SECTION("time", time_section, 0, "{}", "span of time"),
    MAP("materials", material_section, materials, "materials by name"),
    MAP("solids", solid_section, solids, "bodies by name"),
    SECTION("contact", contact_section, AT(scene, contact), NULL,
            "contact between bodies; leave it out and all solids share one velocity field"),
    SECTION("fluid", fluid_section, AT(scene, fluid), NULL, "the liquid; leave it out for a dry scene"),
    {"fluids", ENTRY_MAP, NULL, &other_section, AT(scene, others), AT(scene, n_others), "{}", NULL, NULL, "-",
     "more fluids by name, such as the air above a liquid", false},
    SECTION("boundary", boundary_section, 0, "{}", "conditions at the sides of the grid"),
    MAP("obstacles", obstacle_section, obstacles, "rigid bodies by name"),
    MAP("loads", load_section, loads, "tractions by name"),
    MAP("tracers", tracer_section, tracers, "massless points that move with the solid, by name: a list of coordinates"),
    MAP("gauges", gauge_section, gauges, "numbers sampled over time, by name"),
    SECTION("numerics", numerics_section, AT(scene, numerics), "{}", "numerical choices"),
    SECTION("output", output_section, AT(scene, output), "{}", "what is written, and when"),
    MAP("references", reference_section, references, "exact solutions by name"),
    MAP("metrics", metric_section, metrics, "numbers compared with references, by name"),
    VALUE("origin", origin, scene, title, "{}", "-",
          "of a scene.used.json: the scene, file and variant it was made from"),
    VALUE("variants", override_sets, scene, title, "{}", "-", "overrides by name, for SCENE+name: \"key.path\": value"),
    VALUE("quick", overrides, scene, title, "{}", "-", "overrides of --quick"),
    VALUE("paths", path_overrides, scene, title, "{}", "-", "overrides of a fluid path"),
    ENTRY_END};

const struct section scene_section = {.meaning = "scene", .params = scene_params, .entries = scene_entries};
