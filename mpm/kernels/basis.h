/* Weights along one axis, lane by lane, and their derivatives d in 1/h. a: place of the point, in h, from the node that
 * is nearest (quadratic, GIMP) or below (linear, cubic); a + SHIFT is in [0, 1). FIRST: the first node from that one. A
 * basis of fewer than four nodes has zero in the last lanes. theory 3.1 */
#include "mpm/kernels/rows.h"

#if defined IS_LINEAR
enum { N1 = 2, FIRST = 0 };
static const double SHIFT = 0, moment = 0;
static inline void  axis_weights(double a, double half, ROW *w, ROW *d)
{
  (void)half;
  *w = (ROW){1, 0, 0, 0} + a * (ROW){-1, 1, 0, 0};
  *d = (ROW){-1, 1, 0, 0};
}
#elif defined IS_QUADRATIC
enum { N1 = 3, FIRST = -1 };
static const double SHIFT = 0.5, moment = 0.25;
static inline void  axis_weights(double a, double half, ROW *w, ROW *d)
{
  (void)half;
  ROW t = (ROW){0.5, 0, -0.5, 0} - a * (ROW){1, 1, 1, 0};
  *w = (ROW){0, 0.75, 0, 0} + (ROW){0.5, -1, 0.5, 0} * t * t;
  *d = (ROW){-1, 2, -1, 0} * t;
}
#elif defined IS_CUBIC
enum { N1 = 4, FIRST = -1 };
static const double SHIFT = 0, moment = 1.0 / 3;
/* with t the distance from the cell's far or near end: t^3/6 outside, 2/3 - t^2 (1 - t/2) inside */
static inline void axis_weights(double a, double half, ROW *w, ROW *d)
{
  (void)half;
  ROW t = (ROW){1, 0, 1, 0} + a * (ROW){-1, 1, -1, 1};
  *w = (ROW){0, 2.0 / 3, 2.0 / 3, 0} + t * t * ((ROW){0, -1, -1, 0} + (ROW){1.0 / 6, 0.5, 0.5, 1.0 / 6} * t);
  *d = t * ((ROW){0, -2, 2, 0} + (ROW){-0.5, 1.5, -1.5, 0.5} * t);
}
#elif defined IS_GIMP
enum { N1 = 3, FIRST = -1 };
static const double SHIFT = 0.5, moment = 0;
/* uGIMP: the linear hat averaged over a point of fixed half width l, in h, at most 1/2. Bardenhagen and Kober 2004 */
static inline void axis_weights(double a, double l, ROW *w, ROW *d)
{
  ROW      z = a - (ROW){-1, 0, 1, 2}, minus = ROW_OF(-1);
  ROW_MASK left = z < 0;
  ROW      sign = row_choose(left, minus, -minus), r = sign * z, q = (1 + l) - r;
  ROW_MASK near = r<l, flat = r <= 1 - l, inside = q> 0;
  q = row_choose(inside, q, ROW_OF(0));
  *w = row_choose(near, 1 - (z * z + l * l) / (2 * l), row_choose(flat, 1 - r, q * q / (4 * l)));
  *d = row_choose(near, -z / l, row_choose(flat, -sign, -sign * q / (2 * l)));
}
#endif
