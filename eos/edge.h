/* How a law goes on below the lowest density of its range: the pressure is a straight line over the specific volume,
 * tangent to the law at the edge. Then every pressure has a positive density, and slopes are continuous. */
#ifndef EOS_EDGE_H
#define EOS_EDGE_H

#include <math.h>

struct edge {
  double rho, P, slope; /* kg/m3; Pa; dP/drho there, m2/s2 */
};

/** Pa, at rho < edge.rho. */
static inline double edge_pressure(struct edge e, double rho)
{
  return rho > 0.0 ? e.P + e.slope * e.rho * (1.0 - e.rho / rho) : -INFINITY;
}

/** kg/m3, at P < edge.P. */
static inline double edge_density(struct edge e, double P) { return e.rho / (1.0 - (P - e.P) / (e.slope * e.rho)); }

/** 1/Pa, where the density is rho < edge.rho. */
static inline double edge_compressibility(struct edge e, double rho) { return rho / (e.slope * e.rho * e.rho); }

/** m/s. */
static inline double edge_sound_speed(struct edge e, double rho) { return sqrt(e.slope) * (e.rho / rho); }

/** J/kg that the fluid has at rho < edge.rho beyond the edge, the pressure being P - T dP/dT: that of the edge is
 * cold. */
static inline double edge_energy(struct edge e, double cold, double rho)
{
  double more = 1.0 / rho - 1.0 / e.rho;
  return rho > 0.0 ? (0.5 * e.slope * e.rho * e.rho * more - cold) * more : INFINITY;
}

#endif
