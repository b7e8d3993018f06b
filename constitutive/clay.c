/* The return is one equation for one number, bracketed: the flow rule, while pressure, hardening and ellipse hold
 * exactly for every trial of that number. */
#include "constitutive/clay.h"

#include "constitutive/exponential.h"

#include <float.h>

void clay_measure(const struct clay *c, const VECTOR *p, VECTOR *x)
{
  VECTOR share = *p / c->floor, above = VECTOR_MAX(share, VECTOR_ALL(1.0));
  vector_log(&above, x);
  *x = VECTOR_SELECT(share >= 1.0, *x + 1.0, share);
}

void clay_pressure(const struct clay *c, const VECTOR *x, VECTOR *p)
{
  VECTOR above = VECTOR_MAX(*x - 1.0, VECTOR_ALL(0.0)), share, unused;
  vector_exp(&above, &share, &unused);
  *p = c->floor * VECTOR_SELECT(*x >= 1.0, share, *x);
}

/* Above the floor p/floor = exp(x - 1): the logarithmic mean, for close pressures by its series about the geometric
 * one; from one side of the floor to the other the series of (exp(y) - 1 - y0)/(y - y0), y = x - 1 > 0 > y0. */
void clay_secant(const struct clay *c, const VECTOR *p0, const VECTOR *x0, const VECTOR *p, const VECTOR *x,
                 VECTOR *secant)
{
  const double close = 1e-2;
  VECTOR d = *x - *x0, size = VECTOR_ABS(d), high = VECTOR_MAX(*x, *x0), low = VECTOR_MIN(*x, *x0), mean = *p * *p0;
  VECTOR square = d * d, y = high - 1.0, crossing = y * y / (high - low);
  vector_sqrt(&mean, &mean);
  mean *= 1.0 + square / 24.0 * (1.0 + square / 80.0);
  crossing *= 0.5 + y * (1.0 / 6 + y * (1.0 / 24 + y * (1.0 / 120 + y / 720)));
  *secant = VECTOR_SELECT(low >= 1.0, mean, c->floor + c->floor * crossing);
  *secant = VECTOR_SELECT(size > close, (*p - *p0) / d, *secant);
  *secant = VECTOR_SELECT(high <= 1.0, VECTOR_ALL(c->floor), *secant);
}

/* The step with what follows from it, in measures: ln(pc/floor) = level - beta x. */
struct problem {
  const struct clay      *c;
  const struct clay_step *step;
  double                  beta;
  VECTOR                  x0, level;
  VECTOR                  tip_x, tip, tip_pc; /* where q = 0, p is the ellipse's length: measure, Pa; pc there */
  MASK                    wet;                /* plastic strain compresses */
  MASK                    floored;            /* the tip is the least possible */
};

/* State on the ellipse, and `beyond` 2 p less its length. On the wet side x = tip_x - u^2, on the dry side u^2: q is
 * smooth in u where it vanishes, and loses no digits there. */
static void on_ellipse(const struct problem *b, const VECTOR *u, struct clay_state *s, VECTOR *beyond)
{
  const struct clay *c = b->c;
  VECTOR             w = *u * *u, x, power, first, first_less_one, second, second_less_one, above, secant;
  x = VECTOR_SELECT(b->wet, b->tip_x - w, w);
  power = VECTOR_SELECT(b->wet, -w, VECTOR_MAX(w - 1.0, VECTOR_ALL(0.0)));
  vector_exp(&power, &first, &first_less_one);
  power = VECTOR_SELECT(b->wet, b->beta * w, b->level - b->beta * x);
  vector_exp(&power, &second, &second_less_one);
  VECTOR dry_p = c->floor * VECTOR_SELECT(w >= 1.0, first, w), wet_p = b->tip * first;
  VECTOR dry_pc = c->floor * second, wet_pc = b->tip_pc * second;
  VECTOR longer = VECTOR_MAX(wet_pc - b->tip, VECTOR_ALL(0.0)), least = VECTOR_ALL(2.0 * c->floor);
  longer = VECTOR_SELECT(b->floored, longer, b->tip * second_less_one) - b->tip * first_less_one;
  above = VECTOR_MAX(dry_pc, least) - dry_p;
  above = VECTOR_SELECT(b->wet, longer, above);
  s->p = VECTOR_SELECT(b->wet, wet_p, dry_p);
  s->pc = VECTOR_SELECT(b->wet, wet_pc, dry_pc);
  power = s->p * VECTOR_MAX(above, VECTOR_ALL(0.0));
  vector_sqrt(&power, &s->q);
  s->q *= c->M;
  clay_secant(c, &b->step->p, &b->x0, &s->p, &x, &secant);
  s->shear = c->shear / c->kappa * b->step->v * secant;
  s->compression = -(b->step->change + c->kappa * (x - b->x0)) / b->step->v;
  *beyond = s->p - above;
}

/* Flow rule: (q_trial - q)/(3 G) is the plastic shear strain; over the compression it is 2 q over M^2 (2 p - pc). */
static void flow(const struct problem *b, const VECTOR *u, struct clay_state *s, VECTOR *value)
{
  const struct clay_step *t = b->step;
  double                  M = b->c->M;
  VECTOR                  beyond, square, trial;
  on_ellipse(b, u, s, &beyond);
  square = 1.5 * (t->ss + 4.0 * s->shear * (t->se + s->shear * t->ee));
  square = VECTOR_MAX(square, VECTOR_ALL(0.0));
  vector_sqrt(&square, &trial);
  trial -= s->q;
  *value = trial * beyond * (M * M) - 6.0 * s->shear * s->q * s->compression;
  s->plastic = VECTOR_MAX(trial, VECTOR_ALL(0.0)) / (3.0 * s->shear);
}

/* Bracket of a root in every lane; ends are not negative. */
struct bracket {
  VECTOR a, b, c;    /* latest; on the other side of the root; the one before */
  VECTOR fa, fb, fc; /* values there */
  VECTOR t;          /* share of the way from a to b where to look next */
  MASK   open;
};

/* Takes in the value at x: inverse quadratic steps, halves where those are not safe (Chandrupatla 1997). */
static void bracket_next(struct bracket *k, const VECTOR *x, const VECTOR *fx)
{
  MASK same = ~((MASK)(*fx > 0.0) ^ (MASK)(k->fa > 0.0)), other = k->open & ~same;
  k->c = VECTOR_SELECT(same, k->a, k->b);
  k->fc = VECTOR_SELECT(same, k->fa, k->fb);
  k->b = VECTOR_SELECT(other, k->a, k->b);
  k->fb = VECTOR_SELECT(other, k->fa, k->fb);
  k->a = VECTOR_SELECT(k->open, *x, k->a);
  k->fa = VECTOR_SELECT(k->open, *fx, k->fa);
  VECTOR width = k->b - k->a, best = VECTOR_MIN(k->a, k->b), half = VECTOR_ALL(0.5);
  VECTOR least = 2.0 * DBL_EPSILON * best / VECTOR_ABS(width);
  k->open &= (MASK)(least <= 0.5) & (MASK)(k->fa != 0.0);
  VECTOR xi = -width / (k->c - k->b), phi = (k->fa - k->fb) / (k->fc - k->fb), rest = 1.0 - phi;
  VECTOR ac = (k->c - k->a) / width;
  VECTOR t = k->fa * (k->fc / ((k->fb - k->fa) * (k->fb - k->fc)) + ac * k->fb / ((k->fc - k->fa) * (k->fc - k->fb)));
  k->t = VECTOR_SELECT((MASK)(phi * phi < xi) & (MASK)(rest * rest < 1.0 - xi), t, half);
  k->t = VECTOR_MAX(k->t, least);
  k->t = VECTOR_MIN(k->t, 1.0 - least);
}

/* Root of flow between two ends where it has different signs; round-off may spoil that: then one end is the root. */
static void find(const struct problem *problem, const MASK *outside, const VECTOR *a, const VECTOR *b,
                 struct clay_state *s)
{
  enum { STEPS = 100 };
  struct bracket k = {.a = *a, .b = *b};
  VECTOR         x, fx, size_a, size_b;
  flow(problem, a, s, &k.fa);
  flow(problem, b, s, &k.fb);
  k.open = *outside & ((MASK)(k.fa > 0.0) ^ (MASK)(k.fb > 0.0)) & (MASK)(k.fa != 0.0) & (MASK)(k.fb != 0.0);
  k.t = k.fa / (k.fa - k.fb);
  for (int i = 0; i < STEPS && vector_any(&k.open); i++) {
    x = k.a + k.t * (k.b - k.a);
    flow(problem, &x, s, &fx);
    bracket_next(&k, &x, &fx);
  }
  size_a = VECTOR_ABS(k.fa);
  size_b = VECTOR_ABS(k.fb);
  x = VECTOR_SELECT(size_a <= size_b, k.a, k.b);
  flow(problem, &x, s, &fx);
}

void clay_return(const struct clay *c, const struct clay_step *step, const MASK *outside, struct clay_state *state)
{
  struct problem b = {.c = c, .step = step, .beta = c->kappa / c->plastic};
  VECTOR zero = VECTOR_ALL(0.0), power, trial_x, trial, length, least = VECTOR_ALL(2.0 * c->floor), critical, from, to;
  clay_measure(c, &step->p, &b.x0);
  trial_x = b.x0 - step->change / c->kappa;
  clay_pressure(c, &trial_x, &trial);
  length = VECTOR_MAX(step->pc, least);
  b.wet = (MASK)(2.0 * trial > length);
  power = step->pc / c->floor;
  vector_log(&power, &b.level);
  b.level += b.beta * b.x0 - step->change / c->plastic;
  b.tip_x = (b.level + 1.0) / (1.0 + b.beta); /* x - 1 = level - beta x */
  b.floored = (MASK)(b.tip_x <= 1.0 + M_LN2);
  b.tip_x = VECTOR_MIN(b.tip_x, VECTOR_ALL(1.0 + EXPONENT_MOST));
  b.tip_x = VECTOR_MAX(b.tip_x, VECTOR_ALL(1.0 + M_LN2));
  clay_pressure(c, &b.tip_x, &b.tip);
  power = b.level - b.beta * b.tip_x;
  vector_exp(&power, &b.tip_pc, &trial);
  b.tip_pc = VECTOR_SELECT(b.floored, c->floor * b.tip_pc, b.tip);
  critical = (b.level + 1.0 - M_LN2) / (1.0 + b.beta);
  critical = VECTOR_MAX(critical, VECTOR_ALL(1.0));
  critical = VECTOR_MIN(critical, b.tip_x);
  from = VECTOR_SELECT(b.wet, b.tip_x - trial_x, trial_x);
  from = VECTOR_MAX(from, zero);
  to = VECTOR_SELECT(b.wet, b.tip_x - critical, critical);
  vector_sqrt(&from, &from);
  vector_sqrt(&to, &to);
  find(&b, outside, &from, &to, state);
}
