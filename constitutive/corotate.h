/* The driver of rate laws: dF = R U of a step; the law answers the strain log U in the frame before the rotation, then
 * the stress turns with R. This is objective for steps of any size, and strains of the same axes add up to ln J
 * exactly. theory 1, Skeleton models; M(11)-(14) with the polar decomposition of the step instead of that of all steps.
 */
#ifndef CONSTITUTIVE_COROTATE_H
#define CONSTITUTIVE_COROTATE_H

#include "core/tensor.h"

/* Points go through a law in groups of LANES, stored component by component: every loop over lanes is vector code, and
 * a point gets the same bits in whatever company it comes. */
enum { LANES = 8 };

struct corotate_group {
  double G[9][LANES];      /* dF - I */
  double E[6][LANES];      /* dF^T dF - I */
  double E2[6][LANES];     /* E E */
  double strain[6][LANES]; /* log U, tensor components */
  double R[9][LANES];
  double stress[6][LANES]; /* Pa */
};

/** Decomposes the lanes whose |E| is so large that the series of corotate_split does not reach round-off; m lanes are
 * in use. Lanes it cannot decompose (dF singular, turned inside out, not finite) are left unstrained; returns their
 * number. */
int corotate_split_large(int m, struct corotate_group *g);

/* Above this |E| (Frobenius) series of COROTATE_TERMS terms lose digits. */
#define COROTATE_SMALL 0.02
enum { COROTATE_TERMS = 9 };

/* A polynomial of E is a I + b E + c E^2 (Cayley-Hamilton). */
struct corotate_polynomial {
  double a[LANES], b[LANES], c[LANES];
};

static inline void corotate_load(int m, const double *dF, const double *stress, struct corotate_group *g)
{
  if (m < LANES) memset(g, 0, sizeof *g);
  for (int i = 0; i < m; i++) {
    for (int k = 0; k < 9; k++) g->G[k][i] = dF[9 * i + k] - (k % 4 == 0);
    for (int k = 0; k < 6; k++) g->stress[k][i] = stress[6 * i + k];
  }
}

static inline void corotate_store(int m, const struct corotate_group *g, double *stress)
{
  for (int i = 0; i < m; i++)
    for (int k = 0; k < 6; k++) stress[6 * i + k] = g->stress[k][i];
}

/* E = G + G^T + G^T G */
static inline void corotate_stretch(struct corotate_group *g)
{
  for (int i = 0; i < LANES; i++) {
    double a = g->G[0][i], b = g->G[1][i], c = g->G[2][i], d = g->G[3][i], e = g->G[4][i], f = g->G[5][i];
    double p = g->G[6][i], q = g->G[7][i], r = g->G[8][i];
    g->E[XX][i] = 2.0 * a + (a * a + d * d + p * p);
    g->E[YY][i] = 2.0 * e + (b * b + e * e + q * q);
    g->E[ZZ][i] = 2.0 * r + (c * c + f * f + r * r);
    g->E[XY][i] = b + d + (a * b + d * e + p * q);
    g->E[YZ][i] = f + q + (b * c + e * f + q * r);
    g->E[XZ][i] = c + p + (a * c + d * f + p * r);
  }
}

static inline void corotate_square(struct corotate_group *g)
{
  for (int i = 0; i < LANES; i++) {
    double xx = g->E[XX][i], yy = g->E[YY][i], zz = g->E[ZZ][i], xy = g->E[XY][i], yz = g->E[YZ][i], xz = g->E[XZ][i];
    g->E2[XX][i] = xx * xx + xy * xy + xz * xz;
    g->E2[YY][i] = xy * xy + yy * yy + yz * yz;
    g->E2[ZZ][i] = xz * xz + yz * yz + zz * zz;
    g->E2[XY][i] = xx * xy + xy * yy + xz * yz;
    g->E2[YZ][i] = xy * xz + yy * yz + yz * zz;
    g->E2[XZ][i] = xx * xz + xy * yz + xz * zz;
  }
}

/* sum of coefficient[k] E^k by Horner: E (a I + b E + c E^2) = c i3 I + (a - c i2) E + (b + c i1) E^2 */
static inline void corotate_series(const struct corotate_group *g, const double *coefficient,
                                   struct corotate_polynomial *p)
{
  double i1[LANES], i2[LANES], i3[LANES];
  for (int i = 0; i < LANES; i++) {
    double xx = g->E[XX][i], yy = g->E[YY][i], zz = g->E[ZZ][i], xy = g->E[XY][i], yz = g->E[YZ][i], xz = g->E[XZ][i];
    i1[i] = xx + yy + zz;
    i2[i] = (xx * yy - xy * xy) + (yy * zz - yz * yz) + (xx * zz - xz * xz);
    i3[i] = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
    p->a[i] = coefficient[COROTATE_TERMS];
    p->b[i] = p->c[i] = 0.0;
  }
  for (int k = COROTATE_TERMS - 1; k >= 0; k--)
    for (int i = 0; i < LANES; i++) {
      double a = p->a[i], b = p->b[i], c = p->c[i];
      p->a[i] = coefficient[k] + c * i3[i];
      p->b[i] = a - c * i2[i];
      p->c[i] = b + c * i1[i];
    }
}

/* symmetric result [6] of a polynomial of E */
static inline void corotate_evaluate(const struct corotate_group *g, const struct corotate_polynomial *p,
                                     double result[6][LANES])
{
  for (int k = 0; k < 6; k++)
    for (int i = 0; i < LANES; i++)
      result[k][i] = (k < 3 ? p->a[i] : 0.0) + (p->b[i] * g->E[k][i] + p->c[i] * g->E2[k][i]);
}

/* R = dF U^-1 */
static inline void corotate_rotation(const double U_inverse[6][LANES], struct corotate_group *g)
{
  static const int at[9] = {XX, XY, XZ, XY, YY, YZ, XZ, YZ, ZZ};
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++)
      for (int i = 0; i < LANES; i++) {
        const double *u0 = U_inverse[at[c]], *u1 = U_inverse[at[3 + c]], *u2 = U_inverse[at[6 + c]];
        double        own = U_inverse[at[3 * r + c]][i];
        g->R[3 * r + c][i] = own + (g->G[3 * r][i] * u0[i] + g->G[3 * r + 1][i] * u1[i] + g->G[3 * r + 2][i] * u2[i]);
      }
}

/* |E|^2 of the lane where it is largest; NaN counts as infinite */
static inline double corotate_largest(const struct corotate_group *g)
{
  double largest = 0.0;
  for (int i = 0; i < LANES; i++) {
    double size = g->E2[XX][i] + g->E2[YY][i] + g->E2[ZZ][i];
    if (!(size <= largest)) largest = isnan(size) ? INFINITY : size;
  }
  return largest;
}

/* log U and R of every lane; returns how many of the m lanes in use have none */
static inline int corotate_split(int m, struct corotate_group *g)
{
  /* log(I + E)/2 and (I + E)^(-1/2) */
  static const double logarithm[COROTATE_TERMS + 1] = {0,        1.0 / 2,   -1.0 / 4, 1.0 / 6,   -1.0 / 8,
                                                       1.0 / 10, -1.0 / 12, 1.0 / 14, -1.0 / 16, 1.0 / 18};
  static const double root[COROTATE_TERMS + 1] = {
      1,           -1.0 / 2,     3.0 / 8,       -5.0 / 16,      35.0 / 128,
      -63.0 / 256, 231.0 / 1024, -429.0 / 2048, 6435.0 / 32768, -12155.0 / 65536};
  struct corotate_polynomial p;
  double                     U_inverse[6][LANES];
  corotate_stretch(g);
  corotate_square(g);
  corotate_series(g, logarithm, &p);
  corotate_evaluate(g, &p, g->strain);
  corotate_series(g, root, &p);
  corotate_evaluate(g, &p, U_inverse);
  corotate_rotation(U_inverse, g);
  if (corotate_largest(g) <= COROTATE_SMALL * COROTATE_SMALL) return 0;
  return corotate_split_large(m, g);
}

/* stress <- R stress R^T */
static inline void corotate_turn(struct corotate_group *g)
{
  for (int i = 0; i < LANES; i++) {
    double xx = g->stress[XX][i], yy = g->stress[YY][i], zz = g->stress[ZZ][i];
    double xy = g->stress[XY][i], yz = g->stress[YZ][i], xz = g->stress[XZ][i];
    double T[9];
    for (int r = 0; r < 3; r++) {
      double a = g->R[3 * r][i], b = g->R[3 * r + 1][i], c = g->R[3 * r + 2][i];
      T[3 * r] = a * xx + b * xy + c * xz;
      T[3 * r + 1] = a * xy + b * yy + c * yz;
      T[3 * r + 2] = a * xz + b * yz + c * zz;
    }
    g->stress[XX][i] = T[0] * g->R[0][i] + T[1] * g->R[1][i] + T[2] * g->R[2][i];
    g->stress[YY][i] = T[3] * g->R[3][i] + T[4] * g->R[4][i] + T[5] * g->R[5][i];
    g->stress[ZZ][i] = T[6] * g->R[6][i] + T[7] * g->R[7][i] + T[8] * g->R[8][i];
    g->stress[XY][i] = T[0] * g->R[3][i] + T[1] * g->R[4][i] + T[2] * g->R[5][i];
    g->stress[YZ][i] = T[3] * g->R[6][i] + T[4] * g->R[7][i] + T[5] * g->R[8][i];
    g->stress[XZ][i] = T[0] * g->R[6][i] + T[1] * g->R[7][i] + T[2] * g->R[8][i];
  }
}

/** Updates n points by a law whose answer(prm, group) adds to group.stress what group.strain asks for. `answer` is
 * known where this is called, so it is inlined. Returns how many points could not be updated; their stress stays. */
static inline __attribute__((always_inline)) int corotate_update(const void *prm, int n, const double *dF,
                                                                 double *stress,
                                                                 void (*answer)(const void *, struct corotate_group *))
{
  int bad = 0;
  for (int p = 0; p < n; p += LANES) {
    struct corotate_group g;
    int                   m = n - p < LANES ? n - p : LANES;
    corotate_load(m, &dF[9L * p], &stress[6L * p], &g);
    bad += corotate_split(m, &g);
    answer(prm, &g);
    corotate_turn(&g);
    corotate_store(m, &g, &stress[6L * p]);
  }
  return bad;
}

#endif
