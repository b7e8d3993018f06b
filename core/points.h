/* A set of material points as arrays, sorted by block of cells and, inside a block, by group (material). The arrays
 * themselves are fields of the modules; this keeps their order. */
#ifndef CORE_POINTS_H
#define CORE_POINTS_H

#include "core/field.h"
#include "core/grid.h"
#include "core/status.h"

/* the last entry of a count is not a sorted set: markers are few */
enum point_set { SET_SOLID, SET_WATER, N_SETS, COUNT_MARKERS = N_SETS, N_COUNTS };

/* Cells per block edge. A point may wander one cell out of its block before the set is sorted again; blocks of one
 * colour (every second one along each axis) then still write to different nodes. */
enum { BLOCK_2D = 8, BLOCK_3D = 5, BLOCK_MARGIN = 1 };

struct points {
  long           n;
  int            n_groups;
  unsigned char *group; /* [n] */
  int            block_edge, blocks[3];
  long           n_blocks, n_runs; /* run = (block, group) */
  long          *start; /* [n_runs + 1]: run r = block*n_groups + group holds points [start[r], start[r+1]) */
  /* scratch of the sort */
  long   *order, *key, *count;
  double *shelf;
};

enum status points_create(const struct grid *g, long n, int n_groups, int max_components,
                          struct points **points) MUST_CHECK;
void        points_destroy(struct points **points);
/** Lower corner cell of a block. */
void points_block_corner(const struct points *p, long block, int corner[3]);
/** Number of colours (4 or 8) and the blocks of one: block index of the i-th block of `colour`, -1 past the last. */
int  points_colours(const struct grid *g);
long points_block_of_colour(const struct points *p, int dim, int colour, long i);
/** Points that left a periodic axis come back at its other end. x [n][dim] m. */
void points_wrap(const struct grid *g, long n, double *x);
/** Whether some point has left its block by more than the margin. x [n][dim] m. */
bool points_need_sort(const struct grid *g, const struct points *p, const double *x);
/** Whether a place lies in the grid, its ends included. x [dim] m. */
bool points_inside(const struct grid *g, const double *x);
/** From now on the set holds only the points inside the grid, in their order; then points_permute every array and
 * points_sorted, and sort the set. */
void points_keep_inside(const struct grid *g, struct points *p, const double *x);
/** Computes the new order; then points_permute every array. Points outside the grid: ERR_DIVERGED. */
enum status points_sort(const struct grid *g, struct points *p, const double *x) MUST_CHECK;
/** Brings one array [n][components] into the order of the last sort. */
void points_permute(struct points *p, int components, double *array);
/** Brings every STATE field of a table that lives at `at` into that order; a NULL field is not planned. */
void points_permute_fields(struct points *p, const struct scene *scene, enum where at, const struct field *fields,
                           int n_fields, void *state);
/** To be called after the last points_permute of a sort: the groups follow. */
void points_sorted(struct points *p);

#endif
