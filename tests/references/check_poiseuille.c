/* Channel: figures, differences in space and time, and the balance of momentum. H 1 m, rho 1, mu 0.1, 1 N/m3. */
#include "tests/references/reference_test.h"

static const struct reference *channel(void) { return reference_find("poiseuille"); }

static void *driven(void)
{
  void *prm = defaults(channel());
  set(channel(), prm, "height", 1);
  set(channel(), prm, "density", 1);
  set(channel(), prm, "viscosity", 0.1);
  set(channel(), prm, "force", 1);
  return prm;
}

static double at(const void *prm, const char *quantity, double y, double t)
{
  return value_at(channel(), prm, quantity, 0, y, t);
}

/* 1.25 m/s in the end; in the middle and at 0.1 m at some times, series summed elsewhere with twenty digits */
START_TEST(velocities)
{
  static const double rows[3][3] = {{0.5, 0.4629828973544, 0.2061690058700},
                                    {1, 0.7691906428283, 0.3014143241635},
                                    {2, 1.0707961131718, 0.3946229524833}};
  void               *prm = driven();
  for (int i = 0; i < 3; i++) {
    CLOSE(at(prm, "vel_x", 0.5, rows[i][0]), rows[i][1], 1e-13);
    CLOSE(at(prm, "vel_max", 0.7, rows[i][0]), rows[i][1], 1e-13);
    CLOSE(at(prm, "vel_x", 0.1, rows[i][0]), rows[i][2], 1e-13);
    CLOSE(at(prm, "vel_x", 0.9, rows[i][0]), rows[i][2], 1e-13);
  }
  CLOSE(at(prm, "vel_x", 0.5, 1e3), 1.25, 1e-15);
  CLOSE(at(prm, "vel_x_steady", 0.5, 0), 1.25, 1e-15);
  CLOSE(at(prm, "flux", 0, 1e3), 1.0 / 1.2, 1e-15);
  CLOSE(at(prm, "wall_stress", 0, 1e3), 0.5, 1e-15);
  CLOSE(channel()->time_scale(prm), 10, 1e-14);
  CLOSE(scale_of(channel(), prm, "vel_x"), 1.25, 1e-15);
  free(prm);
}
END_TEST

/* rho u_t = G + mu u_yy on n cells, Crank and Nicolson */
static void march(int n, double t, double *u)
{
  int    steps = 2000;
  double r = 0.5 * 0.1 * (t / steps) * n * n, *super = calloc((size_t)n, sizeof *super);
  for (int i = 0; i < n; i++) u[i] = 0;
  for (int k = 0; k < steps; k++) {
    double before = 0;
    for (int i = 0; i < n; i++) {
      double down = i > 0 ? before - u[i] : -2 * u[i], up = i < n - 1 ? u[i + 1] - u[i] : -2 * u[i];
      double below = i > 0 ? -r : 0, above = i < n - 1 ? -r : 0, old = u[i];
      double pivot = 1 + r * ((i > 0 ? 1 : 2) + (i < n - 1 ? 1 : 2)) - (i > 0 ? below * super[i - 1] : 0);
      super[i] = above / pivot;
      u[i] = (u[i] + r * (down + up) + t / steps - (i > 0 ? below * u[i - 1] : 0)) / pivot;
      before = old;
    }
    for (int i = n - 2; i >= 0; i--) u[i] -= super[i] * u[i + 1];
  }
  free(super);
}

START_TEST(differences)
{
  enum { N = 400 };
  void  *prm = driven();
  double u[N];
  for (double t = 0.125; t < 5; t *= 2) {
    march(N, t, u);
    for (int i = 0; i < N; i++) CLOSE(at(prm, "vel_x", (i + 0.5) / N, t), u[i], 1e-5);
  }
  free(prm);
}
END_TEST

/* rho H d(mean)/dt = G H - 2 wall stress; the flux is the integral; at first the liquid falls freely */
START_TEST(momentum)
{
  void  *prm = driven();
  double h = 1e-4;
  for (double t = 0.01; t < 20; t *= 1.7) {
    double rate = (at(prm, "vel_mean", 0, t + h) - at(prm, "vel_mean", 0, t - h)) / (2 * h), sum = 0;
    CLOSE(rate, 1 - 2 * at(prm, "wall_stress", 0, t), 1e-4);
    for (int i = 0; i < 1000; i++) sum += at(prm, "vel_x", (i + 0.5) / 1000, t) / 1000;
    CLOSE(at(prm, "flux", 0, t), sum, 1e-6);
  }
  for (double t = 1e-6; t < 1e-2; t *= 10) CLOSE(at(prm, "vel_x", 0.5, t), t, 1e-9);
  for (int y = 0; y <= 10; y++) ck_assert_double_eq(at(prm, "vel_x", 0.1 * y, 0), 0);
  ck_assert_double_eq(at(prm, "vel_max", 0, 0), 0);
  free(prm);
}
END_TEST

/* a pressure drop does what a force does: 0.2 Pa over 0.2 m are 1 N/m3 */
START_TEST(pressure_drop)
{
  void *prm = driven(), *other = driven();
  set(channel(), other, "force", 0);
  set(channel(), other, "pressure_drop", 0.2);
  set(channel(), other, "length", 0.2);
  set(channel(), other, "base", -0.5);
  for (double t = 0.1; t < 20; t *= 3) CLOSE(at(other, "vel_x", -0.2, t), at(prm, "vel_x", 0.3, t), 1e-14);
  CLOSE(value_at(channel(), other, "P", 0, 0, 0), 0.2, 1e-15);
  CLOSE(value_at(channel(), other, "P", 0.05, 0, 0), 0.15, 1e-15);
  CLOSE(value_at(channel(), other, "P", 0.2, 0, 9), 0, 1e-15);
  free(prm), free(other);
}
END_TEST

RUN_TESTS("poiseuille", velocities, differences, momentum, pressure_drop)
