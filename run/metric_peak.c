/* The peak of a series that rings: the maximum of the cubic through its samples by least squares. */
#include "run/metric_parts.h"

#include <math.h>

enum { TERMS = 4 };

/* A c = b by elimination, A symmetric and positive: no pivots; false: too few samples */
static bool eliminate(double A[TERMS][TERMS], double b[TERMS], double c[TERMS])
{
  for (int i = 0; i < TERMS; i++) {
    if (!(A[i][i] > 1e-12 * A[0][0])) return false;
    for (int j = i + 1; j < TERMS; j++) {
      double factor = A[j][i] / A[i][i];
      for (int k = i; k < TERMS; k++) A[j][k] -= factor * A[i][k];
      b[j] -= factor * b[i];
    }
  }
  for (int i = TERMS - 1; i >= 0; i--) {
    c[i] = b[i] / A[i][i];
    for (int k = i + 1; k < TERMS; k++) c[i] -= A[i][k] * c[k] / A[i][i];
  }
  return true;
}

/* coefficients of the powers of s, -1 to 1 over the span */
static bool fit(long n, const double *t, const double *v, double c[TERMS])
{
  double A[TERMS][TERMS] = {{0}}, b[TERMS] = {0};
  for (long i = 0; i < n && n >= TERMS; i++) {
    double s = 2 * (t[i] - t[0]) / (t[n - 1] - t[0]) - 1, power[TERMS] = {1, s, s * s, s * s * s};
    for (int j = 0; j < TERMS; j++) {
      b[j] += power[j] * v[i];
      for (int k = 0; k < TERMS; k++) A[j][k] += power[j] * power[k];
    }
  }
  return eliminate(A, b, c);
}

static double cubic(const double c[TERMS], double s) { return c[0] + s * (c[1] + s * (c[2] + s * c[3])); }

/* where the cubic has its maximum inside; NAN: it has none there */
static double summit(const double c[TERMS])
{
  double root = c[2] * c[2] - 3 * c[1] * c[3]; /* c1 + 2 c2 s + 3 c3 s^2 = 0 with a negative second derivative */
  double s = root > 0 ? c[1] / (-c[2] + sqrt(root)) : NAN;
  return fabs(s) <= 1 ? s : NAN;
}

enum status metric_of_peak(const struct compiled_metric *m, long n, const double *t, const double *v, double *at,
                           double *value)
{
  double c[TERMS], s = fit(n, t, v, c) ? summit(c) : NAN;
  if (isnan(s))
    return FAIL(ERR_INPUT, "metrics.%s: %s has no peak inside %g s to %g s; move \"from\" and \"to\"", m->metric->name,
                m->metric->gauge, m->from, m->to);
  *at = t[0] + 0.5 * (s + 1) * (t[n - 1] - t[0]);
  *value = cubic(c, s);
  return OK;
}
