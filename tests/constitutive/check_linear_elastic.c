/* Linear elasticity in rate form: exact logarithmic strain, whatever the steps; shear; a spinning stretched body. */
#include "constitutive/constitutive.h"
#include "core/tensor.h"

#include <check.h>
#include <stdlib.h>

enum { N_LADDER = 4 };
static const struct {
  double young, poisson;
} prm = {1e7, 0.3};
static const int ladder[N_LADDER] = {1, 3, 50, 1000};

static const struct constitutive_model *law(void) { return constitutive_find("linear_elastic"); }

/* `steps` equal steps dF from the stress-free state */
static void stretch(const double dF[9], int steps, double stress[6])
{
  memset(stress, 0, 6 * sizeof *stress);
  for (int i = 0; i < steps; i++) ck_assert_int_eq(law()->update(&prm, 1, 1.0, dF, dF, stress, NULL, NULL), 0);
}

/* stress = E_oed ln J to round-off for one step or a thousand, in compression and extension */
START_TEST(uniaxial)
{
  const double J[3] = {0.6, 0.99, 1.5}, oed = law()->oedometer_modulus(&prm);
  ck_assert_double_eq_tol(oed, 1e7 * 0.7 / (1.3 * 0.4), 1e-8);
  for (int j = 0; j < 3; j++)
    for (int i = 0; i < N_LADDER; i++) {
      double dF[9] = {1, 0, 0, 0, pow(J[j], 1.0 / ladder[i]), 0, 0, 0, 1}, stress[6];
      stretch(dF, ladder[i], stress);
      ck_assert_double_eq_tol(stress[YY], oed * log(J[j]), 4e-16 * oed * ladder[i]);
      ck_assert_double_eq_tol(stress[XX], stress[YY] * 0.3 / 0.7, 4e-16 * oed * ladder[i]);
    }
}
END_TEST

/* pure shear along skew axes: 2 mu ln(stretch) */
START_TEST(shear)
{
  const double c = cosh(0.2), s = sinh(0.2), dF[9] = {c, s, 0, s, c, 0, 0, 0, 1}, mu = 1e7 / 2.6;
  double       stress[6];
  stretch(dF, 1, stress);
  ck_assert_double_eq_tol(stress[XY], 2.0 * mu * 0.2, 1e-8);
  ck_assert_double_eq_tol(stress[XX], 0.0, 1e-8);
}
END_TEST

/* A rod that turns by 1 rad per step while it is stretched: ln of the whole stretch along its axis. */
START_TEST(turning_rod)
{
  enum { STEPS = 200 };
  double stress[6] = {0}, along = log(1.4) / STEPS;
  for (int i = 0; i < STEPS; i++) {
    double a = i, b = i + 1.0, e = exp(along);
    /* R(b) diag(e, 1) R(-a) */
    double dF[9] = {e * cos(b) * cos(a) + sin(b) * sin(a),
                    e * cos(b) * sin(a) - sin(b) * cos(a),
                    0,
                    e * sin(b) * cos(a) - cos(b) * sin(a),
                    e * sin(b) * sin(a) + cos(b) * cos(a),
                    0,
                    0,
                    0,
                    1};
    ck_assert_int_eq(law()->update(&prm, 1, 1.0, dF, dF, stress, NULL, NULL), 0);
  }
  double c = cos(STEPS), s = sin(STEPS), oed = law()->oedometer_modulus(&prm);
  double axial = c * c * stress[XX] + 2.0 * c * s * stress[XY] + s * s * stress[YY];
  ck_assert_double_eq_tol(axial, oed * log(1.4), 1e-15 * oed * STEPS);
}
END_TEST

/* short series, long series and eigenvalues agree where one hands over to the next, in the plane and out of it */
START_TEST(hand_over)
{
  static const double size[2] = {0.01, 0.0424}, tilt[2] = {0, 0.4};
  for (int i = -50; i <= 50; i++)
    for (int j = 0; j < 4; j++) {
      double e = size[j / 2] * (1.0 + 0.01 * i), l = exp(e), c = cos(0.3), s = sin(0.3), f = cos(tilt[j % 2]),
             g = sin(tilt[j % 2]);
      /* stretches l, 1/l, 1 along the axes a, b and across */
      double a[3] = {c * f, s * f, g}, b[3] = {-s, c, 0}, dF[9], stress[6];
      for (int q = 0; q < 9; q++)
        dF[q] = (q % 4 == 0) + (l - 1) * a[q / 3] * a[q % 3] + (1 / l - 1) * b[q / 3] * b[q % 3];
      stretch(dF, 1, stress);
      ck_assert_double_eq_tol(stress[XX] / (1e7 / 1.3), e * (a[0] * a[0] - b[0] * b[0]), 1e-15);
      ck_assert_double_eq_tol(stress[XY] / (1e7 / 1.3), e * (a[0] * a[1] - b[0] * b[1]), 1e-15);
      ck_assert_double_eq_tol(stress[XZ] / (1e7 / 1.3), e * a[0] * a[2], 1e-15);
    }
}
END_TEST

START_TEST(energy)
{
  const double stress[6] = {-1e4, -3e4, -1e4, 2e3, 0, 0}, E = 1e7, nu = 0.3;
  double       e, F[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  law()->energy(&prm, 1, F, stress, NULL, &e);
  ck_assert_double_eq_tol(e, ((1 + nu) * (11e8 + 2 * 4e6) - nu * 25e8) / (2 * E), 1e-12);
}
END_TEST

int main(void)
{
  Suite   *suite = suite_create("constitutive/linear_elastic");
  TCase   *tests = tcase_create("linear elastic");
  SRunner *runner = srunner_create(suite);
  tcase_add_test(tests, uniaxial);
  tcase_add_test(tests, shear);
  tcase_add_test(tests, turning_rod);
  tcase_add_test(tests, hand_over);
  tcase_add_test(tests, energy);
  suite_add_tcase(suite, tests);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
