/* Vibrating bar: against a table and against the equation of motion by differences. L 1 m, E 10 MPa, rho 1000, 0.1 m/s.
 */
#include "tests/references/reference_test.h"

static const struct reference *bar(void) { return reference_find("bar_vibration"); }

static void *one_metre(void)
{
  void *prm = defaults(bar());
  set(bar(), prm, "young", 1e7);
  set(bar(), prm, "density", 1000);
  set(bar(), prm, "length", 1);
  set(bar(), prm, "velocity", 0.1);
  return prm;
}

/* bar_vibration: t, u_end, v_end, kinetic, strain energy */
START_TEST(table)
{
  static const double rows[3][5] = {{0.0004, 3.997368625e-05, 0.09980267284, 2.490143377, 0.009856623357},
                                    {0.002, 0.0001967263286, 0.09510565163, 2.261271243, 0.238728757},
                                    {0.004, 0.0003741957135, 0.08090169944, 1.636271243, 0.863728757}};
  void               *prm = one_metre();
  for (int i = 0; i < 3; i++) {
    double t = rows[i][0];
    CLOSE(value_at(bar(), prm, "displacement_x", 1, 0, t), rows[i][1], 1e-13);
    CLOSE(value_at(bar(), prm, "vel_x", 1, 0, t), rows[i][2], 1e-10);
    CLOSE(value_at(bar(), prm, "kinetic", 1, 0, t), rows[i][3], 1e-9);
    CLOSE(value_at(bar(), prm, "elastic", 1, 0, t), rows[i][4], 1e-9);
  }
  CLOSE(bar()->time_scale(prm), 0.04, 1e-15);
  CLOSE(scale_of(bar(), prm, "displacement_x"), 0.6366e-3, 5e-8);
  CLOSE(value_at(bar(), prm, "energy", 0, 0, 1), 2.5, 1e-12);
  CLOSE(value_at(bar(), prm, "frequency", 0, 0, 0), 25, 1e-12);
  free(prm);
}
END_TEST

/* rho u_tt = E u_xx, stress = E u_x, v = u_t, u(0) = 0, stress(L) = 0, by central differences */
START_TEST(equation_of_motion)
{
  void  *prm = one_metre();
  double e = 1e-3, d = 1e-5;
  set(bar(), prm, "fixed_end", 0.5);
  for (double x = 0.6; x < 1.5; x += 0.1)
    for (double t = 0.003; t < 0.04; t += 0.005) {
      double u = value_at(bar(), prm, "displacement_x", x, 0, t);
      double left = value_at(bar(), prm, "displacement_x", x - e, 0, t);
      double right = value_at(bar(), prm, "displacement_x", x + e, 0, t);
      double before = value_at(bar(), prm, "displacement_x", x, 0, t - d);
      double after = value_at(bar(), prm, "displacement_x", x, 0, t + d);
      CLOSE(1000 * (after - 2 * u + before) / (d * d), 1e7 * (right - 2 * u + left) / (e * e), 0.05);
      CLOSE(value_at(bar(), prm, "stress_xx", x, 0, t), 1e7 * (right - left) / (2 * e), 0.02);
      CLOSE(value_at(bar(), prm, "vel_x", x, 0, t), (after - before) / (2 * d), 1e-6);
    }
  CLOSE(value_at(bar(), prm, "displacement_x", 0.5, 0, 0.01), 0, 1e-18);
  CLOSE(value_at(bar(), prm, "stress_xx", 1.5, 0, 0.01), 0, 1e-9);
  free(prm);
}
END_TEST

RUN_TESTS("bar_vibration", table, equation_of_motion)
