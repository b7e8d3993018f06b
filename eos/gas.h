/* What the laws of gases share: P + p_inf = rho a(T), a = a_ref T/T_ref, the square of the sound speed at constant
 * temperature. T NULL: T_ref everywhere. */
#ifndef EOS_GAS_H
#define EOS_GAS_H

#include "eos/edge.h"

struct gas {
  double rho_ref, T_ref, a_ref, p_inf; /* kg/m3, K, m2/s2, Pa */
};

/** The end of the range at the temperature of entry i; its slope is a(T) everywhere in the range. */
struct edge gas_edge(struct gas g, const double *T, int i);

#define GAS_RANGE                                                                                                      \
  "a density of at least 1e-6 reference_density and a temperature of at least 1e-3 reference_temperature"

void gas_pressure(struct gas g, int n, const double *rho, const double *T, double *P);
void gas_density(struct gas g, int n, const double *P, const double *T, double *rho);
void gas_compressibility(struct gas g, int n, const double *P, const double *T, double *kappa);
void gas_expansion(struct gas g, int n, const double *P, const double *T, double *alpha);
void gas_sound_speed(struct gas g, int n, const double *P, const double *T, double *c);
int  gas_outside(struct gas g, int n, const double *P, const double *T);

#endif
