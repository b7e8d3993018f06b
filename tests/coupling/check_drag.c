/* Every registered drag law: signs, limits, arrays; and each against figures from elsewhere. */
#include "coupling/drag.h"
#include "tests/battery/battery.h"

/* one state of a medium */
struct state {
  double porosity, slip, permeability, diameter;
};

static const struct state ordinary = {0.4, 0.05, 1e-9, 1e-3};

static double coefficient(const char *name, int set, struct state s, double density, double viscosity)
{
  const struct drag_law *law = drag_find(name);
  struct parameters      prm;
  double                 K;
  struct drag_medium     m = {&s.porosity, &s.slip, &s.permeability, &s.diameter, density, viscosity};
  ck_assert_ptr_nonnull(law);
  parameters_fill(name, law->params, set, &prm);
  law->coefficient(&prm, 1, &m, &K);
  return K;
}

static double in_water(const char *name, struct state s) { return coefficient(name, 0, s, 998.0, 1e-3); }

static void for_every_law(void (*test)(const struct drag_law *))
{
  for (const struct drag_law *const *law = drag_laws; *law; law++) test(*law);
}

/* finite and positive in every medium, rest and pores of no size included */
static void is_positive(const struct drag_law *law)
{
  const double porosities[5] = {0.0, 1e-3, 0.3, 0.9, 1.0}, slips[4] = {0.0, 1e-12, 0.1, 100.0};
  for (int n = 0; n < 5; n++)
    for (int u = 0; u < 4; u++) {
      double K = in_water(law->name, (struct state){porosities[n], slips[u], 1e-9, 1e-3});
      ck_assert_msg(isfinite(K) && K >= 0.0, "%s: K = %g at porosity %g, slip %g", law->name, K, porosities[n],
                    slips[u]);
      if (porosities[n] == 0.3) ck_assert_msg(K > 0.0, "%s does not resist", law->name);
    }
}

/* more slip never means a smaller coefficient, and a step of slip no jump */
static void grows_with_slip(const struct drag_law *law)
{
  double before = in_water(law->name, (struct state){0.4, 0.0, 1e-9, 1e-3});
  for (double slip = 1e-9; slip < 10.0; slip *= 1.1) {
    double K = in_water(law->name, (struct state){0.4, slip, 1e-9, 1e-3});
    ck_assert_msg(K >= before && K <= 1.2 * before, "%s: K goes from %g to %g at slip %g", law->name, before, K, slip);
    before = K;
  }
}

/* what it needs and does not get leaves it without resistance, not without a number */
static void is_silent_without_medium(const struct drag_law *law)
{
  struct state none = ordinary;
  ck_assert_msg(law->needs_permeability || law->needs_diameter, "%s needs nothing", law->name);
  if (law->needs_permeability) none.permeability = 0.0;
  if (law->needs_diameter) none.diameter = 0.0;
  ck_assert_double_eq(in_water(law->name, none), 0.0);
}

static void array_equals_point(const struct drag_law *law)
{
  enum { N = 37 };
  double             porosity[N], slip[N], permeability[N], diameter[N], all[N], one;
  struct drag_medium m = {porosity, slip, permeability, diameter, 998.0, 1e-3};
  struct parameters  prm;
  uint64_t           seed = 1;
  parameters_fill(law->name, law->params, 0, &prm);
  for (int i = 0; i < N; i++) {
    porosity[i] = 0.5 + 0.5 * battery_random(&seed);
    slip[i] = fabs(battery_random(&seed));
    permeability[i] = i % 7 ? 1e-9 * (1.5 + battery_random(&seed)) : 0.0;
    diameter[i] = i % 5 ? 1e-3 * (1.5 + battery_random(&seed)) : 0.0;
  }
  law->coefficient(&prm, N, &m, all);
  for (int i = 0; i < N; i++) {
    struct drag_medium own = {&porosity[i], &slip[i], &permeability[i], &diameter[i], 998.0, 1e-3};
    law->coefficient(&prm, 1, &own, &one);
    ck_assert_msg(memcmp(&one, &all[i], sizeof one) == 0, "%s: %.17g alone, %.17g in an array", law->name, one, all[i]);
  }
}

START_TEST(positive) { for_every_law(is_positive); }
END_TEST
START_TEST(slip) { for_every_law(grows_with_slip); }
END_TEST
START_TEST(no_medium) { for_every_law(is_silent_without_medium); }
END_TEST
START_TEST(arrays) { for_every_law(array_equals_point); }
END_TEST

/* sand of k = 1e-3 m/s and porosity 0.3 in water of 1000 kg/m3: n^2 rho g/k */
START_TEST(darcy_from_conductivity)
{
  struct state s = {0.3, 0.0, 1e-3 * 1e-3 / (1000.0 * 9.81), 0.0};
  ck_assert_double_eq_tol(coefficient("darcy", 0, s, 1000.0, 1e-3) / (0.09 * 9.81e6), 1.0, 1e-14);
}
END_TEST

/* Kozeny-Carman is Darcy with kappa = D^2 n^3/(A (1-n)^2) */
START_TEST(kozeny_carman_is_darcy)
{
  const double A[2] = {150.0, 180.0};
  for (int set = 0; set < 2; set++) {
    struct state s = ordinary;
    s.permeability = 1e-6 * 0.064 / (A[set] * 0.36);
    double K = coefficient("kozeny_carman", set, s, 998.0, 1e-3);
    ck_assert_double_eq_tol(K / in_water("darcy", s), 1.0, 1e-14);
  }
}
END_TEST

/* at rest Ergun is Kozeny-Carman, fast it is Burke-Plummer: dp/L = 1.75 (1-n)/n^3 rho q^2/D = K U/n */
START_TEST(ergun_limits)
{
  struct state s = ordinary;
  s.slip = 0.0;
  ck_assert_double_eq_tol(in_water("ergun", s) / in_water("kozeny_carman", s), 1.0, 1e-14);
  s.slip = 1e9;
  double q = 0.4 * s.slip, gradient = 1.75 * 0.6 / 0.064 * 998.0 * q * q / 1e-3;
  ck_assert_double_eq_tol(in_water("ergun", s) * s.slip / 0.4 / gradient, 1.0, 1e-8);
}
END_TEST

/* dense: F -> 10 phi/(1-phi)^2, Kozeny-Carman with A = 180; dilute: Stokes' 18 phi mu/D^2 */
START_TEST(beetstra_limits)
{
  struct state dense = {0.01, 0.0, 0.0, 1e-3}, dilute = {1.0 - 1e-12, 0.0, 0.0, 1e-3};
  double       carman = coefficient("kozeny_carman", 1, dense, 998.0, 1e-3);
  ck_assert_double_eq_tol(in_water("beetstra", dense) / carman, 1.0, 1e-7);
  ck_assert_double_eq_tol(in_water("beetstra", dilute) / (18.0 * 1e-12 * 1e-3 / 1e-6), 1.0, 1e-3);
}
END_TEST

/* Pore velocities of steady flow through 1 m of plug, n dp/L = K(U) U, solved elsewhere: D 1 mm, water 998 kg/m3, 1 mPa
 * s. Kozeny-Carman has A = 180. */
static const struct {
  double phi, dp, carman, beetstra, ergun;
} plugs[] = {
    {0.6, 25331.25, 0.0625462963, 0.04953013244, 0.05311383027},
    {0.6, 101325, 0.2501851852, 0.1387545636, 0.1424330634},
    {0.62, 50662.5, 0.1057299254, 0.0754864826, 0.08051796023},
    {0.66, 101325, 0.149387435, 0.1010529088, 0.1085054293},
    {0.68, 25331.25, 0.03116493656, 0.02913369381, 0.03183410348},
    {0.7, 25331.25, 0.02584821429, 0.02480513553, 0.02729324974},
    {0.7, 101325, 0.1033928571, 0.07918509915, 0.08658586687},
};

static void assert_balance(const char *name, int set, double density, double phi, double dp, double U)
{
  struct state s = {1.0 - phi, U, 0.0, 1e-3};
  double       K = coefficient(name, set, s, density, 1e-3);
  ck_assert_msg(fabs(K * U / ((1.0 - phi) * dp) - 1.0) < 1e-8, "%s: K U = %.10g, n dp/L = %.10g at phi %g", name, K * U,
                (1.0 - phi) * dp, phi);
}

START_TEST(plug_flow)
{
  for (size_t i = 0; i < sizeof plugs / sizeof *plugs; i++) {
    assert_balance("kozeny_carman", 1, 998.0, plugs[i].phi, plugs[i].dp, plugs[i].carman);
    assert_balance("beetstra", 0, 998.0, plugs[i].phi, plugs[i].dp, plugs[i].beetstra);
    assert_balance("ergun", 0, 1000.0, plugs[i].phi, plugs[i].dp, plugs[i].ergun);
  }
}
END_TEST

START_TEST(found_by_name)
{
  for (const struct drag_law *const *law = drag_laws; *law; law++) ck_assert_ptr_eq(drag_find((*law)->name), *law);
  ck_assert_ptr_null(drag_find("no such law"));
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("coupling/drag");
  TCase *tests = tcase_create("every law");
  TCase *figures = tcase_create("figures");
  tcase_add_test(tests, positive);
  tcase_add_test(tests, slip);
  tcase_add_test(tests, no_medium);
  tcase_add_test(tests, arrays);
  tcase_add_test(tests, found_by_name);
  tcase_add_test(figures, darcy_from_conductivity);
  tcase_add_test(figures, kozeny_carman_is_darcy);
  tcase_add_test(figures, ergun_limits);
  tcase_add_test(figures, beetstra_limits);
  tcase_add_test(figures, plug_flow);
  suite_add_tcase(suite, tests);
  suite_add_tcase(suite, figures);
  return battery_run(suite);
}
