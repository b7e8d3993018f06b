/* What the parts of the metrics share: one compiled metric, and its evaluation on a field or on a series. */
#ifndef RUN_METRIC_PARTS_H
#define RUN_METRIC_PARTS_H

#include "core/sim.h"
#include "run/fields.h"

struct gauges;

/* Values that a metric is compared with: a quantity of a reference, or an expression. */
struct expectancy {
  const struct reference *reference; /* NULL: the expression */
  const void             *params;
  int                     quantity;
  const struct function  *expression;
};

/* A metric made ready. */
struct compiled_metric {
  const struct metric *metric;
  struct expectancy    expected;
  double               at, from, to; /* s */
  double               x[3];         /* m: place of a gauge */
  bool                 single;       /* one number: value, mean, frequency, decay */
  struct field_view    view, wet;    /* of a field; wet.data NULL: every cell counts */
  int                  component;
};

/** At x [n][3] m and time t s. */
enum status expectancy_values(const struct expectancy *e, int n, const double (*x)[3], double t, double *v) MUST_CHECK;
/** What the result is divided by: the scene's scale, else the expected value of a single number, else the reference's
 *  scale. *relative: the result has no unit. */
double metric_scale(const struct compiled_metric *m, double expected, bool *relative);

/** Result of a field metric now, before scaling; `expected`: mean of what was expected. difference
 *  [SCATTER_SCRATCH grid.size] is scratch of roughness and scatter, NULL for other measures. ERR_INPUT: nothing lies in
 * its region. */
enum status metric_of_field(struct compiled_metric *m, const struct sim *sim, double *difference, double *result,
                            double *expected) MUST_CHECK;
enum { SCATTER_SCRATCH = 5 };
/** Adds what a point at x gives to its nodes: sums [3][size], of weight times value and of weights. */
void metric_spread(const struct grid *g, const double x[3], double value, double *sums);
/** Means of the nodes, the third part of sums; NaN next to walls, surfaces and voids. */
double *metric_finish_spread(const struct sim *sim, double *sums);
/** Standard deviation of h2 times the Laplacian of a field of cells or nodes, NaN where it does not count. */
double metric_roughness(const struct grid *g, double *difference);
/** Root mean square of a field of points about a plane through the means of the 4 cells around along each axis, over
 * the points of the region whose cells around all hold points. scratch [SCATTER_SCRATCH grid.size]. */
enum status        metric_of_scatter(struct compiled_metric *m, const struct sim *sim, double *scratch,
                                     double *result) MUST_CHECK;
static inline bool metric_is_crest(const struct metric *m)
{
  return m->measure == MEASURE_CREST || m->measure == MEASURE_CREST_PLACE;
}
/** The highest value of a field of cells along the longest axis of the region, or its place, less what is expected;
 * run/metric_crest.c. */
enum status metric_of_crest(struct compiled_metric *m, const struct sim *sim, double *result,
                            double *expected) MUST_CHECK;
/** Value of a series of n samples at a time between two of them. */
double metric_interpolate(long n, const double *t, const double *v, double at);
/** Result of a gauge metric from the samples v [n] at t [n] s, before scaling. */
enum status metric_of_series(const struct compiled_metric *m, long n, const double *t, const double *v, double *result,
                             double *expected) MUST_CHECK;
/** The highest place of a series that rings: of the cubic through its samples by least squares. ERR_INPUT: it has none
 * inside. */
enum status metric_of_peak(const struct compiled_metric *m, long n, const double *t, const double *v, double *at,
                           double *value) MUST_CHECK;
/** Of MEASURE_FIT: root mean square of the series at the rows of a table within the span, after the shift in time of at
 * most the metric's that makes it least. */
enum status metric_of_fit(const struct compiled_metric *m, long n, const double *t, const double *v, double *result,
                          double *expected) MUST_CHECK;
struct gauges;
/** Of MEASURE_PROFILE: root mean square of a line gauge at the rows of one time of a table of places, mean over the
 * times within the span. */
enum status metric_of_profile(const struct compiled_metric *m, const struct scene *scene, const struct gauges *gauges,
                              double *result) MUST_CHECK;
/** Of MEASURE_MISFIT: sum over cells of |field - share of the cell in the region| over the sum of the shares. Of
 * MEASURE_THICKNESS: cells of the region with a field from 0.01 to 0.99 over the length, in cells, of the border, which
 * is the sum of |gradient|. */
double metric_of_border(struct compiled_metric *m, const struct sim *sim);
/** m: where the quantity of a gauge is meant: the point, the sample of a line, the tracer at the start, the middle of a
 *  load's patch. */
void metric_place_gauge(const struct scene *scene, const char *name, double x[3]);
/** Writes folder/references.csv: at sampling times, what the reference says of each gauge that a metric compares with
 * one; nothing where there is none. */
enum status metric_curves_write(int n, const struct compiled_metric *all, const struct gauges *gauges,
                                const char *folder) MUST_CHECK;

#endif
