/* mu(I): steady shear at any rate, the transient with the first order in dt, slow flow and rest at mu_s, grains that
 * part and meet again. */
#include "tests/constitutive/element.h"

/* as the law's parameter table lays them out */
struct prm {
  double young, poisson, mu_s, mu_2, I_0, grain_diameter, density;
};

static const struct prm glass = {1e8, 0.25, 0.38, 0.64, 0.279, 1e-3, 2500};
static const double     G = 4e7, p0 = 1e3, d = 1e-3, rho = 2500;

/* mu at a rate of shear strain */
static double friction(double rate)
{
  double I = rate * d * sqrt(rho / p0);
  return glass.mu_s + (glass.mu_2 - glass.mu_s) / (glass.I_0 / I + 1.0);
}

/* simple shear at constant volume */
static void shear(struct element *e, double rate, int steps)
{
  const double dF[9] = {1, rate * e->dt, 0, 0, 1, 0, 0, 0, 1};
  for (int i = 0; i < steps; i++) element_step(e, dF);
}

/* Elastic strains of 1e-5 turn with the spin: the rate of plastic strain is that of the shear up to their square. */
START_TEST(steady_shear)
{
  for (double rate = 1e-3; rate < 1e4; rate *= 10.0) {
    struct element e = element_start("mu_i", &glass, -p0, -p0, -p0);
    e.dt = 1e-6 / rate;
    shear(&e, rate, 400);
    double size = element_size(&e), plastic_rate = e.work / size / e.dt;
    ck_assert_double_eq_tol(element_p(&e), p0, 1e-12 * p0);
    ck_assert_double_eq_tol(plastic_rate, rate, 1e-8 * rate);
    ck_assert_double_eq_tol(size / p0, friction(plastic_rate), 1e-12);
    ck_assert_double_eq_tol(e.stress[XY] / p0, friction(rate), 1e-7);
  }
}
END_TEST

/* dt/ds of the shear stress while it grows at a rate of shear: Runge and Kutta, so small steps that they are exact */
static double growth(double rate, double t)
{
  double over = t - glass.mu_s * p0, plastic = glass.I_0 / d * sqrt(p0 / rho) * over / (glass.mu_2 * p0 - t);
  return G * (rate - (over > 0.0 ? plastic : 0.0));
}

static double exact_shear_stress(double rate, double start, double time)
{
  enum { STEPS = 20000 };
  double t = start, dt = time / STEPS;
  for (int i = 0; i < STEPS; i++) {
    double a = growth(rate, t), b = growth(rate, t + 0.5 * dt * a), c = growth(rate, t + 0.5 * dt * b),
           f = growth(rate, t + dt * c);
    t += dt / 6.0 * (a + 2.0 * b + 2.0 * c + f);
  }
  return t;
}

/* From the edge of flow, half way to steady flow: pure shear, so that axes stay. */
START_TEST(transient)
{
  const double rate = 500.0, time = 6e-9, start = 0.38 * p0, exact = exact_shear_stress(rate, start, time);
  double       before = NAN;
  ck_assert_double_gt(exact, start + 0.3 * (friction(rate) * p0 - start));
  ck_assert_double_lt(exact, start + 0.7 * (friction(rate) * p0 - start));
  for (int steps = 50; steps <= 1600; steps *= 2) {
    struct element e = element_start("mu_i", &glass, start - p0, -start - p0, -p0);
    e.dt = time / steps;
    for (int i = 0; i < steps; i++) element_stretch(&e, 0.5 * rate * e.dt, -0.5 * rate * e.dt, 0.0);
    double error = fabs(0.5 * (e.stress[XX] - e.stress[YY]) - exact) / p0;
    printf("dt %.1e s: error %.2e of p, ratio %.3f\n", e.dt, error, before / error);
    if (steps > 200) ck_assert_double_eq_tol(before / error, 2.0, 0.05);
    before = error;
  }
  ck_assert_double_lt(before, 1e-4);
}
END_TEST

/* An overstress relaxes to mu_s, and what is below stays. */
START_TEST(rest)
{
  for (int below = 0; below < 2; below++) {
    double         t = (below ? 0.37 : 0.6) * p0;
    struct element e = element_start("mu_i", &glass, t - p0, -t - p0, -p0);
    e.dt = 1e-3;
    for (int i = 0; i < 100; i++) element_stretch(&e, 0.0, 0.0, 0.0);
    ck_assert_double_eq_tol(element_size(&e), below ? t : 0.38 * p0, 1e-12 * p0);
    ck_assert_double_eq_tol(element_p(&e), p0, 1e-12 * p0);
  }
}
END_TEST

/* Grains that part, by any steps, have no stress until the volume is that of contact again. */
START_TEST(separation)
{
  const double bulk = 1e8 / 1.5, gain = 0.3, contact = p0 / bulk;
  for (int steps = 1; steps <= 1000; steps *= 10) {
    struct element e = element_start("mu_i", &glass, -p0, -p0, -p0);
    for (int i = 0; i < steps; i++) element_stretch(&e, gain / steps, 0.1 / steps, 0.0);
    ck_assert_double_eq(element_size(&e) + fabs(element_p(&e)), 0.0);
    ck_assert_double_eq_tol(e.history[1], gain + 0.1 - contact, 4e-16 * (10 + steps));
    for (int i = 0; i < steps; i++) element_stretch(&e, -0.9 * gain / steps, 0.0, 0.0);
    ck_assert_double_eq(element_size(&e) + fabs(element_p(&e)), 0.0);
    for (int i = 0; i < steps; i++) element_stretch(&e, -0.1 * gain / steps, -0.1 / steps, 0.0);
    ck_assert_double_eq_tol(element_p(&e), p0, 4e-16 * bulk * (10 + steps));
    ck_assert_double_eq(e.history[1], 0.0);
    ck_assert_double_le(element_size(&e), 0.64 * element_p(&e));
  }
}
END_TEST

START_TEST(parameters)
{
  struct prm wrong = glass;
  wrong.mu_2 = 0.3;
  ck_assert_ptr_null(constitutive_find("mu_i")->check(&glass));
  ck_assert_ptr_nonnull(constitutive_find("mu_i")->check(&wrong));
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("constitutive/mu_i");
  TCase *tests = tcase_create("mu(I)");
  tcase_add_test(tests, steady_shear);
  tcase_add_test(tests, transient);
  tcase_add_test(tests, rest);
  tcase_add_test(tests, separation);
  tcase_add_test(tests, parameters);
  suite_add_tcase(suite, tests);
  return element_run(suite);
}
