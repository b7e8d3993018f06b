/* Isothermal gas: P = (P_ref/rho_ref) rho, whatever the temperature. Pressures are absolute. */
#include "eos/edge.h"
#include "eos/eos.h"
#include "eos/gas.h"

struct isothermal_gas {
  double rho_ref, P_ref, T_ref, heat_capacity;
};

static const struct param params[] = {
    {"reference_density", PARAM_NUMBER, offsetof(struct isothermal_gas, rho_ref), "kg/m3", 1e-6, 100, NULL, NULL,
     "density at the reference pressure; air: 1.1766"},
    {"reference_pressure", PARAM_NUMBER, offsetof(struct isothermal_gas, P_ref), "Pa", 1e-6, 1e12, "101325", NULL,
     "absolute pressure at which the density is the reference density"},
    {"reference_temperature", PARAM_NUMBER, offsetof(struct isothermal_gas, T_ref), "K", 1e-3, 1e4, "300", NULL,
     "temperature from which the energy counts"},
    {"heat_capacity", PARAM_NUMBER, offsetof(struct isothermal_gas, heat_capacity), "J/kg/K", 1e-3, 1e6, "717.6", NULL,
     "specific heat at constant volume"},
    PARAM_END,
};

/* the same at every temperature */
static struct gas gas_of(const void *prm)
{
  const struct isothermal_gas *g = prm;
  return (struct gas){g->rho_ref, g->T_ref, g->P_ref / g->rho_ref, 0.0};
}

static void pressure(const void *prm, int n, const double *rho, const double *T, double *P)
{
  (void)T;
  gas_pressure(gas_of(prm), n, rho, NULL, P);
}

static void density(const void *prm, int n, const double *P, const double *T, double *rho)
{
  (void)T;
  gas_density(gas_of(prm), n, P, NULL, rho);
}

static void compressibility(const void *prm, int n, const double *P, const double *T, double *kappa)
{
  (void)T;
  gas_compressibility(gas_of(prm), n, P, NULL, kappa);
}

static void expansion(const void *prm, int n, const double *P, const double *T, double *alpha)
{
  (void)prm, (void)P, (void)T;
  for (int i = 0; i < n; i++) alpha[i] = 0.0;
}

static void sound_speed(const void *prm, int n, const double *P, const double *T, double *c)
{
  (void)T;
  gas_sound_speed(gas_of(prm), n, P, NULL, c);
}

static int outside(const void *prm, int n, const double *P, const double *T)
{
  (void)T;
  return gas_outside(gas_of(prm), n, P, NULL);
}

static double heat_capacity(const void *prm) { return ((const struct isothermal_gas *)prm)->heat_capacity; }

/* e at T_ref: the integral of P/rho^2 over rho from rho_ref */
static double cold_energy(const struct isothermal_gas *g, double rho)
{
  struct edge edge = gas_edge(gas_of(g), NULL, 0);
  double      e = g->P_ref / g->rho_ref * log(fmax(rho, edge.rho) / g->rho_ref);
  return rho < edge.rho ? e + edge_energy(edge, edge.P, rho) : e;
}

static void energy(const void *prm, int n, const double *rho, const double *T, double *e)
{
  const struct isothermal_gas *g = prm;
  for (int i = 0; i < n; i++) e[i] = cold_energy(g, rho[i]) + (T ? g->heat_capacity * (T[i] - g->T_ref) : 0.0);
}

static void temperature(const void *prm, int n, const double *rho, const double *e, double *T)
{
  const struct isothermal_gas *g = prm;
  for (int i = 0; i < n; i++) T[i] = g->T_ref + (e[i] - cold_energy(g, rho[i])) / g->heat_capacity;
}

const struct eos eos_isothermal_gas = {
    .name = "isothermal_gas",
    .source = "1, Isothermal gas",
    .range = "a density of at least 1e-6 reference_density",
    .params = params,
    .param_size = sizeof(struct isothermal_gas),
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
