/* What the batteries of registered laws share: parameters from parameters.def, and numbers that look random. */
#ifndef TESTS_BATTERY_BATTERY_H
#define TESTS_BATTERY_BATTERY_H

#include "core/param.h"

#include <check.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PARAMETER_BYTES = 512 };

/* aligned for every member a law may have */
struct parameters {
  union {
    double        align;
    unsigned char bytes[PARAMETER_BYTES];
  };
};

struct parameter_value {
  const char *law;
  int         set;
  const char *name;
  double      value;
};

static const struct parameter_value parameter_values[] = {
#define VALUE(law, set, name, value) {#law, set, #name, value},
#include "parameters.def"
#undef VALUE
};
enum { N_PARAMETER_VALUES = sizeof parameter_values / sizeof *parameter_values };

/** Number of sets of a law. A registered law without one fails. */
static inline int parameters_sets(const char *law)
{
  int sets = 0;
  for (int i = 0; i < N_PARAMETER_VALUES; i++)
    if (strcmp(parameter_values[i].law, law) == 0 && parameter_values[i].set >= sets)
      sets = parameter_values[i].set + 1;
  ck_assert_msg(sets > 0, "%s is registered, but tests/battery/parameters.def has no values for it", law);
  return sets;
}

/* a choice is given by the number of its word */
static inline void parameters_put(const char *law, const struct param *p, double value, struct parameters *prm)
{
  int word = (int)value;
  if (p->type == PARAM_CHOICE) {
    memcpy(&prm->bytes[p->offset], &word, sizeof word);
    return;
  }
  ck_assert_msg(value >= p->min && value <= p->max, "%s: %s = %g is out of its range", law, p->name, value);
  ck_assert_msg(p->type == PARAM_NUMBER, "%s: %s is no number; teach tests/battery/battery.h its type", law, p->name);
  memcpy(&prm->bytes[p->offset], &value, sizeof value);
}

/** The number of a word among "one|two|three". */
static inline int parameters_word(const char *words, const char *word)
{
  int    number = 0;
  size_t length = strlen(word);
  for (const char *w = words; w; number++) {
    const char *end = strchr(w, '|');
    if ((end ? (size_t)(end - w) : strlen(w)) == length && strncmp(w, word, length) == 0) return number;
    w = end ? end + 1 : NULL;
  }
  ck_abort_msg("\"%s\" is none of %s", word, words);
  return 0;
}

static inline double parameters_default(const struct param *p)
{
  if (strcmp(p->fallback, "null") == 0) return INFINITY;
  return p->type == PARAM_CHOICE ? parameters_word(p->words, p->fallback) : strtod(p->fallback, NULL);
}

/** One set of a law's parameters, as its table lays them out. */
static inline void parameters_fill(const char *law, const struct param *table, int set, struct parameters *prm)
{
  memset(prm, 0, sizeof *prm);
  for (const struct param *p = table; p->name; p++) {
    const struct parameter_value *given = NULL;
    for (int i = 0; i < N_PARAMETER_VALUES; i++) {
      const struct parameter_value *v = &parameter_values[i];
      if (strcmp(v->law, law) == 0 && v->set == set && strcmp(v->name, p->name) == 0) given = v;
    }
    ck_assert_msg(given || p->fallback, "%s: set %d in tests/battery/parameters.def lacks %s", law, set, p->name);
    parameters_put(law, p, given ? given->value : parameters_default(p), prm);
  }
}

/** The same sequence in every run: uniform in [-1, 1]. */
static inline double battery_random(uint64_t *state)
{
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return (double)(int64_t)*state / 9.223372036854775808e18;
}

/** Runs a suite of one case: the main of a test program. */
static inline int battery_run(Suite *suite)
{
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif
