/* Metrics of a gauge over a span of time. */
#include "run/metric_parts.h"
#include "run/oscillation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* null in a scene is infinite: the middle of that axis */
static double coordinate(const struct scene *scene, int axis, double x)
{
  return isfinite(x) ? x : scene->min[axis] + 0.5 * scene->h * scene->cells[axis];
}

static void place_load(const struct scene *scene, const char *name, double x[3])
{
  for (int i = 0; i < scene->n_loads; i++) {
    const struct shape *s = &scene->loads[i].patch;
    if (strcmp(scene->loads[i].name, name) != 0) continue;
    for (int d = 0; d < scene->dim; d++)
      x[d] = s->kind == SHAPE_BALL ? s->centre[d] : coordinate(scene, d, 0.5 * (s->min[d] + s->max[d]));
  }
}

static void place_tracer(const struct scene *scene, const char *name, double x[3])
{
  for (int i = 0; i < scene->n_tracers; i++)
    if (strcmp(scene->tracers[i].name, name) == 0)
      for (int d = 0; d < scene->dim; d++) x[d] = scene->tracers[i].x[d];
}

static void place_line(const struct scene *scene, const struct gauge *g, int sample, double x[3])
{
  double part = g->n > 1 ? (double)sample / (g->n - 1) : 0;
  for (int d = 0; d < scene->dim; d++) {
    double from = coordinate(scene, d, g->x[d]), to = coordinate(scene, d, g->to[d]);
    x[d] = from + part * (to - from);
  }
}

void metric_place_gauge(const struct scene *scene, const char *name, double x[3])
{
  for (int d = 0; d < 3; d++) x[d] = 0;
  for (int i = 0; i < scene->n_gauges; i++) {
    const struct gauge *g = &scene->gauges[i];
    size_t              length = strlen(g->name);
    if (strncmp(g->name, name, length) != 0 || (name[length] != '\0' && name[length] != '.')) continue;
    if (g->kind == GAUGE_POINT || g->kind == GAUGE_LEVEL) place_line(scene, g, 0, x);
    if (gauge_is_line(g) && name[length] == '.') place_line(scene, g, atoi(name + length + 1), x);
    if (g->kind == GAUGE_TRACER) place_tracer(scene, g->on, x);
    if (g->kind == GAUGE_LOAD) place_load(scene, g->on, x);
  }
}

static enum status expected_at(const struct compiled_metric *m, double t, double *v)
{
  return expectancy_values(&m->expected, 1, (const double(*)[3])m->x, t, v);
}

double metric_interpolate(long n, const double *t, const double *v, double at)
{
  long i = 1;
  if (n == 1 || at <= t[0]) return v[0];
  while (i < n - 1 && t[i] < at) i++;
  if (at >= t[i]) return v[i];
  return v[i - 1] + (v[i] - v[i - 1]) * (at - t[i - 1]) / (t[i] - t[i - 1]);
}

static enum status value(const struct compiled_metric *m, long n, const double *t, const double *v, double *result,
                         double *expected)
{
  TRY(expected_at(m, m->at, expected));
  *result = metric_interpolate(n, t, v, m->at) + m->metric->offset - *expected;
  return OK;
}

/* mean over time by trapezia, of the samples in the span */
static enum status mean(const struct compiled_metric *m, long n, const double *t, const double *v, double *result,
                        double *expected)
{
  double sum = 0, sum_expected = 0, span = 0, here, before = 0;
  for (long i = 0; i < n; i++, before = here) {
    double dt = i > 0 ? t[i] - t[i - 1] : 0;
    TRY(expected_at(m, t[i], &here));
    if (i == 0) continue;
    span += dt;
    sum += 0.5 * dt * (v[i] + v[i - 1]);
    sum_expected += 0.5 * dt * (here + before);
  }
  if (!(span > 0))
    return FAIL(ERR_INPUT, "metrics.%s: fewer than two samples of %s from %g s to %g s; lower output.gauge_interval",
                m->metric->name, m->metric->gauge, m->from, m->to);
  *expected = sum_expected / span;
  *result = sum / span + m->metric->offset - *expected;
  return OK;
}

/* rms or largest difference over the samples */
static enum status spread(const struct compiled_metric *m, long n, const double *t, const double *v, double *result,
                          double *expected)
{
  double squares = 0, largest = 0;
  *expected = 0;
  for (long i = 0; i < n; i++) {
    double here, d;
    TRY(expected_at(m, t[i], &here));
    d = v[i] + m->metric->offset - here;
    squares += d * d;
    if (!(fabs(d) <= largest)) largest = fabs(d);
    *expected += here / (double)n;
  }
  *result = m->metric->measure == MEASURE_RMS ? sqrt(squares / (double)n) : largest;
  return OK;
}

static enum status oscillation(const struct compiled_metric *m, long n, const double *t, const double *v,
                               double *result, double *expected)
{
  double frequency, decay;
  TRY(oscillation_fit(n, t, v, &frequency, &decay));
  TRY(expected_at(m, m->to, expected));
  *result = (m->metric->measure == MEASURE_DECAY ? decay : frequency) - *expected;
  return OK;
}

/* against the first sample: the largest departure, or that of the last sample */
static enum status drift(const struct compiled_metric *m, long n, const double *v, double *result)
{
  double largest = 0;
  if (v[0] == 0)
    return FAIL(ERR_INPUT, "metrics.%s: %s starts from 0, a drift or change relative to it has no meaning; measure max",
                m->metric->name, m->metric->gauge);
  for (long i = 0; i < n; i++)
    if (!(fabs(v[i] / v[0] - 1) <= largest)) largest = fabs(v[i] / v[0] - 1);
  *result = m->metric->measure == MEASURE_CHANGE ? v[n - 1] / v[0] - 1 : largest;
  return OK;
}

/* s: when the series has first come its share of the way from the first to the last sample */
static enum status reach(const struct compiled_metric *m, long n, const double *t, const double *v, double *result,
                         double *expected)
{
  double way = v[n - 1] - v[0], part = m->metric->share * way;
  long   i = 0;
  TRY(expected_at(m, m->to, expected));
  if (way == 0)
    return FAIL(ERR_INPUT, "metrics.%s: %s ends where it began, at %g; there is no way to go", m->metric->name,
                m->metric->gauge, v[0]);
  while ((v[i] - v[0]) / way < m->metric->share) i++;
  *result = i == 0 ? t[0] : t[i - 1] + (t[i] - t[i - 1]) * (v[0] + part - v[i - 1]) / (v[i] - v[i - 1]);
  *result -= *expected;
  return OK;
}

/* above the least value so far */
static double rise(long n, const double *v)
{
  double least = v[0], most = 0;
  for (long i = 0; i < n; i++) {
    least = fmin(least, v[i]);
    if (!(v[i] - least <= most)) most = v[i] - least;
  }
  return most;
}

static enum status excess(const struct compiled_metric *m, long n, const double *t, const double *v, double *result)
{
  *result = 0;
  for (long i = 0; i < n; i++) {
    double here;
    TRY(expected_at(m, t[i], &here));
    if (!(v[i] + m->metric->offset - here <= *result)) *result = v[i] + m->metric->offset - here;
  }
  return OK;
}

static enum status peak(const struct compiled_metric *m, long n, const double *t, const double *v, double *result,
                        double *expected)
{
  double at, highest;
  TRY(expected_at(m, m->to, expected));
  TRY(metric_of_peak(m, n, t, v, &at, &highest));
  *result = (m->metric->measure == MEASURE_PEAK ? highest + m->metric->offset : at) - *expected;
  return OK;
}

enum status metric_of_series(const struct compiled_metric *m, long n, const double *t, const double *v, double *result,
                             double *expected)
{
  double tolerance = 1e-9 * m->to;
  if (m->metric->measure == MEASURE_VALUE && n > 0) return value(m, n, t, v, result, expected);
  if (m->metric->measure == MEASURE_FIT && n > 0) return metric_of_fit(m, n, t, v, result, expected);
  while (n > 0 && t[0] < m->from - tolerance) t++, v++, n--;
  while (n > 0 && t[n - 1] > m->to + tolerance) n--;
  if (n == 0)
    return FAIL(ERR_INPUT, "metrics.%s: no sample of %s from %g s to %g s; lower output.gauge_interval",
                m->metric->name, m->metric->gauge, m->from, m->to);
  *expected = 0;
  switch (m->metric->measure) {
  case MEASURE_MEAN:
    return mean(m, n, t, v, result, expected);
  case MEASURE_FREQUENCY:
  case MEASURE_DECAY:
    return oscillation(m, n, t, v, result, expected);
  case MEASURE_GAIN:
    TRY(expected_at(m, m->to, expected));
    *result = v[n - 1] - v[0] - *expected;
    return OK;
  case MEASURE_RISE:
    *result = rise(n, v);
    return OK;
  case MEASURE_EXCESS:
    return excess(m, n, t, v, result);
  case MEASURE_REACH:
    return reach(m, n, t, v, result, expected);
  case MEASURE_PEAK:
  case MEASURE_PEAK_TIME:
    return peak(m, n, t, v, result, expected);
  case MEASURE_DRIFT:
  case MEASURE_CHANGE:
    return drift(m, n, v, result);
  default:
    return spread(m, n, t, v, result, expected);
  }
}
