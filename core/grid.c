/* Indices, positions and boxes of the uniform grid. */
#include "core/grid.h"

#include "core/parallel.h"

void grid_create(int dim, const double min[3], const int n[3], double h, const bool periodic[3], struct grid *grid)
{
  struct grid g = {.dim = dim, .h = h, .n = {n[0], n[1], dim == 3 ? n[2] : 1}};
  long        size = 1;
  for (int d = 0; d < 3; d++) {
    bool used = d < dim;
    g.min[d] = used ? min[d] : 0;
    g.periodic[d] = used && periodic[d];
    g.stride[d] = size;
    if (used) g.origin += GHOST * size;
    size *= used ? g.n[d] + 1 + 2 * GHOST : 1;
  }
  g.size = size;
  *grid = g;
}

void grid_place(const struct grid *g, long index, int place[3])
{
  for (int d = 2; d >= 0; d--) {
    place[d] = 0;
    if (d >= g->dim) continue;
    place[d] = (int)(index / g->stride[d]) - GHOST;
    index %= g->stride[d];
  }
}

static void position(const struct grid *g, long index, double shift, int axis, double axis_shift, double x[3])
{
  int place[3];
  grid_place(g, index, place);
  for (int d = 0; d < 3; d++) x[d] = d < g->dim ? g->min[d] + (place[d] + (d == axis ? axis_shift : shift)) * g->h : 0;
}

void grid_centre(const struct grid *g, long cell, double x[3]) { position(g, cell, 0.5, -1, 0, x); }
void grid_node(const struct grid *g, long node, double x[3]) { position(g, node, 0, -1, 0, x); }
void grid_face(const struct grid *g, long face, int axis, double x[3]) { position(g, face, 0.5, axis, 0, x); }

double grid_cell_volume(const struct grid *g) { return g->dim == 3 ? g->h * g->h * g->h : g->h * g->h; }

struct box grid_cells(const struct grid *g) { return (struct box){{0, 0, 0}, {g->n[0], g->n[1], g->n[2]}}; }

struct box grid_nodes(const struct grid *g)
{
  struct box b = grid_cells(g);
  for (int d = 0; d < g->dim; d++)
    if (!g->periodic[d]) b.hi[d]++;
  return b;
}

struct box grid_faces(const struct grid *g, int axis)
{
  struct box b = grid_cells(g);
  b.hi[axis]++;
  return b;
}

struct box grid_side_faces(const struct grid *g, int side)
{
  struct box b = grid_cells(g);
  b.lo[side / 2] = side % 2 ? g->n[side / 2] : 0;
  b.hi[side / 2] = b.lo[side / 2] + 1;
  return b;
}

struct box grid_all(const struct grid *g)
{
  struct box b = grid_cells(g);
  for (int d = 0; d < g->dim; d++) {
    b.lo[d] = -GHOST;
    b.hi[d] = g->n[d] + 1 + GHOST;
  }
  return b;
}

int grid_node_offsets(const struct grid *g, int axis, long *offset)
{
  int n = 0;
  for (int corner = 0; corner < 1 << g->dim; corner++) {
    if (axis >= 0 && corner >> axis & 1) continue;
    offset[n] = 0;
    for (int d = 0; d < g->dim; d++) offset[n] += (corner >> d & 1) * g->stride[d];
    n++;
  }
  return n;
}

/* one layer of ghosts across an axis, from the owned layer that is the same place */
static void fill_layer(const struct grid *g, int n, int axis, int layer, double *field)
{
  struct box b = grid_all(g);
  int        owned = ((layer % g->n[axis]) + g->n[axis]) % g->n[axis];
  long       shift = (owned - layer) * g->stride[axis] * n;
  b.lo[axis] = layer;
  b.hi[axis] = layer + 1;
  FOR_BOX(g, b, c)
  for (int q = 0; q < n; q++) field[c * n + q] = field[c * n + q + shift];
}

void grid_fill_periodic(const struct grid *g, int n, double *field)
{
  for (int d = 0; d < g->dim; d++) {
    if (!g->periodic[d]) continue;
    for (int layer = 1; layer <= GHOST; layer++) fill_layer(g, n, d, -layer, field);
    for (int layer = 0; layer <= GHOST; layer++) fill_layer(g, n, d, g->n[d] + layer, field);
  }
}
