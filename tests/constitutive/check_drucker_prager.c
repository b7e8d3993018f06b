/* Hencky's elasticity exactly, whatever the steps; Mohr and Coulomb's strength where the cone is matched to it;
 * dilation; tip, opening and closing; the wave speed on the cone. */
#include "tests/constitutive/element.h"

enum { PLANE_STRAIN, COMPRESSION, EXTENSION, PLANE_FLOW };

/* as the law's parameter table lays them out */
struct prm {
  double young, poisson, friction_angle_deg, cohesion, dilation_angle_deg;
  int    cone;
};

static const double mu = 4e6, bulk = 1e7 / 1.5; /* of young 1e7, poisson 0.25 */

static struct prm soil(double friction, double cohesion, double dilation, int cone)
{
  return (struct prm){1e7, 0.25, friction, cohesion, dilation, cone};
}

/* stress = E_oed ln(J)/J in one dimension, by one step or by a thousand, small or large */
START_TEST(uniaxial)
{
  const struct prm strong = soil(30, 1e9, 0, PLANE_STRAIN);
  const double     J[4] = {0.5, 0.97, 1.01, 1.6};
  for (int j = 0; j < 4; j++)
    for (int steps = 1; steps <= 1000; steps *= 10) {
      struct element e = element_start("drucker_prager", &strong, 0, 0, 0);
      for (int i = 0; i < steps; i++) element_stretch(&e, 0.0, log(J[j]) / steps, 0.0);
      ck_assert_double_eq_tol(e.stress[YY], 1.2e7 * log(J[j]) / J[j], 1e-15 * 1.2e7 * (10 + steps));
      ck_assert_double_eq_tol(e.stress[XX], e.stress[YY] / 3.0, 1e-15 * 1.2e7 * (10 + steps));
    }
}
END_TEST

/* Simple shear by g: principal axes turn, the logarithmic strain is asinh(g/2). In any steps, whose rotations do not
 * commute with the strain before. */
START_TEST(simple_shear)
{
  const struct prm strong = soil(0, 1e9, 0, PLANE_STRAIN);
  for (double g = 0.03; g < 4.0; g *= 3.0)
    for (int steps = 1; steps <= 1000; steps *= 10) {
      struct element e = element_start("drucker_prager", &strong, 0, 0, 0);
      const double   dF[9] = {1, g / steps, 0, 0, 1, 0, 0, 0, 1}, strain = asinh(0.5 * g), root = sqrt(4.0 + g * g);
      for (int i = 0; i < steps; i++) element_step(&e, dF);
      ck_assert_double_eq_tol(e.stress[XY], 2.0 * mu * strain * 2.0 / root, 4e-15 * mu * (10 + steps));
      ck_assert_double_eq_tol(e.stress[XX], 2.0 * mu * strain * g / root, 4e-15 * mu * (10 + steps));
      ck_assert_double_eq_tol(e.stress[ZZ], 0.0, 4e-15 * mu * (10 + steps));
    }
}
END_TEST

/* s1 = Kp s3 + 2 c sqrt(Kp) in triaxial compression at the outer edges and, turned round, at the inner ones */
START_TEST(triaxial)
{
  const double confining = 1e5, cohesion[2] = {0, 5e3};
  for (int c = 0; c < 2; c++) {
    const struct prm outer = soil(30, cohesion[c], 0, COMPRESSION), inner = soil(30, cohesion[c], 10, EXTENSION);
    struct element   e = element_start("drucker_prager", &outer, -confining, -confining, -confining);
    for (int i = 0; i < 200; i++) element_triaxial(&e, -1e-3, -confining);
    ck_assert_double_eq_tol(element_q(&e), 2.0 * confining + 2.0 * cohesion[c] * sqrt(3.0), 1e-8 * confining);
    e = element_start("drucker_prager", &inner, -confining, -confining, -confining);
    for (int i = 0; i < 200; i++) element_triaxial(&e, 1e-3, -confining);
    ck_assert_double_eq_tol(-element_q(&e), (2.0 * confining + 2.0 * cohesion[c] * sqrt(3.0)) / 3.0, 1e-8 * confining);
  }
}
END_TEST

/* In plane strain: F's cone with associated flow, plane_flow with any; and sin(psi) = volume over shear strain.
 * Stresses are small: with J the elastic strain of a given Cauchy stress grows. */
START_TEST(plane_strain)
{
  const double confining = 0.1, cohesion = 5e-3, dilation[3] = {0, 12, 30};
  for (int i = 0; i < 6; i++) {
    const struct prm prm = soil(30, cohesion, dilation[i % 3], i < 3 ? PLANE_STRAIN : PLANE_FLOW);
    struct element   e = element_start("drucker_prager", &prm, -confining, -confining, -confining), before;
    for (int step = 0; step < 200; step++) {
      before = e;
      element_biaxial(&e, -1e-8, -confining);
    }
    double q = element_q(&e), expected = 2.0 * confining + 2.0 * cohesion * sqrt(3.0);
    printf("dilation %g, %s: %.6f of Mohr and Coulomb's q\n", prm.dilation_angle_deg, i < 3 ? "F" : "flow",
           q / expected);
    if (i >= 2) ck_assert_double_eq_tol(q, expected, 1e-6 * expected);
    if (i < 2) ck_assert_double_lt(q, 0.99 * expected);
    double volume = e.strain[0] + e.strain[1] - before.strain[0] - before.strain[1];
    double shear = e.strain[0] - e.strain[1] - before.strain[0] + before.strain[1];
    ck_assert_double_eq_tol(volume / shear, sin(prm.dilation_angle_deg * M_PI / 180.0), 1e-6);
  }
}
END_TEST

/* A straight path of strain ends in the same stress by any steps. */
START_TEST(steps)
{
  const struct prm prm = soil(30, 0, 5, PLANE_STRAIN);
  double           first[6];
  for (int steps = 1; steps <= 100; steps *= 10) {
    struct element e = element_start("drucker_prager", &prm, -1e4, -1e4, -1e4);
    for (int i = 0; i < steps; i++) element_stretch(&e, 0.02 / steps, -0.05 / steps, 0.01 / steps);
    if (steps == 1) memcpy(first, e.stress, sizeof first);
    for (int k = 0; k < 6; k++) ck_assert_double_eq_tol(e.stress[k], first[k], 1e-11 * fabs(first[YY]));
    ck_assert_double_lt(fabs(e.law->yield(&prm, e.stress, e.history)), 1e-14 * fabs(first[YY]));
  }
}
END_TEST

/* Sand that was pulled apart is without stress until its volume is that of before, by any steps. */
START_TEST(opening)
{
  const struct prm sand = soil(30, 0, 0, PLANE_STRAIN);
  for (int steps = 1; steps <= 1000; steps *= 10) {
    struct element e = element_start("drucker_prager", &sand, -1e4, -1e4, -1e4);
    for (int i = 0; i < steps; i++) element_stretch(&e, 0.4 / steps, 0.3 / steps, 0.0);
    ck_assert_double_eq(element_size(&e) + fabs(element_p(&e)), 0.0);
    ck_assert_double_eq_tol(e.history[1], 0.7 - 1e4 / bulk, 1e-15 * (10 + steps));
    for (int i = 0; i < steps; i++) element_stretch(&e, -0.4 / steps, -0.29 / steps, 0.0);
    ck_assert_double_eq(element_size(&e) + fabs(element_p(&e)), 0.0);
    for (int i = 0; i < steps; i++) element_stretch(&e, 0.0, -0.01 / steps, 0.0);
    ck_assert_double_eq_tol(element_p(&e), 1e4, 1e-15 * bulk * (10 + steps));
    ck_assert_double_eq(e.history[1], 0.0);
  }
}
END_TEST

/* With cohesion the tip pulls with c cot(phi) while it opens, nothing pushes while the gap closes, and that costs work.
 */
START_TEST(cohesive_gap)
{
  const struct prm clay = soil(20, 1e4, 0, COMPRESSION);
  const double     tip = 1e4 / tan(20 * M_PI / 180), elastic = tip / bulk, gap = 0.03;
  struct element   e = element_start("drucker_prager", &clay, 0, 0, 0);
  double           work = 0.0, third = (elastic + gap) / 3.0;
  for (int i = 0; i < 100; i++) {
    element_stretch(&e, third / 100, third / 100, third / 100);
    work += e.work;
  }
  ck_assert_double_eq_tol(element_p(&e), -tip, 1e-9 * tip);
  ck_assert_double_eq_tol(e.history[1], gap, 2.0 * gap * gap); /* tau = J stress grows with J */
  ck_assert_double_eq_tol(work, tip * e.history[1], 1e-9 * work);
  for (int i = 0; i < 99; i++) {
    element_stretch(&e, -third / 100, -third / 100, -third / 100);
    ck_assert_double_ge(e.work, 0.0);
    if (i > 50) ck_assert_double_lt(fabs(element_p(&e)), 1e-9 * tip);
  }
  element_stretch(&e, -0.01, -0.01, -0.01);
  ck_assert_double_eq_tol(element_p(&e), bulk * (0.03 - third / 100 * 3.0) / exp(third * 0.03 - 0.03), 1e-6 * bulk);
}
END_TEST

/* On the cone unloading along the axis of compression is stiffer than elastic; the speed knows. */
START_TEST(wave_speed)
{
  const struct prm prm = soil(35, 0, 0, COMPRESSION);
  const double     rb = 1600, step = 1e-7;
  struct element   e = element_start("drucker_prager", &prm, -1e4, -1e4, -1e4);
  double           elastic = 1.2e7, stiffest = 0.0, c;
  for (int i = 0; i < 50; i++) element_triaxial(&e, -1e-4, -1e4);
  for (int i = 0; i <= 90; i++) {
    struct element moved = e;
    double         x = cos(i * M_PI / 180), y = sin(i * M_PI / 180);
    /* stretch along (x, y) */
    const double dF[9] = {1 + step * x * x, step * x * y, 0, step * x * y, 1 + step * y * y, 0, 0, 0, 1};
    element_step(&moved, dF);
    const double *s = moved.stress, *s0 = e.stress;
    double        change = x * x * (s[XX] - s0[XX]) + 2 * x * y * (s[XY] - s0[XY]) + y * y * (s[YY] - s0[YY]);
    stiffest = fmax(stiffest, change / step);
  }
  c = e.law->wave_speed(&prm, 1, &rb, e.stress, e.history);
  printf("on the cone: stiffest %.4f, wave speed for %.4f of the elastic modulus\n", stiffest / elastic,
         c * c * rb / elastic);
  ck_assert_double_gt(stiffest, 1.01 * elastic);
  ck_assert_double_ge(c * c * rb, stiffest);
  ck_assert_double_le(c * c * rb, 1.1 * stiffest);
}
END_TEST

START_TEST(parameters)
{
  const struct constitutive_model *law = constitutive_find("drucker_prager");
  const struct prm                 good = soil(30, 0, 30, 0), dilating = soil(30, 0, 31, 0), weak = soil(0, 0, 0, 0);
  ck_assert_ptr_null(law->check(&good));
  ck_assert_ptr_nonnull(law->check(&dilating));
  ck_assert_ptr_nonnull(law->check(&weak));
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("constitutive/drucker_prager");
  TCase *tests = tcase_create("Drucker-Prager");
  tcase_add_test(tests, uniaxial);
  tcase_add_test(tests, simple_shear);
  tcase_add_test(tests, triaxial);
  tcase_add_test(tests, plane_strain);
  tcase_add_test(tests, steps);
  tcase_add_test(tests, opening);
  tcase_add_test(tests, cohesive_gap);
  tcase_add_test(tests, wave_speed);
  tcase_add_test(tests, parameters);
  suite_add_tcase(suite, tests);
  return element_run(suite);
}
