/* Gauges: numbers sampled over time, in gauges.csv and kept for the metrics. */
#ifndef RUN_GAUGES_H
#define RUN_GAUGES_H

#include "core/sim.h"

struct gauges;

/** Compiles the scene's gauges into readers and starts <folder>/gauges.csv. marker_range: the markers [first, end) of
 *  a load or tracer (mpm_marker_range). ERR_INPUT: a gauge of an unknown field, of a region without cells, ... */
enum status gauges_create(const struct sim *sim, const char *folder,
                          void (*marker_range)(const struct sim *, const char *name, long *first, long *end),
                          struct gauges **gauges) MUST_CHECK;
void        gauges_destroy(struct gauges **gauges);
/** One row at time sim->t, for which sim->ledger was measured. Allocates nothing until there are more samples than the
 * gauge interval announced. */
enum status gauges_sample(struct gauges *gauges, const struct sim *sim) MUST_CHECK;
/** Brings the file up to date: before a checkpoint and at the end. */
enum status gauges_flush(struct gauges *gauges) MUST_CHECK;
/** After a checkpoint was read: rereads gauges.csv up to time t and drops later rows. */
enum status gauges_resume(struct gauges *gauges, double t) MUST_CHECK;
/** Series of a gauge: n samples at times t [n] s, values v [n]. Sample i of a line is named "name.i".
 *  ERR_INPUT: no such gauge. Valid until the next sample. */
enum status gauges_series(const struct gauges *gauges, const char *name, long *n, const double **t,
                          const double **v) MUST_CHECK;
/** Unit of that series, "-" if none. */
const char *gauges_unit(const struct gauges *gauges, const char *name);
/** s between samples: the scene's, or a thousandth of the end time. */
double gauges_interval(const struct scene *scene);

#endif
