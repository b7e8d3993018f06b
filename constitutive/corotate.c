/* Polar decomposition of a step for groups of points. Small steps take a series in E = dF^T dF - I, which is vector
 * code; large ones, eigenvalues. Where nothing moves across the plane xy all is 2 x 2. */
#include "constitutive/corotate.h"

#include "constitutive/vector.h"

/* Above |E| (Frobenius) = SMALL_STRETCH series of TERMS terms lose digits, above MEDIUM_STRETCH those of MORE_TERMS;
 * beyond |dF - I| = 1 it may be a reflection. */
#define SMALL_STRETCH 0.02
#define MEDIUM_STRETCH 0.12
#define SMALL_TURN 1.0
enum { TERMS = 9, MORE_TERMS = 20 };

/* A step of a group: G = dF - I, E, E2 = E E, |E|^2 and |G|^2. */
struct step {
  VECTOR G[9], E[6], E2[6], stretch2, turn2;
};

/* A polynomial of E is a I + b E + c E^2 (Cayley-Hamilton). */
struct polynomial {
  VECTOR a, b, c;
};

static void load(int m, const double *dF, const double *stress, struct step *s, struct corotate_group *g)
{
  double own_dF[9 * LANES] = {0}, own_stress[6 * LANES] = {0};
  if (m < LANES) { /* the others do not move */
    memcpy(own_dF, dF, (size_t)(9 * m) * sizeof *dF);
    memcpy(own_stress, stress, (size_t)(6 * m) * sizeof *stress);
    for (int i = m; i < LANES; i++) own_dF[9 * i] = own_dF[9 * i + 4] = own_dF[9 * i + 8] = 1;
    dF = own_dF, stress = own_stress;
  }
  for (int k = 0; k < 9; k++) vector_gather(dF, 9, k, &s->G[k]);
  for (int k = 0; k < 9; k += 4) s->G[k] -= 1.0;
  for (int k = 0; k < 6; k++) vector_gather(stress, 6, k, &g->stress[k]);
}

/* E = G + G^T + G^T G */
static void stretch(struct step *s)
{
  const VECTOR *G = s->G;
  s->E[XX] = 2.0 * G[0] + (G[0] * G[0] + G[3] * G[3] + G[6] * G[6]);
  s->E[YY] = 2.0 * G[4] + (G[1] * G[1] + G[4] * G[4] + G[7] * G[7]);
  s->E[ZZ] = 2.0 * G[8] + (G[2] * G[2] + G[5] * G[5] + G[8] * G[8]);
  s->E[XY] = G[1] + G[3] + (G[0] * G[1] + G[3] * G[4] + G[6] * G[7]);
  s->E[YZ] = G[5] + G[7] + (G[1] * G[2] + G[4] * G[5] + G[7] * G[8]);
  s->E[XZ] = G[2] + G[6] + (G[0] * G[2] + G[3] * G[5] + G[6] * G[8]);
}

static void square(struct step *s)
{
  const VECTOR *E = s->E;
  s->E2[XX] = E[XX] * E[XX] + E[XY] * E[XY] + E[XZ] * E[XZ];
  s->E2[YY] = E[XY] * E[XY] + E[YY] * E[YY] + E[YZ] * E[YZ];
  s->E2[ZZ] = E[XZ] * E[XZ] + E[YZ] * E[YZ] + E[ZZ] * E[ZZ];
  s->E2[XY] = E[XX] * E[XY] + E[XY] * E[YY] + E[XZ] * E[YZ];
  s->E2[YZ] = E[XY] * E[XZ] + E[YY] * E[YZ] + E[YZ] * E[ZZ];
  s->E2[XZ] = E[XX] * E[XZ] + E[XY] * E[YZ] + E[XZ] * E[ZZ];
  s->stretch2 = s->E2[XX] + s->E2[YY] + s->E2[ZZ];
  s->turn2 = (E[XX] + E[YY] + E[ZZ]) - 2.0 * (s->G[0] + s->G[4] + s->G[8]);
}

/* log(1 + E)/2 and (1 + E)^(-1/2) */
static const double logarithm[MORE_TERMS + 1] = {
    0,        1.0 / 2,   -1.0 / 4, 1.0 / 6,   -1.0 / 8, 1.0 / 10,  -1.0 / 12, 1.0 / 14,  -1.0 / 16, 1.0 / 18, -1.0 / 20,
    1.0 / 22, -1.0 / 24, 1.0 / 26, -1.0 / 28, 1.0 / 30, -1.0 / 32, 1.0 / 34,  -1.0 / 36, 1.0 / 38,  -1.0 / 40};
static const double root[MORE_TERMS + 1] = {1,
                                            -1.0 / 2,
                                            3.0 / 8,
                                            -5.0 / 16,
                                            35.0 / 128,
                                            -63.0 / 256,
                                            231.0 / 1024,
                                            -429.0 / 2048,
                                            6435.0 / 32768,
                                            -12155.0 / 65536,
                                            46189.0 / 262144,
                                            -88179.0 / 524288,
                                            676039.0 / 4194304,
                                            -1300075.0 / 8388608,
                                            5014575.0 / 33554432,
                                            -9694845.0 / 67108864,
                                            300540195.0 / 2147483648,
                                            -583401555.0 / 4294967296,
                                            2268783825.0 / 17179869184,
                                            -4418157975.0 / 34359738368,
                                            34461632205.0 / 274877906944};

/* log U = log(I + E)/2 and U^-1 = (I + E)^(-1/2) by Horner with E^3 = i1 E^2 - i2 E + i3 I */
static void series(const struct step *s, int terms, struct polynomial *log_U, struct polynomial *U_inverse)
{
  const VECTOR     *E = s->E;
  VECTOR            yz = E[YY] * E[ZZ] - E[YZ] * E[YZ];
  VECTOR            i1 = E[XX] + E[YY] + E[ZZ];
  VECTOR            i2 = (E[XX] * E[YY] - E[XY] * E[XY]) + yz + (E[XX] * E[ZZ] - E[XZ] * E[XZ]);
  VECTOR            i3 = E[XX] * yz - E[XY] * (E[XY] * E[ZZ] - E[YZ] * E[XZ]) + E[XZ] * (E[XY] * E[YZ] - E[YY] * E[XZ]);
  struct polynomial l, r;
  memset(&l, 0, sizeof l);
  memset(&r, 0, sizeof r);
  for (int k = terms; k >= 0; k--) {
    VECTOR a = l.a, b = l.b, ra = r.a, rb = r.b;
    l.a = logarithm[k] + l.c * i3;
    r.a = root[k] + r.c * i3;
    l.b = a - l.c * i2;
    r.b = ra - r.c * i2;
    l.c = b + l.c * i1;
    r.c = rb + r.c * i1;
  }
  *log_U = l;
  *U_inverse = r;
}

static void evaluate(const struct step *s, const struct polynomial *p, VECTOR result[6])
{
  for (int k = 0; k < 6; k++) result[k] = p->b * s->E[k] + p->c * s->E2[k];
  for (int k = 0; k < 3; k++) result[k] += p->a;
}

/* R = dF U^-1 */
static void rotation(const struct step *s, const VECTOR U_inverse[6], VECTOR R[9])
{
  static const int at[9] = {XX, XY, XZ, XY, YY, YZ, XZ, YZ, ZZ};
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++)
      R[3 * r + c] =
          U_inverse[at[3 * r + c]] + (s->G[3 * r] * U_inverse[at[c]] + s->G[3 * r + 1] * U_inverse[at[3 + c]] +
                                      s->G[3 * r + 2] * U_inverse[at[6 + c]]);
}

static void decompose(struct step *s, int terms, struct corotate_group *g)
{
  struct polynomial log_U, U_root;
  VECTOR            U_inverse[6];
  stretch(s);
  square(s);
  series(s, terms, &log_U, &U_root);
  evaluate(s, &log_U, g->strain);
  evaluate(s, &U_root, U_inverse);
  rotation(s, U_inverse, g->R);
}

/* ---- motion in the plane ---- */

static void find_plane(const struct step *s, MASK *plane)
{
  *plane = (MASK)(s->G[2] == 0.0);
  for (int k = 5; k < 9; k++) *plane &= (MASK)(s->G[k] == 0.0);
}

/* The same where all points move in the plane. log U by Horner with E^2 = i1 E - i2 I; of the rotation the cosine goes
 * with dF_xx + dF_yy, the sine with dF_yx - dF_xy. */
static void decompose_plane(struct step *s, int terms, struct corotate_group *g)
{
  const VECTOR *G = s->G;
  VECTOR       *E = s->E, a = VECTOR_ALL(0.0), b = a, cosine = 2.0 + G[0] + G[4], sine = G[3] - G[1], length;
  E[XX] = 2.0 * G[0] + (G[0] * G[0] + G[3] * G[3]);
  E[YY] = 2.0 * G[4] + (G[1] * G[1] + G[4] * G[4]);
  E[XY] = G[1] + G[3] + (G[0] * G[1] + G[3] * G[4]);
  E[ZZ] = E[YZ] = E[XZ] = VECTOR_ALL(0.0);
  VECTOR i1 = E[XX] + E[YY], i2 = E[XX] * E[YY] - E[XY] * E[XY];
  s->stretch2 = E[XX] * E[XX] + E[YY] * E[YY] + 2.0 * E[XY] * E[XY];
  s->turn2 = i1 - 2.0 * (G[0] + G[4]);
  for (int k = terms; k >= 0; k--) {
    VECTOR last = a;
    a = logarithm[k] - b * i2;
    b = last + b * i1;
  }
  for (int k = 0; k < 6; k++) g->strain[k] = b * E[k];
  for (int k = 0; k < 2; k++) g->strain[k] += a;
  length = cosine * cosine + sine * sine;
  vector_sqrt(&length, &length);
  for (int k = 0; k < 9; k++) g->R[k] = VECTOR_ALL(k == 8);
  g->R[0] = g->R[4] = cosine / length;
  g->R[3] = sine / length;
  g->R[1] = -g->R[3];
}

/* takes the lanes of a mask from another group */
static void take_lanes(const MASK *mask, const struct corotate_group *other, struct corotate_group *g)
{
  for (int k = 0; k < 6; k++) g->strain[k] = VECTOR_SELECT(*mask, other->strain[k], g->strain[k]);
  for (int k = 0; k < 9; k++) g->R[k] = VECTOR_SELECT(*mask, other->R[k], g->R[k]);
}

/* some points move in the plane, some do not: each as in any other company */
static void decompose_both(struct step *s, int terms, struct corotate_group *g)
{
  struct step           flat = *s;
  struct corotate_group other;
  decompose(s, terms, g);
  decompose_plane(&flat, terms, &other);
  take_lanes(&g->plane, &other, g);
  for (int k = 0; k < 6; k++) s->E[k] = VECTOR_SELECT(g->plane, flat.E[k], s->E[k]);
  s->stretch2 = VECTOR_SELECT(g->plane, flat.stretch2, s->stretch2);
  s->turn2 = VECTOR_SELECT(g->plane, flat.turn2, s->turn2);
}

static void decompose_any(struct step *s, int terms, struct corotate_group *g)
{
  MASK across = ~g->plane;
  if (!vector_any(&across))
    decompose_plane(s, terms, g);
  else if (!vector_any(&g->plane))
    decompose(s, terms, g);
  else
    decompose_both(s, terms, g);
}

/* ---- large steps ---- */

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

/* Whether the series holds for lane i; not for NaN. */
static inline int is_small(const struct step *s, int i)
{
  return (s->stretch2[i] <= SMALL_STRETCH * SMALL_STRETCH) & (s->turn2[i] <= SMALL_TURN * SMALL_TURN);
}

static inline int all_small(const struct step *s)
{
  int small = 1;
  for (int i = 0; i < LANES; i++) small &= is_small(s, i);
  return small;
}

/* log U and R of a lane by eigenvalues; 0: there are none */
static int decompose_lane(const struct step *s, int i, struct corotate_group *g)
{
  static const int row[6] = {0, 1, 2, 0, 1, 0}, column[6] = {0, 1, 2, 1, 2, 2};
  double           dF[9], E[3][3], value[3], V[3][3], half_log[3], root[3], log_U[3][3], U_inverse[3][3];
  for (int k = 0; k < 9; k++) dF[k] = s->G[k][i] + (k % 4 == 0);
  double J = tensor_determinant(dF);
  if (!(J > 0.0) || isinf(J)) return 0;
  for (int k = 0; k < 6; k++) E[row[k]][column[k]] = E[column[k]][row[k]] = s->E[k][i];
  eigen(E, value, V);
  for (int k = 0; k < 3; k++) {
    if (!(value[k] > -1.0) || isinf(value[k])) return 0;
    half_log[k] = 0.5 * log1p(value[k]);
    root[k] = 1.0 / sqrt(1.0 + value[k]);
  }
  assemble(half_log, V, log_U);
  assemble(root, V, U_inverse);
  for (int k = 0; k < 6; k++) g->strain[k][i] = log_U[row[k]][column[k]];
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++)
      g->R[3 * r + c][i] =
          dF[3 * r] * U_inverse[0][c] + dF[3 * r + 1] * U_inverse[1][c] + dF[3 * r + 2] * U_inverse[2][c];
  return 1;
}

static void leave_unstrained(int i, struct corotate_group *g)
{
  for (int k = 0; k < 6; k++) g->strain[k][i] = 0.0;
  for (int k = 0; k < 9; k++) g->R[k][i] = k % 4 == 0;
}

/* points that need more terms, or eigenvalues; how many have neither */
static int decompose_large(int m, struct step *s, struct corotate_group *g)
{
  MASK medium = (MASK)(s->stretch2 > SMALL_STRETCH * SMALL_STRETCH) &
                (MASK)(s->stretch2 <= MEDIUM_STRETCH * MEDIUM_STRETCH) & (MASK)(s->turn2 <= SMALL_TURN * SMALL_TURN);
  int bad = 0;
  if (vector_any(&medium)) {
    struct corotate_group other = *g;
    decompose_any(s, MORE_TERMS, &other);
    take_lanes(&medium, &other, g);
  }
  for (int i = 0; i < m; i++)
    if (!is_small(s, i) && !medium[i] && !decompose_lane(s, i, g)) {
      leave_unstrained(i, g);
      bad++;
    }
  return bad;
}

int corotate_begin(int m, const double *dF, const double *stress, struct corotate_group *group)
{
  struct step s;
  load(m, dF, stress, &s, group);
  find_plane(&s, &group->plane);
  decompose_any(&s, TERMS, group);
  return all_small(&s) ? 0 : decompose_large(m, &s, group);
}

/* R S R^T */
static void turn(const VECTOR R[9], const VECTOR S[6], VECTOR turned[6])
{
  VECTOR T[9]; /* R S */
  for (int r = 0; r < 9; r += 3) {
    T[r] = R[r] * S[XX] + R[r + 1] * S[XY] + R[r + 2] * S[XZ];
    T[r + 1] = R[r] * S[XY] + R[r + 1] * S[YY] + R[r + 2] * S[YZ];
    T[r + 2] = R[r] * S[XZ] + R[r + 1] * S[YZ] + R[r + 2] * S[ZZ];
  }
  turned[XX] = T[0] * R[0] + T[1] * R[1] + T[2] * R[2];
  turned[YY] = T[3] * R[3] + T[4] * R[4] + T[5] * R[5];
  turned[ZZ] = T[6] * R[6] + T[7] * R[7] + T[8] * R[8];
  turned[XY] = T[0] * R[3] + T[1] * R[4] + T[2] * R[5];
  turned[YZ] = T[3] * R[6] + T[4] * R[7] + T[5] * R[8];
  turned[XZ] = T[0] * R[6] + T[1] * R[7] + T[2] * R[8];
}

/* the same in the plane, R = (c -s; s c) */
static void turn_plane(const VECTOR R[9], const VECTOR S[6], VECTOR turned[6])
{
  VECTOR c = R[0], s = R[3], gap = s * (s * (S[YY] - S[XX]) - 2.0 * (c * S[XY]));
  turned[XX] = S[XX] + gap;
  turned[YY] = S[YY] - gap;
  turned[ZZ] = S[ZZ];
  turned[XY] = c * s * (S[XX] - S[YY]) + (c * c - s * s) * S[XY];
  turned[YZ] = s * S[XZ] + c * S[YZ];
  turned[XZ] = c * S[XZ] - s * S[YZ];
}

void corotate_end(int m, struct corotate_group *group, double *stress)
{
  VECTOR turned[6], flat[6];
  MASK   across = ~group->plane;
  if (vector_any(&across)) turn(group->R, group->stress, turned);
  if (vector_any(&group->plane)) turn_plane(group->R, group->stress, flat);
  if (vector_any(&across) && vector_any(&group->plane))
    for (int k = 0; k < 6; k++) turned[k] = VECTOR_SELECT(group->plane, flat[k], turned[k]);
  else if (vector_any(&group->plane))
    memcpy(turned, flat, sizeof flat);
  for (int i = 0; i < m; i++)
    for (int k = 0; k < 6; k++) stress[6 * i + k] = turned[k][i];
}
