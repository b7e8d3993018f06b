/* What of a field depends on the scene. */
#include "core/scene.h"

int field_components(const struct field *f, const struct scene *scene)
{
  switch (f->components) {
  case VECTOR:
    return scene->dim;
  case MATRIX:
    return scene->dim * scene->dim;
  case HISTORY:
    return scene->n_history;
  default:
    return f->components;
  }
}
