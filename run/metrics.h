/* Metrics: numbers of a run compared with references and judged by the limits of the case. */
#ifndef RUN_METRICS_H
#define RUN_METRICS_H

#include "core/sim.h"
#include "run/summary.h"

struct gauges;
struct loaded_scene;
struct metrics;

/** Compiles the scene's metrics: finds fields, references and the times at which fields are read. */
enum status metrics_create(const struct sim *sim, struct metrics **metrics) MUST_CHECK;
void        metrics_destroy(struct metrics **metrics);
/** Times [n] s, increasing, none after the end of the run: a step must end at each, gauges be sampled there and
 *  metrics_sample be called. */
const double *metrics_times(const struct metrics *metrics, int *n);
/** Reads the fields of the metrics whose time has come. Allocates nothing. */
enum status metrics_sample(struct metrics *metrics, const struct sim *sim) MUST_CHECK;
/** Results so far, one per metric of the scene, NaN before their time: part of a checkpoint. */
double *metrics_values(struct metrics *metrics, int *n);
/** Evaluates the metrics of gauges and judges all by the limits of `loaded` (NULL: no limits). Entries [n] live as long
 *  as `metrics`; a metric whose time lies after t_end, where this run was to end, is left out. RMS and maxima are
 * divided by the scale, single numbers (value, mean, frequency, decay) are the signed difference over the scale, by
 * default over what was expected. A limit holds for the magnitude. */
enum status metrics_finish(struct metrics *metrics, const struct gauges *gauges, const struct loaded_scene *loaded,
                           double t_end, int *n, const struct metric_entry **entries) MUST_CHECK;
/** Writes what the references say of the gauges, folder/references.csv: theory beside gauges.csv. */
enum status metrics_write_references(const struct metrics *metrics, const struct gauges *gauges,
                                     const char *folder) MUST_CHECK;

#endif
