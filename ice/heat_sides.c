/* What the sides of the grid do to the heat of fluid and grains in cells: half a cell away from the centre there is the
 * side's temperature, or the side's flux goes through the phase's share of the area. theory 4.12 */
#include "core/parallel.h"
#include "ice/heat.h"

#include <math.h>
#include <string.h>

/* the cells along a side */
static struct box cells_at(const struct grid *g, int side)
{
  struct box b = grid_cells(g);
  int        d = side / 2;
  b.lo[d] = side % 2 ? g->n[d] - 1 : 0;
  b.hi[d] = b.lo[d] + 1;
  return b;
}

static bool acts(const struct sim *sim, int side)
{
  return !sim->grid.periodic[side / 2] && sim->scene->heat_side[side].kind != HEAT_INSULATED;
}

/* K or W/m2 at the face between a cell and the side */
static double given(const struct sim *sim, int side, long cell, double t)
{
  double x[3];
  grid_face(&sim->grid, side % 2 ? cell + sim->grid.stride[side / 2] : cell, side / 2, x);
  return function_value(&sim->scene->heat_side[side].value, x, t);
}

/* W/K from a cell's centre to the side */
static double conductance(const struct sim *sim, const struct heat_phase *p, long cell)
{
  return 2 * p->conductivity[cell] * ice_face_area(&sim->grid) / sim->grid.h;
}

void heat_sides_set(const struct sim *sim, struct heat_phase *p, double t)
{
  const struct grid *g = &sim->grid;
  memset(p->outside, 0, (size_t)g->size * sizeof(double));
  memset(p->source, 0, (size_t)g->size * sizeof(double));
  for (int side = 0; side < 2 * g->dim; side++) {
    struct box cells = cells_at(g, side);
    bool       fixed = sim->scene->heat_side[side].kind == HEAT_TEMPERATURE;
    if (!acts(sim, side)) continue;
    FOR_BOX_SERIAL(g, cells, c)
    {
      double value = given(sim, side, c, t), to_side = fixed ? conductance(sim, p, c) : 0;
      p->outside[c] += to_side;
      p->source[c] += fixed ? to_side * value : p->share[c] * ice_face_area(g) * value;
    }
  }
}

double heat_sides_power(const struct sim *sim, const struct heat_phase *p, int side, double t)
{
  const struct grid *g = &sim->grid;
  struct box         cells = cells_at(g, side);
  bool               fixed = sim->scene->heat_side[side].kind == HEAT_TEMPERATURE;
  double             sum = 0;
  if (!acts(sim, side)) return 0;
  FOR_BOX_SERIAL(g, cells, c)
  {
    double value = given(sim, side, c, t);
    sum += fixed ? conductance(sim, p, c) * (value - p->T[c] - p->change[c]) : p->share[c] * ice_face_area(g) * value;
  }
  return sum;
}

void heat_sides_span(const struct sim *sim, double t, double span[2])
{
  const struct grid *g = &sim->grid;
  for (int side = 0; side < 2 * g->dim; side++) {
    struct box cells = cells_at(g, side);
    if (!acts(sim, side) || sim->scene->heat_side[side].kind != HEAT_TEMPERATURE) continue;
    FOR_BOX_SERIAL(g, cells, c)
    {
      double T = given(sim, side, c, t);
      span[0] = fmin(span[0], T);
      span[1] = fmax(span[1], T);
    }
  }
}
