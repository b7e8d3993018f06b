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

enum { MAX_SHOCK_FLUIDS = 8 };

/** J/kg of fluid k of a cell, from its density and temperature. */
double shock_internal_energy(const struct sim *sim, const struct ice *ice, int k, long c);
/** m/s in a cell, of several fluids together: at constant entropy where energy is solved, else at constant temperature.
 */
double shock_sound(const struct sim *sim, const struct ice *ice, long c);
/** Share of a cell that fluid k fills; and of a change of the cell's volume that it takes, so that pressures stay
 * equal.
 */
double shock_share(const struct grid *g, const struct ice *ice, int k, long c);
double shock_yield(const struct grid *g, const struct ice *ice, int k, long c);
/** kg through a face in dt with the density of both cells: what weight is counted to work on before the carried mass is
 * known. */
double shock_carried_weight(const struct sim *sim, const struct ice *ice, int axis, long f, double dt);
/** Volumes of the first fluid that pass the faces of an axis, liquid_fc: what its planes cut off. */
void shock_cut(struct sim *sim, struct ice *ice, int axis, double dt);
/** Densities, temperatures and the pressure of all cells from masses and internal energies; several fluids share the
 * room so that their pressures are equal. */
enum status shock_settle(struct sim *sim, struct ice *ice) MUST_CHECK;
/** Fails where the scene is none that this can do; what several fluids hold. */
enum status shock_create(struct sim *sim, struct ice *ice) MUST_CHECK;
/** Adds the energy of compression to the ledger. */
void shock_measure(const struct sim *sim, struct ledger *l);

enum status ice_mix_shock(struct sim *sim, double dt);
enum status ice_find_sound(struct sim *sim, double dt);
enum status ice_predict_shock(struct sim *sim, double dt);
enum status ice_push_shock(struct sim *sim, double dt);
enum status ice_carry_shock(struct sim *sim, double dt);
double      ice_shock_dt(const struct sim *sim);

#endif
