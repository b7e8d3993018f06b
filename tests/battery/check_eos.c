/* Every registered equation of state: inversion, derivatives against differences, sound speed, signs, arrays. */
#include "eos/eos.h"
#include "tests/battery/battery.h"

#include <float.h>

enum { N_P = 4, N_T = 4, N_STATES = N_P * N_T };
static const double some_P[N_P] = {5e4, 1e5, 1e6, 5e6};
static const double some_T[N_T] = {275.0, 283.15, 300.0, 350.0};

struct state {
  double P[N_STATES], T[N_STATES], rho[N_STATES], kappa[N_STATES], alpha[N_STATES], c[N_STATES];
};

static void evaluate(const struct eos *law, const void *prm, struct state *s)
{
  for (int i = 0; i < N_STATES; i++) {
    s->P[i] = some_P[i / N_T];
    s->T[i] = some_T[i % N_T];
  }
  law->density(prm, N_STATES, s->P, s->T, s->rho);
  law->compressibility(prm, N_STATES, s->P, s->T, s->kappa);
  law->expansion(prm, N_STATES, s->P, s->T, s->alpha);
  law->sound_speed(prm, N_STATES, s->P, s->T, s->c);
}

/* Calls `test` for every law, set and state. */
static void for_every_state(void (*test)(const struct eos *, const void *, const struct state *, int))
{
  for (const struct eos *const *law = eos_laws; *law; law++)
    for (int set = 0; set < parameters_sets((*law)->name); set++) {
      struct parameters prm;
      struct state      s;
      parameters_fill((*law)->name, (*law)->params, set, &prm);
      evaluate(*law, &prm, &s);
      for (int i = 0; i < N_STATES; i++) test(*law, &prm, &s, i);
    }
}

static double density(const struct eos *law, const void *prm, double P, double T)
{
  double rho;
  law->density(prm, 1, &P, &T, &rho);
  return rho;
}

/* A density is known to eps, hence a pressure to eps/kappa. */
static void inverts(const struct eos *law, const void *prm, const struct state *s, int i)
{
  double P;
  if (s->kappa[i] == 0.0) return;
  law->pressure(prm, 1, &s->rho[i], &s->T[i], &P);
  ck_assert_msg(fabs(P - s->P[i]) <= 4.0 * DBL_EPSILON * (s->P[i] + 1.0 / s->kappa[i]),
                "%s: pressure(density(%g)) = %.17g", law->name, s->P[i], P);
}

static void compressibility_is_derivative(const struct eos *law, const void *prm, const struct state *s, int i)
{
  double dP = s->kappa[i] > 0.0 ? fmin(1e-5 / s->kappa[i], 0.01 * s->P[i]) : 0.5 * s->P[i];
  double difference = log(density(law, prm, s->P[i] + dP, s->T[i]) / density(law, prm, s->P[i] - dP, s->T[i]));
  double kappa = difference / (2.0 * dP), noise = 2.0 * DBL_EPSILON / dP;
  ck_assert_msg(fabs(kappa - s->kappa[i]) <= 1e-4 * s->kappa[i] + noise, "%s: kappa %g at %g Pa, difference %g",
                law->name, s->kappa[i], s->P[i], kappa);
}

static void expansion_is_derivative(const struct eos *law, const void *prm, const struct state *s, int i)
{
  double dT = 0.1, noise = 2.0 * DBL_EPSILON / dT;
  double difference = log(density(law, prm, s->P[i], s->T[i] + dT) / density(law, prm, s->P[i], s->T[i] - dT));
  double alpha = -difference / (2.0 * dT);
  ck_assert_msg(fabs(alpha - s->alpha[i]) <= 1e-6 * fabs(s->alpha[i]) + noise, "%s: alpha %g at %g K, difference %g",
                law->name, s->alpha[i], s->T[i], alpha);
}

/* between the isothermal speed, c^2 = 1/(rho kappa), and the isentropic one, + T (alpha/(kappa rho))^2/c_v */
static void sound_is_between_isothermal_and_isentropic(const struct eos *law, const void *prm, const struct state *s,
                                                       int i)
{
  double isothermal = 1.0 / (s->rho[i] * s->kappa[i]), slope = s->alpha[i] / (s->kappa[i] * s->rho[i]);
  double isentropic = isothermal + s->T[i] * slope * slope / law->heat_capacity(prm), square = s->c[i] * s->c[i];
  if (s->kappa[i] == 0.0) {
    ck_assert_msg(isinf(s->c[i]), "%s: sound travels at %g m/s through an incompressible fluid", law->name, s->c[i]);
    return;
  }
  ck_assert_msg(square >= isothermal * (1.0 - 1e-12) && square <= isentropic * (1.0 + 1e-12),
                "%s: c^2 %g is not between %g and %g", law->name, square, isothermal, isentropic);
}

static void has_physical_signs(const struct eos *law, const void *prm, const struct state *s, int i)
{
  ck_assert_msg(s->rho[i] > 0.0 && isfinite(s->rho[i]), "%s: density %g", law->name, s->rho[i]);
  ck_assert_msg(s->kappa[i] >= 0.0 && isfinite(s->kappa[i]), "%s: compressibility %g", law->name, s->kappa[i]);
  ck_assert_msg(isfinite(s->alpha[i]), "%s: expansion %g", law->name, s->alpha[i]);
  ck_assert_msg(s->c[i] > 0.0, "%s: sound speed %g", law->name, s->c[i]);
  ck_assert_msg(law->heat_capacity(prm) > 0.0, "%s: heat capacity", law->name);
}

/* the same bits for a state alone, with or without temperatures */
static void array_equals_point(const struct eos *law, const void *prm, const struct state *s, int i)
{
  void (*const functions[])(const void *, int, const double *, const double *, double *) = {
      law->pressure, law->density, law->compressibility, law->expansion, law->sound_speed};
  for (size_t f = 0; f < sizeof functions / sizeof *functions; f++)
    for (int with_T = 0; with_T < 2; with_T++) {
      const double *from = f == 0 ? s->rho : s->P;
      double        all[N_STATES], one;
      functions[f](prm, N_STATES, from, with_T ? s->T : NULL, all);
      functions[f](prm, 1, &from[i], with_T ? &s->T[i] : NULL, &one);
      ck_assert_msg(memcmp(&one, &all[i], sizeof one) == 0, "%s: function %zu gives %.17g alone and %.17g in an array",
                    law->name, f, one, all[i]);
    }
}

START_TEST(inversion) { for_every_state(inverts); }
END_TEST
START_TEST(compressibility) { for_every_state(compressibility_is_derivative); }
END_TEST
START_TEST(expansion) { for_every_state(expansion_is_derivative); }
END_TEST
START_TEST(sound_speed) { for_every_state(sound_is_between_isothermal_and_isentropic); }
END_TEST
START_TEST(signs) { for_every_state(has_physical_signs); }
END_TEST
START_TEST(arrays) { for_every_state(array_equals_point); }
END_TEST

START_TEST(found_by_name)
{
  for (const struct eos *const *law = eos_laws; *law; law++) ck_assert_ptr_eq(eos_find((*law)->name), *law);
  ck_assert_ptr_null(eos_find("no such law"));
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("battery/eos");
  TCase *tests = tcase_create("every law");
  tcase_add_test(tests, inversion);
  tcase_add_test(tests, compressibility);
  tcase_add_test(tests, expansion);
  tcase_add_test(tests, sound_speed);
  tcase_add_test(tests, signs);
  tcase_add_test(tests, arrays);
  tcase_add_test(tests, found_by_name);
  suite_add_tcase(suite, tests);
  return battery_run(suite);
}
