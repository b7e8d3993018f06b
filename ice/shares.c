/* Cells and faces that the surface of a shape cuts. theory 4.1, 4.14 */
#include "ice/shares.h"

#include "ice/plic.h"

#include <math.h>
#include <stddef.h>

/* shares closer than this to 0 or 1 are round-off */
static const double least_share = 1e-9;

struct places places_of(const struct shape *shape) { return (struct places){.n = 1, .shape = {shape}}; }

double places_distance(const struct places *p, const double x[3], double normal[3])
{
  double least = INFINITY;
  for (int i = 0; i < p->n; i++) {
    double y[3] = {x[0] - p->moved[i][0], x[1] - p->moved[i][1], x[2] - p->moved[i][2]};
    double distance = shape_distance(p->shape[i], y);
    if (distance >= least) continue;
    least = distance;
    if (normal) shape_normal(p->shape[i], y, normal);
  }
  return least;
}

/* of a piece of width w about x: its surface is a plane there */
static double piece_inside(const struct places *p, const double x[3], int axis, double w)
{
  double normal[3] = {0}, distance = places_distance(p, x, normal);
  if (axis >= 0) normal[axis] = 0;
  double width = fabs(normal[0]) + fabs(normal[1]) + fabs(normal[2]);
  if (fabs(distance) >= 0.5 * width * w) return distance < 0;
  return plic_volume(normal, -distance / w);
}

static double rounded(double share) { return share < least_share ? 0 : share > 1 - least_share ? 1 : share; }

/* whether no part of a cell about x is cut */
static bool far_away(const struct grid *g, double distance) { return fabs(distance) > 0.5 * sqrt(g->dim) * g->h; }

/* number of pieces, and of them along each axis: one across the section's axis */
static int count_pieces(const struct grid *g, int axis, int along[3])
{
  int all = 1;
  for (int d = 0; d < 3; d++) all *= along[d] = d < g->dim && d != axis ? SHARE_PARTS : 1;
  return all;
}

/* centre of piece i, and its place along each axis */
static void piece_centre(const struct grid *g, const double x[3], const int along[3], int i, int at[3], double y[3])
{
  for (int d = 0, left = i; d < 3; left /= along[d++]) {
    at[d] = left % along[d];
    y[d] = x[d] + (at[d] + 0.5 - 0.5 * along[d]) * g->h / SHARE_PARTS;
  }
}

double share_inside(const struct grid *g, const struct places *p, const double x[3], int axis)
{
  double distance = places_distance(p, x, NULL), sum = 0, y[3];
  int    along[3], at[3];
  if (far_away(g, distance)) return distance < 0;
  int all = count_pieces(g, axis, along);
  for (int i = 0; i < all; i++) {
    piece_centre(g, x, along, i, at, y);
    sum += piece_inside(p, y, axis, g->h / SHARE_PARTS);
  }
  return rounded(sum / all);
}

double share_left(const struct grid *g, const struct places *without, const struct places *p, const double x[3],
                  int axis, double slice[SHARE_PARTS])
{
  double distance = places_distance(without, x, NULL), sum = 0, left = 0, y[3];
  bool   cut = !far_away(g, distance);
  int    along[3], at[3], all = count_pieces(g, -1, along);
  for (int k = 0; k < SHARE_PARTS; k++) slice[k] = cut || distance < 0 ? 0 : 1.0 / SHARE_PARTS;
  for (int i = 0; cut && i < all; i++) {
    piece_centre(g, x, along, i, at, y);
    double open = 1 - rounded(piece_inside(without, y, -1, g->h / SHARE_PARTS));
    slice[at[axis]] += open / all;
    left += open;
    if (open > 0 && p) sum += open * piece_inside(p, y, -1, g->h / SHARE_PARTS);
  }
  if (!p) return cut ? rounded(left / all) : distance >= 0;
  return cut ? (left > 0 ? rounded(sum / left) : 0) : share_inside(g, p, x, -1);
}

double share_way_out(const struct grid *g, const struct places *p, const double x[3], int axis, int sign, double most)
{
  double low = 0, high = 0, y[3] = {x[0], x[1], x[2]};
  if (places_distance(p, x, NULL) >= 0) return 0;
  for (int i = 1; i <= SHARE_PARTS; i++) { /* the first place outside */
    low = high;
    high = most * i / SHARE_PARTS;
    y[axis] = x[axis] + sign * high * g->h;
    if (places_distance(p, y, NULL) >= 0) break;
    if (i == SHARE_PARTS) return most;
  }
  for (int i = 0; i < 50; i++) {
    double middle = 0.5 * (low + high);
    y[axis] = x[axis] + sign * middle * g->h;
    *(places_distance(p, y, NULL) < 0 ? &low : &high) = middle;
  }
  return 0.5 * (low + high);
}
