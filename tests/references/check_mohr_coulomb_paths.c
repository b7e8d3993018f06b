/* Stress paths of a soil: against tabulated failures, against Mohr's circles plane by plane, and softening against an
 * integration of rates. */
#include "tests/references/reference_test.h"

static const struct reference *paths(void) { return reference_find("mohr_coulomb_paths"); }

/* 1 % of strain in a second from 100 kPa; E 10 MPa, nu 0.3, phi 30 */
static void *soil(double cohesion)
{
  void *prm = defaults(paths());
  set(paths(), prm, "young", 1e7);
  set(paths(), prm, "poisson", 0.3);
  set(paths(), prm, "friction_angle_deg", 30);
  set(paths(), prm, "cohesion", cohesion);
  set(paths(), prm, "pressure", 1e5);
  set(paths(), prm, "begin", 1);
  set(paths(), prm, "rate", 0.01);
  return prm;
}

static double stress(const void *prm, const char *quantity, double t)
{
  return value_at(paths(), prm, quantity, 0, 0, t);
}

/* phi 30, lateral 100 kPa: axial stress in compression and in extension with c 0 and 5 kPa */
START_TEST(table)
{
  static const double rows[2][3] = {{0, 300000, 33333.33333}, {5e3, 317320.5081, 27559.83064}};
  for (int i = 0; i < 2; i++) {
    void *prm = soil(rows[i][0]);
    CLOSE(stress(prm, "compression", 5), -rows[i][1], 1e-4);
    CLOSE(stress(prm, "extension", 5), -rows[i][2], 1e-4);
    CLOSE(stress(prm, "plane", 5), -rows[i][1], 1e-4);
    CLOSE(scale_of(paths(), prm, "compression"), rows[i][1], 1e-4);
    CLOSE(scale_of(paths(), prm, "extension"), rows[i][2], 1e-4);
    free(prm);
  }
}
END_TEST

/* On no plane of two principal stresses the shear is above c - s tan(phi), and on one it is that. */
static void assert_circle_touches(double s1, double s3, double cohesion, double phi)
{
  double most = -INFINITY;
  for (int i = 0; i <= 100000; i++) {
    double angle = M_PI * i / 1e5, normal = 0.5 * (s1 + s3) + 0.5 * (s3 - s1) * cos(2 * angle);
    most = fmax(most, 0.5 * fabs(s3 - s1) * fabs(sin(2 * angle)) - (cohesion - normal * tan(phi)));
  }
  CLOSE(most, 0, 1e-4);
}

START_TEST(mohr_circles)
{
  for (double c = 0; c < 2e4; c += 5e3) {
    void *prm = soil(c);
    assert_circle_touches(stress(prm, "compression", 20), -1e5, c, M_PI / 6);
    assert_circle_touches(-1e5, stress(prm, "extension", 20), c, M_PI / 6);
    assert_circle_touches(stress(prm, "plane", 20), -1e5, c, M_PI / 6);
    double tau = stress(prm, "shear", 20), tip = stress(prm, "tension", 20);
    assert_circle_touches(-1e5 - tau, -1e5 + tau, c, M_PI / 6);
    assert_circle_touches(tip, tip, c, M_PI / 6);
    free(prm);
  }
}
END_TEST

/* Hooke's law in the first step off the pressure: each path by all three stresses that its strains ask for */
START_TEST(slopes)
{
  void  *prm = soil(5e3);
  double e = 1e-4, t = 1 + e / 0.01, nu = 0.3;
  CLOSE((-1e5 - stress(prm, "compression", t)) / e, 1e7, 1e-2);
  CLOSE((stress(prm, "extension", t) + 1e5) / e, 1e7, 1e-2);
  /* no strain across: s_z = nu s_y, e_y = (s_y - nu s_z)/E */
  double axial = -1e5 - stress(prm, "plane", t);
  CLOSE((axial - nu * nu * axial) / 1e7, e, 1e-12);
  CLOSE(stress(prm, "shear", t) / e, 2 * 1e7 / 2.6, 1e-2);
  CLOSE((stress(prm, "tension", t) + 1e5) * (1 - 2 * nu) / 1e7, e, 1e-12);
  CLOSE(stress(prm, "compression", 0.25), -2.5e4, 1e-9);
  CLOSE(stress(prm, "shear", 0.25), 0, 1e-300);
  free(prm);
}
END_TEST

/* tau' = G (2 e' - gamma') with gamma' so that tau stays what gamma has left: small steps, the slope by differences */
START_TEST(softening)
{
  enum { STEPS = 400000 };
  void        *prm = soil(3e3);
  const double G = 1e7 / 2.6, step = 0.08 / STEPS;
  double       tau = 0, gamma = 0;
  set(paths(), prm, "residual_friction_angle_deg", 15);
  set(paths(), prm, "residual_cohesion", 0);
  set(paths(), prm, "softening_start", 0.01);
  set(paths(), prm, "softening_end", 0.05);
  for (int i = 1; i <= STEPS; i++) {
    double lost = fmin(1, fmax(0, (gamma - 0.01) / 0.04)), phi = M_PI / 6 * (1 - 0.5 * lost);
    double bears = 1e5 * sin(phi) + 3e3 * (1 - lost) * cos(phi);
    double slope = gamma > 0.01 && gamma < 0.05
                       ? (-M_PI / 12 * (1e5 * cos(phi) - 3e3 * (1 - lost) * sin(phi)) - 3e3 * cos(phi)) / 0.04
                       : 0;
    double slip = tau + G * step < bears ? 0 : G * step / (G + slope);
    gamma += slip;
    tau += G * (step - slip);
    if (i % (STEPS / 16) == 0) CLOSE(stress(prm, "shear", 1 + 0.5 * i * step / 0.01), tau, 5);
  }
  CLOSE(tau, 1e5 * sin(M_PI / 12), 5);
  free(prm);
}
END_TEST

START_TEST(cut_off)
{
  void *prm = soil(5e3);
  CLOSE(stress(prm, "tension", 20), 5e3 * sqrt(3), 1e-9);
  set(paths(), prm, "tension_strength", 2e3);
  CLOSE(stress(prm, "tension", 20), 2e3, 1e-300);
  CLOSE(scale_of(paths(), prm, "tension"), 1e5, 1e-300);
  free(prm);
}
END_TEST

RUN_TESTS("mohr_coulomb_paths", table, mohr_circles, slopes, softening, cut_off)
