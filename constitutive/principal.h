/* Principal values of the stresses of a group, and stresses of the same axes. */
#ifndef CONSTITUTIVE_PRINCIPAL_H
#define CONSTITUTIVE_PRINCIPAL_H

#include "constitutive/vector.h"

/* A stress is centre I + alone N + B: N projects on one principal axis, whose value is `alone` above `centre`, the mean
 * of the others; B, with principal values -radius and +radius, lies in the plane across. No axis of that plane is
 * needed, so equal values are no special case. In general the one value is the farthest from the others; of a stress of
 * the plane xy it is zz. */
struct principal {
  VECTOR N[6];         /* - */
  VECTOR B[6], radius; /* in a unit of their own */
  VECTOR value[3];     /* Pa, ascending */
  MASK   low, high;    /* the one value is the lowest, the highest */
};

void principal_split(const VECTOR stress[6], struct principal *p);

/** The stress [6] of the same axes with other principal values, ascending. */
void principal_join(const struct principal *p, const VECTOR value[3], VECTOR stress[6]);

#endif
