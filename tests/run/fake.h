/* A small sim with one invented module, for tests of what walks the field tables. Every value is a formula of place. */
#ifndef TESTS_RUN_FAKE_H
#define TESTS_RUN_FAKE_H

#include "core/memory.h"
#include "core/parallel.h"
#include "core/sim.h"

#include <check.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define FAKE_FIELDS                                                                                                    \
  FIELD(x_p, AT_SOLID, VECTOR, STATE, NULL, "m", "place")                                                              \
  FIELD(vel_p, AT_SOLID, VECTOR, STATE, "vel", "m/s", "velocity")                                                      \
  FIELD(stress_p, AT_SOLID, SYMMETRIC, STATE, "stress", "Pa", "stress")                                                \
  FIELD(grad_p, AT_SOLID, MATRIX, SCRATCH, "gradient", "1/s", "velocity gradient")                                     \
  FIELD(volume_p, AT_SOLID, 1, STATE, "volume", "m3", "volume")                                                        \
  FIELD(absent_p, AT_SOLID, 1, STATE, "absent", "-", "not planned, so never allocated")                                \
  FIELD(x_w, AT_WATER, VECTOR, STATE, NULL, "m", "place")                                                              \
  FIELD(P_w, AT_WATER, 1, STATE, "P", "Pa", "pressure of points")                                                      \
  FIELD(volume_w, AT_WATER, 1, STATE, "volume", "m3", "volume of points")                                              \
  FIELD(alpha_cc, AT_CELL, 1, STATE, "saturation", "-", "share of a cell")                                             \
  FIELD(P_cc, AT_CELL, 1, STATE, "P", "Pa", "pressure of cells")                                                       \
  FIELD(vel_cc, AT_CELL, VECTOR, STATE, "vel_fluid", "m/s", "velocity of cells")                                       \
  FIELD(flux_fc, AT_FACE, 1, STATE, NULL, "m/s", "flux")                                                               \
  FIELD(mass_nc, AT_NODE, 1, SCRATCH, NULL, "kg", "mass")                                                              \
  FIELD(x_m, AT_MARKER, VECTOR, STATE, NULL, "m", "place of markers")                                                  \
  FIELD(x0_m, AT_MARKER, VECTOR, STATE, NULL, "m", "their places at the start")

struct fake {
#define FIELD FIELD_MEMBER
  FAKE_FIELDS
#undef FIELD
};

static const struct field fake_fields[] = {
#define FIELD(...) FIELD_ROW(struct fake, __VA_ARGS__)
    FAKE_FIELDS
#undef FIELD
};

enum { FAKE_FIELD_COUNT = sizeof fake_fields / sizeof *fake_fields, FAKE_MARKERS = 3, PER_AXIS = 2 };

static const struct module fake_module = {
    .name = "fake", .fields = fake_fields, .n_fields = FAKE_FIELD_COUNT, .state_size = sizeof(struct fake)};
static const struct module *const fake_modules[] = {&fake_module};

struct fake_run {
  struct scene scene;
  struct sim   sim;
  struct fake  state;
  void        *states[1];
  char         folder[64];
};

static void fake_ok(enum status s) { ck_assert_msg(s == OK, "%s", status_message()); }

static double linear(const double x[3]) { return 100 + 10 * x[0] - 30 * x[1] + 7 * x[2]; }

static void fake_allocate(struct fake_run *r)
{
  const struct sim *sim = &r->sim;
  const long        count[] = {[AT_NODE] = sim->grid.size,
                               [AT_CELL] = sim->grid.size,
                               [AT_FACE] = sim->grid.dim * sim->grid.size,
                               [AT_SOLID] = sim->points[SET_SOLID]->n,
                               [AT_WATER] = sim->points[SET_WATER]->n,
                               [AT_MARKER] = FAKE_MARKERS};
  for (int i = 0; i < FAKE_FIELD_COUNT; i++) {
    const struct field *f = &fake_fields[i];
    double             *data;
    if (strcmp(f->name, "absent_p") == 0 || strcmp(f->name, "volume_w") == 0 || strcmp(f->name, "alpha_cc") == 0)
      continue; /* the last two: only where fake_liquid wants them */
    fake_ok(NEW(&data, count[f->at] * field_components(f, sim->scene)));
    memcpy((char *)&r->state + f->offset, &data, sizeof data);
  }
}

/* n points on a lattice, PER_AXIS^dim per cell, in the grid's lower `rows` rows along y. */
static void fake_place(const struct grid *g, int rows, double *x)
{
  const int n[3] = {PER_AXIS * g->n[0], PER_AXIS * rows, g->dim == 3 ? PER_AXIS * g->n[2] : 1};
  for (long p = 0; p < (long)n[0] * n[1] * n[2]; p++) {
    const long at[3] = {p % n[0], p / n[0] % n[1], p / ((long)n[0] * n[1])};
    for (int d = 0; d < g->dim; d++) x[p * g->dim + d] = g->min[d] + g->h * ((double)at[d] + 0.5) / PER_AXIS;
  }
}

static void fake_sort(const struct grid *g, struct points *p, double *x)
{
  fake_ok(points_sort(g, p, x));
  points_permute(p, g->dim, x);
  points_sorted(p);
}

static void fake_fill_points(struct fake_run *r)
{
  const int dim = r->sim.grid.dim;
  for (long p = 0; p < r->sim.points[SET_SOLID]->n; p++) {
    double x[3] = {0, 0, 0};
    memcpy(x, &r->state.x_p[p * dim], (size_t)dim * sizeof *x);
    for (int d = 0; d < dim; d++) r->state.vel_p[p * dim + d] = (d + 1) * linear(x);
    for (int c = 0; c < 6; c++) r->state.stress_p[6 * p + c] = c + linear(x);
    for (int c = 0; c < dim * dim; c++) r->state.grad_p[dim * dim * p + c] = c + 1;
    r->state.volume_p[p] = grid_cell_volume(&r->sim.grid) / (dim == 3 ? 8 : 4);
  }
  for (long p = 0; p < r->sim.points[SET_WATER]->n; p++) {
    double x[3] = {0, 0, 0};
    memcpy(x, &r->state.x_w[p * dim], (size_t)dim * sizeof *x);
    r->state.P_w[p] = linear(x);
  }
}

static void fake_fill_grid(struct fake_run *r)
{
  const struct grid *g = &r->sim.grid;
  const struct box   all = grid_all(g);
  FOR_BOX_SERIAL(g, all, c)
  {
    double x[3];
    grid_centre(g, c, x);
    r->state.P_cc[c] = linear(x);
    for (int d = 0; d < g->dim; d++) r->state.vel_cc[c * g->dim + d] = x[d];
    for (int d = 0; d < g->dim; d++) r->state.flux_fc[d * g->size + c] = d + x[d];
  }
}

/* A 20 x 5 (x 4) grid of h = 0.1 from (-0.2, 0.1, 0); solid points in the lower three rows of cells, water everywhere.
 */
static void fake_create(int dim, struct fake_run *r)
{
  const double min[3] = {-0.2, 0.1, 0};
  const int    n[3] = {20, 5, 4};
  const bool   periodic[3] = {false, false, false};
  memset(r, 0, sizeof *r);
  snprintf(r->folder, sizeof r->folder, "/tmp/mpmice-check-XXXXXX");
  ck_assert_ptr_nonnull(mkdtemp(r->folder));
  snprintf(r->scene.name, sizeof r->scene.name, "fake");
  snprintf(r->scene.title, sizeof r->scene.title, "An invented state");
  r->scene.dim = dim;
  r->scene.time_end = 1;
  r->scene.output = (struct output){.interval = 0.25, .gauge_interval = 0.1};
  r->states[0] = &r->state;
  r->sim = (struct sim){.scene = &r->scene,
                        .t = 0.25,
                        .dt = 1e-3,
                        .step = 250,
                        .n_modules = 1,
                        .n_markers = FAKE_MARKERS,
                        .modules = fake_modules,
                        .states = r->states};
  grid_create(dim, min, n, 0.1, periodic, &r->sim.grid);
  const long per_cell = dim == 3 ? 8 : 4, layers = r->sim.grid.n[2];
  fake_ok(points_create(&r->sim.grid, 20 * 3 * layers * per_cell, 2, 9, &r->sim.points[SET_SOLID]));
  fake_ok(points_create(&r->sim.grid, 20 * 5 * layers * per_cell, 1, 9, &r->sim.points[SET_WATER]));
  fake_allocate(r);
  for (long p = 0; p < r->sim.points[SET_SOLID]->n; p++) r->sim.points[SET_SOLID]->group[p] = p % 2;
  fake_place(&r->sim.grid, 3, r->state.x_p);
  fake_place(&r->sim.grid, 5, r->state.x_w);
  fake_sort(&r->sim.grid, r->sim.points[SET_SOLID], r->state.x_p);
  fake_sort(&r->sim.grid, r->sim.points[SET_WATER], r->state.x_w);
  fake_fill_points(r);
  fake_fill_grid(r);
}

/* saturation of cells, 0, and volumes of water points, a cell's among its points */
static inline void fake_liquid(struct fake_run *r)
{
  fake_ok(NEW(&r->state.alpha_cc, r->sim.grid.size));
  fake_ok(NEW(&r->state.volume_w, r->sim.points[SET_WATER]->n));
  for (long p = 0; p < r->sim.points[SET_WATER]->n; p++)
    r->state.volume_w[p] = grid_cell_volume(&r->sim.grid) / (r->sim.grid.dim == 3 ? 8 : 4);
}

static void fake_destroy(struct fake_run *r)
{
  char command[128];
  for (int i = 0; i < FAKE_FIELD_COUNT; i++) memory_free((char *)&r->state + fake_fields[i].offset);
  for (int s = 0; s < N_SETS; s++) points_destroy(&r->sim.points[s]);
  snprintf(command, sizeof command, "rm -r '%s'", r->folder);
  ck_assert_int_eq(system(command), 0);
}

#endif
