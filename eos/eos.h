/* Equations of state: pressure, density and their derivatives. Arrays in, arrays out. docs/theory.md, "Equations of
 * state". */
#ifndef EOS_EOS_H
#define EOS_EOS_H

#include "core/param.h"

struct eos {
  const char         *name, *source;
  const struct param *params;
  size_t              param_size;
  /* T NULL: the reference temperature everywhere (runs without energy). */
  /** P [n] Pa, compression positive, gauge where the law's reference pressure is zero; from rho [n] kg/m3 and T [n] K.
   */
  void (*pressure)(const void *prm, int n, const double *rho, const double *T, double *P);
  /** rho [n] kg/m3 from P [n] Pa and T [n] K. */
  void (*density)(const void *prm, int n, const double *P, const double *T, double *rho);
  /** kappa [n] 1/Pa = (1/rho) drho/dP at constant T. */
  void (*compressibility)(const void *prm, int n, const double *P, const double *T, double *kappa);
  /** alpha [n] 1/K = -(1/rho) drho/dT at constant P. */
  void (*expansion)(const void *prm, int n, const double *P, const double *T, double *alpha);
  /** c [n] m/s. */
  void (*sound_speed)(const void *prm, int n, const double *P, const double *T, double *c);
  /** J/kg/K. */
  double (*heat_capacity)(const void *prm);
};

/** The registered laws of eos.def; NULL-terminated. */
extern const struct eos *const eos_laws[];
const struct eos              *eos_find(const char *name);

#endif
