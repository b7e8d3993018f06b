/* Linear two-velocity theory of a saturated column: what its two solutions, by modes and by transforms, share.
 * docs/references.md, "Waves in a saturated column". */
#ifndef REFERENCES_COLUMN_WAVES_H
#define REFERENCES_COLUMN_WAVES_H

#include "references/conductivity.h"
#include "references/reference.h"

struct column_waves {
  struct conductivity pores;
  double              young, poisson, solid_density, bulk_modulus;
  double              height, load, ramp, base, water; /* ramp s; water: m of clear liquid above the column */
  int                 terms;                           /* modes of a bare column */
};

/* R u'' + C u' = S d2u/dy2 for u = (solid, liquid): R = diag(r), C = drag [1 -1; -1 1] */
struct column_matrices {
  double M;             /* Pa, skeleton alone */
  double r[2];          /* kg/m3, partial densities */
  double drag;          /* kg/m3/s */
  double s11, s12, s22; /* Pa */
  double speed;         /* m/s, fast wave without drag */
};

struct column_state {
  double pressure, displacement, stress; /* Pa; m upwards, of the skeleton; Pa effective, tension positive */
};

void column_matrices_make(const struct column_waves *c, struct column_matrices *m);
/** States at n places z m above the base of a column with c->water = 0, at t > 0: modes. */
void column_modes_states(const struct column_waves *c, int n, const double *z, double t, struct column_state *state);
/** The pole of the first fast mode: angular frequency and decay, 1/s. */
void column_modes_fast_pole(const struct column_waves *c, double *angular, double *decay);
/** State at n places z above the base, with the liquid above it: Fourier series of the Laplace transform. z beyond the
 *  height lies in the clear liquid: only the pressure has a meaning there. */
void column_transform_states(const struct column_waves *c, int n, const double *z, double t,
                             struct column_state *state);

#endif
