/* Linear water: P = P_ref + K [rho/rho_ref - 1 + alpha (T - T_ref)]. With K infinite the density is a function of T
 * alone and the pressure none of the density: then pressure() gives P_ref. */
#include "eos/edge.h"
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

/* rho/rho_ref where the range ends */
static const double least = 0.1;

/* alpha (T - T_ref) of entry i */
static inline double swelling(const struct linear_water *w, const double *T, int i)
{
  return T ? w->alpha * (T[i] - w->T_ref) : 0.0;
}

/* the end of the range, K finite */
static struct edge edge_of(const struct linear_water *w, const double *T, int i)
{
  return (struct edge){least * w->rho_ref, w->P_ref + w->K * (least - 1.0 + swelling(w, T, i)), w->K / w->rho_ref};
}

static void pressure(const void *prm, int n, const double *rho, const double *T, double *P)
{
  const struct linear_water *w = prm;
  double                     K = isinf(w->K) ? 0.0 : w->K;
  for (int i = 0; i < n; i++)
    P[i] = rho[i] < least * w->rho_ref && K > 0.0 ? edge_pressure(edge_of(w, T, i), rho[i])
                                                  : w->P_ref + K * (rho[i] / w->rho_ref - 1.0 + swelling(w, T, i));
}

/* rho/rho_ref of entry i, inside the range */
static inline double relative_density(const struct linear_water *w, const double *P, const double *T, int i)
{
  return 1.0 + (P[i] - w->P_ref) / w->K - swelling(w, T, i);
}

/* kg/m3, outside the range */
static double thin(const struct linear_water *w, const double *P, const double *T, int i)
{
  return isinf(w->K) ? least * w->rho_ref : edge_density(edge_of(w, T, i), P[i]);
}

static void density(const void *prm, int n, const double *P, const double *T, double *rho)
{
  const struct linear_water *w = prm;
  for (int i = 0; i < n; i++) {
    double r = relative_density(w, P, T, i);
    rho[i] = r < least ? thin(w, P, T, i) : w->rho_ref * r;
  }
}

static void compressibility(const void *prm, int n, const double *P, const double *T, double *kappa)
{
  const struct linear_water *w = prm;
  for (int i = 0; i < n; i++) {
    double r = relative_density(w, P, T, i);
    kappa[i] = r < least ? edge_compressibility(edge_of(w, T, i), thin(w, P, T, i)) : 1.0 / (w->K * r);
  }
}

static void expansion(const void *prm, int n, const double *P, const double *T, double *alpha)
{
  const struct linear_water *w = prm;
  double stretch = isinf(w->K) ? 0.0 : 1.0 / (least * least * w->rho_ref); /* alpha = alpha K kappa */
  for (int i = 0; i < n; i++) {
    double r = relative_density(w, P, T, i);
    alpha[i] = r < least ? w->alpha * thin(w, P, T, i) * stretch : w->alpha / r;
  }
}

/* c^2 = dP/drho at constant T, the same everywhere in the range */
static void sound_speed(const void *prm, int n, const double *P, const double *T, double *c)
{
  const struct linear_water *w = prm;
  double                     c0 = sqrt(w->K / w->rho_ref);
  for (int i = 0; i < n; i++)
    c[i] = relative_density(w, P, T, i) < least ? c0 * (least * w->rho_ref / thin(w, P, T, i)) : c0;
}

static double heat_capacity(const void *prm) { return ((const struct linear_water *)prm)->heat_capacity; }

/* e at T_ref: the integral of (P - T dP/dT)/rho^2 over rho from rho_ref. With K infinite: 0, no work is stored */
static double cold_energy(const struct linear_water *w, double rho)
{
  double r = fmax(rho / w->rho_ref, least), pull = w->K * (1.0 + w->alpha * w->T_ref), e;
  if (isinf(w->K)) return 0.0;
  e = ((w->P_ref - pull) * (1.0 - 1.0 / r) + w->K * log(r)) / w->rho_ref;
  if (rho < least * w->rho_ref) e += edge_energy(edge_of(w, NULL, 0), w->P_ref - pull + w->K * least, rho);
  return e;
}

static void energy(const void *prm, int n, const double *rho, const double *T, double *e)
{
  const struct linear_water *w = prm;
  for (int i = 0; i < n; i++) e[i] = cold_energy(w, rho[i]) + (T ? w->heat_capacity * (T[i] - w->T_ref) : 0.0);
}

static void temperature(const void *prm, int n, const double *rho, const double *e, double *T)
{
  const struct linear_water *w = prm;
  for (int i = 0; i < n; i++) T[i] = w->T_ref + (e[i] - cold_energy(w, rho[i])) / w->heat_capacity;
}

static int outside(const void *prm, int n, const double *P, const double *T)
{
  int count = 0;
  for (int i = 0; i < n; i++) count += !(relative_density(prm, P, T, i) >= least);
  return count;
}

const struct eos eos_linear_water = {
    .name = "linear_water",
    .source = "1, linear water",
    .range = "a density of at least 0.1 reference_density",
    .params = params,
    .param_size = sizeof(struct linear_water),
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
