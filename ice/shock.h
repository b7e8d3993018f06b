/* The fluid at any speed, to shocks: what its faces and cells share. theory 4.13 */
#ifndef ICE_SHOCK_H
#define ICE_SHOCK_H

#include "ice/ice.h"

/** van Leer's harmonic mean of two slopes. */
static inline double shock_limited(double a, double b) { return a * b > 0 ? 2 * a * b / (a + b) : 0; }

/** Change of a scalar with n components per cell across a face: none at walls and sides. */
static inline double shock_jump(const struct sim *sim, const struct ice *ice, int axis, long f, int n, const double *q)
{
  bool inner = ice->kind[axis * sim->grid.size + f] == FACE_INNER;
  return inner ? q[f * n] - q[(f - sim->grid.stride[axis]) * n] : 0;
}

/** Change of velocity component d across a face, m/s: at walls and sides of given velocity the normal one goes on so
 * that the face has their velocity. */
double shock_jump_velocity(const struct sim *sim, const struct ice *ice, int axis, long f, int d);

/** J/kg of a cell, from its density and temperature; 0 where energy is not solved. */
double shock_internal_energy(const struct sim *sim, const struct ice *ice, long c, double rho);
/** m/s: at constant entropy where energy is solved, else at constant temperature. */
double shock_sound(const struct sim *sim, const struct ice *ice, long c);
/** kg through a face in dt with the density of both cells: what weight is counted to work on before the carried mass is
 * known. */
double shock_carried_weight(const struct sim *sim, const struct ice *ice, int axis, long f, double dt);
/** Densities and pressures of all cells from their masses and temperatures. */
void shock_settle(struct sim *sim, struct ice *ice);
/** Fails where the scene is none that this can do. */
enum status shock_create(struct sim *sim, struct ice *ice) MUST_CHECK;
/** Adds the energy of compression to the ledger. */
void shock_measure(const struct sim *sim, struct ledger *l);

enum status ice_find_sound(struct sim *sim, double dt);
enum status ice_predict_shock(struct sim *sim, double dt);
enum status ice_push_shock(struct sim *sim, double dt);
enum status ice_carry_shock(struct sim *sim, double dt);
double      ice_shock_dt(const struct sim *sim);

#endif
