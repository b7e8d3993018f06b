/* Linear water against its formula. */
#include "eos/eos.h"

#include <check.h>
#include <stdlib.h>
#include <string.h>

static const struct eos *law;
static double            prm[16];

static void set(const char *name, double value)
{
  for (const struct param *p = law->params; p->name; p++)
    if (strcmp(p->name, name) == 0) {
      memcpy((char *)prm + p->offset, &value, sizeof value);
      return;
    }
  ck_abort_msg("linear_water has no parameter %s", name);
}

/* M's water */
static void setup(void)
{
  law = eos_find("linear_water");
  ck_assert_uint_le(law->param_size, sizeof prm);
  set("reference_density", 999.8);
  set("bulk_modulus", 2e9);
  set("reference_pressure", 101325.0);
  set("expansion", 0.18 / 999.8);
  set("reference_temperature", 283.15);
  set("heat_capacity", 4186.0);
}

START_TEST(reference_state)
{
  double P, rho, T = 283.15, rho_ref = 999.8, P_ref = 101325.0;
  law->pressure(prm, 1, &rho_ref, &T, &P);
  ck_assert_double_eq(P, 101325.0);
  law->density(prm, 1, &P_ref, &T, &rho);
  ck_assert_double_eq(rho, 999.8);
}
END_TEST

/* 0.1 % denser at 10 K more: 2e6 Pa + 2e9 Pa * 0.18/999.8/K * 10 K */
START_TEST(compressed_and_heated)
{
  double P, T = 293.15, rho = 1.001 * 999.8;
  law->pressure(prm, 1, &rho, &T, &P);
  ck_assert_double_eq_tol(P, 101325.0 + 2e6 + 2e10 * 0.18 / 999.8, 1e-5);
}
END_TEST

START_TEST(no_temperature_is_the_reference_temperature)
{
  double with[3], without[3], T[3] = {283.15, 283.15, 283.15}, rho[3] = {999.0, 1000.0, 1010.0};
  law->pressure(prm, 3, rho, T, with);
  law->pressure(prm, 3, rho, NULL, without);
  for (int i = 0; i < 3; i++) ck_assert_double_eq(with[i], without[i]);
}
END_TEST

START_TEST(sound_speed)
{
  double P = 101325.0, c;
  law->sound_speed(prm, 1, &P, NULL, &c);
  ck_assert_double_eq_tol(c, 1414.3550, 1e-4);
}
END_TEST

START_TEST(incompressible)
{
  double P[2] = {0.0, 1e9}, T[2] = {283.15, 293.15}, rho[2], kappa[2], back[2];
  set("bulk_modulus", INFINITY);
  law->density(prm, 2, P, T, rho);
  law->compressibility(prm, 2, P, T, kappa);
  law->pressure(prm, 2, rho, T, back);
  ck_assert_double_eq(rho[0], 999.8);
  ck_assert_double_eq_tol(rho[1], 999.8 - 1.8, 1e-10);
  for (int i = 0; i < 2; i++) {
    ck_assert_double_eq(kappa[i], 0.0);
    ck_assert_double_eq(back[i], 101325.0);
  }
}
END_TEST

int main(void)
{
  Suite   *suite = suite_create("eos/linear_water");
  TCase   *tests = tcase_create("linear water");
  SRunner *runner = srunner_create(suite);
  tcase_add_checked_fixture(tests, setup, NULL);
  tcase_add_test(tests, reference_state);
  tcase_add_test(tests, compressed_and_heated);
  tcase_add_test(tests, no_temperature_is_the_reference_temperature);
  tcase_add_test(tests, sound_speed);
  tcase_add_test(tests, incompressible);
  suite_add_tcase(suite, tests);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
