/* Points to nodes and back for one DIM and one BASIS. Every block works on a tile of nodes in L1. theory 3.1 */
#include "core/parallel.h"
#include "mpm/kernels/kernels.h"

#include <math.h>
#include <string.h>

#include "mpm/kernels/tile.tmpl.h"

/* a point has strayed from the block: the tile gets its margin */
#define RARE __attribute__((noinline, cold))

#define PASTE_(dim, basis) kernels_##dim##d_##basis
#define PASTE(dim, basis) PASTE_(dim, basis)

/* places in xx yy zz xy yz xz of a row of the symmetric stress */
static const int SYM[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

/* stress less pressure */
static inline const double *total_stress(const struct p2g_args *a, long p, double own[6])
{
  if (!a->pressure) return a->stress + p * 6;
  for (int q = 0; q < 6; q++) own[q] = (a->stress ? a->stress[p * 6 + q] : 0) - (q < 3 ? a->pressure[p] : 0);
  return own;
}

/* What a point gives to its nodes, as rows along x. Momentum w m (v + C r) is momentum[.][0] in the row of lowest y and
 * z and grows by [1] and [2] from a row to the next along y and z, times the weights of y and z. Force -V stress grad w
 * takes the slope in place of the weight along y in [1], along z in [2]. */
struct gift {
  double *at; /* in the tile: its first node's first scalar */
  ROW     mass, momentum[DIM][DIM], force[DIM][DIM];
  ROW     w[DIM], d[DIM];       /* of its stencil along y and z, from [1] on */
  double  yz[N1_Z * ROW_NODES]; /* products of the weights of y and z */
};

/* h in m */
static inline void offer_momentum(const struct p2g_args *a, double h, const struct stencil *s, long p, struct gift *g)
{
  ROW w = a->mass[p] * s->w[0], wh = h * w, wr = (a->mass[p] * h) * s->wr[0];
  g->mass = w;
  for (int k = 0; k < N1_Z; k++) row_store(g->yz + k * ROW_NODES, along_z(s->w, k, s->w[1]));
  for (int d = 0; d < DIM; d++) {
    const double *C = a->affine + (p * DIM + d) * DIM;
    ROW           momentum = a->vel[p * DIM + d] * w;
    for (int e = 1; e < DIM; e++) g->momentum[d][e] = a->affine ? C[e] * wh : (ROW){0};
    if (a->affine) momentum += C[0] * wr;
    for (int e = 1; e < DIM; e++) momentum += s->r[e] * g->momentum[d][e];
    g->momentum[d][0] = momentum;
  }
}

/* inverse_h in 1/m */
static inline void offer_force(const struct p2g_args *a, double inverse_h, const struct stencil *s, long p,
                               struct gift *g)
{
  double        own[6];
  const double *S = total_stress(a, p, own);
  double        factor = -a->volume[p] * inverse_h;
  ROW           w = factor * s->w[0], slope = factor * s->d[0];
  for (int e = 1; e < DIM; e++) g->w[e] = s->w[e], g->d[e] = s->d[e];
  for (int d = 0; d < DIM; d++)
    for (int e = 0; e < DIM; e++) g->force[d][e] = S[SYM[d][e]] * (e == 0 ? slope : w);
}

/* Mass and momentum of n points of one cell: rows of nodes stay in registers meanwhile. u: the first node in the tile
 */
static inline void give_momentum(double *u, const struct gift *gift, int n)
{
  for (int k = 0; k < N1_Z; k++, u += EDGE * LINE) {
    ROW row[1 + DIM][N1];
    for (int q = 0; q < 1 + DIM; q++) rows_load(u + q * PITCH, row[q]);
    for (const struct gift *g = gift; g < gift + n; g++) {
      const double *w = g->yz + k * ROW_NODES;
      for (int j = 0; j < N1; j++) row[0][j] += w[j] * g->mass;
#pragma GCC unroll 3
      for (int d = 0; d < DIM; d++) {
        ROW now = g->momentum[d][0], y = g->momentum[d][1];
        if (k > 0) now += (double)k * g->momentum[d][DIM - 1];
        for (int j = 0; j < N1; j++, now += y) row[1 + d][j] += w[j] * now;
      }
    }
    for (int q = 0; q < 1 + DIM; q++) rows_store(u + q * PITCH, row[q]);
  }
}

/* their force; u: its first scalar there */
static inline void give_force(double *u, const struct gift *gift, int n)
{
  for (int k = 0; k < N1_Z; k++, u += EDGE * LINE) {
    ROW row[DIM][N1];
    for (int q = 0; q < DIM; q++) rows_load(u + q * PITCH, row[q]);
    for (const struct gift *g = gift; g < gift + n; g++) {
#pragma GCC unroll 3
      for (int d = 0; d < DIM; d++) {
        ROW even = along_z(g->w, k, g->force[d][0]), y = along_z(g->w, k, g->force[d][1]);
        if (DIM == 3) even += along_z(g->d, k, g->force[d][DIM - 1]);
        for (int j = 0; j < N1; j++) row[d][j] += g->w[1][j] * even + g->d[1][j] * y;
      }
    }
    for (int q = 0; q < DIM; q++) rows_store(u + q * PITCH, row[q]);
  }
}

/* adds `components` scalars of a row of n nodes; node [n][components] */
static inline void add_row(int components, int n, double (*restrict row)[PITCH], double *restrict node)
{
  for (int i = 0; i < n; i++)
    for (int d = 0; d < components; d++) node[i * components + d] += row[d][i];
}

static void p2g_close(const struct kernel_grid *kg, const struct p2g_args *a, struct tile *t)
{
  FOR_TILE_ROWS(t, j, k, row)
  {
    long node = grid_at(&kg->g, t->first[0], j, k);
    if (a->mass_nc) add_row(1, t->count[0], row, a->mass_nc + node);
    add_row(DIM, t->count[0], row + 1, a->mom_nc + node * DIM);
    if (a->force_nc) add_row(DIM, t->count[0], row + 1 + DIM, a->force_nc + node * DIM);
  }
}

static RARE void p2g_widen(const struct kernel_grid *kg, const struct p2g_args *a, struct tile *t)
{
  p2g_close(kg, a, t);
  tile_reach(t, kg, BLOCK_MARGIN);
  tile_clear(t, 1 + 2 * DIM);
}

/* n <= TEAM points from p on */
static inline void p2g_team(const struct kernel_grid *kg, const struct p2g_args *a, struct tile *t, const double *low,
                            long p, int n)
{
  struct places places;
  struct gift   gift[TEAM];
  bool          force = a->stress || a->pressure;
  find_places(kg, low, n, a->x + p * DIM, &places);
  for (int i = 0; i < n; i++) {
    struct stencil s;
    find_stencil(kg, t->at_wall, &places, i, &s);
    if (!tile_holds(t, &s)) p2g_widen(kg, a, t);
    gift[i].at = tile_at(t, &s);
    offer_momentum(a, kg->g.h, &s, p + i, gift + i);
    if (force) offer_force(a, kg->inverse_h, &s, p + i, gift + i);
  }
  for (int i = 0, end; i < n; i = end) {
    double *u = gift[i].at;
    for (end = i + 1; end < n && gift[end].at == u; end++) continue;
    give_momentum(u, gift + i, end - i);
    if (force) give_force(u + (1 + DIM) * PITCH, gift + i, end - i);
  }
}

/* scalars of the tile: mass, momentum, force */
static void p2g(const struct kernel_grid *kg, const struct kernel_run *run, const struct p2g_args *a)
{
  struct tile t;
  double      low[TEAM * DIM];
  tile_place(&t, kg, run);
  tile_clear(&t, 1 + 2 * DIM);
  for (int q = 0; q < TEAM * DIM; q++) low[q] = kg->low[q % DIM];
  for (long p = run->begin; p < run->end; p += TEAM)
    p2g_team(kg, a, &t, low, p, run->end - p < TEAM ? (int)(run->end - p) : TEAM);
  p2g_close(kg, a, &t);
}

/* What a point gathers: sum w v r (in h; from which the affine matrix is made), w v, v grad w (in 1/h), and w of the
 * change of v. Matrices begin with a row of sums, so that they leave from registers. */
#if DIM == 2
enum { AFFINE = 0, GRADIENT = 4, VELOCITY = 8, CHANGE = 10, SUMS = 12 };
#else
enum { AFFINE = 0, VELOCITY = 9, GRADIENT = 12, CHANGE = 21, SUMS = 24 };
#endif

static inline void gather_motion(const double *u, const struct stencil *s, ROW sums[SUMS / ROW_NODES])
{
  ROW of[SUMS]; /* to be summed over their lanes */
#pragma GCC unroll 3
  for (int d = 0; d < DIM; d++) {
    struct sums q;
    tile_sum(u + d * PITCH, s, &q);
    ROW *r = of + AFFINE + d * DIM, *gradient = of + GRADIENT + d * DIM;
    r[0] = s->wr[0] * q.w;
    r[1] = s->w[0] * q.ry;
    gradient[0] = s->d[0] * q.w;
    gradient[1] = s->w[0] * q.dy;
    if (DIM == 3) r[DIM - 1] = s->w[0] * q.rz;
    if (DIM == 3) gradient[DIM - 1] = s->w[0] * q.dz;
    of[VELOCITY + d] = s->w[0] * q.w;
    of[CHANGE + d] = s->w[0] * tile_sum_even(u + (DIM + d) * PITCH, s);
  }
  for (int q = 0; q < SUMS; q += ROW_NODES) sums[q / ROW_NODES] = row_sums(of[q], of[q + 1], of[q + 2], of[q + 3]);
}

static inline double sum_at(const ROW *sums, int q) { return sums[q / ROW_NODES][q % ROW_NODES]; }

/* a matrix of the sums, from `first` on, times a factor */
static inline void store_matrix(const ROW *sums, int first, double factor, double *matrix)
{
  int rows = DIM * DIM / ROW_NODES;
  for (int q = 0; q < rows; q++) row_store(matrix + q * ROW_NODES, sums[first / ROW_NODES + q] * factor);
  for (int q = rows * ROW_NODES; q < DIM * DIM; q++) matrix[q] = sum_at(sums, first + q) * factor;
}

/* second moment of the weights along an axis, h2: D of T(28); x: place of the point */
static inline double axis_moment(const struct kernel_grid *kg, const struct stencil *s, const double *x, int axis)
{
  double m = 0, nearest = s->first[axis] - (x[axis] - kg->g.min[axis]) * kg->inverse_h;
  for (int i = 0; i < N1; i++) m += s->wr[axis][i] * (nearest + i);
  return m;
}

/* in h2: where the moment is not the same everywhere, 1 until it is known */
static const double usual_moment = moment > 0 ? moment : 1;

/* Affine velocity matrix B D^-1, T(28), that was made with the usual D. Near a modified wall D shrinks; the velocity
 * gradient where it vanishes. */
static inline void correct_affine(const struct kernel_grid *kg, const struct stencil *s, const double *x,
                                  const double *gradv, double *affine)
{
  for (int e = 0; e < DIM; e++) {
    double m = axis_moment(kg, s, x, e);
    for (int q = e; q < DIM * DIM; q += DIM) affine[q] = m > 0.05 ? affine[q] * (usual_moment / m) : gradv[q];
  }
}

/* gradv [DIM][DIM]: where this point's goes */
static inline void g2p_point(const struct kernel_grid *kg, const struct g2p_args *a, struct tile *t, long p,
                             const struct stencil *s, double *gradv)
{
  ROW     sums[SUMS / ROW_NODES];
  double *x = a->x + p * DIM, *vel = a->vel + p * DIM, *affine = a->affine + p * DIM * DIM;
  gather_motion(tile_at(t, s), s, sums);
  store_matrix(sums, GRADIENT, kg->inverse_h, gradv);
  if (a->affine) store_matrix(sums, AFFINE, kg->inverse_h * (1 / usual_moment), affine);
  if (a->affine && (moment == 0 || s->folded)) correct_affine(kg, s, x, gradv, affine);
  for (int d = 0; d < DIM; d++) {
    double now = sum_at(sums, VELOCITY + d);
    vel[d] = a->beta * now + (1 - a->beta) * (vel[d] + sum_at(sums, CHANGE + d));
    x[d] += a->dt * now;
    if (a->displacement) a->displacement[p * DIM + d] += a->dt * now;
  }
}

/* velocity of a row of n nodes, and its change */
static inline void take_row(int n, const double *restrict now, const double *restrict old,
                            double (*restrict row)[PITCH])
{
  for (int i = 0; i < n; i++)
    for (int d = 0; d < DIM; d++) {
      row[d][i] = now[i * DIM + d];
      row[DIM + d][i] = now[i * DIM + d] - old[i * DIM + d];
    }
}

/* scalars of the tile: new velocity, its change */
static void g2p_open(const struct kernel_grid *kg, const struct g2p_args *a, struct tile *t)
{
  tile_pad(t, 2 * DIM);
  FOR_TILE_ROWS(t, j, k, row)
  {
    long node = grid_at(&kg->g, t->first[0], j, k);
    take_row(t->count[0], a->vel_nc + node * DIM, a->vel_old_nc + node * DIM, row);
  }
}

static RARE void g2p_widen(const struct kernel_grid *kg, const struct g2p_args *a, struct tile *t)
{
  tile_reach(t, kg, BLOCK_MARGIN);
  g2p_open(kg, a, t);
}

/* points [p, p + n); gradv [n][DIM][DIM] */
static inline void g2p_points(const struct kernel_grid *kg, const struct g2p_args *a, struct tile *t, const double *low,
                              long p, int n, double *gradv)
{
  for (int i = 0; i < n; i += TEAM) {
    int            team = n - i < TEAM ? n - i : TEAM;
    struct places  places;
    struct stencil s[TEAM];
    find_places(kg, low, team, a->x + (p + i) * DIM, &places);
    for (int j = 0; j < team; j++) find_stencil(kg, t->at_wall, &places, j, s + j);
    for (int j = 0; j < team; j++) {
      if (!tile_holds(t, s + j)) g2p_widen(kg, a, t);
      g2p_point(kg, a, t, p + i + j, s + j, gradv + (i + j) * DIM * DIM);
    }
  }
}

static void g2p(const struct kernel_grid *kg, const struct kernel_run *run, const struct g2p_args *a)
{
  struct tile t;
  double      low[TEAM * DIM];
  tile_place(&t, kg, run);
  g2p_open(kg, a, &t);
  for (int q = 0; q < TEAM * DIM; q++) low[q] = kg->low[q % DIM];
  for (long p = run->begin; p < run->end; p += POINT_BATCH) {
    int    n = run->end - p < POINT_BATCH ? (int)(run->end - p) : POINT_BATCH;
    double own[POINT_BATCH * DIM * DIM], *gradv = a->gradv ? a->gradv + p * DIM * DIM : own;
    g2p_points(kg, a, &t, low, p, n, gradv);
    if (a->strain) a->strain(a->context, p, n, gradv);
  }
}

static inline void scatter_point(const struct kernel_grid *kg, const struct scatter_args *a, const struct stencil *s,
                                 long p, double *u)
{
  double weight = a->weight ? a->weight[p] : 1, h = kg->g.h;
  ROW    w = weight * s->w[0], wh = h * w, wr = (weight * h) * s->wr[0];
  ROW    w_h = kg->inverse_h * w, slope = (weight * kg->inverse_h) * s->d[0];
  for (int q = 0; q < a->n; q++) {
    double        value = a->value[q] ? a->value[q][p] : 1;
    const double *A = a->gradient[q] + p * DIM, *flux = a->flux[q] + p * DIM;
    if (a->gradient[q])
      tile_add(u + q * PITCH, s, s->wr, value * w + A[0] * wr, A[1] * wh, A[DIM - 1] * wh);
    else
      tile_add_even(u + q * PITCH, s, value * w);
    if (a->flux[q]) tile_add(u + q * PITCH, s, s->d, flux[0] * slope, flux[1] * w_h, flux[DIM - 1] * w_h);
  }
}

static void scatter_close(const struct kernel_grid *kg, const struct scatter_args *a, struct tile *t)
{
  FOR_TILE_ROWS(t, j, k, row)
  for (int q = 0; q < a->n; q++) {
    double *node = a->node[q] + grid_at(&kg->g, t->first[0], j, k), factor = a->factor[q] != 0 ? a->factor[q] : 1;
    for (int i = 0; i < t->count[0]; i++) node[i] += factor * row[q][i];
  }
}

static RARE void scatter_widen(const struct kernel_grid *kg, const struct scatter_args *a, struct tile *t)
{
  scatter_close(kg, a, t);
  tile_reach(t, kg, BLOCK_MARGIN);
  tile_clear(t, a->n);
}

static void scatter(const struct kernel_grid *kg, const struct kernel_run *run, const struct scatter_args *a)
{
  struct tile    t;
  struct stencil s;
  tile_place(&t, kg, run);
  tile_clear(&t, a->n);
  for (long p = run->begin; p < run->end; p++) {
    stencil_at(kg, t.at_wall, a->x + p * DIM, &s);
    if (!tile_holds(&t, &s)) scatter_widen(kg, a, &t);
    scatter_point(kg, a, &s, p, tile_at(&t, &s));
  }
  scatter_close(kg, a, &t);
}

static inline void gather_point(const struct kernel_grid *kg, const struct gather_args *a, const struct stencil *s,
                                long p, const double *u)
{
  long step = a->gradient_stride ? a->gradient_stride : DIM;
  for (int q = 0; q < a->n; q++) {
    struct sums sums;
    double      all[ROW_NODES];
    tile_sum(u + q * PITCH, s, &sums);
    row_store(all, row_sums(s->w[0] * sums.w, s->d[0] * sums.w, s->w[0] * sums.dy, s->w[0] * sums.dz));
    if (a->value[q]) a->value[q][p] = all[0];
    for (int e = 0; e < DIM && a->gradient[q]; e++) a->gradient[q][p * step + e] = all[1 + e] * kg->inverse_h;
  }
}

static void gather_open(const struct kernel_grid *kg, const struct gather_args *a, struct tile *t)
{
  tile_pad(t, a->n);
  FOR_TILE_ROWS(t, j, k, row)
  for (int q = 0; q < a->n; q++) {
    long node = grid_at(&kg->g, t->first[0], j, k), step = a->stride[q] ? a->stride[q] : 1;
    for (int i = 0; i < t->count[0]; i++) row[q][i] = a->node[q][(node + i) * step];
  }
}

static RARE void gather_widen(const struct kernel_grid *kg, const struct gather_args *a, struct tile *t)
{
  tile_reach(t, kg, BLOCK_MARGIN);
  gather_open(kg, a, t);
}

static void gather(const struct kernel_grid *kg, const struct kernel_run *run, const struct gather_args *a)
{
  struct tile    t;
  struct stencil s;
  tile_place(&t, kg, run);
  gather_open(kg, a, &t);
  for (long p = run->begin; p < run->end; p++) {
    stencil_at(kg, t.at_wall, a->x + p * DIM, &s);
    if (!tile_holds(&t, &s)) gather_widen(kg, a, &t);
    gather_point(kg, a, &s, p, tile_at(&t, &s));
  }
}

static void weights(const struct kernel_grid *kg, const double *x, long *node, double *w, double (*gradient)[3])
{
  struct stencil s;
  stencil_at(kg, true, x, &s);
  for (int k = 0, q = 0; k < N1_Z; k++)
    for (int j = 0; j < N1; j++)
      for (int i = 0; i < N1; i++, q++) {
        node[q] = grid_at(&kg->g, s.first[0] + i, s.first[1] + j, s.first[2] + k);
        double w_z = DIM == 2 ? 1 : s.w[DIM - 1][k], d_z = DIM == 2 ? 0 : s.d[DIM - 1][k];
        w[q] = s.w[0][i] * s.w[1][j] * w_z;
        if (!gradient) continue;
        gradient[q][0] = s.d[0][i] * s.w[1][j] * w_z * kg->inverse_h;
        gradient[q][1] = s.w[0][i] * s.d[1][j] * w_z * kg->inverse_h;
        gradient[q][2] = s.w[0][i] * s.w[1][j] * d_z * kg->inverse_h;
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
