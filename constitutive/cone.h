/* Laws with a circular cone, sqrt(J2) = strength - slope mean: what friction does to waves and to the state at rest. */
#ifndef CONSTITUTIVE_CONE_H
#define CONSTITUTIVE_CONE_H

#include "constitutive/isotropic.h"

/* share of the strength from which a point may be at the cone in the next step */
#define CONE_NEAR 0.5

/** Pa: what plastic flow can add to the longitudinal modulus. Stress follows a strain e with the stiffness
 * D - (D m) (n D)/H, n = s/(2 size) + slope/3 I, m with the slope of the flow instead, H = G + K slope flow; a wave v
 * along N has (m D v N)(n D v N) >= -(K (slope - flow) v.N)^2/4, whatever the stress s. */
static inline double cone_stiffening(const struct isotropic *e, double slope, double flow)
{
  double K = isotropic_bulk(e), difference = K * (slope - flow);
  return 0.25 * difference * difference / (isotropic_shear(e) + K * slope * flow);
}

/** Lateral over vertical stress at rest: elastic, unless that is outside a cone with its tip at zero. */
static inline double cone_lateral(const struct isotropic *e, double slope)
{
  double root3 = sqrt(3.0);
  return fmax(isotropic_lateral(e), fmax(0.0, (root3 - slope) / (root3 + 2.0 * slope)));
}

#endif
