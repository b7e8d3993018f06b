/* How much of a line along an axis is liquid: depths, heights, fronts. Of cells: their saturation, between the lines of
 * centres linear, beyond the last constant. Of water points: what they fill, within a cell's width of the line by
 * nearness; beyond a side of the grid its mirror image. */
#include "run/gauge_level.h"

#include "core/parallel.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* m: saturation times h along the line that starts in cell `first` */
static double length_in_cells(const struct gauge_reader *r, const struct sim *sim, long first)
{
  const struct grid *g = &sim->grid;
  double             sum = 0;
  for (int i = 0; i < g->n[r->axis]; i++) sum += r->view.data[first + i * g->stride[r->axis]];
  return sum * g->h;
}

static double read_cells(const struct gauge_reader *r, const struct sim *sim)
{
  double length = 0;
  for (int i = 0; i < 8; i++)
    if (r->weight[i] > 0) length += r->weight[i] * length_in_cells(r, sim, r->cell[i]);
  return length;
}

/* 1 on the line, 0 a cell away; what lies behind a side is mirrored. s: distance from the line, low, high: of the sides
 * from it, all in cells along one axis */
static double nearness(double s, double low, double high)
{
  double w = fmax(0, 1 - fabs(s)), below = 2 * low - s, above = 2 * high - s;
  return w + fmax(0, 1 - fabs(below)) + fmax(0, 1 - fabs(above));
}

static double read_points(const struct gauge_reader *r, const struct sim *sim)
{
  const struct grid *g = &sim->grid;
  struct field_view  x;
  double             volume = 0;
  if (!fields_positions(sim, AT_WATER, &x)) return NAN;
  for (long p = 0; p < r->view.n; p++) {
    double w = 1;
    for (int d = 0; d < g->dim && w > 0; d++) {
      double low = (g->min[d] - r->x[d]) / g->h;
      if (d != r->axis) w *= nearness((x.data[p * g->dim + d] - r->x[d]) / g->h, low, low + g->n[d]);
    }
    volume += w * r->view.data[p];
  }
  return volume * g->h / grid_cell_volume(g);
}

/* a line between the centres of cells: none closer to a side than half a cell */
static void keep_off_sides(const struct grid *g, struct gauge_reader *r)
{
  for (int d = 0; d < g->dim; d++) {
    double low = g->min[d] + 0.5 * g->h, high = g->min[d] + (g->n[d] - 0.5) * g->h;
    r->x[d] = d == r->axis ? low : fmin(high, fmax(low, r->x[d]));
  }
}

enum status gauge_level_create(const struct sim *sim, const struct gauge *gauge, int sample, struct gauge_reader *r)
{
  int component;
  r->axis = gauge->of[0] - 'x';
  if (strlen(gauge->of) != 1 || r->axis < 0 || r->axis >= sim->grid.dim)
    return FAIL(ERR_INPUT, "gauges.%s.of: \"%s\" is no axis; say x, y or, in 3D, z", gauge->name, gauge->of);
  gauge_reader_place(&sim->grid, gauge, sample, r->x);
  keep_off_sides(&sim->grid, r);
  snprintf(r->unit, sizeof r->unit, "m");
  if (fields_component(sim, "cells.saturation", &r->view, &component) == OK) {
    r->read = read_cells;
    gauge_reader_weigh(&sim->grid, r);
    return OK;
  }
  r->read = read_points;
  if (fields_component(sim, "water.volume", &r->view, &component) == OK) return OK;
  return FAIL(ERR_INPUT,
              "gauges.%s: no liquid moves in this scene; take the path twopoint, or ice with "
              "numerics.ice.advection",
              gauge->name);
}
