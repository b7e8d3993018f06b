/* The serial loops between points and nodes, compiled once for every dimension and basis. theory 3 */
#ifndef MPM_KERNELS_H
#define MPM_KERNELS_H

#include "core/grid.h"
#include "core/points.h"
#include "core/scene.h"

/* What all kernels need to know of the grid. */
struct kernel_grid {
  struct grid g;
  double      low[4];          /* m: grid.min, and 0 */
  double      inverse_h;       /* 1/m */
  double      half_width[3];   /* m, GIMP: half a point's width */
  bool        modified[SIDES]; /* boundary-modified splines at this wall: ghost weights are folded into the basis */
};

/* Points [begin, end) of one block; corner: lower cell of the block; index: number of the run in the set. */
struct kernel_run {
  long begin, end, index;
  int  corner[3];
};

/* Points to nodes. x, vel [n][DIM]; affine [n][DIM][DIM] or NULL; mass, volume [n]; stress [n][6] Pa or NULL;
 * pressure [n] Pa or NULL (compression positive); adds to mass_nc [size] kg, mom_nc, force_nc [size][DIM] (NULL: not
 * wanted). */
struct p2g_args {
  const double *x, *vel, *affine, *mass, *volume, *stress, *pressure;
  double       *mass_nc, *mom_nc, *force_nc;
};

enum { POINT_BATCH = 64 };

/* Nodes to points. vel_old_nc, vel_nc [size][DIM]; beta: share of the nodal velocity, T(30); moves x, displacement
 * (NULL: not wanted) by the nodal velocity; affine, gradv [n][DIM][DIM], gradv 1/s row i column j = dv_i/dx_j; NULL:
 * not wanted. strain (NULL: not wanted) is called with the gradients of every n <= POINT_BATCH points from p on while
 * they are in L1. */
struct g2p_args {
  double        dt, beta;
  const double *vel_old_nc, *vel_nc;
  double       *x, *displacement, *vel, *affine, *gradv;
  void (*strain)(void *context, long p, int n, const double *gradv);
  void *context;
};

enum { LANES = 8 }; /* scalars that one call of scatter or gather can carry */

/* Scalars of points to nodes: node[q] += factor[q] sum weight [w (value[q] + gradient[q].(x_i - x_p)) + grad
 * w.flux[q]]. value[q] [n] (NULL: one); gradient[q], flux[q] [n][DIM] or NULL; weight [n] or NULL; factor 0 counts as
 * 1; node[q] [size]. */
struct scatter_args {
  int           n;
  double        factor[LANES];
  const double *x, *weight, *value[LANES], *gradient[LANES], *flux[LANES];
  double       *node[LANES];
};

/* Scalars of nodes to points: value[q] [n] = sum w node; gradient[q] [n][DIM] = sum grad w node; NULL: not wanted.
 * node[q] is read at node*stride[q] (0 counts as 1), so components of vectors can be gathered; a point's gradient is
 * written at point*gradient_stride (0 counts as DIM), so it can be a row of a matrix. */
struct gather_args {
  int           n;
  const double *x, *node[LANES];
  int           stride[LANES], gradient_stride;
  double       *value[LANES], *gradient[LANES];
};

struct kernels {
  int        dim;
  enum basis basis;
  double     moment;    /* D of T(28) in the interior, in h2; 0: C is the velocity gradient (linear, GIMP) */
  int        n_support; /* nodes that weights() writes */
  void (*p2g)(const struct kernel_grid *, const struct kernel_run *, const struct p2g_args *);
  void (*g2p)(const struct kernel_grid *, const struct kernel_run *, const struct g2p_args *);
  void (*scatter)(const struct kernel_grid *, const struct kernel_run *, const struct scatter_args *);
  void (*gather)(const struct kernel_grid *, const struct kernel_run *, const struct gather_args *);
  /** Nodes and weights of the place x [DIM] m; gradient [n_support][3] 1/m or NULL. */
  void (*weights)(const struct kernel_grid *, const double *x, long *node, double *w, double (*gradient)[3]);
};

enum { MAX_SUPPORT = 64 };

const struct kernels *kernels_find(int dim, enum basis basis);

/** Fills a kernel_grid from the scene; sides that are walls get modified splines if the scene asks for them. */
void kernel_grid_create(const struct grid *g, const struct numerics *numerics, const struct side_condition *sides,
                        struct kernel_grid *kg);

/** Calls kernel(kg, run, args) for every block, blocks of one colour in parallel. groups: which groups of points. */
#define FOR_RUNS(points, grid, run, group)                                                                             \
  for (int colour_ = 0; colour_ < points_colours(grid); colour_++)                                                     \
  PARALLEL_FOR_DYNAMIC for (long i_ = 0; i_ < kernels_blocks_of_colour(points, (grid)->dim, colour_); i_++)            \
      FOR_GROUPS(points, points_block_of_colour(points, (grid)->dim, colour_, i_), run, group)

/** The same for kernels that write nothing to nodes: all blocks at once. */
#define FOR_RUNS_READING(points, run, group)                                                                           \
  PARALLEL_FOR_DYNAMIC for (long i_ = 0; i_ < (points)->n_blocks; i_++) FOR_GROUPS(points, i_, run, group)

#define FOR_GROUPS(points, block, run, group)                                                                          \
  for (int group = 0; group < (points)->n_groups; group++)                                                             \
    for (struct kernel_run run = kernels_run(points, block, group); run.begin < run.end; run.begin = run.end)

long              kernels_blocks_of_colour(const struct points *p, int dim, int colour);
struct kernel_run kernels_run(const struct points *p, long block, int group);

#endif
