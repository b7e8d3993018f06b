/* Cylinder of saturated soil in plane strain, pressed on its drained rim from t = 0 on; quasi-static. The pressure in
 * the middle first rises above that of the start (Mandel and Cryer). docs/references.md, "Pressed cylinder". */
#include "references/conductivity.h"
#include "references/elastic.h"
#include "references/reference.h"

struct cylinder {
  struct conductivity pores;
  double              young, poisson, bulk_modulus, radius, load, centre[3];
};

static const struct param params[] = {
    {"young", PARAM_NUMBER, offsetof(struct cylinder, young), "Pa", 1e-6, 1e15, NULL, NULL, "Young's modulus"},
    {"poisson", PARAM_NUMBER, offsetof(struct cylinder, poisson), "-", -0.99, 0.499, NULL, NULL, "Poisson's ratio"},
    {"bulk_modulus", PARAM_NUMBER, offsetof(struct cylinder, bulk_modulus), "Pa", 1, INFINITY, NULL, NULL,
     "bulk modulus of the liquid; infinite: no storage"},
    CONDUCTIVITY_PARAMS(struct cylinder, pores),
    {"radius", PARAM_NUMBER, offsetof(struct cylinder, radius), "m", 1e-9, 1e9, NULL, NULL, "radius"},
    {"load", PARAM_NUMBER, offsetof(struct cylinder, load), "Pa", -1e12, 1e12, NULL, NULL, "pressure on the rim"},
    {"centre", PARAM_VECTOR, offsetof(struct cylinder, centre), "m", -1e9, 1e9, "0", NULL, "axis of the cylinder"},
    PARAM_END,
};

enum {
  P,
  STRESS_R,
  STRESS_R_TOTAL,
  DISPLACEMENT_R,
  CENTRE_P,
  CENTRE_STRESS,
  CENTRE_STRESS_TOTAL,
  RIM,
  P0,
  PEAK,
  PEAK_OVER_P0,
  PEAK_TIME
};

/* Figures of the series: its modes b obey a b J0(b) = d J1(b), d = 2 eta G/M, a = 1 - G/M + d/2. eta: what storage in
 * the liquid leaves of the modulus M, 1/(1 + M n/K). */
struct series {
  double M, shear, eta, a, d, rate; /* Pa, G/M, -, -, -, 1/s: diffusivity over R2 */
};

static struct series series_of(const struct cylinder *c)
{
  double M = elastic_oedometer(c->young, c->poisson), shear = elastic_shear(c->young, c->poisson) / M;
  double eta = 1 / (1 + M * c->pores.porosity / c->bulk_modulus), d = 2 * eta * shear;
  double diffusivity = conductivity(&c->pores) / (c->pores.density * c->pores.gravity) * M * eta;
  return (struct series){M, shear, eta, 1 - shear + 0.5 * d, d, diffusivity / (c->radius * c->radius)};
}

/* what the load raises the pressure to at once, over the load */
static double undrained(const struct series *s) { return 1 / ((1 - s->shear) / s->eta + s->shear); }

/* m-th mode, m = 0, 1, ...: between a zero of J1 and the next one of J0 */
static double mode(const struct series *s, int m)
{
  double low = (m + 0.25) * M_PI, high = (m + 0.75) * M_PI, sign = m % 2 ? -1 : 1;
  for (int i = 0; i < 6; i++) { /* these by Newton, from McMahon's estimates */
    if (m > 0) low -= j1(low) / (j0(low) - j1(low) / low);
    high += j0(high) / j1(high);
  }
  if (m == 0) low = 1e-9;
  for (int i = 0; i < 100 && high - low > 1e-15 * high; i++) {
    double middle = 0.5 * (low + high);
    if (sign * (s->a * middle * j0(middle) - s->d * j1(middle)) > 0)
      low = middle;
    else
      high = middle;
  }
  return 0.5 * (low + high);
}

/* at one radius, over the load: pressure, its mean over the disk within that radius, and the part of M div(u) that is
 * the same everywhere: M div(u) = pressure + common */
struct terms {
  double pressure, mean, common;
};

/* of the mode b at r = z R, without its decay */
static struct terms mode_terms(const struct series *s, double b, double z)
{
  double factor = 2 / (s->a * b * j1(b) - s->d * jn(2, b)), edge = j0(b), w = b * z;
  double mean = w > 1e-8 ? 2 * j1(w) / w : 1;
  return (struct terms){s->eta * factor * (j0(w) - edge), s->eta * factor * (mean - edge), factor * edge};
}

/* the quantity from its terms: u/r = (common + mean)/2M, total sigma_r = common - 2 G u/r; tension positive */
static double combine(const struct series *s, int quantity, double r, struct terms t)
{
  double total = t.common - s->shear * (t.common + t.mean);
  switch (quantity) {
  case P:
    return t.pressure;
  case STRESS_R:
    return total + t.pressure;
  case STRESS_R_TOTAL:
    return total;
  default:
    return 0.5 * r * (t.common + t.mean) / s->M;
  }
}

enum { MOST_MODES = 1 << 14 };

/* One of the four fields at the radii r [n] m. Modes that have decayed below 1e-17 are left out; before the diffusion
 * time 4/MOST_MODES^2 only the rim has drained. */
static void field(const struct cylinder *c, int quantity, int n, const double *r, double t, double *v)
{
  struct series s = series_of(c);
  double        time = s.rate * t, p0 = undrained(&s);
  bool          early = time * MOST_MODES * MOST_MODES < 4;
  int           modes = early ? 0 : (int)(2 / sqrt(time)) + 2;
  for (int i = 0; i < n; i++) {
    struct terms start = {r[i] < c->radius ? p0 : 0, p0, -p0 / s.eta}, end = {0, 0, -1 / (1 - s.shear)};
    v[i] = combine(&s, quantity, r[i], early ? start : end);
  }
  for (int m = 0; m < modes; m++) {
    double b = mode(&s, m), decay = exp(-b * b * time);
    for (int i = 0; i < n; i++) v[i] += decay * combine(&s, quantity, r[i], mode_terms(&s, b, r[i] / c->radius));
  }
  for (int i = 0; i < n; i++) v[i] *= c->load;
}

static double at_centre(const struct cylinder *c, int quantity, double t)
{
  double r = 0, v;
  field(c, quantity, 1, &r, t, &v);
  return v;
}

/* s, of the highest pressure in the middle, by the golden section between diffusion times 0.005 and 0.5 */
static double peak_time(const struct cylinder *c)
{
  const double golden = 0.5 * (sqrt(5) - 1);
  double       rate = series_of(c).rate, low = 0.005 / rate, high = 0.5 / rate, sign = c->load < 0 ? -1 : 1;
  for (int i = 0; i < 50; i++) {
    double early = high - golden * (high - low), late = low + golden * (high - low);
    if (sign * at_centre(c, P, early) < sign * at_centre(c, P, late))
      low = early;
    else
      high = late;
  }
  return 0.5 * (low + high);
}

/* numbers that have no place */
static double number(const struct cylinder *c, int quantity, double t)
{
  struct series s = series_of(c);
  double        rim;
  switch (quantity) {
  case RIM:
    field(c, DISPLACEMENT_R, 1, &c->radius, t, &rim);
    return rim;
  case P0:
    return c->load * undrained(&s);
  case PEAK:
    return at_centre(c, P, peak_time(c));
  case PEAK_OVER_P0:
    return at_centre(c, P, peak_time(c)) / (c->load * undrained(&s));
  case PEAK_TIME:
    return peak_time(c);
  default:
    return at_centre(c, P + quantity - CENTRE_P, t);
  }
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  enum { BLOCK = 256 };
  const struct cylinder *c = prm;
  double                 r[BLOCK];
  if (conductivity(&c->pores) <= 0.0)
    return FAIL(ERR_INPUT, "cryer_cylinder: permeability and grain_diameter are both 0; give one");
  if (quantity >= CENTRE_P) {
    double same = number(c, quantity, t);
    for (int i = 0; i < n; i++) v[i] = same;
    return OK;
  }
  for (int first = 0; first < n; first += BLOCK) {
    int m = n - first < BLOCK ? n - first : BLOCK;
    for (int i = 0; i < m; i++)
      r[i] = fmin(hypot(x[first + i][0] - c->centre[0], x[first + i][1] - c->centre[1]), c->radius);
    field(c, quantity, m, r, t, v + first);
  }
  return OK;
}

/* T_v = 1: R2/c_v, without storage */
static double time_scale(const void *prm)
{
  struct series s = series_of(prm);
  return s.eta / s.rate;
}

static double scale(const void *prm, int quantity)
{
  const struct cylinder *c = prm;
  struct series          s = series_of(c);
  double                 q = c->load != 0 ? fabs(c->load) : 1;
  switch (quantity) {
  case P:
  case CENTRE_P:
  case P0:
  case PEAK:
    return q * undrained(&s);
  case DISPLACEMENT_R:
  case RIM: /* in the end */
    return 0.5 * q * c->radius / (s.M * (1 - s.shear));
  case PEAK_OVER_P0:
    return 1;
  case PEAK_TIME:
    return time_scale(c);
  default:
    return q;
  }
}

const struct reference reference_cryer_cylinder = {
    .name = "cryer_cylinder",
    .source = "Biot's consolidation of a cylinder in plane strain, by modes",
    .params = params,
    .param_size = sizeof(struct cylinder),
    .quantities = "P|stress_r|stress_r_total|displacement_r|centre_P|centre_stress_r|centre_stress_r_total|rim|p0|peak|"
                  "peak_over_p0|peak_time",
    .value = value,
    .time_scale = time_scale,
    .scale = scale,
};
