/* Nodes forward in time, and back to the points. theory 3.1 */
#include "mpm/stages.h"

#include "constitutive/constitutive.h"
#include "core/parallel.h"

#include <string.h>

enum status mpm_advance_nodes(struct sim *sim, double dt)
{
  struct mpm                  *m = mpm_of(sim);
  const struct grid           *g = &sim->grid;
  const struct side_condition *sides = sim->scene->solid_side;
  struct box                   nodes = boundary_nodes(g, sides);
  int                          dim = g->dim;
  double                       gravity[3];
  sim_gravity(sim, sim->t + 0.5 * dt, gravity);
  memcpy(m->vel_new_nc, m->vel_nc, (size_t)(g->size * dim) * sizeof(double));
  FOR_BOX(g, nodes, c)
  if (m->mass_nc[c] > m->mass_floor)
    for (int d = 0; d < dim; d++)
      m->vel_new_nc[c * dim + d] += dt * (m->force_nc[c * dim + d] / m->mass_nc[c] + gravity[d]);
  boundary_velocity(g, sides, sim->t + dt, m->vel_new_nc);
  boundary_ghosts(&m->kernel_grid, sides, dim, sim->t, m->vel_nc);
  boundary_ghosts(&m->kernel_grid, sides, dim, sim->t + dt, m->vel_new_nc);
  return OK;
}

/* the blend of a scene holds for a step of this factor, the default; other steps take their share */
static const double blend_step = 0.8;

double mpm_blend(const struct sim *sim, double dt)
{
  const struct numerics *n = &sim->scene->numerics;
  if (n->transfer == TRANSFER_PIC || n->transfer == TRANSFER_APIC) return 1;
  if (n->transfer == TRANSFER_FLIP) return 0;
  double share = sim->dt_limit < INFINITY ? dt / (blend_step * sim->dt_limit) : 1;
  return n->aflip_beta >= 1 ? 1 : 1 - pow(1 - n->aflip_beta, share);
}

enum status mpm_nodes_to_points(struct sim *sim, double dt)
{
  struct mpm           *m = mpm_of(sim);
  const struct g2p_args args = {.dt = dt,
                                .beta = mpm_blend(sim, dt),
                                .vel_old_nc = m->vel_nc,
                                .vel_nc = m->vel_new_nc,
                                .x = m->x_p,
                                .displacement = m->displacement_p,
                                .vel = m->vel_p,
                                .affine = m->affine_p,
                                .gradv = m->gradv_p};
  FOR_RUNS(m->points, &sim->grid, run, group)
  if (!sim->scene->materials[group].model->held) m->kernels->g2p(&m->kernel_grid, &run, &args);
  if (m->x_m) mpm_move_markers(sim, m, dt);
  return OK;
}

void mpm_gather_gradient(struct sim *sim, struct mpm *m, const double *vel_nc)
{
  int                dim = sim->grid.dim;
  struct gather_args args = {.n = dim, .x = m->x_p, .gradient_stride = dim * dim};
  for (int d = 0; d < dim; d++) {
    args.node[d] = vel_nc + d;
    args.stride[d] = dim;
    args.gradient[d] = m->gradv_p + d * dim;
  }
  FOR_RUNS(m->points, &sim->grid, run, group) m->kernels->gather(&m->kernel_grid, &run, &args);
}
