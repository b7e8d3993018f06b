/* Uniform Cartesian grid. Cell, node and lower faces (i, j, k) share one index, so every grid field is an array of
 * grid.size entries with GHOST layers around the owned box; a 2D grid has one layer and no ghosts in z. */
#ifndef CORE_GRID_H
#define CORE_GRID_H

#include <stdbool.h>

enum { GHOST = 3 };

struct grid {
  int    dim;
  double min[3], h;
  int    n[3]; /* owned cells; 1 in z in 2D */
  bool   periodic[3];
  long   stride[3], size; /* size: entries of a grid field */
  long   origin;          /* index of cell or node (0, 0, 0) */
};

struct box {
  int lo[3], hi[3]; /* lo <= i < hi */
};

void grid_create(int dim, const double min[3], const int n[3], double h, const bool periodic[3], struct grid *grid);

static inline long grid_at(const struct grid *g, int i, int j, int k)
{
  return g->origin + i * g->stride[0] + j * g->stride[1] + k * g->stride[2];
}

/** i, j, k of an index. */
void grid_place(const struct grid *g, long index, int place[3]);
/** m: centre of a cell. */
void grid_centre(const struct grid *g, long cell, double x[3]);
/** m: position of a node. */
void grid_node(const struct grid *g, long node, double x[3]);
/** m: centre of the face with normal `axis`. */
void grid_face(const struct grid *g, long face, int axis, double x[3]);
/** h^dim, m3 (m2 per metre in 2D). */
double grid_cell_volume(const struct grid *g);

/** Owned cells. */
struct box grid_cells(const struct grid *g);
/** Owned nodes; on a periodic axis the last plane is the first and not owned twice. */
struct box grid_nodes(const struct grid *g);
/** Faces with normal `axis` that touch an owned cell. */
struct box grid_faces(const struct grid *g, int axis);
/** Faces on a side of the grid, 2 axis or 2 axis + 1: numbered as the cells above them, so those of an upper side lie
 * one beyond. */
struct box grid_side_faces(const struct grid *g, int side);
/** Box with every entry, ghosts included. */
struct box grid_all(const struct grid *g);

static inline long box_rows(const struct box *b) { return (long)(b->hi[1] - b->lo[1]) * (b->hi[2] - b->lo[2]); }
static inline long box_row(const struct grid *g, const struct box *b, long row)
{
  int nj = b->hi[1] - b->lo[1];
  return grid_at(g, b->lo[0], b->lo[1] + (int)(row % nj), b->lo[2] + (int)(row / nj));
}
static inline int box_length(const struct box *b) { return b->hi[0] - b->lo[0]; }

/** Offsets from a face with normal `axis` to its nodes, offset [4]; returns how many: 2^(dim-1). The faces with that
 * normal around a node lie at the negative offsets. axis = -1: from a cell to its nodes, offset [8]. */
int grid_node_offsets(const struct grid *g, int axis, long *offset);

/** Copies owned values of a cell field with n components per cell into the ghosts of periodic axes. */
void grid_fill_periodic(const struct grid *g, int n, double *field);

#endif
