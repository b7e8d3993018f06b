/* Pressed cylinder: tables made by an inversion of the Laplace transform and by a series elsewhere, Biot's equations by
 * differences, and finite volumes in radius and time. R 1 m, E 10 MPa, n 0.3, k 1e-3 m/s, 10 kPa. */
#include "tests/references/reference_test.h"

static const struct reference *cylinder(void) { return reference_find("cryer_cylinder"); }

static void *pressed(double poisson, double bulk_modulus)
{
  void *prm = defaults(cylinder());
  set(cylinder(), prm, "young", 1e7);
  set(cylinder(), prm, "poisson", poisson);
  set(cylinder(), prm, "porosity", 0.3);
  set(cylinder(), prm, "permeability", 1e-3);
  set(cylinder(), prm, "bulk_modulus", bulk_modulus);
  set(cylinder(), prm, "radius", 1);
  set(cylinder(), prm, "load", 1e4);
  return prm;
}

static double at(const void *prm, const char *quantity, double r, double t)
{
  return value_at(cylinder(), prm, quantity, 0.6 * r, -0.8 * r, t);
}

/* nu 0.3, water 2.2 GPa: T_v; in the middle p/P, effective and total radial pressure over P */
START_TEST(centre)
{
  static const double rows[8][4] = {{0.001, 1.019043596, 0.001336158561, 1.020379754},
                                    {0.002755099784, 1.032502274, 0.001353805429, 1.033856079},
                                    {0.007124691797, 1.053108388, 0.001380823935, 1.054489212},
                                    {0.0184244627, 1.086200712, 0.001426002661, 1.087626714},
                                    {0.04764568565, 1.128416719, 0.008973224249, 1.137389943},
                                    {0.1156494968, 0.9819048722, 0.1670181129, 1.148922985},
                                    {0.2990697562, 0.4458104632, 0.6244567968, 1.07026726},
                                    {2, 0.000207029004, 0.9998256151, 1.000032644}};
  void               *prm = pressed(0.3, 2.2e9);
  double              unit = cylinder()->time_scale(prm);
  CLOSE(unit, 0.7287428571, 1e-10);
  CLOSE(at(prm, "p0", 0, 0), 9986.9053, 5e-5);
  for (int i = 0; i < 8; i++) {
    double t = rows[i][0] * unit;
    CLOSE(at(prm, "centre_P", 9, t), 1e4 * rows[i][1], 2e-5);
    CLOSE(at(prm, "P", 0, t), 1e4 * rows[i][1], 2e-5);
    CLOSE(at(prm, "centre_stress_r", 9, t), -1e4 * rows[i][2], 2e-5);
    CLOSE(at(prm, "stress_r_total", 0, t), -1e4 * rows[i][3], 2e-5);
  }
  free(prm);
}
END_TEST

/* p/p0 over r at five times */
START_TEST(radial)
{
  static const double times[5] = {0.01, 0.02, 0.05, 0.1, 0.5};
  static const double rows[5][5] = {{1.064566644, 1.091280668, 1.130313272, 1.035834189, 0.1803570584},
                                    {1.064566609, 1.091141088, 1.114765042, 0.9938018324, 0.1708531743},
                                    {1.064531512, 1.086869227, 1.043515537, 0.8630969578, 0.1436126463},
                                    {1.058410903, 1.029889137, 0.8511615704, 0.6391032385, 0.102260132},
                                    {0.8823326081, 0.7143721521, 0.4855400185, 0.336580273, 0.05223702701}};
  void               *prm = pressed(0.3, 2.2e9);
  double              unit = cylinder()->time_scale(prm), p0 = scale_of(cylinder(), prm, "P");
  for (int k = 0; k < 5; k++) {
    for (int i = 0; i < 5; i++) CLOSE(at(prm, "P", 0.2 * i, times[k] * unit), p0 * rows[i][k], 2e-5);
    CLOSE(at(prm, "P", 1, times[k] * unit), 0, 1e-8);
  }
  free(prm);
}
END_TEST

/* incompressible liquid: nu, T_v, p/P and effective radial pressure in the middle, six digits */
START_TEST(other_soils)
{
  static const double rows[6][4] = {{0.1, 0.03, 1.182546, 0.000273}, {0.1, 0.06, 1.230722, 0.017944},
                                    {0.2, 0.05, 1.182255, 0.008611}, {0.2, 0.5, 0.230032, 0.817087},
                                    {0.4, 0.001, 1.011836, 0},       {0.4, 0.2, 0.602839, 0.453063}};
  for (int i = 0; i < 6; i++) {
    void  *prm = pressed(rows[i][0], INFINITY);
    double t = rows[i][1] * cylinder()->time_scale(prm);
    CLOSE(at(prm, "centre_P", 0, t), 1e4 * rows[i][2], 6e-3);
    CLOSE(at(prm, "centre_stress_r", 0, t), -1e4 * rows[i][3], 6e-3);
    CLOSE(at(prm, "p0", 0, 0), 1e4, 1e-9);
    free(prm);
  }
}
END_TEST

/* highest p/p0 in the middle with water of 2.2 GPa, and when; storage takes 0.0002 off */
START_TEST(peaks)
{
  static const double rows[4][3] = {
      {0.1, 1.2305, 0.0604}, {0.2, 1.1838, 0.0560}, {0.3, 1.13033, 0.05066}, {0.4, 1.0687, 0.0434}};
  for (int i = 0; i < 4; i++) {
    void  *prm = pressed(rows[i][0], 2.2e9);
    double unit = cylinder()->time_scale(prm), time = at(prm, "peak_time", 0, 0), peak = at(prm, "peak", 0, 0);
    CLOSE(at(prm, "peak_over_p0", 0, 0), rows[i][1], 5e-5);
    CLOSE(time / unit, rows[i][2], 5e-5);
    CLOSE(at(prm, "centre_P", 0, time), peak, 1e-9);
    ck_assert_double_lt(at(prm, "centre_P", 0, 0.98 * time), peak);
    ck_assert_double_lt(at(prm, "centre_P", 0, 1.02 * time), peak);
    free(prm);
  }
}
END_TEST

/* derivative along r */
static double slope(const void *prm, const char *q, double r, double t)
{
  double h = 1e-3, near = at(prm, q, r + h, t) - at(prm, q, r - h, t);
  return (8 * near - at(prm, q, r + 2 * h, t) + at(prm, q, r - 2 * h, t)) / (12 * h);
}

static double rate(const void *prm, const char *q, double r, double t)
{
  double h = 1e-4 * t;
  return (at(prm, q, r, t + h) - at(prm, q, r, t - h)) / (2 * h);
}

/* volume change u_r + u/r */
static double dilation(const void *prm, double r, double t)
{
  return slope(prm, "displacement_r", r, t) + at(prm, "displacement_r", r, t) / r;
}

/* its rate, 1/s */
static double swelling(const void *prm, double r, double t)
{
  double h = 1e-4 * t;
  return (dilation(prm, r, t + h) - dilation(prm, r, t - h)) / (2 * h);
}

/* Hooke, equilibrium, volume balance: sigma' = M u_r + lambda u/r, tangential lambda u_r + M u/r;
 * (sigma' - p)_r + (sigma' - sigma'_t)/r = 0; (n/K) p_t + (div u)_t = (k/rho g) (p_rr + p_r/r) */
START_TEST(biot)
{
  void  *prm = pressed(0.2, 1e8);
  double M = 1e7 * 0.8 / (1.2 * 0.6), lambda = M * 0.2 / 0.8, unit = cylinder()->time_scale(prm);
  for (int k = 0; k < 3; k++)
    for (double r = 0.15; r < 0.96; r += 0.1) {
      double t = unit * (k == 0 ? 0.02 : k == 1 ? 0.1 : 0.5), h = 2e-3;
      double stretch = slope(prm, "displacement_r", r, t), hoop = at(prm, "displacement_r", r, t) / r;
      double radial = M * stretch + lambda * hoop, around = lambda * stretch + M * hoop;
      CLOSE(at(prm, "stress_r", r, t), radial, 1e-4);
      CLOSE(at(prm, "stress_r_total", r, t), radial - at(prm, "P", r, t), 1e-4);
      CLOSE(slope(prm, "stress_r_total", r, t) + (radial - around) / r, 0, 1e-2);
      double bend = (slope(prm, "P", r + h, t) - slope(prm, "P", r - h, t)) / (2 * h);
      double in = 1e-3 / 9810 * (bend + slope(prm, "P", r, t) / r);
      CLOSE(3e-9 * rate(prm, "P", r, t) + swelling(prm, r, t), in, 1e-6);
      CLOSE(at(prm, "stress_r_total", 1, t), -1e4, 1e-5);
      CLOSE(at(prm, "rim", 0, t), at(prm, "displacement_r", 1, t), 1e-12);
    }
  free(prm);
}
END_TEST

/* N rings of equal width, backward steps: S p_t + ((p + C)/M)_t = (k/rho g) lap p, C (1 - G/M) = (G/M) mean p - q. The
 * system is the diffusion's plus one column: two solutions of it. Returns p [N] over q. */
static void rings(int n, double M, double G, double S, double k, double t, int steps, double *p)
{
  double *super = calloc((size_t)n, sizeof *super), *one = calloc((size_t)n, sizeof *one), dt = t / steps;
  double shear = G / M, share = 1 / (1 + M * S), C = -1 / ((1 - shear) + shear * share), D = dt * k * M * share * n * n;
  for (int i = 0; i < n; i++) p[i] = -share * C; /* undrained */
  for (int step = 0; step < steps; step++) {
    for (int way = 0; way < 2; way++) /* right-hand sides: old p + share C; 1 */
      for (int i = 0; i < n; i++) {
        double in = D * i / (i + 0.5), out = D * (i + 1) / (i + 0.5) * (i < n - 1 ? 1 : 2), *x = way ? one : p;
        double pivot = 1 + in + out - (i > 0 ? in * super[i - 1] : 0);
        if (way == 0) super[i] = (i < n - 1 ? out : 0) / pivot;
        pivot = way == 0 ? pivot : 1 + in + out - (i > 0 ? in * super[i - 1] : 0);
        x[i] = ((way ? 1 : p[i] + share * C) + (i > 0 ? in * x[i - 1] : 0)) / pivot;
      }
    for (int way = 0; way < 2; way++)
      for (int i = n - 2; i >= 0; i--) (way ? one : p)[i] += super[i] * (way ? one : p)[i + 1];
    double mean_p = 0, mean_one = 0; /* new p is p - share C one */
    for (int i = 0; i < n; i++) {
      mean_p += p[i] * (2 * i + 1) / n / n;
      mean_one += one[i] * (2 * i + 1) / n / n;
    }
    C = (shear * mean_p - 1) / (1 - shear + shear * share * mean_one);
    for (int i = 0; i < n; i++) p[i] -= share * C * one[i];
  }
  free(super), free(one);
}

START_TEST(finite_volumes)
{
  enum { N = 100 };
  void  *prm = pressed(0.3, 1e8);
  double M = 1e7 * 0.7 / (1.3 * 0.4), p[N], unit = cylinder()->time_scale(prm);
  for (int k = 0; k < 3; k++) {
    double t = unit * (k == 0 ? 0.02 : k == 1 ? 0.06 : 0.3);
    rings(N, M, 1e7 / 2.6, 3e-9, 1e-3 / 9810, t, 4000, p);
    for (int i = 0; i < N; i += 3) CLOSE(at(prm, "P", (i + 0.5) / N, t), 1e4 * p[i], 6);
  }
  free(prm);
}
END_TEST

/* before and just after the load: p0 everywhere but at the rim, no volume change without storage; another place; no
 * soil */
START_TEST(edges)
{
  void        *prm = pressed(0.3, INFINITY);
  const double x[1][3] = {{0}};
  double       v;
  CLOSE(at(prm, "P", 0.5, 0), 1e4, 1e-9);
  ck_assert_double_eq(at(prm, "P", 1, 0), 0);
  CLOSE(at(prm, "rim", 0, 0), 0, 1e-17);
  CLOSE(at(prm, "stress_r", 0.5, 0), 0, 1e-9);
  CLOSE(at(prm, "P", 0.5, 1e-6), 1e4, 15);
  CLOSE(at(prm, "rim", 0, 10), -scale_of(cylinder(), prm, "rim"), 1e-12);
  set(cylinder(), prm, "centre", 0.5);
  CLOSE(value_at(cylinder(), prm, "P", 0.5, 0, 0.02), at(prm, "centre_P", 0, 0.02), 1e-9);
  set(cylinder(), prm, "permeability", 0);
  ck_assert_int_eq(cylinder()->value(prm, 0, 1, x, 1.0, &v), ERR_INPUT);
  free(prm);
}
END_TEST

RUN_TESTS("cryer_cylinder", centre, radial, other_soils, peaks, biot, finite_volumes, edges)
