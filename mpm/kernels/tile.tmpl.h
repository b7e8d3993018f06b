/* A tile of nodes, the stencil of a point in it, and what one point does to one scalar of its nodes. The tile keeps a
 * row of nodes along x for every scalar, so that a row of a stencil is one vector: sums over the nodes of a point run
 * along z, then y, and last over the lanes; what a point gives is built the other way round. theory 3.1 */
#include "mpm/kernels/basis.h"

#if DIM == 2
enum { EDGE = BLOCK_2D + 2 * BLOCK_MARGIN + 3, EDGE_Z = 1, N1_Z = 1 };
#else
enum { EDGE = BLOCK_3D + 2 * BLOCK_MARGIN + 3, EDGE_Z = EDGE, N1_Z = N1 };
#endif
/* rows are padded: four nodes from any on lie within them. LINE: from a row to the next along y */
enum { PITCH = EDGE + ROW_NODES - 1, LINE = LANES * PITCH };

struct tile {
  double at[EDGE_Z][EDGE][LANES][PITCH]; /* [k][j][scalar][i] */
  int    first[3], count[3];             /* lower node; nodes in use: a block at the border of the grid needs fewer */
  bool   at_wall;                        /* some node may be a ghost of a modified wall */
};

/* first node, and for up to four nodes along every axis weights, weights times distance r, derivatives; lengths in h */
struct stencil {
  int  first[3];
  bool folded; /* a wall has changed the weights, and with them their second moment */
  ROW  w[3], wr[3], d[3];
};

/* weights or derivatives where a node beyond a wall is the linear extrapolation of the two inside: q_-1 = 2 q_0 - q_1
 */
static inline ROW fold_ghost(ROW w, int ghost, int inwards)
{
  ROW change = {0};
  change[ghost] = change[ghost + 2 * inwards] = -1;
  change[ghost + inwards] = 2;
  return w + w[ghost] * change;
}

/* modified walls along an axis, T section 3.2, its four types; whether one is near */
static inline bool fold_axis(const struct kernel_grid *kg, int axis, int first, ROW *w, ROW *d)
{
  int  beyond = kg->g.n[axis] + 1 - first; /* place of the upper wall's ghost in the stencil */
  bool low = kg->modified[2 * axis] && first == -1;
  bool high =
      kg->modified[2 * axis + 1] && beyond > 1 && beyond < N1; /* the last; on the wall itself the last but one */
  if (low) *w = fold_ghost(*w, 0, 1), *d = fold_ghost(*d, 0, 1);
  if (high) *w = fold_ghost(*w, beyond, -1), *d = fold_ghost(*d, beyond, -1);
  return low || high;
}

static inline void stencil_at(const struct kernel_grid *kg, bool at_wall, const double *x, struct stencil *s)
{
  ROW     position = ((ROW){x[0], x[1], DIM == 3 ? x[2] : 0, 0} - row_load(kg->low)) * kg->inverse_h;
  ROW     nearest = row_floor(position + SHIFT), a = position - nearest;
  ROW_INT first = __builtin_convertvector(nearest, ROW_INT) + FIRST;
  s->folded = false;
  for (int axis = 0; axis < DIM; axis++) {
    s->first[axis] = first[axis];
    axis_weights(a[axis], kg->half_width[axis] * kg->inverse_h, &s->w[axis], &s->d[axis]);
    if (N1 > 2 && at_wall) s->folded |= fold_axis(kg, axis, first[axis], &s->w[axis], &s->d[axis]);
    s->wr[axis] = s->w[axis] * ((ROW){FIRST, FIRST + 1, FIRST + 2, FIRST + 3} - a[axis]);
  }
#if DIM == 2
  s->first[2] = 0;
  s->w[2] = (ROW){1, 0, 0, 0};
  s->wr[2] = s->d[2] = (ROW){0};
#endif
}

/* nodes that points of the block can reach, all of them in the grid's ghosts at most */
static inline void tile_place(struct tile *t, const struct kernel_grid *kg, const struct kernel_run *run)
{
  t->at_wall = false;
  for (int a = 0; a < 3; a++) {
    t->first[a] = a < DIM ? run->corner[a] - BLOCK_MARGIN - 1 : 0;
    int last = kg->g.n[a] + 2 - t->first[a];
    t->count[a] = a >= DIM ? 1 : last + 1 < EDGE ? last + 1 : EDGE;
    t->at_wall |= a < DIM && ((kg->modified[2 * a] && t->first[a] < 0) || (kg->modified[2 * a + 1] && last < EDGE));
  }
}

/* empties the first n scalars */
static inline void tile_clear(struct tile *t, int n)
{
  for (int k = 0; k < t->count[2]; k++)
    for (int j = 0; j < t->count[1]; j++) memset(t->at[k][j], 0, (size_t)n * sizeof t->at[k][j][0]);
}

/* Empties what stands behind the nodes in use of the first n scalars: a row of a basis of fewer than four nodes reaches
 * there with weights of zero, and zero times what the stack held may be not a number. */
static inline void tile_pad(struct tile *t, int n)
{
  for (int k = 0; k < t->count[2] && ROW_NODES - N1 > 0; k++)
    for (int j = 0; j < t->count[1]; j++)
      for (int q = 0; q < n; q++) memset(&t->at[k][j][q][t->count[0]], 0, (ROW_NODES - 1) * sizeof(double));
}

/* the first scalar at the first node of a stencil; the next scalar stands PITCH further */
static inline double *tile_at(struct tile *t, const struct stencil *s)
{
  return &t->at[s->first[2] - t->first[2]][s->first[1] - t->first[1]][0][s->first[0] - t->first[0]];
}

/* for every row of the tile: node = index in the grid of its first node, row = its scalars, [LANES][PITCH] */
#define FOR_TILE_ROWS(t, g, node, row)                                                                                 \
  for (int k_ = 0; k_ < (t)->count[2]; k_++)                                                                           \
    for (int j_ = 0; j_ < (t)->count[1]; j_++)                                                                         \
      for (long node = grid_at(g, (t)->first[0], (t)->first[1] + j_, (t)->first[2] + k_), once_ = 1; once_; once_ = 0) \
        for (double(*row)[PITCH] = (t)->at[k_][j_]; once_; once_ = 0)

/* adds to the scalar u of a point's nodes: rows along x that go with the weights of the other axes, and along y and z
 * with `slant` (wr or d of the stencil) instead of the weight. 2D has no z */
static inline void tile_add(double *u, const struct stencil *s, const ROW *slant, ROW even, ROW y, ROW z)
{
  for (int k = 0; k < N1_Z; k++) {
    ROW e = s->w[2][k] * even, f = s->w[2][k] * y;
    if (DIM == 3) e += slant[2][k] * z;
    for (int j = 0; j < N1; j++) {
      double *row = u + (k * EDGE + j) * LINE;
      row_store(row, row_load(row) + s->w[1][j] * e + slant[1][j] * f);
    }
  }
}

/* the same for what has no slant */
static inline void tile_add_even(double *u, const struct stencil *s, ROW even)
{
  for (int k = 0; k < N1_Z; k++) {
    ROW e = s->w[2][k] * even;
    for (int j = 0; j < N1; j++) {
      double *row = u + (k * EDGE + j) * LINE;
      row_store(row, row_load(row) + s->w[1][j] * e);
    }
  }
}

/* Sums of a scalar over y and z, rows along x: with the weights of both axes; with wr or d along one of them instead.
 * Along an axis weights add up to one, wr and d to nothing: all is taken relative to node 1, which is next to the
 * point, so that it takes differences where it took products, and a uniform field has no gradient at all. */
struct sums {
  ROW w, ry, dy, rz, dz;
};

/* differences of N1 rows from row 1; step: from a row to the next */
static inline void relative_rows(const double *u, long step, ROW *row)
{
  row[1] = row_load(u + step);
  for (int j = 0; j < N1; j++)
    if (j != 1) row[j] = row_load(u + j * step) - row[1];
}

static inline void tile_sum(const double *u, const struct stencil *s, struct sums *sums)
{
  ROW w[4], r[4], d[4], row[4];
  for (int k = 0; k < N1_Z; k++) {
    relative_rows(u + k * EDGE * LINE, LINE, row);
    w[k] = row[1] + s->w[1][0] * row[0];
    r[k] = s->wr[1][0] * row[0];
    d[k] = s->d[1][0] * row[0];
    for (int j = 2; j < N1; j++) {
      w[k] += s->w[1][j] * row[j];
      r[k] += s->wr[1][j] * row[j];
      d[k] += s->d[1][j] * row[j];
    }
  }
  *sums = (struct sums){w[0], r[0], d[0], {0}, {0}};
#if DIM == 3
  w[0] -= w[1];
  *sums = (struct sums){w[1] + s->w[2][0] * w[0], s->w[2][0] * r[0] + s->w[2][1] * r[1],
                        s->w[2][0] * d[0] + s->w[2][1] * d[1], s->wr[2][0] * w[0], s->d[2][0] * w[0]};
  for (int k = 2; k < N1; k++) {
    w[k] -= w[1];
    sums->w += s->w[2][k] * w[k];
    sums->ry += s->w[2][k] * r[k];
    sums->dy += s->w[2][k] * d[k];
    sums->rz += s->wr[2][k] * w[k];
    sums->dz += s->d[2][k] * w[k];
  }
#endif
}

static inline ROW tile_sum_even(const double *u, const struct stencil *s)
{
  ROW all = {0};
  for (int k = 0; k < N1_Z; k++) {
    ROW w = {0};
    for (int j = 0; j < N1; j++) w += s->w[1][j] * row_load(u + (k * EDGE + j) * LINE);
    all = DIM == 2 ? w : all + s->w[2][k] * w;
  }
  return all;
}
