/* Signed distances of simple shapes and of their combinations. */
#include "core/shape.h"

#include "core/memory.h"

#include <math.h>

/* m: how far outside a point may lie and still count as inside, so that borders do not depend on round-off */
static const double border = 1e-12;

static double distance_box(const struct shape *s, const double x[3])
{
  double outside = 0, inside = -INFINITY;
  for (int d = 0; d < s->dim; d++) {
    double beyond = fmax(s->min[d] - x[d], x[d] - s->max[d]);
    if (beyond > 0) outside += beyond * beyond;
    inside = fmax(inside, beyond);
  }
  return outside > 0 ? sqrt(outside) : inside;
}

static double distance_ball(const struct shape *s, const double x[3])
{
  double r2 = 0;
  for (int d = 0; d < s->dim; d++) r2 += (x[d] - s->centre[d]) * (x[d] - s->centre[d]);
  return sqrt(r2) - s->radius;
}

static double distance_half_space(const struct shape *s, const double x[3])
{
  double along = 0, length2 = 0;
  for (int d = 0; d < s->dim; d++) {
    along += s->normal[d] * (x[d] - s->centre[d]);
    length2 += s->normal[d] * s->normal[d];
  }
  return along / sqrt(length2);
}

/** m2: square of the distance from x to the edge a-b. */
static double edge_distance2(const double a[2], const double b[2], const double x[3])
{
  double ex = b[0] - a[0], ey = b[1] - a[1], dx = x[0] - a[0], dy = x[1] - a[1];
  double length2 = ex * ex + ey * ey;
  double along = length2 > 0 ? fmin(1, fmax(0, (dx * ex + dy * ey) / length2)) : 0;
  dx -= along * ex;
  dy -= along * ey;
  return dx * dx + dy * dy;
}

/** Whether a ray from x towards +x crosses the edge a-b. */
static bool edge_crosses(const double a[2], const double b[2], const double x[3])
{
  if ((a[1] > x[1]) == (b[1] > x[1])) return false;
  return x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
}

static double distance_polygon(const struct shape *s, const double x[3])
{
  double nearest2 = INFINITY;
  bool   inside = false;
  for (int i = 0, j = s->n - 1; i < s->n; j = i++) {
    nearest2 = fmin(nearest2, edge_distance2(s->vertices[j], s->vertices[i], x));
    if (edge_crosses(s->vertices[j], s->vertices[i], x)) inside = !inside;
  }
  return inside ? -sqrt(nearest2) : sqrt(nearest2);
}

static double distance_combined(const struct shape *s, const double x[3])
{
  double distance = shape_distance(&s->parts[0], x);
  for (int i = 1; i < s->n; i++) {
    double part = shape_distance(&s->parts[i], x);
    if (s->kind == SHAPE_UNION) distance = fmin(distance, part);
    if (s->kind == SHAPE_DIFFERENCE) distance = fmax(distance, -part);
    if (s->kind == SHAPE_INTERSECTION) distance = fmax(distance, part);
  }
  return distance;
}

double shape_distance(const struct shape *s, const double x[3])
{
  switch (s->kind) {
  case SHAPE_BOX:
    return distance_box(s, x);
  case SHAPE_BALL:
    return distance_ball(s, x);
  case SHAPE_HALF_SPACE:
    return distance_half_space(s, x);
  case SHAPE_POLYGON:
    return distance_polygon(s, x);
  case SHAPE_UNION:
  case SHAPE_DIFFERENCE:
  case SHAPE_INTERSECTION:
    return distance_combined(s, x);
  default:
    return -INFINITY;
  }
}

bool shape_contains(const struct shape *s, const double x[3]) { return shape_distance(s, x) <= border; }

void shape_destroy(struct shape *s)
{
  for (int i = 0; s->parts && i < s->n; i++) shape_destroy(&s->parts[i]);
  memory_free(&s->parts);
  memory_free(&s->vertices);
  s->n = 0;
}
