/* What the tests of single laws share: parameters by name, one state at a time. */
#ifndef TESTS_EOS_LAW_H
#define TESTS_EOS_LAW_H

#include "eos/eos.h"

#include <check.h>
#include <stdlib.h>
#include <string.h>

enum { LAW_DOUBLES = 16 };

static inline void law_set(const struct eos *law, double *prm, const char *name, double value)
{
  for (const struct param *p = law->params; p->name; p++)
    if (strcmp(p->name, name) == 0) {
      ck_assert_msg(value >= p->min && value <= p->max, "%s: %g is out of range", name, value);
      memcpy((char *)prm + p->offset, &value, sizeof value);
      return;
    }
  ck_abort_msg("%s has no parameter %s", law->name, name);
}

/* The law of this name; prm [LAW_DOUBLES] gets its defaults. */
static inline const struct eos *law_find(const char *name, double *prm)
{
  const struct eos *law = eos_find(name);
  ck_assert_ptr_nonnull(law);
  ck_assert_uint_le(law->param_size, LAW_DOUBLES * sizeof *prm);
  for (const struct param *p = law->params; p->name; p++)
    if (p->fallback) law_set(law, prm, p->name, strtod(p->fallback, NULL));
  return law;
}

#define LAW_AT(function)                                                                                               \
  static inline double law_##function(const struct eos *law, const double *prm, double a, double b)                    \
  {                                                                                                                    \
    double result;                                                                                                     \
    law->function(prm, 1, &a, &b, &result);                                                                            \
    return result;                                                                                                     \
  }
LAW_AT(pressure)
LAW_AT(density)
LAW_AT(compressibility)
LAW_AT(expansion)
LAW_AT(sound_speed)
LAW_AT(energy)
LAW_AT(temperature)
#undef LAW_AT

static inline double law_adiabatic_speed(const struct eos *law, const double *prm, double P, double T)
{
  double c;
  eos_adiabatic_sound_speed(law, prm, 1, &P, &T, &c);
  return c;
}

static inline int law_outside(const struct eos *law, const double *prm, double P, double T)
{
  return law->outside(prm, 1, &P, &T);
}

/* relative */
#define LAW_CLOSE(value, wanted, tolerance) ck_assert_double_eq_tol((value) / (wanted), 1.0, tolerance)

static inline int law_run(const char *name, int n, const TTest *const *tests)
{
  Suite   *suite = suite_create(name);
  TCase   *all = tcase_create(name);
  SRunner *runner = srunner_create(suite);
  for (int i = 0; i < n; i++) tcase_add_test(all, tests[i]);
  suite_add_tcase(suite, all);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#define LAW_TESTS(name, ...)                                                                                           \
  int main(void)                                                                                                       \
  {                                                                                                                    \
    const TTest *const tests[] = {__VA_ARGS__};                                                                        \
    return law_run(name, (int)(sizeof tests / sizeof *tests), tests);                                                  \
  }

#endif
