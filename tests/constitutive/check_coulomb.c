/* Returns in principal space: random trials end on the surface by a flow that their place allows, and reach every
 * place.
 */
#include "constitutive/coulomb.h"
#include "tests/battery/battery.h"

#include <float.h>

static const double degree = M_PI / 180.0;

/* where a stress lies */
enum place {
  INSIDE,
  PLANE,
  LOWER_EDGE,
  UPPER_EDGE,
  TIP,
  OPENED,
  OPENED_TWICE,
  OPENED_TIP,
  MEETING,
  LOWER_CORNER,
  UPPER_CORNER,
  PLACES
};
static const char *const place_names[PLACES] = {
    "inside",       "plane",   "s1 = s2",          "s2 = s3",         "tip", "cut-off", "cut-off, s2 = s3",
    "cut-off, tip", "meeting", "meeting, s1 = s2", "meeting, s2 = s3"};

struct soil {
  double                  phi, psi, cohesion, tension; /* rad, Pa */
  struct coulomb_elastic  elastic;
  struct coulomb_strength strength;
  struct coulomb_flow     flow;
};

static struct soil soil(double phi, double psi, double cohesion, double tension, int smooth)
{
  struct soil s = {.phi = phi * degree, .psi = psi * degree, .cohesion = cohesion};
  double      sine = sin(s.phi), tip = cohesion / tan(s.phi);
  s.tension = fmin(tension, tip);
  s.elastic = (struct coulomb_elastic){5.77e6, 3.85e6, 5.77e6 + 3.85e6 / 1.5};
  s.strength.sin_phi = VECTOR_ALL(sine);
  s.strength.sin_psi = VECTOR_ALL(sin(s.psi));
  s.strength.cohesive = VECTOR_ALL(2.0 * cohesion * cos(s.phi));
  s.strength.tip = VECTOR_ALL(tip);
  s.strength.tension = VECTOR_ALL(s.tension);
  if (smooth) s.flow = (struct coulomb_flow){(3 - sine) / (3 + sine), (3 - sine) / (6 * cos(s.phi)), 0.1 * cohesion};
  return s;
}

static double yield_of(const struct soil *s, const double v[3])
{
  return (v[2] - v[0]) + (v[2] + v[0]) * sin(s->phi) - 2.0 * s->cohesion * cos(s->phi);
}

/* ascending; some eps of `scale` count as equal */
static enum place place_of(const struct soil *s, const double v[3], double scale)
{
  double eps = 1e-12 * scale;
  int    low = v[1] - v[0] <= eps, high = v[2] - v[1] <= eps;
  int    opened = v[2] >= s->tension - eps && s->tension < s->cohesion / tan(s->phi);
  if (yield_of(s, v) < -eps) return !opened ? INSIDE : low && high ? OPENED_TIP : high ? OPENED_TWICE : OPENED;
  if (opened) return low ? LOWER_CORNER : high ? UPPER_CORNER : MEETING;
  return low && high ? TIP : low ? LOWER_EDGE : high ? UPPER_EDGE : PLANE;
}

/* plastic strain of a return from t to v */
static void plastic_strain(const struct soil *s, const double t[3], const double v[3], double e[3])
{
  double mean = 0.0;
  for (int k = 0; k < 3; k++) mean += (t[k] - v[k]) / 3.0;
  for (int k = 0; k < 3; k++) e[k] = (t[k] - v[k] - mean) / (2.0 * s->elastic.shear) + mean / (3.0 * s->elastic.bulk);
}

/* Slip lowers s_1 by 1 - sin(psi) for 1 + sin(psi) of the opening of s_3; on an edge the equal stresses share theirs. A
 * cut-off opens what it touches. Returns the largest strain that is not of this kind. */
static double wrong_flow(const struct soil *s, enum place place, const double e[3])
{
  double ratio = (1.0 + sin(s->psi)) / (1.0 - sin(s->psi)); /* opening per shortening */
  double shortened = -ratio * (e[0] + (place == LOWER_EDGE || place == LOWER_CORNER ? e[1] : 0.0));
  switch (place) {
  case PLANE:
    return fmax(fabs(e[1]), fabs(e[2] - shortened));
  case LOWER_EDGE:
    return fmax(fmax(e[0], e[1]), fabs(e[2] - shortened));
  case UPPER_EDGE:
    return fmax(fmax(-e[1], -e[2]), fabs(e[1] + e[2] - shortened));
  case OPENED:
    return fmax(fmax(fabs(e[0]), fabs(e[1])), -e[2]);
  case OPENED_TWICE:
    return fmax(fmax(fabs(e[0]), -e[1]), -e[2]);
  case OPENED_TIP:
    return fmax(fmax(-e[0], -e[1]), -e[2]);
  case MEETING:
    return fmax(fmax(fabs(e[1]), e[0]), shortened - e[2]);
  case LOWER_CORNER:
    return fmax(fmax(e[0], e[1]), shortened - e[2]);
  case UPPER_CORNER:
    return fmax(fmax(e[0], -e[1]), fmax(-e[2], shortened - e[1] - e[2]));
  default:
    return 0.0;
  }
}

/* what a random test has seen */
struct record {
  long   at[PLACES];
  double yield, order, flow, work; /* worst, over the size of trial or of strain */
};

static void look(const struct soil *s, const double t[3], const double v[3], struct record *seen)
{
  double e[3], work = 0.0, size = 0.0, scale = fmax(fabs(t[0]), fabs(t[2]));
  plastic_strain(s, t, v, e);
  enum place place = place_of(s, v, scale);
  for (int k = 0; k < 3; k++) work += v[k] * e[k], size = fmax(size, fabs(e[k]));
  seen->at[place]++;
  seen->yield = fmax(seen->yield, fmax(yield_of(s, v), v[2] - s->tension) / scale);
  seen->order = fmax(seen->order, fmax(v[0] - v[1], v[1] - v[2]) / scale);
  seen->work = fmax(seen->work, -work / (scale * scale / s->elastic.shear));
  if (s->flow.roundness == 0.0) seen->flow = fmax(seen->flow, wrong_flow(s, place, e) / (scale / s->elastic.shear));
}

/* any three stresses of 1 to 1e6 Pa around a mean of that size, in order; often two are close */
static void random_trial(uint64_t *seed, double t[3])
{
  double size = pow(10.0, 3.0 + 3.0 * battery_random(seed)), mean = battery_random(seed) - 0.3;
  double close = battery_random(seed) > 0.5 ? 1e-3 : 1.0;
  for (int k = 0; k < 3; k++) t[k] = size * (mean + (k == 1 ? 1.0 : close) * battery_random(seed));
  for (int k = 0; k < 3; k++) {
    int    i = k == 1 ? 1 : 0;
    double low = fmin(t[i], t[i + 1]), high = fmax(t[i], t[i + 1]);
    t[i] = low, t[i + 1] = high;
  }
}

enum { TRIALS = 1000000 };

static void random_returns(const struct soil *s, struct record *seen)
{
  uint64_t seed = 1;
  for (int n = 0; n < TRIALS; n += LANES) {
    VECTOR trial[3], value[3];
    double t[LANES][3];
    for (int i = 0; i < LANES; i++) {
      random_trial(&seed, t[i]);
      for (int k = 0; k < 3; k++) trial[k][i] = t[i][k];
    }
    coulomb_return(&s->elastic, &s->strength, &s->flow, trial, value);
    for (int i = 0; i < LANES; i++) {
      double v[3] = {value[0][i], value[1][i], value[2][i]};
      int    outside = yield_of(s, t[i]) > 0.0 || t[i][2] > s->tension;
      look(s, t[i], outside ? v : t[i], seen);
    }
  }
}

static void expect(const char *what, const struct soil *s, unsigned places)
{
  struct record seen = {0};
  random_returns(s, &seen);
  printf("%s: yield %.1e, order %.1e, flow %.1e, work %.1e;", what, seen.yield, seen.order, seen.flow, seen.work);
  for (int p = 0; p < PLACES; p++)
    if (seen.at[p]) printf(" %s %ld", place_names[p], seen.at[p]);
  printf("\n");
  ck_assert_double_le(seen.yield, 1e-14);
  ck_assert_double_le(seen.order, 1e-15);
  ck_assert_double_le(seen.flow, 1e-12);
  ck_assert_double_le(seen.work, 1e-14);
  for (int p = 0; p < PLACES; p++)
    ck_assert_msg((seen.at[p] > 1000) == (places >> p & 1), "%s: %ld of a million end at: %s", what, seen.at[p],
                  place_names[p]);
}

#define BIT(place) (1u << place)
#define WITHOUT_CUT_OFF (BIT(INSIDE) | BIT(PLANE) | BIT(LOWER_EDGE) | BIT(UPPER_EDGE) | BIT(TIP))

START_TEST(planes)
{
  struct soil sand = soil(30, 0, 0, INFINITY, 0), clay = soil(25, 10, 5e3, INFINITY, 0),
              dense = soil(45, 45, 1e3, INFINITY, 0);
  expect("phi 30", &sand, WITHOUT_CUT_OFF);
  expect("phi 25, psi 10, cohesion", &clay, WITHOUT_CUT_OFF);
  expect("phi 45, associated", &dense, WITHOUT_CUT_OFF);
}
END_TEST

START_TEST(cut_off)
{
  struct soil none = soil(30, 10, 1e4, 0.0, 0), some = soil(35, 0, 1e4, 3e3, 0);
  expect("no tension", &none, (BIT(PLACES) - 1) & ~BIT(TIP));
  expect("some tension", &some, (BIT(PLACES) - 1) & ~BIT(TIP));
}
END_TEST

START_TEST(smooth)
{
  struct soil sand = soil(30, 10, 0, INFINITY, 1), clay = soil(25, 10, 5e3, INFINITY, 1), cut = soil(30, 0, 5e3, 0, 1);
  expect("smooth, phi 30", &sand, BIT(INSIDE) | BIT(PLANE) | BIT(TIP));
  expect("smooth, cohesion", &clay, BIT(INSIDE) | BIT(PLANE));
  expect("smooth, no tension", &cut, (BIT(PLACES) - 1) & ~BIT(TIP) & ~BIT(LOWER_EDGE) & ~BIT(UPPER_EDGE));
}
END_TEST

/* Menetrey and Willam's potential of principal stresses, from invariants */
static double potential(const struct soil *s, const double v[3])
{
  double p = (v[0] + v[1] + v[2]) / 3.0, a = v[0] - p, b = v[1] - p, c = v[2] - p, e = s->flow.roundness;
  double q = sqrt(1.5 * (a * a + b * b + c * c)), flat = 1 - e * e, sharp = 2 * e - 1;
  double cosine = cos(acos(fmax(-1.0, fmin(1.0, 13.5 * a * b * c / (q * q * q)))) / 3.0);
  double R = (4 * flat * cosine * cosine + sharp * sharp) /
             (2 * flat * cosine + sharp * sqrt(4 * flat * cosine * cosine + 5 * e * e - 4 * e)) * (3 - sin(s->phi)) /
             (6 * cos(s->phi));
  return hypot(0.1 * s->cohesion * tan(s->psi), R * q) + p * tan(s->psi);
}

/* largest difference of the directions of a plastic strain and of the potential's gradient; 0 near its tip and edges,
 * where differences fail */
static double off_gradient(const struct soil *s, const double t[3], const double v[3])
{
  double e[3], gradient[3], strain = 0.0, slope = 0.0, off = 0.0, scale = fmax(fabs(t[0]), fabs(t[2]));
  if (fmin(v[1] - v[0], v[2] - v[1]) < 1e-3 * scale) return 0.0;
  plastic_strain(s, t, v, e);
  for (int k = 0; k < 3; k++) {
    double up[3] = {v[0], v[1], v[2]}, down[3] = {v[0], v[1], v[2]}, step = 1e-6 * scale;
    up[k] += step, down[k] -= step;
    gradient[k] = (potential(s, up) - potential(s, down)) / (2.0 * step);
    strain += e[k] * e[k], slope += gradient[k] * gradient[k];
  }
  if (sqrt(strain) < 1e-3 * scale / s->elastic.shear) return 0.0;
  for (int k = 0; k < 3; k++) off = fmax(off, fabs(e[k] / sqrt(strain) - gradient[k] / sqrt(slope)));
  return off;
}

START_TEST(smooth_gradient)
{
  const struct soil soils[3] = {soil(30, 0, 0, INFINITY, 1), soil(40, 15, 0, INFINITY, 1),
                                soil(25, 10, 5e3, INFINITY, 1)};
  for (int n = 0; n < 3; n++) {
    const struct soil *s = &soils[n];
    uint64_t           seed = 2;
    double             worst = 0.0;
    int                seen = 0;
    for (int i = 0; i < 100000; i++) {
      VECTOR trial[3], value[3];
      double t[3], v[3], off;
      random_trial(&seed, t);
      if (yield_of(s, t) <= 0.0) continue;
      for (int k = 0; k < 3; k++) trial[k] = VECTOR_ALL(t[k]);
      coulomb_return(&s->elastic, &s->strength, &s->flow, trial, value);
      for (int k = 0; k < 3; k++) v[k] = value[k][0];
      off = off_gradient(s, t, v);
      worst = fmax(worst, off);
      seen += off > 0.0;
    }
    printf("smooth flow: %.1e off the gradient in %d returns\n", worst, seen);
    ck_assert_int_gt(seen, 1000);
    ck_assert_double_le(worst, 1e-5);
  }
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("constitutive/coulomb");
  TCase *tests = tcase_create("returns");
  tcase_add_test(tests, planes);
  tcase_add_test(tests, cut_off);
  tcase_add_test(tests, smooth);
  tcase_add_test(tests, smooth_gradient);
  suite_add_tcase(suite, tests);
  return battery_run(suite);
}
