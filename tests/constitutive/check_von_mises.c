/* Undrained strength: shear and triaxial failure, hardening and softening in closed form, any size of steps, work. */
#include "tests/constitutive/element.h"

/* as the law's parameter table lays them out */
struct prm {
  double young, poisson, shear_strength, hardening_modulus, sensitivity, softening_strain;
};

static const struct prm perfect = {1e7, 0.25, 3e4, 0.0, 1.0, 10.0};
static const double     G = 4e6; /* of young 1e7, poisson 0.25 */

/* pure shear in the plane to an engineering strain, in equal steps; returns the plastic work, J/m3 */
static double shear(struct element *e, double strain, int steps)
{
  double work = 0.0;
  for (int i = 0; i < steps; i++) {
    element_stretch(e, 0.5 * strain / steps, -0.5 * strain / steps, 0.0);
    work += e->work;
  }
  return work;
}

/* shear stress on the planes between the axes of the stretch */
static double shear_stress(const struct element *e) { return 0.5 * (e->stress[XX] - e->stress[YY]); }

START_TEST(pure_shear)
{
  const int ladder[3] = {1, 10, 1000};
  for (int i = 0; i < 3; i++) {
    struct element e = element_start("von_mises", &perfect, -1e5, -1e5, -1e5);
    double         work = shear(&e, 0.05, ladder[i]), plastic = 0.05 - 3e4 / G;
    ck_assert_double_eq_tol(shear_stress(&e), 3e4, 1e-11 * 3e4);
    ck_assert_double_eq_tol(element_p(&e), 1e5, 1e-11 * 1e5);
    ck_assert_double_eq_tol(sqrt(3.0) * e.history[0], plastic, 1e-13);
    ck_assert_double_eq_tol(work, 3e4 * plastic, 1e-11 * work);
  }
}
END_TEST

/* q = sqrt(3) k whatever the confining stress; the volume changes elastically only */
START_TEST(triaxial)
{
  const double confining[3] = {0.0, 1e5, 1e6};
  for (int i = 0; i < 3; i++) {
    struct element e = element_start("von_mises", &perfect, -confining[i], -confining[i], -confining[i]);
    for (int step = 0; step < 100; step++) element_triaxial(&e, -5e-4, -confining[i]);
    ck_assert_double_eq_tol(element_q(&e), sqrt(3.0) * 3e4, 1e-6 * 3e4);
    double bulk = 1e7 / (3.0 * (1.0 - 0.5)), volume = e.strain[0] + e.strain[1] + e.strain[2];
    ck_assert_double_eq_tol(volume, -element_q(&e) / 3.0 / bulk, 1e-12);
  }
}
END_TEST

/* t = k + H g_p with g = t/G + g_p */
START_TEST(hardening)
{
  const struct prm prm = {1e7, 0.25, 3e4, 1e5, 1.0, 10.0};
  const int        ladder[2] = {1, 100};
  for (int i = 0; i < 2; i++) {
    struct element e = element_start("von_mises", &prm, 0, 0, 0);
    shear(&e, 0.2, ladder[i]);
    double plastic = (0.2 - 3e4 / G) / (1.0 + 1e5 / G);
    ck_assert_double_eq_tol(sqrt(3.0) * e.history[0], plastic, 1e-13);
    ck_assert_double_eq_tol(shear_stress(&e), 3e4 + 1e5 * plastic, 1e-7);
  }
}
END_TEST

/* On the curve of strength at any strain, 95 % lost after softening_strain, then the remoulded strength. */
START_TEST(softening)
{
  const struct prm prm = {1e7, 0.25, 3e4, 0.0, 6.0, 0.4};
  struct element   e = element_start("von_mises", &prm, 0, 0, 0);
  double           before = 0.0;
  for (int step = 1; step <= 400; step++) {
    shear(&e, 0.01, 1);
    double g = sqrt(3.0) * e.history[0], k = 3e4 * (1.0 / 6.0 + 5.0 / 6.0 * exp(-3.0 * g / 0.4));
    if (step > 1) ck_assert_double_eq_tol(shear_stress(&e), k, 1e-12 * 3e4);
    ck_assert_double_eq_tol(g + shear_stress(&e) / G, 0.01 * step, 1e-12);
    if (before < 0.4 && g >= 0.4) ck_assert_double_eq_tol((3e4 - k) / (3e4 - 5e3), 0.95, 4e-3);
    before = g;
  }
  ck_assert_double_eq_tol(shear_stress(&e), 5e3, 1e-6 * 5e3);
}
END_TEST

/* Softening steeper than the elastic unloading: strength is lost within a step, and the stress lands on the surface. */
START_TEST(brittle)
{
  const struct prm prm = {1e7, 0.25, 3e4, 0.0, 10.0, 1e-4};
  struct element   e = element_start("von_mises", &prm, 0, 0, 0);
  shear(&e, 0.99 * 3e4 / G, 1);
  ck_assert_double_eq(e.history[0], 0.0);
  shear(&e, 0.02 * 3e4 / G, 1);
  ck_assert_double_eq_tol(shear_stress(&e), 3e3, 1e-9);
  ck_assert_double_le(e.law->yield(&prm, e.stress, e.history), 1e-9);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("constitutive/von_mises");
  TCase *tests = tcase_create("von Mises");
  tcase_add_test(tests, pure_shear);
  tcase_add_test(tests, triaxial);
  tcase_add_test(tests, hardening);
  tcase_add_test(tests, softening);
  tcase_add_test(tests, brittle);
  suite_add_tcase(suite, tests);
  return element_run(suite);
}
