/* Nodes forward in time under pressure, stress and gravity, without drag. theory_twopoint 4 */
#include "twopoint/twopoint.h"

#include "core/parallel.h"
#include "mpm/absorb.h"
#include "mpm/mpm.h"
#include "mpm/rub.h"

#include <string.h>

bool twopoint_shares(const struct twopoint *w, long node)
{
  return w->grains_held || (w->mpm && w->mpm->mass_nc[node] > w->mpm->mass_floor);
}

/* share of the pressure force that the water takes */
static double water_share(const struct twopoint *w, long node)
{
  return twopoint_shares(w, node) ? w->porosity_nc[node] : 1;
}

static void predict_water(struct sim *sim, struct twopoint *w, const double gravity[3], double dt)
{
  const struct grid *g = &sim->grid;
  struct box         nodes = boundary_nodes(g, w->sides);
  int                dim = g->dim;
  memcpy(w->water_star_nc, w->water_vel_nc, (size_t)(g->size * dim) * sizeof(double));
  FOR_BOX(g, nodes, i)
  if (w->water_mass_nc[i] > w->mass_floor) {
    double share = water_share(w, i) / w->water_mass_nc[i];
    for (int d = 0; d < dim; d++)
      w->water_star_nc[i * dim + d] += dt * (share * w->water_force_nc[i * dim + d] + gravity[d]);
  }
  boundary_velocity(g, w->sides, sim->t + dt, w->water_star_nc);
}

static void predict_solid(struct sim *sim, struct twopoint *w, const double gravity[3], double dt)
{
  const struct grid *g = &sim->grid;
  const struct mpm  *m = w->mpm;
  struct box         nodes = grid_nodes(g);
  int                dim = g->dim;
  memcpy(w->solid_star_nc, m->vel_nc, (size_t)(g->size * dim) * sizeof(double));
  FOR_BOX(g, nodes, i)
  if (m->mass_nc[i] > m->mass_floor)
    for (int d = 0; d < dim; d++) {
      double force = m->force_nc[i * dim + d] + (1 - water_share(w, i)) * w->water_force_nc[i * dim + d];
      w->solid_star_nc[i * dim + d] += dt * (force / m->mass_nc[i] + gravity[d]);
    }
  absorb_slow(sim, m, dt, w->solid_star_nc);
  boundary_velocity(g, m->sides, sim->t + dt, w->solid_star_nc);
  rub_nodes(sim, m, dt, w->solid_star_nc);
}

enum status twopoint_predict_nodes(struct sim *sim, double dt)
{
  struct twopoint *w = twopoint_of(sim);
  double           gravity[3];
  sim_gravity(sim, sim->t + 0.5 * dt, gravity);
  predict_water(sim, w, gravity, dt);
  if (w->mpm) predict_solid(sim, w, gravity, dt);
  return OK;
}
