/* Every registered equation of state: inversion, derivatives against differences, sound speeds, energy
 * and its Maxwell relation, signs, arrays, and how it goes on outside its range. */
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

/* c^2 = 1/(rho kappa) */
static void sound_is_isothermal(const struct eos *law, const void *prm, const struct state *s, int i)
{
  double square = s->c[i] * s->c[i];
  (void)prm;
  if (s->kappa[i] == 0.0)
    ck_assert_msg(isinf(s->c[i]), "%s: sound travels at %g m/s through an incompressible fluid", law->name, s->c[i]);
  else
    ck_assert_msg(fabs(square * s->rho[i] * s->kappa[i] - 1.0) <= 1e-12, "%s: c^2 %g is not %g", law->name, square,
                  1.0 / (s->rho[i] * s->kappa[i]));
}

static double pressure(const struct eos *law, const void *prm, double rho, double T)
{
  double P;
  law->pressure(prm, 1, &rho, &T, &P);
  return P;
}

static double energy(const struct eos *law, const void *prm, double rho, double T)
{
  double e;
  law->energy(prm, 1, &rho, &T, &e);
  return e;
}

/* T from e, and c_v = de/dT: e is linear in T */
static void energy_has_a_temperature(const struct eos *law, const void *prm, const struct state *s, int i)
{
  double e = energy(law, prm, s->rho[i], s->T[i]), rise = energy(law, prm, s->rho[i], s->T[i] + 100.0) - e, T;
  double c_v = law->heat_capacity(prm);
  law->temperature(prm, 1, &s->rho[i], &e, &T);
  ck_assert_msg(fabs(T - s->T[i]) <= 1e-11 * s->T[i], "%s: temperature(energy(%g)) = %.17g", law->name, s->T[i], T);
  ck_assert_msg(fabs(rise - 100.0 * c_v) <= 1e-9 * rise, "%s: de/dT %g, c_v %g", law->name, rise / 100.0, c_v);
}

/* rho^2 de/drho = P - T dP/dT, both at constant other variable; differences over d of the density and 1 K: P is linear
 * in T. Their error is d^2 of the stiffness, their noise eps/d of what e is made of. */
static void energy_and_pressure_agree(const struct eos *law, const void *prm, double rho, double T, double kappa)
{
  double d = 1e-4, K = kappa > 0.0 ? 1.0 / kappa : 0.0;
  double up = energy(law, prm, rho * (1.0 + d), T), down = energy(law, prm, rho * (1.0 - d), T);
  double slope = rho * (up - down) / (2.0 * d), P = pressure(law, prm, rho, T);
  double push = 0.5 * (pressure(law, prm, rho, T + 1.0) - pressure(law, prm, rho, T - 1.0));
  double unit = fabs(P) + K + fabs(T * push), noise = 8.0 * DBL_EPSILON * rho * fabs(up) / d;
  if (K == 0.0) return; /* no density changes with pressure */
  ck_assert_msg(fabs(slope - (P - T * push)) <= 1e-6 * unit + noise, "%s: rho^2 de/drho %g, P - T dP/dT %g at %g kg/m3",
                law->name, slope, P - T * push, rho);
}

static void energy_obeys_maxwell(const struct eos *law, const void *prm, const struct state *s, int i)
{
  energy_and_pressure_agree(law, prm, s->rho[i], s->T[i], s->kappa[i]);
}

/* Compressed by d without heat, de = P/rho^2 drho by the midpoint, pressure must rise by c^2 drho. */
static void sound_is_adiabatic(const struct eos *law, const void *prm, const struct state *s, int i)
{
  double c, P[2], d = 1e-4;
  eos_adiabatic_sound_speed(law, prm, 1, &s->P[i], &s->T[i], &c);
  ck_assert_msg(c >= s->c[i] * (1.0 - 1e-12), "%s: adiabatic speed %g, isothermal %g", law->name, c, s->c[i]);
  if (s->kappa[i] == 0.0) return;
  for (int way = 0; way < 2; way++) {
    double drho = (way ? d : -d) * s->rho[i], rho = s->rho[i] + drho, e = energy(law, prm, s->rho[i], s->T[i]), T;
    e += (s->P[i] + 0.5 * c * c * drho) * (1.0 / s->rho[i] - 1.0 / rho);
    law->temperature(prm, 1, &rho, &e, &T);
    P[way] = pressure(law, prm, rho, T);
  }
  double square = (P[1] - P[0]) / (2.0 * d * s->rho[i]);
  ck_assert_msg(fabs(square - c * c) <= 1e-6 * c * c, "%s: c^2 %g, along the isentrope %g", law->name, c * c, square);
}

static void has_physical_signs(const struct eos *law, const void *prm, const struct state *s, int i)
{
  ck_assert_msg(s->rho[i] > 0.0 && isfinite(s->rho[i]), "%s: density %g", law->name, s->rho[i]);
  ck_assert_msg(s->kappa[i] >= 0.0 && isfinite(s->kappa[i]), "%s: compressibility %g", law->name, s->kappa[i]);
  ck_assert_msg(isfinite(s->alpha[i]), "%s: expansion %g", law->name, s->alpha[i]);
  ck_assert_msg(s->c[i] > 0.0, "%s: sound speed %g", law->name, s->c[i]);
  ck_assert_msg(law->heat_capacity(prm) > 0.0, "%s: heat capacity", law->name);
}

static void state_is_inside(const struct eos *law, const void *prm, const struct state *s, int i)
{
  ck_assert_msg(law->outside(prm, 1, &s->P[i], &s->T[i]) == 0, "%s: %g Pa, %g K is outside its range: %s", law->name,
                s->P[i], s->T[i], law->range);
}

/* whatever the state: a number, a positive density, told when outside */
static void bears_any_state(const struct eos *law, const void *prm)
{
  static const double P[] = {-1e30, -1e12, -1e9, -1.0, 0.0, 1e-30, 1.0, 1e9, 1e12}, T[] = {-1e3, 0.0, 1e-3, 300.0, 1e5};
  static const double rho[] = {-1.0, 0.0, 1e-300, 1e-9, 1.0, 1e3, 1e6};
  for (int i = 0; i < 45; i++) {
    double p = P[i / 5], t = T[i % 5], r, kappa, alpha, c, fast;
    law->density(prm, 1, &p, &t, &r);
    law->compressibility(prm, 1, &p, &t, &kappa);
    law->expansion(prm, 1, &p, &t, &alpha);
    law->sound_speed(prm, 1, &p, &t, &c);
    eos_adiabatic_sound_speed(law, prm, 1, &p, &t, &fast);
    ck_assert_msg(r > 0.0 && isfinite(r) && kappa >= 0.0 && isfinite(kappa) && isfinite(alpha) && c > 0.0 && fast > 0.0,
                  "%s: %g Pa, %g K: %g kg/m3, kappa %g, alpha %g, c %g, %g", law->name, p, t, r, kappa, alpha, c, fast);
  }
  for (int i = 0; i < 35; i++) {
    double r = rho[i / 5], t = T[i % 5], p = pressure(law, prm, r, t), e = energy(law, prm, r, t);
    ck_assert_msg(!isnan(p) && !isnan(e), "%s: %g kg/m3, %g K: %g Pa, %g J/kg", law->name, r, t, p, e);
  }
}

/* Pa, at 300 K: where the range ends, between -1e12 and 1e5 Pa */
static double edge(const struct eos *law, const void *prm)
{
  double low = -1e12, high = 1e5, T = 300.0;
  ck_assert_msg(law->outside(prm, 1, &low, &T) == 1, "%s: bears a tension of 1e12 Pa", law->name);
  for (int i = 0; i < 200; i++) {
    double middle = 0.5 * (low + high);
    *(law->outside(prm, 1, &middle, &T) ? &low : &high) = middle;
  }
  return low;
}

/* outside: the same relations, no kink at the edge */
static void goes_on_smoothly(const struct eos *law, const void *prm)
{
  double T = 300.0, P = edge(law, prm), K, beyond, kappa[2], rho, alpha;
  law->compressibility(prm, 1, &P, &T, &kappa[0]);
  K = 1.0 / kappa[0];
  beyond = P + 1e-9 * K;
  law->compressibility(prm, 1, &beyond, &T, &kappa[1]);
  ck_assert_msg(fabs(kappa[1] - kappa[0]) <= 1e-7 * kappa[0], "%s: kappa jumps from %g to %g", law->name, kappa[0],
                kappa[1]);
  for (double far = 0.1; far < 1e3; far *= 10.0) {
    double p = P - far * K, d = 1e-4 * K, h = 0.1, noise = 4.0 * DBL_EPSILON * fabs(p) / d;
    law->density(prm, 1, &p, &T, &rho);
    law->compressibility(prm, 1, &p, &T, &kappa[0]);
    law->expansion(prm, 1, &p, &T, &alpha);
    double slope = log(density(law, prm, p + d, T) / density(law, prm, p - d, T)) / (2.0 * d);
    double push = -log(density(law, prm, p, T + h) / density(law, prm, p, T - h)) / (2.0 * h);
    ck_assert_msg(fabs(pressure(law, prm, rho, T) - p) <= 1e-12 * (fabs(p) + 1.0 / kappa[0]), "%s: no inverse at %g Pa",
                  law->name, p);
    ck_assert_msg(fabs(slope - kappa[0]) <= (1e-6 + noise) * kappa[0], "%s: kappa %g, %g", law->name, kappa[0], slope);
    ck_assert_msg(fabs(push - alpha) <= 1e-6 * fabs(alpha) + noise / T + 1e-12, "%s: alpha %g, %g", law->name, alpha,
                  push);
    energy_and_pressure_agree(law, prm, rho, T, kappa[0]);
  }
}

static void for_every_law(bool compressible, void (*test)(const struct eos *, const void *))
{
  for (const struct eos *const *law = eos_laws; *law; law++)
    for (int set = 0; set < parameters_sets((*law)->name); set++) {
      struct parameters prm;
      double            P = 1e5, kappa;
      parameters_fill((*law)->name, (*law)->params, set, &prm);
      (*law)->compressibility(&prm, 1, &P, NULL, &kappa);
      if (kappa > 0.0 || !compressible) test(*law, &prm);
    }
}

/* the same bits for a state alone, with or without temperatures; e and T from e too */
static void array_equals_point(const struct eos *law, const void *prm, const struct state *s, int i)
{
  void (*const functions[])(const void *, int, const double *, const double *, double *) = {
      law->pressure, law->energy, law->density, law->compressibility, law->expansion, law->sound_speed};
  double all[N_STATES], e[N_STATES], one;
  for (size_t f = 0; f < sizeof functions / sizeof *functions; f++)
    for (int with_T = 0; with_T < 2; with_T++) {
      const double *from = f < 2 ? s->rho : s->P;
      functions[f](prm, N_STATES, from, with_T ? s->T : NULL, all);
      functions[f](prm, 1, &from[i], with_T ? &s->T[i] : NULL, &one);
      ck_assert_msg(memcmp(&one, &all[i], sizeof one) == 0, "%s: function %zu gives %.17g alone and %.17g in an array",
                    law->name, f, one, all[i]);
    }
  law->energy(prm, N_STATES, s->rho, s->T, e);
  law->temperature(prm, N_STATES, s->rho, e, all);
  law->temperature(prm, 1, &s->rho[i], &e[i], &one);
  ck_assert_msg(memcmp(&one, &all[i], sizeof one) == 0, "%s: temperature %.17g, %.17g", law->name, one, all[i]);
  eos_adiabatic_sound_speed(law, prm, N_STATES, s->P, s->T, all);
  eos_adiabatic_sound_speed(law, prm, 1, &s->P[i], &s->T[i], &one);
  ck_assert_msg(memcmp(&one, &all[i], sizeof one) == 0, "%s: adiabatic speed %.17g, %.17g", law->name, one, all[i]);
}

START_TEST(inversion) { for_every_state(inverts); }
END_TEST
START_TEST(compressibility) { for_every_state(compressibility_is_derivative); }
END_TEST
START_TEST(expansion) { for_every_state(expansion_is_derivative); }
END_TEST
START_TEST(sound_speed) { for_every_state(sound_is_isothermal); }
END_TEST
START_TEST(temperature) { for_every_state(energy_has_a_temperature); }
END_TEST
START_TEST(maxwell) { for_every_state(energy_obeys_maxwell); }
END_TEST
START_TEST(adiabatic) { for_every_state(sound_is_adiabatic); }
END_TEST
START_TEST(signs) { for_every_state(has_physical_signs); }
END_TEST
START_TEST(range) { for_every_state(state_is_inside); }
END_TEST
START_TEST(any_state) { for_every_law(false, bears_any_state); }
END_TEST
START_TEST(beyond) { for_every_law(true, goes_on_smoothly); }
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
  tcase_add_test(tests, temperature);
  tcase_add_test(tests, maxwell);
  tcase_add_test(tests, adiabatic);
  tcase_add_test(tests, signs);
  tcase_add_test(tests, range);
  tcase_add_test(tests, any_state);
  tcase_add_test(tests, beyond);
  tcase_add_test(tests, arrays);
  tcase_add_test(tests, found_by_name);
  suite_add_tcase(suite, tests);
  return battery_run(suite);
}
