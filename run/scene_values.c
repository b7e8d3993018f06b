/* Values of a scene that no struct param describes: sides, names of other entries, points per cell, lists. */
#include "core/scene.h"
#include "run/overrides.h"
#include "run/plan.h"
#include "run/scene_tables.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static enum status read_line(struct reader *reader, const cJSON *value, size_t size, const char *remedy, char *at)
{
  if (!cJSON_IsString(value))
    return reader_fail(reader, "expected a text, found %s; put it in quotes", json_type(value));
  if (strlen(value->valuestring) >= size) return reader_fail(reader, "more than %zu characters; %s", size - 1, remedy);
  memcpy(at, value->valuestring, strlen(value->valuestring) + 1);
  return OK;
}

static enum status read_title(struct reader *reader, const cJSON *value, void *at)
{
  return read_line(reader, value, sizeof((struct scene *)0)->title, "move the rest to \"notes\"", at);
}

const struct value_kind value_title = {"text", read_title, NULL, "{\"type\": \"string\"}"};

static enum status read_folder(struct reader *reader, const cJSON *value, void *at)
{
  return read_line(reader, value, FOLDER_LENGTH, "give a shorter path", at);
}

const struct value_kind value_folder = {"folder", read_folder, NULL, "{\"type\": \"string\"}"};

static enum status read_notes(struct reader *reader, const cJSON *value, void *at)
{
  (void)at;
  if (cJSON_IsString(value) || cJSON_IsArray(value)) return OK;
  return reader_fail(reader, "expected a text or a list of texts, found %s; put it in quotes", json_type(value));
}

const struct value_kind value_notes = {"text", read_notes, NULL, "{\"type\": [\"string\", \"array\"]}"};

static enum status read_origin(struct reader *reader, const cJSON *value, void *at)
{
  (void)at;
  if (!cJSON_IsObject(value)) return reader_fail(reader, "expected an object, found %s; remove it", json_type(value));
  for (const cJSON *member = value->child; member; member = member->next)
    if (!cJSON_IsString(member)) return reader_fail(reader, "it holds %s; remove it", json_type(member));
  return OK;
}

const struct value_kind value_origin = {"object", read_origin, NULL,
                                        "{\"type\": \"object\", \"additionalProperties\": {\"type\": \"string\"}}"};

/* ---- sides ---- */

static enum status read_side_word(struct reader *reader, const char *word, struct side_condition *side)
{
  static const struct param words = {
      .name = "side", .type = PARAM_CHOICE, .words = SIDE_WORDS, .meaning = "condition at this side"};
  cJSON text = {.type = cJSON_String, .valuestring = (char *)word};
  TRY(params_read_value(reader, &words, &text, &side->kind));
  if (side->kind == SIDE_VELOCITY)
    return reader_fail(reader, "\"velocity\" needs values; write {\"velocity\": [1, 0]}");
  if (side->kind == SIDE_PRESSURE) return reader_fail(reader, "\"pressure\" needs a value; write {\"pressure\": 0}");
  return OK;
}

enum { SIDE_KEYS = 2 };
static const struct param fluid_side_keys[SIDE_KEYS] = {{.name = "velocity",
                                                         .type = PARAM_FUNCTION3,
                                                         .offset = offsetof(struct side_condition, velocity),
                                                         .meaning = "velocity in m/s"},
                                                        {.name = "pressure",
                                                         .type = PARAM_FUNCTION,
                                                         .offset = offsetof(struct side_condition, pressure),
                                                         .meaning = "pressure in Pa"}};
static const struct param solid_side_keys[SIDE_KEYS] = {{.name = "velocity",
                                                         .type = PARAM_FUNCTION3,
                                                         .offset = offsetof(struct side_condition, velocity),
                                                         .meaning = "velocity in m/s"},
                                                        {.name = "friction",
                                                         .type = PARAM_NUMBER,
                                                         .offset = offsetof(struct side_condition, friction),
                                                         .min = 0,
                                                         .max = INFINITY,
                                                         .meaning = "Coulomb coefficient"}};

static enum status read_side_keys(struct reader *reader, const cJSON *value, const struct param keys[SIDE_KEYS],
                                  struct side_condition *side)
{
  for (const cJSON *member = value->child; member; member = member->next) {
    bool   known = json_is_comment(member);
    size_t mark = reader_enter(reader, member->string);
    for (int i = 0; i < SIDE_KEYS && !known; i++) {
      known = strcmp(keys[i].name, member->string) == 0;
      if (known) TRY(params_read_value(reader, &keys[i], member, side));
    }
    reader_leave(reader, mark);
    struct names names = {.n = SIDE_KEYS, .name = {keys[0].name, keys[1].name}};
    if (!known) return reader_unknown(reader, "key", member->string, &names);
  }
  return OK;
}

static enum status fail_side(const struct reader *reader, const cJSON *value, const char *example)
{
  return reader_fail(reader, "expected a word or an object, found %s; write \"slip\" or %s", json_type(value), example);
}

static enum status read_side_fluid(struct reader *reader, const cJSON *value, void *at)
{
  struct side_condition *side = at;
  bool                   is_velocity = json_member(value, "velocity");
  if (cJSON_IsString(value)) return read_side_word(reader, value->valuestring, at);
  if (!cJSON_IsObject(value)) return fail_side(reader, value, "{\"velocity\": [1, 0]}");
  TRY(read_side_keys(reader, value, fluid_side_keys, side));
  side->kind = is_velocity ? SIDE_VELOCITY : SIDE_PRESSURE;
  if (is_velocity != (json_member(value, "pressure") != NULL)) return OK;
  return reader_fail(
      reader, "expected one of {\"velocity\": [...]} and {\"pressure\": ...}; write one of them or a word such as "
              "\"slip\"");
}

/* {"velocity": [...]} is rough and holds the solid, with "friction" the solid presses on it and slides */
static enum status read_side_motion(struct reader *reader, const cJSON *value, struct side_condition *side)
{
  bool moves = json_member(value, "velocity"), rubs = json_member(value, "friction");
  TRY(read_side_keys(reader, value, solid_side_keys, side));
  side->kind = moves ? SIDE_VELOCITY : SIDE_SLIP;
  side->rubs = rubs;
  if (moves || rubs) return OK;
  return reader_fail(reader, "expected \"friction\", \"velocity\" or both; write {\"friction\": 0.5} or a word such as "
                             "\"slip\"");
}

static enum status read_side_solid(struct reader *reader, const cJSON *value, void *at)
{
  struct side_condition *side = at;
  if (!cJSON_IsString(value) && !cJSON_IsObject(value)) return fail_side(reader, value, "{\"friction\": 0.5}");
  if (cJSON_IsString(value)) TRY(read_side_word(reader, value->valuestring, side));
  if (side->kind == SIDE_PRESSURE || json_member(value, "pressure"))
    return reader_fail(reader, "a solid has no pressure side; put a load with \"pressure\" on its surface instead");
  return cJSON_IsObject(value) ? read_side_motion(reader, value, side) : OK;
}

static void destroy_side(void *at)
{
  struct side_condition *side = at;
  for (int d = 0; d < 3; d++) function_destroy(&side->velocity[d]);
  function_destroy(&side->pressure);
}

const struct value_kind value_side_solid = {"side", read_side_solid, destroy_side,
                                            "{\"$ref\": \"#/$defs/side_solid\"}"};
const struct value_kind value_side_fluid = {"side", read_side_fluid, destroy_side,
                                            "{\"$ref\": \"#/$defs/side_fluid\"}"};

/* ---- names of other entries ---- */

static enum status read_material(struct reader *reader, const cJSON *value, void *at)
{
  struct names        names = {0};
  const struct scene *scene = reader->scene;
  if (!cJSON_IsString(value))
    return reader_fail(reader, "expected the name of a material, found %s; put it in quotes", json_type(value));
  for (int i = 0; i < scene->n_materials; i++) {
    names_add(&names, scene->materials[i].name);
    if (strcmp(scene->materials[i].name, value->valuestring) != 0) continue;
    *(int *)at = i;
    return OK;
  }
  return reader_unknown(reader, "material", value->valuestring, &names);
}

const struct value_kind value_material = {"name", read_material, NULL, "{\"type\": \"string\"}"};

static enum status read_fluid_path(struct reader *reader, const cJSON *value, void *at)
{
  struct names names = {0};
  for (int i = 0; all_modules[i]; i++) {
    if (!all_modules[i]->is_fluid_path) continue;
    names_add(&names, all_modules[i]->name);
    if (!cJSON_IsString(value) || strcmp(value->valuestring, all_modules[i]->name) != 0) continue;
    memcpy(at, &all_modules[i], sizeof all_modules[i]);
    return OK;
  }
  if (cJSON_IsString(value)) return reader_unknown(reader, "fluid path", value->valuestring, &names);
  return reader_fail(reader, "the fluid has no path; choose one with --fluid or \"path\", such as \"%s\"",
                     names.n ? names.name[0] : "");
}

const struct value_kind value_fluid_path = {"name", read_fluid_path, NULL, "{\"type\": [\"string\", \"null\"]}"};

static enum status read_time_unit(struct reader *reader, const cJSON *value, void *at)
{
  static const struct param words = {
      .name = "time", .type = PARAM_CHOICE, .words = "seconds|scaled", .meaning = "unit of at, from, to"};
  int index = 0;
  TRY(params_read_value(reader, &words, value, &index));
  *(bool *)at = index == 1;
  return OK;
}

const struct value_kind value_time_unit = {"seconds|scaled", read_time_unit, NULL,
                                           "{\"enum\": [\"seconds\", \"scaled\"]}"};

/* ---- points per cell ---- */

static enum status read_points_number(struct reader *reader, const cJSON *value, struct numerics *numerics)
{
  double n = value->valuedouble, per_axis = reader->dim == 2 ? sqrt(n) : cbrt(n);
  double whole = floor(per_axis + 0.5), power = reader->dim == 2 ? whole * whole : whole * whole * whole;
  if (!(n >= 1 && n <= 1000)) return reader_fail(reader, "%.10g is outside [1, 1000]; choose 4 in 2D or 8 in 3D", n);
  if (power != n)
    return reader_fail(reader,
                       "%.10g is not the %s of a whole number; choose %.10g, or give points per axis such as [4, 1%s]",
                       n, reader->dim == 2 ? "square" : "cube", power, reader->dim == 2 ? "" : ", 1");
  numerics->points_per_cell = n;
  for (int d = 0; d < 3; d++) numerics->points_per_axis[d] = d < reader->dim ? (int)whole : 1;
  return OK;
}

static enum status read_points_list(struct reader *reader, const cJSON *value, struct numerics *numerics)
{
  int d = 0;
  if (cJSON_GetArraySize(value) != reader->dim)
    return reader_fail(reader, "%d entries in a grid of %d dimensions; give %d", cJSON_GetArraySize(value), reader->dim,
                       reader->dim);
  numerics->points_per_cell = numerics->points_per_axis[2] = 1;
  for (const cJSON *axis = value->child; axis; axis = axis->next, d++) {
    double n = cJSON_IsNumber(axis) ? axis->valuedouble : 0;
    if (n != floor(n) || n < 1 || n > 32)
      return reader_fail(reader, "points along an axis are not a whole number in [1, 32]; write [2, 2]");
    numerics->points_per_axis[d] = (int)n;
    numerics->points_per_cell *= n;
  }
  return OK;
}

static enum status read_points_per_cell(struct reader *reader, const cJSON *value, void *at)
{
  if (cJSON_IsArray(value)) return read_points_list(reader, value, at);
  if (cJSON_IsNumber(value)) return read_points_number(reader, value, at);
  return reader_fail(reader, "expected a number or a list of numbers per axis, found %s; write 4 or [2, 2]",
                     json_type(value));
}

const struct value_kind value_points_per_cell = {
    "number or list", read_points_per_cell, NULL,
    "{\"anyOf\": [{\"type\": \"number\", \"minimum\": 1, \"maximum\": 1000}, {\"type\": \"array\", \"minItems\": 2, "
    "\"maxItems\": 3, "
    "\"items\": {\"type\": \"integer\", \"minimum\": 1, \"maximum\": 32}}]}"};

/* ---- lists ---- */

static enum status read_times(struct reader *reader, const cJSON *value, void *at)
{
  struct output *output = at;
  enum { MOST = sizeof output->times / sizeof *output->times };
  if (!cJSON_IsArray(value))
    return reader_fail(reader, "expected a list of times in s, found %s; write [0.1, 0.2]", json_type(value));
  if (cJSON_GetArraySize(value) > MOST)
    return reader_fail(reader, "%d times are more than %d; use \"interval\"", cJSON_GetArraySize(value), MOST);
  for (const cJSON *time = value->child; time; time = time->next) {
    if (!cJSON_IsNumber(time) || time->valuedouble < 0)
      return reader_fail(reader, "a time is not a number from 0 on; write it in s");
    if (output->n_times > 0 && time->valuedouble <= output->times[output->n_times - 1])
      return reader_fail(reader, "%.10g does not come after %.10g; sort the times", time->valuedouble,
                         output->times[output->n_times - 1]);
    output->times[output->n_times++] = time->valuedouble;
  }
  return OK;
}

const struct value_kind value_times = {
    "list of numbers", read_times, NULL,
    "{\"type\": \"array\", \"maxItems\": 64, \"items\": {\"type\": \"number\", \"minimum\": 0}}"};

static enum status read_overrides(struct reader *reader, const cJSON *value, void *at)
{
  (void)at;
  return overrides_check(reader, &scene_section, value);
}

static enum status read_override_sets(struct reader *reader, const cJSON *value, void *at)
{
  (void)at;
  if (!cJSON_IsObject(value))
    return reader_fail(reader, "expected an object of named overrides, found %s; write {\"fine\": {\"grid.h\": 0.01}}",
                       json_type(value));
  for (const cJSON *set = value->child; set; set = set->next) {
    if (json_is_comment(set)) continue;
    size_t mark = reader_enter(reader, set->string);
    TRY(overrides_check(reader, &scene_section, set));
    reader_leave(reader, mark);
  }
  return OK;
}

/** Paths that scenes may already speak of though this program need not have them. */
static bool is_foreseen(const char *path) { return strcmp(path, "twopoint") == 0 || strcmp(path, "fem") == 0; }

static enum status read_path_overrides(struct reader *reader, const cJSON *value, void *at)
{
  TRY(read_override_sets(reader, value, at));
  for (const cJSON *set = value->child; set; set = set->next) {
    const struct module *path = NULL;
    const cJSON          name = {.type = cJSON_String, .valuestring = set->string};
    if (json_is_comment(set) || is_foreseen(set->string)) continue;
    TRY(read_fluid_path(reader, &name, &path));
  }
  return OK;
}

const struct value_kind value_overrides = {"overrides", read_overrides, NULL, "{\"type\": \"object\"}"};
const struct value_kind value_override_sets = {
    "named overrides", read_override_sets, NULL,
    "{\"type\": \"object\", \"additionalProperties\": {\"type\": [\"object\", \"string\"]}}"};
const struct value_kind value_path_overrides = {
    "overrides per path", read_path_overrides, NULL,
    "{\"type\": \"object\", \"additionalProperties\": {\"type\": [\"object\", \"string\"]}}"};
