/* Isotropic elasticity in Young's modulus and Poisson's ratio: what the elastic laws share. */
#ifndef CONSTITUTIVE_ISOTROPIC_H
#define CONSTITUTIVE_ISOTROPIC_H

#include "constitutive/constitutive.h"

struct isotropic {
  double young, poisson; /* Pa, - */
};

/* rows of a law's parameter table; `type` starts with the members young and poisson; `least` is the smallest poisson */
#define ISOTROPIC_PARAMS(type, least)                                                                                  \
  {"young", PARAM_NUMBER, offsetof(type, young), "Pa", 1e-6, 1e15, NULL, NULL, "Young's modulus of the skeleton"},     \
  {                                                                                                                    \
    "poisson", PARAM_NUMBER, offsetof(type, poisson), "-", least, 0.499, NULL, NULL, "Poisson's ratio of the skeleton" \
  }

/** Pa: Lame's first constant. */
static inline double isotropic_lambda(const struct isotropic *e)
{
  return e->young * e->poisson / ((1.0 + e->poisson) * (1.0 - 2.0 * e->poisson));
}

/** Pa: shear modulus. */
static inline double isotropic_shear(const struct isotropic *e) { return 0.5 * e->young / (1.0 + e->poisson); }

/** Pa: bulk modulus lambda + 2/3 mu. */
static inline double isotropic_bulk(const struct isotropic *e) { return e->young / (3.0 * (1.0 - 2.0 * e->poisson)); }

/** Pa: constrained modulus lambda + 2 mu. */
static inline double isotropic_oedometer(const void *prm) { return isotropic_lambda(prm) + 2.0 * isotropic_shear(prm); }

/** Pa: shear modulus, as a law gives it. */
static inline double isotropic_shear_modulus(const void *prm) { return isotropic_shear(prm); }

/** Lateral over vertical stress without lateral strain: nu/(1 - nu). */
static inline double isotropic_lateral(const void *prm)
{
  const struct isotropic *e = prm;
  return e->poisson / (1.0 - e->poisson);
}

/** `wave_speed` and `energy` of a law whose stress turns with the material and grows with the strain. */
double isotropic_wave_speed(const void *prm, int n, const double *rb, const double *stress, const double *history);
void   isotropic_energy(const void *prm, int n, const double *F, const double *stress, const double *history,
                        double *energy);

#endif
