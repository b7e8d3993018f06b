/* `mpmice compare`: one scene on several fluid paths, side by side. */
#include "run/json.h"
#include "run/loop.h"
#include "run/plan.h"
#include "run/scene_read.h"
#include "run/verbs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct comparison {
  char        scene[NAME_LENGTH], folder[LONGEST_PATH];
  int         n;
  char        path[MAX_MODULES][NAME_LENGTH];
  enum status status[MAX_MODULES];
  cJSON      *summary[MAX_MODULES]; /* NULL: it did not run */
};

/* ---- which paths ---- */

static enum status add_path(struct comparison *c, const char *name, size_t length)
{
  if (length >= NAME_LENGTH || c->n == MAX_MODULES)
    return FAIL(ERR_INPUT, "--fluid: %.40s: too long, or too many paths; name each once", name);
  snprintf(c->path[c->n], NAME_LENGTH, "%.*s", (int)length, name);
  const struct module *module = module_find(c->path[c->n]);
  if (!module || !module->is_fluid_path)
    return FAIL(ERR_INPUT, "--fluid: \"%s\" is no fluid path; mpmice list names them", c->path[c->n]);
  c->n++;
  return OK;
}

/** Those of --fluid A,B,...; without it every one there is. */
static enum status choose_paths(const char *fluid, struct comparison *c)
{
  for (int i = 0; all_modules[i] && !fluid; i++)
    if (all_modules[i]->is_fluid_path) TRY(add_path(c, all_modules[i]->name, strlen(all_modules[i]->name)));
  for (const char *at = fluid; at && *at;) {
    size_t length = strcspn(at, ",");
    TRY(add_path(c, at, length));
    at += length + (at[length] == ',');
  }
  return c->n > 0 ? OK : FAIL(ERR_INPUT, "--fluid: no path is named; write --fluid ice,twopoint");
}

/** Whether a path can take the scene; if not, says why. */
static bool takes_scene(const struct run_options *options, const char *path)
{
  struct loaded_scene *loaded = NULL;
  struct run_options   one = *options;
  one.fluid = path;
  enum status status = scene_load(&one, &loaded);
  scene_unload(&loaded);
  if (status != OK) printf("%s: not possible: %s\n", path, status_message());
  return status == OK;
}

/** Without --fluid, paths that cannot take the scene are left out. */
static enum status drop_paths(const struct run_options *options, struct comparison *c)
{
  int n = 0;
  if (options->fluid) return OK;
  for (int i = 0; i < c->n; i++)
    if (takes_scene(options, c->path[i])) memmove(c->path[n++], c->path[i], NAME_LENGTH);
  c->n = n;
  return n > 0 ? OK : FAIL(ERR_INPUT, "%s: no fluid path can take it; see above", options->argument);
}

/** The scene's name and the folder, <out> or out/<scene>-compare. */
static enum status open_comparison(const struct run_options *options, struct comparison *c)
{
  struct loaded_scene *loaded = NULL;
  struct run_options   one = *options;
  TRY(choose_paths(options->fluid, c));
  one.fluid = NULL;
  enum status status = scene_load(&one, &loaded);
  if (status == OK && !loaded->scene.fluid.present)
    status = FAIL(ERR_INPUT, "%s: has no fluid, so there are no paths to compare; use mpmice run", options->argument);
  if (status == OK) memcpy(c->scene, loaded->scene.name, sizeof c->scene);
  scene_unload(&loaded);
  TRY(status);
  TRY(drop_paths(options, c));
  int n = options->out ? snprintf(c->folder, sizeof c->folder, "%s", options->out)
                       : snprintf(c->folder, sizeof c->folder, "out/%s-compare", c->scene);
  return n > 0 && n < LONGEST_PATH ? OK : FAIL(ERR_INPUT, "--out: a name of %d characters; give a shorter one", n);
}

/* ---- running ---- */

/** One path in <folder>/<path>. A path that cannot take the scene or fails in it is a result too. */
static enum status run_path(const struct run_options *options, struct comparison *c, int i)
{
  struct run_options one = *options;
  char               folder[LONGEST_PATH], file[LONGEST_PATH];
  TRY(files_path(c->folder, c->path[i], folder));
  TRY(files_path(folder, "summary.json", file));
  one.fluid = c->path[i];
  one.out = folder;
  if (!options->quiet) printf("%s on %s\n", c->scene, c->path[i]);
  c->status[i] = run_scene(&one);
  if (c->status[i] == INTERRUPTED || c->status[i] == ERR_ENVIRONMENT || c->status[i] == ERR_INPUT) return c->status[i];
  if (c->status[i] != OK && !options->quiet) printf("%s: %s\n", c->path[i], status_message());
  return files_exists(file) ? json_load(file, &c->summary[i]) : OK;
}

/* ---- the table ---- */

static double number_at(const cJSON *summary, const char *path)
{
  const cJSON *item = summary ? json_find(summary, path) : NULL;
  return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

static void print_row(const struct comparison *c, const char *label, const char *unit, const char *path)
{
  printf("%-24s %-8s", label, unit);
  for (int i = 0; i < c->n; i++) printf(" %14.6g       ", number_at(c->summary[i], path));
  printf("\n");
}

/** Value, and how it compares with its limit. */
static void print_metric(const struct comparison *c, const cJSON *first)
{
  const cJSON *unit = json_member(first, "unit");
  printf("%-24s %-8s", first->string, cJSON_IsString(unit) && *unit->valuestring ? unit->valuestring : "-");
  for (int i = 0; i < c->n; i++) {
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
  printf("\n%-24s %-8s", c->scene, "unit");
  for (int i = 0; i < c->n; i++) printf(" %14s       ", c->path[i]);
  printf("\n");
  for (size_t i = 0; i < sizeof row / sizeof *row; i++) print_row(c, row[i].label, row[i].unit, row[i].path);
  for (int i = 0; i < c->n; i++) {
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
  char        file[LONGEST_PATH];
  cJSON      *root = cJSON_CreateObject();
  enum status status = files_path(c->folder, "compare.json", file);
  if (status == OK) status = json_add(root, "scene", cJSON_CreateString(c->scene));
  cJSON *paths = cJSON_AddObjectToObject(root, "paths"), *ratio = cJSON_AddObjectToObject(root, "run_time_ratio");
  for (int i = 0; i < c->n && status == OK; i++) {
    status = json_add(paths, c->path[i], c->summary[i] ? cJSON_Duplicate(c->summary[i], true) : cJSON_CreateNull());
    double times = number_at(c->summary[i], "wall_s") / number_at(c->summary[0], "wall_s");
    if (status == OK) status = json_add(ratio, c->path[i], cJSON_CreateNumber(times));
  }
  char *text = status == OK ? cJSON_Print(root) : NULL;
  cJSON_Delete(root);
  TRY(status);
  if (!text) return FAIL(ERR_ENVIRONMENT, "%s: no memory to write it", file);
  status = files_replace(file, text, strlen(text));
  free(text);
  return status;
}

static enum status run_all(const struct run_options *options, struct comparison *c)
{
  enum status worst = OK;
  for (int i = 0; i < c->n; i++) {
    TRY(run_path(options, c, i));
    if (c->status[i] > worst) worst = c->status[i]; /* a failure counts more than a missed metric */
  }
  print_table(c);
  TRY(write_comparison(c));
  if (worst == ERR_METRIC) return FAIL(ERR_METRIC, "a metric missed its limit; see the table above");
  return worst == OK ? OK : FAIL(worst, "a path failed; see above and %s", c->folder);
}

enum status verb_compare(const struct run_options *options)
{
  struct comparison c = {.n = 0};
  TRY(open_comparison(options, &c));
  enum status status = run_all(options, &c);
  for (int i = 0; i < c.n; i++) cJSON_Delete(c.summary[i]);
  return status;
}
