/* Heat in a scene: what a side does to it, and whether the scene can solve it. */
#include "ice/ice.h"
#include "run/scene_check.h"
#include "run/scene_tables.h"

#include <stdio.h>
#include <string.h>

/* ---- sides: "insulated", {"temperature": K}, {"flux": W/m2} ---- */

static enum status read_side_value(struct reader *reader, const cJSON *value, struct heat_side *side)
{
  const cJSON *member = value->child;
  bool         is_temperature = member && !member->next && strcmp(member->string, "temperature") == 0;
  bool         is_flux = member && !member->next && strcmp(member->string, "flux") == 0;
  if (!is_temperature && !is_flux)
    return reader_fail(reader, "expected one of {\"temperature\": ...} and {\"flux\": ...}; write one of them or "
                               "\"insulated\"");
  side->kind = is_temperature ? HEAT_TEMPERATURE : HEAT_FLUX;
  size_t mark = reader_enter(reader, member->string);
  TRY(params_read_function(reader, member, &side->value));
  reader_leave(reader, mark);
  return OK;
}

static enum status read_side_heat(struct reader *reader, const cJSON *value, void *at)
{
  struct heat_side *side = at;
  side->kind = HEAT_INSULATED;
  if (cJSON_IsObject(value)) return read_side_value(reader, value, side);
  if (cJSON_IsString(value) && strcmp(value->valuestring, "insulated") == 0) return OK;
  return reader_fail(reader,
                     "expected \"insulated\" or an object, found %s; write {\"temperature\": 300} in K or "
                     "{\"flux\": 100} in W/m2 into the solid",
                     json_type(value));
}

static void destroy_side(void *at)
{
  struct heat_side *side = at;
  function_destroy(&side->value);
}

const struct value_kind value_side_heat = {
    "insulated, temperature or flux", read_side_heat, destroy_side,
    "{\"oneOf\": [{\"const\": \"insulated\"}, {\"type\": \"object\", \"properties\": {\"temperature\": {\"$ref\": "
    "\"#/$defs/function\"}}, \"required\": [\"temperature\"], \"additionalProperties\": false}, {\"type\": \"object\", "
    "\"properties\": {\"flux\": {\"$ref\": \"#/$defs/function\"}}, \"required\": [\"flux\"], "
    "\"additionalProperties\": false}]}"};

/* ---- whether it fits together ---- */

/* a material of some solid that has a heat capacity; NULL: heat is not solved */
static const struct material *find_warm(const struct scene *scene)
{
  for (int s = 0; s < scene->n_solids; s++)
    if (scene_material(scene, s)->heat_capacity > 0) return scene_material(scene, s);
  return NULL;
}

static enum status check_capacities(struct reader *reader, const struct scene *scene)
{
  const struct material *warm = find_warm(scene);
  for (int s = 0; s < scene->n_solids; s++) {
    const struct material *m = scene_material(scene, s);
    snprintf(reader->path, sizeof reader->path, "materials.%s.heat_capacity", m->name);
    if (m->heat_capacity > 0) continue;
    if (m->conductivity > 0)
      return reader_fail(reader, "a material with a conductivity needs a heat capacity; give it in J/(kg K)");
    if (warm)
      return reader_fail(reader, "heat is solved as material %s has a heat capacity; give it in J/(kg K) here too",
                         warm->name);
  }
  return OK;
}

static bool conducts(const struct scene *scene)
{
  for (int s = 0; s < scene->n_solids; s++)
    if (scene_material(scene, s)->conductivity > 0) return true;
  return false;
}

static enum status check_sides(struct reader *reader, const struct scene *scene)
{
  for (int side = 0; side < 2 * scene->dim; side++) {
    int kind = scene->solid_side[side].kind;
    snprintf(reader->path, sizeof reader->path, "boundary.heat.%s", side_names[side]);
    if (scene->heat_side[side].kind == HEAT_INSULATED) continue;
    if (fluid_has_energy(&scene->fluid)) continue;
    if (!conducts(scene))
      return reader_fail(reader, "no material of a solid conducts heat, and the fluid's energy is not solved; give "
                                 "\"conductivity\" and \"heat_capacity\", or fluid.temperature, or remove it");
    if (kind == SIDE_OPEN || kind == SIDE_PERIODIC)
      return reader_fail(reader, "this side is %s for solids, which never reach it; write \"insulated\"",
                         kind == SIDE_OPEN ? "open" : "periodic");
  }
  return OK;
}

static enum status check_fluid(struct reader *reader, const struct scene *scene)
{
  const struct fluid *fluid = &scene->fluid;
  snprintf(reader->path, sizeof reader->path, "fluid.conductivity");
  if (!fluid_has_energy(fluid))
    return fluid->present && fluid->conductivity > 0
               ? reader_fail(reader, "a fluid that conducts heat needs a temperature; give fluid.temperature in K")
               : OK;
  snprintf(reader->path, sizeof reader->path, "fluid.temperature");
  if (fluid->path != &module_ice)
    return reader_fail(reader, "the path %s does not solve the fluid's energy; take fluid.path ice or remove it",
                       fluid->path ? fluid->path->name : "null");
  const struct ice_params *params = scene_module_params(scene, &module_ice);
  if (scene->n_fluids > 1 && !params->shocks)
    return reader_fail(reader, "energy of several fluids is solved at any speed only; remove it or fluids, or set "
                               "numerics.ice.shocks true");
  if (params->advection || params->shocks) return OK;
  return reader_fail(reader, "heat goes with the flow, which is not followed; set numerics.ice.advection true");
}

enum status scene_check_heat(struct reader *reader, const struct scene *scene)
{
  TRY(check_capacities(reader, scene));
  TRY(check_fluid(reader, scene));
  return check_sides(reader, scene);
}
