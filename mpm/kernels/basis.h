/* Weights along one axis: nodes from `first`, lane by lane, w and their derivatives d in 1/h; a basis of fewer than
 * four nodes has zero in the last lanes. s = (x - min)/h. theory 3.1 */
#include "mpm/kernels/rows.h"

#if defined IS_LINEAR
enum { N1 = 2 };
static const double moment = 0;
static inline int   axis_weights(double s, double half, ROW *w, ROW *d)
{
  (void)half;
  int c = (int)floor(s);
  *w = (ROW){1, 0, 0, 0} + (s - c) * (ROW){-1, 1, 0, 0};
  *d = (ROW){-1, 1, 0, 0};
  return c;
}
#elif defined IS_QUADRATIC
enum { N1 = 3 };
static const double moment = 0.25;
static inline int   axis_weights(double s, double half, ROW *w, ROW *d)
{
  (void)half;
  int c = (int)floor(s - 0.5);
  ROW t = (ROW){1.5, 1, 0.5, 0} - (s - c) * (ROW){1, 1, 1, 0}; /* s - c in [0.5, 1.5) */
  *w = (ROW){0, 0.75, 0, 0} + (ROW){0.5, -1, 0.5, 0} * t * t;
  *d = (ROW){-1, 2, -1, 0} * t;
  return c;
}
#elif defined IS_CUBIC
enum { N1 = 4 };
static const double moment = 1.0 / 3;
/* with t the distance from the cell's far or near end: t^3/6 outside, 2/3 - t^2 (1 - t/2) inside */
static inline int axis_weights(double s, double half, ROW *w, ROW *d)
{
  (void)half;
  int c = (int)floor(s);
  ROW t = (ROW){1, 0, 1, 0} + (s - c) * (ROW){-1, 1, -1, 1};
  *w = (ROW){0, 2.0 / 3, 2.0 / 3, 0} + t * t * ((ROW){0, -1, -1, 0} + (ROW){1.0 / 6, 0.5, 0.5, 1.0 / 6} * t);
  *d = t * ((ROW){0, -2, 2, 0} + (ROW){-0.5, 1.5, -1.5, 0.5} * t);
  return c - 1;
}
#elif defined IS_GIMP
/* uGIMP: the linear hat averaged over a point of fixed half width l, in h, at most 1/2. Bardenhagen and Kober 2004 */
enum { N1 = 3 };
static const double moment = 0;
static inline int   axis_weights(double s, double l, ROW *w, ROW *d)
{
  int      c = (int)floor(s - 0.5);
  ROW      z = (s - c) - (ROW){0, 1, 2, 3}, minus = ROW_OF(-1);
  ROW_MASK left = z < 0;
  ROW      sign = row_choose(left, minus, -minus), r = sign * z, q = (1 + l) - r;
  ROW_MASK near = r<l, flat = r <= 1 - l, inside = q> 0;
  q = row_choose(inside, q, ROW_OF(0));
  *w = row_choose(near, 1 - (z * z + l * l) / (2 * l), row_choose(flat, 1 - r, q * q / (4 * l)));
  *d = row_choose(near, -z / l, row_choose(flat, -sign, -sign * q / (2 * l)));
  return c;
}
#endif
