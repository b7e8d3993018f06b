/* Bodies of liquid in prescribed flows that bring them back to where they were: shared by tests and the benchmark. */
#ifndef TESTS_ICE_ADVECT_H
#define TESTS_ICE_ADVECT_H

#include "core/memory.h"
#include "core/parallel.h"
#include "ice/plic.h"

#include <math.h>

struct flow {
  const char *name;
  int         dim;
  double      end, fastest; /* s; m/s: largest component */
  bool        reverses;     /* as cos(pi t/end) */
  bool (*inside)(const double x[3]);
  double (*flux)(int axis, const double x[3], double h); /* m/s, mean over the face with centre x */
};

static inline bool flow_disk(const double x[3]) { return hypot(x[0] - 0.5, x[1] - 0.75) < 0.15; }
static inline bool flow_slotted_disk(const double x[3])
{
  return flow_disk(x) && !(fabs(x[0] - 0.5) < 0.025 && x[1] < 0.85);
}
static inline bool flow_ball(const double x[3])
{
  double a = x[0] - 0.35, b = x[1] - 0.35, c = x[2] - 0.35;
  return a * a + b * b + c * c < 0.15 * 0.15;
}

/* a solid turn per second, stream function pi r^2; no flux through the sides of the unit square */
static inline double flow_turn(int axis, const double x[3], double h)
{
  (void)h;
  return (axis == 0 ? -1 : 1) * 2 * M_PI * (x[1 - axis] - 0.5);
}

/* Rider and Kothe 1998: stream function -(sin pi x sin pi y)^2/pi */
static inline double flow_vortex_stream(double x, double y)
{
  double s = sin(M_PI * x) * sin(M_PI * y);
  return -s * s / M_PI;
}
static inline double flow_vortex(int axis, const double x[3], double h)
{
  if (axis == 0) return -(flow_vortex_stream(x[0], x[1] + 0.5 * h) - flow_vortex_stream(x[0], x[1] - 0.5 * h)) / h;
  return (flow_vortex_stream(x[0] + 0.5 * h, x[1]) - flow_vortex_stream(x[0] - 0.5 * h, x[1])) / h;
}

/* mean of sin 2 pi x over a cell's width */
static inline double flow_wave(double x, double h)
{
  return (cos(2 * M_PI * (x - 0.5 * h)) - cos(2 * M_PI * (x + 0.5 * h))) / (2 * M_PI * h);
}
/* LeVeque 1996, three dimensions */
static inline double flow_leveque(int axis, const double x[3], double h)
{
  double s = sin(M_PI * x[axis]);
  return (axis == 0 ? 2 : -1) * s * s * flow_wave(x[(axis + 1) % 3], h) * flow_wave(x[(axis + 2) % 3], h);
}

static const struct flow flow_zalesak = {"slotted disk, one turn", 2, 1, M_PI, false, flow_slotted_disk, flow_turn};
static const struct flow flow_reversed = {"disk in a vortex", 2, 2, 1, true, flow_disk, flow_vortex};
static const struct flow flow_ball_3d = {"ball in three vortices", 3, 1.5, 2, true, flow_ball, flow_leveque};

/* water: what `passed` has left in the cells, in flux form, over a cell's volume. fill follows from it each step. */
struct tank {
  struct grid grid;
  double     *pore, *start, *water, *fill, *passed, *base[3], *flux[3];
  struct plic plic;
  double      least, most; /* fill of any cell after any step */
};

static inline void tank_close(struct tank *t)
{
  plic_destroy(&t->plic);
  memory_free(&t->pore);
  memory_free(&t->start);
  memory_free(&t->water);
  memory_free(&t->fill);
  memory_free(&t->passed);
  for (int d = 0; d < 3; d++) {
    memory_free(&t->base[d]);
    memory_free(&t->flux[d]);
  }
}

static inline enum status tank_open(int dim, const int n[3], double h, const bool periodic[3], struct tank *t)
{
  *t = (struct tank){0};
  grid_create(dim, (const double[]){0, 0, 0}, n, h, periodic, &t->grid);
  TRY(NEW(&t->pore, t->grid.size));
  TRY(NEW(&t->start, t->grid.size));
  TRY(NEW(&t->water, t->grid.size));
  TRY(NEW(&t->fill, t->grid.size));
  TRY(NEW(&t->passed, t->grid.size));
  for (int d = 0; d < dim; d++) {
    TRY(NEW(&t->base[d], t->grid.size));
    TRY(NEW(&t->flux[d], t->grid.size));
  }
  struct box cells = grid_cells(&t->grid);
  FOR_BOX_SERIAL(&t->grid, cells, c) t->pore[c] = 1;
  grid_fill_periodic(&t->grid, 1, t->pore);
  return plic_create(&t->grid, t->pore, &t->plic);
}

/* share of a cell inside a shape: samples where a ball of a cell's diagonal is not all in or all out at its corners */
static inline double tank_share(const struct grid *g, bool (*inside)(const double *), long cell)
{
  enum { RIM = 3 };
  int    n = g->dim == 3 ? 12 : 40, layers = g->dim == 3 ? RIM : 1, total = 0, in = 0;
  double centre[3], x[3] = {0, 0, 0};
  grid_centre(g, cell, centre);
  for (int fine = 0; fine < 2; fine++) {
    int    points = fine ? n : RIM, deep = g->dim == 3 ? points : 1;
    double width = fine ? g->h : 2 * g->h;
    total = in = 0;
    for (int k = 0; k < deep; k++)
      for (int j = 0; j < points; j++)
        for (int i = 0; i < points; i++, total++) {
          const int at[3] = {i, j, k};
          for (int d = 0; d < g->dim; d++) x[d] = centre[d] + width * ((at[d] + 0.5) / points - 0.5);
          in += inside(x);
        }
    if (!fine && (in == 0 || in == RIM * RIM * layers)) break;
  }
  return (double)in / total;
}

/* the body, and the flow at t = 0; no flux through the sides */
static inline void tank_fill(struct tank *t, const struct flow *flow)
{
  const struct grid *g = &t->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX_SERIAL(g, cells, c) t->start[c] = t->water[c] = t->pore[c] * tank_share(g, flow->inside, c);
  for (int axis = 0; axis < g->dim; axis++) {
    struct box inner = cells;
    inner.lo[axis]++;
    FOR_BOX_SERIAL(g, inner, f)
    {
      double x[3];
      grid_face(g, f, axis, x);
      t->base[axis][f] = flow->flux(axis, x, g->h);
    }
  }
}

/* a step with the fluxes */
static inline void tank_step(struct tank *t, long step, double dt)
{
  const struct grid *g = &t->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX(g, cells, c) t->fill[c] = t->pore[c] > 0 ? t->water[c] / t->pore[c] : 0;
  plic_begin(&t->plic, t->fill);
  for (int k = 0; k < g->dim; k++) {
    int  axis = plic_axis(g, step, k);
    long st = g->stride[axis];
    plic_sweep(&t->plic, axis, dt, t->flux[axis], t->fill, t->passed);
    FOR_BOX(g, cells, c) t->water[c] -= t->passed[c + st] - t->passed[c];
  }
}

static inline void tank_bounds(struct tank *t)
{
  struct box cells = grid_cells(&t->grid);
  FOR_BOX_SERIAL(&t->grid, cells, c)
  {
    if (!(t->pore[c] > 0)) continue;
    t->least = fmin(t->least, t->water[c] / t->pore[c]);
    t->most = fmax(t->most, t->water[c] / t->pore[c]);
  }
}

/* from 0 to the end in equal steps of at most this Courant number; returns how many */
static inline int tank_run(struct tank *t, const struct flow *flow, double end, double courant)
{
  int    steps = (int)ceil(end * flow->fastest / (courant * t->grid.h));
  double dt = end / steps;
  for (int s = 0; s < steps; s++) {
    double strength = flow->reverses ? cos(M_PI * (s + 0.5) / steps) : 1;
    for (int d = 0; d < t->grid.dim; d++)
      for (long f = 0; f < t->grid.size; f++) t->flux[d][f] = strength * t->base[d][f];
    tank_step(t, s, dt);
    tank_bounds(t);
  }
  return steps;
}

struct tank_result {
  double error;     /* sum |water - start| / sum start */
  double drift;     /* sum water / sum start - 1 */
  double thickness; /* cells with a surface per cell length of it */
};

/* Thickness: cells of fill 0.01 to 0.99 over the surface's area in faces, the sum of |gradient of fill|. */
static inline struct tank_result tank_result(const struct tank *t)
{
  const struct grid *g = &t->grid;
  struct box         cells = grid_cells(g);
  long double        start = 0, water = 0;
  double             error = 0, surface = 0;
  long               mixed = 0;
  FOR_BOX_SERIAL(g, cells, c)
  {
    double slope = 0, fill = t->water[c] / t->pore[c];
    start += t->start[c];
    water += t->water[c];
    error += fabs(t->water[c] - t->start[c]);
    mixed += fill > 0.01 && fill < 0.99;
    for (int d = 0; d < g->dim; d++) {
      double change = 0.5 * (t->water[c + g->stride[d]] - t->water[c - g->stride[d]]);
      slope += change * change;
    }
    surface += sqrt(slope);
  }
  return (struct tank_result){error / (double)start, (double)(water / start - 1), (double)mixed / surface};
}

#endif
