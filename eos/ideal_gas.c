/* Ideal gas: P = rho R T, R = P_ref/(rho_ref T_ref), e = c_v T. Pressures are absolute. */
#include "eos/eos.h"
#include "eos/gas.h"

struct ideal_gas {
  double rho_ref, P_ref, T_ref, heat_capacity;
};

static const struct param params[] = {
    {"reference_density", PARAM_NUMBER, offsetof(struct ideal_gas, rho_ref), "kg/m3", 1e-6, 100, NULL, NULL,
     "density at the reference pressure and temperature; air: 1.1766"},
    {"reference_pressure", PARAM_NUMBER, offsetof(struct ideal_gas, P_ref), "Pa", 1e-6, 1e12, "101325", NULL,
     "absolute pressure at which the density is the reference density"},
    {"reference_temperature", PARAM_NUMBER, offsetof(struct ideal_gas, T_ref), "K", 1e-3, 1e4, "300", NULL,
     "temperature at which the density is the reference density"},
    {"heat_capacity", PARAM_NUMBER, offsetof(struct ideal_gas, heat_capacity), "J/kg/K", 1e-3, 1e6, "717.6", NULL,
     "specific heat at constant volume, R/(gamma - 1)"},
    PARAM_END,
};

static struct gas gas_of(const void *prm)
{
  const struct ideal_gas *g = prm;
  return (struct gas){g->rho_ref, g->T_ref, g->P_ref / g->rho_ref, 0.0};
}

static void pressure(const void *prm, int n, const double *rho, const double *T, double *P)
{
  gas_pressure(gas_of(prm), n, rho, T, P);
}

static void density(const void *prm, int n, const double *P, const double *T, double *rho)
{
  gas_density(gas_of(prm), n, P, T, rho);
}

static void compressibility(const void *prm, int n, const double *P, const double *T, double *kappa)
{
  gas_compressibility(gas_of(prm), n, P, T, kappa);
}

static void expansion(const void *prm, int n, const double *P, const double *T, double *alpha)
{
  gas_expansion(gas_of(prm), n, P, T, alpha);
}

static void sound_speed(const void *prm, int n, const double *P, const double *T, double *c)
{
  gas_sound_speed(gas_of(prm), n, P, T, c);
}

static int outside(const void *prm, int n, const double *P, const double *T)
{
  return gas_outside(gas_of(prm), n, P, T);
}

static double heat_capacity(const void *prm) { return ((const struct ideal_gas *)prm)->heat_capacity; }

static void energy(const void *prm, int n, const double *rho, const double *T, double *e)
{
  const struct ideal_gas *g = prm;
  (void)rho;
  for (int i = 0; i < n; i++) e[i] = g->heat_capacity * (T ? T[i] : g->T_ref);
}

static void temperature(const void *prm, int n, const double *rho, const double *e, double *T)
{
  const struct ideal_gas *g = prm;
  (void)rho;
  for (int i = 0; i < n; i++) T[i] = e[i] / g->heat_capacity;
}

const struct eos eos_ideal_gas = {
    .name = "ideal_gas",
    .source = "1, Ideal gas",
    .range = GAS_RANGE,
    .params = params,
    .param_size = sizeof(struct ideal_gas),
    .pressure = pressure,
    .density = density,
    .compressibility = compressibility,
    .expansion = expansion,
    .sound_speed = sound_speed,
    .heat_capacity = heat_capacity,
    .energy = energy,
    .temperature = temperature,
    .outside = outside,
};
