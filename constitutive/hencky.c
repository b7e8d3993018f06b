/* exp and log as series of a matrix, evaluated as a I + b A + c A^2; principal values where it is too large for that.
 */
#include "constitutive/hencky.h"

#include "constitutive/principal.h"

/* Above this size (Frobenius) the series below lose digits. */
#define SMALL 0.05
enum { LOG_TERMS = 12, EXP_TERMS = 9 };

/* coefficients of A, A^2, ... of log(I + A)/2 and exp(A) - I */
static const double log_terms[LOG_TERMS] = {1.0 / 2,  -1.0 / 4,  1.0 / 6,  -1.0 / 8,  1.0 / 10, -1.0 / 12,
                                            1.0 / 14, -1.0 / 16, 1.0 / 18, -1.0 / 20, 1.0 / 22, -1.0 / 24};
static const double exp_terms[EXP_TERMS] = {1.0,       1.0 / 2,    1.0 / 6,     1.0 / 24,    1.0 / 120,
                                            1.0 / 720, 1.0 / 5040, 1.0 / 40320, 1.0 / 362880};

static void square(const VECTOR A[6], VECTOR A2[6])
{
  A2[XX] = A[XX] * A[XX] + A[XY] * A[XY] + A[XZ] * A[XZ];
  A2[YY] = A[XY] * A[XY] + A[YY] * A[YY] + A[YZ] * A[YZ];
  A2[ZZ] = A[XZ] * A[XZ] + A[YZ] * A[YZ] + A[ZZ] * A[ZZ];
  A2[XY] = A[XX] * A[XY] + A[XY] * A[YY] + A[XZ] * A[YZ];
  A2[YZ] = A[XY] * A[XZ] + A[YY] * A[YZ] + A[YZ] * A[ZZ];
  A2[XZ] = A[XX] * A[XZ] + A[XY] * A[YZ] + A[XZ] * A[ZZ];
}

/* sum of terms[k] A^(k+1), with A^3 = i1 A^2 - i2 A + i3 I; answers whether A is small enough */
static void series(int n, const double *terms, const VECTOR A[6], VECTOR sum[6], MASK *small)
{
  VECTOR A2[6], a, b, c, yz = A[YY] * A[ZZ] - A[YZ] * A[YZ], i1 = A[XX] + A[YY] + A[ZZ];
  VECTOR i2 = (A[XX] * A[YY] - A[XY] * A[XY]) + yz + (A[XX] * A[ZZ] - A[XZ] * A[XZ]);
  VECTOR i3 = A[XX] * yz - A[XY] * (A[XY] * A[ZZ] - A[YZ] * A[XZ]) + A[XZ] * (A[XY] * A[YZ] - A[YY] * A[XZ]);
  square(A, A2);
  *small = (MASK)(A2[XX] + A2[YY] + A2[ZZ] <= SMALL * SMALL);
  a = b = c = VECTOR_ALL(0.0);
  for (int k = n - 1; k >= -1; k--) {
    VECTOR up = a, a1 = b;
    a = (k >= 0 ? terms[k] : 0.0) + c * i3;
    b = up - c * i2;
    c = a1 + c * i1;
  }
  for (int k = 0; k < 6; k++) sum[k] = b * A[k] + c * A2[k];
  for (int k = 0; k < 3; k++) sum[k] += a;
}

/* G = dF - I and det dF - 1; lanes beyond m: no motion */
static void load(int m, const double *dF, VECTOR G[9], VECTOR *growth)
{
  for (int k = 0; k < 9; k++) G[k] = VECTOR_ALL(0.0);
  for (int i = 0; i < m; i++)
    for (int k = 0; k < 9; k++) G[k][i] = dF[9 * i + k] - (k % 4 == 0);
  VECTOR minors = (G[0] * G[4] - G[1] * G[3]) + (G[4] * G[8] - G[5] * G[7]) + (G[0] * G[8] - G[2] * G[6]);
  VECTOR det =
      G[0] * (G[4] * G[8] - G[5] * G[7]) - G[1] * (G[3] * G[8] - G[5] * G[6]) + G[2] * (G[3] * G[7] - G[4] * G[6]);
  *growth = (G[0] + G[4] + G[8]) + minors + det;
}

/* dF (I + B) dF^T - I = (G + M) + (G + M)^T + ... without the cancelling ones: with M = B + G B,
 * E = G + G^T + G G^T + M + M G^T */
static void push(const VECTOR G[9], const VECTOR B[6], VECTOR E[6])
{
  static const int at[9] = {XX, XY, XZ, XY, YY, YZ, XZ, YZ, ZZ}, row[6] = {0, 1, 2, 0, 1, 0},
                   col[6] = {0, 1, 2, 1, 2, 2};
  VECTOR M[9];
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++)
      M[3 * r + c] =
          B[at[3 * r + c]] + (G[3 * r] * B[at[c]] + G[3 * r + 1] * B[at[3 + c]] + G[3 * r + 2] * B[at[6 + c]]);
  for (int k = 0; k < 6; k++) {
    const VECTOR *g = &G[3 * row[k]], *h = &G[3 * col[k]], *n = &M[3 * row[k]];
    E[k] = (g[col[k]] + h[row[k]] + n[col[k]]) + ((g[0] + n[0]) * h[0] + (g[1] + n[1]) * h[1] + (g[2] + n[2]) * h[2]);
  }
}

/* the same function of the principal values */
static void by_values(double (*function)(double), const VECTOR A[6], VECTOR result[6])
{
  struct principal p;
  VECTOR           value[3];
  principal_split(A, &p);
  for (int k = 0; k < 3; k++)
    for (int i = 0; i < LANES; i++) value[k][i] = function(p.value[k][i]);
  principal_join(&p, value, result);
}

static double half_log(double value) { return 0.5 * log1p(value); }

/* strains of the lanes that are not small */
static void large_step(const VECTOR G[9], const VECTOR A[6], const MASK *small, VECTOR trial[6])
{
  VECTOR B[6], E[6], large[6];
  by_values(expm1, A, B);
  push(G, B, E);
  by_values(half_log, E, large);
  for (int k = 0; k < 6; k++) trial[k] = VECTOR_SELECT(*small, trial[k], large[k]);
}

/* Lanes that lost their volume, or became NaN or infinite, keep their strain. */
static int refuse(int m, const VECTOR *growth, const VECTOR trial[6], VECTOR strain[6], MASK *refused)
{
  int    n = 0;
  VECTOR sum = trial[0] + trial[1] + trial[2] + trial[3] + trial[4] + trial[5];
  *refused = ~((MASK)(*growth > -1.0) & (MASK)(*growth < INFINITY) & (MASK)(sum - sum == 0.0));
  for (int k = 0; k < 6; k++) strain[k] = VECTOR_SELECT(*refused, strain[k], trial[k]);
  for (int i = 0; i < m; i++) n += (*refused)[i] != 0;
  return n;
}

int hencky_step(int m, const double *dF, VECTOR strain[6], VECTOR *growth, MASK *refused)
{
  VECTOR G[9], A[6], B[6], E[6], trial[6];
  MASK   small, small_too;
  load(m, dF, G, growth);
  for (int k = 0; k < 6; k++) A[k] = 2.0 * strain[k];
  series(EXP_TERMS, exp_terms, A, B, &small);
  push(G, B, E);
  series(LOG_TERMS, log_terms, E, trial, &small_too);
  small &= small_too;
  MASK large = ~small;
  if (vector_any(&large)) large_step(G, A, &small, trial);
  return refuse(m, growth, trial, strain, refused);
}
