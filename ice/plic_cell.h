/* A plane in the unit cell in terms of its sorted normal, after Scardovelli and Zaleski 2000. Only for ice/plic*.c.
 * theory 4.9 */
#ifndef ICE_PLIC_CELL_H
#define ICE_PLIC_CELL_H

#include <math.h>
#include <stdbool.h>

/* |components| of a normal in rising order over their sum; in 2D lo = 0 */
struct sorted {
  double lo, mid, hi, sum;
};

static inline double lesser(double a, double b) { return a < b ? a : b; }
static inline double greater(double a, double b) { return a > b ? a : b; }

static inline struct sorted sort(const double normal[3])
{
  double x = fabs(normal[0]), y = fabs(normal[1]), z = fabs(normal[2]);
  double less = lesser(x, y), more = greater(x, y);
  double lo = lesser(less, z), mid = greater(less, lesser(more, z)), hi = greater(more, z), sum = hi + mid + lo;
  return (struct sorted){lo / sum, mid / sum, hi / sum, sum};
}

/* What the parts beyond the edges mid and hi take from the volume, over 1/(6 mid hi), or from the cut, over 1/(2 mid
 * hi). b and c are not larger than lo where the plane cuts them: the quotient is no amplifier, however small lo. */
static inline double tails(const struct sorted *m, double a, bool volume)
{
  double b = greater(0, a - m->mid), c = greater(0, a - m->hi);
  if (b == 0) return 0;
  return b / m->lo * b * (volume ? b : 1) + c / m->lo * c * (volume ? c : 1);
}

/* volume below the plane at a <= 1/2 from the corner, a in units of the offset */
static inline double below(const struct sorted *m, double a)
{
  if (a >= m->lo + m->mid) return (a - 0.5 * (m->lo + m->mid)) / m->hi;
  double scale = 6 * m->mid * m->hi;
  if (a < m->lo) return a / m->lo * a * a / scale;
  return (3 * a * (a - m->lo) + m->lo * m->lo - tails(m, a, true)) / scale;
}

/* d below / da = area of the cut, where it grows */
static inline double cut(const struct sorted *m, double a)
{
  if (a >= m->lo + m->mid) return 1 / m->hi;
  return (2 * a - m->lo - tails(m, a, false)) / (2 * m->mid * m->hi);
}

/* share of the cell at normal.x <= offset, x from its centre */
static inline double volume_of(const struct sorted *m, double offset)
{
  double a = 0.5 - fabs(offset) / m->sum, v = a > 0 ? below(m, a) : 0;
  return offset > 0 ? 1 - v : v;
}

/* The a that has v <= 1/2 below. Where the volume is a cubic with tails, Newton's method: the volume is convex there.
 */
static inline double distance(const struct sorted *m, double v)
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

/* the offset that leaves a share of the cell */
static inline double offset_of(const struct sorted *m, double volume)
{
  bool   more = volume > 0.5;
  double from_centre = m->sum * (0.5 - distance(m, greater(0, more ? 1 - volume : volume)));
  return more ? from_centre : -from_centre;
}

#endif
