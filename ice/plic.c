/* A plane in the unit cell: volume below, its inverse, slabs, centroid. theory 4.9 */
#include "ice/plic.h"

#include "ice/plic_cell.h"

void plic_normalise(double normal[3])
{
  double sum = sort(normal).sum;
  for (int d = 0; d < 3; d++) normal[d] /= sum;
}

double plic_volume(const double normal[3], double offset)
{
  struct sorted m = sort(normal);
  return volume_of(&m, offset);
}

double plic_offset(const double normal[3], double volume)
{
  struct sorted m = sort(normal);
  return offset_of(&m, volume);
}

double plic_slab(const struct plane *p, int axis, bool upper, double width)
{
  if (width <= 0) return 0;
  double normal[3] = {p->normal[0], p->normal[1], p->normal[2]}, shift = 0.5 * (1 - width) * normal[axis];
  normal[axis] *= width; /* the slab as a unit cell */
  return width * plic_volume(normal, p->offset + (upper ? -shift : shift));
}

/* share of liquid in the slice of the cell at x along an axis; rest: the normal without that axis */
static double slice(const double rest[3], double offset)
{
  if (rest[0] == 0 && rest[1] == 0 && rest[2] == 0) return offset > 0 ? 1 : 0;
  return plic_volume(rest, offset);
}

/* Integral of x slice(x): the slice is a quadratic between the x where the plane passes a corner of it, so that two
 * Gauss points between each two of them are exact. */
static double moment(const struct plane *p, int axis)
{
  double rest[3] = {p->normal[0], p->normal[1], p->normal[2]}, n = rest[axis];
  rest[axis] = 0;
  double b = fabs(rest[(axis + 1) % 3]), c = fabs(rest[(axis + 2) % 3]), total = 0;
  double corner[4] = {-0.5 * (b + c), -0.5 * fabs(b - c), 0.5 * fabs(b - c), 0.5 * (b + c)}, x[6] = {-0.5};
  for (int i = 0; i < 4; i++) {
    double at = n == 0 ? 0.5 : (p->offset - (n > 0 ? corner[3 - i] : corner[i])) / n;
    x[i + 1] = lesser(0.5, greater(-0.5, at));
  }
  x[5] = 0.5;
  for (int i = 0; i < 5; i++) {
    double middle = 0.5 * (x[i] + x[i + 1]), half = 0.5 * (x[i + 1] - x[i]);
    for (int side = -1; side <= 1; side += 2) {
      double at = middle + side * half / sqrt(3.0);
      total += half * at * slice(rest, p->offset - n * at);
    }
  }
  return total;
}

void plic_centroid(const struct plane *p, double centroid[3])
{
  double volume = plic_volume(p->normal, p->offset);
  for (int d = 0; d < 3; d++) centroid[d] = volume > 0 ? moment(p, d) / volume : 0;
}
