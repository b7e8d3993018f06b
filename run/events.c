/* Times at which a step must end. */
#include "run/events.h"

#include "core/memory.h"

#include <math.h>
#include <stdlib.h>

static void add(struct events *e, double t, double t_end, int kind)
{
  if (t > 0 && t <= t_end * (1 + 1e-12)) e->event[e->n++] = (struct event){fmin(t, t_end), kind};
}

static int by_time(const void *a, const void *b)
{
  const struct event *x = a, *y = b;
  return (x->t > y->t) - (x->t < y->t);
}

/* events closer than `near` are one, at the later time: an output just before the end must not force a tiny step */
static void merge(struct events *e, double near)
{
  int kept = 0;
  for (int i = 0; i < e->n; i++) {
    int kinds = e->event[i].kinds;
    if (kept > 0 && e->event[i].t - e->event[kept - 1].t <= near) kinds |= e->event[--kept].kinds;
    e->event[kept++] = (struct event){e->event[i].t, kinds};
  }
  e->n = kept;
}

enum status events_create(const struct scene *scene, double output_interval, const double *metric_times,
                          int n_metric_times, double t_end, struct events *events)
{
  long outputs = output_interval > 0 && output_interval < t_end ? (long)(t_end / output_interval + 1e-9) : 0;
  *events = (struct events){0};
  TRY(NEW(&events->event, outputs + scene->output.n_times + n_metric_times + 1));
  for (long i = 1; i <= outputs; i++) add(events, (double)i * output_interval, t_end, EVENT_OUTPUT);
  for (int i = 0; i < scene->output.n_times; i++) add(events, scene->output.times[i], t_end, EVENT_OUTPUT);
  for (int i = 0; i < n_metric_times; i++) add(events, metric_times[i], t_end, EVENT_METRIC);
  add(events, t_end, t_end, EVENT_END | EVENT_OUTPUT);
  qsort(events->event, (size_t)events->n, sizeof *events->event, by_time);
  merge(events, 1e-6 * fmin(t_end, output_interval > 0 ? output_interval : t_end));
  return OK;
}

void events_destroy(struct events *events) { memory_free(&events->event); }

double events_step(const struct events *events, double t, double limit, bool *last)
{
  double left = events->event[events->next].t - t, steps = limit < left ? ceil(left / limit * (1 - 1e-12)) : 1;
  *last = steps <= 1;
  return left / fmax(1, steps);
}
