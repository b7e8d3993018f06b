/* `mpmice study`: error against run time over ladders of one parameter each, on every path. */
#include "run/several.h"
#include "run/sweep.h"
#include "run/verbs.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* the entry of one run in study.json: its value, what it cost, its metrics */
static enum status entry_of(const struct sweep *sweep, int i, enum status how, const cJSON *summary, cJSON **entry)
{
  static const char *const numbers[] = {"steps", "cells", "points_solid", "points_fluid", "wall_s", "cpu_s"};
  cJSON                   *e = cJSON_CreateObject(), *value = NULL;
  *entry = e;
  TRY(json_from_word(sweep->key, sweep->value[i], &value));
  TRY(json_add(e, "value", value));
  bool done = how == OK || how == ERR_METRIC;
  TRY(json_add(e, "status", cJSON_CreateString(done ? "done" : status_message())));
  for (size_t k = 0; k < sizeof numbers / sizeof *numbers && summary; k++)
    TRY(json_add(e, numbers[k], cJSON_CreateNumber(several_number(summary, numbers[k]))));
  cJSON *metrics = cJSON_AddObjectToObject(e, "metrics");
  cJSON *all = summary ? json_member(summary, "metrics") : NULL;
  for (const cJSON *m = all && done ? all->child : NULL; m; m = m->next)
    TRY(json_add(metrics, m->string, cJSON_CreateNumber(several_number(m, "value"))));
  return OK;
}

/* Order of a metric: the slope of log |value| over log of the parameter, by least squares; NAN with fewer than two
 * runs, or where a value is zero or no number. */
static double order_of(const cJSON *runs, const char *metric)
{
  double       n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  const cJSON *run;
  cJSON_ArrayForEach(run, runs)
  {
    double x = several_number(run, "value"), y = fabs(several_number(json_member(run, "metrics"), metric));
    if (!(x > 0) || !(y > 0)) return NAN;
    n++;
    sx += log(x);
    sy += log(y);
    sxx += log(x) * log(x);
    sxy += log(x) * log(y);
  }
  return n > 1 ? (n * sxy - sx * sy) / (n * sxx - sx * sx) : NAN;
}

static void print_number(double value)
{
  if (isfinite(value)) printf(" %12.4g", value);
  if (!isfinite(value)) printf(" %12s", "-");
}

/* one row per metric: its value in every run and the order; one for the run time */
static enum status print_orders(const char *path, const struct sweep *sweep, const cJSON *runs, cJSON *orders)
{
  const cJSON *run, *metrics = json_member(cJSON_GetArrayItem(runs, 0), "metrics");
  printf("\n%-28s", path);
  for (int i = 0; i < sweep->n; i++) printf(" %12s", sweep->value[i]);
  printf(" %12s\n%-28s", "order", "run time, s");
  cJSON_ArrayForEach(run, runs) print_number(several_number(run, "wall_s"));
  printf("\n");
  for (const cJSON *m = metrics ? metrics->child : NULL; m; m = m->next) {
    double order = order_of(runs, m->string);
    printf("%-28s", m->string);
    cJSON_ArrayForEach(run, runs) print_number(several_number(json_member(run, "metrics"), m->string));
    print_number(order);
    printf("\n");
    if (isfinite(order)) TRY(json_add(orders, m->string, cJSON_CreateNumber(order)));
  }
  return OK;
}

static enum status run_step(const struct run_options *options, const struct several *s, const char *path,
                            const struct sweep *sweep, int i, cJSON *runs)
{
  struct run_options one = *options;
  char               word[JSON_PATH + STEP_LENGTH], name[LONGEST_PATH];
  enum status        how;
  cJSON             *summary, *entry;
  TRY(sweep_apply(sweep, i, word, &one));
  snprintf(name, sizeof name, "%s-%s-%s", path, sweep->key, sweep->value[i]);
  if (!options->quiet) printf("%s on %s, %s\n", s->scene, path, word);
  TRY(several_run(&one, s, path, name, false, &how, &summary));
  if (how != OK && !options->quiet) printf("%s: %s\n", name, status_message());
  enum status status = entry_of(sweep, i, how, summary, &entry);
  cJSON_Delete(summary);
  if (status == OK) return json_add(runs, NULL, entry);
  cJSON_Delete(entry);
  return status;
}

/* {"runs": [...], "orders": {"<metric>": slope}} of one path on one ladder */
static enum status climb(const struct run_options *options, const struct several *s, const char *path,
                         const struct sweep *sweep, cJSON *paths)
{
  cJSON *here = cJSON_AddObjectToObject(paths, path), *runs = cJSON_AddArrayToObject(here, "runs"),
        *orders = cJSON_AddObjectToObject(here, "orders");
  if (!orders) return FAIL(ERR_ENVIRONMENT, "study: no memory for the results");
  for (int i = 0; i < sweep->n; i++) TRY(run_step(options, s, path, sweep, i, runs));
  return print_orders(path, sweep, runs, orders);
}

static enum status climb_all(const struct run_options *options, const struct several *s, cJSON *ladders)
{
  for (int l = 0; l < options->n_ladders; l++) {
    struct sweep sweep;
    cJSON       *ladder = cJSON_CreateObject();
    TRY(sweep_read("--refine", options->ladders[l], &sweep));
    TRY(json_add(ladders, NULL, ladder));
    TRY(json_add(ladder, "key", cJSON_CreateString(sweep.key)));
    TRY(json_add(ladder, "values", sweep_values(&sweep)));
    cJSON *paths = cJSON_AddObjectToObject(ladder, "paths");
    for (int p = 0; p < s->n; p++) TRY(climb(options, s, s->path[p], &sweep, paths));
  }
  return OK;
}

enum status verb_study(const struct run_options *options)
{
  struct several s = {.n = 0};
  cJSON         *root = cJSON_CreateObject();
  if (options->n_ladders == 0)
    return FAIL(ERR_INPUT, "study: --refine is missing; write for instance --refine h=0.04,0.02,0.01");
  enum status status = several_open(options, "study", &s);
  if (status == OK) status = json_add(root, "scene", cJSON_CreateString(s.scene));
  cJSON *ladders = cJSON_AddArrayToObject(root, "ladders");
  if (status == OK) status = climb_all(options, &s, ladders);
  if (status != OK && status != INTERRUPTED) cJSON_Delete(root);
  if (status != OK && status != INTERRUPTED) return status;
  TRY(several_write(&s, "study.json", root)); /* an interrupted study keeps the runs that were done */
  if (!options->quiet) printf("\nfiles: %s; pictures: mpmice plot %s\n", s.folder, s.folder);
  return status;
}
