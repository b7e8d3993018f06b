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

static void normalise(double v[3])
{
  double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  for (int d = 0; d < 3 && length > 0; d++) v[d] /= length;
}

/* outside: from the nearest place of the box; inside: the axis whose face is nearest */
static void normal_box(const struct shape *s, const double x[3], double normal[3])
{
  double inside = -INFINITY, face[3] = {0};
  bool   outside = false;
  for (int d = 0; d < s->dim; d++) {
    double beyond = fmax(s->min[d] - x[d], x[d] - s->max[d]), sign = x[d] - s->max[d] >= s->min[d] - x[d] ? 1 : -1;
    normal[d] = beyond > 0 ? sign * beyond : 0;
    outside = outside || beyond > 0;
    if (beyond <= inside) continue;
    inside = beyond;
    face[0] = face[1] = face[2] = 0;
    face[d] = sign;
  }
  for (int d = 0; d < 3 && !outside; d++) normal[d] = isfinite(inside) ? face[d] : 0;
  normalise(normal);
}

/* twice the area, positive for a left turn */
static double polygon_turn(const struct shape *s)
{
  double turn = 0;
  for (int i = 0, j = s->n - 1; i < s->n; j = i++)
    turn += s->vertices[j][0] * s->vertices[i][1] - s->vertices[i][0] * s->vertices[j][1];
  return turn;
}

/* the nearest edge's, or from the nearest vertex */
static void normal_polygon(const struct shape *s, const double x[3], double normal[3])
{
  double nearest2 = INFINITY, turn = polygon_turn(s) > 0 ? 1 : -1, side = distance_polygon(s, x) < 0 ? -1 : 1;
  for (int i = 0, j = s->n - 1; i < s->n; j = i++) {
    const double *a = s->vertices[j], *b = s->vertices[i];
    double        distance2 = edge_distance2(a, b, x), ex = b[0] - a[0], ey = b[1] - a[1];
    double        along = (x[0] - a[0]) * ex + (x[1] - a[1]) * ey, length2 = ex * ex + ey * ey;
    if (distance2 >= nearest2) continue;
    nearest2 = distance2;
    bool          on_edge = (along > 0 && along < length2) || distance2 == 0;
    const double *vertex = along > 0 ? b : a;
    normal[0] = on_edge ? turn * ey : side * (x[0] - vertex[0]);
    normal[1] = on_edge ? -turn * ex : side * (x[1] - vertex[1]);
  }
  normalise(normal);
}

/* that of the part whose distance counts */
static void normal_combined(const struct shape *s, const double x[3], double normal[3])
{
  double counts = shape_distance(&s->parts[0], x);
  int    part = 0;
  bool   removed = false;
  for (int i = 1; i < s->n; i++) {
    bool   minus = s->kind == SHAPE_DIFFERENCE;
    double own = shape_distance(&s->parts[i], x) * (minus ? -1 : 1);
    if (s->kind == SHAPE_UNION ? own >= counts : own <= counts) continue;
    counts = own;
    part = i;
    removed = minus;
  }
  shape_normal(&s->parts[part], x, normal);
  for (int d = 0; d < 3 && removed; d++) normal[d] = -normal[d];
}

void shape_normal(const struct shape *s, const double x[3], double normal[3])
{
  normal[0] = normal[1] = normal[2] = 0;
  switch (s->kind) {
  case SHAPE_BOX:
    normal_box(s, x, normal);
    break;
  case SHAPE_BALL:
    for (int d = 0; d < s->dim; d++) normal[d] = x[d] - s->centre[d];
    normalise(normal);
    break;
  case SHAPE_HALF_SPACE:
    for (int d = 0; d < s->dim; d++) normal[d] = s->normal[d];
    normalise(normal);
    break;
  case SHAPE_POLYGON:
    normal_polygon(s, x, normal);
    break;
  case SHAPE_UNION:
  case SHAPE_DIFFERENCE:
  case SHAPE_INTERSECTION:
    normal_combined(s, x, normal);
    break;
  default:
    break;
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
