/* The pressure at which fluids of given masses fill a volume. theory 4.15 */
#ifndef ICE_EQUILIBRIUM_H
#define ICE_EQUILIBRIUM_H

#include "core/scene.h"

enum { MOST_EQUILIBRIUM_STEPS = 200 };

/** Masses m [n_fluids] kg at one temperature, or NULL for those of reference, in `volume` m3: *P in as a guess, out so
 * that sum m/rho(P) = volume to round-off. There must be a fluid that is compressible, and room for those that are not.
 * Returns the steps it took. */
int ice_equilibrium(const struct scene *scene, const double *m, const double *T, double volume, double *P);

#endif
