/* Local damping: a share of the force on every node, against its motion, for scenes that are to come to rest. theory
 * 3.5, after Cundall 1987 */
#include "core/parallel.h"
#include "mpm/stages.h"

/* whether a wall moves this node as it likes: what is taken from the force there is the wall's */
static bool driven(const struct sim *sim, long node)
{
  int place[3];
  grid_place(&sim->grid, node, place);
  for (int side = 0; side < 2 * sim->grid.dim; side++)
    if (sim->scene->solid_side[side].kind == SIDE_VELOCITY && place[side / 2] == (side % 2 ? sim->grid.n[side / 2] : 0))
      return true;
  return false;
}

/* f <- f - alpha |f + m g| sign(v) per component; returns the work that it takes in the step, J */
static double damp_node(const struct sim *sim, const struct body_nodes *b, const double gravity[3], double dt,
                        long node)
{
  double alpha = mpm_params(sim->scene)->damping, mass = b->mass_nc[node], work = 0;
  for (int d = 0; d < sim->grid.dim; d++) {
    double *force = b->force_nc + node * sim->grid.dim + d, v = b->vel_nc[node * sim->grid.dim + d];
    double  total = *force + mass * gravity[d], taken = v == 0 ? 0 : alpha * copysign(fabs(total), v);
    *force -= taken;
    work += dt * taken * (v + 0.5 * dt * (total - taken) / mass); /* its mean velocity over the step */
  }
  return work;
}

/* rows in parallel, their sums in order */
static double damp_body(const struct sim *sim, struct mpm *m, const struct body_nodes *b, double dt)
{
  struct box nodes = boundary_nodes(&sim->grid, m->sides);
  double     gravity[3], work = 0;
  sim_gravity(sim, sim->t + 0.5 * dt, gravity);
  PARALLEL_FOR
  for (long row = 0; row < box_rows(&nodes); row++) {
    long first = box_row(&sim->grid, &nodes, row);
    m->row_work[row] = 0;
    for (long c = first; c < first + box_length(&nodes); c++) {
      if (!(b->mass_nc[c] > m->mass_floor)) continue;
      double taken = damp_node(sim, b, gravity, dt, c);
      if (!driven(sim, c)) m->row_work[row] += taken;
    }
  }
  for (long row = 0; row < box_rows(&nodes); row++) work += m->row_work[row];
  return work;
}

enum status mpm_damp_nodes(struct sim *sim, double dt)
{
  struct mpm *m = mpm_of(sim);
  for (int b = 0; b < m->n_bodies; b++) m->now.damping += damp_body(sim, m, &m->bodies[b], dt);
  return OK;
}
