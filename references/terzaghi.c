/* One-dimensional consolidation with compressible water: a column under a load that is applied at once and kept,
 * drained at its top, closed at its base; quasi-static. docs/references.md, "Consolidation of a column". */
#include "references/conductivity.h"
#include "references/elastic.h"
#include "references/reference.h"

struct terzaghi {
  struct conductivity pores;
  double              young, poisson, bulk_modulus, height, load, base;
};

static const struct param params[] = {
    {"young", PARAM_NUMBER, offsetof(struct terzaghi, young), "Pa", 1e-6, 1e15, NULL, NULL, "Young's modulus"},
    {"poisson", PARAM_NUMBER, offsetof(struct terzaghi, poisson), "-", -0.99, 0.499, NULL, NULL, "Poisson's ratio"},
    {"bulk_modulus", PARAM_NUMBER, offsetof(struct terzaghi, bulk_modulus), "Pa", 1, INFINITY, NULL, NULL,
     "bulk modulus of the liquid; infinite: no storage"},
    CONDUCTIVITY_PARAMS(struct terzaghi, pores),
    {"height", PARAM_NUMBER, offsetof(struct terzaghi, height), "m", 1e-9, 1e9, NULL, NULL, "height of the column"},
    {"load", PARAM_NUMBER, offsetof(struct terzaghi, load), "Pa", -1e12, 1e12, NULL, NULL,
     "pressure of the load on the skeleton"},
    {"base", PARAM_NUMBER, offsetof(struct terzaghi, base), "m", -1e9, 1e9, "0", NULL, "y of the base"},
    PARAM_END,
};

enum { P, STRESS_YY, DISPLACEMENT_Y, SETTLEMENT, BASE_PRESSURE, P0 };

static double modulus(const struct terzaghi *c) { return elastic_oedometer(c->young, c->poisson); }

/* 1 + M S: how much the water's own compression softens the undrained column */
static double softening(const struct terzaghi *c) { return 1.0 + modulus(c) * c->pores.porosity / c->bulk_modulus; }

/* Pa */
static double undrained(const struct terzaghi *c) { return c->load / softening(c); }

/* m2/s, without storage */
static double diffusivity(const struct terzaghi *c)
{
  return conductivity(&c->pores) / (c->pores.density * c->pores.gravity) * modulus(c);
}

/* z above the base in units of the height, inside the column */
static double height_of(const struct terzaghi *c, double y) { return fmin(fmax((y - c->base) / c->height, 0), 1); }

/* ierfc(x) = integral of erfc from x to infinity */
static double ierfc(double x) { return exp(-x * x) / sqrt(M_PI) - x * erfc(x); }

/* p/p0 and its integral from the base, at z in [0, 1] and diffusion time T > 0, from images: good for T <= 0.2 */
static void images(double z, double T, double *p, double *sum)
{
  double r = 2.0 * sqrt(T);
  *p = 1.0, *sum = z;
  for (int k = 0; k < 4; k++) {
    double a = 2 * k + 1, sign = k % 2 ? 1.0 : -1.0;
    *p += sign * (erfc((a - z) / r) + erfc((a + z) / r));
    *sum += sign * r * (ierfc((a - z) / r) - ierfc((a + z) / r));
  }
}

/* the same from modes, good for T >= 0.05 */
static void modes(double z, double T, double *p, double *sum)
{
  *p = *sum = 0.0;
  for (int m = 0; m < 12; m++) {
    double b = (m + 0.5) * M_PI, a = (m % 2 ? -2.0 : 2.0) / b * exp(-b * b * T);
    *p += a * cos(b * z);
    *sum += a * sin(b * z) / b;
  }
}

/* z = 1 is drained from the start */
static void pressure(const struct terzaghi *c, double z, double t, double *p, double *sum)
{
  double T = diffusivity(c) / softening(c) * t / (c->height * c->height);
  if (T <= 0.0)
    *p = z < 1.0, *sum = z;
  else
    (T < 0.1 ? images : modes)(z, T, p, sum);
}

static double one(const struct terzaghi *c, int quantity, double y, double t)
{
  double z = quantity == SETTLEMENT ? 1.0 : quantity == BASE_PRESSURE ? 0.0 : height_of(c, y), p, sum;
  double p0 = undrained(c), u;
  pressure(c, z, t, &p, &sum);
  u = (c->load * z - p0 * sum) * c->height / modulus(c); /* downwards */
  switch (quantity) {
  case P:
  case BASE_PRESSURE:
    return p0 * p;
  case STRESS_YY:
    return p0 * p - c->load;
  case DISPLACEMENT_Y:
    return -u;
  case SETTLEMENT:
    return u;
  default:
    return p0;
  }
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  if (diffusivity(prm) <= 0.0) return FAIL(ERR_INPUT, "terzaghi: permeability and grain_diameter are both 0; give one");
  for (int i = 0; i < n; i++) v[i] = one(prm, quantity, x[i][1], t);
  return OK;
}

/* T_v = 1 */
static double time_scale(const void *prm)
{
  const struct terzaghi *c = prm;
  return c->height * c->height / diffusivity(c);
}

static double scale(const void *prm, int quantity)
{
  const struct terzaghi *c = prm;
  if (quantity == DISPLACEMENT_Y || quantity == SETTLEMENT) return fabs(c->load) * c->height / modulus(c);
  return quantity == STRESS_YY ? fabs(c->load) : fabs(undrained(c));
}

const struct reference reference_terzaghi = {
    .name = "terzaghi",
    .source = "Terzaghi's series with storage",
    .params = params,
    .param_size = sizeof(struct terzaghi),
    .quantities = "P|stress_yy|displacement_y|settlement|base_pressure|p0",
    .value = value,
    .time_scale = time_scale,
    .scale = scale,
};
