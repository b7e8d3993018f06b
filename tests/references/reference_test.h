/* What the tests of references share: parameters set by name, one value at one place, a suite run. */
#ifndef TESTS_REFERENCE_TEST_H
#define TESTS_REFERENCE_TEST_H

#include "references/reference.h"

#include <check.h>
#include <stdlib.h>
#include <string.h>

/* Words of a choice, in order; -1: not among them. */
static inline int word_index(const char *words, const char *word)
{
  const struct reference as_quantities = {.quantities = words};
  return reference_quantity(&as_quantities, word);
}

static inline void set_word(const struct reference *r, void *prm, const char *name, const char *word)
{
  for (const struct param *p = r->params; p->name; p++) {
    char *at = (char *)prm + p->offset;
    if (strcmp(p->name, name) != 0) continue;
    if (p->type == PARAM_CHOICE)
      *(int *)at = word_index(p->words, word);
    else if (p->type == PARAM_INTEGER)
      *(int *)at = atoi(word);
    else
      *(double *)at = strtod(word, NULL);
    return;
  }
  ck_abort_msg("%s has no parameter %s", r->name, name);
}

static inline void set(const struct reference *r, void *prm, const char *name, double v)
{
  for (const struct param *p = r->params; p->name; p++) {
    if (strcmp(p->name, name) != 0) continue;
    ck_assert_msg(v >= p->min && v <= p->max, "%s: %g is out of range", name, v);
    *(double *)((char *)prm + p->offset) = v;
    return;
  }
  ck_abort_msg("%s has no parameter %s", r->name, name);
}

/* Zeroed parameters with the defaults of the table; to be freed. */
static inline void *defaults(const struct reference *r)
{
  void *prm = calloc(1, r->param_size);
  ck_assert_ptr_nonnull(prm);
  for (const struct param *p = r->params; p->name; p++)
    if (p->fallback) set_word(r, prm, p->name, p->fallback);
  return prm;
}

/* A quantity at (x, y) and time t. */
static inline double value_at(const struct reference *r, const void *prm, const char *quantity, double x, double y,
                              double t)
{
  const double place[1][3] = {{x, y, 0.0}};
  double       v = NAN;
  int          q = reference_quantity(r, quantity);
  ck_assert_msg(q >= 0, "%s has no quantity %s", r->name, quantity);
  ck_assert_int_eq(r->value(prm, q, 1, place, t, &v), OK);
  return v;
}

static inline double scale_of(const struct reference *r, const void *prm, const char *quantity)
{
  return r->scale(prm, reference_quantity(r, quantity));
}

/* RMS over n equal cells of [0, H] of the difference of two references in one quantity, a at time t and b at time t_b.
 */
static inline double rms_between(const struct reference *a, const void *pa, const struct reference *b, const void *pb,
                                 const char *quantity, int n, double H, double t, double t_b)
{
  double(*x)[3] = calloc((size_t)n, sizeof *x), *va = calloc((size_t)n, sizeof *va),
  *vb = calloc((size_t)n, sizeof *vb);
  double sum = 0.0;
  for (int i = 0; i < n; i++) x[i][1] = (i + 0.5) * H / n;
  ck_assert_int_eq(a->value(pa, reference_quantity(a, quantity), n, (const double(*)[3])x, t, va), OK);
  ck_assert_int_eq(b->value(pb, reference_quantity(b, quantity), n, (const double(*)[3])x, t_b, vb), OK);
  for (int i = 0; i < n; i++) sum += (va[i] - vb[i]) * (va[i] - vb[i]);
  free(x), free(va), free(vb);
  return sqrt(sum / n);
}

#define CLOSE(value, wanted, tolerance) ck_assert_double_eq_tol(value, wanted, tolerance)

static inline int run_tests(const char *name, int n, const TTest *const *tests)
{
  Suite   *suite = suite_create(name);
  TCase   *all = tcase_create(name);
  SRunner *runner = srunner_create(suite);
  for (int i = 0; i < n; i++) tcase_add_test(all, tests[i]);
  tcase_set_timeout(all, 60);
  suite_add_tcase(suite, all);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed != 0;
}

#define RUN_TESTS(name, ...)                                                                                           \
  int main(void)                                                                                                       \
  {                                                                                                                    \
    const TTest *const tests[] = {__VA_ARGS__};                                                                        \
    return run_tests(name, (int)(sizeof tests / sizeof *tests), tests);                                                \
  }

#endif
