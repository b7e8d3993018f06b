/* Walls on nodal fields. Mirrored ghosts: a ghost node is the image of the node inside, the normal component of a
 * vector is odd, everything else even; no-slip walls make all components odd. Modified splines need no ghosts.
 * theory 3.2 */
#include "core/parallel.h"
#include "mpm/mpm.h"

static bool is_wall(const struct side_condition *side)
{
  return side->kind != SIDE_OPEN && side->kind != SIDE_PERIODIC;
}

/* the plane of nodes on a side: all entries of the other axes */
static struct box wall_plane(const struct grid *g, int side)
{
  struct box b = grid_all(g);
  int        d = side / 2;
  b.lo[d] = side % 2 ? g->n[d] : 0;
  b.hi[d] = b.lo[d] + 1;
  return b;
}

static double parity(const struct side_condition *side, int axis, int n, int component)
{
  if (n == 1) return 1;
  if (side->kind == SIDE_ABSORBING) return component == axis && side->shear_only ? -1 : 1;
  bool stuck = side->kind == SIDE_NO_SLIP || (side->kind == SIDE_VELOCITY && !side->rubs);
  return component == axis || stuck ? -1 : 1;
}

/* place along a periodic axis that a ghost plane is the image of; -1: not a ghost */
static int image_place(const struct grid *g, int d, int place)
{
  int n = g->n[d];
  return place >= 0 && place < n ? -1 : (place % n + n) % n;
}

static void fold_periodic(const struct grid *g, int d, int n, double *field)
{
  struct box b = wall_plane(g, 2 * d);
  FOR_BOX_SERIAL(g, b, c)
  for (int k = -GHOST; k <= g->n[d] + GHOST; k++) {
    int  image = image_place(g, d, k);
    long from = c + k * g->stride[d], to = c + image * g->stride[d];
    for (int q = 0; q < n && image >= 0; q++) {
      field[to * n + q] += field[from * n + q];
      field[from * n + q] = 0;
    }
  }
}

void boundary_fold_side(const struct kernel_grid *kg, const struct side_condition *sides, int side, int n,
                        double *field)
{
  const struct grid *g = &kg->g;
  int                d = side / 2;
  long               out = (side % 2 ? 1 : -1) * g->stride[d];
  struct box         b = wall_plane(g, side);
  if (g->periodic[d]) {
    if (side % 2 == 0) fold_periodic(g, d, n, field);
    return;
  }
  if (!is_wall(&sides[side]) || kg->modified[side]) return;
  FOR_BOX_SERIAL(g, b, c)
  for (int q = 0; q < n; q++) {
    field[(c - out) * n + q] += parity(&sides[side], d, n, q) * field[(c + out) * n + q];
    field[(c + out) * n + q] = 0;
  }
}

void boundary_fold(const struct kernel_grid *kg, const struct side_condition *sides, int n, double *field)
{
  for (int side = 0; side < 2 * kg->g.dim; side++) boundary_fold_side(kg, sides, side, n, field);
}

static void ghosts_periodic(const struct grid *g, int d, int n, double *field)
{
  struct box b = wall_plane(g, 2 * d);
  FOR_BOX_SERIAL(g, b, c)
  for (int k = -GHOST; k <= g->n[d] + GHOST; k++) {
    int  image = image_place(g, d, k);
    long to = c + k * g->stride[d], from = c + image * g->stride[d];
    for (int q = 0; q < n && image >= 0; q++) field[to * n + q] = field[from * n + q];
  }
}

void boundary_speed(const struct side_condition *side, const double x[3], double t, double speed[3])
{
  for (int d = 0; d < 3; d++)
    speed[d] = side->kind == SIDE_VELOCITY && t >= 0 ? function_value(&side->velocity[d], x, t) : 0;
}

static double wall_speed(const struct grid *g, const struct side_condition *side, long node, int component, double t)
{
  double x[3], speed[3];
  if (side->kind != SIDE_VELOCITY) return 0;
  grid_node(g, node, x);
  boundary_speed(side, x, t, speed);
  return speed[component];
}

void boundary_ghosts(const struct kernel_grid *kg, const struct side_condition *sides, int n, double t, double *field)
{
  const struct grid *g = &kg->g;
  for (int side = 0; side < 2 * g->dim; side++) {
    int  d = side / 2;
    long out = (side % 2 ? 1 : -1) * g->stride[d];
    if (g->periodic[d]) {
      if (side % 2 == 0) ghosts_periodic(g, d, n, field);
      continue;
    }
    if (!is_wall(&sides[side])) continue;
    struct box b = wall_plane(g, side);
    FOR_BOX_SERIAL(g, b, c)
    for (int q = 0; q < n; q++) {
      double sign = parity(&sides[side], d, n, q), wall = sign < 0 ? wall_speed(g, &sides[side], c, q, t) : 0;
      field[(c + out) * n + q] = kg->modified[side] ? 2 * field[c * n + q] - field[(c - out) * n + q]
                                                    : 2 * wall + sign * field[(c - out) * n + q];
    }
  }
}

void boundary_velocity(const struct grid *g, const struct side_condition *sides, double t, double *vel_nc)
{
  for (int side = 0; side < 2 * g->dim; side++) {
    if (!is_wall(&sides[side])) continue;
    struct box b = wall_plane(g, side);
    FOR_BOX_SERIAL(g, b, c)
    for (int q = 0; q < g->dim; q++)
      if (parity(&sides[side], side / 2, g->dim, q) < 0) vel_nc[c * g->dim + q] = wall_speed(g, &sides[side], c, q, t);
  }
}

bool boundary_holds(const struct grid *g, const struct side_condition *sides, long node, int component)
{
  int place[3];
  grid_place(g, node, place);
  for (int side = 0; side < 2 * g->dim; side++) {
    int d = side / 2;
    if (is_wall(&sides[side]) && place[d] == (side % 2 ? g->n[d] : 0) && parity(&sides[side], d, g->dim, component) < 0)
      return true;
  }
  return false;
}

struct box boundary_nodes(const struct grid *g, const struct side_condition *sides)
{
  struct box b = grid_nodes(g);
  for (int side = 0; side < 2 * g->dim; side++) {
    if (sides[side].kind != SIDE_OPEN) continue;
    if (side % 2)
      b.hi[side / 2]++;
    else
      b.lo[side / 2]--;
  }
  return b;
}

/* what a wall's first ghost weight holds inside, in h: the sum of a basis function over the lattice of points beyond
 * one node from its centre. (Its integral would leave 2 % of a full lattice unaccounted for.) */
static double tail(const struct kernel_grid *kg, enum basis basis, int axis)
{
  double l = kg->half_width[axis] / kg->g.h, sum = 0;
  for (double z = 1 + l; z < 2; z += 2 * l) {
    double w = basis == BASIS_CUBIC       ? (2 - z) * (2 - z) * (2 - z) / 6
               : basis == BASIS_QUADRATIC ? (z < 1.5 ? 0.5 * (1.5 - z) * (1.5 - z) : 0)
                                          : 0;
    sum += 2 * l * w;
  }
  return sum;
}

double boundary_room(const struct kernel_grid *kg, enum basis basis, long node)
{
  const struct grid *g = &kg->g;
  int                place[3];
  double             room = 1;
  grid_place(g, node, place);
  for (int d = 0; d < g->dim; d++) {
    double e = tail(kg, basis, d), axis = 1;
    if (!g->periodic[d])
      for (int high = 0; high < 2; high++) {
        int    inside = high ? g->n[d] - place[d] : place[d];
        double folded = kg->modified[2 * d + high] ? 2 * e : 0;
        axis += inside == 0 ? -0.5 + folded : inside == 1 ? -folded : inside == -1 ? -1 : 0;
      }
    room *= g->h * fmax(axis, 0);
  }
  return room;
}
