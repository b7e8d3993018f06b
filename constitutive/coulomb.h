/* Return of principal stresses to Mohr and Coulomb's surface with a cut-off in tension. theory 1.3.1 */
#ifndef CONSTITUTIVE_COULOMB_H
#define CONSTITUTIVE_COULOMB_H

#include "constitutive/vector.h"

/* Pa: Lame's constants, and the modulus of compression */
struct coulomb_elastic {
  double lambda, shear, bulk;
};

/* What the points of a group can bear now. */
struct coulomb_strength {
  VECTOR sin_phi, sin_psi; /* friction and dilation angle; psi <= phi */
  VECTOR cohesive;         /* Pa, 2 c cos(phi) */
  VECTOR tip;              /* Pa, equal principal stresses that the planes bear, c cot(phi); may be infinite */
  VECTOR tension;          /* Pa, largest principal stress, at most `tip` */
};

/* Menetrey and Willam's potential; roundness 0: there is none, plastic strain follows Mohr and Coulomb's planes */
struct coulomb_flow {
  double roundness, meridian; /* e, R_mc(pi/3) */
  double blunt;               /* Pa, eccentricity times cohesion */
};

/** Mohr and Coulomb's function of ascending principal stresses: Pa, above 0 outside. */
#define COULOMB_YIELD(s, value) (((value)[2] - (value)[0]) + ((value)[2] + (value)[0]) * (s)->sin_phi - (s)->cohesive)

/** trial to value [3], Pa, ascending, for lanes that are outside. The others get numbers without meaning. */
void coulomb_return(const struct coulomb_elastic *elastic, const struct coulomb_strength *strength,
                    const struct coulomb_flow *flow, const VECTOR trial[3], VECTOR value[3]);

/** The same to the planes without cut-off, with Menetrey and Willam's potential. */
void coulomb_return_smooth(const struct coulomb_elastic *elastic, const struct coulomb_strength *strength,
                           const struct coulomb_flow *flow, const VECTOR trial[3], VECTOR value[3]);

#endif
