/* Consolidation of a column: against a table made with an independent series, against finite differences, and itself.
 * Column: H 1 m, E 10 MPa, nu 0.3, n 0.3, k 1e-3 m/s, 10 kPa. */
#include "tests/references/reference_test.h"

static const struct reference *terzaghi(void) { return reference_find("terzaghi"); }

static void *column(double bulk_modulus)
{
  void *prm = defaults(terzaghi());
  set(terzaghi(), prm, "young", 1e7);
  set(terzaghi(), prm, "poisson", 0.3);
  set(terzaghi(), prm, "porosity", 0.3);
  set(terzaghi(), prm, "permeability", 1e-3);
  set(terzaghi(), prm, "bulk_modulus", bulk_modulus);
  set(terzaghi(), prm, "height", 1.0);
  set(terzaghi(), prm, "load", 1e4);
  return prm;
}

static const double times[6] = {0.02, 0.05, 0.1, 0.2, 0.5, 1.0};

/* Rows z = 0 and 0.09 of the tables consolidation1d_p (water 2.2 GPa) and _incompressible_p: ten digits */
START_TEST(pressures)
{
  static const double at_base[2][6] = {{9981.665816, 9950.73625, 9478.335524, 7715.576236, 3709.354941, 1082.675732},
                                       {9999.988534, 9968.691955, 9493.053627, 7723.116069, 3707.774298, 1079.770444}};
  static const double above[2][6] = {{9981.624007, 9936.427026, 9418.841992, 7642.556058, 3672.354267, 1071.874588},
                                     {9999.94585, 9954.266992, 9433.343789, 7649.995867, 3670.789298, 1068.998285}};
  for (int water = 0; water < 2; water++) {
    void  *prm = column(water ? INFINITY : 2.2e9);
    double unit = terzaghi()->time_scale(prm);
    for (int i = 0; i < 6; i++) {
      CLOSE(value_at(terzaghi(), prm, "P", 0, 0, times[i] * unit), at_base[water][i], 2e-6);
      CLOSE(value_at(terzaghi(), prm, "P", 0, 0.09, times[i] * unit), above[water][i], 2e-6);
    }
    free(prm);
  }
}
END_TEST

/* consolidation1d_settlement */
START_TEST(settlements)
{
  static const double wanted[4][2] = {
      {0.001, 2.779530486e-05}, {0.05, 0.0001882789258}, {0.5, 0.0005674311333}, {1.0, 0.0006916555079}};
  void  *prm = column(2.2e9);
  double unit = terzaghi()->time_scale(prm);
  CLOSE(unit, 0.7287428571, 1e-10);
  CLOSE(scale_of(terzaghi(), prm, "P"), 9981.677, 1e-3);
  CLOSE(value_at(terzaghi(), prm, "p0", 0, 0, 0), 9981.677, 1e-3);
  for (int i = 0; i < 4; i++) {
    CLOSE(value_at(terzaghi(), prm, "settlement", 0, 0, wanted[i][0] * unit), wanted[i][1], 1e-13);
    CLOSE(value_at(terzaghi(), prm, "displacement_y", 0, 1, wanted[i][0] * unit), -wanted[i][1], 1e-13);
  }
  free(prm);
}
END_TEST

/* p_t = c p_yy on n cells, Crank and Nicolson, to the time t; p_0 = p0, 0 at the top face */
static void diffuse(int n, double c, double p0, double t, double *p)
{
  int    steps = 4000;
  double r = 0.5 * c * (t / steps) * n * n, *super = calloc((size_t)n, sizeof *super),
         *b = calloc((size_t)n, sizeof *b);
  for (int i = 0; i < n; i++) p[i] = p0;
  for (int k = 0; k < steps; k++) {
    /* two backward steps first, they calm the jump at the top */
    double w = k < 4 ? 2.0 : 1.0;
    for (int i = 0; i < n; i++) {
      double down = i > 0 ? p[i - 1] - p[i] : 0.0, up = i < n - 1 ? p[i + 1] - p[i] : -2.0 * p[i];
      double below = i > 0 ? -r * w : 0.0, above = i < n - 1 ? -r * w : 0.0;
      double diagonal = 1.0 + r * w * ((i > 0) + (i < n - 1 ? 1.0 : 2.0));
      double pivot = diagonal - (i > 0 ? below * super[i - 1] : 0.0);
      super[i] = above / pivot;
      b[i] = (p[i] + r * (2.0 - w) * (down + up) - (i > 0 ? below * b[i - 1] : 0.0)) / pivot;
    }
    for (int i = n - 1; i >= 0; i--) p[i] = b[i] - (i < n - 1 ? super[i] * p[i + 1] : 0.0);
  }
  free(super), free(b);
}

START_TEST(finite_differences)
{
  enum { N = 400 };
  void  *prm = column(2.2e9);
  double unit = terzaghi()->time_scale(prm), p[N];
  for (int k = 1; k < 6; k++) {
    diffuse(N, 1.3697118, 9981.677, times[k] * unit, p);
    for (int i = 0; i < N; i++) CLOSE(value_at(terzaghi(), prm, "P", 0, (i + 0.5) / N, times[k] * unit), p[i], 0.15);
  }
  free(prm);
}
END_TEST

/* Images serve early times, modes late ones: no step between them. And the settlement is the integral of the strain. */
START_TEST(consistent)
{
  void  *prm = column(2.2e9);
  double change = 0.1 / 1.3697118, M = 1e7 * 0.7 / (1.3 * 0.4);
  for (int i = 0; i <= 10; i++) {
    double before = value_at(terzaghi(), prm, "P", 0, 0.1 * i, change * (1 - 1e-12));
    CLOSE(value_at(terzaghi(), prm, "P", 0, 0.1 * i, change * (1 + 1e-6)), before, 0.05);
    CLOSE(value_at(terzaghi(), prm, "P", 0, 0.1 * i, change * (1 + 1e-12)), before, 1e-7);
  }
  for (int k = 0; k < 6; k++) {
    double t = times[k] * 0.7287428571, sum = 0.0;
    for (int i = 0; i < 2000; i++) sum -= value_at(terzaghi(), prm, "stress_yy", 0, (i + 0.5) / 2000, t) / M / 2000;
    CLOSE(value_at(terzaghi(), prm, "settlement", 0, 0, t), sum, 1e-9);
  }
  free(prm);
}
END_TEST

/* Grains of 0.1 mm, Kozeny-Carman A 180, water 998 kg/m3 and 2 GPa: k 2.997e-5 m/s, T_v = 1 after 24.27 s, p0 9979.8 Pa
 */
START_TEST(from_grains)
{
  void *prm = column(2e9);
  set(terzaghi(), prm, "permeability", 0.0);
  set(terzaghi(), prm, "grain_diameter", 1e-4);
  set(terzaghi(), prm, "density", 998);
  CLOSE(terzaghi()->time_scale(prm), 24.27, 5e-3);
  CLOSE(value_at(terzaghi(), prm, "p0", 0, 0, 0), 9979.8, 0.06);
  set(terzaghi(), prm, "grain_diameter", 0.0);
  const double x[1][3] = {{0}};
  double       v;
  ck_assert_int_eq(terzaghi()->value(prm, 0, 1, x, 1.0, &v), ERR_INPUT);
  free(prm);
}
END_TEST

/* Another base, and before the load: nothing but the undrained state */
START_TEST(edges)
{
  void *prm = column(2.2e9);
  set(terzaghi(), prm, "base", 2.0);
  CLOSE(value_at(terzaghi(), prm, "P", 0, 2.5, 0), 9981.677, 1e-3);
  ck_assert_double_eq(value_at(terzaghi(), prm, "P", 0, 3.0, 0), 0.0);
  CLOSE(value_at(terzaghi(), prm, "P", 0, 3.5, 0.1), 0.0, 1e-9);
  CLOSE(value_at(terzaghi(), prm, "base_pressure", 0, 0, 0.3643714286), 3709.354941, 1e-5);
  CLOSE(value_at(terzaghi(), prm, "displacement_y", 0, 2.0, 0.3), 0.0, 1e-15);
  free(prm);
}
END_TEST

RUN_TESTS("terzaghi", pressures, settlements, finite_differences, consistent, from_grains, edges)
