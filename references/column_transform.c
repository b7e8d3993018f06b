/* A saturated column with or without clear liquid above it, by Laplace transform in time: two exponential pairs in z,
 * closed at the top by the load and the liquid's impedance, brought back to time by a Fourier series. */
#include "references/column_waves.h"

#include <complex.h>

/* State of the column for one s: u(z) = sum over j of c[j] v[j] sinh(lambda[j] z)/cosh(lambda[j] H) */
struct transform {
  double complex lambda[2], v[2][2], c[2];
  double complex top, mu; /* pressure at the top of the column; wave number of the clear liquid, 1/m */
};

/* (lambda2 S - G) v = 0 with G = R s2 + C s */
static void exponents(const struct column_matrices *m, double complex s, struct transform *f)
{
  double complex g11 = m->r[0] * s * s + m->drag * s, g22 = m->r[1] * s * s + m->drag * s, g12 = -m->drag * s;
  double complex det = m->M * m->s22, middle = m->s11 * g22 + m->s22 * g11 - 2.0 * m->s12 * g12;
  double complex root = csqrt(middle * middle - 4.0 * det * (g11 * g22 - g12 * g12));
  double complex fast = 0.5 * (creal(middle * conj(root)) > 0 ? middle + root : middle - root) / det;
  double complex square[2] = {fast, (g11 * g22 - g12 * g12) / (det * fast)};
  for (int j = 0; j < 2; j++) {
    f->lambda[j] = csqrt(square[j]); /* real part >= 0 */
    f->v[j][0] = square[j] * m->s22 - g22;
    f->v[j][1] = g12 - square[j] * m->s12;
  }
}

/* sinh(lambda z)/cosh(lambda H) and its derivative by z */
static void shape(double complex lambda, double z, double H, double complex *value, double complex *slope)
{
  double complex up = cexp(lambda * (z - H)), down = cexp(-lambda * (z + H)), bottom = 1.0 + cexp(-2.0 * lambda * H);
  *value = (up - down) / bottom;
  *slope = lambda * (up + down) / bottom;
}

/* Top of the column: S du/dz = (-load, 0) - P (1 - n, n), and the clear liquid: P = Z (n u_f + (1 - n) u_s) */
static void close_top(const struct column_waves *c, const struct column_matrices *m, double complex s,
                      double complex load, struct transform *f)
{
  double         g[2] = {1.0 - c->pores.porosity, c->pores.porosity};
  double complex a[2][2], w[2], Z, det;
  f->mu = s * sqrt(c->pores.density / c->bulk_modulus);
  Z = c->water > 0.0 ? c->bulk_modulus * f->mu * ctanh(f->mu * c->water) : 0.0;
  for (int j = 0; j < 2; j++) {
    double complex value, slope;
    shape(f->lambda[j], c->height, c->height, &value, &slope);
    w[j] = value * (g[0] * f->v[j][0] + g[1] * f->v[j][1]);
    a[0][j] = slope * (m->s11 * f->v[j][0] + m->s12 * f->v[j][1]) + Z * w[j] * g[0];
    a[1][j] = slope * (m->s12 * f->v[j][0] + m->s22 * f->v[j][1]) + Z * w[j] * g[1];
  }
  det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
  f->c[0] = -load * a[1][1] / det;
  f->c[1] = load * a[1][0] / det;
  f->top = Z * (f->c[0] * w[0] + f->c[1] * w[1]);
}

/* transforms of pressure, displacement and effective stress at z */
static void evaluate(const struct column_waves *c, const struct column_matrices *m, const struct transform *f, double z,
                     double complex out[3])
{
  double complex u = 0.0, du = 0.0, dw = 0.0;
  for (int j = 0; j < 2; j++) {
    double complex value, slope;
    shape(f->lambda[j], fmin(z, c->height), c->height, &value, &slope);
    u += f->c[j] * f->v[j][0] * value;
    du += f->c[j] * f->v[j][0] * slope;
    dw += f->c[j] * ((1.0 - c->pores.porosity) * f->v[j][0] + c->pores.porosity * f->v[j][1]) * slope;
  }
  out[0] = -c->bulk_modulus / c->pores.porosity * dw;
  out[1] = u;
  out[2] = m->M * du;
  if (z > c->height) /* sinh(mu (top - z))/sinh(mu water), the pressure falls to 0 at the free surface */
    out[0] = f->top * csinh(f->mu * (c->height + c->water - z)) / csinh(f->mu * c->water);
}

static double complex transformed_load(const struct column_waves *c, double complex s)
{
  return c->ramp > 0.0 ? c->load * (1.0 - cexp(-s * c->ramp)) / (c->ramp * s * s) : c->load / s;
}

/* Terms of the series: enough for 160 times the slowest fast wave, so that fronts are sharp to H/160. */
static int series_terms(const struct column_waves *c, const struct column_matrices *m, double period)
{
  double highest = 160.0 * 0.5 * M_PI * m->speed / (c->height + c->water);
  return (int)fmin(fmax(highest * period / M_PI, 2000.0), 40000.0);
}

static void add_term(const struct column_waves *c, const struct column_matrices *m, double complex s,
                     double complex factor, int n, const double *z, struct column_state *state)
{
  struct transform f;
  exponents(m, s, &f);
  close_top(c, m, s, transformed_load(c, s), &f);
  for (int i = 0; i < n; i++) {
    double complex out[3];
    evaluate(c, m, &f, z[i], out);
    state[i].pressure += creal(factor * out[0]);
    state[i].displacement += creal(factor * out[1]);
    state[i].stress += creal(factor * out[2]);
  }
}

/* f(t) = exp(sigma t)/T [F(sigma)/2 + sum of Re F(sigma + i k pi/T) exp(i k pi t/T)], error exp(-2 sigma T), with
 * Lanczos' factors against Gibbs' ripples (Dubner and Abate 1968, Durbin 1974). */
void column_transform_states(const struct column_waves *c, int n, const double *z, double t, struct column_state *state)
{
  struct column_matrices m;
  double                 T = 2.0 * t, sigma = 8.0 / T;
  int                    terms;
  column_matrices_make(c, &m);
  terms = series_terms(c, &m, T);
  for (int i = 0; i < n; i++) state[i] = (struct column_state){0};
  for (int k = 0; k <= terms; k++) {
    double         x = M_PI * k / (terms + 1.0), lanczos = k ? sin(x) / x : 0.5;
    double complex s = sigma + I * (M_PI * k / T);
    add_term(c, &m, s, exp(sigma * t) / T * lanczos * cexp(I * (M_PI * k * t / T)), n, z, state);
  }
}
