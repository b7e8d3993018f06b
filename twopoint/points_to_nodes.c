/* Water points to nodes: mass, momentum, force of pressure and shear; nodal velocities. theory_twopoint 3 */
#include "twopoint/twopoint.h"

#include "core/parallel.h"
#include "mpm/mpm.h"

static const double full_enough = 0.9; /* fill at a point from which on its water holds together under tension */

/* fill of the space around a point */
static double fill_at(const struct twopoint *w, int dim, long p)
{
  long   node[MAX_SUPPORT];
  double weight[MAX_SUPPORT], fill = 0;
  w->kernels->weights(&w->kernel_grid, w->x_w + p * dim, node, weight, NULL);
  for (int q = 0; q < w->kernels->n_support; q++) fill += weight[q] * w->water_fill_nc[node[q]];
  return fill;
}

/* spray and surfaces do not pull; the state keeps its sign, or averages would pump volume in */
static void find_push(const struct twopoint *w, int dim, long begin, long end)
{
  const double *P = w->averaged_w ? w->averaged_w : w->P_w;
  for (long p = begin; p < end; p++) {
    bool pulls = P[p] >= 0 || w->params->tension || fill_at(w, dim, p) >= full_enough;
    w->push_w[p] = pulls ? P[p] : 0;
  }
}

static void find_velocities(const struct sim *sim, struct twopoint *w)
{
  struct box all = grid_all(&sim->grid);
  int        dim = sim->grid.dim;
  FOR_BOX(&sim->grid, all, i)
  for (int d = 0; d < dim; d++)
    w->water_vel_nc[i * dim + d] =
        w->water_mass_nc[i] > w->mass_floor ? w->water_mom_nc[i * dim + d] / w->water_mass_nc[i] : 0;
  boundary_velocity(&sim->grid, w->sides, sim->t, w->water_vel_nc);
}

enum status twopoint_points_to_nodes(struct sim *sim, double dt)
{
  (void)dt;
  struct twopoint      *w = twopoint_of(sim);
  int                   dim = sim->grid.dim;
  const struct p2g_args args = {.x = w->x_w,
                                .vel = w->vel_w,
                                .affine = w->affine_w,
                                .mass = w->mass_w,
                                .volume = w->volume_w,
                                .stress = w->shear_w,
                                .pressure = w->push_w,
                                .mass_nc = w->water_mass_nc,
                                .mom_nc = w->water_mom_nc,
                                .force_nc = w->water_force_nc};
  twopoint_clear(sim, 1, w->water_mass_nc);
  twopoint_clear(sim, dim, w->water_mom_nc);
  twopoint_clear(sim, dim, w->water_force_nc);
  FOR_RUNS(w->points, &sim->grid, run, group)
  {
    find_push(w, dim, run.begin, run.end);
    w->kernels->p2g(&w->kernel_grid, &run, &args);
  }
  boundary_fold(&w->kernel_grid, w->sides, 1, w->water_mass_nc);
  boundary_fold(&w->kernel_grid, w->sides, dim, w->water_mom_nc);
  boundary_fold(&w->kernel_grid, w->sides, dim, w->water_force_nc);
  find_velocities(sim, w);
  return OK;
}
