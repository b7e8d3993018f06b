/* Modified Cam-clay in pressure p, shear q and specific volume v: elastic law, ellipse and the return to it, for
 * groups. theory 1.3.4 */
#ifndef CONSTITUTIVE_CLAY_H
#define CONSTITUTIVE_CLAY_H

#include "constitutive/vector.h"

/* The parameters as the return wants them. */
struct clay {
  double kappa, plastic; /* slopes in v over ln p: kappa, lambda - kappa */
  double M;              /* q/p of the critical state */
  double shear;          /* shear over bulk modulus */
  double floor; /* Pa: below, the bulk modulus is that of this pressure; an ellipse is at least twice as long */
};

/* What a step asks of points that leave their ellipse. */
struct clay_step {
  VECTOR p, pc;      /* Pa: pressure and preconsolidation pressure before */
  VECTOR change, v;  /* of the specific volume over the step; its mean */
  VECTOR ss, se, ee; /* s:s, s:e, e:e of the deviator before and of the strain's deviator */
};

/* Where they end. */
struct clay_state {
  VECTOR p, q, pc;             /* Pa; pc without the floor */
  VECTOR shear;                /* Pa, shear modulus of the step */
  VECTOR compression, plastic; /* plastic strain: of volume, compression positive; of the deviator sqrt(2/3 e:e) */
};

/** Measure of pressure in which elastic compression is linear, v = -kappa x: 1 + ln(p/floor), p/floor below. */
void clay_measure(const struct clay *c, const VECTOR *p, VECTOR *x);
/** Pa, the pressure of a measure. */
void clay_pressure(const struct clay *c, const VECTOR *x, VECTOR *p);
/** Pa, secant (p - p0)/(x - x0) of the two. */
void clay_secant(const struct clay *c, const VECTOR *p0, const VECTOR *x0, const VECTOR *p, const VECTOR *x,
                 VECTOR *secant);

/** Returns the lanes that are outside; others get numbers without meaning. */
void clay_return(const struct clay *c, const struct clay_step *step, const MASK *outside, struct clay_state *state);

#endif
