/* Regions of space: boxes, polygons, balls, half-spaces, and their unions, differences and intersections. */
#ifndef CORE_SHAPE_H
#define CORE_SHAPE_H

#include <stdbool.h>

enum shape_kind {
  SHAPE_EVERYWHERE,
  SHAPE_BOX,        /* min <= x <= max; infinite where the scene says null */
  SHAPE_BALL,       /* |x - centre| <= radius: circle (cylinder along z) or sphere */
  SHAPE_HALF_SPACE, /* normal.(x - centre) <= 0 */
  SHAPE_POLYGON,    /* vertices in the x-y plane, either turn */
  SHAPE_UNION,
  SHAPE_DIFFERENCE, /* the first part without the others */
  SHAPE_INTERSECTION
};

struct shape {
  enum shape_kind kind;
  int             dim;
  double          min[3], max[3], centre[3], normal[3], radius;
  int             n; /* vertices or parts */
  double (*vertices)[2];
  struct shape *parts;
};

/** Signed distance, m: negative inside. Exact for the simple shapes; for combinations a bound of the right sign. */
double shape_distance(const struct shape *s, const double x[3]);
/** Unit gradient of the distance: out of the shape, where the nearest part of its surface faces. On edges and in
 * corners one of the faces' normals. A shape without surface: zero. */
void shape_normal(const struct shape *s, const double x[3], double normal[3]);
/** Whether x lies inside; a point on the border, to 1e-12 m, counts as inside. */
bool shape_contains(const struct shape *s, const double x[3]);
void shape_destroy(struct shape *s);

#endif
