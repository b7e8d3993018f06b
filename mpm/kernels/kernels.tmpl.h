/* Points to nodes and back for one DIM and one BASIS. Every block works on a tile of node records in L1: a record has
 * LANES scalars, and one row of the tile is handled with whole records, so that the compiler sees vectors.
 * With U the record of a point, the contribution to node (i, j, k) is
 *   w (A0 + r.A) + grad w . G      A0: value, A[d]: its gradient, G[d]: what meets the weight's gradient. theory 3.1 */
#include "core/parallel.h"
#include "mpm/kernels/kernels.h"

#include <math.h>
#include <string.h>

#include "mpm/kernels/basis.h"

#define PASTE_(dim, basis) kernels_##dim##d_##basis
#define PASTE(dim, basis) PASTE_(dim, basis)

#if DIM == 2
enum { EDGE = BLOCK_2D + 2 * BLOCK_MARGIN + 3, EDGE_Z = 1, N1_Z = 1 };
#else
enum { EDGE = BLOCK_3D + 2 * BLOCK_MARGIN + 3, EDGE_Z = EDGE, N1_Z = N1 };
#endif
enum { TILE = EDGE * EDGE * EDGE_Z };

#define SIMD _Pragma("omp simd")

struct tile {
  double record[TILE][LANES];
  int    first[3], count[3]; /* lower node; nodes in use: a block at the border of the grid needs fewer */
};

/* first node, weights, derivatives (1/m) and distances (m) to the nodes along every axis */
struct stencil {
  int    first[3];
  double w[3][4], d[3][4], r[3][4];
};

/* a wall's ghost node is the linear extrapolation of the two nodes inside: q_-1 = 2 q_0 - q_1. T section 3.2, its four
 * types */
static inline void fold_axis(const struct kernel_grid *kg, int axis, int first, double *w, double *d)
{
  int n = kg->g.n[axis], low = -first, high = n - first; /* positions of the wall nodes in the stencil */
  if (kg->modified[2 * axis] && low == 1) {
    w[1] += 2 * w[0];
    w[2] -= w[0];
    d[1] += 2 * d[0];
    d[2] -= d[0];
    w[0] = d[0] = 0;
  }
  if (kg->modified[2 * axis + 1] && high > 0 && high < N1 - 1) { /* N1 - 2, or on the wall itself one less */
    w[high] += 2 * w[high + 1];
    w[high - 1] -= w[high + 1];
    d[high] += 2 * d[high + 1];
    d[high - 1] -= d[high + 1];
    w[high + 1] = d[high + 1] = 0;
  }
}

static inline void stencil_at(const struct kernel_grid *kg, const double *x, struct stencil *s)
{
  double h = kg->g.h, inverse_h = 1 / h;
  for (int a = 0; a < DIM; a++) {
    double position = (x[a] - kg->g.min[a]) * inverse_h;
    s->first[a] = axis_weights(position, kg->half_width[a] * inverse_h, s->w[a], s->d[a]);
    if (N1 > 2) fold_axis(kg, a, s->first[a], s->w[a], s->d[a]);
    for (int i = 0; i < N1; i++) {
      s->d[a][i] *= inverse_h;
      s->r[a][i] = (s->first[a] + i - position) * h;
    }
  }
#if DIM == 2
  s->first[2] = 0;
  s->w[2][0] = 1;
  s->d[2][0] = s->r[2][0] = 0;
#endif
}

/* nodes that points of the block can reach, all of them in the grid's ghosts at most; their records are emptied */
static inline void tile_open(struct tile *t, const struct kernel_grid *kg, const struct kernel_run *run)
{
  for (int a = 0; a < 3; a++) {
    t->first[a] = a < DIM ? run->corner[a] - BLOCK_MARGIN - 1 : 0;
    int last = kg->g.n[a] + 2 - t->first[a];
    t->count[a] = a >= DIM ? 1 : last + 1 < EDGE ? last + 1 : EDGE;
  }
  for (int k = 0; k < t->count[2]; k++)
    for (int j = 0; j < t->count[1]; j++)
      memset(t->record[((long)k * EDGE + j) * EDGE], 0, (size_t)t->count[0] * sizeof *t->record);
}

static inline long tile_index(const struct tile *t, int i, int j, int k)
{
  return ((long)(k - t->first[2]) * EDGE + j - t->first[1]) * EDGE + i - t->first[0];
}

/* for every node of the tile: node = its index in the grid, r = its record */
#define FOR_TILE(t, g, node, r)                                                                                        \
  for (int k_ = 0; k_ < (t)->count[2]; k_++)                                                                           \
    for (int j_ = 0; j_ < (t)->count[1]; j_++)                                                                         \
      for (long r = ((long)k_ * EDGE + j_) * EDGE, end_ = r + (t)->count[0],                                           \
                node = grid_at(g, (t)->first[0], (t)->first[1] + j_, (t)->first[2] + k_);                              \
           r < end_; r++, node++)

/* adds one point: A0 [LANES], A [DIM][LANES], G [DIM][LANES] */
static inline void tile_add(struct tile *t, const struct stencil *s, const double *A0, double A[DIM][LANES],
                            double G[DIM][LANES])
{
  for (int k = 0; k < N1_Z; k++)
    for (int j = 0; j < N1; j++) {
      double wjk = s->w[1][j] * s->w[2][k], dj = s->d[1][j] * s->w[2][k], value[LANES], slope[LANES], push[LANES];
#if DIM == 3
      double dk = s->w[1][j] * s->d[2][k];
#endif
      SIMD for (int q = 0; q < LANES; q++)
      {
        double v = A0[q] + s->r[1][j] * A[1][q], g = dj * G[1][q];
#if DIM == 3
        v += s->r[2][k] * A[2][q];
        g += dk * G[2][q];
#endif
        value[q] = wjk * v + g;
        slope[q] = wjk * A[0][q];
        push[q] = wjk * G[0][q];
      }
      double(*row)[LANES] = t->record + tile_index(t, s->first[0], s->first[1] + j, s->first[2] + k);
      for (int i = 0; i < N1; i++) {
        double w = s->w[0][i], wr = w * s->r[0][i], d = s->d[0][i];
        SIMD for (int q = 0; q < LANES; q++) row[i][q] += w * value[q] + wr * slope[q] + d * push[q];
      }
    }
}

/* the same for values alone, most scatters */
static inline void tile_add_values(struct tile *t, const struct stencil *s, const double *A0)
{
  for (int k = 0; k < N1_Z; k++)
    for (int j = 0; j < N1; j++) {
      double wjk = s->w[1][j] * s->w[2][k];
      double(*row)[LANES] = t->record + tile_index(t, s->first[0], s->first[1] + j, s->first[2] + k);
      for (int i = 0; i < N1; i++) {
        double w = wjk * s->w[0][i];
        SIMD for (int q = 0; q < LANES; q++) row[i][q] += w * A0[q];
      }
    }
}

/* sums over the nodes of a point: S0 = sum w u, R[a] = sum w r_a u, D[a] = sum dw/dx_a u */
static inline void tile_gather(const struct tile *t, const struct stencil *s, double *S0, double R[DIM][LANES],
                               double D[DIM][LANES])
{
  memset(S0, 0, LANES * sizeof *S0);
  memset(R, 0, DIM * sizeof *R);
  memset(D, 0, DIM * sizeof *D);
  for (int k = 0; k < N1_Z; k++)
    for (int j = 0; j < N1; j++) {
      const double(*row)[LANES] = t->record + tile_index(t, s->first[0], s->first[1] + j, s->first[2] + k);
      double a0[LANES] = {0}, a1[LANES] = {0}, a2[LANES] = {0};
      for (int i = 0; i < N1; i++) {
        double w = s->w[0][i], wr = w * s->r[0][i], d = s->d[0][i];
        SIMD for (int q = 0; q < LANES; q++)
        {
          a0[q] += w * row[i][q];
          a1[q] += wr * row[i][q];
          a2[q] += d * row[i][q];
        }
      }
      double wjk = s->w[1][j] * s->w[2][k], rj = wjk * s->r[1][j], dj = s->d[1][j] * s->w[2][k];
#if DIM == 3
      double rk = wjk * s->r[2][k], dk = s->w[1][j] * s->d[2][k];
#endif
      SIMD for (int q = 0; q < LANES; q++)
      {
        S0[q] += wjk * a0[q];
        R[0][q] += wjk * a1[q];
        R[1][q] += rj * a0[q];
        D[0][q] += wjk * a2[q];
        D[1][q] += dj * a0[q];
#if DIM == 3
        R[2][q] += rk * a0[q];
        D[2][q] += dk * a0[q];
#endif
      }
    }
}

/* column a of the symmetric stress, DIM rows; SYM[i][j] = place in xx yy zz xy yz xz */
static const int SYM[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

/* record of a point: lane 0 mass, 1..DIM momentum, DIM+1..2 DIM force */
static inline void p2g_record(const struct p2g_args *a, long p, double *A0, double A[DIM][LANES], double G[DIM][LANES])
{
  double m = a->mass[p];
  A0[0] = m;
  for (int d = 0; d < DIM; d++) {
    A0[1 + d] = m * a->vel[p * DIM + d];
    if (a->affine)
      for (int e = 0; e < DIM; e++) A[e][1 + d] = m * a->affine[(p * DIM + d) * DIM + e];
    if (a->stress)
      for (int e = 0; e < DIM; e++) G[e][1 + DIM + d] = -a->volume[p] * a->stress[p * 6 + SYM[d][e]];
    if (a->pressure) G[d][1 + DIM + d] = a->volume[p] * a->pressure[p];
  }
}

static void p2g(const struct kernel_grid *kg, const struct kernel_run *run, const struct p2g_args *a)
{
  struct tile    t;
  struct stencil s;
  double         A0[LANES] = {0}, A[DIM][LANES] = {{0}}, G[DIM][LANES] = {{0}};
  tile_open(&t, kg, run);
  for (long p = run->begin; p < run->end; p++) {
    stencil_at(kg, a->x + p * DIM, &s);
    p2g_record(a, p, A0, A, G);
    tile_add(&t, &s, A0, A, G);
  }
  FOR_TILE(&t, &kg->g, node, r)
  {
    if (a->mass_nc) a->mass_nc[node] += t.record[r][0];
    for (int d = 0; d < DIM; d++) {
      a->mom_nc[node * DIM + d] += t.record[r][1 + d];
      if (a->force_nc) a->force_nc[node * DIM + d] += t.record[r][1 + DIM + d];
    }
  }
}

/* second moment of the weights along an axis, m2: D of T(28); near a modified wall it shrinks */
static inline double axis_moment(const struct stencil *s, int axis)
{
  double m = 0;
  for (int i = 0; i < N1; i++) m += s->w[axis][i] * s->r[axis][i] * s->r[axis][i];
  return m;
}

/* affine velocity matrix B D^-1, T(28) with the point's own D; the velocity gradient where D vanishes at a wall */
static inline void affine_matrix(const struct kernel_grid *kg, const struct stencil *s, double R[DIM][LANES],
                                 double D[DIM][LANES], double *C)
{
  for (int e = 0; e < DIM; e++) {
    double m = axis_moment(s, e);
    bool   wide = m > 0.05 * kg->g.h * kg->g.h;
    for (int d = 0; d < DIM; d++) C[d * DIM + e] = wide ? R[e][d] / m : D[e][d];
  }
}

static inline void g2p_point(const struct kernel_grid *kg, const struct g2p_args *a, const struct tile *t, long p)
{
  struct stencil s;
  double         S0[LANES], R[DIM][LANES], D[DIM][LANES];
  stencil_at(kg, a->x + p * DIM, &s);
  tile_gather(t, &s, S0, R, D);
  for (int d = 0; d < DIM; d++) {
    a->vel[p * DIM + d] = a->beta * S0[d] + (1 - a->beta) * (a->vel[p * DIM + d] + S0[DIM + d]);
    a->x[p * DIM + d] += a->dt * S0[d];
    if (a->displacement) a->displacement[p * DIM + d] += a->dt * S0[d];
    if (a->gradv)
      for (int e = 0; e < DIM; e++) a->gradv[(p * DIM + d) * DIM + e] = D[e][d];
  }
  if (a->affine) affine_matrix(kg, &s, R, D, a->affine + p * DIM * DIM);
}

/* lanes 0..DIM-1 new velocity, DIM..2 DIM-1 its change */
static void g2p(const struct kernel_grid *kg, const struct kernel_run *run, const struct g2p_args *a)
{
  struct tile t;
  tile_open(&t, kg, run);
  FOR_TILE(&t, &kg->g, node, r)
  for (int d = 0; d < DIM; d++) {
    t.record[r][d] = a->vel_nc[node * DIM + d];
    t.record[r][DIM + d] = a->vel_nc[node * DIM + d] - a->vel_old_nc[node * DIM + d];
  }
  for (long p = run->begin; p < run->end; p++) g2p_point(kg, a, &t, p);
}

/* scalars of point p, and whether any has a gradient */
static inline bool scatter_record(const struct scatter_args *a, long p, double *A0, double A[DIM][LANES])
{
  double weight = a->weight ? a->weight[p] : 1;
  bool   sloped = false;
  for (int q = 0; q < a->n; q++) {
    A0[q] = weight * (a->value[q] ? a->value[q][p] : 1);
    if (!a->gradient[q]) continue;
    sloped = true;
    for (int e = 0; e < DIM; e++) A[e][q] = weight * a->gradient[q][p * DIM + e];
  }
  return sloped;
}

static void scatter(const struct kernel_grid *kg, const struct kernel_run *run, const struct scatter_args *a)
{
  struct tile    t;
  struct stencil s;
  double         A0[LANES] = {0}, A[DIM][LANES] = {{0}}, G[DIM][LANES] = {{0}};
  tile_open(&t, kg, run);
  for (long p = run->begin; p < run->end; p++) {
    stencil_at(kg, a->x + p * DIM, &s);
    if (scatter_record(a, p, A0, A))
      tile_add(&t, &s, A0, A, G);
    else
      tile_add_values(&t, &s, A0);
  }
  for (int q = 0; q < a->n; q++) {
    double factor = a->factor[q] != 0 ? a->factor[q] : 1;
    FOR_TILE(&t, &kg->g, node, r) a->node[q][node] += factor * t.record[r][q];
  }
}

static void gather(const struct kernel_grid *kg, const struct kernel_run *run, const struct gather_args *a)
{
  struct tile    t;
  struct stencil s;
  double         S0[LANES], R[DIM][LANES], D[DIM][LANES];
  long           step = a->gradient_stride ? a->gradient_stride : DIM;
  tile_open(&t, kg, run);
  FOR_TILE(&t, &kg->g, node, r)
  for (int q = 0; q < a->n; q++) t.record[r][q] = a->node[q][node * (a->stride[q] ? a->stride[q] : 1)];
  for (long p = run->begin; p < run->end; p++) {
    stencil_at(kg, a->x + p * DIM, &s);
    tile_gather(&t, &s, S0, R, D);
    for (int q = 0; q < a->n; q++) {
      if (a->value[q]) a->value[q][p] = S0[q];
      for (int e = 0; e < DIM && a->gradient[q]; e++) a->gradient[q][p * step + e] = D[e][q];
    }
  }
}

static void weights(const struct kernel_grid *kg, const double *x, long *node, double *w, double (*gradient)[3])
{
  struct stencil s;
  stencil_at(kg, x, &s);
  for (int k = 0, q = 0; k < N1_Z; k++)
    for (int j = 0; j < N1; j++)
      for (int i = 0; i < N1; i++, q++) {
        node[q] = grid_at(&kg->g, s.first[0] + i, s.first[1] + j, s.first[2] + k);
        w[q] = s.w[0][i] * s.w[1][j] * s.w[2][k];
        if (!gradient) continue;
        gradient[q][0] = s.d[0][i] * s.w[1][j] * s.w[2][k];
        gradient[q][1] = s.w[0][i] * s.d[1][j] * s.w[2][k];
        gradient[q][2] = s.w[0][i] * s.w[1][j] * s.d[2][k];
      }
}

extern const struct kernels PASTE(DIM, BASIS);
const struct kernels        PASTE(DIM, BASIS) = {
           .dim = DIM,
           .basis = BASIS_ENUM,
           .moment = moment,
           .n_support = N1 * N1 * N1_Z,
           .p2g = p2g,
           .g2p = g2p,
           .scatter = scatter,
           .gather = gather,
           .weights = weights,
};
