/* Trial stress, mean and deviator of a group, and its points' history: what laws without principal axes share. */
#ifndef CONSTITUTIVE_DEVIATOR_H
#define CONSTITUTIVE_DEVIATOR_H

#include "constitutive/isotropic.h"
#include "constitutive/vector.h"

/* plastic shear strain over plastic_strain, the sum of sqrt(2/3 e:e) */
static const double shear_of_plastic = 1.7320508075688772;

/** Adds the elastic stress of the group's strain. */
static inline void group_strain(double lambda, double twice_mu, struct corotate_group *g)
{
  VECTOR volume = lambda * (g->strain[XX] + g->strain[YY] + g->strain[ZZ]);
  for (int k = 0; k < 3; k++) g->stress[k] += volume;
  for (int k = 0; k < 6; k++) g->stress[k] += twice_mu * g->strain[k];
}

/** `mean` of the diagonal, deviator `dev` [6], `J2` = dev:dev/2. */
static inline void deviator_split(const VECTOR s[6], VECTOR *mean, VECTOR dev[6], VECTOR *J2)
{
  *mean = (s[XX] + s[YY] + s[ZZ]) * (1.0 / 3.0);
  for (int k = 0; k < 3; k++) dev[k] = s[k] - *mean;
  for (int k = 3; k < 6; k++) dev[k] = s[k];
  *J2 = 0.5 * (dev[XX] * dev[XX] + dev[YY] * dev[YY] + dev[ZZ] * dev[ZZ]) +
        (dev[XY] * dev[XY] + dev[YZ] * dev[YZ] + dev[XZ] * dev[XZ]);
}

/** Component k of the records [m][width] of a group; 0 in the lanes beyond m. */
static inline void group_load(int m, int width, const double *records, int k, VECTOR *v)
{
  for (int i = 0; i < LANES; i++) (*v)[i] = i < m ? records[width * i + k] : 0.0;
}

static inline void group_store(int m, int width, const VECTOR *v, double *records, int k)
{
  for (int i = 0; i < m; i++) records[width * i + k] = (*v)[i];
}

/** sqrt(J2) of one stress, and its mean. */
static inline double deviator_size(const double s[6], double *mean)
{
  double a = s[XX] - s[YY], b = s[YY] - s[ZZ], c = s[ZZ] - s[XX];
  *mean = (s[XX] + s[YY] + s[ZZ]) / 3.0;
  return sqrt((a * a + b * b + c * c) / 6.0 + s[XY] * s[XY] + s[YZ] * s[YZ] + s[XZ] * s[XZ]);
}

#endif
