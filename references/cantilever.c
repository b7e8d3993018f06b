/* Spectral elements in the undeformed body: nodes at the points of Gauss and Lobatto, which are also those of the
 * quadrature, so that the mass is diagonal. Central differences in time. docs/references.md, "Cantilever". */
#include "references/cantilever.h"

#include "core/memory.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { MOST = 9 }; /* nodes per axis of an element */

struct mesh {
  const struct cantilever *c;
  int                      p1, nodes[2];     /* nodes per axis: of an element, of the body */
  double                   z[MOST], w[MOST]; /* places in [-1, 1], weights */
  double                   D[MOST][MOST];    /* derivative of function j at place i */
  double                   size[2];          /* m, of an element */
  double                   lambda, mu;       /* Pa */
  double (*u)[2], (*v)[2], (*f)[2], *mass;   /* m, m/s, N, kg per metre */
};

/* Legendre polynomial of degree p at z, and its derivative */
static double legendre(int p, double z, double *slope)
{
  double before = 1, now = z, d_before = 0, d_now = 1;
  for (int k = 2; k <= p; k++) {
    double next = ((2 * k - 1) * z * now - (k - 1) * before) / k, d_next = d_before + (2 * k - 1) * now;
    before = now;
    now = next;
    d_before = d_now;
    d_now = d_next;
  }
  *slope = d_now;
  return now;
}

/* places: the ends and the zeros of the derivative, by Newton's method from Chebyshev's places; weights 2/(p (p + 1)
 * L^2)
 */
static void lobatto(struct mesh *m)
{
  int          p = m->p1 - 1;
  double       slope;
  const double pi = acos(-1.0);
  for (int i = 0; i <= p; i++) {
    double z = -cos(pi * i / p);
    for (int k = 0; k < 50 && i > 0 && i < p; k++) {
      double L = legendre(p, z, &slope), curve = (2 * z * slope - p * (p + 1) * L) / (1 - z * z);
      z -= slope / curve;
    }
    double L = legendre(p, z, &slope);
    m->z[i] = z;
    m->w[i] = 2 / (p * (p + 1) * L * L);
  }
  for (int i = 0; i <= p; i++)
    for (int j = 0; j <= p; j++) {
      double Li = legendre(p, m->z[i], &slope), Lj = legendre(p, m->z[j], &slope);
      m->D[i][j] = i != j   ? Li / (Lj * (m->z[i] - m->z[j]))
                   : i == 0 ? -0.25 * p * (p + 1)
                   : i == p ? 0.25 * p * (p + 1)
                            : 0;
    }
}

static long node_of(const struct mesh *m, int ex, int ey, int i, int j)
{
  return (long)(ey * (m->p1 - 1) + j) * m->nodes[0] + ex * (m->p1 - 1) + i;
}

/* u of the nodes, gradient of u at a place, row i column j = du_i/dx_j */
static void gradient(const struct mesh *m, double (*u)[MOST][2], int i, int j, double G[2][2])
{
  memset(G, 0, 4 * sizeof(double));
  for (int k = 0; k < m->p1; k++)
    for (int d = 0; d < 2; d++) {
      G[d][0] += m->D[i][k] * u[j][k][d] * 2 / m->size[0];
      G[d][1] += m->D[j][k] * u[k][i][d] * 2 / m->size[1];
    }
}

/* first Piola stress of M(15): lambda ln J F^-T + mu (F - F^-T); energy per volume; false: J <= 0 */
static bool piola(const struct mesh *m, double G[2][2], double P[2][2], double *energy)
{
  double F[2][2] = {{1 + G[0][0], G[0][1]}, {G[1][0], 1 + G[1][1]}};
  double J = F[0][0] * F[1][1] - F[0][1] * F[1][0], l = log(J), square = 0;
  double back[2][2] = {{F[1][1] / J, -F[1][0] / J}, {-F[0][1] / J, F[0][0] / J}}; /* F^-T */
  if (!(J > 0)) return false;
  for (int a = 0; a < 2; a++)
    for (int b = 0; b < 2; b++) {
      P[a][b] = m->mu * F[a][b] + (m->lambda * l - m->mu) * back[a][b];
      square += F[a][b] * F[a][b];
    }
  *energy = 0.5 * m->lambda * l * l - m->mu * l + 0.5 * m->mu * (square - 2);
  return true;
}

/* forces of one element; its elastic energy is added */
static bool element(struct mesh *m, int ex, int ey, double *energy)
{
  double u[MOST][MOST][2], f[MOST][MOST][2] = {{{0}}}, area = 0.25 * m->size[0] * m->size[1];
  for (int j = 0; j < m->p1; j++)
    for (int i = 0; i < m->p1; i++) memcpy(u[j][i], m->u[node_of(m, ex, ey, i, j)], sizeof u[j][i]);
  for (int j = 0; j < m->p1; j++)
    for (int i = 0; i < m->p1; i++) {
      double G[2][2], P[2][2], own, weight = m->w[i] * m->w[j] * area;
      gradient(m, u, i, j, G);
      if (!piola(m, G, P, &own)) return false;
      *energy += weight * own;
      for (int k = 0; k < m->p1; k++)
        for (int d = 0; d < 2; d++) {
          f[j][k][d] -= weight * P[d][0] * m->D[i][k] * 2 / m->size[0];
          f[k][i][d] -= weight * P[d][1] * m->D[j][k] * 2 / m->size[1];
        }
    }
  for (int j = 0; j < m->p1; j++)
    for (int i = 0; i < m->p1; i++)
      for (int d = 0; d < 2; d++) m->f[node_of(m, ex, ey, i, j)][d] += f[j][i][d];
  return true;
}

static enum status forces(struct mesh *m, double *energy)
{
  long n = (long)m->nodes[0] * m->nodes[1];
  for (long q = 0; q < n; q++) {
    m->f[q][0] = 0;
    m->f[q][1] = -m->mass[q] * m->c->gravity;
  }
  *energy = 0;
  for (int ey = 0; ey < m->c->n[1]; ey++)
    for (int ex = 0; ex < m->c->n[0]; ex++)
      if (!element(m, ex, ey, energy))
        return FAIL(ERR_DIVERGED, "cantilever: element (%d, %d) turned inside out; take more elements", ex, ey);
  for (int j = 0; j < m->nodes[1]; j++) memset(m->f[(long)j * m->nodes[0]], 0, sizeof *m->f); /* held at x = 0 */
  return OK;
}

static enum status create(const struct cantilever *c, struct mesh *m)
{
  *m = (struct mesh){.c = c, .p1 = c->order + 1};
  m->lambda = c->young * c->poisson / ((1 + c->poisson) * (1 - 2 * c->poisson));
  m->mu = 0.5 * c->young / (1 + c->poisson);
  for (int d = 0; d < 2; d++) {
    m->nodes[d] = c->n[d] * c->order + 1;
    m->size[d] = (d ? c->height : c->length) / c->n[d];
  }
  lobatto(m);
  long n = (long)m->nodes[0] * m->nodes[1];
  TRY(NEW(&m->u, n));
  TRY(NEW(&m->v, n));
  TRY(NEW(&m->f, n));
  TRY(NEW(&m->mass, n));
  for (int ey = 0; ey < c->n[1]; ey++)
    for (int ex = 0; ex < c->n[0]; ex++)
      for (int j = 0; j < m->p1; j++)
        for (int i = 0; i < m->p1; i++)
          m->mass[node_of(m, ex, ey, i, j)] += m->w[i] * m->w[j] * 0.25 * m->size[0] * m->size[1] * c->density;
  return OK;
}

static void destroy(struct mesh *m)
{
  memory_free(&m->u);
  memory_free(&m->v);
  memory_free(&m->f);
  memory_free(&m->mass);
}

/* s: the elastic wave over the smallest distance of nodes, with a margin for what is compressed, and so that time adds
 * nothing to the error of space */
static double step_limit(const struct mesh *m)
{
  double spacing = 0.5 * (m->z[1] - m->z[0]) * fmin(m->size[0], m->size[1]);
  return 0.2 * spacing / sqrt((m->lambda + 2 * m->mu) / m->c->density);
}

static void sample(const struct mesh *m, double t, double elastic, struct cantilever_sample *s)
{
  long n = (long)m->nodes[0] * m->nodes[1], tip = (long)(m->nodes[1] / 2 + 1) * m->nodes[0] - 1;
  *s = (struct cantilever_sample){.t = t, .energy = elastic};
  memcpy(s->tip, m->u[tip], sizeof s->tip);
  for (long q = 0; q < n; q++)
    s->energy += m->mass[q] * (0.5 * (m->v[q][0] * m->v[q][0] + m->v[q][1] * m->v[q][1]) + m->c->gravity * m->u[q][1]);
}

/* half a step of velocity: velocities of the samples live at their time */
static void kick(struct mesh *m, double dt)
{
  long n = (long)m->nodes[0] * m->nodes[1];
  for (long q = 0; q < n; q++)
    for (int d = 0; d < 2; d++) m->v[q][d] += 0.5 * dt * m->f[q][d] / m->mass[q];
}

static enum status step(struct mesh *m, double dt, double *elastic)
{
  long n = (long)m->nodes[0] * m->nodes[1];
  kick(m, dt);
  for (long q = 0; q < n; q++)
    for (int d = 0; d < 2; d++) m->u[q][d] += dt * m->v[q][d];
  TRY(forces(m, elastic));
  kick(m, dt);
  return OK;
}

static enum status march(struct mesh *m, double interval, int n_samples, struct cantilever_sample *samples)
{
  int    steps = (int)ceil(interval / step_limit(m));
  double elastic;
  TRY(forces(m, &elastic));
  for (int i = 0; i < n_samples; i++) {
    for (int k = 0; k < steps && i > 0; k++) TRY(step(m, interval / steps, &elastic));
    sample(m, i * interval, elastic, &samples[i]);
  }
  return OK;
}

enum status cantilever_solve(const struct cantilever *c, double interval, int n_samples,
                             struct cantilever_sample *samples)
{
  struct mesh m;
  enum status status = OK;
  if (c->order < 1 || c->order >= MOST || c->n[0] < 1 || c->n[1] < 1 || c->n[1] * c->order % 2 != 0)
    return FAIL(ERR_INPUT,
                "cantilever: %d x %d elements of order %d have no node in the middle of the end; take even "
                "numbers and an order from 1 to %d",
                c->n[0], c->n[1], c->order, MOST - 1);
  status = create(c, &m);
  if (status == OK) status = march(&m, interval, n_samples, samples);
  destroy(&m);
  return status;
}
