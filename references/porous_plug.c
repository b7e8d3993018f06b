/* Steady flow of a liquid through a rigid porous plug between two pressures, for four drag laws.
 * docs/references.md, "Flow through a plug". */
#include "references/reference.h"

enum law { DARCY, KOZENY_CARMAN, ERGUN, BEETSTRA };

struct plug {
  int    law;
  double porosity, diameter, permeability, kozeny_factor, inertia_factor, density, viscosity, gravity;
  double length, inlet, drop;
};

static const struct param params[] = {
    {"law", PARAM_CHOICE, offsetof(struct plug, law), "-", 0, 0, "kozeny_carman", "darcy|kozeny_carman|ergun|beetstra",
     "drag law"},
    {"porosity", PARAM_NUMBER, offsetof(struct plug, porosity), "-", 1e-3, 0.999, NULL, NULL, "porosity of the plug"},
    {"grain_diameter", PARAM_NUMBER, offsetof(struct plug, diameter), "m", 0, 1e3, "0", NULL,
     "grain diameter; not used by darcy"},
    {"permeability", PARAM_NUMBER, offsetof(struct plug, permeability), "m/s", 0, 1e6, "0", NULL,
     "hydraulic conductivity; used by darcy only"},
    {"kozeny_factor", PARAM_NUMBER, offsetof(struct plug, kozeny_factor), "-", 1, 1e4, "180", NULL,
     "A in kappa = D2 n3/(A (1-n)2); not used by darcy and beetstra"},
    {"inertia_factor", PARAM_NUMBER, offsetof(struct plug, inertia_factor), "-", 0, 1e3, "1.75", NULL,
     "B of Ergun's law"},
    {"density", PARAM_NUMBER, offsetof(struct plug, density), "kg/m3", 1e-3, 1e5, NULL, NULL, "density of the liquid"},
    {"viscosity", PARAM_NUMBER, offsetof(struct plug, viscosity), "Pa s", 1e-12, 1e6, NULL, NULL,
     "viscosity of the liquid"},
    {"gravity", PARAM_NUMBER, offsetof(struct plug, gravity), "m/s2", 1e-3, 1e3, "9.81", NULL,
     "the g in which the hydraulic conductivity is meant"},
    {"length", PARAM_NUMBER, offsetof(struct plug, length), "m", 1e-9, 1e9, NULL, NULL, "length of the plug"},
    {"inlet", PARAM_NUMBER, offsetof(struct plug, inlet), "m", -1e9, 1e9, "0", NULL, "x where the plug begins"},
    {"pressure_drop", PARAM_NUMBER, offsetof(struct plug, drop), "Pa", 1e-12, 1e12, NULL, NULL,
     "pressure before the plug less that behind it"},
    PARAM_END,
};

enum { VEL_X, FLUX, P, REYNOLDS };

/* m2 */
static double intrinsic(const struct plug *p)
{
  double n = p->porosity, s = 1.0 - n;
  if (p->law == DARCY) return p->permeability * p->viscosity / (p->density * p->gravity);
  return p->diameter * p->diameter * n * n * n / (p->kozeny_factor * s * s);
}

/* Reynolds number of the grains, Beetstra et al. 2007: from the superficial velocity */
static double reynolds(const struct plug *p, double U)
{
  return p->porosity * p->density * p->diameter * U / p->viscosity;
}

/* Pa/m: drag per volume of plug over the porosity, from its definition; U m/s is the pore velocity */
static double gradient_beetstra(const struct plug *p, double U)
{
  double n = p->porosity, s = 1.0 - n, Re = reynolds(p, U), F = 10 * s / (n * n) + n * n * (1 + 1.5 * sqrt(s));
  double low = 1 / n + 3 * s * n + 8.4 * pow(Re, -0.343), high = 1 + pow(10, 3 * s) * pow(Re, -(1 + 4 * s) / 2);
  if (Re > 0.0) F += 0.413 * Re / (24 * n * n) * low / high;
  return 18 * s * p->viscosity / (p->diameter * p->diameter) * F * U;
}

static double gradient(const struct plug *p, double U)
{
  double n = p->porosity, kappa = intrinsic(p);
  switch (p->law) {
  case BEETSTRA:
    return gradient_beetstra(p, U);
  case ERGUN:
    return n * p->viscosity / kappa * U +
           p->density * sqrt(n) * p->inertia_factor / sqrt(p->kozeny_factor * kappa) * U * U;
  default:
    return n * p->viscosity / kappa * U;
  }
}

/* m/s: gradient(U) = drop/length by bisection; the gradient grows with U */
static enum status velocity(const struct plug *p, double *U)
{
  double wanted = p->drop / p->length, low = 0.0, high = 1.0;
  if (p->law == DARCY ? p->permeability <= 0.0 : p->diameter <= 0.0)
    return FAIL(ERR_INPUT, "porous_plug: %s is not given; the drag law needs it",
                p->law == DARCY ? "permeability" : "grain_diameter");
  while (gradient(p, high) < wanted) high *= 2.0;
  for (int i = 0; i < 200 && high - low > 1e-15 * high; i++) {
    double middle = 0.5 * (low + high);
    if (gradient(p, middle) < wanted)
      low = middle;
    else
      high = middle;
  }
  *U = 0.5 * (low + high);
  return OK;
}

static double pressure(const struct plug *p, double x)
{
  return p->drop * (1.0 - fmin(fmax((x - p->inlet) / p->length, 0.0), 1.0));
}

/* pore velocity inside the plug, superficial before and behind it */
static double local_velocity(const struct plug *p, double x, double U)
{
  return x >= p->inlet && x <= p->inlet + p->length ? U : p->porosity * U;
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  const struct plug *p = prm;
  double             U;
  (void)t;
  TRY(velocity(p, &U));
  for (int i = 0; i < n; i++) switch (quantity) {
    case VEL_X:
      v[i] = local_velocity(p, x[i][0], U);
      break;
    case FLUX:
      v[i] = p->porosity * U;
      break;
    case P:
      v[i] = pressure(p, x[i][0]);
      break;
    default:
      v[i] = reynolds(p, U);
    }
  return OK;
}

static double scale(const void *prm, int quantity)
{
  const struct plug *p = prm;
  double             U;
  if (quantity == P) return p->drop;
  if (velocity(p, &U) != OK) return 1.0;
  return quantity == VEL_X ? U : quantity == FLUX ? p->porosity * U : reynolds(p, U);
}

const struct reference reference_porous_plug = {
    .name = "porous_plug",
    .source = "drag per volume = porosity times pressure gradient",
    .params = params,
    .param_size = sizeof(struct plug),
    .quantities = "vel_x|flux|P|reynolds",
    .value = value,
    .scale = scale,
};
