/* The list of equations of state, and what follows from the functions of any of them. */
#include "eos/eos.h"

#include <string.h>

#define EOS(name) extern const struct eos eos_##name;
#include "eos/eos.def"
#undef EOS

const struct eos *const eos_laws[] = {
#define EOS(name) &eos_##name,
#include "eos/eos.def"
#undef EOS
    NULL};

const struct eos *eos_find(const char *name)
{
  for (const struct eos *const *law = eos_laws; *law; law++)
    if (strcmp((*law)->name, name) == 0) return *law;
  return NULL;
}

/* m/s: c^2 = 1/(rho kappa) + (T/c_v) (dP/dT at constant rho)^2/rho^2, and dP/dT = alpha/kappa */
static double adiabatic(double rho, double kappa, double alpha, double T, double heat_capacity)
{
  if (kappa <= 0.0) return INFINITY;
  double push = alpha / (kappa * rho);
  return sqrt(1.0 / (rho * kappa) + fmax(T, 0.0) / heat_capacity * push * push);
}

void eos_adiabatic_sound_speed(const struct eos *law, const void *prm, int n, const double *P, const double *T,
                               double *c)
{
  enum { BLOCK = 64 };
  double rho[BLOCK], kappa[BLOCK], alpha[BLOCK], heat_capacity = law->heat_capacity(prm);
  for (int first = 0; first < n; first += BLOCK) {
    int m = n - first < BLOCK ? n - first : BLOCK;
    law->density(prm, m, P + first, T + first, rho);
    law->compressibility(prm, m, P + first, T + first, kappa);
    law->expansion(prm, m, P + first, T + first, alpha);
    for (int i = 0; i < m; i++) c[first + i] = adiabatic(rho[i], kappa[i], alpha[i], T[first + i], heat_capacity);
  }
}
