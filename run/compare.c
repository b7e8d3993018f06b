/* `mpmice compare`: one scene on several fluid paths, side by side. */
#include "run/scripts.h"
#include "run/several.h"
#include "run/verbs.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct comparison {
  struct several of;
  enum status    how[MAX_MODULES];
  cJSON         *summary[MAX_MODULES]; /* NULL: it did not run */
};

/** One path in <folder>/<path>. A path that cannot take the scene or fails in it is a result too. */
static enum status run_path(const struct run_options *options, struct comparison *c, int i)
{
  const char *path = c->of.path[i];
  if (!options->quiet) printf("%s on %s\n", c->of.scene, path);
  TRY(several_run(options, &c->of, path, path, false, &c->how[i], &c->summary[i]));
  if (c->how[i] != OK && !options->quiet) printf("%s: %s\n", path, status_message());
  return OK;
}

/* ---- the table ---- */

static void print_row(const struct comparison *c, const char *label, const char *unit, const char *path)
{
  printf("%-24s %-8s", label, unit);
  for (int i = 0; i < c->of.n; i++) printf(" %14.6g       ", several_number(c->summary[i], path));
  printf("\n");
}

/** Value, and how it compares with its limit. */
static void print_metric(const struct comparison *c, const cJSON *first)
{
  const cJSON *unit = json_member(first, "unit");
  printf("%-24s %-8s", first->string, cJSON_IsString(unit) && *unit->valuestring ? unit->valuestring : "-");
  for (int i = 0; i < c->of.n; i++) {
    const cJSON *m = c->summary[i] ? json_member(json_member(c->summary[i], "metrics"), first->string) : NULL;
    const cJSON *value = m ? json_member(m, "value") : NULL;
    const char  *verdict = !m || !cJSON_IsNumber(json_member(m, "limit")) ? ""
                           : cJSON_IsTrue(json_member(m, "pass"))         ? "ok"
                                                                          : "MISSED";
    printf(" %14.5g %-6s", cJSON_IsNumber(value) ? value->valuedouble : NAN, verdict);
  }
  printf("\n");
}

static void print_table(const struct comparison *c)
{
  static const struct {
    const char *label, *unit, *path;
  } row[] = {{"steps", "-", "steps"},
             {"time step, mean", "s", "dt.mean"},
             {"run time", "s", "wall_s"},
             {"solid points", "-", "points_solid"},
             {"water points", "-", "points_fluid"},
             {"mass of water, change", "-", "ledger.mass_fluid_rel"}};
  printf("\n%-24s %-8s", c->of.scene, "unit");
  for (int i = 0; i < c->of.n; i++) printf(" %14s       ", c->of.path[i]);
  printf("\n");
  for (size_t i = 0; i < sizeof row / sizeof *row; i++) print_row(c, row[i].label, row[i].unit, row[i].path);
  for (int i = 0; i < c->of.n; i++) {
    if (!c->summary[i]) continue;
    const cJSON *metrics = json_member(c->summary[i], "metrics");
    for (const cJSON *m = metrics ? metrics->child : NULL; m; m = m->next) print_metric(c, m);
    break;
  }
}

/* ---- compare.json ---- */

/** {"scene", "paths": {"<path>": its summary.json, or {"status": what went wrong}}, "run_time_ratio": {"<path>": wall
 * time over the first path's}} */
static enum status write_comparison(const struct comparison *c)
{
  cJSON      *root = cJSON_CreateObject();
  enum status status = json_add(root, "scene", cJSON_CreateString(c->of.scene));
  cJSON      *paths = cJSON_AddObjectToObject(root, "paths"), *ratio = cJSON_AddObjectToObject(root, "run_time_ratio");
  for (int i = 0; i < c->of.n && status == OK; i++) {
    status = json_add(paths, c->of.path[i], c->summary[i] ? cJSON_Duplicate(c->summary[i], true) : cJSON_CreateNull());
    double times = several_number(c->summary[i], "wall_s") / several_number(c->summary[0], "wall_s");
    if (status == OK) status = json_add(ratio, c->of.path[i], cJSON_CreateNumber(times));
  }
  if (status != OK) cJSON_Delete(root);
  TRY(status);
  return several_write(&c->of, "compare.json", root);
}

static enum status run_all(const struct run_options *options, struct comparison *c)
{
  enum status worst = OK;
  for (int i = 0; i < c->of.n; i++) {
    TRY(run_path(options, c, i));
    if (c->how[i] > worst) worst = c->how[i]; /* a failure counts more than a missed metric */
  }
  print_table(c);
  TRY(write_comparison(c));
  /* a machine without matplotlib has its numbers all the same */
  if (script_run("report.py", c->of.folder) != OK) fprintf(stderr, "mpmice: no report.html: %s\n", status_message());
  if (worst == ERR_METRIC) return FAIL(ERR_METRIC, "a metric missed its limit; see the table above");
  return worst == OK ? OK : FAIL(worst, "a path failed; see above and %s", c->of.folder);
}

enum status verb_compare(const struct run_options *options)
{
  struct comparison c = {.of = {.n = 0}};
  TRY(several_open(options, "compare", &c.of));
  if (!c.of.fluid)
    return FAIL(ERR_INPUT, "%s: has no fluid, so there are no paths to compare; use mpmice run", options->argument);
  enum status status = run_all(options, &c);
  for (int i = 0; i < c.of.n; i++) cJSON_Delete(c.summary[i]);
  return status;
}
