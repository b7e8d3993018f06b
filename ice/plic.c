/* A plane in the unit cell: volume below, its inverse, slabs, centroid. theory 4.9 */
#include "ice/plic.h"

#include <math.h>

/* |components| of a normal in rising order over their sum; in 2D lo = 0 */
struct sorted {
  double lo, mid, hi, sum;
};

static inline double lesser(double a, double b) { return a < b ? a : b; }
static inline double greater(double a, double b) { return a > b ? a : b; }

static struct sorted sort(const double normal[3])
{
  double x = fabs(normal[0]), y = fabs(normal[1]), z = fabs(normal[2]);
  double less = lesser(x, y), more = greater(x, y);
  double lo = lesser(less, z), mid = greater(less, lesser(more, z)), hi = greater(more, z), sum = hi + mid + lo;
  return (struct sorted){lo / sum, mid / sum, hi / sum, sum};
}

void plic_normalise(double normal[3])
{
  double sum = sort(normal).sum;
  for (int d = 0; d < 3; d++) normal[d] /= sum;
}

/* What the parts beyond the edges mid and hi take from the volume, over 1/(6 mid hi), or from the cut, over 1/(2 mid
 * hi). b and c are not larger than lo where the plane cuts them: the quotient is no amplifier, however small lo. */
static double tails(const struct sorted *m, double a, bool volume)
{
  double b = greater(0, a - m->mid), c = greater(0, a - m->hi);
  if (b == 0) return 0;
  return b / m->lo * b * (volume ? b : 1) + c / m->lo * c * (volume ? c : 1);
}

/* volume below the plane at a <= 1/2 from the corner, a in units of the offset */
static double below(const struct sorted *m, double a)
{
  if (a >= m->lo + m->mid) return (a - 0.5 * (m->lo + m->mid)) / m->hi;
  double scale = 6 * m->mid * m->hi;
  if (a < m->lo) return a / m->lo * a * a / scale;
  return (3 * a * (a - m->lo) + m->lo * m->lo - tails(m, a, true)) / scale;
}

/* d below / da = area of the cut */
static double cut(const struct sorted *m, double a)
{
  if (a >= m->lo + m->mid) return 1 / m->hi;
  return (2 * a - m->lo - tails(m, a, false)) / (2 * m->mid * m->hi);
}

double plic_volume(const double normal[3], double offset)
{
  struct sorted m = sort(normal);
  double        a = 0.5 - fabs(offset) / m.sum, v = a > 0 ? below(&m, a) : 0;
  return offset > 0 ? 1 - v : v;
}

/* The a that has v <= 1/2 below. Where the volume is a cubic with tails, Newton's method: the volume is convex there.
 */
static double distance(const struct sorted *m, double v)
{
  double flat = m->hi * v + 0.5 * (m->lo + m->mid), scaled = 6 * m->mid * m->hi * v;
  if (flat >= m->lo + m->mid) return flat;
  if (scaled < m->lo * m->lo) return cbrt(scaled * m->lo);
  double a = 0.5 * m->lo + sqrt(scaled / 3 - m->lo * m->lo / 12), change = a > m->mid ? 1 : 0;
  for (int i = 0; i < 20 && fabs(change) > 1e-15; i++) {
    change = (below(m, a) - v) / cut(m, a);
    a = lesser(0.5, a - change);
  }
  return a;
}

double plic_offset(const double normal[3], double volume)
{
  struct sorted m = sort(normal);
  bool          more = volume > 0.5;
  double        from_centre = m.sum * (0.5 - distance(&m, greater(0, more ? 1 - volume : volume)));
  return more ? from_centre : -from_centre;
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
