/* The crest of a field of cells along a line: the profile is the mean over the region's cells at each index of its
 * longest axis, its highest place that of the parabola through the highest value and its neighbours. */
#include "core/parallel.h"
#include "run/metric_parts.h"

#include <math.h>

enum { AXES = 3 };

static bool counts(const struct compiled_metric *m, const struct grid *g, long c)
{
  double x[AXES] = {0};
  grid_centre(g, c, x);
  return (!m->wet.data || m->wet.data[c] != 0) && shape_contains(&m->metric->region, x);
}

/* first and last index of the region's cells along every axis; the longest */
static int longest_axis(const struct compiled_metric *m, const struct grid *g, int *first, int *last)
{
  struct box cells = grid_cells(g);
  int        lo[AXES] = {1 << 30, 1 << 30, 1 << 30}, hi[AXES] = {-1, -1, -1}, axis = 0;
  FOR_BOX_SERIAL(g, cells, c)
  {
    int place[AXES];
    if (!counts(m, g, c)) continue;
    grid_place(g, c, place);
    for (int d = 0; d < g->dim; d++) {
      lo[d] = place[d] < lo[d] ? place[d] : lo[d];
      hi[d] = place[d] > hi[d] ? place[d] : hi[d];
    }
  }
  for (int d = 1; d < g->dim; d++) axis = hi[d] - lo[d] > hi[axis] - lo[axis] ? d : axis;
  *first = lo[axis];
  *last = hi[axis];
  return axis;
}

/* mean over the region's cells at one index; NaN: there are none */
static double profile(const struct compiled_metric *m, const struct grid *g, int axis, int index)
{
  struct box plane = grid_cells(g);
  double     sum = 0;
  long       n = 0;
  plane.lo[axis] = index;
  plane.hi[axis] = index + 1;
  FOR_BOX_SERIAL(g, plane, c)
  {
    if (!counts(m, g, c)) continue;
    sum += m->view.data[c * m->view.components + m->component];
    n++;
  }
  return n > 0 ? sum / (double)n : NAN;
}

enum status metric_of_crest(struct compiled_metric *m, const struct sim *sim, double *result, double *expected)
{
  const struct grid *g = &sim->grid;
  int                first, last, axis = longest_axis(m, g, &first, &last), top = first;
  double             x[1][AXES] = {{0}}, highest = -INFINITY;
  if (last < first)
    return FAIL(ERR_INPUT, "metrics.%s.region: no cell of %s lies in it at t = %g s; widen it", m->metric->name,
                m->metric->field, sim->t);
  for (int i = first; i <= last; i++) {
    double here = profile(m, g, axis, i);
    if (!(here > highest)) continue;
    highest = here;
    top = i;
  }
  double below = top > first ? profile(m, g, axis, top - 1) : NAN,
         above = top < last ? profile(m, g, axis, top + 1) : NAN;
  double shift = 0.5 * (below - above) / (below - 2 * highest + above);
  if (!isfinite(shift)) shift = 0; /* at an end, or flat */
  if (shift != 0) highest -= 0.25 * (below - above) * shift;
  x[0][axis] = g->min[axis] + (top + 0.5 + shift) * g->h;
  TRY(expectancy_values(&m->expected, 1, (const double(*)[3])x, sim->t, expected));
  *result = (m->metric->measure == MEASURE_CREST ? highest : x[0][axis]) - *expected;
  return OK;
}
