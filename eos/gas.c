/* What the laws of gases share. */
#include "eos/gas.h"

#include <stddef.h>

/* rho/rho_ref and T/T_ref where the range ends; a colder gas counts as one at this temperature */
static const double least_density = 1e-6, least_temperature = 1e-3;

/* K, of entry i */
static inline double temperature_of(struct gas g, const double *T, int i)
{
  return T ? fmax(T[i], least_temperature * g.T_ref) : g.T_ref;
}

struct edge gas_edge(struct gas g, const double *T, int i)
{
  double a = g.a_ref * (temperature_of(g, T, i) / g.T_ref), rho = least_density * g.rho_ref;
  return (struct edge){rho, rho * a - g.p_inf, a};
}

void gas_pressure(struct gas g, int n, const double *rho, const double *T, double *P)
{
  for (int i = 0; i < n; i++) {
    struct edge edge = gas_edge(g, T, i);
    P[i] = rho[i] < edge.rho ? edge_pressure(edge, rho[i]) : rho[i] * edge.slope - g.p_inf;
  }
}

void gas_density(struct gas g, int n, const double *P, const double *T, double *rho)
{
  for (int i = 0; i < n; i++) {
    struct edge edge = gas_edge(g, T, i);
    rho[i] = P[i] < edge.P ? edge_density(edge, P[i]) : (P[i] + g.p_inf) / edge.slope;
  }
}

/* 1/Pa */
static inline double compressibility_at(struct gas g, struct edge edge, double P)
{
  return P < edge.P ? edge_compressibility(edge, edge_density(edge, P)) : 1.0 / (P + g.p_inf);
}

void gas_compressibility(struct gas g, int n, const double *P, const double *T, double *kappa)
{
  for (int i = 0; i < n; i++) kappa[i] = compressibility_at(g, gas_edge(g, T, i), P[i]);
}

/* kappa times dP/dT at constant density, which is (P + p_inf)/T outside the range too */
void gas_expansion(struct gas g, int n, const double *P, const double *T, double *alpha)
{
  for (int i = 0; i < n; i++)
    alpha[i] = compressibility_at(g, gas_edge(g, T, i), P[i]) * (P[i] + g.p_inf) / temperature_of(g, T, i);
}

void gas_sound_speed(struct gas g, int n, const double *P, const double *T, double *c)
{
  for (int i = 0; i < n; i++) {
    struct edge edge = gas_edge(g, T, i);
    c[i] = P[i] < edge.P ? edge_sound_speed(edge, edge_density(edge, P[i])) : sqrt(edge.slope);
  }
}

int gas_outside(struct gas g, int n, const double *P, const double *T)
{
  int count = 0;
  for (int i = 0; i < n; i++) {
    int cold = T && !(T[i] >= least_temperature * g.T_ref);
    count += cold || !(P[i] >= gas_edge(g, T, i).P);
  }
  return count;
}
