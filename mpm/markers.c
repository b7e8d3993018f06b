/* Markers: points of loaded surfaces and tracers, which ride on the solid's nodal velocity. theory 3.3 */
#include "mpm/stages.h"

#include <math.h>
#include <string.h>

/* force on the solid at marker i: traction, and pressure against the outward normal; N */
static void marker_force(const struct sim *sim, const struct mpm *m, const struct load *load, long i, double t,
                         double force[3])
{
  double x[3] = {0};
  memcpy(x, m->x_m + i * sim->grid.dim, (size_t)sim->grid.dim * sizeof *x);
  double p = function_value(&load->pressure, x, t);
  for (int d = 0; d < sim->grid.dim; d++)
    force[d] = m->marker_area[i] * (function_value(&load->traction[d], x, t) - p * m->marker_normal[i][d]);
}

/* a node with less than this of the heaviest mass around a marker carries no load, as it could not pass it on, and its
 * velocity is not the solid's */
static const double light_node = 1e-3;

/* centre and spread of the weights along an axis; dx [n]: distances of the nodes from that centre */
static double axis_spread(const struct grid *g, const long *node, const double *w, int n, int axis, double *centre,
                          double *dx)
{
  double spread = 0, x[3];
  *centre = 0;
  for (int q = 0; q < n; q++) {
    grid_node(g, node[q], x);
    dx[q] = x[axis];
    *centre += w[q] * x[axis];
  }
  for (int q = 0; q < n; q++) {
    dx[q] -= *centre;
    spread += w[q] * dx[q] * dx[q];
  }
  return spread;
}

/* Nodes of a marker and its weights over those that hold enough of the solid. Their sum stays one and their centre at
 * the marker: beyond a free surface nodes are missing, and without the second a load would act too deep, a velocity be
 * too low. */
static void marker_weights(const struct sim *sim, const struct mpm *m, long i, long *node, double *w)
{
  const double *x = m->x_m + i * sim->grid.dim;
  int           n = m->kernels->n_support;
  double        heaviest = 0, kept = 0, share[MAX_SUPPORT], dx[MAX_SUPPORT], h2 = sim->grid.h * sim->grid.h;
  m->kernels->weights(&m->kernel_grid, x, node, w, NULL);
  for (int q = 0; q < n; q++) heaviest = fmax(heaviest, m->mass_nc[node[q]]);
  for (int q = 0; q < n; q++) {
    if (m->mass_nc[node[q]] <= light_node * heaviest) w[q] = 0;
    kept += w[q];
  }
  for (int q = 0; q < n; q++) share[q] = w[q] = kept > 0 ? w[q] / kept : 0;
  for (int axis = 0; axis < sim->grid.dim; axis++) {
    double centre, spread = axis_spread(&sim->grid, node, share, n, axis, &centre, dx);
    for (int q = 0; q < n && spread > 0.01 * h2; q++) w[q] += share[q] * dx[q] * (x[axis] - centre) / spread;
  }
}

/* velocity of the solid at a marker */
static void marker_velocity(const struct sim *sim, const struct mpm *m, long i, double vel[3])
{
  long   node[MAX_SUPPORT];
  double w[MAX_SUPPORT];
  int    dim = sim->grid.dim;
  marker_weights(sim, m, i, node, w);
  memset(vel, 0, 3 * sizeof *vel);
  for (int q = 0; q < m->kernels->n_support; q++)
    for (int d = 0; d < dim; d++) vel[d] += w[q] * m->vel_new_nc[node[q] * dim + d];
}

enum status mpm_load_surfaces(struct sim *sim, double dt)
{
  struct mpm *m = mpm_of(sim);
  int         dim = sim->grid.dim;
  for (int k = 0; k < sim->scene->n_loads; k++)
    for (long i = k ? m->marker_end[k - 1] : 0; i < m->marker_end[k]; i++) {
      long   node[MAX_SUPPORT];
      double w[MAX_SUPPORT], force[3];
      marker_weights(sim, m, i, node, w);
      marker_force(sim, m, &sim->scene->loads[k], i, sim->t + 0.5 * dt, force);
      for (int q = 0; q < m->kernels->n_support; q++)
        for (int d = 0; d < dim; d++) m->force_nc[node[q] * dim + d] += w[q] * force[d];
    }
  return OK;
}

void mpm_move_markers(struct sim *sim, struct mpm *m, double dt)
{
  const struct scene *scene = sim->scene;
  int                 dim = sim->grid.dim;
  for (int k = 0; k < scene->n_loads + scene->n_tracers; k++)
    for (long i = k ? m->marker_end[k - 1] : 0; i < m->marker_end[k]; i++) {
      double vel[3], force[3] = {0};
      marker_velocity(sim, m, i, vel);
      if (k < scene->n_loads) marker_force(sim, m, &scene->loads[k], i, sim->t + 0.5 * dt, force);
      for (int d = 0; d < dim; d++) {
        m->x_m[i * dim + d] += dt * vel[d];
        m->now.work_loads += dt * vel[d] * force[d];
      }
    }
}
