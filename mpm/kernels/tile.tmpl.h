/* A tile of nodes, the stencil of a point in it, and what one point does to one scalar of its nodes. The tile keeps a
 * row of nodes along x for every scalar, so that a row of a stencil is one vector: sums over the nodes of a point run
 * along z, then y, and last over the lanes; what a point gives is built the other way round. theory 3.1 */
#include "mpm/kernels/basis.h"

#if DIM == 2
enum { EDGE = BLOCK_2D + 2 * BLOCK_MARGIN + 3, EDGE_Z = 1, N1_Z = 1 };
#else
enum { EDGE = BLOCK_3D + 2 * BLOCK_MARGIN + 3, EDGE_Z = EDGE, N1_Z = N1 };
#endif
/* Rows are padded: four nodes from any on lie within PITCH. The nodes of points that have not left the block start
 * where a cache line does, LEAD doubles further the margin before them; in 3D they fill one line. LINE: from a row to
 * the next along y. */
enum { CACHE_LINE = 8, PITCH = 16, LEAD = DIM == 2 ? 0 : CACHE_LINE - BLOCK_MARGIN, LINE = LANES * PITCH };
_Static_assert(EDGE + ROW_NODES - 1 <= PITCH, "a row of the tile holds the nodes of a block and its margin");

struct tile {
  _Alignas(64) double at[EDGE_Z * EDGE * LINE + CACHE_LINE]; /* [k][j][scalar][i], from LEAD on */
  int  origin[3];                                            /* node whose place is [0][0][0] */
  int  first[3], count[3]; /* nodes in use: those of points inside the block, or of those in its margin too */
  bool at_wall;            /* some may be a ghost of a modified wall */
};

/* Where so many points lie is found before the first of them is used: finding it is a chain of operations that wait for
 * one another, those of several points go side by side. */
enum { TEAM = 8 };

/* of every point and axis the first node of its stencil, and how far in h it is beyond the node that the basis starts
 * from (basis.h) */
struct places {
  int    first[TEAM * DIM];
  double a[TEAM * DIM];
};

/* for up to four nodes along every axis weights, weights times distance r, derivatives; lengths in h */
struct stencil {
  int    first[3];
  bool   folded; /* a wall has changed the weights, and with them their second moment */
  double r[3];   /* of the first node */
  ROW    w[DIM], wr[DIM], d[DIM];
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

/* low [TEAM][DIM]: lower corner of the grid, again and again */
static inline void find_places(const struct kernel_grid *kg, const double *low, int n, const double *x,
                               struct places *places)
{
  double inverse_h = kg->inverse_h;
  for (int q = 0; q < n * DIM; q++) {
    double position = (x[q] - low[q]) * inverse_h, nearest = floor(position + SHIFT);
    places->a[q] = position - nearest;
    places->first[q] = (int)nearest + FIRST;
  }
}

/* of point i of the team */
static inline void find_stencil(const struct kernel_grid *kg, bool at_wall, const struct places *places, int i,
                                struct stencil *s)
{
  bool folded = false;
  s->first[2] = 0;
  for (int axis = 0; axis < DIM; axis++) {
    int    first = places->first[i * DIM + axis];
    double a = places->a[i * DIM + axis];
    ROW    w, d;
    axis_weights(a, kg->half_width[axis] * kg->inverse_h, &w, &d);
    if (N1 > 2 && at_wall) folded |= fold_axis(kg, axis, first, &w, &d);
    s->first[axis] = first;
    s->r[axis] = FIRST - a;
    s->w[axis] = w;
    s->d[axis] = d;
    s->wr[axis] = w * ((ROW){FIRST, FIRST + 1, FIRST + 2, FIRST + 3} - a);
  }
  s->folded = folded;
}

static inline void stencil_at(const struct kernel_grid *kg, bool at_wall, const double *x, struct stencil *s)
{
  struct places place;
  find_places(kg, kg->low, 1, x, &place);
  find_stencil(kg, at_wall, &place, 0, s);
}

/* nodes of points up to `margin` cells outside the block; of the ghosts one layer, the only one that holds something */
static inline void tile_reach(struct tile *t, const struct kernel_grid *kg, int margin)
{
  for (int a = 0; a < 3; a++) {
    t->first[a] = a < DIM ? t->origin[a] + BLOCK_MARGIN - margin : 0;
    int edge = EDGE - 2 * (BLOCK_MARGIN - margin), last = kg->g.n[a] + 1 - t->first[a];
    t->count[a] = a >= DIM ? 1 : last + 1 < edge ? last + 1 : edge;
  }
}

/* a tile for points that have not left their block, in 2D for all */
static inline void tile_place(struct tile *t, const struct kernel_grid *kg, const struct kernel_run *run)
{
  t->at_wall = false;
  for (int a = 0; a < 3; a++) {
    t->origin[a] = a < DIM ? run->corner[a] - BLOCK_MARGIN - 1 : 0;
    t->at_wall |= a < DIM && ((kg->modified[2 * a] && t->origin[a] < 0) ||
                              (kg->modified[2 * a + 1] && t->origin[a] + EDGE > kg->g.n[a]));
  }
  tile_reach(t, kg, DIM == 2 ? BLOCK_MARGIN : 0);
}

/* Whether no place in the tile is negative, from either end. In 2D a tile is small and has its margin from the start.
 */
static inline bool tile_holds(const struct tile *t, const struct stencil *s)
{
  if (DIM == 2) return true;
  int places = 0; /* their sign bits together */
  for (int a = 0; a < DIM; a++) places |= (s->first[a] - t->first[a]) | (t->first[a] + t->count[a] - N1 - s->first[a]);
  return places >= 0;
}

/* the scalars of a row of nodes from (i, j, k) on, [LANES][PITCH] */
static inline double (*tile_row(struct tile *t, int i, int j, int k))[PITCH]
{
  return (double(*)[PITCH])(t->at + LEAD + ((k - t->origin[2]) * EDGE + j - t->origin[1]) * LINE + i - t->origin[0]);
}

/* for every row of the nodes in use: row = its scalars */
#define FOR_TILE_ROWS(t, j, k, row)                                                                                    \
  for (int k = (t)->first[2]; k < (t)->first[2] + (t)->count[2]; k++)                                                  \
    for (int j = (t)->first[1]; j < (t)->first[1] + (t)->count[1]; j++)                                                \
      for (double(*row)[PITCH] = tile_row(t, (t)->first[0], j, k), (*once_)[PITCH] = row; once_; once_ = NULL)

/* empties the first n scalars: in 2D whole rows, which follow one another */
static inline void tile_clear(struct tile *t, int n)
{
  FOR_TILE_ROWS(t, j, k, row)
  for (int q = 0; q < n; q++)
    if (DIM == 2)
      memset(row[q], 0, sizeof row[q]);
    else
      for (int i = 0; i < t->count[0] + ROW_NODES - N1; i += ROW_NODES) row_store(row[q] + i, (ROW){0});
}

/* Empties what stands behind the nodes in use of the first n scalars: a row of a basis of fewer than four nodes reaches
 * there with weights of zero, and zero times what the stack held may be not a number. */
static inline void tile_pad(struct tile *t, int n)
{
  FOR_TILE_ROWS(t, j, k, row)
  for (int q = 0; q < n && ROW_NODES - N1 > 0; q++) memset(row[q] + t->count[0], 0, (ROW_NODES - N1) * sizeof(double));
}

/* the first scalar at the first node of a stencil; the next scalar stands PITCH further */
static inline double *tile_at(struct tile *t, const struct stencil *s)
{
  return *tile_row(t, s->first[0], s->first[1], s->first[2]);
}

/* a row times the weight of layer k along z */
static inline ROW along_z(const ROW *w, int k, ROW row) { return DIM == 2 ? row : w[DIM - 1][k] * row; }

/* the N1 rows along y of a scalar */
static inline void rows_load(const double *u, ROW *row)
{
  for (int j = 0; j < N1; j++) row[j] = row_load(u + j * LINE);
}

static inline void rows_store(double *u, const ROW *row)
{
  for (int j = 0; j < N1; j++) row_store(u + j * LINE, row[j]);
}

/* adds to the scalar u of a point's nodes: rows along x that go with the weights of the other axes, and along y and z
 * with `slant` (wr or d of the stencil) instead of the weight. 2D has no z */
static inline void tile_add(double *u, const struct stencil *s, const ROW *slant, ROW even, ROW y, ROW z)
{
  for (int k = 0; k < N1_Z; k++) {
    ROW e = along_z(s->w, k, even), f = along_z(s->w, k, y);
    if (DIM == 3) e += along_z(slant, k, z);
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
    ROW e = along_z(s->w, k, even);
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
    all = DIM == 2 ? w : all + along_z(s->w, k, w);
  }
  return all;
}
