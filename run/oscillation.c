/* Least squares for one damped oscillation over a linear trend: a scan of undamped frequencies finds the start, a
 * damped Gauss-Newton iteration (Levenberg 1944, Marquardt 1963) the minimum. */
#include "run/oscillation.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* unknowns, in units of the span: constant, slope, cosine, sine, angular frequency, decay */
enum { C, D, A, B, W, L, UNKNOWNS, LINEAR = W };
enum { SAMPLES_LEAST = 16, SCAN_PER_CYCLE = 4, CYCLES_MOST = 400, ROUNDS = 300 };

struct series {
  long          n;
  const double *t, *v;
  double        start, span;
};

static double place(const struct series *s, long i) { return (s->t[i] - s->start) / s->span; }

/* Hann's window; the offset keeps the end samples alive */
static double window(double x) { return 0.5 - 0.5 * cos(2 * M_PI * x) + 1e-6; }

/* gradient of the model at x by its unknowns, and the model itself */
static double model(const double p[UNKNOWNS], double x, double g[UNKNOWNS])
{
  double e = exp(-p[L] * x), c = e * cos(p[W] * x), s = e * sin(p[W] * x), wave = p[A] * c + p[B] * s;
  g[C] = 1, g[D] = x, g[A] = c, g[B] = s;
  g[W] = x * (p[B] * c - p[A] * s), g[L] = -x * wave;
  return p[C] + p[D] * x + wave;
}

/* Gaussian elimination with pivoting, n <= UNKNOWNS; false: singular */
static bool solve(int n, double m[UNKNOWNS][UNKNOWNS], double b[UNKNOWNS])
{
  for (int k = 0; k < n; k++) {
    int pivot = k;
    for (int i = k + 1; i < n; i++)
      if (fabs(m[i][k]) > fabs(m[pivot][k])) pivot = i;
    if (m[pivot][k] == 0) return false;
    for (int j = 0; j < n; j++) {
      double swap = m[k][j];
      m[k][j] = m[pivot][j], m[pivot][j] = swap;
    }
    double swap = b[k];
    b[k] = b[pivot], b[pivot] = swap;
    for (int i = 0; i < n; i++) {
      double f = i == k ? 0 : m[i][k] / m[k][k];
      for (int j = k; j < n; j++) m[i][j] -= f * m[k][j];
      b[i] -= f * b[k];
    }
  }
  for (int k = 0; k < n; k++) b[k] /= m[k][k];
  return true;
}

/* Normal equations of the first n unknowns at p; returns the weighted sum of squared residuals. */
static double normal(const struct series *s, const double p[UNKNOWNS], int n, double m[UNKNOWNS][UNKNOWNS],
                     double b[UNKNOWNS])
{
  double sum = 0, g[UNKNOWNS];
  memset(m, 0, sizeof(double[UNKNOWNS][UNKNOWNS]));
  memset(b, 0, sizeof(double[UNKNOWNS]));
  for (long k = 0; k < s->n; k++) {
    double x = place(s, k), w = window(x), r = s->v[k] - model(p, x, g);
    sum += w * r * r;
    for (int i = 0; i < n; i++) {
      b[i] += w * g[i] * r;
      for (int j = 0; j < n; j++) m[i][j] += w * g[i] * g[j];
    }
  }
  return sum;
}

/* Best linear unknowns for the frequency and decay in p; returns the sum of squares they leave. */
static double fit_linear(const struct series *s, double p[UNKNOWNS])
{
  double m[UNKNOWNS][UNKNOWNS], b[UNKNOWNS];
  for (int i = 0; i < LINEAR; i++) p[i] = 0;
  normal(s, p, LINEAR, m, b);
  if (!solve(LINEAR, m, b)) return INFINITY;
  for (int i = 0; i < LINEAR; i++) p[i] = b[i];
  return normal(s, p, 0, m, b);
}

/* the undamped frequency that explains most, from one oscillation per span to a quarter of the sampling rate */
static double scan(const struct series *s, double best[UNKNOWNS])
{
  double least = INFINITY, cycles = fmin(0.25 * s->n, CYCLES_MOST);
  for (int k = SCAN_PER_CYCLE; k <= cycles * SCAN_PER_CYCLE; k++) {
    double p[UNKNOWNS] = {[W] = 2 * M_PI * k / SCAN_PER_CYCLE}, left = fit_linear(s, p);
    if (left < least) least = left, memcpy(best, p, sizeof p);
  }
  return least;
}

static void refine(const struct series *s, double p[UNKNOWNS], double least)
{
  double damping = 1e-3;
  for (int round = 0; round < ROUNDS && damping < 1e12; round++) {
    double m[UNKNOWNS][UNKNOWNS], step[UNKNOWNS], q[UNKNOWNS], unused[UNKNOWNS][UNKNOWNS], left;
    normal(s, p, UNKNOWNS, m, step);
    for (int i = 0; i < UNKNOWNS; i++) m[i][i] *= 1 + damping;
    bool solved = solve(UNKNOWNS, m, step);
    for (int i = 0; i < UNKNOWNS; i++) q[i] = p[i] + step[i];
    left = solved ? normal(s, q, 0, unused, step) : INFINITY;
    damping *= left <= least ? 0.2 : 5;
    if (!(left <= least)) continue;
    bool converged = least - left <= 1e-15 * least;
    least = left;
    memcpy(p, q, sizeof q);
    if (converged) return;
  }
}

enum status oscillation_fit(long n, const double *t, const double *v, double *frequency, double *decay)
{
  struct series s = {n, t, v, n > 0 ? t[0] : 0, n > 0 ? t[n - 1] - t[0] : 0};
  double        p[UNKNOWNS] = {0}, least;
  if (n < SAMPLES_LEAST || !(s.span > 0))
    return FAIL(ERR_INPUT, "frequency: %ld samples in the span are fewer than %d; lower output.gauge_interval", n,
                SAMPLES_LEAST);
  least = scan(&s, p);
  if (!isfinite(least))
    return FAIL(ERR_INPUT, "frequency: the samples from %g s to %g s are not finite", t[0], t[n - 1]);
  refine(&s, p, least);
  if (!(fabs(p[W]) >= M_PI))
    return FAIL(ERR_INPUT, "frequency: less than one oscillation from %g s to %g s; lengthen the span", t[0], t[n - 1]);
  *frequency = fabs(p[W]) / s.span / (2 * M_PI);
  *decay = p[L] / s.span;
  return OK;
}
