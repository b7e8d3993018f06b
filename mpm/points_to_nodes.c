/* Points to nodes: mass, momentum, internal force; tractions of loaded surfaces; nodal velocities. theory 3.1 */
#include "mpm/sides.h"
#include "mpm/stages.h"
#include "mpm/walls.h"

#include "constitutive/constitutive.h"
#include "core/parallel.h"
#include "core/tensor.h"

enum status mpm_sort_points(struct sim *sim, double dt)
{
  (void)dt;
  struct mpm *m = mpm_of(sim);
  points_wrap(&sim->grid, m->points->n, m->x_p);
  if (!points_need_sort(&sim->grid, m->points, m->x_p)) return OK;
  TRY(mpm_handle_strays(sim, m));
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
  PARALLEL_FOR
  for (long q = 0; q < g->size * n; q++) field[q] = 0;
}

/* whether points of the group move and belong to the body */
static bool in_body(const struct scene *scene, int group, int body)
{
  return scene->solids[group].body == body && !scene_material(scene, group)->model->held;
}

/* gathers mass and momentum of every body, and with `force` the internal force */
static void gather_points(struct sim *sim, struct mpm *m, bool force)
{
  struct p2g_args args = {.x = m->x_p,
                          .vel = m->vel_p,
                          .affine = m->affine_p,
                          .mass = m->mass_p,
                          .volume = m->volume_p,
                          .stress = force ? m->stress_p : NULL};
  for (int b = 0; b < m->n_bodies; b++) {
    args.mass_nc = m->bodies[b].mass_nc;
    args.mom_nc = m->bodies[b].mom_nc;
    args.force_nc = force ? m->bodies[b].force_nc : NULL;
    clear(&sim->grid, 1, args.mass_nc);
    clear(&sim->grid, sim->grid.dim, args.mom_nc);
    if (force) clear(&sim->grid, sim->grid.dim, args.force_nc);
    FOR_RUNS(m->points, &sim->grid, run, group)
    if (in_body(sim->scene, group, b)) m->kernels->p2g(&m->kernel_grid, &run, &args);
  }
}

enum status mpm_points_to_nodes(struct sim *sim, double dt)
{
  (void)dt;
  gather_points(sim, mpm_of(sim), true);
  return OK;
}

/* velocity = momentum / mass where there is enough mass, else zero */
void mpm_velocities(const struct sim *sim, const struct mpm *m, const struct body_nodes *b, double t, double *vel_nc)
{
  const struct grid *g = &sim->grid;
  struct box         all = grid_all(g);
  int                dim = g->dim;
  FOR_BOX(g, all, c)
  for (int d = 0; d < dim; d++)
    vel_nc[c * dim + d] = b->mass_nc[c] > m->mass_floor ? b->mom_nc[c * dim + d] / b->mass_nc[c] : 0;
  boundary_velocity(g, m->sides, t, vel_nc);
}

enum status mpm_fold_nodes(struct sim *sim, double dt)
{
  (void)dt;
  struct mpm                  *m = mpm_of(sim);
  const struct side_condition *sides = m->sides;
  for (int b = 0; b < m->n_bodies; b++) {
    const struct body_nodes *own = &m->bodies[b];
    sides_fold(sim, m, b, FOLD_STEP, sim->t);
    mpm_velocities(sim, m, own, sim->t, own->vel_nc);
    boundary_ghosts(&m->kernel_grid, sides, 1, sim->t, own->mass_nc); /* markers and faces look for the solid there */
  }
  return OK;
}

/* The regathered gradient L is taken at the new places, dF = (I - dt L)^-1. It becomes the gradient at the old ones:
 * dF = I + dt L', L' = L (I - dt L)^-1 */
void mpm_refer_to_start(const struct sim *sim, const struct mpm *m, double dt, double *gradv)
{
  int dim = sim->grid.dim;
  PARALLEL_FOR
  for (long p = 0; p < m->points->n; p++) {
    double *L = gradv + p * dim * dim, wide[9] = {0}, left[9], inverse[9];
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
  const struct side_condition *sides = m->sides;
  TRY(mpm_sort_points(sim, dt)); /* they have moved, perhaps too far for their block */
  gather_points(sim, m, false);
  for (int b = 0; b < m->n_bodies; b++) {
    const struct body_nodes *own = &m->bodies[b];
    sides_fold(sim, m, b, FOLD_REMAP, sim->t + dt);
    mpm_velocities(sim, m, own, sim->t + dt, own->vel_new_nc);
    if (m->walls) walls_meet_again(sim, m, b);
    boundary_ghosts(&m->kernel_grid, sides, sim->grid.dim, sim->t + dt, own->vel_new_nc);
  }
  mpm_gather_gradient(sim, m, m->gradv_p);
  mpm_refer_to_start(sim, m, dt, m->gradv_p);
  return OK;
}
