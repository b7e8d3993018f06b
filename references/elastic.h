/* Moduli of isotropic elasticity that several references need. */
#ifndef REFERENCES_ELASTIC_H
#define REFERENCES_ELASTIC_H

/** Pa: constrained (oedometer) modulus E (1 - nu)/((1 + nu)(1 - 2 nu)), also lambda + 2 G. */
static inline double elastic_oedometer(double young, double poisson)
{
  return young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
}

/** Pa. */
static inline double elastic_shear(double young, double poisson) { return 0.5 * young / (1.0 + poisson); }

#endif
