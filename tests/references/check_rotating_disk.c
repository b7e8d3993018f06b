/* Turning disk: against tables, against the balance of the steady state and against differences in radius and time.
 * R 1 m, E 10 MPa, nu 0.3, rho 1000, 10 1/s. */
#include "tests/references/reference_test.h"

static const struct reference *disk(void) { return reference_find("rotating_disk"); }

static void *one_metre(void)
{
  void *prm = defaults(disk());
  set(disk(), prm, "young", 1e7);
  set(disk(), prm, "poisson", 0.3);
  set(disk(), prm, "density", 1000);
  set(disk(), prm, "radius", 1);
  set(disk(), prm, "spin", 10);
  return prm;
}

/* disk_breathing: rim at five times */
START_TEST(breathing)
{
  static const double rows[5][2] = {{0.001, 4.723118892e-05},
                                    {0.005, 0.000903524828},
                                    {0.013, 0.002569994401},
                                    {0.051, 5.585773013e-06},
                                    {0.2, 0.0005256664932}};
  void               *prm = one_metre();
  for (int i = 0; i < 5; i++) {
    CLOSE(value_at(disk(), prm, "rim", 0, 0, rows[i][0]), rows[i][1], 2e-7);
    CLOSE(value_at(disk(), prm, "distance", 0, 0, rows[i][0]), 1 + rows[i][1], 2e-7);
  }
  CLOSE(value_at(disk(), prm, "angular_frequency", 0, 0, 0), 246.63762, 1e-5);
  CLOSE(value_at(disk(), prm, "kinetic", 0, 0, 0), 78539.81634, 1e-5);
  CLOSE(value_at(disk(), prm, "angular_z", 0, 0, 0), 15707.96327, 1e-5);
  free(prm);
}
END_TEST

/* disk_static: stresses at r 0, 0.5, 1, rim displacement 1.3 mm; and the balance d(r sigma_r)/dr - sigma_t = -rho w2 r2
 */
START_TEST(steady)
{
  void  *prm = one_metre();
  double e = 1e-4;
  CLOSE(value_at(disk(), prm, "rim_static", 0, 0, 0), 0.0013, 1e-12);
  CLOSE(value_at(disk(), prm, "stress_r_static", 0, 0, 0), 42857.14286, 1e-5);
  CLOSE(value_at(disk(), prm, "stress_r_static", 0.5, 0, 0), 32142.85714, 1e-5);
  CLOSE(value_at(disk(), prm, "stress_t_static", 0, 0.5, 0), 35714.28571, 1e-5);
  CLOSE(value_at(disk(), prm, "stress_t_static", 1, 0, 0), 14285.71429, 1e-5);
  for (double r = 0.1; r < 0.95; r += 0.1) {
    double out = (r + e) * value_at(disk(), prm, "stress_r_static", r + e, 0, 0);
    double in = (r - e) * value_at(disk(), prm, "stress_r_static", r - e, 0, 0);
    double hoop = value_at(disk(), prm, "stress_t_static", r, 0, 0);
    CLOSE((out - in) / (2 * e) - hoop, -1e5 * r * r, 1e-2);
  }
  free(prm);
}
END_TEST

/* rho u_tt = M (u_r + u/r)_r + rho w2 r on nodes r = i h, i <= N; the last node carries half a cell and no stress:
 * leapfrog in time */
START_TEST(differences)
{
  enum { N = 200 };
  static double u[N + 2], v[N + 2];
  void         *prm = one_metre();
  double        M = 1e7 * 0.7 / (1.3 * 0.4), lambda = M * 0.3 / 0.7, h = 1.0 / N, dt = 0.5 * h / 116.1, t = 0;
  memset(u, 0, sizeof u), memset(v, 0, sizeof v);
  for (int k = 1; k <= 30000 && t < 0.05; k++) {
    /* stress-free rim: M (u[N+1] - u[N-1])/2h + lambda u[N] = 0 gives the node beyond it */
    u[N + 1] = u[N - 1] - 2 * h * lambda / M * u[N];
    for (int i = 1; i <= N; i++) {
      double r = i * h, curve = (u[i + 1] - 2 * u[i] + u[i - 1]) / (h * h) + (u[i + 1] - u[i - 1]) / (2 * h * r);
      v[i] += dt * ((k == 1 ? 0.5 : 1) * (M / 1000 * (curve - u[i] / (r * r)) + 100 * r));
    }
    for (int i = 1; i <= N; i++) u[i] += dt * v[i];
    t += dt;
    if (k % 500) continue;
    CLOSE(value_at(disk(), prm, "rim", 0, 0, t), u[N], 2e-6);
    CLOSE(value_at(disk(), prm, "displacement_r", 0, 0.5, t), u[N / 2], 2e-6);
  }
  free(prm);
}
END_TEST

RUN_TESTS("rotating_disk", breathing, steady, differences)
