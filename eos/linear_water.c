/* Linear water: P = P_ref + K [rho/rho_ref - 1 + alpha (T - T_ref)]. With K infinite the density is a function of T
 * alone and the pressure none of the density: then pressure() gives P_ref. */
#include "eos/eos.h"

struct linear_water {
  double rho_ref, K, P_ref, alpha, T_ref, heat_capacity;
};

static const struct param params[] = {
    {"reference_density", PARAM_NUMBER, offsetof(struct linear_water, rho_ref), "kg/m3", 1e-3, 1e5, NULL, NULL,
     "density at the reference pressure and temperature"},
    {"bulk_modulus", PARAM_NUMBER, offsetof(struct linear_water, K), "Pa", 1, INFINITY, NULL, NULL,
     "bulk modulus at constant temperature; infinite: incompressible"},
    {"reference_pressure", PARAM_NUMBER, offsetof(struct linear_water, P_ref), "Pa", -1e12, 1e12, "0", NULL,
     "pressure at which the density is the reference density; 0 makes pressures gauge pressures"},
    {"expansion", PARAM_NUMBER, offsetof(struct linear_water, alpha), "1/K", -1e-2, 1e-2, "0", NULL,
     "thermal expansion per kelvin at the reference density"},
    {"reference_temperature", PARAM_NUMBER, offsetof(struct linear_water, T_ref), "K", 1, 1e4, "283.15", NULL,
     "temperature at which the density is the reference density"},
    {"heat_capacity", PARAM_NUMBER, offsetof(struct linear_water, heat_capacity), "J/kg/K", 1, 1e6, "4186", NULL,
     "specific heat at constant volume"},
    PARAM_END,
};

/* alpha (T - T_ref) of entry i */
static inline double swelling(const struct linear_water *w, const double *T, int i)
{
  return T ? w->alpha * (T[i] - w->T_ref) : 0.0;
}

static void pressure(const void *prm, int n, const double *rho, const double *T, double *P)
{
  const struct linear_water *w = prm;
  double                     K = isinf(w->K) ? 0.0 : w->K;
  for (int i = 0; i < n; i++) P[i] = w->P_ref + K * (rho[i] / w->rho_ref - 1.0 + swelling(w, T, i));
}

/* rho/rho_ref of entry i */
static inline double relative_density(const struct linear_water *w, const double *P, const double *T, int i)
{
  return 1.0 + (P[i] - w->P_ref) / w->K - swelling(w, T, i);
}

static void density(const void *prm, int n, const double *P, const double *T, double *rho)
{
  const struct linear_water *w = prm;
  for (int i = 0; i < n; i++) rho[i] = w->rho_ref * relative_density(w, P, T, i);
}

static void compressibility(const void *prm, int n, const double *P, const double *T, double *kappa)
{
  const struct linear_water *w = prm;
  for (int i = 0; i < n; i++) kappa[i] = 1.0 / (w->K * relative_density(w, P, T, i));
}

static void expansion(const void *prm, int n, const double *P, const double *T, double *alpha)
{
  const struct linear_water *w = prm;
  for (int i = 0; i < n; i++) alpha[i] = w->alpha / relative_density(w, P, T, i);
}

/* isothermal: c^2 = dP/drho at constant T, the same everywhere */
static void sound_speed(const void *prm, int n, const double *P, const double *T, double *c)
{
  const struct linear_water *w = prm;
  (void)P, (void)T;
  for (int i = 0; i < n; i++) c[i] = sqrt(w->K / w->rho_ref);
}

static double heat_capacity(const void *prm) { return ((const struct linear_water *)prm)->heat_capacity; }

const struct eos eos_linear_water = {
    .name = "linear_water",
    .source = "1, linear water",
    .params = params,
    .param_size = sizeof(struct linear_water),
    .pressure = pressure,
    .density = density,
    .compressibility = compressibility,
    .expansion = expansion,
    .sound_speed = sound_speed,
    .heat_capacity = heat_capacity,
};
