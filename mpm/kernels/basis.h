/* Weights along one axis: N1 nodes from `first`, w and their derivatives d in 1/h. s = (x - min)/h. theory 3.1 */
#if defined IS_LINEAR
enum { N1 = 2 };
static const double moment = 0;
static inline int   axis_weights(double s, double half, double *w, double *d)
{
  (void)half;
  int    c = (int)floor(s);
  double a = s - c;
  w[0] = 1 - a;
  w[1] = a;
  d[0] = -1;
  d[1] = 1;
  return c;
}
#elif defined IS_QUADRATIC
enum { N1 = 3 };
static const double moment = 0.25;
static inline int   axis_weights(double s, double half, double *w, double *d)
{
  (void)half;
  int    c = (int)floor(s - 0.5);
  double a = s - c; /* in [0.5, 1.5) */
  w[0] = 0.5 * (1.5 - a) * (1.5 - a);
  w[1] = 0.75 - (a - 1) * (a - 1);
  w[2] = 0.5 * (a - 0.5) * (a - 0.5);
  d[0] = a - 1.5;
  d[1] = -2 * (a - 1);
  d[2] = a - 0.5;
  return c;
}
#elif defined IS_CUBIC
enum { N1 = 4 };
static const double moment = 1.0 / 3;
static inline int   axis_weights(double s, double half, double *w, double *d)
{
  (void)half;
  int    c = (int)floor(s);
  double a = s - c, b = 1 - a;
  w[0] = b * b * b / 6;
  w[1] = 2.0 / 3 - a * a * (1 - 0.5 * a);
  w[2] = 2.0 / 3 - b * b * (1 - 0.5 * b);
  w[3] = a * a * a / 6;
  d[0] = -0.5 * b * b;
  d[1] = a * (1.5 * a - 2);
  d[2] = b * (2 - 1.5 * b);
  d[3] = 0.5 * a * a;
  return c - 1;
}
#elif defined IS_GIMP
/* uGIMP: the linear hat averaged over a point of fixed half width l, in h, at most 1/2. Bardenhagen and Kober 2004 */
enum { N1 = 3 };
static const double moment = 0;
static inline int   axis_weights(double s, double l, double *w, double *d)
{
  int c = (int)floor(s - 0.5);
  for (int k = 0; k < 3; k++) {
    double z = s - c - k, r = fabs(z), sign = z < 0 ? -1 : 1;
    if (r < l) {
      w[k] = 1 - (z * z + l * l) / (2 * l);
      d[k] = -z / l;
    } else if (r <= 1 - l) {
      w[k] = 1 - r;
      d[k] = -sign;
    } else {
      double q = r < 1 + l ? 1 + l - r : 0;
      w[k] = q * q / (4 * l);
      d[k] = -sign * q / (2 * l);
    }
  }
  return c;
}
#endif
