/* The start at rest: hydrostatic pressure and geostatic stress, computed, not reached by waiting. theory 2.5 */
#ifndef MPM_AT_REST_H
#define MPM_AT_REST_H

#include "core/scene.h"

struct rest {
  double pressure;  /* Pa, of the fluid there; 0 in the dry */
  double effective; /* Pa, vertical effective stress of the skeleton there, tension positive */
};
/** Hydrostatic pressure and geostatic stress at x: the column above x, against gravity, is weighed. */
enum status at_rest_column(const struct scene *scene, const double x[3], struct rest *rest) MUST_CHECK;
/** Unit vector against gravity at t = 0 and its size g m/s2; a scene without gravity: up = 0, g = 0. */
void at_rest_up(const struct scene *scene, double up[3], double *g);

#endif
