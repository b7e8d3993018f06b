/* The return to Mohr and Coulomb's planes along the gradient of Menetrey and Willam's potential at the end of the step.
 * theory 1.3.1, T(15) with 1 - e^2 for its (1 - e)^2.
 *
 * Deviators are vectors of length q at the angle theta of Lode, 0 where s_1 = s_2 and pi/3 where s_2 = s_3. The trial
 * (q_t, theta_t) is the result (q, theta) plus x (R e_r + R' e_theta), so with delta = theta - theta_t
 *     q_t cos(delta) = q + x R(theta),   q_t sin(delta) = -x R'(theta),   p = p_t - chi x sqrt(1 + (w/q)^2),
 * chi = K tan(psi)/(3 G), w = eps c tan(psi)/R. */
#include "constitutive/coulomb.h"

#define SQRT3 1.73205080756887729353

/* The trial of a group, and at a turn tan(delta/2) what follows from the first and the last of the equations and the
 * yield function; `gap` is what is left of the second. */
struct turn {
  VECTOR mean, q, cosine, sine; /* Pa, Pa, of theta_t */
  VECTOR c, s, ahead, aside;    /* cos, sin of theta; q_t cos(delta), q_t sin(delta) in Pa */
  VECTOR R, slope, A;           /* R(theta), R'(theta); f = A q + 2 p sin(phi) - 2 c cos(phi) */
  VECTOR end, end_mean, gap;    /* Pa: q, p, residual */
};

static void measure(const VECTOR t[3], struct turn *u)
{
  u->mean = (t[0] + t[1] + t[2]) / 3.0;
  VECTOR a = t[1] - t[0], b = t[2] - t[1], square = a * a + b * b + a * b;
  vector_sqrt(&square, &u->q);
  MASK   some = (MASK)(u->q > 0.0);
  VECTOR one = VECTOR_ALL(1.0), zero = VECTOR_ALL(0.0);
  u->sine = VECTOR_SELECT(some, 0.5 * SQRT3 * a / u->q, zero);
  u->cosine = VECTOR_SELECT(some, (0.5 * a + b) / u->q, one);
}

static void turn_to(const VECTOR *half, struct turn *u)
{
  VECTOR square = *half * *half, cosine = (1.0 - square) / (1.0 + square), sine = 2.0 * *half / (1.0 + square);
  u->c = u->cosine * cosine - u->sine * sine;
  u->s = u->sine * cosine + u->cosine * sine;
  u->ahead = u->q * cosine;
  u->aside = u->q * sine;
}

/* R(theta) and its derivative: an ellipse of roundness e between the meridians. */
static void shape(const struct coulomb_flow *f, const struct coulomb_strength *s, struct turn *u)
{
  double e = f->roundness, flat = 1.0 - e * e, sharp = 2.0 * e - 1.0;
  VECTOR square = 4.0 * flat * u->c * u->c, inner = square + (5.0 * e * e - 4.0 * e), root;
  vector_sqrt(&inner, &root);
  VECTOR under = 2.0 * flat * u->c + sharp * root, ratio = (square + sharp * sharp) / under;
  VECTOR growth = 8.0 * flat * u->c - ratio * (2.0 * flat + sharp * 4.0 * flat * u->c / root); /* over `under` */
  u->R = f->meridian * ratio;
  u->slope = -u->s * f->meridian * growth / under;
  u->A = u->c + u->s / SQRT3 + s->sin_phi * (u->c / 3.0 - u->s / SQRT3);
}

/* q from A q + P = D (q_t cos(delta) - q) sqrt(1 + (w/q)^2): the root with w = 0, or above it. The left less the right
 * grows with q and is concave, so Newton's method climbs to the root from below. It starts on the larger of two bounds:
 * the roots with 1 and with w/q in place of the square root. A lane that is done keeps what it has. */
static void solve_end(const struct turn *u, const VECTOR *P, const VECTOR *D, const VECTOR *w, VECTOR *end)
{
  enum { STEPS = 20 };
  VECTOR b = *P + *D * *w, c = *D * *w * u->ahead, square = b * b + 4.0 * u->A * c, root;
  MASK   open = (MASK)(*w * *D > 0.0);
  *end = (*D * u->ahead - *P) / (u->A + *D);
  if (!vector_any(&open)) return;
  vector_sqrt(&square, &root);
  VECTOR blunt = VECTOR_SELECT(b > 0.0, 2.0 * c / (b + root), 0.5 * (root - b) / u->A);
  *end = VECTOR_SELECT(open & (MASK)(blunt > *end), blunt, *end);
  for (int i = 0; i < STEPS && vector_any(&open); i++) {
    VECTOR q = *end, ratio = *w / q, stretch = 1.0 + ratio * ratio, rest = u->ahead - q;
    vector_sqrt(&stretch, &root);
    VECTOR change = (*D * rest * root - u->A * q - *P) / (u->A + *D * (root + rest * ratio * ratio / (q * root)));
    *end = VECTOR_SELECT(open, q + change, q);
    open &= (MASK)(change > 1e-15 * q);
  }
}

static void turn_evaluate(const struct coulomb_elastic *e, const struct coulomb_strength *s,
                          const struct coulomb_flow *f, const VECTOR *half, struct turn *u)
{
  VECTOR square = 1.0 - s->sin_psi * s->sin_psi, cosine, tangent;
  vector_sqrt(&square, &cosine);
  tangent = s->sin_psi / cosine;
  turn_to(half, u);
  shape(f, s, u);
  VECTOR chi = tangent * (e->bulk / (3.0 * e->shear)) / u->R, w = f->blunt * tangent / u->R;
  VECTOR P = 2.0 * s->sin_phi * u->mean - s->cohesive, D = 2.0 * s->sin_phi * chi;
  solve_end(u, &P, &D, &w, &u->end);
  u->end = VECTOR_MIN(u->end, u->ahead);
  VECTOR ratio = w / u->end, stretch = 1.0 + VECTOR_SELECT(w > 0.0, ratio * ratio, w), root;
  vector_sqrt(&stretch, &root);
  u->end_mean = u->mean - chi * (u->ahead - u->end) * root;
  u->gap = u->aside + (u->ahead - u->end) * u->slope / u->R;
}

/* The turn is between 0, where the gap is negative, and pi/3 - theta_t, where it is not. It starts with what the gap at
 * 0 asks for. A lane that is done keeps what it has. */
static void turn_solve(const struct coulomb_elastic *e, const struct coulomb_strength *s, const struct coulomb_flow *f,
                       struct turn *u)
{
  enum { STEPS = 80 };
  struct search search;
  VECTOR        zero = VECTOR_ALL(0.0);
  turn_evaluate(e, s, f, &zero, u);
  MASK open = (MASK)(VECTOR_ABS(u->gap) > 1e-13 * u->q);
  search.high = (SQRT3 * u->cosine - u->sine) / (2.0 + u->cosine + SQRT3 * u->sine); /* tan((pi/3 - theta_t)/2) */
  search.low = search.last = zero;
  search.last_gap = u->gap;
  search.at = -0.5 * u->gap / u->q;
  search.at = VECTOR_SELECT(search.at < search.high, search.at, 0.5 * search.high);
  for (int i = 0; i < STEPS && vector_any(&open); i++) {
    struct turn next = *u;
    turn_evaluate(e, s, f, &search.at, &next);
    u->c = VECTOR_SELECT(open, next.c, u->c);
    u->s = VECTOR_SELECT(open, next.s, u->s);
    u->end = VECTOR_SELECT(open, next.end, u->end);
    u->end_mean = VECTOR_SELECT(open, next.end_mean, u->end_mean);
    open &= (MASK)(VECTOR_ABS(next.gap) > 1e-13 * u->q);
    search_next(&search, &next.gap);
  }
}

void coulomb_return_smooth(const struct coulomb_elastic *elastic, const struct coulomb_strength *strength,
                           const struct coulomb_flow *flow, const VECTOR trial[3], VECTOR value[3])
{
  struct turn u;
  measure(trial, &u);
  turn_solve(elastic, strength, flow, &u);
  MASK   tip = (MASK)(u.end <= 0.0);
  VECTOR third = u.end / 3.0, across = u.end * u.s / SQRT3, bound = VECTOR_MIN(strength->tip, u.mean);
  value[0] = VECTOR_SELECT(tip, bound, u.end_mean - third * u.c - across);
  value[1] = VECTOR_SELECT(tip, bound, u.end_mean - third * u.c + across);
  value[2] = VECTOR_SELECT(tip, bound, u.end_mean + 2.0 * third * u.c);
}
