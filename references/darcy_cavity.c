/* Steady free convection in a square of a porous medium, hot at x = 0, cold at x = L, insulated below and above,
 * Darcy's law with Boussinesq's buoyancy and one temperature: lap psi = -Ra dT/dx, u . grad T = lap T in units of L, of
 * the difference of temperatures and of diffusivity/L for the flux u = (dpsi/dy, -dpsi/dx). Chebyshev collocation; both
 * equations relaxed together in steps whose operator factors along the axes. docs/references.md, "Darcy cavity". */
#include "references/reference.h"

#include <string.h>

enum { N = 24, P = N + 1, INNER = N - 1, MOST_STEPS = 20000, QUADRATURE = 64 };

struct cavity {
  double rayleigh, length, diffusivity, conductivity, hot, cold, porosity;
};

static const struct param params[] = {
    {"rayleigh", PARAM_NUMBER, offsetof(struct cavity, rayleigh), "-", 0, 200, NULL, NULL,
     "g beta (hot - cold) kappa L/(nu diffusivity)"},
    {"length", PARAM_NUMBER, offsetof(struct cavity, length), "m", 1e-9, 1e9, "1", NULL, "side L of the square"},
    {"diffusivity", PARAM_NUMBER, offsetof(struct cavity, diffusivity), "m2/s", 1e-15, 1e6, "1", NULL,
     "conductivity of the medium over the liquid's heat capacity per volume"},
    {"conductivity", PARAM_NUMBER, offsetof(struct cavity, conductivity), "W/(m K)", 1e-12, 1e12, "1", NULL,
     "of the medium, for heat"},
    {"hot", PARAM_NUMBER, offsetof(struct cavity, hot), "K", -1e9, 1e9, "1", NULL, "temperature at x = 0"},
    {"cold", PARAM_NUMBER, offsetof(struct cavity, cold), "K", -1e9, 1e9, "0", NULL, "temperature at x = L"},
    {"porosity", PARAM_NUMBER, offsetof(struct cavity, porosity), "-", 1e-3, 1, "1", NULL,
     "velocities are those of the pores: flux over porosity"},
    PARAM_END,
};

/* heat: W through every section x, per metre of thickness; turning: m/s, mean of vel_x over the lower half of x = L/2
 */
enum { NUSSELT, PSI_CENTRE, TEMPERATURE, VEL_X, VEL_Y, HEAT, TURNING };

/* Values at the places s[i] = (1 - cos(pi i/N))/2 along both axes, [x][y]. */
struct solution {
  double s[P], D[P][P], T[P][P], psi[P][P];
};

/* what one axis needs: second derivative of inner values under its end conditions, and (1 - step second)^-1 */
struct axis {
  double second[INNER][INNER], inverse[INNER][INNER];
};

/* derivative at the places, Trefethen's formula on [0, 1] */
static void differentiate(struct solution *q)
{
  for (int i = 0; i < P; i++) q->s[i] = 0.5 * (1 - cos(M_PI * i / N));
  for (int i = 0; i < P; i++) {
    q->D[i][i] = 0;
    for (int j = 0; j < P; j++) {
      if (i == j) continue;
      double c = (i % N ? 1 : 2) * ((i + j) % 2 ? -1 : 1) / (j % N ? 1.0 : 2.0);
      q->D[i][j] = c / (q->s[i] - q->s[j]);
      q->D[i][i] -= q->D[i][j];
    }
  }
}

/* Gauss-Jordan with pivoting; A [INNER][INNER] is used up */
static void invert(double A[INNER][INNER], double B[INNER][INNER])
{
  for (int i = 0; i < INNER; i++)
    for (int j = 0; j < INNER; j++) B[i][j] = i == j;
  for (int k = 0; k < INNER; k++) {
    int p = k;
    for (int i = k; i < INNER; i++) p = fabs(A[i][k]) > fabs(A[p][k]) ? i : p;
    for (int j = 0; j < INNER; j++) {
      double a = A[k][j], b = B[k][j];
      A[k][j] = A[p][j];
      A[p][j] = a;
      B[k][j] = B[p][j];
      B[p][j] = b;
    }
    double pivot = A[k][k];
    for (int j = 0; j < INNER; j++) {
      A[k][j] /= pivot;
      B[k][j] /= pivot;
    }
    for (int i = 0; i < INNER; i++) {
      double f = i == k ? 0 : A[i][k];
      for (int j = 0; j < INNER && f != 0; j++) {
        A[i][j] -= f * A[k][j];
        B[i][j] -= f * B[k][j];
      }
    }
  }
}

/* ends[2][INNER]: value at either end as a combination of inner ones, for zero slope there */
static void find_ends(const struct solution *q, double ends[2][INNER])
{
  double a = q->D[0][0], b = q->D[0][N], c = q->D[N][0], d = q->D[N][N], det = a * d - b * c;
  for (int j = 0; j < INNER; j++) {
    double low = -q->D[0][j + 1], high = -q->D[N][j + 1];
    ends[0][j] = (d * low - b * high) / det;
    ends[1][j] = (a * high - c * low) / det;
  }
}

/* insulated: zero slope at both ends, else zero value */
static void make_axis(const struct solution *q, bool insulated, double step, struct axis *a)
{
  double ends[2][INNER] = {{0}}, whole[P][P], work[INNER][INNER];
  if (insulated) find_ends(q, ends);
  for (int i = 0; i < P; i++)
    for (int j = 0; j < P; j++) {
      whole[i][j] = 0;
      for (int k = 0; k < P; k++) whole[i][j] += q->D[i][k] * q->D[k][j];
    }
  for (int i = 0; i < INNER; i++)
    for (int j = 0; j < INNER; j++) {
      a->second[i][j] = whole[i + 1][j + 1] + whole[i + 1][0] * ends[0][j] + whole[i + 1][N] * ends[1][j];
      work[i][j] = (i == j) - step * a->second[i][j];
    }
  invert(work, a->inverse);
}

static double along_x(const struct solution *q, double f[P][P], int i, int j)
{
  double sum = 0;
  for (int k = 0; k < P; k++) sum += q->D[i][k] * f[k][j];
  return sum;
}

static double along_y(const struct solution *q, double f[P][P], int i, int j)
{
  double sum = 0;
  for (int k = 0; k < P; k++) sum += q->D[j][k] * f[i][k];
  return sum;
}

/* A times f along x plus f times B along y; inner values */
static void second_of(const struct axis *x, const struct axis *y, double f[INNER][INNER], double out[INNER][INNER])
{
  for (int i = 0; i < INNER; i++)
    for (int j = 0; j < INNER; j++) {
      out[i][j] = 0;
      for (int k = 0; k < INNER; k++) out[i][j] += x->second[i][k] * f[k][j] + y->second[j][k] * f[i][k];
    }
}

/* f += step (1 - step d2/dx2)^-1 (1 - step d2/dy2)^-1 rest; returns the largest of rest */
static double relax(const struct axis *x, const struct axis *y, double step, double rest[INNER][INNER],
                    double f[INNER][INNER])
{
  double half[INNER][INNER], most = 0;
  for (int i = 0; i < INNER; i++)
    for (int j = 0; j < INNER; j++) {
      half[i][j] = 0;
      for (int k = 0; k < INNER; k++) half[i][j] += x->inverse[i][k] * rest[k][j];
      most = fmax(most, fabs(rest[i][j]));
    }
  for (int i = 0; i < INNER; i++)
    for (int j = 0; j < INNER; j++)
      for (int k = 0; k < INNER; k++) f[i][j] += step * y->inverse[j][k] * half[i][k];
  return most;
}

/* whole fields from inner values: psi is zero at the walls; T = 1 - x + inner, with zero slope at y = 0, 1 */
static void spread(struct solution *q, double psi[INNER][INNER], double warm[INNER][INNER])
{
  double ends[2][INNER];
  find_ends(q, ends);
  memset(q->psi, 0, sizeof q->psi);
  for (int i = 0; i < P; i++)
    for (int j = 0; j < P; j++) q->T[i][j] = 1 - q->s[i];
  for (int i = 0; i < INNER; i++)
    for (int j = 0; j < INNER; j++) {
      q->psi[i + 1][j + 1] = psi[i][j];
      q->T[i + 1][j + 1] += warm[i][j];
      q->T[i + 1][0] += ends[0][j] * warm[i][j];
      q->T[i + 1][N] += ends[1][j] * warm[i][j];
    }
}

static enum status solve(double Ra, struct solution *q)
{
  const double step = 0.0015;
  struct axis  fixed, insulated;
  double       psi[INNER][INNER] = {{0}}, warm[INNER][INNER] = {{0}}, curl[INNER][INNER], heat[INNER][INNER], left = 1;
  differentiate(q);
  make_axis(q, false, step, &fixed);
  make_axis(q, true, step, &insulated);
  for (int n = 0; n < MOST_STEPS && left > 1e-9 * (1 + Ra); n++) {
    spread(q, psi, warm);
    second_of(&fixed, &fixed, psi, curl);
    second_of(&fixed, &insulated, warm, heat);
    for (int i = 0; i < INNER; i++)
      for (int j = 0; j < INNER; j++) {
        double Tx = along_x(q, q->T, i + 1, j + 1), Ty = along_y(q, q->T, i + 1, j + 1);
        curl[i][j] += Ra * Tx;
        heat[i][j] -= along_y(q, q->psi, i + 1, j + 1) * Tx - along_x(q, q->psi, i + 1, j + 1) * Ty;
      }
    left = relax(&fixed, &fixed, step, curl, psi);
    left = fmax(left, relax(&fixed, &insulated, step, heat, warm));
  }
  spread(q, psi, warm);
  if (left <= 1e-9 * (1 + Ra)) return OK;
  return FAIL(ERR_INPUT, "darcy_cavity: no steady state found at rayleigh %g", Ra);
}

/* weights of the values at the places for a value at s, barycentric */
static void weigh(const struct solution *q, double s, double w[P])
{
  double sum = 0;
  for (int i = 0; i < P; i++) {
    double d = s - q->s[i];
    if (fabs(d) < 1e-14) {
      for (int k = 0; k < P; k++) w[k] = k == i;
      return;
    }
    w[i] = (i % 2 ? -1 : 1) * (i % N ? 1 : 0.5) / d;
    sum += w[i];
  }
  for (int i = 0; i < P; i++) w[i] /= sum;
}

static double interpolate(const struct solution *q, double f[P][P], double x, double y)
{
  double a[P], b[P], sum = 0;
  weigh(q, x, a);
  weigh(q, y, b);
  for (int i = 0; i < P; i++)
    for (int j = 0; j < P; j++) sum += a[i] * b[j] * f[i][j];
  return sum;
}

/* heat through the middle x = L/2, as much as through the walls, over what would be conducted; Gauss-Chebyshev places
 * with the weights of ds */
static double nusselt(struct solution *q)
{
  double flux[P][P], sum = 0;
  for (int i = 0; i < P; i++)
    for (int j = 0; j < P; j++) flux[i][j] = along_y(q, q->psi, i, j) * q->T[i][j] - along_x(q, q->T, i, j);
  for (int k = 0; k < QUADRATURE; k++) {
    double angle = M_PI * (k + 0.5) / QUADRATURE, weight = 0;
    for (int m = 0; m < QUADRATURE; m += 2) weight += (m ? 2 : 1) * cos(m * angle) / (1.0 - m * m);
    sum += weight / QUADRATURE * interpolate(q, flux, 0.5, 0.5 * (1 - cos(angle)));
  }
  return sum;
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  const struct cavity *c = prm;
  struct solution      q;
  double               field[P][P], speed = c->diffusivity / (c->length * c->porosity), one;
  (void)t;
  TRY(solve(c->rayleigh, &q));
  for (int i = 0; i < P; i++)
    for (int j = 0; j < P; j++)
      field[i][j] = quantity == TEMPERATURE ? c->cold + (c->hot - c->cold) * q.T[i][j]
                    : quantity == VEL_X     ? along_y(&q, q.psi, i, j) * speed
                                            : -along_x(&q, q.psi, i, j) * speed;
  one = quantity == NUSSELT      ? nusselt(&q)
        : quantity == HEAT       ? nusselt(&q) * c->conductivity * (c->hot - c->cold)
        : quantity == PSI_CENTRE ? interpolate(&q, q.psi, 0.5, 0.5) * c->diffusivity
                                 : interpolate(&q, q.psi, 0.5, 0.5) * 2 * speed;
  bool everywhere = quantity == TEMPERATURE || quantity == VEL_X || quantity == VEL_Y;
  for (int i = 0; i < n; i++)
    v[i] = everywhere ? interpolate(&q, field, x[i][0] / c->length, x[i][1] / c->length) : one;
  return OK;
}

/* the difference of temperatures; for velocities the diffusivity over the length times the largest of conduction alone
 */
static double scale(const void *prm, int quantity)
{
  const struct cavity *c = prm;
  struct solution      q;
  double               most = 0;
  if (quantity == TEMPERATURE) return fabs(c->hot - c->cold);
  if (solve(c->rayleigh, &q) != OK) return 1;
  for (int i = 0; i < P; i++) /* where midlines meet the walls */
    most = fmax(most, fabs(quantity == VEL_X ? along_y(&q, q.psi, N / 2, i) : along_x(&q, q.psi, i, N / 2)));
  return most * c->diffusivity / (c->length * c->porosity);
}

const struct reference reference_darcy_cavity = {
    .name = "darcy_cavity",
    .source = "Chebyshev collocation of the stream function",
    .params = params,
    .param_size = sizeof(struct cavity),
    .quantities = "nusselt|psi_centre|temperature|vel_x|vel_y|heat|turning",
    .value = value,
    .scale = scale,
};
