/* summary.json: what a run did, in numbers. */
#include "run/summary.h"

#include "run/files.h"
#include "run/json.h"
#include "twopoint/twopoint.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* a number that is not finite becomes null */
static void number(cJSON *to, const char *name, double v) { cJSON_AddNumberToObject(to, name, v); }
static void text(cJSON *to, const char *name, const char *v) { cJSON_AddStringToObject(to, name, v ? v : ""); }

static void add_what(cJSON *root, const struct run_record *r)
{
  text(root, "scene", r->scene);
  text(root, "fluid_path", r->fluid_path);
  text(root, "version", r->version);
  number(root, "threads", r->threads);
  number(root, "ranks", r->ranks);
  number(root, "cells", (double)r->cells);
  number(root, "points_solid", (double)r->points_solid);
  number(root, "points_fluid", (double)r->points_fluid);
  cJSON *strays = cJSON_AddObjectToObject(root, "points_strayed");
  number(strays, "put_back", (double)r->points_put_back);
  number(strays, "deleted", (double)r->points_deleted);
  number(strays, "flowed_out", (double)r->points_flowed_out);
  if (r->density_change >= 0) number(root, "density_change", r->density_change);
  number(root, "steps", (double)r->steps);
  number(root, "t_end", r->t_end);
}

static void add_dt(cJSON *root, const struct run_record *r)
{
  cJSON *dt = cJSON_AddObjectToObject(root, "dt");
  number(dt, "min", r->dt_min);
  number(dt, "mean", r->dt_mean);
  number(dt, "max", r->dt_max);
  cJSON *limited_by = cJSON_AddObjectToObject(dt, "limited_by");
  for (int i = 0; i < r->n_limited_by; i++) number(limited_by, r->limited_by[i].name, (double)r->limited_by[i].count);
}

/* how a start at rest came about; nothing where it was not computed */
static void add_start(cJSON *root, const struct start_record *s)
{
  if (!s->computed) return;
  cJSON *start = cJSON_AddObjectToObject(root, "start");
  number(start, "unbalanced_columns", s->column);
  number(start, "unbalanced", s->unbalanced);
  number(start, "static_steps", s->steps);
  cJSON_AddBoolToObject(start, "settled", s->settled);
  if (!s->still || !(s->motion.fall > 0)) return;
  number(start, "speed", s->motion.speed);
  number(start, "speed_of_free_fall", s->motion.fall);
  cJSON_AddBoolToObject(start, "moves", s->moves);
}

static void add_cost(cJSON *root, const struct run_record *r)
{
  number(root, "wall_s", r->wall_s);
  number(root, "cpu_s", r->cpu_s);
  number(root, "peak_rss_bytes", (double)r->peak_rss_bytes);
  cJSON *stages = cJSON_AddArrayToObject(root, "stages");
  for (int i = 0; i < r->n_stages; i++) {
    cJSON *stage = cJSON_CreateObject();
    text(stage, "name", r->stages[i].name);
    number(stage, "calls", (double)r->stages[i].calls);
    number(stage, "seconds", r->stages[i].seconds);
    cJSON_AddItemToArray(stages, stage);
  }
  cJSON *left_out = cJSON_AddArrayToObject(root, "left_out");
  for (int i = 0; i < r->n_left_out; i++) {
    cJSON *stage = cJSON_CreateObject();
    text(stage, "name", r->left_out[i].name);
    text(stage, "why", r->left_out[i].why);
    cJSON_AddItemToArray(left_out, stage);
  }
}

static void add_quality(cJSON *root, const struct run_record *r)
{
  cJSON *solver = cJSON_AddObjectToObject(root, "pressure_solver");
  number(solver, "solves", (double)r->solves);
  number(solver, "iterations_mean", r->solves > 0 ? (double)r->iterations / (double)r->solves : 0);
  number(solver, "with_smg", (double)r->smg);
  number(solver, "with_direct", (double)r->fallbacks);
  number(solver, "residual_max", r->residual_max);
  number(solver, "equilibria", (double)r->equilibria);
  number(solver, "equilibrium_steps_mean",
         r->equilibria > 0 ? (double)r->equilibrium_steps / (double)r->equilibria : 0);
  cJSON *defect = cJSON_AddObjectToObject(root, "volume_defect");
  number(defect, "rms_max", r->defect_rms_max);
  number(defect, "max", r->defect_max);
  cJSON *ledger = cJSON_AddObjectToObject(root, "ledger");
  number(ledger, "mass_solid_rel", r->mass_solid_rel);
  number(ledger, "mass_fluid_rel", r->mass_fluid_rel);
  number(ledger, "momentum_rel", r->momentum_rel);
  number(ledger, "energy_growth_rel", r->energy_growth_rel);
}

static void add_metrics(cJSON *root, const struct run_record *r)
{
  cJSON *metrics = cJSON_AddObjectToObject(root, "metrics");
  for (int i = 0; i < r->n_metrics; i++) {
    const struct metric_entry *m = &r->metrics[i];
    cJSON                     *entry = cJSON_AddObjectToObject(metrics, m->name);
    number(entry, "value", m->value);
    text(entry, "unit", m->unit);
    if (m->has_limit)
      number(entry, "limit", m->limit);
    else
      cJSON_AddNullToObject(entry, "limit");
    cJSON_AddBoolToObject(entry, "pass", m->pass);
    text(entry, "reference", m->reference);
  }
}

enum status summary_write(const char *folder, const struct run_record *record)
{
  char path[LONGEST_PATH];
  TRY(files_path(folder, "summary.json", path));
  cJSON *root = cJSON_CreateObject();
  add_what(root, record);
  add_dt(root, record);
  add_start(root, &record->start);
  add_cost(root, record);
  add_quality(root, record);
  add_metrics(root, record);
  text(root, "status", record->status);
  char *printed = cJSON_Print(root);
  cJSON_Delete(root);
  if (!printed) return FAIL(ERR_ENVIRONMENT, "%s: no memory to write it", path);
  enum status s = files_replace(path, printed, strlen(printed));
  free(printed);
  return s;
}

void summary_add_water(const struct sim *sim, struct run_record *record)
{
  const struct twopoint *w = twopoint_of(sim);
  record->density_change = w ? w->now.density_change : -1;
  if (!w) return;
  record->points_put_back += (long)w->now.put_back;
  record->points_deleted += (long)w->now.deleted;
  record->points_flowed_out += (long)w->now.flowed_out;
}

/* above it water is no longer nearly incompressible */
static const double largest_change = 0.03;

static void print_density(double change)
{
  if (change < 0) return;
  printf("density of the water changed by up to %.2g %%\n", 100 * change);
  if (change > largest_change)
    fprintf(stderr, "mpmice: warning: more than %g %% is not nearly incompressible; raise fluid.bulk_modulus\n",
            100 * largest_change);
}

void summary_print(const struct run_record *record)
{
  print_density(record->density_change);
  for (int i = 0; i < record->n_metrics; i++) {
    const struct metric_entry *m = &record->metrics[i];
    if (i == 0) printf("%-24s %12s %-8s %12s  %s\n", "metric", "value", "unit", "limit", "");
    printf("%-24s %12.5g %-8s ", m->name, m->value, m->unit ? m->unit : "-");
    if (m->has_limit)
      printf("%12.5g  %s\n", m->limit, m->pass ? "ok" : "MISSED");
    else
      printf("%12s  %s\n", "-", m->pass ? "" : "NOT FINITE");
  }
}
