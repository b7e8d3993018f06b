/* Darcy cavity: against both equations by differences, the heat through a wall, and small Rayleigh numbers. */
#include "tests/references/reference_test.h"

#include <math.h>

static const struct reference *cavity(void) { return reference_find("darcy_cavity"); }

static void *at_rayleigh(double Ra)
{
  void *prm = defaults(cavity());
  set(cavity(), prm, "rayleigh", Ra);
  return prm;
}

/* a quantity at 5 places around (x, y): centre, left, right, below, above */
static void around(const void *prm, const char *quantity, double x, double y, double d, double v[5])
{
  const double place[5][3] = {{x, y, 0}, {x - d, y, 0}, {x + d, y, 0}, {x, y - d, 0}, {x, y + d, 0}};
  ck_assert_int_eq(cavity()->value(prm, reference_quantity(cavity(), quantity), 5, place, 0, v), OK);
}

/* div u = 0, curl u = Ra dT/dx, u . grad T = lap T */
START_TEST(equations)
{
  static const double places[][2] = {{0.2, 0.3}, {0.75, 0.9}, {0.06, 0.5}};
  const double        d = 2e-3;
  void               *prm = at_rayleigh(100);
  for (int i = 0; i < 3; i++) {
    double u[5], v[5], T[5], x = places[i][0], y = places[i][1];
    around(prm, "vel_x", x, y, d, u);
    around(prm, "vel_y", x, y, d, v);
    around(prm, "temperature", x, y, d, T);
    double Tx = (T[2] - T[1]) / (2 * d), Ty = (T[4] - T[3]) / (2 * d);
    CLOSE((u[2] - u[1] + v[4] - v[3]) / (2 * d), 0, 0.05);
    CLOSE((v[2] - v[1] - u[4] + u[3]) / (2 * d), 100 * Tx, 0.1);
    CLOSE(u[0] * Tx + v[0] * Ty, (T[1] + T[2] + T[3] + T[4] - 4 * T[0]) / (d * d), 0.05);
  }
  free(prm);
}
END_TEST

/* what goes through the middle comes in through the hot wall */
START_TEST(wall)
{
  enum { N = 200 };
  static double x[2 * N][3], T[2 * N];
  const double  d = 1e-3;
  double        heat = 0;
  void         *prm = at_rayleigh(100);
  for (int i = 0; i < 2 * N; i++) {
    x[i][0] = i / N ? 2 * d : d;
    x[i][1] = (i % N + 0.5) / N;
  }
  ck_assert_int_eq(cavity()->value(prm, reference_quantity(cavity(), "temperature"), 2 * N, x, 0, T), OK);
  for (int i = 0; i < N; i++) heat += (3 - 4 * T[i] + T[N + i]) / (2 * d) / N;
  double Nu = value_at(cavity(), prm, "nusselt", 0, 0, 0);
  CLOSE(heat, Nu, 5e-4);
  CLOSE(Nu, 3.1113, 2e-4); /* Walker and Homsy 1978: 3.097, Manole and Lage 1992: 3.118 */
  free(prm);
}
END_TEST

/* conduction alone turns the liquid as a membrane bends: 0.0736714 Ra in the centre; what it carries grows as Ra^2 */
START_TEST(slow)
{
  void *slow = at_rayleigh(0.5), *faster = at_rayleigh(1), *none = at_rayleigh(0);
  CLOSE(value_at(cavity(), slow, "psi_centre", 0, 0, 0), -0.5 * 0.07367135, 1e-5);
  double a = value_at(cavity(), slow, "nusselt", 0, 0, 0) - 1, b = value_at(cavity(), faster, "nusselt", 0, 0, 0) - 1;
  CLOSE(b / a, 4, 0.02);
  CLOSE(value_at(cavity(), none, "temperature", 0.3, 0.8, 0), 0.7, 1e-12);
  free(slow), free(faster), free(none);
}
END_TEST

/* units: K, pore velocity */
START_TEST(units)
{
  void *prm = at_rayleigh(100), *plain = at_rayleigh(100);
  set(cavity(), prm, "length", 0.15);
  set(cavity(), prm, "diffusivity", 1e-7);
  set(cavity(), prm, "hot", 320);
  set(cavity(), prm, "cold", 280);
  set(cavity(), prm, "porosity", 0.4);
  CLOSE(value_at(cavity(), prm, "temperature", 0.015, 0.06, 0),
        280 + 40 * value_at(cavity(), plain, "temperature", 0.1, 0.4, 0), 1e-9);
  double per = 1e-7 / 0.15 / 0.4;
  CLOSE(value_at(cavity(), prm, "vel_y", 0.015, 0.06, 0) / per, value_at(cavity(), plain, "vel_y", 0.1, 0.4, 0), 1e-8);
  CLOSE(scale_of(cavity(), prm, "vel_y") / per, 36.6795, 1e-3);
  CLOSE(scale_of(cavity(), prm, "temperature"), 40, 1e-12);
  set(cavity(), prm, "conductivity", 0.5);
  CLOSE(value_at(cavity(), prm, "heat", 0, 0, 0), 20 * value_at(cavity(), plain, "nusselt", 0, 0, 0), 1e-9);
  CLOSE(value_at(cavity(), prm, "turning", 0, 0, 0) / per, -2 * 4.70769, 1e-4);
  free(prm), free(plain);
}
END_TEST

RUN_TESTS("darcy_cavity", equations, wall, slow, units)
