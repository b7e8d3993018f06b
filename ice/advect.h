/* What everything that the liquid carries shares: how much mass passes a face, and slopes inside the liquid. theory
 * 4.10 */
#ifndef ICE_ADVECT_H
#define ICE_ADVECT_H

#include "ice/ice.h"

/* a cell filled to more than this share is full: there what is carried has slopes */
static const double advect_full = 0.999;
/* of what a full cell holds: a cell with less has neither velocity nor temperature of its own */
static const double advect_least_mass = 1e-12;

/** Whether a face lies in the full liquid, where fluxes are of second order. */
bool advect_is_smooth(const struct grid *g, const struct ice *ice, int axis, long f);
/** Density of what passes a face in this sweep, kg/m3: that of the cell it leaves; where energy is solved, inside the
 * liquid of second order, as the temperature is. */
double advect_density(const struct grid *g, const struct ice *ice, int axis, long f);
/** Mass that passes a face in this sweep, kg, upwards. */
double advect_mass(const struct ice *ice, const struct grid *g, int axis, long f);
/** Share of the pores of cell `from` that passes a face in this sweep. */
double advect_courant(const struct grid *g, const struct ice *ice, int axis, long f, long from);

/** Component d of the velocity in the middle of the step that leaves cell `from` through its face: a limited slope,
 * less half of what pressure, weight and viscosity have changed. Bell, Colella and Glaz 1989 */
double advect_leaving_velocity(const struct sim *sim, const struct ice *ice, int axis, long from, bool up, int d,
                               double number);

/** van Leer's harmonic mean of two slopes. */
static inline double advect_limited(double a, double b) { return a * b > 0 ? 2 * a * b / (a + b) : 0; }

/** Whether a cell and its neighbour are full of the same fluid. */
static inline bool advect_same(const struct ice *ice, long c, long neighbour)
{
  if (!ice->several) return ice->alpha_cc[neighbour] > advect_full;
  int fluid = ice_only_fluid(ice, c);
  return fluid >= 0 && fluid == ice_only_fluid(ice, neighbour);
}

/** Limited change across cell c along an axis; n: components per cell of q; 0 beside cells that are not full. */
static inline double advect_slope(const struct grid *g, const struct ice *ice, int axis, long c, int n, const double *q)
{
  long before = c - g->stride[axis], after = c + g->stride[axis];
  bool known = advect_same(ice, c, before) && advect_same(ice, c, after);
  return known ? advect_limited(q[c * n] - q[before * n], q[after * n] - q[c * n]) : 0;
}

#endif
