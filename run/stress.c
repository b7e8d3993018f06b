/* `mpmice stress`: where a scene stays stable, over the product of several parameters, on every path. */
#include "run/several.h"
#include "run/sweep.h"
#include "run/verbs.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_AXES = 6, REASON = 512 };

/* what a stable run stays below; the case book's rules for every run */
static const struct {
  const char *path, *what;
  double      most;
} bounds[] = {{"ledger.mass_solid_rel", "mass of the solid changed by", 1e-12},
              {"ledger.mass_fluid_rel", "mass of the fluid changed by", 1e-12},
              {"ledger.energy_growth_rel", "energy grew by", 1e-3},
              {"volume_defect.rms_max", "volume defect (rms) reached", 1e-3}};

struct map {
  struct several of;
  int            n_axes, total, done;
  struct sweep   axis[MAX_AXES];
  cJSON         *paths;
};

/* Stable: it came to its end, conserved what it must, did not gain energy, and filled its room. Else why, in words. */
static bool judge(enum status how, const cJSON *summary, char why[REASON])
{
  *why = '\0';
  if (how != OK && how != ERR_METRIC) {
    snprintf(why, REASON, "%s", status_message());
    return false;
  }
  for (size_t i = 0; i < sizeof bounds / sizeof *bounds; i++) {
    double value = several_number(summary, bounds[i].path);
    if (!isnan(value) && !(fabs(value) <= bounds[i].most)) {
      snprintf(why, REASON, "%s %.3g, more than %g", bounds[i].what, value, bounds[i].most);
      return false;
    }
  }
  return true;
}

/* place of a run on every axis: the last one changes fastest */
static void place_of(const struct map *m, int run, int place[MAX_AXES])
{
  for (int a = m->n_axes - 1; a >= 0; a--) {
    place[a] = run % m->axis[a].n;
    run /= m->axis[a].n;
  }
}

static enum status record(const struct map *m, const int place[], bool stable, const char *why, const cJSON *summary,
                          cJSON *runs)
{
  static const char *const numbers[] = {"steps", "wall_s", "ledger.energy_growth_rel", "volume_defect.rms_max"};
  static const char *const names[] = {"steps", "wall_s", "energy_growth_rel", "defect_rms_max"};
  cJSON                   *entry = cJSON_CreateObject();
  TRY(json_add(runs, NULL, entry));
  cJSON *at = cJSON_AddArrayToObject(entry, "at");
  for (int a = 0; a < m->n_axes; a++) TRY(json_add(at, NULL, cJSON_CreateNumber(place[a])));
  TRY(json_add(entry, "stable", cJSON_CreateBool(stable)));
  TRY(json_add(entry, "why", cJSON_CreateString(why)));
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers && summary; i++)
    TRY(json_add(entry, names[i], cJSON_CreateNumber(several_number(summary, numbers[i]))));
  return OK;
}

static enum status run_one(const struct run_options *options, struct map *m, const char *path, int run, cJSON *runs)
{
  struct run_options one = *options;
  char               word[MAX_AXES][JSON_PATH + STEP_LENGTH], name[LONGEST_PATH], why[REASON];
  int                place[MAX_AXES];
  enum status        how;
  cJSON             *summary;
  place_of(m, run, place);
  one.quiet = true;
  printf("[%d/%d] %s", ++m->done, m->total, path);
  for (int a = 0; a < m->n_axes; a++) {
    TRY(sweep_apply(&m->axis[a], place[a], word[a], &one));
    printf(" %s", word[a]);
  }
  fflush(stdout);
  snprintf(name, sizeof name, "%s-%d", path, run);
  TRY(several_run(&one, &m->of, path, name, true, &how, &summary));
  bool stable = judge(how, summary, why);
  printf(": %s\n", stable ? "stable" : why);
  enum status status = record(m, place, stable, why, summary, runs);
  cJSON_Delete(summary);
  return status;
}

/* a block of the map: rows the first axis, columns the last; other axes at one place each */
static void print_map(const struct map *m, const char *path, const cJSON *runs)
{
  const struct sweep *columns = &m->axis[m->n_axes - 1];
  int                 n = cJSON_GetArraySize(runs);
  printf("\n%s: + stable, . not; across: %s\n", path, columns->key);
  for (int i = 0; i < n; i += columns->n) {
    int place[MAX_AXES];
    place_of(m, i, place);
    for (int a = 0; a < m->n_axes - 1; a++) printf("%s=%-10s ", m->axis[a].key, m->axis[a].value[place[a]]);
    for (int j = 0; j < columns->n && i + j < n; j++)
      printf(" %c", cJSON_IsTrue(json_member(cJSON_GetArrayItem(runs, i + j), "stable")) ? '+' : '.');
    printf("\n");
  }
}

static enum status run_map(const struct run_options *options, struct map *m)
{
  int each = m->total / m->of.n;
  for (int p = 0; p < m->of.n; p++) {
    cJSON *here = cJSON_AddObjectToObject(m->paths, m->of.path[p]), *runs = cJSON_AddArrayToObject(here, "runs");
    if (!runs) return FAIL(ERR_ENVIRONMENT, "stress: no memory for the results");
    for (int run = 0; run < each; run++) TRY(run_one(options, m, m->of.path[p], run, runs));
    print_map(m, m->of.path[p], runs);
  }
  return OK;
}

/* without --sweep: the step against the stiffness of the fluid, or against the points per cell of a dry scene */
static enum status read_axes(const struct run_options *options, struct map *m)
{
  const char *usual[] = {"dt=0.2,0.5,0.8,0.95,1.2", m->of.fluid ? "K=1e6,1e7,1e8,1e9,1e10" : "ppc=1,4,9,16"};
  int         n = options->n_ladders > 0 ? options->n_ladders : 2;
  m->total = m->of.n;
  if (n > MAX_AXES) return FAIL(ERR_INPUT, "--sweep: more than %d; split the study", MAX_AXES);
  for (m->n_axes = 0; m->n_axes < n; m->n_axes++) {
    struct sweep *axis = &m->axis[m->n_axes];
    TRY(sweep_read("--sweep", options->n_ladders > 0 ? options->ladders[m->n_axes] : usual[m->n_axes], axis));
    m->total *= axis->n;
  }
  return OK;
}

static enum status describe(const struct map *m, cJSON *root)
{
  TRY(json_add(root, "scene", cJSON_CreateString(m->of.scene)));
  cJSON *axes = cJSON_AddArrayToObject(root, "axes");
  for (int a = 0; a < m->n_axes; a++) {
    cJSON *axis = cJSON_CreateObject();
    TRY(json_add(axes, NULL, axis));
    TRY(json_add(axis, "key", cJSON_CreateString(m->axis[a].key)));
    TRY(json_add(axis, "values", sweep_values(&m->axis[a])));
  }
  cJSON *limits = cJSON_AddObjectToObject(root, "limits");
  for (size_t i = 0; i < sizeof bounds / sizeof *bounds; i++)
    TRY(json_add(limits, bounds[i].path, cJSON_CreateNumber(bounds[i].most)));
  return OK;
}

enum status verb_stress(const struct run_options *options)
{
  struct map m = {.n_axes = 0};
  TRY(several_open(options, "stress", &m.of));
  TRY(read_axes(options, &m));
  cJSON      *root = cJSON_CreateObject();
  enum status status = describe(&m, root);
  m.paths = cJSON_AddObjectToObject(root, "paths");
  if (status == OK) status = run_map(options, &m);
  if (status != OK && status != INTERRUPTED) cJSON_Delete(root);
  if (status != OK && status != INTERRUPTED) return status;
  TRY(several_write(&m.of, "stress.json", root)); /* an interrupted map keeps the runs that were done */
  printf("\nfiles: %s; pictures: mpmice plot %s\n", m.of.folder, m.of.folder);
  return status;
}
