/* Metrics of a cell field that is 1 in a body and 0 outside: where the body is, how sharp its border. */
#include "core/parallel.h"
#include "ice/shares.h"
#include "run/metric_parts.h"

#include <math.h>

static double value_of(const struct compiled_metric *m, long c)
{
  return m->view.data[c * m->view.components + m->component];
}

static double misfit(const struct compiled_metric *m, const struct grid *g)
{
  struct box    cells = grid_cells(g);
  struct places region = places_of(&m->metric->region);
  double        away = 0, body = 0;
  FOR_BOX_SERIAL(g, cells, c)
  {
    double x[3];
    grid_centre(g, c, x);
    double share = share_inside(g, &region, x, -1);
    away += fabs(value_of(m, c) - share);
    body += share;
  }
  return away / body;
}

/* cells in between at least 1 %, over the sum of |gradient| h, which is the area of the border in faces of a cell */
static double thickness(const struct compiled_metric *m, const struct grid *g)
{
  static const double rim = 0.01;
  struct box          inner = grid_cells(g);
  double              border = 0;
  long                mixed = 0;
  for (int d = 0; d < g->dim; d++) {
    inner.lo[d]++;
    inner.hi[d]--;
  }
  FOR_BOX_SERIAL(g, inner, c)
  {
    double x[3], slope = 0, here = value_of(m, c);
    grid_centre(g, c, x);
    if (!shape_contains(&m->metric->region, x)) continue;
    mixed += here > rim && here < 1 - rim;
    for (int d = 0; d < g->dim; d++)
      slope += pow(0.5 * (value_of(m, c + g->stride[d]) - value_of(m, c - g->stride[d])), 2);
    border += sqrt(slope);
  }
  return (double)mixed / border;
}

double metric_of_border(struct compiled_metric *m, const struct sim *sim)
{
  fields_refresh(sim, &m->view);
  return m->metric->measure == MEASURE_MISFIT ? misfit(m, &sim->grid) : thickness(m, &sim->grid);
}
