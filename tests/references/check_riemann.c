/* Shock tube: star states against published figures, profiles, and the balances of mass, momentum and energy over the
 * whole tube, which hold only if every wave has its right speed and strength. */
#include "tests/references/reference_test.h"

#include <stdio.h>

static const struct reference *tube(void) { return reference_find("riemann"); }

struct problem {
  double left[5], right[5]; /* density, velocity, pressure, gamma, stiffness */
  double p, u, left_density, right_density, digits;
};

/* Sod; Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, his five tests (tables 4.1 to 4.3, to the digits
 * printed); two gases; water under 1 GPa before air (Saurel and Abgrall, J. Comput. Phys. 150, 1999); air before water
 */
static const struct problem problems[] = {
    {{1, 0, 1, 1.4}, {0.125, 0, 0.1, 1.4}, 0.3031302, 0.9274526, 0.4263194, 0.2655737, 5e-7},
    {{1, 0.75, 1, 1.4}, {0.125, 0, 0.1, 1.4}, 0.4662936, 1.360906, 0.5798667, 0.3397002, 5e-7},
    {{1, -2, 0.4, 1.4}, {1, 2, 0.4, 1.4}, 0.001893873, 0, 0.02185212, 0.02185212, 5e-7},
    {{1, 0, 1000, 1.4}, {1, 0, 0.01, 1.4}, 460.894, 19.5975, 0.57506, 5.99924, 5e-6},
    {{1, 0, 0.01, 1.4}, {1, 0, 100, 1.4}, 46.0950, -6.19633, 5.99242, 0.57511, 5e-6},
    {{5.99924, 19.5975, 460.894, 1.4}, {5.99242, -6.19633, 46.0950, 1.4}, 1691.64, 8.68975, 14.2823, 31.0426, 5e-6},
    {{1, 0, 1, 1.4}, {0.125, 0, 0.1, 1.2}, 0.2938074, 0.9496652, 0.4169123, 0.2988111, 5e-7},
    {{1000, 0, 1e9, 4.4, 6e8}, {50, 0, 1e5, 1.4}, 1.419048e7, 482.6104, 804.4446, 288.1681, 5e-7},
    {{11.6, 0, 1e6, 1.4}, {1000, 0, 1e5, 4.4, 6e8}, 997776.6, 0.5522439, 11.58157, 1000.34, 5e-7},
};
enum { PROBLEMS = sizeof problems / sizeof *problems };

static void *fill(const struct problem *q)
{
  static const char *const names[5] = {"density", "velocity", "pressure", "gamma", "stiffness"};
  void                    *prm = defaults(tube());
  for (int i = 0; i < 5; i++) {
    char name[32];
    snprintf(name, sizeof name, "left_%s", names[i]);
    set(tube(), prm, name, q->left[i]);
    snprintf(name, sizeof name, "right_%s", names[i]);
    set(tube(), prm, name, q->right[i]);
  }
  return prm;
}

static double at(const void *prm, const char *quantity, double x, double t)
{
  return value_at(tube(), prm, quantity, x, 0, t);
}

START_TEST(star_states)
{
  for (int i = 0; i < PROBLEMS; i++) {
    const struct problem *q = &problems[i];
    void                 *prm = fill(q);
    CLOSE(at(prm, "P_star", 0, 0), q->p, q->digits * q->p);
    CLOSE(at(prm, "vel_star", 0, 0), q->u, q->digits * fabs(q->u) + 1e-12);
    CLOSE(at(prm, "density_left_star", 0, 0), q->left_density, 2 * q->digits * q->left_density);
    CLOSE(at(prm, "density_right_star", 0, 0), q->right_density, 2 * q->digits * q->right_density);
    free(prm);
  }
}
END_TEST

/* x, density, velocity, pressure of Sod at 0.2 and of water before air at 0.229 ms, eight digits made elsewhere */
START_TEST(profiles)
{
  static const double sod[7][4] = {
      {0.2, 1, 0, 1},
      {0.27125, 0.9725116425, 0.03288829718, 0.9617290464},
      {0.3, 0.87745253, 0.15267996, 0.83274702},
      {0.4, 0.6029377, 0.56934663, 0.49247185},
      {0.6, 0.42631943, 0.92745262, 0.30313018},
      {0.8, 0.26557371, 0.92745262, 0.30313018},
      {0.9, 0.125, 0, 0.1},
  };
  static const double water[5][4] = {{0.1, 995.35636, 12.300924, 9.6756592e8},
                                     {0.2, 932.81763, 174.03471, 5.7821805e8},
                                     {0.35, 833.04645, 416.63539, 1.1624984e8},
                                     {0.8, 804.44463, 482.61041, 14190477},
                                     {0.9, 50, 0, 1e5}};
  void               *prm = fill(&problems[0]);
  for (int i = 0; i < 7; i++) {
    CLOSE(at(prm, "density", sod[i][0], 0.2), sod[i][1], 6e-9);
    CLOSE(at(prm, "vel_x", sod[i][0], 0.2), sod[i][2], 6e-9);
    CLOSE(at(prm, "P", sod[i][0], 0.2), sod[i][3], 6e-9);
  }
  free(prm);
  prm = fill(&problems[7]);
  set(tube(), prm, "position", 0.7);
  for (int i = 0; i < 5; i++) {
    CLOSE(at(prm, "density", water[i][0], 2.29e-4), water[i][1], 6e-6);
    CLOSE(at(prm, "vel_x", water[i][0], 2.29e-4), water[i][2], 6e-6);
    CLOSE(at(prm, "P", water[i][0], 2.29e-4), water[i][3], 6);
  }
  ck_assert_double_eq(at(prm, "is_left", 0.8, 2.29e-4), 1);
  ck_assert_double_eq(at(prm, "is_left", 0.82, 2.29e-4), 0);
  free(prm);
}
END_TEST

/* mass, momentum or energy per volume (k = 0, 1, 2), or its flux */
static double density_of(const void *prm, int k, double x, double t, bool flux)
{
  double rho = at(prm, "density", x, t), u = at(prm, "vel_x", x, t), p = at(prm, "P", x, t);
  double amount = k == 0 ? rho : k == 1 ? rho * u : rho * (at(prm, "internal_energy", x, t) + 0.5 * u * u);
  return !flux ? amount : amount * u + (k == 0 ? 0 : k == 1 ? p : p * u);
}

/* integral of it from a to b, 40 times Gauss's rule of three points */
static double integral(const void *prm, int k, double a, double b, double t)
{
  enum { N = 40 };
  double sum = 0, h = (b - a) / N, away = sqrt(0.15) * h;
  for (int i = 0; i < N; i++) {
    double x = a + (i + 0.5) * h, outer = density_of(prm, k, x - away, t, false);
    outer += density_of(prm, k, x + away, t, false);
    sum += h / 18 * (5 * outer + 8 * density_of(prm, k, x, t, false));
  }
  return sum;
}

/* what is between x = -L and L at time 1 (s, ms where sound is fast) = what was there + what came in through both ends
 */
static void balance(const void *prm, double t)
{
  static const char *const places[5] = {"left_head", "left_tail", "contact", "right_tail", "right_head"};
  double                   x[8], reach = 0;
  int                      n = 1;
  for (int i = 0; i < 5; i++) x[n++] = at(prm, places[i], 0, t);
  for (int i = 1; i < n; i++) reach = fmax(reach, fabs(x[i]));
  x[0] = -1.5 * reach, x[n++] = 1.5 * reach;
  for (int k = 0; k < 3; k++) {
    double before = integral(prm, k, x[0], 0, 0) + integral(prm, k, 0, x[n - 1], 0), after = 0, size = 0;
    double in = t * (density_of(prm, k, x[0], 0, true) - density_of(prm, k, x[n - 1], 0, true));
    for (int i = 1; i < n; i++) {
      ck_assert_msg(x[i] >= x[i - 1], "wave %d at %g lies behind wave %d at %g", i, x[i], i - 1, x[i - 1]);
      if (x[i] > x[i - 1]) after += integral(prm, k, x[i - 1], x[i], t);
      if (x[i] > x[i - 1]) size += (x[i] - x[i - 1]) * fabs(density_of(prm, k, 0.5 * (x[i] + x[i - 1]), t, false));
    }
    ck_assert_msg(fabs(after - before - in) <= 1e-8 * size, "balance %d: %.12g, then %.12g, came in %.12g", k, before,
                  after, in);
  }
}

START_TEST(balances)
{
  for (int i = 0; i < PROBLEMS; i++) {
    void *prm = fill(&problems[i]);
    set(tube(), prm, "position", 0);
    balance(prm, problems[i].left[4] + problems[i].right[4] > 0 ? 1e-3 : 1);
    free(prm);
  }
}
END_TEST

/* pulled apart faster than 2 (c_l + c_r)/(gamma - 1) = 10 sqrt(1.4) = 11.8: nothing is left between, mass and energy
 * are in the two fans */
START_TEST(vacuum_between)
{
  const struct problem q = {{1, -8, 1, 1.4}, {1, 8, 1, 1.4}, 0, 0, 0, 0, 0};
  void                *prm = fill(&q);
  set(tube(), prm, "position", 0);
  ck_assert_double_eq(at(prm, "P_star", 0, 0), 0);
  ck_assert_double_eq(at(prm, "density", 0.5, 1), 0);
  CLOSE(at(prm, "vel_x", 0.5, 1), 0.5, 1e-15);
  CLOSE(at(prm, "contact", 0, 1), -8 + 5 * sqrt(1.4), 1e-14);
  CLOSE(at(prm, "left_tail", 0, 1), -8 + 5 * sqrt(1.4), 1e-14);
  CLOSE(at(prm, "right_tail", 0, 1), 8 - 5 * sqrt(1.4), 1e-14);
  balance(prm, 1);
  free(prm);
}
END_TEST

/* beside nothing: a gas escapes at 2 c/(gamma - 1), water springs to no pressure at 1e5/(rho c), nearly */
START_TEST(empty_side)
{
  const struct problem gas = {{1, 0, 1, 1.4}, {0, 0, 0, 1.4}, 0, 0, 0, 0, 0};
  const struct problem water = {{0, 0, 0, 1.4}, {1000, 0, 1e5, 4.4, 6e8}, 0, 0, 0, 0, 0};
  void                *prm = fill(&gas);
  set(tube(), prm, "position", 0);
  CLOSE(at(prm, "contact", 0, 1), 5 * sqrt(1.4), 1e-14);
  ck_assert_double_eq(at(prm, "density", 5.95, 1), 0);
  CLOSE(at(prm, "density", 0, 1), pow(5.0 / 6, 5), 1e-14); /* sonic point */
  balance(prm, 1);
  free(prm);
  prm = fill(&water);
  set(tube(), prm, "position", 0);
  CLOSE(at(prm, "vel_star", 0, 0), -1e5 / (1000 * 1624.9431), 1e-5);
  ck_assert_double_eq(at(prm, "P_star", 0, 0), 0);
  ck_assert_double_eq(at(prm, "density", -1, 1e-3), 0);
  CLOSE(at(prm, "density", 1, 1e-3), 1000 * pow(6e8 / 6.001e8, 1 / 4.4), 1e-9);
  free(prm);
}
END_TEST

/* the same tube from the other side; the start; what no fluid can be */
START_TEST(edges)
{
  const struct problem mirror = {{0.125, 0, 0.1, 1.4}, {1, 0, 1, 1.4}, 0, 0, 0, 0, 0};
  void                *sod = fill(&problems[0]), *other = fill(&mirror);
  const double         x[1][3] = {{0}};
  double               v;
  for (double at_x = 0.005; at_x < 1; at_x += 0.01) {
    CLOSE(at(other, "P", 1 - at_x, 0.2), at(sod, "P", at_x, 0.2), 1e-14);
    CLOSE(at(other, "vel_x", 1 - at_x, 0.2), -at(sod, "vel_x", at_x, 0.2), 1e-14);
  }
  ck_assert_double_eq(at(sod, "density", 0.49, 0), 1);
  ck_assert_double_eq(at(sod, "density", 0.51, 0), 0.125);
  CLOSE(at(sod, "internal_energy", 0.51, 0), 2, 1e-15);
  ck_assert_double_eq(scale_of(tube(), sod, "P"), 1);
  ck_assert_double_eq(scale_of(tube(), sod, "vel_x"), 1);
  set(tube(), sod, "right_pressure", -0.1);
  ck_assert_int_eq(tube()->value(sod, 0, 1, x, 1.0, &v), ERR_INPUT);
  set(tube(), sod, "right_density", 0);
  ck_assert_int_eq(tube()->value(sod, 0, 1, x, 1.0, &v), ERR_INPUT);
  set(tube(), sod, "left_density", 0);
  ck_assert_int_eq(tube()->value(sod, 0, 1, x, 1.0, &v), ERR_INPUT);
  free(sod), free(other);
}
END_TEST

RUN_TESTS("riemann", star_states, profiles, balances, vacuum_between, empty_side, edges)
