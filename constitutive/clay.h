/* Modified Cam-clay in pressure p, shear q and specific volume v: elastic law, ellipse and the return to it. theory
 * 1.3.4 */
#ifndef CONSTITUTIVE_CLAY_H
#define CONSTITUTIVE_CLAY_H

/* The parameters as the return wants them. */
struct clay {
  double kappa, plastic; /* slopes in v over ln p: kappa, lambda - kappa */
  double M;              /* q/p of the critical state */
  double shear;          /* shear over bulk modulus */
  double floor; /* Pa: below, the bulk modulus is that of this pressure; an ellipse is at least twice as long */
};

/* What a step asks of a point that leaves its ellipse. */
struct clay_step {
  double p, pc;      /* Pa: pressure and preconsolidation pressure before */
  double change, v;  /* of the specific volume over the step; its mean */
  double ss, se, ee; /* s:s, s:e, e:e of the deviator before and of the strain's deviator */
};

/* Where it ends. */
struct clay_state {
  double p, q, pc;             /* Pa; pc without the floor */
  double shear;                /* Pa, shear modulus of the step */
  double compression, plastic; /* plastic strain: of volume, compression positive; deviator sqrt(2/3 e:e) */
};

/** Measure of pressure in which elastic compression is linear, v = -kappa x: ln(p/floor), p/floor - 1 below. */
double clay_measure(const struct clay *c, double p);
/** Pa, the pressure of a measure. */
double clay_pressure(const struct clay *c, double x);
/** Pa, secant (p - p0)/(x - x0) of the two. */
double clay_secant(const struct clay *c, double p0, double x0, double p, double x);
/** Pa, length of the ellipse. */
double clay_length(const struct clay *c, double pc);

/** Returns a point that is outside. */
void clay_return(const struct clay *c, const struct clay_step *step, struct clay_state *state);

#endif
