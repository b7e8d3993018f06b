/* Metrics: compiled from the scene, fed during the run, judged at its end. */
#include "run/metrics.h"

#include "core/memory.h"
#include "references/reference.h"
#include "run/gauges.h"
#include "run/metric_parts.h"
#include "run/scene_read.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct metrics {
  const struct scene     *scene;
  int                     n, n_times, n_entries;
  struct compiled_metric *m;          /* [n] */
  double                 *values;     /* [2 n]: results before scaling; what was expected */
  double                 *times;      /* [n_times] */
  double                 *difference; /* [SCATTER_SCRATCH grid.size], NULL without roughness or scatter */
  struct metric_entry    *entries;    /* [n] */
  char (*units)[NAME_LENGTH];         /* [n] */
};

/* ---- what is expected ---- */

enum status expectancy_values(const struct expectancy *e, int n, const double (*x)[3], double t, double *v)
{
  if (e->reference) return e->reference->value(e->params, e->quantity, n, x, t, v);
  for (int i = 0; i < n; i++) v[i] = function_value(e->expression, x[i], t);
  return OK;
}

double metric_scale(const struct compiled_metric *m, double expected, bool *relative)
{
  const struct expectancy *e = &m->expected;
  double                   scale = m->metric->scale;
  if (m->metric->measure == MEASURE_DRIFT || m->metric->measure == MEASURE_CHANGE) {
    *relative = true;
    return 1;
  }
  if (scale == 0 && m->single) scale = fabs(expected);
  if (scale == 0 && !m->single && e->reference && e->reference->scale)
    scale = e->reference->scale(e->params, e->quantity);
  *relative = scale != 0;
  return scale != 0 ? scale : 1;
}

static void find_expected(const struct scene *scene, const struct metric *metric, struct expectancy *e)
{
  const char *dot = strrchr(metric->reference, '.');
  e->expression = &metric->expected;
  for (int i = 0; dot && i < scene->n_references; i++) {
    const struct reference_use *use = &scene->references[i];
    size_t                      length = (size_t)(dot - metric->reference);
    if (strlen(use->name) != length || strncmp(use->name, metric->reference, length) != 0) continue;
    e->reference = use->reference;
    e->params = use->params;
    e->quantity = reference_quantity(use->reference, dot + 1);
  }
}

/* ---- creation ---- */

/* whether it sums in cells: scratch */
static bool needs_cells(const struct metric *m)
{
  return m->measure == MEASURE_ROUGHNESS || m->measure == MEASURE_SCATTER;
}

static enum status find_field(const struct sim *sim, struct compiled_metric *m)
{
  char why[512];
  int  component;
  if (fields_component(sim, m->metric->field, &m->view, &m->component) != OK) {
    snprintf(why, sizeof why, "%s", status_message());
    return FAIL(ERR_INPUT, "metrics.%s.field: %s", m->metric->name, why);
  }
  if (m->view.field->at == AT_CELL && fields_component(sim, "cells.wet", &m->wet, &component) != OK)
    memset(&m->wet, 0, sizeof m->wet);
  if (metric_is_crest(m->metric) && m->view.field->at != AT_CELL)
    return FAIL(ERR_INPUT, "metrics.%s.field: crests are known of fields of cells, %s belongs to points",
                m->metric->name, m->metric->field);
  if (m->metric->measure == MEASURE_SCATTER && m->view.field->at == AT_CELL)
    return FAIL(ERR_INPUT, "metrics.%s.field: scatter is known of fields of points, %s belongs to cells",
                m->metric->name, m->metric->field);
  bool of_cells = m->metric->measure == MEASURE_MISFIT || m->metric->measure == MEASURE_THICKNESS;
  if (of_cells && m->view.field->at != AT_CELL)
    return FAIL(ERR_INPUT, "metrics.%s.field: this measure is known of fields of cells, %s belongs to points",
                m->metric->name, m->metric->field);
  return OK;
}

static enum status compile(const struct sim *sim, const struct metric *metric, struct compiled_metric *m)
{
  double unit = 1;
  m->metric = metric;
  find_expected(sim->scene, metric, &m->expected);
  if (*metric->reference && !m->expected.reference)
    return FAIL(ERR_INPUT, "metrics.%s.reference: there is no \"%s\"", metric->name, metric->reference);
  if (metric->scaled_time && m->expected.reference && m->expected.reference->time_scale)
    unit = m->expected.reference->time_scale(m->expected.params);
  m->at = fmin(metric->at * unit, isfinite(metric->at) ? INFINITY : sim->scene->time_end);
  m->from = metric->from * unit;
  m->to = fmin(metric->to * unit, isfinite(metric->to) ? INFINITY : sim->scene->time_end);
  m->single = metric->measure == MEASURE_VALUE || metric->measure == MEASURE_MEAN ||
              metric->measure == MEASURE_FREQUENCY || metric->measure == MEASURE_DECAY ||
              metric->measure == MEASURE_REACH || metric->measure == MEASURE_GAIN || metric->measure == MEASURE_PEAK ||
              metric->measure == MEASURE_PEAK_TIME || metric_is_crest(metric);
  if (*metric->field) return find_field(sim, m);
  metric_place_gauge(sim->scene, metric->gauge, m->x);
  return OK;
}

/* s that times may differ by and be the same */
static double tolerance(const struct scene *scene) { return 1e-9 * scene->time_end; }

/* whether a run to t_end reaches all that the metric needs */
static bool in_reach(const struct scene *scene, const struct compiled_metric *m, double t_end)
{
  bool one_time = *m->metric->field || m->metric->measure == MEASURE_VALUE;
  return (one_time ? m->at : m->to) <= t_end + tolerance(scene);
}

static void add_time(struct metrics *metrics, double t)
{
  int i = metrics->n_times;
  for (int k = 0; k < metrics->n_times; k++)
    if (fabs(metrics->times[k] - t) <= tolerance(metrics->scene)) return;
  for (; i > 0 && metrics->times[i - 1] > t; i--) metrics->times[i] = metrics->times[i - 1];
  metrics->times[i] = t;
  metrics->n_times++;
}

static void collect_times(struct metrics *metrics)
{
  for (int i = 0; i < metrics->n; i++) {
    const struct compiled_metric *m = &metrics->m[i];
    bool                          one_time = *m->metric->field || m->metric->measure == MEASURE_VALUE;
    if (one_time && in_reach(metrics->scene, m, metrics->scene->time_end))
      add_time(metrics, fmin(m->at, metrics->scene->time_end));
  }
}

static enum status fill(const struct sim *sim, struct metrics *metrics)
{
  const struct scene *scene = sim->scene;
  TRY(NEW(&metrics->m, metrics->n));
  TRY(NEW(&metrics->values, 2 * metrics->n));
  TRY(NEW(&metrics->times, metrics->n));
  TRY(NEW(&metrics->entries, metrics->n));
  TRY(NEW(&metrics->units, metrics->n));
  for (int i = 0; i < metrics->n; i++) {
    metrics->values[i] = NAN;
    TRY(compile(sim, &scene->metrics[i], &metrics->m[i]));
    if (needs_cells(&scene->metrics[i]) && !metrics->difference)
      TRY(NEW(&metrics->difference, SCATTER_SCRATCH * sim->grid.size));
  }
  collect_times(metrics);
  return OK;
}

enum status metrics_create(const struct sim *sim, struct metrics **metrics)
{
  enum status status;
  TRY(NEW(metrics, 1));
  (*metrics)->scene = sim->scene;
  (*metrics)->n = sim->scene->n_metrics;
  status = fill(sim, *metrics);
  if (status != OK) metrics_destroy(metrics);
  return status;
}

void metrics_destroy(struct metrics **metrics)
{
  if (!*metrics) return;
  memory_free(&(*metrics)->m);
  memory_free(&(*metrics)->values);
  memory_free(&(*metrics)->times);
  memory_free(&(*metrics)->difference);
  memory_free(&(*metrics)->entries);
  memory_free(&(*metrics)->units);
  memory_free(metrics);
}

/* ---- during the run ---- */

const double *metrics_times(const struct metrics *metrics, int *n)
{
  *n = metrics->n_times;
  return metrics->times;
}

double *metrics_values(struct metrics *metrics, int *n)
{
  *n = 2 * metrics->n;
  return metrics->values;
}

enum status metrics_sample(struct metrics *metrics, const struct sim *sim)
{
  for (int i = 0; i < metrics->n; i++) {
    struct compiled_metric *m = &metrics->m[i];
    if (!*m->metric->field || !isnan(metrics->values[i]) || !in_reach(metrics->scene, m, metrics->scene->time_end))
      continue;
    if (sim->t < m->at - tolerance(metrics->scene)) continue;
    TRY(metric_of_field(m, sim, needs_cells(m->metric) ? metrics->difference : NULL, &metrics->values[i],
                        &metrics->values[metrics->n + i]));
  }
  return OK;
}

/* ---- at the end ---- */

/* A series that cannot be measured (diverged, too few samples) gives NaN: the metric is missed, the others are told. */
static enum status measure_gauge(struct metrics *metrics, int i, const struct gauges *gauges)
{
  struct compiled_metric *m = &metrics->m[i];
  const double           *t, *v;
  long                    n;
  if (m->metric->measure == MEASURE_PROFILE) {
    if (metric_of_profile(m, metrics->scene, gauges, &metrics->values[i]) != OK) metrics->values[i] = NAN;
    return OK;
  }
  TRY(gauges_series(gauges, m->metric->gauge, &n, &t, &v));
  if (metric_of_series(m, n, t, v, &metrics->values[i], &metrics->values[metrics->n + i]) != OK)
    metrics->values[i] = NAN;
  return OK;
}

/* what "over" divides by: a gauge at the time of the metric */
static double divisor(const struct compiled_metric *m, const struct gauges *gauges)
{
  const double *t, *v;
  long          n;
  if (gauges_series(gauges, m->metric->over, &n, &t, &v) != OK || n == 0) return NAN;
  return fabs(metric_interpolate(n, t, v, m->metric->measure == MEASURE_VALUE ? m->at : m->to));
}

static void judge(struct metrics *metrics, int i, const struct gauges *gauges, const struct loaded_scene *loaded)
{
  const struct compiled_metric *m = &metrics->m[i];
  struct metric_entry          *entry = &metrics->entries[metrics->n_entries++];
  struct expectation            limit = {0};
  bool                          relative;
  double scale = metric_scale(m, metrics->values[metrics->n + i], &relative), value = metrics->values[i] / scale;
  if (*m->metric->over) {
    value = metrics->values[i] / divisor(m, gauges);
    relative = true;
  }
  const char *unit = *m->metric->field ? m->view.field->unit : gauges_unit(gauges, m->metric->gauge);
  if (m->metric->measure == MEASURE_PROFILE) unit = "m";
  if (m->metric->measure == MEASURE_FREQUENCY) unit = "Hz";
  if (m->metric->measure == MEASURE_DECAY) unit = "1/s";
  if (m->metric->measure == MEASURE_REACH || m->metric->measure == MEASURE_PEAK_TIME) unit = "s";
  if (m->metric->measure == MEASURE_CREST_PLACE) unit = "m";
  snprintf(metrics->units[i], sizeof metrics->units[i], "%s", relative ? "-" : unit);
  if (loaded) scene_expected(loaded, m->metric->name, &limit);
  *entry = (struct metric_entry){.name = m->metric->name,
                                 .unit = metrics->units[i],
                                 .reference = m->metric->reference,
                                 .value = value,
                                 .limit = limit.limit,
                                 .has_limit = limit.has_limit,
                                 .pass = isfinite(value) && (!limit.has_limit || fabs(value) <= limit.limit)};
}

enum status metrics_finish(struct metrics *metrics, const struct gauges *gauges, const struct loaded_scene *loaded,
                           double t_end, int *n, const struct metric_entry **entries)
{
  metrics->n_entries = 0;
  for (int i = 0; i < metrics->n; i++) {
    if (!in_reach(metrics->scene, &metrics->m[i], t_end)) continue;
    if (*metrics->m[i].metric->gauge) TRY(measure_gauge(metrics, i, gauges));
    judge(metrics, i, gauges, loaded);
  }
  *n = metrics->n_entries;
  *entries = metrics->entries;
  return OK;
}

enum status metrics_write_references(const struct metrics *metrics, const struct gauges *gauges, const char *folder)
{
  return metric_curves_write(metrics->n, metrics->m, gauges, folder);
}
