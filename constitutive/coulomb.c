/* The exact return to planes: Mohr and Coulomb's, the cut-off's, and where they meet. After Clausen, Damkilde and
 * Andersen 2006. theory 1.3.1 */
#include "constitutive/coulomb.h"

/* What a slip of 1 on the plane of s_1 and s_3 takes from the stresses: D b with b = (sin psi - 1, 0, sin psi + 1). */
struct slip {
  VECTOR low, middle, high;
};

static void slip_stress(const struct coulomb_elastic *e, const struct coulomb_strength *s, struct slip *d)
{
  d->middle = 2.0 * e->lambda * s->sin_psi;
  d->low = d->middle - 2.0 * e->shear * (1.0 - s->sin_psi);
  d->high = d->middle + 2.0 * e->shear * (1.0 + s->sin_psi);
}

static void to_plane(const struct coulomb_strength *s, const struct slip *d, const VECTOR t[3], VECTOR value[3])
{
  VECTOR up = 1.0 + s->sin_phi, down = 1.0 - s->sin_phi;
  VECTOR slip = (up * t[2] - down * t[0] - s->cohesive) / (up * d->high - down * d->low);
  value[0] = t[0] - slip * d->low;
  value[1] = t[1] - slip * d->middle;
  value[2] = t[2] - slip * d->high;
}

/* On an edge two planes slip and two stresses are equal: they lose the mean of what the planes take. */
static void to_lower_edge(const struct coulomb_strength *s, const struct slip *d, const VECTOR t[3], VECTOR value[3])
{
  VECTOR up = 1.0 + s->sin_phi, down = 1.0 - s->sin_phi, both = 0.5 * (d->low + d->middle), pair = 0.5 * (t[0] + t[1]);
  VECTOR slip = (up * t[2] - down * pair - s->cohesive) / (up * d->high - down * both);
  value[0] = value[1] = pair - slip * both;
  value[2] = t[2] - slip * d->high;
}

static void to_upper_edge(const struct coulomb_strength *s, const struct slip *d, const VECTOR t[3], VECTOR value[3])
{
  VECTOR up = 1.0 + s->sin_phi, down = 1.0 - s->sin_phi, both = 0.5 * (d->high + d->middle), pair = 0.5 * (t[1] + t[2]);
  VECTOR slip = (up * pair - down * t[0] - s->cohesive) / (up * both - down * d->low);
  value[0] = t[0] - slip * d->low;
  value[1] = value[2] = pair - slip * both;
}

static void choose(const MASK *mask, const VECTOR yes[3], VECTOR value[3])
{
  for (int k = 0; k < 3; k++) value[k] = VECTOR_SELECT(*mask, yes[k], value[k]);
}

/* The plane where that keeps the order of the stresses, the edge that it would cross, the tip beyond both. */
static void to_planes(const struct coulomb_strength *s, const struct slip *d, const VECTOR t[3], VECTOR value[3])
{
  VECTOR lower[3], upper[3], tip[3], mean = (t[0] + t[1] + t[2]) / 3.0;
  to_plane(s, d, t, value);
  to_lower_edge(s, d, t, lower);
  to_upper_edge(s, d, t, upper);
  tip[0] = tip[1] = tip[2] = VECTOR_MIN(s->tip, mean);
  MASK crosses_lower = (MASK)(value[0] > value[1]), crosses_upper = (MASK)(value[1] > value[2]);
  MASK on_lower = crosses_lower & (MASK)(lower[0] <= lower[2]);
  MASK on_upper = crosses_upper & (MASK)(upper[0] <= upper[2]) & ~on_lower;
  MASK on_tip = (crosses_lower | crosses_upper) & ~on_lower & ~on_upper;
  choose(&on_lower, lower, value);
  choose(&on_upper, upper, value);
  choose(&on_tip, tip, value);
}

/* The cut-off alone, associated: opening across one, two or three axes. */
static void to_cut_off(const struct coulomb_elastic *e, const struct coulomb_strength *s, const VECTOR t[3],
                       VECTOR value[3])
{
  VECTOR one = (t[2] - s->tension) / (e->lambda + 2.0 * e->shear);
  VECTOR two = (0.5 * (t[1] + t[2]) - s->tension) / (e->lambda + e->shear);
  MASK   second = (MASK)(t[1] - e->lambda * one > s->tension);
  VECTOR loss = e->lambda * VECTOR_SELECT(second, two, one);
  value[0] = VECTOR_MIN(t[0] - loss, s->tension);
  value[1] = VECTOR_MIN(t[1] - loss, s->tension);
  value[1] = VECTOR_SELECT(second, s->tension, value[1]);
  value[2] = s->tension;
}

/* Slip and opening: s_3 is the cut-off's, s_1 the plane's, s_2 what both leave within these. */
static void to_meeting(const struct coulomb_elastic *e, const struct coulomb_strength *s, const struct slip *d,
                       const VECTOR t[3], VECTOR value[3])
{
  double stiff = e->lambda + 2.0 * e->shear;
  value[2] = s->tension;
  value[0] = ((1.0 + s->sin_phi) * s->tension - s->cohesive) / (1.0 - s->sin_phi);
  VECTOR low = t[0] - value[0], high = t[2] - value[2], determinant = d->low * stiff - d->high * e->lambda;
  VECTOR slip = (low * stiff - high * e->lambda) / determinant, opening = (d->low * high - d->high * low) / determinant;
  value[1] = t[1] - slip * d->middle - opening * e->lambda;
  value[1] = VECTOR_MAX(value[1], value[0]);
  value[1] = VECTOR_MIN(value[1], value[2]);
}

/* Where the planes leave too much tension: the cut-off alone if that satisfies the planes, else both. */
static void cut(const struct coulomb_elastic *e, const struct coulomb_strength *s, const struct slip *d,
                const VECTOR t[3], VECTOR value[3])
{
  VECTOR opened[3], meeting[3];
  MASK   over = (MASK)(value[2] > s->tension);
  if (!vector_any(&over)) return;
  to_cut_off(e, s, t, opened);
  to_meeting(e, s, d, t, meeting);
  MASK slips = (MASK)(COULOMB_YIELD(s, opened) > 0.0);
  choose(&slips, meeting, opened);
  choose(&over, opened, value);
}

void coulomb_return(const struct coulomb_elastic *elastic, const struct coulomb_strength *strength,
                    const struct coulomb_flow *flow, const VECTOR trial[3], VECTOR value[3])
{
  struct slip d;
  MASK        inside = (MASK)(COULOMB_YIELD(strength, trial) <= 0.0);
  slip_stress(elastic, strength, &d);
  if (flow->roundness > 0.0)
    coulomb_return_smooth(elastic, strength, flow, trial, value);
  else
    to_planes(strength, &d, trial, value);
  choose(&inside, trial, value);
  cut(elastic, strength, &d, trial, value);
}
