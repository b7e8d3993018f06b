/* The neo-Hookean law against its closed forms, and its energy as a potential. */
#include "constitutive/constitutive.h"
#include "core/tensor.h"

#include <check.h>
#include <stdlib.h>

static const struct {
  double young, poisson;
} prm = {1e7, 0.25}; /* lambda = mu = 4 MPa */
static const double mu = 4e6, lambda = 4e6;

static const struct constitutive_model *law(void) { return constitutive_find("neo_hookean"); }

static void respond(const double F[9], double stress[6])
{
  ck_assert_int_eq(law()->update(&prm, 1, 1.0, F, F, stress, NULL, NULL), 0);
}

START_TEST(uniaxial)
{
  const double J[3] = {0.5, 0.999, 2.0};
  for (int i = 0; i < 3; i++) {
    double F[9] = {1, 0, 0, 0, J[i], 0, 0, 0, 1}, stress[6];
    respond(F, stress);
    ck_assert_double_eq_tol(stress[YY], lambda * log(J[i]) / J[i] + mu / J[i] * (J[i] * J[i] - 1), 1e-8);
    ck_assert_double_eq_tol(stress[XX], lambda * log(J[i]) / J[i], 1e-8);
  }
}
END_TEST

/* F = [[1, g], [0, 1]]: shear stress mu g, normal stress mu g^2 along the shear */
START_TEST(simple_shear)
{
  double F[9] = {1, 0.4, 0, 0, 1, 0, 0, 0, 1}, stress[6];
  respond(F, stress);
  ck_assert_double_eq_tol(stress[XY], mu * 0.4, 1e-8);
  ck_assert_double_eq_tol(stress[XX], mu * 0.16, 1e-8);
  ck_assert_double_eq_tol(stress[YY], 0.0, 1e-8);
}
END_TEST

/* strains of 1e-12 keep their digits: stress = E_oed times strain */
START_TEST(tiny_strain)
{
  double e = 0x1p-40, F[9] = {1, 0, 0, 0, 1 + e, 0, 0, 0, 1}, stress[6];
  respond(F, stress);
  ck_assert_double_eq_tol(stress[YY] / (law()->oedometer_modulus(&prm) * e), 1.0, 1e-11);
}
END_TEST

/* nominal stress J stress F^-T = d(J energy)/dF: F P^T = J stress, so sum_k P_ik F_jk */
START_TEST(energy_is_a_potential)
{
  const double F[9] = {1.1, 0.2, -0.1, 0.05, 0.9, 0.1, -0.15, 0.03, 1.2}, step = 1e-5;
  double       stress[6], P[9], Pt[9], product[9], kirchhoff[6];
  respond(F, stress);
  for (int k = 0; k < 9; k++) {
    double psi[2];
    for (int side = 0; side < 2; side++) {
      double moved[9];
      memcpy(moved, F, sizeof moved);
      moved[k] += side ? step : -step;
      law()->energy(&prm, 1, moved, stress, NULL, &psi[side]);
      psi[side] *= tensor_determinant(moved);
    }
    P[k] = (psi[1] - psi[0]) / (2.0 * step);
  }
  tensor_transpose(F, Pt);
  tensor_product(P, Pt, product);
  tensor_to_symmetric(product, kirchhoff);
  for (int k = 0; k < 6; k++) ck_assert_double_eq_tol(kirchhoff[k] / tensor_determinant(F), stress[k], 1e-8 * lambda);
}
END_TEST

/* stretched to J along an axis, the wave along it has the modulus lambda (1 - ln J)/J + mu (1 + J^2)/J */
START_TEST(wave_speed_of_a_stretched_bar)
{
  double J = 0.8, F[9] = {1, 0, 0, 0, 1, 0, 0, 0, J}, stress[6], rb = 2000.0;
  respond(F, stress);
  double exact = sqrt((lambda * (1 - log(J)) + mu * (1 + J * J)) / J / rb);
  double c = law()->wave_speed(&prm, 1, &rb, stress, NULL);
  ck_assert_double_ge(c, exact);
  ck_assert_double_le(c, 1.2 * exact);
}
END_TEST

int main(void)
{
  Suite   *suite = suite_create("constitutive/neo_hookean");
  TCase   *tests = tcase_create("neo-Hookean");
  SRunner *runner = srunner_create(suite);
  tcase_add_test(tests, uniaxial);
  tcase_add_test(tests, simple_shear);
  tcase_add_test(tests, tiny_strain);
  tcase_add_test(tests, energy_is_a_potential);
  tcase_add_test(tests, wave_speed_of_a_stretched_bar);
  suite_add_tcase(suite, tests);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
