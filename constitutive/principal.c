/* Eigenvalues by Newton's method on the scaled cubic, projectors from the adjugate: some eps of the stress, whether
 * values are equal or not. */
#include "constitutive/principal.h"

/* The deviator over sqrt(J2), and the determinant of that. */
static void scale(const VECTOR s[6], struct principal *p, VECTOR S[6], VECTOR *determinant)
{
  p->mean = (s[XX] + s[YY] + s[ZZ]) / 3.0;
  for (int k = 0; k < 3; k++) S[k] = s[k] - p->mean;
  for (int k = 3; k < 6; k++) S[k] = s[k];
  VECTOR J2 = 0.5 * (S[XX] * S[XX] + S[YY] * S[YY] + S[ZZ] * S[ZZ]) + S[XY] * S[XY] + S[YZ] * S[YZ] + S[XZ] * S[XZ];
  vector_sqrt(&J2, &p->size);
  VECTOR inverse = VECTOR_SELECT(p->size > 0.0, 1.0 / p->size, p->size);
  for (int k = 0; k < 6; k++) S[k] *= inverse;
  *determinant = S[XX] * (S[YY] * S[ZZ] - S[YZ] * S[YZ]) - S[XY] * (S[XY] * S[ZZ] - S[YZ] * S[XZ]) +
                 S[XZ] * (S[XY] * S[YZ] - S[YY] * S[XZ]);
}

/* x^3 - x = j with 0 <= j <= 2/sqrt(27): the largest root, from 1 to 2/sqrt(3), where the slope is 2 to 3. The cubic
 * that it starts on is 5e-5 off at most; each step squares the error. */
static void solve_cubic(const VECTOR *j, VECTOR *x)
{
  enum { STEPS = 2 };
  VECTOR root = 1.00005 + *j * (0.49599 + *j * (-0.31716 + *j * 0.18872));
  for (int i = 0; i < STEPS; i++) {
    VECTOR square = root * root;
    root = (2.0 * root * square + *j) / (3.0 * square - 1.0);
  }
  *x = root;
}

/* N = adj(S - x I)/(3 x^2 - 1) with adj = S^2 + x S + (x^2 - 1) I, as S has no trace and J2 = 1 */
static void project(const VECTOR S[6], struct principal *p)
{
  VECTOR square = p->x * p->x, share = 1.0 / (3.0 * square - 1.0), *N = p->N;
  N[XX] = S[XX] * S[XX] + S[XY] * S[XY] + S[XZ] * S[XZ] + (square - 1.0);
  N[YY] = S[XY] * S[XY] + S[YY] * S[YY] + S[YZ] * S[YZ] + (square - 1.0);
  N[ZZ] = S[XZ] * S[XZ] + S[YZ] * S[YZ] + S[ZZ] * S[ZZ] + (square - 1.0);
  N[XY] = S[XX] * S[XY] + S[XY] * S[YY] + S[XZ] * S[YZ];
  N[YZ] = S[XY] * S[XZ] + S[YY] * S[YZ] + S[YZ] * S[ZZ];
  N[XZ] = S[XX] * S[XZ] + S[XY] * S[YZ] + S[XZ] * S[ZZ];
  for (int k = 0; k < 6; k++) N[k] = (N[k] + p->x * S[k]) * share;
}

static void leave_plane(const VECTOR S[6], struct principal *p)
{
  VECTOR *B = p->B;
  for (int k = 0; k < 6; k++) B[k] = S[k] - 1.5 * p->x * p->N[k];
  for (int k = 0; k < 3; k++) B[k] += 0.5 * p->x;
  VECTOR square = 0.5 * (B[XX] * B[XX] + B[YY] * B[YY] + B[ZZ] * B[ZZ]) + B[XY] * B[XY] + B[YZ] * B[YZ] + B[XZ] * B[XZ];
  vector_sqrt(&square, &p->radius);
}

void principal_split(const VECTOR stress[6], struct principal *p)
{
  VECTOR S[6], j, x;
  scale(stress, p, S, &j);
  VECTOR size = VECTOR_ABS(j);
  solve_cubic(&size, &x);
  p->x = VECTOR_SELECT(j < 0.0, -x, x);
  project(S, p);
  leave_plane(S, p);
  VECTOR alone = p->mean + p->size * p->x, centre = p->mean - 0.5 * p->size * p->x, half = p->size * p->radius;
  VECTOR low = centre - half, high = centre + half;
  p->value[0] = VECTOR_SELECT(j < 0.0, alone, low);
  p->value[1] = VECTOR_SELECT(j < 0.0, low, high);
  p->value[2] = VECTOR_SELECT(j < 0.0, high, alone);
}

void principal_join(const struct principal *p, const VECTOR value[3], VECTOR stress[6])
{
  MASK   lowest = (MASK)(p->x < 0.0);
  VECTOR alone = VECTOR_SELECT(lowest, value[0], value[2]);
  VECTOR low = VECTOR_SELECT(lowest, value[1], value[0]), high = VECTOR_SELECT(lowest, value[2], value[1]);
  VECTOR centre = 0.5 * (low + high), half = 0.5 * (high - low);
  VECTOR stretch = VECTOR_SELECT(p->radius > 0.0, half / p->radius, p->radius);
  for (int k = 0; k < 6; k++) stress[k] = (alone - centre) * p->N[k] + stretch * p->B[k];
  for (int k = 0; k < 3; k++) stress[k] += centre;
}
