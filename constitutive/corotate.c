/* The rare case of the driver of rate laws: steps too large for its series. */
#include "constitutive/corotate.h"

/* one Jacobi rotation: makes A[p][q] zero; V collects the eigenvectors as columns */
static void annihilate(double A[3][3], double V[3][3], int p, int q)
{
  if (A[p][q] == 0.0) return;
  double theta = 0.5 * (A[q][q] - A[p][p]) / A[p][q];
  double t = copysign(1.0, theta) / (fabs(theta) + hypot(theta, 1.0));
  double c = 1.0 / hypot(t, 1.0), s = t * c;
  for (int k = 0; k < 3; k++) {
    double a = A[k][p], b = A[k][q];
    A[k][p] = c * a - s * b;
    A[k][q] = s * a + c * b;
  }
  for (int k = 0; k < 3; k++) {
    double a = A[p][k], b = A[q][k], v = V[k][p], w = V[k][q];
    A[p][k] = c * a - s * b;
    A[q][k] = s * a + c * b;
    V[k][p] = c * v - s * w;
    V[k][q] = s * v + c * w;
  }
}

/* eigenvalues and eigenvectors (columns of V) of a symmetric matrix, which is destroyed */
static void eigen(double A[3][3], double value[3], double V[3][3])
{
  enum { SWEEPS = 12 }; /* converges quadratically: 5 or 6 are enough */
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++) V[r][c] = r == c;
  for (int sweep = 0; sweep < SWEEPS; sweep++) {
    annihilate(A, V, 0, 1);
    annihilate(A, V, 0, 2);
    annihilate(A, V, 1, 2);
  }
  for (int k = 0; k < 3; k++) value[k] = A[k][k];
}

/* result = sum of f_k v_k v_k^T */
static void assemble(const double f[3], double V[3][3], double result[3][3])
{
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++)
      result[r][c] = f[0] * V[r][0] * V[c][0] + f[1] * V[r][1] * V[c][1] + f[2] * V[r][2] * V[c][2];
}

static void unstrained(struct corotate_group *g, int i)
{
  for (int k = 0; k < 6; k++) g->strain[k][i] = 0.0;
  for (int k = 0; k < 9; k++) g->R[k][i] = k % 4 == 0;
}

static int proper(const struct corotate_group *g, int i)
{
  double dF[9];
  for (int k = 0; k < 9; k++) dF[k] = g->G[k][i] + (k % 4 == 0);
  double J = tensor_determinant(dF);
  return isfinite(J) && J > 0.0;
}

static int split_lane(struct corotate_group *g, int i)
{
  double E[3][3] = {{g->E[XX][i], g->E[XY][i], g->E[XZ][i]},
                    {g->E[XY][i], g->E[YY][i], g->E[YZ][i]},
                    {g->E[XZ][i], g->E[YZ][i], g->E[ZZ][i]}};
  double value[3], V[3][3], half_log[3], root[3], log_U[3][3], U_inverse[3][3];
  eigen(E, value, V);
  for (int k = 0; k < 3; k++) {
    if (!(value[k] > -1.0) || isinf(value[k])) return 0;
    half_log[k] = 0.5 * log1p(value[k]);
    root[k] = 1.0 / sqrt(1.0 + value[k]);
  }
  assemble(half_log, V, log_U);
  assemble(root, V, U_inverse);
  static const int row[6] = {0, 1, 2, 0, 1, 0}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; k++) g->strain[k][i] = log_U[row[k]][column[k]];
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++) {
      double sum = U_inverse[r][c];
      for (int k = 0; k < 3; k++) sum += g->G[3 * r + k][i] * U_inverse[k][c];
      g->R[3 * r + c][i] = sum;
    }
  return 1;
}

int corotate_split_large(int m, struct corotate_group *g)
{
  int bad = 0;
  for (int i = 0; i < m; i++) {
    double size = g->E2[XX][i] + g->E2[YY][i] + g->E2[ZZ][i];
    if (size <= COROTATE_SMALL * COROTATE_SMALL) continue;
    if (proper(g, i) && split_lane(g, i)) continue;
    unstrained(g, i);
    bad++;
  }
  return bad;
}
