/* Metrics of a field at one time: differences at cell centres or points inside a region. */
#include "core/parallel.h"
#include "run/metric_parts.h"

#include <math.h>
#include <string.h>

enum { BATCH = 512 };

/* sums over the places that count */
struct tally {
  const struct compiled_metric *m;
  double                        t;
  int                           n; /* waiting in the batch */
  double                        x[BATCH][3], value[BATCH], expected[BATCH];
  long                          where[BATCH];
  long                          count;
  double                        sum, sizes, squares, largest, sum_expected;
  double                       *difference; /* of cells, or sums at nodes of what points give; NULL: not kept */
  const struct grid            *grid;
  bool                          points;
};

static enum status empty_batch(struct tally *a)
{
  if (a->n > 0) TRY(expectancy_values(&a->m->expected, a->n, (const double(*)[3])a->x, a->t, a->expected));
  for (int i = 0; i < a->n; i++) {
    double d = a->value[i] - a->expected[i];
    a->sum += d;
    a->sizes += fabs(d);
    a->squares += d * d;
    if (!(fabs(d) <= a->largest)) a->largest = fabs(d);
    a->sum_expected += a->expected[i];
    if (a->difference && a->points) metric_spread(a->grid, a->x[i], d, a->difference);
    if (a->difference && !a->points) a->difference[a->where[i]] = d;
  }
  a->count += a->n;
  a->n = 0;
  return OK;
}

static enum status add(struct tally *a, const double x[3], double value, long where)
{
  memcpy(a->x[a->n], x, sizeof a->x[0]);
  a->value[a->n] = value;
  a->where[a->n++] = where;
  return a->n == BATCH ? empty_batch(a) : OK;
}

static enum status add_cells(struct tally *a, const struct sim *sim)
{
  const struct compiled_metric *m = a->m;
  const struct box              cells = grid_cells(&sim->grid);
  FOR_BOX_SERIAL(&sim->grid, cells, c)
  {
    double x[3] = {0, 0, 0};
    grid_centre(&sim->grid, c, x);
    if (a->difference) a->difference[c] = NAN;
    if ((m->wet.data && m->wet.data[c] == 0) || !shape_contains(&m->metric->region, x)) continue;
    TRY(add(a, x, m->view.data[c * m->view.components + m->component], c));
  }
  return OK;
}

static enum status add_points(struct tally *a, const struct sim *sim)
{
  const struct compiled_metric *m = a->m;
  struct field_view             place;
  if (!fields_positions(sim, m->view.field->at, &place))
    return FAIL(ERR_INPUT, "metrics.%s.field: %s belongs to points without a place", m->metric->name, m->metric->field);
  for (long i = 0; i < m->view.n; i++) {
    double x[3] = {0, 0, 0};
    memcpy(x, &place.data[i * place.components], (size_t)place.components * sizeof *x);
    if (!shape_contains(&m->metric->region, x)) continue;
    TRY(add(a, x, m->view.data[i * m->view.components + m->component], i));
  }
  return OK;
}

static double measure(struct tally *a, const struct sim *sim)
{
  double n = (double)a->count;
  switch (a->m->metric->measure) {
  case MEASURE_RMS:
    return sqrt(a->squares / n);
  case MEASURE_MAX:
    return a->largest;
  case MEASURE_L1:
    return a->sizes / n;
  case MEASURE_ROUGHNESS:
    return metric_roughness(&sim->grid, a->points ? metric_finish_spread(sim, a->difference) : a->difference);
  default:
    return a->sum / n;
  }
}

enum status metric_of_field(struct compiled_metric *m, const struct sim *sim, double *difference, double *result,
                            double *expected)
{
  bool         points = m->view.field->at != AT_CELL;
  struct tally a = {.m = m, .t = sim->t, .difference = difference, .grid = &sim->grid, .points = points};
  *expected = 0;
  if (m->metric->measure == MEASURE_MISFIT || m->metric->measure == MEASURE_THICKNESS) {
    *result = metric_of_border(m, sim);
    return OK;
  }
  if (m->metric->measure == MEASURE_SCATTER) return metric_of_scatter(m, sim, difference, result);
  fields_refresh(sim, &m->view);
  if (m->wet.field) fields_refresh(sim, &m->wet);
  if (metric_is_crest(m->metric)) return metric_of_crest(m, sim, result, expected);
  if (difference)
    for (long i = 0; i < 2 * sim->grid.size; i++) difference[i] = points ? 0 : NAN;
  TRY((points ? add_points : add_cells)(&a, sim));
  TRY(empty_batch(&a));
  if (a.count == 0)
    return FAIL(ERR_INPUT, "metrics.%s.region: nothing of %s lies in it at t = %g s; widen it", m->metric->name,
                m->metric->field, sim->t);
  *result = measure(&a, sim);
  *expected = a.sum_expected / (double)a.count;
  return OK;
}
