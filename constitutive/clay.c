/* The return is one equation for one number, bracketed: the flow rule, while pressure, hardening and ellipse hold
 * exactly for every trial of that number. */
#include "constitutive/clay.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

/* Exponents beyond, of pressures that no soil bears, are cut, so that squares stay finite. */
#define MOST 300.0

static double exp_cut(double x) { return exp(fmax(-MOST, fmin(MOST, x))); }

double clay_measure(const struct clay *c, double p) { return p >= c->floor ? log(p / c->floor) : p / c->floor - 1.0; }

double clay_pressure(const struct clay *c, double x) { return c->floor * (x >= 0.0 ? exp_cut(x) : 1.0 + x); }

/* Above the floor p/floor = exp x: the logarithmic mean, for close pressures by its series about the geometric one. */
double clay_secant(const struct clay *c, double p0, double x0, double p, double x)
{
  const double close = 1e-2;
  double       d = x - x0;
  if (x <= 0.0 && x0 <= 0.0) return c->floor;
  if (fabs(d) > close) return (p - p0) / d;
  if (x >= 0.0 && x0 >= 0.0) return sqrt(p * p0) * (1.0 + d * d / 24.0 * (1.0 + d * d / 80.0));
  return c->floor * (expm1(fmax(x, x0)) - fmin(x, x0)) / fabs(d);
}

double clay_length(const struct clay *c, double pc) { return fmax(pc, 2.0 * c->floor); }

/* The step with what follows from it. Plastic compression hardens, so that pc falls with p as p^-beta. */
struct problem {
  const struct clay      *c;
  const struct clay_step *step;
  double                  x0, beta, log_pc;
  double                  log_tip, tip; /* ln Pa, Pa: where q = 0 and p is the ellipse's length */
  bool                    wet;          /* plastic strain compresses */
  bool                    floored;      /* the tip is the least possible */
};

/* pc of a step that ends at the measure x */
static double hardened(const struct problem *b, double x)
{
  return exp_cut(b->log_pc - (b->step->change + b->c->kappa * (x - b->x0)) / b->c->plastic);
}

/* ln of the pressure that is pc over k, above the floor, where pc(p) is a power */
static double log_of_share(const struct problem *b, double k)
{
  double at_floor = b->log_pc - (b->step->change - b->c->kappa * b->x0) / b->c->plastic; /* ln pc at x = 0 */
  return (at_floor + b->beta * log(b->c->floor) - log(k)) / (1.0 + b->beta);
}

/* State on the ellipse, and pressure over the bound: on the wet side, p = tip exp(-u^2); on the dry side p = u^2. So q
 * is smooth in u where it vanishes, and no digits are lost there. */
static double on_ellipse(const struct problem *b, double u, struct clay_state *s)
{
  const struct clay *c = b->c;
  double             w = u * u, x, above; /* ellipse's length less p */
  if (b->wet) {
    s->p = b->tip * exp(-w);
    x = b->log_tip - log(c->floor) - w;
    s->pc = b->floored ? hardened(b, x) : b->tip * exp_cut(b->beta * w);
    double longer = b->floored ? fmax(s->pc - b->tip, 0.0) : b->tip * expm1(fmin(MOST, b->beta * w));
    above = longer - b->tip * expm1(-w);
  } else {
    s->p = w;
    x = clay_measure(c, w);
    s->pc = hardened(b, x);
    above = clay_length(c, s->pc) - w;
  }
  s->q = c->M * sqrt(s->p * fmax(above, 0.0));
  s->shear = c->shear * b->step->v / c->kappa * clay_secant(c, b->step->p, b->x0, s->p, x);
  s->compression = -(b->step->change + c->kappa * (x - b->x0)) / b->step->v;
  return s->p - above; /* 2 p less the length */
}

/* q of the trial with that shear modulus */
static double trial_q(const struct clay_step *t, double G)
{
  return sqrt(fmax(0.0, 1.5 * (t->ss + 4.0 * G * (t->se + G * t->ee))));
}

/* Flow rule: (q_trial - q)/(3 G) is the plastic shear strain; over the compression it is 2 q over M^2 (2 p - pc). */
static double flow(const struct problem *b, double u, struct clay_state *s)
{
  double M = b->c->M, beyond = on_ellipse(b, u, s), lost = trial_q(b->step, s->shear) - s->q;
  s->plastic = fmax(0.0, lost / (3.0 * s->shear));
  return lost * beyond * M * M - 6.0 * s->shear * s->q * s->compression;
}

/* Root between a and b, where flow has different signs: inverse quadratic steps, halving where those are not safe
 * (Chandrupatla 1997). */
static void find(const struct problem *problem, double a, double b, struct clay_state *s)
{
  enum { STEPS = 100 };
  double fa = flow(problem, a, s), fb = flow(problem, b, s), t = 0.5, c, fc;
  if (fa == 0.0 || fb == 0.0 || (fa > 0.0) == (fb > 0.0)) { /* the last: round-off at an end */
    flow(problem, fabs(fa) <= fabs(fb) ? a : b, s);
    return;
  }
  for (int i = 0; i < STEPS; i++) {
    double x = a + t * (b - a), fx = flow(problem, x, s);
    if ((fx > 0.0) == (fa > 0.0)) {
      c = a, fc = fa;
    } else {
      c = b, b = a;
      fc = fb, fb = fa;
    }
    a = x, fa = fx;
    double best = fabs(fa) < fabs(fb) ? a : b, least = 2.0 * DBL_EPSILON * fabs(best) / fabs(b - a);
    if (least > 0.5 || fa == 0.0) break;
    double xi = (a - b) / (c - b), phi = (fa - fb) / (fc - fb);
    t = 0.5;
    if (phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi)
      t = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb);
    t = fmax(least, fmin(1.0 - least, t));
  }
  flow(problem, fabs(fa) <= fabs(fb) ? a : b, s);
}

void clay_return(const struct clay *c, const struct clay_step *step, struct clay_state *state)
{
  struct problem b = {.c = c, .step = step, .x0 = clay_measure(c, step->p), .beta = c->kappa / c->plastic};
  double         x = b.x0 - step->change / c->kappa, trial = clay_pressure(c, x), log_floor = log(c->floor);
  b.log_pc = log(step->pc);
  b.wet = 2.0 * trial > clay_length(c, step->pc);
  b.log_tip = log_of_share(&b, 1.0);
  b.floored = b.log_tip <= log_floor + log(2.0);
  b.log_tip = fmin(MOST, fmax(b.log_tip, log_floor + log(2.0)));
  b.tip = exp(b.log_tip);
  double critical = fmin(b.log_tip, fmax(log_of_share(&b, 2.0), log_floor));
  if (b.wet)
    find(&b, sqrt(fmax(0.0, b.log_tip - log_floor - x)), sqrt(b.log_tip - critical), state);
  else
    find(&b, sqrt(fmax(0.0, trial)), exp(0.5 * critical), state);
}
