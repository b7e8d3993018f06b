/* Porosity at nodes and water points, and the volume that the water fills. theory_twopoint 2 */
#include "twopoint/twopoint.h"

#include "core/parallel.h"
#include "coupling/coupling.h"
#include "mpm/mpm.h"

#include <math.h>
#include <string.h>

static const double least_porosity = 0.05; /* points crowd together at times */

void twopoint_clear(const struct sim *sim, int n, double *field)
{
  memset(field, 0, (size_t)(sim->grid.size * n) * sizeof *field);
}

void twopoint_gather_volumes(struct sim *sim, struct twopoint *w, const double *increment)
{
  struct scatter_args args = {.n = 1, .x = w->x_w, .weight = w->volume_w, .node = {w->water_volume_nc}};
  if (w->coupling) {
    args.value[args.n] = w->porosity_w;
    args.node[args.n++] = w->water_pores_nc;
  }
  if (increment) {
    args.value[args.n] = increment;
    args.node[args.n++] = w->average_nc;
  }
  for (int q = 0; q < args.n; q++) twopoint_clear(sim, 1, args.node[q]);
  FOR_RUNS(w->points, &sim->grid, run, group) w->kernels->scatter(&w->kernel_grid, &run, &args);
  for (int q = 0; q < args.n; q++) boundary_fold(&w->kernel_grid, w->sides, 1, args.node[q]);
}

enum status twopoint_gather_water(struct sim *sim, double dt)
{
  (void)dt;
  struct twopoint *w = twopoint_of(sim);
  twopoint_gather_volumes(sim, w, w->params->average_increment ? w->dlnJ_w : NULL);
  return OK;
}

/* grains per *filled* volume: a surface where soil and water end together does not look like a loose soil. What is
 * filled are water and grains, not the V_f of the points, which know the porosity of the last step: that would answer
 * with (1 - n)/n of its error, turn by turn */
static double filled_porosity(const struct twopoint *w, long node)
{
  const struct coupling *c = w->coupling;
  double                 room = c->room_nc[node], water_room = w->water_room_nc[node];
  if (!(room > 0) || !(water_room > 0)) return 1;
  double grains = c->solid_nc[node] / room, wet = w->water_pores_nc[node] / water_room + grains;
  double filled = fmin(1, fmax(c->bulk_nc[node] / room, wet));
  return filled > 1e-9 ? fmax(least_porosity, 1 - grains / filled) : 1;
}

static void find_skeleton_porosity(struct sim *sim, struct twopoint *w)
{
  struct box nodes = boundary_nodes(&sim->grid, w->sides);
  FOR_BOX(&sim->grid, nodes, i) w->skeleton_porosity_nc[i] = filled_porosity(w, i);
  boundary_ghosts(&w->kernel_grid, w->sides, 1, sim->t, w->skeleton_porosity_nc);
}

/* points fill their piece of the lattice with water and grains: what grains leave is water */
void twopoint_start_porosity(struct sim *sim, struct twopoint *w)
{
  struct gather_args args = {.n = 1, .x = w->x_w, .node = {w->skeleton_porosity_nc}, .value = {w->porosity_w}};
  struct box         nodes = boundary_nodes(&sim->grid, w->sides);
  twopoint_gather_volumes(sim, w, NULL);
  FOR_BOX(&sim->grid, nodes, i)
  w->water_pores_nc[i] = fmax(0, w->water_volume_nc[i] - w->coupling->solid_nc[i]);
  find_skeleton_porosity(sim, w);
  FOR_RUNS_READING(w->points, run, group) w->kernels->gather(&w->kernel_grid, &run, &args);
}

/* the porosity that the water of a node has: then share times force is mass times gravity at rest, node by node */
static void average_porosity(struct sim *sim, struct twopoint *w)
{
  struct box nodes = boundary_nodes(&sim->grid, w->sides);
  double     least = 1e-12 * grid_cell_volume(&sim->grid);
  FOR_BOX(&sim->grid, nodes, i)
  {
    bool wet = w->water_volume_nc[i] > least && w->water_room_nc[i] > 0;
    w->porosity_nc[i] = wet ? w->water_pores_nc[i] / w->water_volume_nc[i] : w->skeleton_porosity_nc[i];
  }
  boundary_ghosts(&w->kernel_grid, w->sides, 1, sim->t, w->porosity_nc);
}

enum status twopoint_find_fill(struct sim *sim, double dt)
{
  (void)dt;
  struct twopoint *w = twopoint_of(sim);
  struct box       nodes = boundary_nodes(&sim->grid, w->sides);
  FOR_BOX(&sim->grid, nodes, i)
  w->water_fill_nc[i] = w->water_room_nc[i] > 0 ? fmin(1, w->water_volume_nc[i] / w->water_room_nc[i]) : 0;
  boundary_ghosts(&w->kernel_grid, w->sides, 1, sim->t, w->water_fill_nc);
  return OK;
}

enum status twopoint_find_porosity(struct sim *sim, double dt)
{
  struct twopoint *w = twopoint_of(sim);
  find_skeleton_porosity(sim, w);
  average_porosity(sim, w);
  return twopoint_find_fill(sim, dt);
}
