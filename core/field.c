/* What of a field depends on the scene. */
#include "core/scene.h"

int field_components(const struct field *f, const struct scene *scene)
{
  switch (f->components) {
  case VECTOR:
  case FLUID_VECTORS:
    return scene->dim;
  case MATRIX:
    return scene->dim * scene->dim;
  case HISTORY:
    return scene->n_history;
  case FLUIDS:
    return 1;
  default:
    return f->components;
  }
}

int field_copies(const struct field *f, const struct scene *scene)
{
  return (f->components == FLUIDS || f->components == FLUID_VECTORS) && scene->n_fluids > 1 ? scene->n_fluids : 1;
}
