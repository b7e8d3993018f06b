/* Points to nodes and back for one DIM and one BASIS. Every block works on a tile of nodes in L1. theory 3.1 */
#include "core/parallel.h"
#include "mpm/kernels/kernels.h"

#include <math.h>
#include <string.h>

#include "mpm/kernels/tile.tmpl.h"

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

/* w m (v + C r) */
static inline void add_momentum(const struct p2g_args *a, const struct stencil *s, long p, double *u)
{
  ROW w = a->mass[p] * s->w[0], wr = a->mass[p] * s->wr[0];
  tile_add_even(u, s, w);
  for (int d = 0; d < DIM; d++) {
    const double *C = a->affine + (p * DIM + d) * DIM, vel = a->vel[p * DIM + d];
    if (a->affine)
      tile_add(u + (1 + d) * PITCH, s, s->wr, vel * w + C[0] * wr, C[1] * w, C[DIM - 1] * w);
    else
      tile_add_even(u + (1 + d) * PITCH, s, vel * w);
  }
}

/* -V stress grad w */
static inline void add_force(const struct p2g_args *a, const struct stencil *s, long p, double *u)
{
  double        own[6];
  const double *S = total_stress(a, p, own);
  ROW           w = -a->volume[p] * s->w[0], slope = -a->volume[p] * s->d[0];
  for (int d = 0; d < DIM; d++)
    tile_add(u + (1 + DIM + d) * PITCH, s, s->d, S[SYM[d][0]] * slope, S[SYM[d][1]] * w, S[SYM[d][2]] * w);
}

/* scalars of the tile: mass, momentum, force */
static void p2g(const struct kernel_grid *kg, const struct kernel_run *run, const struct p2g_args *a)
{
  struct tile    t;
  struct stencil s;
  tile_place(&t, kg, run);
  tile_clear(&t, 1 + 2 * DIM);
  for (long p = run->begin; p < run->end; p++) {
    stencil_at(kg, a->x + p * DIM, &s);
    add_momentum(a, &s, p, tile_at(&t, &s));
    if (a->stress || a->pressure) add_force(a, &s, p, tile_at(&t, &s));
  }
  FOR_TILE_ROWS(&t, &kg->g, node, row)
  {
    for (int i = 0; i < t.count[0] && a->mass_nc; i++) a->mass_nc[node + i] += row[0][i];
    for (int i = 0; i < t.count[0] * DIM; i++) a->mom_nc[node * DIM + i] += row[1 + i % DIM][i / DIM];
    for (int i = 0; i < t.count[0] * DIM && a->force_nc; i++)
      a->force_nc[node * DIM + i] += row[1 + DIM + i % DIM][i / DIM];
  }
}

/* what a point gathers: sum w r v, w v, grad w v, and w of the change of v */
struct motion {
  double r[DIM * DIM], vel[DIM], gradient[DIM * DIM], change[DIM];
};

static inline void gather_motion(const double *u, const struct stencil *s, struct motion *motion)
{
  enum { N = sizeof *motion / sizeof(double), VEL = DIM * DIM, GRADIENT = VEL + DIM, CHANGE = GRADIENT + DIM * DIM };
  ROW    of[N]; /* to be summed over their lanes */
  double sums[N];
  for (int d = 0; d < DIM; d++) {
    struct sums q;
    tile_sum(u + d * PITCH, s, &q);
    ROW *r = of + d * DIM, *gradient = of + GRADIENT + d * DIM;
    r[0] = s->wr[0] * q.w;
    r[1] = s->w[0] * q.ry;
    gradient[0] = s->d[0] * q.w;
    gradient[1] = s->w[0] * q.dy;
    if (DIM == 3) r[DIM - 1] = s->w[0] * q.rz;
    if (DIM == 3) gradient[DIM - 1] = s->w[0] * q.dz;
    of[VEL + d] = s->w[0] * q.w;
    of[CHANGE + d] = s->w[0] * tile_sum_even(u + (DIM + d) * PITCH, s);
  }
  for (int q = 0; q < N; q += 4) row_store(sums + q, row_sums(of[q], of[q + 1], of[q + 2], of[q + 3]));
  memcpy(motion, sums, sizeof *motion);
}

/* second moment of the weights along an axis, m2: D of T(28); x: place of the point */
static inline double axis_moment(const struct kernel_grid *kg, const struct stencil *s, const double *x, int axis)
{
  double m = 0, nearest = kg->g.min[axis] + s->first[axis] * kg->g.h - x[axis];
  for (int i = 0; i < N1; i++) m += s->wr[axis][i] * (nearest + i * kg->g.h);
  return m;
}

/* Affine velocity matrix B D^-1, T(28). Near a modified wall D shrinks; the velocity gradient where it vanishes. */
static inline void affine_matrix(const struct kernel_grid *kg, const struct stencil *s, const double *x,
                                 const struct motion *now, double *C)
{
  double h2 = kg->g.h * kg->g.h;
  if (moment > 0 && !s->folded) {
    for (int q = 0; q < DIM * DIM; q++) C[q] = now->r[q] * (1 / moment * kg->inverse_h * kg->inverse_h);
    return;
  }
  for (int e = 0; e < DIM; e++) {
    double m = axis_moment(kg, s, x, e);
    for (int q = e; q < DIM * DIM; q += DIM) C[q] = m > 0.05 * h2 ? now->r[q] / m : now->gradient[q];
  }
}

/* gradv [DIM][DIM]: where this point's goes */
static inline void g2p_point(const struct kernel_grid *kg, const struct g2p_args *a, struct tile *t, long p,
                             double *gradv)
{
  struct stencil s;
  struct motion  now;
  double        *x = a->x + p * DIM, *vel = a->vel + p * DIM;
  stencil_at(kg, x, &s);
  gather_motion(tile_at(t, &s), &s, &now);
  if (a->affine) affine_matrix(kg, &s, x, &now, a->affine + p * DIM * DIM);
  memcpy(gradv, now.gradient, sizeof now.gradient);
  for (int d = 0; d < DIM; d++) {
    vel[d] = a->beta * now.vel[d] + (1 - a->beta) * (vel[d] + now.change[d]);
    x[d] += a->dt * now.vel[d];
    if (a->displacement) a->displacement[p * DIM + d] += a->dt * now.vel[d];
  }
}

/* scalars of the tile: new velocity, its change */
static void g2p(const struct kernel_grid *kg, const struct kernel_run *run, const struct g2p_args *a)
{
  struct tile t;
  tile_place(&t, kg, run);
  tile_pad(&t, 2 * DIM);
  FOR_TILE_ROWS(&t, &kg->g, node, row)
  for (int i = 0; i < t.count[0] * DIM; i++) {
    double vel = a->vel_nc[node * DIM + i];
    row[i % DIM][i / DIM] = vel;
    row[DIM + i % DIM][i / DIM] = vel - a->vel_old_nc[node * DIM + i];
  }
  for (long p = run->begin; p < run->end; p += POINT_BATCH) {
    int    n = run->end - p < POINT_BATCH ? (int)(run->end - p) : POINT_BATCH;
    double own[POINT_BATCH * DIM * DIM], *gradv = a->gradv ? a->gradv + p * DIM * DIM : own;
    for (int i = 0; i < n; i++) g2p_point(kg, a, &t, p + i, gradv + i * DIM * DIM);
    if (a->strain) a->strain(a->context, p, n, gradv);
  }
}

static inline void scatter_point(const struct kernel_grid *kg, const struct scatter_args *a, struct tile *t, long p)
{
  struct stencil s;
  stencil_at(kg, a->x + p * DIM, &s);
  double *u = tile_at(t, &s), weight = a->weight ? a->weight[p] : 1;
  ROW     w = weight * s.w[0], wr = weight * s.wr[0], slope = weight * s.d[0];
  for (int q = 0; q < a->n; q++) {
    double        value = a->value[q] ? a->value[q][p] : 1;
    const double *A = a->gradient[q] + p * DIM, *flux = a->flux[q] + p * DIM;
    if (a->gradient[q])
      tile_add(u + q * PITCH, &s, s.wr, value * w + A[0] * wr, A[1] * w, A[DIM - 1] * w);
    else
      tile_add_even(u + q * PITCH, &s, value * w);
    if (a->flux[q]) tile_add(u + q * PITCH, &s, s.d, flux[0] * slope, flux[1] * w, flux[DIM - 1] * w);
  }
}

static void scatter(const struct kernel_grid *kg, const struct kernel_run *run, const struct scatter_args *a)
{
  struct tile t;
  tile_place(&t, kg, run);
  tile_clear(&t, a->n);
  for (long p = run->begin; p < run->end; p++) scatter_point(kg, a, &t, p);
  FOR_TILE_ROWS(&t, &kg->g, node, row)
  for (int q = 0; q < a->n; q++) {
    double factor = a->factor[q] != 0 ? a->factor[q] : 1;
    for (int i = 0; i < t.count[0]; i++) a->node[q][node + i] += factor * row[q][i];
  }
}

static inline void gather_point(const struct kernel_grid *kg, const struct gather_args *a, struct tile *t, long p)
{
  struct stencil s;
  stencil_at(kg, a->x + p * DIM, &s);
  const double *u = tile_at(t, &s);
  long          step = a->gradient_stride ? a->gradient_stride : DIM;
  for (int q = 0; q < a->n; q++) {
    struct sums sums;
    double      all[ROW_NODES];
    tile_sum(u + q * PITCH, &s, &sums);
    row_store(all, row_sums(s.w[0] * sums.w, s.d[0] * sums.w, s.w[0] * sums.dy, s.w[0] * sums.dz));
    if (a->value[q]) a->value[q][p] = all[0];
    for (int e = 0; e < DIM && a->gradient[q]; e++) a->gradient[q][p * step + e] = all[1 + e];
  }
}

static void gather(const struct kernel_grid *kg, const struct kernel_run *run, const struct gather_args *a)
{
  struct tile t;
  tile_place(&t, kg, run);
  tile_pad(&t, a->n);
  FOR_TILE_ROWS(&t, &kg->g, node, row)
  for (int q = 0; q < a->n; q++) {
    long step = a->stride[q] ? a->stride[q] : 1;
    for (int i = 0; i < t.count[0]; i++) row[q][i] = a->node[q][(node + i) * step];
  }
  for (long p = run->begin; p < run->end; p++) gather_point(kg, a, &t, p);
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
