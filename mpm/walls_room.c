/* Rooms of nodes beside obstacles. theory 3.11 */
#include "mpm/walls.h"

#include "core/parallel.h"

#include <math.h>
#include <string.h>

/* share of a node's room that stays, however deep in an obstacle it lies: points creep in by a hair */
static const double least_room = 0.01;

/* m: to the nearest obstacle that is there, negative inside */
static double nearest(const struct mpm *m, double t, const double x[3])
{
  double least = INFINITY;
  for (int i = 0; i < m->walls->n_walls; i++) {
    const struct obstacle *body = &m->walls->wall[i].body;
    if (m->walls->wall[i].account >= SIDES && wall_present(body, t) && body->until > 0)
      least = fmin(least, wall_distance(m, i, x, NULL));
  }
  return least;
}

/* the points of a cell's lattice that lie inside */
static void close_cell(const struct sim *sim, const struct mpm *m, double t, long cell, double *taken_nc)
{
  const struct grid *g = &sim->grid;
  const int         *along = sim->scene->numerics.points_per_axis;
  int                points = along[0] * along[1] * (g->dim == 3 ? along[2] : 1);
  double             centre[3], volume = mpm_point_volume(sim->scene);
  grid_centre(g, cell, centre);
  if (nearest(m, t, centre) > 0.5 * sqrt(g->dim) * g->h) return;
  for (int p = 0; p < points; p++) {
    long   node[MAX_SUPPORT];
    double w[MAX_SUPPORT], x[3] = {centre[0], centre[1], centre[2]};
    for (int d = 0, left = p; d < g->dim; left /= along[d++]) x[d] += g->h * ((left % along[d] + 0.5) / along[d] - 0.5);
    if (nearest(m, t, x) >= 0) continue;
    m->kernels->weights(&m->kernel_grid, x, node, w, NULL);
    for (int q = 0; q < m->kernels->n_support; q++) taken_nc[node[q]] += w[q] * volume;
  }
}

void walls_find_rooms(const struct sim *sim, const struct mpm *m, double t, double *taken_nc, double *room_nc)
{
  const struct grid *g = &sim->grid;
  struct box         all = grid_all(g), cells = grid_cells(g);
  memset(taken_nc, 0, (size_t)g->size * sizeof *taken_nc);
  FOR_BOX_SERIAL(g, cells, c) close_cell(sim, m, t, c, taken_nc);
  boundary_fold(&m->kernel_grid, m->sides, 1, taken_nc);
  FOR_BOX_SERIAL(g, all, n)
  {
    double room = boundary_room(&m->kernel_grid, sim->scene->numerics.basis, n);
    room_nc[n] = fmax(least_room * room, room - taken_nc[n]);
  }
}
