/* Nodes forward in time, and back to the points. theory 3.1 */
#include "mpm/stages.h"

#include "constitutive/constitutive.h"
#include "core/parallel.h"

/* what a fluid gave to all bodies together (2.4), each takes by its mass */
enum status mpm_share_push(struct sim *sim, double dt)
{
  (void)dt;
  struct mpm *m = mpm_of(sim);
  int         dim = sim->grid.dim;
  PARALLEL_FOR
  for (long c = 0; c < sim->grid.size; c++) {
    if (!(m->mass_nc[c] > m->mass_floor)) continue;
    for (int d = 0; d < dim; d++) {
      double push = m->force_nc[c * dim + d];
      for (int b = 0; b < m->n_bodies; b++) push -= m->bodies[b].force_nc[c * dim + d];
      for (int b = 0; b < m->n_bodies; b++)
        m->bodies[b].force_nc[c * dim + d] += push * m->bodies[b].mass_nc[c] / m->mass_nc[c];
    }
  }
  return OK;
}

enum status mpm_advance_nodes(struct sim *sim, double dt)
{
  struct mpm                  *m = mpm_of(sim);
  const struct grid           *g = &sim->grid;
  const struct side_condition *sides = m->sides;
  struct box                   nodes = boundary_nodes(g, sides);
  int                          dim = g->dim;
  double                       gravity[3];
  sim_gravity(sim, sim->t + 0.5 * dt, gravity);
  for (int b = 0; b < m->n_bodies; b++) {
    const struct body_nodes *own = &m->bodies[b];
    PARALLEL_FOR
    for (long q = 0; q < g->size * dim; q++) own->vel_new_nc[q] = own->vel_nc[q];
    FOR_BOX(g, nodes, c)
    if (own->mass_nc[c] > m->mass_floor)
      for (int d = 0; d < dim; d++)
        own->vel_new_nc[c * dim + d] += dt * (own->force_nc[c * dim + d] / own->mass_nc[c] + gravity[d]);
    boundary_velocity(g, sides, sim->t + dt, own->vel_new_nc);
    boundary_ghosts(&m->kernel_grid, sides, dim, sim->t, own->vel_nc);
    boundary_ghosts(&m->kernel_grid, sides, dim, sim->t + dt, own->vel_new_nc);
  }
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

struct g2p_args mpm_motion(const struct sim *sim, const struct mpm *m, double dt, int group)
{
  const struct body_nodes *own = &m->bodies[sim->scene->solids[group].body];
  return (struct g2p_args){.dt = dt,
                           .beta = mpm_blend(sim, dt),
                           .vel_old_nc = own->vel_nc,
                           .vel_nc = own->vel_new_nc,
                           .x = m->x_p,
                           .displacement = m->displacement_p,
                           .vel = m->vel_p,
                           .affine = m->affine_p,
                           .gradv = m->gradv_p};
}

enum status mpm_nodes_to_points(struct sim *sim, double dt)
{
  struct mpm *m = mpm_of(sim);
  FOR_RUNS_READING(m->points, run, group)
  {
    const struct g2p_args args = mpm_motion(sim, m, dt, group);
    if (!scene_material(sim->scene, group)->model->held) m->kernels->g2p(&m->kernel_grid, &run, &args);
  }
  return OK;
}

void mpm_gather_gradient(struct sim *sim, struct mpm *m, double *gradv)
{
  int                dim = sim->grid.dim;
  struct gather_args args = {.n = dim, .x = m->x_p, .gradient_stride = dim * dim};
  for (int d = 0; d < dim; d++) {
    args.stride[d] = dim;
    args.gradient[d] = gradv + d * dim;
  }
  FOR_RUNS_READING(m->points, run, group)
  {
    struct gather_args own = args;
    for (int d = 0; d < dim; d++) own.node[d] = m->bodies[sim->scene->solids[group].body].vel_new_nc + d;
    m->kernels->gather(&m->kernel_grid, &run, &own);
  }
}
