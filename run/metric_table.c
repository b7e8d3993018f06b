/* Metrics against measured rows: of a gauge over time, of a line of gauges over time and place. */
#include "core/parallel.h"
#include "run/gauges.h"
#include "run/metric_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- rows over time ---- */

struct rows {
  int           n;
  const double *t, *v;
};

/* mean square with the series read `shift` s later; INFINITY: no row in the span */
static double mean_square(const struct compiled_metric *m, const struct rows *rows, double shift, long n,
                          const double *t, const double *v)
{
  double sum = 0;
  int    count = 0;
  for (int i = 0; i < rows->n; i++) {
    if (rows->t[i] < m->from || rows->t[i] > m->to) continue;
    double away = metric_interpolate(n, t, v, rows->t[i] + shift) + m->metric->offset - rows->v[i];
    sum += away * away;
    count++;
  }
  return count > 0 ? sum / count : INFINITY;
}

enum status metric_of_fit(const struct compiled_metric *m, long n, const double *t, const double *v, double *result,
                          double *expected)
{
  enum { TRIES = 400 };
  struct rows rows = {0};
  double      least = INFINITY, most = m->metric->shift;
  rows.n = function_rows(m->expected.expression, &rows.t, &rows.v);
  for (int i = 0; i <= (most > 0 ? TRIES : 0); i++) {
    double shift = most > 0 ? most * (2.0 * i / TRIES - 1) : 0;
    least = fmin(least, mean_square(m, &rows, shift, n, t, v));
  }
  *expected = 0;
  *result = sqrt(least);
  if (least < INFINITY) return OK;
  return FAIL(ERR_INPUT, "metrics.%s: no row of the table from %g s to %g s, or %s is not finite there",
              m->metric->name, m->from, m->to, m->metric->gauge);
}

/* ---- rows over time and place ---- */

static const struct gauge *find_line(const struct scene *scene, const char *name)
{
  for (int i = 0; i < scene->n_gauges; i++)
    if (strcmp(scene->gauges[i].name, name) == 0) return &scene->gauges[i];
  return NULL;
}

/* the sample at time t */
static enum status sample(const struct gauge *g, const struct gauges *gauges, int i, double t, double *value)
{
  char          name[NAME_LENGTH + 16];
  long          n;
  const double *times, *v;
  snprintf(name, sizeof name, "%s.%d", g->name, i);
  TRY(gauges_series(gauges, name, &n, &times, &v));
  *value = n > 0 ? metric_interpolate(n, times, v, t) : NAN;
  return OK;
}

/* the line at place x along the axis that it runs along most, between samples linear */
static enum status at_place(const struct gauge *g, const struct gauges *gauges, double t, double x, double *value)
{
  int    axis = 0;
  double low, high;
  for (int d = 1; d < 3; d++)
    if (fabs(g->to[d] - g->x[d]) > fabs(g->to[axis] - g->x[axis])) axis = d;
  double s = (g->n - 1) * (x - g->x[axis]) / (g->to[axis] - g->x[axis]);
  s = fmin(g->n - 1, fmax(0, s));
  int i = (int)fmin(floor(s), g->n - 2);
  TRY(sample(g, gauges, i, t, &low));
  TRY(sample(g, gauges, i + 1, t, &high));
  *value = low + (s - i) * (high - low);
  return OK;
}

enum status metric_of_profile(const struct compiled_metric *m, const struct scene *scene, const struct gauges *gauges,
                              double *result)
{
  const struct profile *p = &m->metric->profile;
  const struct gauge   *g = find_line(scene, m->metric->gauge);
  double                sum = 0, here;
  int                   times = 0;
  for (int i = 0, end; i < p->n; i = end) {
    double squares = 0;
    for (end = i; end < p->n && p->t[end] == p->t[i]; end++) {
      TRY(at_place(g, gauges, p->t[end], p->x[end], &here));
      squares += (here + m->metric->offset - p->v[end]) * (here + m->metric->offset - p->v[end]);
    }
    if (p->t[i] < m->from || p->t[i] > m->to) continue;
    sum += sqrt(squares / (end - i));
    times++;
  }
  *result = sum / times;
  if (times > 0) return OK;
  return FAIL(ERR_INPUT, "metrics.%s: no row of the table from %g s to %g s", m->metric->name, m->from, m->to);
}
