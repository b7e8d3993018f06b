/* Standing wave: its period, and by differences what it must obey: no sources, no curl, Euler's equations, the
 * conditions at surface, floor and walls, and its energies. Box 1 m, depth 0.5 m, 1 cm. */
#include "tests/references/reference_test.h"

static const struct reference *slosh(void) { return reference_find("slosh"); }

static void *basin(void)
{
  void *prm = defaults(slosh());
  set(slosh(), prm, "depth", 0.5);
  set(slosh(), prm, "length", 1);
  set(slosh(), prm, "amplitude", 0.01);
  return prm;
}

static double at(const void *prm, const char *quantity, double x, double y, double t)
{
  return value_at(slosh(), prm, quantity, x, y, t);
}

/* omega^2 = g pi tanh(pi/2); shallow: sqrt(g d) k, deep: sqrt(g k) */
START_TEST(period)
{
  void *prm = basin();
  CLOSE(at(prm, "period", 0, 0, 0), 1.18182, 5e-6);
  CLOSE(slosh()->time_scale(prm), 1.18182, 5e-6);
  CLOSE(at(prm, "frequency", 0, 0, 0) * at(prm, "period", 0, 0, 0), 1, 1e-15);
  set(slosh(), prm, "depth", 1e-4);
  CLOSE(at(prm, "angular_frequency", 0, 0, 0), M_PI * sqrt(9.81e-4), 1e-7);
  set(slosh(), prm, "depth", 1e6);
  CLOSE(at(prm, "angular_frequency", 0, 0, 0), sqrt(9.81 * M_PI), 1e-14);
  CLOSE(at(prm, "vel_y", 0, 1e6 - 1, 0.1) / at(prm, "vel_y", 0, 1e6, 0.1), exp(-M_PI), 1e-9);
  set_word(slosh(), prm, "mode", "4");
  CLOSE(at(prm, "angular_frequency", 0, 0, 0), sqrt(9.81 * 4 * M_PI), 1e-14);
  free(prm);
}
END_TEST

/* d = 0, 1, 2: along x, y, t */
static double slope(const void *prm, const char *q, double x, double y, double t, int d)
{
  double h = 1e-3, s[4];
  for (int i = 0; i < 4; i++) {
    double a = h * (i < 2 ? i - 2 : i - 1);
    s[i] = at(prm, q, x + (d == 0) * a, y + (d == 1) * a, t + (d == 2) * a);
  }
  return (s[0] - 8 * s[1] + 8 * s[2] - s[3]) / (12 * h);
}

START_TEST(equations)
{
  for (int mode = 1; mode <= 3; mode++) {
    void *prm = basin();
    set(slosh(), prm, "wall", -0.3);
    set(slosh(), prm, "floor", 0.2);
    set_word(slosh(), prm, "mode", mode == 1 ? "1" : mode == 2 ? "2" : "3");
    for (int i = 0; i < 12; i++) {
      double x = -0.3 + i / 11.0, y = 0.2 + 0.5 * (i * 5 % 12) / 11.0, t = 0.13 * i;
      CLOSE(slope(prm, "vel_x", x, y, t, 0) + slope(prm, "vel_y", x, y, t, 1), 0, 1e-9);
      CLOSE(slope(prm, "vel_x", x, y, t, 1) - slope(prm, "vel_y", x, y, t, 0), 0, 1e-9);
      CLOSE(1000 * slope(prm, "vel_x", x, y, t, 2) + slope(prm, "P", x, y, t, 0), 0, 1e-6);
      CLOSE(1000 * slope(prm, "vel_y", x, y, t, 2) + slope(prm, "P", x, y, t, 1), -9810, 1e-6);
      CLOSE(at(prm, "vel_y", x, 0.7, t), slope(prm, "elevation", x, 0.7, t, 2), 1e-9);
      CLOSE(at(prm, "P", x, 0.7, t), 9810 * at(prm, "elevation", x, 0.7, t), 1e-11);
      CLOSE(at(prm, "vel_y", x, 0.2, t), 0, 1e-17);
      CLOSE(at(prm, "vel_x", -0.3, y, t), 0, 1e-17);
      CLOSE(at(prm, "vel_x", 0.7, y, t), 0, 1e-16);
    }
    free(prm);
  }
}
END_TEST

/* kinetic and potential energy by sums over the depth and the length */
START_TEST(energies)
{
  enum { N = 100 };
  void *prm = basin();
  for (double t = 0; t < 1; t += 0.19) {
    double kinetic = 0, potential = 0;
    for (int i = 0; i < N; i++) {
      double x = (i + 0.5) / N, eta = at(prm, "elevation", x, 0, t);
      potential += 0.5 * 9810 * eta * eta / N;
      for (int j = 0; j < N; j++) {
        double y = 0.5 * (j + 0.5) / N, u = at(prm, "vel_x", x, y, t), v = at(prm, "vel_y", x, y, t);
        kinetic += 0.5 * 1000 * (u * u + v * v) * 0.5 / (N * N);
      }
    }
    CLOSE(at(prm, "kinetic", 0, 0, t), kinetic, 1e-4 * 0.24525);
    CLOSE(at(prm, "potential", 0, 0, t), potential, 1e-12);
    CLOSE(at(prm, "kinetic", 0, 0, t) + at(prm, "potential", 0, 0, t), 0.24525, 1e-14);
  }
  free(prm);
}
END_TEST

/* work of viscous stress of this flow, 2 mu e:e, summed over the basin and a period, is what the energy loses */
START_TEST(damping)
{
  enum { N = 40, TIMES = 8 };
  void  *prm = basin();
  double mu = 1e-3, lost = 0, period = at(prm, "period", 0, 0, 0);
  for (int k = 0; k < TIMES; k++)
    for (int i = 0; i < N; i++)
      for (int j = 0; j < N; j++) {
        double x = (i + 0.5) / N, y = 0.5 * (j + 0.5) / N, t = period * k / TIMES;
        double stretch = slope(prm, "vel_x", x, y, t, 0), shear = slope(prm, "vel_x", x, y, t, 1);
        lost += 4 * mu * (stretch * stretch + shear * shear) * 0.5 / (N * N * TIMES);
      }
  set(slosh(), prm, "viscosity", mu);
  CLOSE(2 * at(prm, "damping", 0, 0, 0) * 0.24525, lost, 2e-3 * lost);
  CLOSE(at(prm, "wall_elevation", 0, 0, period), 0.01 * exp(-at(prm, "damping", 0, 0, 0) * period), 1e-12);
  free(prm);
}
END_TEST

RUN_TESTS("slosh", period, equations, energies, damping)
