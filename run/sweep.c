/* Reading "key=a,b,c", and the override of one of its values. */
#include "run/sweep.h"

#include <stdio.h>
#include <string.h>

static const struct {
  const char *word, *key;
} shorthand[] = {{"h", "grid.h"},
                 {"dt", "numerics.dt_factor"},
                 {"ppc", "numerics.points_per_cell"},
                 {"basis", "numerics.basis"},
                 {"transfer", "numerics.transfer"},
                 {"K", "fluid.bulk_modulus"},
                 {"mu", "fluid.viscosity"}};

static void read_key(const char *text, size_t length, struct sweep *sweep)
{
  snprintf(sweep->key, sizeof sweep->key, "%.*s", (int)length, text);
  for (size_t i = 0; i < sizeof shorthand / sizeof *shorthand; i++)
    if (strcmp(sweep->key, shorthand[i].word) == 0) snprintf(sweep->key, sizeof sweep->key, "%s", shorthand[i].key);
}

enum status sweep_read(const char *option, const char *text, struct sweep *sweep)
{
  size_t length = strcspn(text, "=");
  if (length == 0 || length >= sizeof sweep->key || text[length] != '=' || text[length + 1] == '\0')
    return FAIL(ERR_INPUT, "%s: \"%.80s\" is not KEY=VALUE,VALUE,...; write for instance h=0.04,0.02,0.01", option,
                text);
  read_key(text, length, sweep);
  sweep->n = 0;
  for (const char *at = text + length + 1;; at++) {
    size_t n = strcspn(at, ",");
    if (n == 0 || n >= STEP_LENGTH)
      return FAIL(ERR_INPUT, "%s: \"%.80s\" has an empty or very long value; correct it", option, text);
    if (sweep->n == MAX_STEPS)
      return FAIL(ERR_INPUT, "%s: %s has more than %d values; leave some out", option, sweep->key, MAX_STEPS);
    snprintf(sweep->value[sweep->n++], STEP_LENGTH, "%.*s", (int)n, at);
    at += n;
    if (*at == '\0') return OK;
  }
}

enum status sweep_apply(const struct sweep *sweep, int i, char word[JSON_PATH + STEP_LENGTH],
                        struct run_options *options)
{
  if (options->n_sets == MAX_SETS)
    return FAIL(ERR_INPUT, "--set: more than %d; put them into a variant of the scene", MAX_SETS);
  snprintf(word, JSON_PATH + STEP_LENGTH, "%s=%s", sweep->key, sweep->value[i]);
  options->sets[options->n_sets++] = word;
  return OK;
}

cJSON *sweep_values(const struct sweep *sweep)
{
  cJSON *values = cJSON_CreateArray();
  for (int i = 0; i < sweep->n && values; i++) {
    cJSON *value = NULL;
    if (json_from_word(sweep->key, sweep->value[i], &value) != OK || json_add(values, NULL, value) != OK) {
      cJSON_Delete(values);
      return NULL;
    }
  }
  return values;
}
