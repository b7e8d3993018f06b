/* Modified Cam-clay: lines in v over ln p, elastic paths, drained and undrained failure in closed form, swelling to
 * nothing and back, what a constant Poisson's ratio costs. */
#include "tests/constitutive/element.h"

enum { PLASTIC_STRAIN, PC, V };

/* as the law's parameter table lays them out */
struct prm {
  double kappa, lambda, M, friction_angle_deg, poisson, void_ratio, preconsolidation_pressure, overconsolidation_ratio,
      floor_pressure;
};

static const double p0 = 1e5, kappa = 0.05, lambda = 0.25, M = 0.9;

static struct prm clay(double overconsolidation_ratio)
{
  return (struct prm){0.05, 0.25, 0.9, 0, 0.25, 1.2, 0, overconsolidation_ratio, 1e3};
}

static struct element isotropic(const struct prm *prm) { return element_start("cam_clay", prm, -p0, -p0, -p0); }

/* equal strains, positive in compression, of volume in all */
static void squeeze(struct element *e, double volume, int steps)
{
  for (int i = 0; i < steps; i++) element_stretch(e, -volume / 3 / steps, -volume / 3 / steps, -volume / 3 / steps);
}

/* swelling line to pc, compression line beyond, swelling line back: exact by any steps */
START_TEST(isotropic_lines)
{
  const struct prm prm = clay(3.0);
  for (int steps = 1; steps <= 1000; steps *= 10) {
    struct element e = isotropic(&prm);
    double         N = 2.2 - kappa * log(3.0);
    squeeze(&e, 0.02, steps);
    ck_assert_double_eq_tol(e.history[V], 2.2 * exp(-0.02), 1e-13);
    ck_assert_double_eq_tol(element_p(&e), p0 * exp((2.2 - e.history[V]) / kappa), 1e-9 * p0);
    squeeze(&e, 0.08, steps);
    ck_assert_double_eq_tol(element_p(&e), 3 * p0 * exp((N - e.history[V]) / lambda), 1e-9 * p0);
    ck_assert_double_eq_tol(e.history[PC], element_p(&e), 1e-9 * p0);
    double v = e.history[V], p = element_p(&e);
    squeeze(&e, -0.05, steps);
    ck_assert_double_eq_tol(element_p(&e), p * exp((v - e.history[V]) / kappa), 1e-9 * p0);
    ck_assert_double_eq_tol(e.history[PC], p, 1e-9 * p0);
    ck_assert_double_lt(element_size(&e), 1e-9 * p0);
  }
}
END_TEST

/* With a constant Poisson's ratio q grows in proportion with p on a straight path of strain: oedometer. */
START_TEST(elastic_path)
{
  const struct prm prm = clay(20.0);
  for (int steps = 1; steps <= 1000; steps *= 10) {
    struct element e = isotropic(&prm);
    for (int i = 0; i < steps; i++) element_stretch(&e, 0.0, 0.03 / steps, 0.0);
    ck_assert_double_lt(element_p(&e), 0.6 * p0);
    ck_assert_double_eq_tol((e.stress[XX] + p0) / (e.stress[YY] + p0), 0.25 / 0.75, 1e-11);
    ck_assert_double_eq(e.history[PLASTIC_STRAIN], 0.0);
  }
}
END_TEST

/* Critical state q = M p on v = N - (lambda - kappa) ln 2 - lambda ln p, from both sides; where the stress starts on
 * the ellipse, friction_angle_deg is the other way to say M. */
START_TEST(drained)
{
  const double ratio[3] = {1, 2, 12};
  for (int i = 0; i < 3; i++) {
    struct prm     prm = clay(ratio[i]);
    struct element e = isotropic(&prm);
    double         N = 2.2 + lambda * log(p0) + (lambda - kappa) * log(ratio[i]), peak = 0.0;
    if (i == 1) prm.M = 0, prm.friction_angle_deg = asin(3 * M / (6 + M)) * 180 / M_PI;
    for (int step = 0; step < 1500; step++) {
      element_triaxial(&e, -1e-3, -p0);
      peak = fmax(peak, element_q(&e));
    }
    double p = 3 * p0 / (3 - M), v = N - (lambda - kappa) * log(2) - lambda * log(p);
    printf("drained, OCR %g: q %.6f of 3 M p0/(3 - M), v %.6f of %.6f\n", ratio[i], element_q(&e) / (M * p),
           e.history[V], v);
    ck_assert_double_eq_tol(element_q(&e), M * p, 1e-3 * M * p);
    ck_assert_double_eq_tol(e.history[V], v, 1e-3);
    if (i == 2) ck_assert_double_gt(peak, 1.3 * M * p);
    if (i == 0) ck_assert_double_le(peak, 1.0001 * M * p);
  }
}
END_TEST

/* At constant volume p (1 + (q/p)^2/M^2)^L is p0 OCR^L, L = (lambda - kappa)/lambda, on the ellipse at every step, and
 * the strength is M/2 p0 (OCR/2)^L. */
START_TEST(undrained)
{
  const double ratio[4] = {1, 1.5, 4, 20}, L = (lambda - kappa) / lambda;
  for (int i = 0; i < 4; i++) {
    const struct prm prm = clay(ratio[i]);
    struct element   e = isotropic(&prm);
    for (int step = 0; step < 3000; step++) {
      element_stretch(&e, 2.5e-4, -5e-4, 2.5e-4);
      double p = element_p(&e), share = element_q(&e) / p / M;
      if (e.history[PLASTIC_STRAIN] > 0)
        ck_assert_double_eq_tol(p * pow(1 + share * share, L), p0 * pow(ratio[i], L), 1e-9 * p0);
      else
        ck_assert_double_eq_tol(p, p0, 1e-12 * p0);
    }
    double strength = 0.5 * M * p0 * pow(0.5 * ratio[i], L);
    printf("undrained, OCR %g: strength %.7f of M/2 p0 (OCR/2)^L\n", ratio[i], 0.5 * element_q(&e) / strength);
    ck_assert_double_eq_tol(0.5 * element_q(&e), strength, 1e-5 * strength);
    ck_assert_double_eq_tol(element_q(&e), M * element_p(&e), 1e-5 * strength);
  }
}
END_TEST

/* stress after a given strain, by halves of the step: first order */
START_TEST(order)
{
  const struct prm prm = clay(1.0);
  double           size[7], before = NAN;
  for (int i = 0; i < 7; i++) {
    struct element e = isotropic(&prm);
    int            steps = 10 << i;
    for (int step = 0; step < steps; step++) element_stretch(&e, 0.01 / steps, -0.03 / steps, 0.0);
    size[i] = element_size(&e);
  }
  for (int i = 1; i < 7; i++) {
    double change = fabs(size[i] - size[i - 1]) / p0;
    printf("%d steps: sqrt(J2) moves by %.2e p0, ratio %.2f\n", 10 << i, change, before / change);
    if (i > 2) ck_assert_double_ge(before / change, 1.9);
    before = change;
  }
}
END_TEST

/* Clay pulled apart by half its volume bears next to nothing; pressed again it meets its compression line where it left
 * it, as v + kappa ln p + (lambda - kappa) ln pc never changes. */
START_TEST(swollen)
{
  const struct prm prm = clay(1.0);
  const double     N = 2.2 + lambda * log(p0);
  for (int steps = 1; steps <= 1000; steps *= 10) {
    struct element e = isotropic(&prm);
    for (int i = 0; i < steps; i++) element_stretch(&e, 0.4 / steps, -0.1 / steps, 0.2 / steps);
    ck_assert_double_ge(element_p(&e), 0.0);
    ck_assert_double_lt(element_p(&e) + element_size(&e), 2.0 * prm.floor_pressure);
    squeeze(&e, 0.6, steps);
    double p = element_p(&e), v = e.history[V];
    ck_assert_double_eq_tol(v, 2.2 * exp(-0.1), 1e-12);
    ck_assert_double_eq_tol(v + kappa * log(p) + (lambda - kappa) * log(e.history[PC]), N, 1e-11);
    ck_assert_double_eq_tol(p, exp((N - v) / lambda), 1e-3 * p);
  }
}
END_TEST

/* Shear, compression, unshearing, swelling: G has grown in between, and q^2/6 (1/G0 - 1/G1) is lost. */
START_TEST(elastic_loop)
{
  enum { STEPS = 2000 };
  const struct prm prm = clay(30.0);
  struct element   e = isotropic(&prm);
  double           work = 0.0, G[4], q = 0.0, before, after;
  e.law->energy(&prm, 1, e.F, e.stress, e.history, &before);
  for (int k = 0; k < 4; k++) {
    G[k] = 0.6 * e.history[V] * element_p(&e) / kappa;
    double shear[4] = {4e-3, 0, -q / (3 * G[k]), 0}, volume[4] = {0, 0.01, 0, -0.01};
    for (int i = 0; i < STEPS; i++) {
      struct element old = e;
      double         s = shear[k] / STEPS, v = volume[k] / STEPS;
      element_stretch(&e, -v / 3 + s / 2, -v / 3 - s, -v / 3 + s / 2);
      work += 0.5 * (element_p(&e) + element_p(&old)) * v + 0.5 * (element_q(&e) + element_q(&old)) * s;
    }
    if (k == 0) q = element_q(&e);
  }
  e.law->energy(&prm, 1, e.F, e.stress, e.history, &after);
  double lost = q * q / 6.0 * (1.0 / G[0] - 1.0 / G[2]);
  printf("elastic loop: %.4f J/m3 lost, expected %.4f; sheared it held %.4f\n", work, lost, q * q / 6 / G[0]);
  ck_assert_double_eq(e.history[PLASTIC_STRAIN], 0.0);
  ck_assert_double_eq_tol(after, before, 1e-9 * before);
  ck_assert_double_eq_tol(work, lost, 1e-4 * lost);
}
END_TEST

START_TEST(start)
{
  struct prm   prm = clay(2.0);
  const double stress[6] = {-6e4, -1e5, -6e4, 0, 0, 0}, p = 2.2e5 / 3, q = 4e4;
  double       history[3];
  constitutive_find("cam_clay")->start(&prm, 1, stress, history);
  ck_assert_double_eq_tol(history[PC], 2.0 * (p + q * q / (M * M * p)), 1e-9 * p);
  ck_assert_double_eq(history[V], 2.2);
  prm.preconsolidation_pressure = 1e6;
  constitutive_find("cam_clay")->start(&prm, 1, stress, history);
  ck_assert_double_eq(history[PC], 1e6);
}
END_TEST

START_TEST(parameters)
{
  const char *(*check)(const void *) = constitutive_find("cam_clay")->check;
  struct prm prm = clay(1.0);
  ck_assert_ptr_null(check(&prm));
  prm.friction_angle_deg = 30;
  ck_assert_ptr_nonnull(check(&prm));
  prm.M = prm.friction_angle_deg = 0;
  ck_assert_ptr_nonnull(check(&prm));
  prm = clay(1.0);
  prm.lambda = prm.kappa;
  ck_assert_ptr_nonnull(check(&prm));
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("constitutive/cam_clay");
  TCase *tests = tcase_create("Cam-clay");
  tcase_add_test(tests, isotropic_lines);
  tcase_add_test(tests, elastic_path);
  tcase_add_test(tests, drained);
  tcase_add_test(tests, undrained);
  tcase_add_test(tests, order);
  tcase_add_test(tests, swollen);
  tcase_add_test(tests, elastic_loop);
  tcase_add_test(tests, start);
  tcase_add_test(tests, parameters);
  suite_add_tcase(suite, tests);
  return element_run(suite);
}
