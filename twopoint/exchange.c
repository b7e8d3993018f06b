/* Drag, implicit at every node, and the momentum that the water gives the solid in this step. theory_twopoint 5 */
#include "twopoint/twopoint.h"

#include "core/parallel.h"
#include "coupling/coupling.h"
#include "mpm/mpm.h"

#include <string.h>

/* impulse of drag on the water along d at the end of the step: slip <- slip/(1 + dt D (1/m_s + 1/m_f)); what a wall
 * prescribes does not answer */
static double drag_impulse(const struct twopoint *w, int dim, long node, int d, double dt)
{
  const struct mpm *m = w->mpm;
  long              at = node * dim + d;
  bool              moves = m && m->mass_nc[node] > m->mass_floor && !w->solid_bound[at];
  double            slip = (m ? w->solid_star_nc[at] : 0) - w->water_star_nc[at], D = dt * w->drag_nc[node];
  double            s = (moves ? 1 / m->mass_nc[node] : 0) + (w->water_bound[at] ? 0 : 1 / w->water_mass_nc[node]);
  return D * slip / (1 + D * s);
}

/* what the solid gains the water loses: share of the pressure force, and drag */
static void exchange_at(struct twopoint *w, int dim, long node, double dt)
{
  double *dmom_nc = w->mpm ? w->coupling->dmom_nc : NULL;
  bool    shares = twopoint_shares(w, node);
  if (!(w->water_mass_nc[node] > w->mass_floor)) return;
  for (int d = 0; d < dim; d++) {
    long   at = node * dim + d;
    double impulse = w->drag_nc[node] > 0 ? drag_impulse(w, dim, node, d, dt) : 0;
    if (!w->water_bound[at]) w->water_vel_new_nc[at] += impulse / w->water_mass_nc[node];
    if (dmom_nc && shares) dmom_nc[at] = dt * (1 - w->porosity_nc[node]) * w->water_force_nc[at] - impulse;
  }
}

enum status twopoint_exchange_momentum(struct sim *sim, double dt)
{
  struct twopoint   *w = twopoint_of(sim);
  const struct grid *g = &sim->grid;
  struct box         nodes = grid_nodes(g);
  int                dim = g->dim;
  memcpy(w->water_vel_new_nc, w->water_star_nc, (size_t)(g->size * dim) * sizeof(double));
  if (w->mpm) twopoint_clear(sim, dim, w->coupling->dmom_nc);
  if (w->coupling) FOR_BOX(g, nodes, i) exchange_at(w, dim, i, dt);
  boundary_ghosts(&w->kernel_grid, w->sides, dim, sim->t, w->water_vel_nc);
  boundary_ghosts(&w->kernel_grid, w->sides, dim, sim->t + dt, w->water_vel_new_nc);
  return OK;
}
