/* Decaying vortices: figures at some times, and the residuals of the Navier-Stokes equations by differences. */
#include "tests/references/reference_test.h"

static const struct reference *vortices(void) { return reference_find("taylor_green"); }

static void *thick(void)
{
  void *prm = defaults(vortices());
  set(vortices(), prm, "density", 1);
  set(vortices(), prm, "viscosity", 0.01);
  return prm;
}

static double at(const void *prm, const char *quantity, double x, double y, double t)
{
  return value_at(vortices(), prm, quantity, x, y, t);
}

/* t, largest velocity, mean kinetic energy, largest pressure: a table with ten digits */
START_TEST(decay)
{
  static const double rows[4][4] = {{0, 1, 0.25, 0.5},
                                    {0.05, 0.9612907007, 0.2310199528, 0.4620399056},
                                    {0.1, 0.9240798113, 0.2134808744, 0.4269617488},
                                    {1, 0.4540407387, 0.05153824811, 0.1030764962}};
  void               *prm = thick();
  for (int i = 0; i < 4; i++) {
    double t = rows[i][0];
    CLOSE(at(prm, "vel_max", 0, 0, t), rows[i][1], 2e-10);
    CLOSE(at(prm, "kinetic", 0, 0, t), rows[i][2], 2e-10);
    CLOSE(at(prm, "P_amplitude", 0, 0, t), rows[i][3], 2e-10);
    CLOSE(at(prm, "vel_x", 0.25, 0, t), rows[i][1], 2e-10);
    CLOSE(at(prm, "P", 0, 0.5, t), rows[i][3], 2e-10);
  }
  free(prm);
}
END_TEST

struct point {
  double x, y, t;
};

/* derivative of a quantity along x, y or t (d = 0, 1, 2), four points */
static double slope(const void *prm, const char *q, struct point p, int d)
{
  double h = 1e-3, s[4];
  for (int i = 0; i < 4; i++) {
    double a = h * (i < 2 ? i - 2 : i - 1);
    s[i] = at(prm, q, p.x + (d == 0) * a, p.y + (d == 1) * a, p.t + (d == 2) * a);
  }
  return (s[0] - 8 * s[1] + 8 * s[2] - s[3]) / (12 * h);
}

static double laplacian(const void *prm, const char *q, struct point p)
{
  double h = 2e-3, sum = -5 * at(prm, q, p.x, p.y, p.t);
  for (int i = 0; i < 4; i++) {
    double x = (i == 0) - (i == 1), y = (i == 2) - (i == 3);
    sum += 4.0 / 3 * at(prm, q, p.x + h * x, p.y + h * y, p.t);
    sum -= 1.0 / 12 * at(prm, q, p.x + 2 * h * x, p.y + 2 * h * y, p.t);
  }
  return sum / (h * h);
}

/* rho (u_t + u u_x + v u_y) + P_x - mu lap u, the same for v, and u_x + v_y; terms are of the order of 10 */
static void obeys(const void *prm, struct point p, double rho, double mu)
{
  double u = at(prm, "vel_x", p.x, p.y, p.t), v = at(prm, "vel_y", p.x, p.y, p.t);
  CLOSE(slope(prm, "vel_x", p, 0) + slope(prm, "vel_y", p, 1), 0, 1e-9);
  for (int d = 0; d < 2; d++) {
    const char *q = d ? "vel_y" : "vel_x";
    double      rate = slope(prm, q, p, 2) + u * slope(prm, q, p, 0) + v * slope(prm, q, p, 1);
    CLOSE(rho * rate + slope(prm, "P", p, d), mu * laplacian(prm, q, p), 1e-7);
  }
}

START_TEST(navier_stokes)
{
  for (int carried = 0; carried < 2; carried++) {
    void *prm = thick();
    set(vortices(), prm, "density", 2);
    set(vortices(), prm, "wavelength", 1.3);
    set(vortices(), prm, "origin", 0.1);
    if (carried) set(vortices(), prm, "drift", 0.7);
    for (int i = 0; i < 20; i++) obeys(prm, (struct point){0.137 * i, 0.0719 * i, 0.04 * i}, 2, 0.01);
    free(prm);
  }
}
END_TEST

/* the walls of the box [0, 1/2]^2 are smooth: nothing through them, no shear; the energy is the integral */
START_TEST(box)
{
  enum { N = 40 };
  void  *prm = thick();
  double sum = 0;
  for (int i = 0; i < N; i++) {
    double s = (i + 0.5) / (2 * N);
    for (int side = 0; side < 2; side++) {
      CLOSE(at(prm, "vel_x", 0.5 * side, s, 0.3), 0, 1e-15);
      CLOSE(at(prm, "vel_y", s, 0.5 * side, 0.3), 0, 1e-15);
      CLOSE(slope(prm, "vel_x", (struct point){s, 0.5 * side, 0.3}, 1), 0, 1e-12);
    }
    for (int j = 0; j < N; j++) {
      double u = at(prm, "vel_x", s, (j + 0.5) / (2 * N), 0.3), v = at(prm, "vel_y", s, (j + 0.5) / (2 * N), 0.3);
      sum += 0.5 * (u * u + v * v) / (4 * N * N);
    }
  }
  set(vortices(), prm, "area", 0.25);
  CLOSE(at(prm, "kinetic", 0, 0, 0.3), sum, 1e-14);
  CLOSE(scale_of(vortices(), prm, "P"), 0.5, 1e-15);
  CLOSE(scale_of(vortices(), prm, "kinetic"), 0.0625, 1e-15);
  free(prm);
}
END_TEST

RUN_TESTS("taylor_green", decay, navier_stokes, box)
