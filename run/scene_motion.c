/* Whether a prescribed motion of the fluid leaves nothing else to move it. */
#include "ice/ice.h"
#include "run/scene_check.h"

#include <stdio.h>

/* sides that let something through would need to know what comes in */
static enum status check_sides(struct reader *reader, const struct scene *scene)
{
  for (int side = 0; side < 2 * scene->dim; side++) {
    int kind = scene->fluid_side[side].kind;
    if (kind == SIDE_SLIP || kind == SIDE_NO_SLIP || kind == SIDE_SYMMETRY || kind == SIDE_PERIODIC) continue;
    snprintf(reader->path, sizeof reader->path, "fluid.motion");
    return reader_fail(reader, "prescribed, but a side lets the fluid through; close all sides or make them periodic");
  }
  return OK;
}

enum status scene_check_motion(struct reader *reader, const struct scene *scene)
{
  const struct fluid *fluid = &scene->fluid;
  if (!fluid->present || !fluid->prescribed) return OK;
  snprintf(reader->path, sizeof reader->path, "fluid.motion");
  if (fluid->path != &module_ice)
    return reader_fail(reader, "the path %s does not take a prescribed motion; take fluid.path ice",
                       fluid->path ? fluid->path->name : "null");
  const struct ice_params *params = scene_module_params(scene, &module_ice);
  if (!params->advection || params->shocks)
    return reader_fail(reader, "prescribed, but nothing is carried; set numerics.ice.advection true, shocks false");
  if (scene->n_solids > 0 || scene->n_obstacles > 0 || scene->n_others > 0 || fluid_has_energy(fluid))
    return reader_fail(reader, "prescribed goes with one fluid alone; leave solids, obstacles, fluids and "
                               "temperatures out");
  return check_sides(reader, scene);
}
