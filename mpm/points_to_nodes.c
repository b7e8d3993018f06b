/* Points to nodes: mass, momentum, internal force; tractions of loaded surfaces; nodal velocities. theory 3.1 */
#include "mpm/stages.h"

#include "constitutive/constitutive.h"
#include "core/parallel.h"
#include "core/tensor.h"

#include <string.h>

enum status mpm_sort_points(struct sim *sim, double dt)
{
  (void)dt;
  struct mpm *m = mpm_of(sim);
  points_wrap(&sim->grid, m->points->n, m->x_p);
  if (!points_need_sort(&sim->grid, m->points, m->x_p)) return OK;
  return mpm_sort_now(sim, m);
}

/* every array of the set follows the new order; scratch of the last step is not needed any more */
enum status mpm_sort_now(struct sim *sim, struct mpm *m)
{
  TRY(points_sort(&sim->grid, m->points, m->x_p));
  points_permute_fields(m->points, sim->scene, AT_SOLID, module_mpm.fields, module_mpm.n_fields, m);
  points_sorted(m->points);
  return OK;
}

static void clear(const struct grid *g, int n, double *field)
{
  memset(field, 0, (size_t)(g->size * n) * sizeof *field);
}

static bool held(const struct sim *sim, int group) { return sim->scene->materials[group].model->held; }

/* gathers mass and momentum, and with `force` the internal force */
static void gather_points(struct sim *sim, struct mpm *m, bool force)
{
  const struct p2g_args args = {.x = m->x_p,
                                .vel = m->vel_p,
                                .affine = m->affine_p,
                                .mass = m->mass_p,
                                .volume = m->volume_p,
                                .stress = force ? m->stress_p : NULL,
                                .mass_nc = m->mass_nc,
                                .mom_nc = m->mom_nc,
                                .force_nc = force ? m->force_nc : NULL};
  FOR_RUNS(m->points, &sim->grid, run, group) if (!held(sim, group)) m->kernels->p2g(&m->kernel_grid, &run, &args);
}

enum status mpm_points_to_nodes(struct sim *sim, double dt)
{
  (void)dt;
  struct mpm *m = mpm_of(sim);
  int         dim = sim->grid.dim;
  clear(&sim->grid, 1, m->mass_nc);
  clear(&sim->grid, dim, m->mom_nc);
  clear(&sim->grid, dim, m->force_nc);
  gather_points(sim, m, true);
  return OK;
}

/* velocity = momentum / mass where there is enough mass, else zero */
static void velocities(const struct sim *sim, const struct mpm *m, double t, double *vel_nc)
{
  const struct grid *g = &sim->grid;
  struct box         all = grid_all(g);
  int                dim = g->dim;
  FOR_BOX(g, all, c)
  for (int d = 0; d < dim; d++)
    vel_nc[c * dim + d] = m->mass_nc[c] > m->mass_floor ? m->mom_nc[c * dim + d] / m->mass_nc[c] : 0;
  boundary_velocity(g, sim->scene->solid_side, t, vel_nc);
}

enum status mpm_fold_nodes(struct sim *sim, double dt)
{
  (void)dt;
  struct mpm                  *m = mpm_of(sim);
  const struct side_condition *sides = sim->scene->solid_side;
  boundary_fold(&m->kernel_grid, sides, 1, m->mass_nc);
  boundary_fold(&m->kernel_grid, sides, sim->grid.dim, m->mom_nc);
  boundary_fold(&m->kernel_grid, sides, sim->grid.dim, m->force_nc);
  velocities(sim, m, sim->t, m->vel_nc);
  boundary_ghosts(&m->kernel_grid, sides, 1, sim->t, m->mass_nc); /* markers and faces look for the solid there */
  return OK;
}

/* The regathered gradient L is taken at the new places, dF = (I - dt L)^-1. It becomes the gradient at the old ones:
 * dF = I + dt L', L' = L (I - dt L)^-1 */
static void refer_to_start(const struct sim *sim, struct mpm *m, double dt)
{
  int dim = sim->grid.dim;
  PARALLEL_FOR
  for (long p = 0; p < m->points->n; p++) {
    double *L = m->gradv_p + p * dim * dim, wide[9] = {0}, left[9], inverse[9];
    for (int q = 0; q < dim * dim; q++) wide[q / dim * 3 + q % dim] = L[q];
    for (int q = 0; q < 9; q++) left[q] = (q % 4 == 0) - dt * wide[q];
    tensor_inverse(left, inverse);
    tensor_product(wide, inverse, wide);
    for (int q = 0; q < dim * dim; q++) L[q] = wide[q / dim * 3 + q % dim];
  }
}

/* MUSL: the velocity whose gradient strains the points is gathered from their new velocities, at their new places (mass
 * too: old masses under new momenta tear free surfaces apart). Sulsky et al. 1995 */
enum status mpm_remap_momentum(struct sim *sim, double dt)
{
  struct mpm                  *m = mpm_of(sim);
  const struct side_condition *sides = sim->scene->solid_side;
  TRY(mpm_sort_points(sim, dt)); /* they have moved, perhaps too far for their block */
  clear(&sim->grid, 1, m->mass_nc);
  clear(&sim->grid, sim->grid.dim, m->mom_nc);
  gather_points(sim, m, false);
  boundary_fold(&m->kernel_grid, sides, 1, m->mass_nc);
  boundary_fold(&m->kernel_grid, sides, sim->grid.dim, m->mom_nc);
  velocities(sim, m, sim->t + dt, m->vel_new_nc);
  boundary_ghosts(&m->kernel_grid, sides, sim->grid.dim, sim->t + dt, m->vel_new_nc);
  mpm_gather_gradient(sim, m, m->vel_new_nc);
  refer_to_start(sim, m, dt);
  return OK;
}
