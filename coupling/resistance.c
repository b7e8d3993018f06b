/* The skeleton's resistance in a space that it may fill only partly. theory 2.2 */
#include "coupling/coupling.h"

#include <math.h>

static const double reference_gravity =
    9.81; /* hydraulic conductivities are quoted with it, whatever gravity the scene has */

double coupling_permeability(const struct scene *scene, const struct material *material)
{
  return material->permeability * scene->fluid.viscosity / (scene->fluid.density * reference_gravity);
}

void coupling_drag(const struct scene *scene, const struct fluid *fluid, int n, const double *porosity,
                   const double *fill, const double *medium_porosity, const double *slip, const double *permeability,
                   const double *diameter, double *K)
{
  double             inside[DRAG_BATCH];
  struct drag_medium medium = {.porosity = medium_porosity,
                               .slip = inside,
                               .permeability = permeability,
                               .diameter = diameter,
                               .density = fluid->density,
                               .viscosity = fluid->viscosity};
  for (int i = 0; i < n; i++) inside[i] = porosity[i] * slip[i] / medium_porosity[i];
  scene->fluid.drag->coefficient(scene->fluid.drag_params, n, &medium, K);
  for (int i = 0; i < n; i++) {
    double ratio = porosity[i] / medium_porosity[i];
    K[i] = fill[i] > 0 ? K[i] * fill[i] * ratio * ratio : 0;
  }
}
