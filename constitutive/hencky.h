/* Elastic strain of laws with F = F_e F_p: e = log(F_e F_e^T)/2. A step takes it to log(dF exp(2 e) dF^T)/2. */
#ifndef CONSTITUTIVE_HENCKY_H
#define CONSTITUTIVE_HENCKY_H

#include "constitutive/vector.h"

/** Takes the strains [6] of a group of m points through their dF [m][9]; `growth` det dF - 1. Returns how many cannot
 * follow (turned inside out, singular, not finite): `refused`; they keep their strain. */
int hencky_step(int m, const double *dF, VECTOR strain[6], VECTOR *growth, MASK *refused);

#endif
