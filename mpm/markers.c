/* Markers: points of loaded surfaces and tracers, which ride on the solid's nodal velocity. theory 3.3 */
#include "mpm/sides.h"
#include "mpm/stages.h"

#include "core/tensor.h"

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

/* M^-1 offset, M [9] the second moments of weights about their centre. An axis along which they hardly spread says
 * nothing; axes that nearly depend on each other are taken one by one. */
static void solve_moments(const double M[9], const double offset[3], double h, double a[3])
{
  double own[9] = {0}, inverse[9];
  bool   wide[3];
  for (int i = 0; i < 3; i++) wide[i] = M[4 * i] > 0.01 * h * h;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) own[3 * i + j] = wide[i] && wide[j] ? M[3 * i + j] : i == j;
  if (tensor_determinant(own) < 0.01 * own[0] * own[4] * own[8])
    for (int q = 0; q < 9; q++) own[q] *= q % 4 == 0;
  tensor_inverse(own, inverse);
  for (int i = 0; i < 3; i++) {
    a[i] = 0;
    for (int j = 0; j < 3 && wide[i]; j++) a[i] += wide[j] ? inverse[3 * i + j] * offset[j] : 0;
  }
}

/* tilts weights w [n] with sum one so that their centre lies at x */
static void centre_weights(const struct grid *g, const double x[3], int n, const long *node, double *w)
{
  double r[MAX_SUPPORT][3], centre[3] = {0}, M[9] = {0}, offset[3], a[3];
  for (int q = 0; q < n; q++) {
    grid_node(g, node[q], r[q]);
    for (int d = 0; d < 3; d++) centre[d] += w[q] * r[q][d];
  }
  for (int q = 0; q < n; q++) {
    for (int d = 0; d < 3; d++) r[q][d] -= centre[d];
    for (int e = 0; e < 9; e++) M[e] += w[q] * r[q][e / 3] * r[q][e % 3];
  }
  for (int d = 0; d < 3; d++) offset[d] = x[d] - centre[d];
  solve_moments(M, offset, g->h, a);
  for (int q = 0; q < n; q++) w[q] *= 1 + r[q][0] * a[0] + r[q][1] * a[1] + r[q][2] * a[2];
}

/* the basis one order lower, whose difference over a cell is the derivative of `basis`; NULL: there is none */
static const struct kernels *lower_kernels(int dim, enum basis basis)
{
  return basis == BASIS_LINEAR ? NULL : kernels_find(dim, basis == BASIS_CUBIC ? BASIS_QUADRATIC : BASIS_LINEAR);
}

/* Weights of a loaded surface over the nodes of its marker. What balances a uniform stress of the body at a node is not
 * w(surface), the integral of dw/dn below it, but the points' midpoint sum of that integral. With n points per cell
 * along the normal it telescopes to the mean of the lower basis at n places within a cell around the surface. With w
 * itself a node beyond the surface gets more than the points can carry, and the load pulls it out of the body (cubic,
 * one point per cell). */
static void surface_weights(const struct sim *sim, const struct mpm *m, long i, const double x[3], const long *node,
                            double *w)
{
  const struct kernels *lower = lower_kernels(sim->grid.dim, m->kernels->basis);
  const double         *normal = m->marker_normal[i];
  int                   axis = 0, points;
  for (int d = 1; d < sim->grid.dim; d++)
    if (fabs(normal[d]) > fabs(normal[axis])) axis = d;
  points = sim->scene->numerics.points_per_axis[axis];
  memset(w, 0, (size_t)m->kernels->n_support * sizeof *w);
  for (int j = 0; j < points; j++) {
    long   own[MAX_SUPPORT];
    double share[MAX_SUPPORT], place[3];
    for (int d = 0; d < 3; d++) place[d] = x[d] + ((j + 0.5) / points - 0.5) * sim->grid.h * normal[d];
    lower->weights(&m->kernel_grid, place, own, share, NULL);
    for (int a = 0; a < lower->n_support; a++)
      for (int q = 0; q < m->kernels->n_support; q++)
        if (node[q] == own[a]) w[q] += share[a] / points;
  }
}

/* Nodes of a marker and its weights over those that hold enough of the solid. Their sum stays one and their centre at
 * the marker: beyond a free surface nodes are missing, and without the second a load would act too deep, a velocity be
 * too low. On a periodic axis a marker's place counts its turns, its weights do not. */
static void marker_weights(const struct sim *sim, const struct mpm *m, long i, long *node, double *w)
{
  int           dim = sim->grid.dim, n = m->kernels->n_support;
  double        x[3] = {0}, heaviest = 0, kept = 0;
  const double *mass_nc = m->bodies[m->marker_body[i]].mass_nc;
  memcpy(x, m->x_m + i * dim, (size_t)dim * sizeof *x);
  points_wrap(&sim->grid, 1, x);
  m->kernels->weights(&m->kernel_grid, x, node, w, NULL);
  if (m->marker_area[i] > 0 && m->kernels->basis != BASIS_LINEAR) surface_weights(sim, m, i, x, node, w);
  for (int q = 0; q < n; q++) heaviest = fmax(heaviest, w[q] != 0 ? mass_nc[node[q]] : 0);
  for (int q = 0; q < n; q++) {
    if (mass_nc[node[q]] <= light_node * heaviest) w[q] = 0;
    kept += w[q];
  }
  for (int q = 0; q < n; q++) w[q] = kept > 0 ? w[q] / kept : 0;
  centre_weights(&sim->grid, x, n, node, w);
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
    for (int d = 0; d < dim; d++) vel[d] += w[q] * m->bodies[m->marker_body[i]].vel_new_nc[node[q] * dim + d];
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
        for (int d = 0; d < dim; d++) m->bodies[m->marker_body[i]].force_nc[node[q] * dim + d] += w[q] * force[d];
    }
  for (int b = 0; b < m->n_bodies; b++) sides_fold(sim, m, b, FOLD_LOADS, sim->t);
  return OK;
}

/* they ride on the new nodal velocity; the loads' work is counted */
enum status mpm_move_markers(struct sim *sim, double dt)
{
  struct mpm         *m = mpm_of(sim);
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
  return OK;
}
