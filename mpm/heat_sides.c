/* What the sides of the grid do to heat. The temperature goes on beyond them: as its mirror image at an insulated side,
 * as 2 T - image at one of given temperature T, with the slope that a flux asks for at one of given flux. So it is as
 * smooth as in the interior, whatever numerics.wall_basis says of velocities. theory 3.8 */
#include "mpm/heat.h"

#include "core/parallel.h"

#include <string.h>

bool heat_has_side(const struct scene *scene, int kind)
{
  for (int side = 0; side < 2 * scene->dim; side++)
    if (scene->heat_side[side].kind == kind) return true;
  return false;
}

/* the plane of nodes on a side, ghosts of the other axes included, and the step out of the grid */
static struct box side_plane(const struct grid *g, int side, long *out)
{
  struct box b = grid_all(g);
  int        d = side / 2;
  b.lo[d] = side % 2 ? g->n[d] : 0;
  b.hi[d] = b.lo[d] + 1;
  *out = (side % 2 ? 1 : -1) * g->stride[d];
  return b;
}

static double given(const struct grid *g, const struct heat_side *side, long node, double t)
{
  double x[3];
  grid_node(g, node, x);
  return function_value(&side->value, x, t);
}

void heat_reflect(const struct sim *sim, const struct mpm *m, double t, const double *capacity_nc, double *field)
{
  const struct grid *g = &m->heat_grid.g;
  for (int side = 0; side < 2 * g->dim; side++) {
    const struct heat_side *own = &sim->scene->heat_side[side];
    long                    out;
    struct box              plane = side_plane(g, side, &out);
    if (own->kind != HEAT_TEMPERATURE) continue;
    FOR_BOX_SERIAL(g, plane, c)
    {
      double image = capacity_nc ? 2 * capacity_nc[c + out] * given(g, own, c, t) : 0;
      field[c + out] = image - field[c + out];
    }
  }
}

/* ---- sides with a flux: image + 2 s flux/conductivity, s the distance from the side ---- */

/* K/m outwards at the nodes of a side's plane, into slope_nc: flux over the conductivity of the solid there */
static void find_slopes(const struct sim *sim, struct mpm *m, int side, double t)
{
  const struct grid *g = &sim->grid;
  long               out;
  struct box         plane = side_plane(g, side, &out);
  FOR_BOX_SERIAL(g, plane, c)
  {
    double conductance = m->conductance_nc[c];
    m->slope_nc[c] = conductance > 0 ? given(g, &sim->scene->heat_side[side], c, t) * m->filled_nc[c] / conductance : 0;
  }
}

/* what the images of a point add to the heat content of a side's nodes and, before folding, of its ghosts */
static void lift_point(const struct grid *g, struct mpm *m, int side, long p, double capacity)
{
  int           d = side / 2, wall = side % 2 ? g->n[d] : 0, ghost = side % 2 ? wall + 1 : -1;
  long          out = (ghost - wall) * g->stride[d], node[MAX_SUPPORT];
  const double *x = m->x_p + p * g->dim;
  double        depth = fabs(x[d] - (g->min[d] + wall * g->h)), w[MAX_SUPPORT];
  if (depth >= 2 * g->h) return;
  m->kernels->weights(&m->heat_grid, x, node, w, NULL);
  for (int q = 0; q < m->kernels->n_support; q++) {
    int place[3];
    grid_place(g, node[q], place);
    if (place[d] == wall) m->temperature_nc[node[q]] += w[q] * capacity * depth * m->slope_nc[node[q]];
    if (place[d] == ghost) m->temperature_nc[node[q]] += 2 * w[q] * capacity * depth * m->slope_nc[node[q] - out];
  }
}

void heat_lift(struct sim *sim, struct mpm *m, double t)
{
  const struct scene *scene = sim->scene;
  const struct grid  *g = &sim->grid;
  int                 reach = m->points->block_edge + BLOCK_MARGIN + 2;
  for (int side = 0; side < 2 * g->dim; side++) {
    int d = side / 2, wall = side % 2 ? g->n[d] : 0;
    if (scene->heat_side[side].kind != HEAT_FLUX) continue;
    find_slopes(sim, m, side, t);
    FOR_RUNS(m->points, g, run, group)
    {
      double c = scene_material(scene, group)->heat_capacity;
      bool   near = run.corner[d] - BLOCK_MARGIN - 2 <= wall && run.corner[d] + reach >= wall;
      for (long p = run.begin; p < run.end && near; p++) lift_point(g, m, side, p, m->mass_p[p] * c);
    }
  }
}

/* ---- nodes on sides and beyond ---- */

/* after boundary_ghosts, which made images */
static void bound_side(const struct sim *sim, struct mpm *m, int side, double t, bool increment, double *field)
{
  const struct grid *g = &sim->grid;
  int                kind = sim->scene->heat_side[side].kind;
  long               out;
  struct box         plane = side_plane(g, side, &out);
  if (kind == HEAT_INSULATED || (kind == HEAT_FLUX && increment)) return;
  if (kind == HEAT_FLUX) find_slopes(sim, m, side, t);
  FOR_BOX_SERIAL(g, plane, c)
  if (kind == HEAT_FLUX)
    field[c + out] += 2 * g->h * m->slope_nc[c];
  else
    field[c + out] = 2 * field[c] - field[c - out];
}

void heat_bound(const struct sim *sim, struct mpm *m, double t, bool increment, double *field)
{
  const struct grid *g = &sim->grid;
  long               out;
  for (int side = 0; side < 2 * g->dim; side++) {
    const struct heat_side *own = &sim->scene->heat_side[side];
    struct box              plane = side_plane(g, side, &out);
    if (own->kind != HEAT_TEMPERATURE) continue;
    FOR_BOX_SERIAL(g, plane, c) field[c] = increment ? 0 : given(g, own, c, t);
  }
  boundary_ghosts(&m->heat_grid, sim->scene->solid_side, 1, t, field);
  for (int side = 0; side < 2 * g->dim; side++) bound_side(sim, m, side, t, increment, field);
}

/* ---- the heat that a flux brings ---- */

enum status mpm_fill_sides(struct sim *sim, double dt)
{
  (void)dt;
  struct mpm                  *m = mpm_of(sim);
  const struct side_condition *sides = sim->scene->solid_side;
  double                      *fields[] = {m->filled_nc, m->conductance_nc};
  for (int i = 0; i < 2; i++) memset(fields[i], 0, (size_t)sim->grid.size * sizeof(double));
  FOR_RUNS(m->points, &sim->grid, run, group)
  {
    const struct material *own = scene_material(sim->scene, group);
    struct scatter_args    args = {
           .n = own->conductivity > 0 ? 2 : 1, .x = m->x_p, .weight = m->volume_p, .node = {fields[0], fields[1]}};
    args.factor[1] = (1 - own->porosity) * own->conductivity;
    m->kernels->scatter(&m->heat_grid, &run, &args);
  }
  for (int i = 0; i < 2; i++) {
    boundary_fold(&m->heat_grid, sides, 1, fields[i]);
    boundary_ghosts(&m->heat_grid, sides, 1, sim->t, fields[i]);
  }
  return OK;
}

/* how much of the room at a face's nodes the solid fills */
static double fill_of_face(const struct sim *sim, const struct mpm *m, int axis, long face)
{
  long   offset[4];
  int    n = grid_node_offsets(&sim->grid, axis, offset);
  double fill = 0;
  for (int q = 0; q < n; q++) {
    double room = boundary_room(&m->heat_grid, m->kernels->basis, face + offset[q]);
    fill += room > 0 ? fmin(1, m->filled_nc[face + offset[q]] / room) / n : 0;
  }
  return fill;
}

/* Weights of a place x on a side, with normal `axis`, over the nodes. What balances a uniform gradient of the body's
 * temperature at a node is the points' midpoint sum of dw/dn, which telescopes: for splines to the mean of the lower
 * ones at points_per_axis places within a cell around the side, for GIMP to the hat at the side. */
static int side_weights(const struct sim *sim, const struct mpm *m, int axis, const double x[3], long *node, double *w)
{
  enum basis            basis = m->kernels->basis;
  bool                  spline = basis == BASIS_QUADRATIC || basis == BASIS_CUBIC;
  const struct kernels *lower = kernels_find(sim->grid.dim, basis == BASIS_CUBIC ? BASIS_QUADRATIC : BASIS_LINEAR);
  int                   n = spline ? sim->scene->numerics.points_per_axis[axis] : 1, total = 0;
  for (int j = 0; j < n; j++, total += lower->n_support) {
    double place[3] = {x[0], x[1], x[2]};
    place[axis] += ((j + 0.5) / n - 0.5) * sim->grid.h;
    lower->weights(&m->heat_grid, place, node + total, w + total, NULL);
  }
  return total;
}

enum { MOST_PLACES = 32 }; /* points per axis that a scene may have */

/* heat, J, goes to the nodes that the solid reaches; returns what was taken */
static double heat_place(const struct sim *sim, struct mpm *m, int axis, const double x[3], double heat)
{
  long   node[MOST_PLACES * MAX_SUPPORT];
  double w[MOST_PLACES * MAX_SUPPORT], kept = 0;
  int    n = side_weights(sim, m, axis, x, node, w);
  for (int q = 0; q < n; q++) {
    if (!(m->filled_nc[node[q]] > 0)) w[q] = 0;
    kept += w[q];
  }
  if (!(kept > 0)) return 0;
  for (int q = 0; q < n; q++) m->heat_nc[node[q]] += w[q] / kept * heat;
  return heat;
}

static double heat_side(const struct sim *sim, struct mpm *m, int side, double dt)
{
  const struct grid      *g = &sim->grid;
  const struct heat_side *own = &sim->scene->heat_side[side];
  struct box              cells = grid_cells(g);
  int                     d = side / 2;
  double                  area = grid_cell_volume(g) / g->h, heat = 0;
  cells.lo[d] = side % 2 ? g->n[d] : 0;
  cells.hi[d] = cells.lo[d] + 1;
  FOR_BOX_SERIAL(g, cells, face)
  {
    double x[3], fill = fill_of_face(sim, m, d, face);
    grid_face(g, face, d, x);
    if (fill > 0)
      heat += heat_place(sim, m, d, x, fill * area * dt * function_value(&own->value, x, sim->t + 0.5 * dt));
  }
  return heat;
}

/* per area of the side that the solid covers */
enum status mpm_heat_sides(struct sim *sim, double dt)
{
  struct mpm *m = mpm_of(sim);
  for (int side = 0; side < 2 * sim->grid.dim; side++)
    if (sim->scene->heat_side[side].kind == HEAT_FLUX) m->heat_given += heat_side(sim, m, side, dt);
  m->now.heat_sides += m->heat_given;
  return OK;
}
