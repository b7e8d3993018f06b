/* Exponential and logarithm of VECTORs, to about one unit in the last place: libm's would go lane by lane. */
#ifndef CONSTITUTIVE_EXPONENTIAL_H
#define CONSTITUTIVE_EXPONENTIAL_H

#include "constitutive/vector.h"

/* Exponents beyond are cut, so that squares of the results stay finite. */
#define EXPONENT_MOST 300.0

/** exp(x), and exp(x) - 1 with all its digits near zero. */
void vector_exp(const VECTOR *x, VECTOR *exponential, VECTOR *less_one);

/** ln of positive, normal numbers. */
void vector_log(const VECTOR *x, VECTOR *result);

#endif
