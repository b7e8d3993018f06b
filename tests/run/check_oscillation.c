/* Frequency and decay from samples: exact series, overtones, a trend, the waves of a saturated column. */
#include "run/oscillation.h"
#include "tests/references/reference_test.h"

enum { MOST = 4000 };

static double t[MOST], v[MOST];

static void fill(long n, double span, double frequency, double decay, double offset, double slope)
{
  for (long i = 0; i < n; i++) {
    t[i] = 0.3 + span * (double)i / (double)(n - 1);
    v[i] = offset + slope * t[i] + 2.5 * exp(-decay * t[i]) * sin(2 * M_PI * frequency * t[i] + 0.7);
  }
}

static void check(long n, double frequency, double decay, double tolerance)
{
  double f = 0, d = 0;
  ck_assert_int_eq(oscillation_fit(n, t, v, &f, &d), OK);
  CLOSE(f / frequency, 1, tolerance);
  CLOSE(d, decay, tolerance * 2 * M_PI * frequency);
}

START_TEST(exact)
{
  fill(200, 0.1, 55, 12, 0, 0);
  check(200, 55, 12, 1e-7);
  fill(400, 0.1, 55, 0, 1e3, -40);
  check(400, 55, 0, 1e-7);
  fill(300, 2.0, 1.13, 0.4, -5, 3); /* little more than two oscillations */
  check(300, 1.13, 0.4, 1e-6);
  fill(4000, 10.0, 35, -0.05, 0, 0); /* a growing one */
  check(4000, 35, -0.05, 1e-7);
}
END_TEST

START_TEST(uneven_samples)
{
  fill(300, 1.0, 8, 1.5, 2, 0);
  for (int i = 1; i < 299; i++) {
    t[i] += 1e-3 * sin(1.7 * i);
    v[i] = 2 + 2.5 * exp(-1.5 * t[i]) * sin(2 * M_PI * 8 * t[i] + 0.7);
  }
  check(300, 8, 1.5, 1e-6);
}
END_TEST

/* Overtones of a third and a fifth of the amplitude, damped alike, and noise of 1 %: the fundamental is found */
START_TEST(overtones_and_noise)
{
  fill(700, 0.014, 483, 155, 0, 0);
  for (int i = 0; i < 700; i++) {
    double e = 2.5 * exp(-155 * (t[i] - 0.3)), w = 2 * M_PI * 483 * t[i];
    v[i] = 10 + e * (sin(w + 0.7) + sin(3 * w) / 3 + sin(5 * w) / 5) + 0.025 * sin(12.9898 * i * i);
  }
  check(700, 483, 155, 2e-4);
}
END_TEST

/* What the case terzaghi_column+ramp1ms measures, on the exact base pressure: 0.1 % and 1 % */
START_TEST(saturated_column)
{
  const struct reference  *waves = reference_find("column_waves");
  static const char *const names[] = {"young",        "poisson", "porosity", "permeability", "solid_density",
                                      "bulk_modulus", "height",  "load",     "ramp"};
  static const double      values[] = {1e7, 0.3, 0.3, 1e-3, 2650, 2.2e9, 1, 1e4, 1e-3};
  void                    *prm = defaults(waves);
  double                   f = 0, d = 0;
  for (int i = 0; i < 9; i++) set(waves, prm, names[i], values[i]);
  for (int i = 0; i <= 350; i++) {
    t[i] = 2e-3 + 4e-5 * i;
    v[i] = value_at(waves, prm, "P", 0.01, 0.01, t[i]);
  }
  ck_assert_int_eq(oscillation_fit(351, t, v, &f, &d), OK);
  CLOSE(f / value_at(waves, prm, "frequency", 0, 0, 0), 1, 1e-3);
  CLOSE(d / value_at(waves, prm, "decay", 0, 0, 0), 1, 1e-2);
  free(prm);
}
END_TEST

START_TEST(nothing_to_fit)
{
  double f, d;
  fill(10, 1, 3, 0, 0, 0);
  ck_assert_int_eq(oscillation_fit(10, t, v, &f, &d), ERR_INPUT);
  ck_assert_int_eq(oscillation_fit(0, t, v, &f, &d), ERR_INPUT);
  fill(100, 1, 3, 0, 0, 0);
  v[50] = NAN;
  ck_assert_int_eq(oscillation_fit(100, t, v, &f, &d), ERR_INPUT);
}
END_TEST

RUN_TESTS("oscillation", exact, uneven_samples, overtones_and_noise, saturated_column, nothing_to_fit)
