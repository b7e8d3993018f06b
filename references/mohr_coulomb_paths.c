/* One point of a linear elastic soil with Mohr and Coulomb's strength, led along paths whose stress is known: triaxial
 * tests, plane strain, shear without change of volume, tension on all sides. Before `begin` it is compressed on all
 * sides in proportion to time. docs/references.md, "Stress paths". */
#include "references/reference.h"

struct path {
  double young, poisson, friction, cohesion, tension; /* Pa, -, deg, Pa, Pa */
  double residual_friction, residual_cohesion;        /* deg, Pa */
  double softening_start, softening_end;              /* plastic shear strain */
  double pressure, begin, rate;                       /* Pa, s, 1/s */
};

#define AT(member) offsetof(struct path, member)
static const struct param params[] = {
    {"young", PARAM_NUMBER, AT(young), "Pa", 1e-6, 1e15, NULL, NULL, "Young's modulus"},
    {"poisson", PARAM_NUMBER, AT(poisson), "-", 0, 0.499, NULL, NULL, "Poisson's ratio"},
    {"friction_angle_deg", PARAM_NUMBER, AT(friction), "deg", 0, 60, NULL, NULL, "friction angle"},
    {"cohesion", PARAM_NUMBER, AT(cohesion), "Pa", 0, 1e12, "0", NULL, "cohesion"},
    {"tension_strength", PARAM_NUMBER, AT(tension), "Pa", 0, INFINITY, "infinite", NULL, "largest tensile stress"},
    {"residual_friction_angle_deg", PARAM_NUMBER, AT(residual_friction), "deg", 0, INFINITY, "null", NULL,
     "friction angle after softening; null: the first"},
    {"residual_cohesion", PARAM_NUMBER, AT(residual_cohesion), "Pa", 0, INFINITY, "null", NULL,
     "cohesion after softening; null: the first"},
    {"softening_start", PARAM_NUMBER, AT(softening_start), "-", 0, 1e6, "0", NULL,
     "plastic shear strain where softening starts"},
    {"softening_end", PARAM_NUMBER, AT(softening_end), "-", 0, INFINITY, "infinite", NULL, "where it ends"},
    {"pressure", PARAM_NUMBER, AT(pressure), "Pa", 0, 1e12, "0", NULL, "pressure on all sides at `begin`"},
    {"begin", PARAM_NUMBER, AT(begin), "s", 0, 1e9, "0", NULL, "time at which the path leaves that pressure"},
    {"rate", PARAM_NUMBER, AT(rate), "1/s", 0, 1e9, NULL, NULL, "rate of the path's strain"},
    PARAM_END,
};

enum { COMPRESSION, EXTENSION, PLANE, SHEAR, TENSION };

static double radians(double degrees) { return degrees * (M_PI / 180.0); }

/* axial less lateral stress at which an axial test under `pressure` fails, both taken positive */
static double failure(const struct path *p, int quantity)
{
  double s = sin(radians(p->friction)), c = p->cohesion * cos(radians(p->friction));
  return quantity == EXTENSION ? 2.0 * (p->pressure * s + c) / (1.0 + s) : 2.0 * (p->pressure * s + c) / (1.0 - s);
}

/* tau = pressure sin(phi) + c cos(phi) with what the plastic shear strain gamma has left */
static double bears(const struct path *p, double gamma)
{
  double length = p->softening_end - p->softening_start, lost = 0.0;
  double phi = p->friction, left = fmin(p->residual_friction, phi), c = p->cohesion,
         c_left = fmin(p->residual_cohesion, c);
  if (p->softening_end < INFINITY) lost = fmin(1.0, fmax(0.0, (gamma - p->softening_start) / length));
  phi = radians(phi + lost * (left - phi));
  return p->pressure * sin(phi) + (c + lost * (c_left - c)) * cos(phi);
}

/* Strains e and -e: elastic up to tau = bears(2 e - tau/G), whose sides cross once while softening is slower than
 * unloading. */
static double sheared(const struct path *p, double strain)
{
  enum { HALVINGS = 100 };
  double G = 0.5 * p->young / (1.0 + p->poisson), low = 0.0, high = 2.0 * G * strain;
  if (high <= bears(p, 0.0)) return high;
  for (int i = 0; i < HALVINGS; i++) {
    double tau = 0.5 * (low + high);
    *(tau < bears(p, 2.0 * strain - tau / G) ? &low : &high) = tau;
  }
  return low;
}

/* on all sides: up to the tip c cot(phi), or the cut-off */
static double pulled(const struct path *p, double strain)
{
  double elastic = -p->pressure + p->young / (1.0 - 2.0 * p->poisson) * strain;
  return fmin(elastic, fmin(p->tension, p->friction > 0.0 ? p->cohesion / tan(radians(p->friction)) : INFINITY));
}

static double one(const struct path *p, int quantity, double t)
{
  double strain = p->rate * (t - p->begin), nu = p->poisson;
  if (t < p->begin) return quantity == SHEAR ? 0.0 : -p->pressure * t / p->begin;
  switch (quantity) {
  case COMPRESSION:
    return -p->pressure - fmin(p->young * strain, failure(p, quantity));
  case EXTENSION:
    return -p->pressure + fmin(p->young * strain, failure(p, quantity));
  case PLANE:
    return -p->pressure - fmin(p->young / (1.0 - nu * nu) * strain, failure(p, quantity));
  case SHEAR:
    return sheared(p, strain);
  default:
    return pulled(p, strain);
  }
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  (void)x;
  for (int i = 0; i < n; i++) v[i] = one(prm, quantity, t);
  return OK;
}

/* the largest stress on the path; of an extension the smallest, at its end */
static double scale(const void *prm, int quantity)
{
  const struct path *p = prm;
  if (quantity == SHEAR) return bears(p, 0.0);
  if (quantity == TENSION) return fmax(p->pressure, fabs(pulled(p, 1e3)));
  return quantity == EXTENSION ? fabs(p->pressure - failure(p, quantity)) : p->pressure + failure(p, quantity);
}

const struct reference reference_mohr_coulomb_paths = {
    .name = "mohr_coulomb_paths",
    .source = "Mohr and Coulomb's criterion",
    .params = params,
    .param_size = sizeof(struct path),
    .quantities = "compression|extension|plane|shear|tension",
    .value = value,
    .scale = scale,
};
