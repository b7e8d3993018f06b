/* Skeleton laws: stress from deformation. Arrays in, arrays out; a law is pure. docs/theory.md, "Skeleton models". */
#ifndef CONSTITUTIVE_CONSTITUTIVE_H
#define CONSTITUTIVE_CONSTITUTIVE_H

#include "core/param.h"

struct constitutive_model {
  const char         *name, *source; /* word in the scene; section of docs/theory.md */
  const struct param *params;
  size_t              param_size;
  int                 n_history; /* doubles of history per point */
  const char *const  *history;   /* [n_history] their names, for output: "plastic_strain", ... */
  bool                held;      /* never moves: no stress, no mechanical time step limit */
  bool total;   /* stress follows from F alone, not from the stress before: a pre-stress must be put into F */
  bool viscous; /* stress depends on the rate of strain: it may relax where nothing moves */
  /** What is wrong with parameters that are each in their range, and the remedy; NULL: nothing. */
  const char *(*check)(const void *prm);
  /** Stress at the end of the step of n points of one material.
   *  dF, F [n][9] relative and total deformation gradient (in; F NULL: kept only for laws that are `total`); stress
   * [n][6] effective Cauchy, Pa, tension positive, xx yy zz xy yz xz (in/out); history [n][n_history] (in/out; NULL
   * where n_history is 0); work [n] plastic work of the step per present volume, J/m3 (out; NULL: not wanted). dt s:
   * rate laws need it. Returns how many points it could not update. */
  int (*update)(const void *prm, int n, double dt, const double *dF, const double *F, double *stress, double *history,
                double *work);
  /** m/s, upper bound over n points from bulk density rb [n] kg/m3 and the present state: it limits dt. */
  double (*wave_speed)(const void *prm, int n, const double *rb, const double *stress, const double *history);
  /** J/m3 per present volume, elastic, of n points. */
  void (*energy)(const void *prm, int n, const double *F, const double *stress, const double *history, double *energy);
  /** History of n points that start with that stress; NULL: it starts at zero. */
  void (*start)(const void *prm, int n, const double *stress, double *history);
  /** Pa, of one point: above 0 outside the yield surface, where `update` leaves no stress; NULL: there is none. */
  double (*yield)(const void *prm, const double *stress, const double *history);
  /** Pa: constrained (oedometer) modulus at the start, and the ratio of lateral to vertical effective stress at rest.
   */
  double (*oedometer_modulus)(const void *prm);
  double (*shear_modulus)(const void *prm); /* Pa, at the start; NULL: the law is held */
  double (*lateral_ratio)(const void *prm);
};

extern const struct constitutive_model *const constitutive_models[];
const struct constitutive_model              *constitutive_find(const char *name);

#endif
