/* Cells and faces that the surface of a shape cuts. theory 4.1, 4.12 */
#include "ice/shares.h"

#include "ice/plic.h"

#include <math.h>

/* parts along each axis of a cell that is cut */
enum { PARTS = 8 };
/* shares closer than this to 0 or 1 are round-off */
static const double least_share = 1e-9;

/* of a piece of width w about x: its surface is a plane there */
static double piece_inside(const struct shape *shape, const double x[3], int axis, double w)
{
  double normal[3], distance = shape_distance(shape, x);
  shape_normal(shape, x, normal);
  if (axis >= 0) normal[axis] = 0;
  double width = fabs(normal[0]) + fabs(normal[1]) + fabs(normal[2]);
  if (fabs(distance) >= 0.5 * width * w) return distance < 0;
  return plic_volume(normal, -distance / w);
}

double share_inside(const struct grid *g, const struct shape *shape, const double x[3], int axis)
{
  double distance = shape_distance(shape, x), sum = 0, w = g->h / PARTS, y[3];
  int    along[3], all = 1;
  if (fabs(distance) > 0.5 * sqrt(g->dim) * g->h) return distance < 0;
  for (int d = 0; d < 3; d++) all *= along[d] = d < g->dim && d != axis ? PARTS : 1;
  for (int i = 0; i < all; i++) {
    for (int d = 0, left = i; d < 3; left /= along[d++]) y[d] = x[d] + (left % along[d] + 0.5 - 0.5 * along[d]) * w;
    sum += piece_inside(shape, y, axis, w);
  }
  sum /= all;
  return sum < least_share ? 0 : sum > 1 - least_share ? 1 : sum;
}

double share_way_out(const struct grid *g, const struct shape *shape, const double x[3], int axis, int sign,
                     double most)
{
  double low = 0, high = 0, y[3] = {x[0], x[1], x[2]};
  if (shape_distance(shape, x) >= 0) return 0;
  for (int i = 1; i <= PARTS; i++) { /* the first place outside */
    low = high;
    high = most * i / PARTS;
    y[axis] = x[axis] + sign * high * g->h;
    if (shape_distance(shape, y) >= 0) break;
    if (i == PARTS) return most;
  }
  for (int i = 0; i < 50; i++) {
    double middle = 0.5 * (low + high);
    y[axis] = x[axis] + sign * middle * g->h;
    *(shape_distance(shape, y) < 0 ? &low : &high) = middle;
  }
  return 0.5 * (low + high);
}
