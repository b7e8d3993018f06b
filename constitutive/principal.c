/* Eigenvalues by Newton's method on the scaled cubic, projectors from the adjugate: some eps of the stress, whether
 * values are equal or not. Of a stress of the plane xy, by the root of a quadratic. */
#include "constitutive/principal.h"

/* of the deviator over its size sqrt(J2), whose principal values are x, -x/2 - radius and -x/2 + radius */
struct scaled {
  VECTOR S[6], determinant; /* - */
  VECTOR mean, size, x;     /* Pa, Pa, - */
};

static void scale(const VECTOR s[6], struct scaled *d)
{
  VECTOR *S = d->S;
  d->mean = (s[XX] + s[YY] + s[ZZ]) / 3.0;
  for (int k = 0; k < 3; k++) S[k] = s[k] - d->mean;
  for (int k = 3; k < 6; k++) S[k] = s[k];
  VECTOR J2 = 0.5 * (S[XX] * S[XX] + S[YY] * S[YY] + S[ZZ] * S[ZZ]) + S[XY] * S[XY] + S[YZ] * S[YZ] + S[XZ] * S[XZ];
  vector_sqrt(&J2, &d->size);
  VECTOR inverse = VECTOR_SELECT(d->size > 0.0, 1.0 / d->size, d->size);
  for (int k = 0; k < 6; k++) S[k] *= inverse;
  d->determinant = S[XX] * (S[YY] * S[ZZ] - S[YZ] * S[YZ]) - S[XY] * (S[XY] * S[ZZ] - S[YZ] * S[XZ]) +
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
static void project(const struct scaled *d, VECTOR N[6])
{
  const VECTOR *S = d->S;
  VECTOR        square = d->x * d->x, share = 1.0 / (3.0 * square - 1.0);
  N[XX] = S[XX] * S[XX] + S[XY] * S[XY] + S[XZ] * S[XZ] + (square - 1.0);
  N[YY] = S[XY] * S[XY] + S[YY] * S[YY] + S[YZ] * S[YZ] + (square - 1.0);
  N[ZZ] = S[XZ] * S[XZ] + S[YZ] * S[YZ] + S[ZZ] * S[ZZ] + (square - 1.0);
  N[XY] = S[XX] * S[XY] + S[XY] * S[YY] + S[XZ] * S[YZ];
  N[YZ] = S[XY] * S[XZ] + S[YY] * S[YZ] + S[YZ] * S[ZZ];
  N[XZ] = S[XX] * S[XZ] + S[XY] * S[YZ] + S[XZ] * S[ZZ];
  for (int k = 0; k < 6; k++) N[k] = (N[k] + d->x * S[k]) * share;
}

static void leave_plane(const struct scaled *d, struct principal *p)
{
  VECTOR *B = p->B;
  for (int k = 0; k < 6; k++) B[k] = d->S[k] - 1.5 * d->x * p->N[k];
  for (int k = 0; k < 3; k++) B[k] += 0.5 * d->x;
  VECTOR square = 0.5 * (B[XX] * B[XX] + B[YY] * B[YY] + B[ZZ] * B[ZZ]) + B[XY] * B[XY] + B[YZ] * B[YZ] + B[XZ] * B[XZ];
  vector_sqrt(&square, &p->radius);
}

static void sort_values(const VECTOR *alone, const VECTOR *centre, const VECTOR *half, struct principal *p)
{
  VECTOR low = *centre - *half, high = *centre + *half;
  p->low = (MASK)(*alone < low);
  p->high = (MASK)(*alone > high);
  p->value[0] = VECTOR_SELECT(p->low, *alone, low);
  p->value[1] = VECTOR_SELECT(p->low, low, VECTOR_SELECT(p->high, high, *alone));
  p->value[2] = VECTOR_SELECT(p->high, *alone, high);
}

static void split(const VECTOR stress[6], struct principal *p)
{
  struct scaled d;
  VECTOR        x;
  scale(stress, &d);
  VECTOR size = VECTOR_ABS(d.determinant);
  solve_cubic(&size, &x);
  d.x = VECTOR_SELECT(d.determinant < 0.0, -x, x);
  project(&d, p->N);
  leave_plane(&d, p);
  VECTOR alone = d.mean + d.size * d.x, centre = d.mean - 0.5 * d.size * d.x, half = d.size * p->radius;
  sort_values(&alone, &centre, &half, p);
}

static void split_plane(const VECTOR stress[6], struct principal *p)
{
  VECTOR centre = 0.5 * (stress[XX] + stress[YY]), half = 0.5 * (stress[XX] - stress[YY]);
  VECTOR square = half * half + stress[XY] * stress[XY], zero = VECTOR_ALL(0.0);
  vector_sqrt(&square, &p->radius);
  for (int k = 0; k < 6; k++) p->N[k] = p->B[k] = zero;
  p->N[ZZ] = VECTOR_ALL(1.0);
  p->B[XX] = half;
  p->B[YY] = -half;
  p->B[XY] = stress[XY];
  sort_values(&stress[ZZ], &centre, &p->radius, p);
}

static void take_lanes(const MASK *mask, const struct principal *other, struct principal *p)
{
  for (int k = 0; k < 6; k++) p->N[k] = VECTOR_SELECT(*mask, other->N[k], p->N[k]);
  for (int k = 0; k < 6; k++) p->B[k] = VECTOR_SELECT(*mask, other->B[k], p->B[k]);
  for (int k = 0; k < 3; k++) p->value[k] = VECTOR_SELECT(*mask, other->value[k], p->value[k]);
  p->radius = VECTOR_SELECT(*mask, other->radius, p->radius);
  p->low = (*mask & other->low) | (~*mask & p->low);
  p->high = (*mask & other->high) | (~*mask & p->high);
}

void principal_split(const VECTOR stress[6], struct principal *p)
{
  struct principal flat;
  MASK             plane = (MASK)(stress[YZ] == 0.0) & (MASK)(stress[XZ] == 0.0), across = ~plane;
  if (vector_any(&across)) split(stress, p);
  if (!vector_any(&plane)) return;
  split_plane(stress, vector_any(&across) ? &flat : p);
  if (vector_any(&across)) take_lanes(&plane, &flat, p);
}

void principal_join(const struct principal *p, const VECTOR value[3], VECTOR stress[6])
{
  VECTOR low = VECTOR_SELECT(p->low, value[1], value[0]), high = VECTOR_SELECT(p->high, value[1], value[2]);
  VECTOR alone = VECTOR_SELECT(p->low, value[0], VECTOR_SELECT(p->high, value[2], value[1]));
  VECTOR centre = 0.5 * (low + high), half = 0.5 * (high - low);
  VECTOR stretch = VECTOR_SELECT(p->radius > 0.0, half / p->radius, p->radius);
  for (int k = 0; k < 6; k++) stress[k] = (alone - centre) * p->N[k] + stretch * p->B[k];
  for (int k = 0; k < 3; k++) stress[k] += centre;
}
