/* Two fluids at rest, one above the other, each as dense as the pressure makes it. docs/references.md, "Layers at
 * rest". */
#include "references/reference.h"

enum law { LINEAR, TAIT, GAS };

struct layer {
  int    law;
  double density, bulk_modulus, gamma, reference_pressure;
};

struct layers {
  struct layer upper, lower;
  double       gravity, top, interface, base, top_pressure;
};

static const struct param params[] = {
    {"gravity", PARAM_NUMBER, offsetof(struct layers, gravity), "m/s2", 1e-9, 1e9, "9.81", NULL, "gravity, downwards"},
    {"top", PARAM_NUMBER, offsetof(struct layers, top), "m", -1e9, 1e9, NULL, NULL, "y of the top of the upper layer"},
    {"interface", PARAM_NUMBER, offsetof(struct layers, interface), "m", -1e9, 1e9, NULL, NULL, "y where they meet"},
    {"base", PARAM_NUMBER, offsetof(struct layers, base), "m", -1e9, 1e9, "0", NULL,
     "y of the base of the lower layer"},
    {"top_pressure", PARAM_NUMBER, offsetof(struct layers, top_pressure), "Pa", -1e12, 1e12, "101325", NULL,
     "pressure at the top"},
    {"upper_law", PARAM_CHOICE, offsetof(struct layers, upper.law), "-", 0, 0, "gas", "linear|tait|gas",
     "of the upper layer, at one temperature"},
    {"upper_density", PARAM_NUMBER, offsetof(struct layers, upper.density), "kg/m3", 1e-9, 1e9, "1.1766", NULL,
     "its density at its reference pressure"},
    {"upper_bulk_modulus", PARAM_NUMBER, offsetof(struct layers, upper.bulk_modulus), "Pa", 1, INFINITY, "2.2e9", NULL,
     "its bulk modulus at its reference pressure; not used by gas"},
    {"upper_gamma", PARAM_NUMBER, offsetof(struct layers, upper.gamma), "-", 1, 100, "7.15", NULL, "used by tait only"},
    {"upper_reference_pressure", PARAM_NUMBER, offsetof(struct layers, upper.reference_pressure), "Pa", -1e12, 1e12,
     "101325", NULL, "its reference pressure"},
    {"lower_law", PARAM_CHOICE, offsetof(struct layers, lower.law), "-", 0, 0, "linear", "linear|tait|gas",
     "of the lower layer, at one temperature"},
    {"lower_density", PARAM_NUMBER, offsetof(struct layers, lower.density), "kg/m3", 1e-9, 1e9, "1000", NULL,
     "its density at its reference pressure"},
    {"lower_bulk_modulus", PARAM_NUMBER, offsetof(struct layers, lower.bulk_modulus), "Pa", 1, INFINITY, "2.2e9", NULL,
     "its bulk modulus at its reference pressure; not used by gas"},
    {"lower_gamma", PARAM_NUMBER, offsetof(struct layers, lower.gamma), "-", 1, 100, "7.15", NULL, "used by tait only"},
    {"lower_reference_pressure", PARAM_NUMBER, offsetof(struct layers, lower.reference_pressure), "Pa", -1e12, 1e12,
     "101325", NULL, "its reference pressure"},
    PARAM_END,
};

enum { P, DENSITY, INTERFACE_PRESSURE, BASE_PRESSURE, UPPER_MASS, LOWER_MASS };

/* 1 + gamma (P - P_ref)/K: the bulk modulus over that of the reference state; linear: gamma = 1 */
static double stiffening(const struct layer *l, double gamma, double pressure)
{
  return 1 + gamma * (pressure - l->reference_pressure) / l->bulk_modulus;
}

/* kg/m3 */
static double density(const struct layer *l, double pressure)
{
  switch (l->law) {
  case GAS:
    return l->density * pressure / l->reference_pressure;
  case TAIT:
    return l->density * pow(stiffening(l, l->gamma, pressure), 1 / l->gamma);
  default:
    return l->density * stiffening(l, 1, pressure);
  }
}

/* Pa more at the depth d, m, below a place of the pressure `above`: dP/dd = rho(P) g */
static double increase(const struct layer *l, double gravity, double above, double d)
{
  double weight = l->density * gravity * d, K = l->bulk_modulus, more = l->gamma - 1, b;
  if (l->law == GAS) return above * expm1(weight / l->reference_pressure);
  if (isinf(K)) return weight;
  if (l->law == LINEAR || more == 0) return K * stiffening(l, 1, above) * expm1(weight / K);
  b = stiffening(l, l->gamma, above);
  return K / l->gamma * b * expm1(l->gamma / more * log1p(more * weight / (K * pow(b, more / l->gamma))));
}

static double interface_pressure(const struct layers *s)
{
  return s->top_pressure + increase(&s->upper, s->gravity, s->top_pressure, s->top - s->interface);
}

static double pressure(const struct layers *s, double y)
{
  double at = interface_pressure(s);
  if (y < s->interface) return at + increase(&s->lower, s->gravity, at, s->interface - y);
  return s->top_pressure + increase(&s->upper, s->gravity, s->top_pressure, s->top - y);
}

static double one(const struct layers *s, int quantity, double y)
{
  switch (quantity) {
  case P:
    return pressure(s, y);
  case DENSITY:
    return density(y < s->interface ? &s->lower : &s->upper, pressure(s, y));
  case INTERFACE_PRESSURE:
    return interface_pressure(s);
  case BASE_PRESSURE:
    return pressure(s, s->base);
  case UPPER_MASS:
    return (interface_pressure(s) - s->top_pressure) / s->gravity;
  default:
    return (pressure(s, s->base) - interface_pressure(s)) / s->gravity;
  }
}

static enum status check_layer(const struct layer *l, const char *name)
{
  if (l->law != GAS || l->reference_pressure > 0) return OK;
  return FAIL(ERR_INPUT, "hydrostatic_layers: %s_reference_pressure is %g; a gas needs an absolute one, above 0", name,
              l->reference_pressure);
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  const struct layers *s = prm;
  (void)t;
  if (s->top < s->interface || s->interface < s->base)
    return FAIL(ERR_INPUT, "hydrostatic_layers: top %g, interface %g, base %g must follow downwards", s->top,
                s->interface, s->base);
  TRY(check_layer(&s->upper, "upper"));
  TRY(check_layer(&s->lower, "lower"));
  for (int i = 0; i < n; i++) v[i] = one(s, quantity, x[i][1]);
  return OK;
}

/* pressures by what the two layers weigh */
static double scale(const void *prm, int quantity)
{
  const struct layers *s = prm;
  double               weight = pressure(s, s->base) - s->top_pressure;
  if (quantity == DENSITY) return s->lower.density;
  return weight > 0 ? (quantity < UPPER_MASS ? weight : weight / s->gravity) : 1;
}

const struct reference reference_hydrostatic_layers = {
    .name = "hydrostatic_layers",
    .source = "dP/dy = -rho(P) g, integrated",
    .params = params,
    .param_size = sizeof(struct layers),
    .quantities = "P|density|interface_pressure|base_pressure|upper_mass|lower_mass",
    .value = value,
    .scale = scale,
};
