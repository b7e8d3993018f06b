/* Stiffened gas: P = (gamma - 1) rho c_v T - p_inf, e = c_v T + p_inf/rho. The bulk modulus at constant temperature is
 * P + p_inf, at constant entropy gamma times that; p_inf = K - P_ref, c_v = K/((gamma - 1) rho_ref T_ref). */
#include "eos/eos.h"
#include "eos/gas.h"

struct stiffened_gas {
  double rho_ref, K, gamma, P_ref, T_ref;
};

static const struct param params[] = {
    {"reference_density", PARAM_NUMBER, offsetof(struct stiffened_gas, rho_ref), "kg/m3", 1e-6, 1e5, NULL, NULL,
     "density at the reference pressure and temperature"},
    {"bulk_modulus", PARAM_NUMBER, offsetof(struct stiffened_gas, K), "Pa", 1e-6, 1e13, NULL, NULL,
     "bulk modulus at constant temperature, in the reference state: reference_pressure + p_inf"},
    {"gamma", PARAM_NUMBER, offsetof(struct stiffened_gas, gamma), "-", 1.001, 100, "4.4", NULL,
     "bulk modulus at constant entropy over that at constant temperature"},
    {"reference_pressure", PARAM_NUMBER, offsetof(struct stiffened_gas, P_ref), "Pa", -1e12, 1e12, "0", NULL,
     "pressure at which the density is the reference density"},
    {"reference_temperature", PARAM_NUMBER, offsetof(struct stiffened_gas, T_ref), "K", 1e-3, 1e4, "283.15", NULL,
     "temperature at which the density is the reference density"},
    PARAM_END,
};

static struct gas gas_of(const void *prm)
{
  const struct stiffened_gas *g = prm;
  return (struct gas){g->rho_ref, g->T_ref, g->K / g->rho_ref, g->K - g->P_ref};
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

static double heat_capacity(const void *prm)
{
  const struct stiffened_gas *g = prm;
  return g->K / ((g->gamma - 1.0) * g->rho_ref * g->T_ref);
}

/* p_inf/rho, the part of e that T does not change; infinite where no density is positive */
static double cold_energy(const struct stiffened_gas *g, double rho)
{
  return rho > 0.0 ? (g->K - g->P_ref) / rho : INFINITY;
}

static void energy(const void *prm, int n, const double *rho, const double *T, double *e)
{
  const struct stiffened_gas *g = prm;
  double                      c_v = heat_capacity(g);
  for (int i = 0; i < n; i++) e[i] = cold_energy(g, rho[i]) + c_v * (T ? T[i] : g->T_ref);
}

static void temperature(const void *prm, int n, const double *rho, const double *e, double *T)
{
  const struct stiffened_gas *g = prm;
  double                      c_v = heat_capacity(g);
  for (int i = 0; i < n; i++) T[i] = (e[i] - cold_energy(g, rho[i])) / c_v;
}

const struct eos eos_stiffened_gas = {
    .name = "stiffened_gas",
    .source = "1, Stiffened gas",
    .range = GAS_RANGE,
    .params = params,
    .param_size = sizeof(struct stiffened_gas),
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
