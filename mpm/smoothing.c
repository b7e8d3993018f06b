/* Hybrid strain smoothing: the volumetric part of the velocity gradient is averaged over nodes and back, the rest over
 * the cell. theory 3.6, T(51)-(54) */
#include "constitutive/constitutive.h"
#include "core/parallel.h"
#include "mpm/stages.h"

#include <math.h>
#include <string.h>

static double trace(int dim, const double *L)
{
  double sum = 0;
  for (int d = 0; d < dim; d++) sum += L[d * dim + d];
  return sum;
}

/* cell of a point; on the upper end of the grid the last one */
static long cell_of(const struct grid *g, const double *x)
{
  int cell[3] = {0};
  for (int d = 0; d < g->dim; d++) {
    int c = (int)floor((x[d] - g->min[d]) / g->h);
    cell[d] = c < g->n[d] ? c : g->n[d] - 1;
  }
  return grid_at(g, cell[0], cell[1], cell[2]);
}

static void sum_cells(const struct grid *g, struct mpm *m, const struct kernel_run *run)
{
  int n = g->dim * g->dim;
  for (long p = run->begin; p < run->end; p++) {
    long cell = cell_of(g, m->x_p + p * g->dim);
    m->share_cc[cell] += m->volume_p[p];
    for (int q = 0; q < n; q++) m->gradv_cc[cell * n + q] += m->volume_p[p] * m->smooth_p[p * n + q];
  }
}

static void take_cells(const struct grid *g, struct mpm *m, const struct kernel_run *run)
{
  int n = g->dim * g->dim;
  for (long p = run->begin; p < run->end; p++) {
    long cell = cell_of(g, m->x_p + p * g->dim);
    for (int q = 0; q < n; q++) m->smooth_p[p * n + q] = m->gradv_cc[cell * n + q] / m->share_cc[cell];
  }
}

/* smooth_p of one solid's points: mean over volume in their cell. Blocks of one colour share no cell. */
static void average_cells(struct sim *sim, struct mpm *m, int solid)
{
  const struct grid *g = &sim->grid;
  memset(m->share_cc, 0, (size_t)g->size * sizeof(double));
  memset(m->gradv_cc, 0, (size_t)(g->size * g->dim * g->dim) * sizeof(double));
  FOR_RUNS(m->points, g, run, group) if (group == solid) sum_cells(g, m, &run);
  FOR_RUNS(m->points, g, run, group) if (group == solid) take_cells(g, m, &run);
}

/* rate_p of one solid's points: mean over volume at the nodes, T(52), and back at the points, T(53) */
static void average_rate(struct sim *sim, struct mpm *m, int solid)
{
  const struct grid           *g = &sim->grid;
  const struct side_condition *sides = m->sides;
  struct box                   all = grid_all(g);
  const struct scatter_args    to_nodes = {
         .n = 2, .x = m->x_p, .weight = m->volume_p, .value = {NULL, m->rate_p}, .node = {m->share_nc, m->rate_nc}};
  const struct gather_args to_points = {.n = 1, .x = m->x_p, .node = {m->rate_nc}, .value = {m->rate_p}};
  memset(m->share_nc, 0, (size_t)g->size * sizeof(double));
  memset(m->rate_nc, 0, (size_t)g->size * sizeof(double));
  FOR_RUNS(m->points, g, run, group) if (group == solid) m->kernels->scatter(&m->kernel_grid, &run, &to_nodes);
  boundary_fold(&m->kernel_grid, sides, 1, m->share_nc);
  boundary_fold(&m->kernel_grid, sides, 1, m->rate_nc);
  FOR_BOX(g, all, c) m->rate_nc[c] = m->share_nc[c] > 0 ? m->rate_nc[c] / m->share_nc[c] : 0;
  boundary_ghosts(&m->kernel_grid, sides, 1, sim->t, m->rate_nc);
  FOR_RUNS(m->points, g, run, group) if (group == solid) m->kernels->gather(&m->kernel_grid, &run, &to_points);
}

/* L = that of the cell with the averaged trace; in plane strain nothing strains out of plane */
static void join(const struct sim *sim, struct mpm *m)
{
  int dim = sim->grid.dim;
  PARALLEL_FOR
  for (long p = 0; p < m->points->n; p++) {
    double *L = m->smooth_p + p * dim * dim, change = (m->rate_p[p] - trace(dim, L)) / dim;
    for (int d = 0; d < dim; d++) L[d * dim + d] += change;
  }
}

static void smooth(struct sim *sim, struct mpm *m)
{
  int dim = sim->grid.dim;
  mpm_gather_gradient(sim, m, m->smooth_p);
  PARALLEL_FOR
  for (long p = 0; p < m->points->n; p++) m->rate_p[p] = trace(dim, m->smooth_p + p * dim * dim);
  for (int s = 0; s < sim->scene->n_solids; s++) {
    if (scene_material(sim->scene, s)->model->held) continue;
    average_rate(sim, m, s);
    average_cells(sim, m, s);
  }
  join(sim, m);
}

/* usl: before the points move, where the nodes are theirs */
enum status mpm_smooth_strain(struct sim *sim, double dt)
{
  (void)dt;
  smooth(sim, mpm_of(sim));
  return OK;
}

/* musl: with what was gathered at the new places */
enum status mpm_smooth_strain_again(struct sim *sim, double dt)
{
  struct mpm *m = mpm_of(sim);
  smooth(sim, m);
  mpm_refer_to_start(sim, m, dt, m->smooth_p);
  return OK;
}

enum status mpm_take_smoothed(struct sim *sim, double dt)
{
  (void)dt;
  struct mpm *m = mpm_of(sim);
  long        n = m->points->n * sim->grid.dim * sim->grid.dim;
  double      share = mpm_params(sim->scene)->smoothing;
  PARALLEL_FOR
  for (long q = 0; q < n; q++) m->gradv_p[q] += share * (m->smooth_p[q] - m->gradv_p[q]);
  return OK;
}
