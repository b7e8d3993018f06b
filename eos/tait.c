/* Tait's (Murnaghan's) liquid: a bulk modulus that grows with pressure, K + gamma (P - P_ref).
 * P = P_ref + (K/gamma) [(rho/rho_ref)^gamma - 1] + K alpha (T - T_ref); gamma = 1 is linear water. */
#include "eos/edge.h"
#include "eos/eos.h"

struct tait {
  double rho_ref, K, gamma, P_ref, alpha, T_ref, heat_capacity;
};

static const struct param params[] = {
    {"reference_density", PARAM_NUMBER, offsetof(struct tait, rho_ref), "kg/m3", 1e-3, 1e5, NULL, NULL,
     "density at the reference pressure and temperature"},
    {"bulk_modulus", PARAM_NUMBER, offsetof(struct tait, K), "Pa", 1, 1e13, NULL, NULL,
     "bulk modulus at constant temperature, in the reference state"},
    {"gamma", PARAM_NUMBER, offsetof(struct tait, gamma), "-", 1, 20, "7.15", NULL,
     "growth of the bulk modulus with pressure"},
    {"reference_pressure", PARAM_NUMBER, offsetof(struct tait, P_ref), "Pa", -1e12, 1e12, "0", NULL,
     "pressure at which the density is the reference density; 0 makes pressures gauge pressures"},
    {"expansion", PARAM_NUMBER, offsetof(struct tait, alpha), "1/K", -1e-2, 1e-2, "0", NULL,
     "thermal expansion per kelvin in the reference state"},
    {"reference_temperature", PARAM_NUMBER, offsetof(struct tait, T_ref), "K", 1, 1e4, "283.15", NULL,
     "temperature at which the density is the reference density"},
    {"heat_capacity", PARAM_NUMBER, offsetof(struct tait, heat_capacity), "J/kg/K", 1, 1e6, "4186", NULL,
     "specific heat at constant volume"},
    PARAM_END,
};

/* bulk modulus over that of the reference state, where the range ends */
static const double least = 0.1;

/* alpha (T - T_ref) of entry i */
static inline double swelling(const struct tait *t, const double *T, int i)
{
  return T ? t->alpha * (T[i] - t->T_ref) : 0.0;
}

/* (rho/rho_ref)^gamma of entry i, inside the range: the bulk modulus over that of the reference state */
static inline double stiffening(const struct tait *t, const double *P, const double *T, int i)
{
  return 1.0 + t->gamma * ((P[i] - t->P_ref) / t->K - swelling(t, T, i));
}

/* kg/m3, the lowest of the range */
static inline double least_density(const struct tait *t) { return t->rho_ref * pow(least, 1.0 / t->gamma); }

static struct edge edge_of(const struct tait *t, const double *T, int i)
{
  double rho = least_density(t);
  return (struct edge){rho, t->P_ref + t->K * ((least - 1.0) / t->gamma + swelling(t, T, i)), t->K * least / rho};
}

static void pressure(const void *prm, int n, const double *rho, const double *T, double *P)
{
  const struct tait *t = prm;
  double             lowest = least_density(t);
  for (int i = 0; i < n; i++) {
    double growth = expm1(t->gamma * log(fmax(rho[i], lowest) / t->rho_ref)) / t->gamma;
    P[i] = rho[i] < lowest ? edge_pressure(edge_of(t, T, i), rho[i]) : t->P_ref + t->K * (growth + swelling(t, T, i));
  }
}

/* kg/m3 where the stiffening is b */
static inline double density_at(const struct tait *t, double b, const double *P, const double *T, int i)
{
  return b < least ? edge_density(edge_of(t, T, i), P[i]) : t->rho_ref * pow(b, 1.0 / t->gamma);
}

static void density(const void *prm, int n, const double *P, const double *T, double *rho)
{
  const struct tait *t = prm;
  for (int i = 0; i < n; i++) rho[i] = density_at(t, stiffening(t, P, T, i), P, T, i);
}

static void compressibility(const void *prm, int n, const double *P, const double *T, double *kappa)
{
  const struct tait *t = prm;
  for (int i = 0; i < n; i++) {
    double b = stiffening(t, P, T, i);
    kappa[i] = b < least ? edge_compressibility(edge_of(t, T, i), density_at(t, b, P, T, i)) : 1.0 / (t->K * b);
  }
}

/* kappa times dP/dT at constant density */
static void expansion(const void *prm, int n, const double *P, const double *T, double *alpha)
{
  const struct tait *t = prm;
  compressibility(prm, n, P, T, alpha);
  for (int i = 0; i < n; i++) alpha[i] *= t->alpha * t->K;
}

/* c^2 = (K/rho_ref) (rho/rho_ref)^(gamma - 1) */
static void sound_speed(const void *prm, int n, const double *P, const double *T, double *c)
{
  const struct tait *t = prm;
  for (int i = 0; i < n; i++) {
    double b = stiffening(t, P, T, i), rho = density_at(t, b, P, T, i);
    c[i] = b < least ? edge_sound_speed(edge_of(t, T, i), rho) : sqrt(t->K * b / rho);
  }
}

static double heat_capacity(const void *prm) { return ((const struct tait *)prm)->heat_capacity; }

/* e at T_ref: the integral of (P - T dP/dT)/rho^2 over rho from rho_ref */
static double cold_energy(const struct tait *t, double rho)
{
  double lowest = least_density(t), ln = log(fmax(rho, lowest) / t->rho_ref), more = t->gamma - 1.0;
  double cold = t->P_ref - t->K * (1.0 / t->gamma + t->alpha * t->T_ref); /* of P - T dP/dT, what is constant */
  double growth = (more > 0.0 ? expm1(more * ln) / more : ln) / t->gamma;
  double e = (t->K * growth - cold * expm1(-ln)) / t->rho_ref;
  if (rho < lowest) e += edge_energy(edge_of(t, NULL, 0), cold + t->K * least / t->gamma, rho);
  return e;
}

static void energy(const void *prm, int n, const double *rho, const double *T, double *e)
{
  const struct tait *t = prm;
  for (int i = 0; i < n; i++) e[i] = cold_energy(t, rho[i]) + (T ? t->heat_capacity * (T[i] - t->T_ref) : 0.0);
}

static void temperature(const void *prm, int n, const double *rho, const double *e, double *T)
{
  const struct tait *t = prm;
  for (int i = 0; i < n; i++) T[i] = t->T_ref + (e[i] - cold_energy(t, rho[i])) / t->heat_capacity;
}

static int outside(const void *prm, int n, const double *P, const double *T)
{
  int count = 0;
  for (int i = 0; i < n; i++) count += !(stiffening(prm, P, T, i) >= least);
  return count;
}

const struct eos eos_tait = {
    .name = "tait",
    .source = "1, Tait",
    .range = "a bulk modulus of at least 0.1 bulk_modulus",
    .params = params,
    .param_size = sizeof(struct tait),
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
