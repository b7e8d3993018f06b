/* A bare saturated column by its modes sin((m + 1/2) pi z/H): each is a pair of damped oscillators with a quartic
 * characteristic polynomial, whose four poles give the response to the load by residues. */
#include "references/column_waves.h"

#include <complex.h>

enum { POLES = 4 };

/* Q(s) = det(R s2 + C s + b2 S) = q[4] s^4 + ... + q[0] */
static void characteristic(const struct column_matrices *m, double b, double q[5])
{
  double b2 = b * b;
  q[4] = m->r[0] * m->r[1];
  q[3] = m->drag * (m->r[0] + m->r[1]);
  q[2] = b2 * (m->r[0] * m->s22 + m->r[1] * m->s11);
  q[1] = m->drag * b2 * (m->s11 + m->s22 + 2.0 * m->s12);
  q[0] = b2 * b2 * m->M * m->s22;
}

static double complex polynomial(const double *q, int degree, double complex s)
{
  double complex sum = 0.0;
  for (int k = degree; k >= 0; k--) sum = sum * s + q[k];
  return sum;
}

/* Durand-Kerner on the polynomial in s/w, w the geometric mean of the poles */
static void poles(const double q[5], double complex s[POLES])
{
  double w = pow(q[0] / q[4], 0.25), p[5], power = 1.0, change = 1.0;
  for (int k = 0; k <= 4; k++, power *= w) p[k] = q[k] * power;
  for (int k = 0; k <= 4; k++) p[k] /= q[4] * power / w;
  for (int i = 0; i < POLES; i++) s[i] = cpow(0.4 + 0.9 * I, i);
  for (int round = 0; round < 500 && change > 1e-15; round++) {
    change = 0.0;
    for (int i = 0; i < POLES; i++) {
      double complex product = 1.0, step;
      for (int j = 0; j < POLES; j++)
        if (j != i) product *= s[i] - s[j];
      step = polynomial(p, 4, s[i]) / product;
      s[i] -= step;
      change = fmax(change, cabs(step) / cabs(s[i]));
    }
  }
  for (int i = 0; i < POLES; i++) s[i] *= w;
}

/* What a load that grows to 1 within T (0: at once) leaves of a pole at time t, over Q'(s) */
static double complex weight(double complex s, double t, double T)
{
  if (T == 0.0) return cexp(s * t) / s;
  if (t < T) return cexp(s * t) / (s * s * T);
  return (cexp(s * t) - cexp(s * (t - T))) / (s * s * T);
}

/* Departure of one mode from its static value: solid displacement a and w = n liquid + (1 - n) solid, for a unit
 * force on the solid. Transforms A(s)/Q and W(s)/Q; while the ramp lasts the double pole at s = 0 leaves a rest. */
static void mode(const struct column_waves *c, const struct column_matrices *m, double b, double t, double *a,
                 double *w)
{
  double         q[5], slope[4], b2s22 = b * b * m->s22;
  double complex s[POLES], sum_a = 0.0, sum_w = 0.0;
  characteristic(m, b, q);
  poles(q, s);
  for (int k = 0; k < 4; k++) slope[k] = (k + 1) * q[k + 1];
  for (int i = 0; i < POLES; i++) {
    double complex share = weight(s[i], t, c->ramp) / polynomial(slope, 3, s[i]);
    sum_a += share * (m->r[1] * s[i] * s[i] + m->drag * s[i] + b2s22);
    sum_w += share * ((1.0 - c->pores.porosity) * m->r[1] * s[i] * s[i] + m->drag * s[i]);
  }
  if (t < c->ramp) {
    sum_a += (m->drag / q[0] - b2s22 * q[1] / (q[0] * q[0])) / c->ramp;
    sum_w += m->drag / q[0] / c->ramp;
  }
  *a = creal(sum_a), *w = creal(sum_w);
}

void column_modes_states(const struct column_waves *c, int n, const double *z, double t, struct column_state *state)
{
  struct column_matrices m;
  double                 now = c->ramp > 0.0 ? fmin(t / c->ramp, 1.0) * c->load : c->load;
  column_matrices_make(c, &m);
  for (int i = 0; i < n; i++) state[i] = (struct column_state){0.0, -now * z[i] / m.M, -now};
  for (int k = 0; k < c->terms; k++) {
    double b = (k + 0.5) * M_PI / c->height, force = (k % 2 ? 2.0 : -2.0) / c->height * c->load, a, w;
    mode(c, &m, b, t, &a, &w);
    for (int i = 0; i < n; i++) {
      state[i].displacement += force * a * sin(b * z[i]);
      state[i].stress += m.M * force * a * b * cos(b * z[i]);
      state[i].pressure -= c->bulk_modulus / c->pores.porosity * force * w * b * cos(b * z[i]);
    }
  }
}

void column_modes_fast_pole(const struct column_waves *c, double *angular, double *decay)
{
  struct column_matrices m;
  double                 q[5];
  double complex         s[POLES];
  column_matrices_make(c, &m);
  characteristic(&m, 0.5 * M_PI / c->height, q);
  poles(q, s);
  *angular = *decay = 0.0;
  for (int i = 0; i < POLES; i++)
    if (cimag(s[i]) > *angular) *angular = cimag(s[i]), *decay = -creal(s[i]);
}
