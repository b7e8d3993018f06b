/* Times at which a step must end: snapshots, metrics, the end of the run. */
#ifndef RUN_EVENTS_H
#define RUN_EVENTS_H

#include "core/scene.h"

enum event_kind { EVENT_OUTPUT = 1, EVENT_METRIC = 2, EVENT_END = 4 };

struct event {
  double t;
  int    kinds;
};

struct events {
  struct event *event;
  int           n, next;
};

/** All times in (0, t_end], increasing; times closer than 1e-6 of the output interval are one, the later. */
enum status events_create(const struct scene *scene, double output_interval, const double *metric_times,
                          int n_metric_times, double t_end, struct events *events) MUST_CHECK;
void        events_destroy(struct events *events);
/** Length of the next step: what is left until the next event is shared evenly among the fewest steps <= limit. *last:
 *  this step ends at the event. */
double events_step(const struct events *events, double t, double limit, bool *last);

#endif
