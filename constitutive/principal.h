/* Principal values of the stresses of a group, and stresses of the same axes. */
#ifndef CONSTITUTIVE_PRINCIPAL_H
#define CONSTITUTIVE_PRINCIPAL_H

#include "constitutive/vector.h"

/* The deviator over its size sqrt(J2) is x (N - (I - N)/2) + B: N projects on the axis of x, the principal value that
 * is farthest from the others; B, with principal values -radius and +radius, lies in the plane across. No axis of that
 * plane is needed, so equal values are no special case. */
struct principal {
  VECTOR mean, size; /* Pa */
  VECTOR x, radius;  /* - */
  VECTOR N[6], B[6]; /* - */
  VECTOR value[3];   /* Pa, ascending */
};

void principal_split(const VECTOR stress[6], struct principal *p);

/** The stress [6] of the same axes with other principal values, ascending. */
void principal_join(const struct principal *p, const VECTOR value[3], VECTOR stress[6]);

#endif
