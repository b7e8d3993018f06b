/* Equations of state: pressure, density, internal energy and their derivatives. Arrays in, arrays out. docs/theory.md,
 * "Equations of state". */
#ifndef EOS_EOS_H
#define EOS_EOS_H

#include "core/param.h"

struct eos {
  const char         *name, *source;
  const char         *range; /* the states that the law is meant for, in words */
  const struct param *params;
  size_t              param_size;
  /* T NULL: the reference temperature everywhere (runs without energy). Outside its range a law goes on smoothly and
   * tells by `outside`: a density stays positive, and no finite state gives a NaN. */
  /** P [n] Pa, compression positive, gauge where the law's reference pressure is zero; from rho [n] kg/m3 and T [n] K.
   */
  void (*pressure)(const void *prm, int n, const double *rho, const double *T, double *P);
  /** rho [n] kg/m3 from P [n] Pa and T [n] K. */
  void (*density)(const void *prm, int n, const double *P, const double *T, double *rho);
  /** kappa [n] 1/Pa = (1/rho) drho/dP at constant T. */
  void (*compressibility)(const void *prm, int n, const double *P, const double *T, double *kappa);
  /** alpha [n] 1/K = -(1/rho) drho/dT at constant P. */
  void (*expansion)(const void *prm, int n, const double *P, const double *T, double *alpha);
  /** c [n] m/s at constant T: c^2 = 1/(rho kappa). At constant entropy: eos_adiabatic_sound_speed(). */
  void (*sound_speed)(const void *prm, int n, const double *P, const double *T, double *c);
  /** J/kg/K at constant volume, the same in every state. */
  double (*heat_capacity)(const void *prm);
  /** e [n] J/kg from rho [n] and T [n]; each law has its own zero. */
  void (*energy)(const void *prm, int n, const double *rho, const double *T, double *e);
  /** T [n] K from rho [n] and e [n]: the inverse of energy(). */
  void (*temperature)(const void *prm, int n, const double *rho, const double *e, double *T);
  /** How many of n states P [n], T [n] lie outside the range. */
  int (*outside)(const void *prm, int n, const double *P, const double *T);
};

/** The registered laws of eos.def; NULL-terminated. */
extern const struct eos *const eos_laws[];
const struct eos              *eos_find(const char *name);
/** c [n] m/s at constant entropy, from P [n] and T [n], both given. */
void eos_adiabatic_sound_speed(const struct eos *law, const void *prm, int n, const double *P, const double *T,
                               double *c);

#endif
