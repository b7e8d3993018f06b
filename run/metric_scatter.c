/* Scatter of a field of points: how far its values lie from a plane through the cells around. */
#include "core/parallel.h"
#include "core/tensor.h"
#include "run/metric_parts.h"

#include <math.h>
#include <string.h>

enum { WINDOW = 4 }; /* cells along each axis */

/* sums over the points of every cell, each [size] */
struct cell_sums {
  double *count, *value, *place[3];
};

/* the plane value + gradient (x - middle) that fits the cells of a window, each counting as many times as it has points
 */
struct plane {
  double value, middle[3], gradient[3];
};

/* lowest cell of the window whose middle, a node, is nearest to x; false: the window leaves the grid */
static bool window_at(const struct grid *g, const double x[3], struct box *window)
{
  *window = grid_cells(g);
  for (int d = 0; d < g->dim; d++) {
    int low = (int)floor((x[d] - g->min[d]) / g->h + 0.5) - WINDOW / 2;
    if (g->n[d] == 1) continue; /* an axis that is one cell wide holds nothing to compare with */
    if (low < 0 || low + WINDOW > g->n[d]) return false;
    window->lo[d] = low;
    window->hi[d] = low + WINDOW;
  }
  return true;
}

/* means over the points of the window; false: some of its cells are empty */
static bool window_means(const struct grid *g, const struct box *window, const struct cell_sums *s, struct plane *plane)
{
  double n = 0;
  *plane = (struct plane){0};
  FOR_BOX_SERIAL(g, *window, c)
  {
    if (s->count[c] == 0) return false;
    n += s->count[c];
    plane->value += s->value[c];
    for (int d = 0; d < g->dim; d++) plane->middle[d] += s->place[d][c];
  }
  plane->value /= n;
  for (int d = 0; d < g->dim; d++) plane->middle[d] /= n;
  return true;
}

/* gradient by least squares of the cells' means */
static bool fit_plane(const struct grid *g, const struct box *window, const struct cell_sums *s, struct plane *plane)
{
  double spread[9] = {0}, covariance[3] = {0}, inverse[9];
  if (!window_means(g, window, s, plane)) return false;
  FOR_BOX_SERIAL(g, *window, c)
  {
    double away[3] = {0}, value = s->value[c] / s->count[c] - plane->value;
    for (int d = 0; d < g->dim; d++) away[d] = s->place[d][c] / s->count[c] - plane->middle[d];
    for (int d = 0; d < g->dim; d++) {
      covariance[d] += s->count[c] * away[d] * value;
      for (int e = 0; e < g->dim; e++) spread[3 * d + e] += s->count[c] * away[d] * away[e];
    }
  }
  for (int d = 0; d < 3; d++)
    if (d >= g->dim || window->hi[d] - window->lo[d] == 1) spread[4 * d] = g->h * g->h; /* no slope along this axis */
  tensor_inverse(spread, inverse);
  for (int d = 0; d < g->dim; d++)
    for (int e = 0; e < g->dim; e++) plane->gradient[d] += inverse[3 * d + e] * covariance[e];
  return true;
}

static double value_of(const struct compiled_metric *m, long i)
{
  return m->view.data[i * m->view.components + m->component];
}

static void place_of(const struct field_view *places, long i, double x[3])
{
  memset(x, 0, 3 * sizeof *x);
  memcpy(x, &places->data[i * places->components], (size_t)places->components * sizeof *x);
}

static void sum_cells(const struct compiled_metric *m, const struct grid *g, const struct field_view *places,
                      struct cell_sums *s)
{
  for (long i = 0; i < m->view.n; i++) {
    double x[3];
    int    c[3] = {0, 0, 0};
    bool   inside = true;
    place_of(places, i, x);
    for (int d = 0; d < g->dim; d++) {
      c[d] = (int)floor((x[d] - g->min[d]) / g->h);
      inside = inside && c[d] >= 0 && c[d] < g->n[d];
    }
    if (!inside) continue;
    long cell = grid_at(g, c[0], c[1], c[2]);
    s->count[cell]++;
    s->value[cell] += value_of(m, i);
    for (int d = 0; d < 3; d++) s->place[d][cell] += x[d];
  }
}

enum status metric_of_scatter(struct compiled_metric *m, const struct sim *sim, double *scratch, double *result)
{
  const struct grid *g = &sim->grid;
  const long         size = g->size;
  struct cell_sums   s = {scratch, scratch + size, {scratch + 2 * size, scratch + 3 * size, scratch + 4 * size}};
  struct field_view  places;
  double             squares = 0;
  long               n = 0;
  fields_refresh(sim, &m->view);
  if (!fields_positions(sim, m->view.field->at, &places))
    return FAIL(ERR_INPUT, "metrics.%s.field: %s belongs to points without a place", m->metric->name, m->metric->field);
  memset(scratch, 0, (size_t)(5 * size) * sizeof *scratch);
  sum_cells(m, g, &places, &s);
  for (long i = 0; i < m->view.n; i++) {
    double       x[3], away;
    struct box   window;
    struct plane plane;
    place_of(&places, i, x);
    if (!shape_contains(&m->metric->region, x) || !window_at(g, x, &window)) continue;
    if (!fit_plane(g, &window, &s, &plane)) continue;
    away = value_of(m, i) - plane.value;
    for (int d = 0; d < g->dim; d++) away -= plane.gradient[d] * (x[d] - plane.middle[d]);
    squares += away * away;
    n++;
  }
  if (n == 0)
    return FAIL(ERR_INPUT,
                "metrics.%s.region: no point of %s has %d filled cells on every axis around it at t = %g s; widen it",
                m->metric->name, m->metric->field, WINDOW, sim->t);
  *result = sqrt(squares / (double)n);
  return OK;
}
