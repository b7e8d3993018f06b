/* Heat of the fluid, and with it of a skeleton's grains: when it is solved, how it is carried and conducted.
 * theory 4.12
 */
#ifndef ICE_HEAT_H
#define ICE_HEAT_H

#include "ice/ice.h"

/* ice/heat_carry.c: within ice.advect, sweep by sweep. */
/** Temperature, and density, of what would flow in at face f of a side: the side's, or that of the cell inside. */
void ice_heat_beyond(const struct sim *sim, struct ice *ice, int side, long f);
/** What the sweep brings every cell, before masses change. */
void ice_heat_gather(const struct sim *sim, struct ice *ice, int axis);
/** Temperatures after the sweep, when the masses have changed. */
void ice_heat_settle(const struct sim *sim, struct ice *ice);

/* ice/heat_conduct.c */
enum status ice_conduct_heat(struct sim *sim, double dt);
double      ice_heat_dt(const struct sim *sim);

/* ice/heat_sides.c */
/** What the sides do to a phase at time t: fills outside and source. */
void heat_sides_set(const struct sim *sim, struct heat_phase *p, double t);
/** W that comes in through a side, cells having the temperatures T + change. */
double heat_sides_power(const struct sim *sim, const struct heat_phase *p, int side, double t);
/** Widens a span of temperatures, span [2] K, by those that sides have at time t. */
void heat_sides_span(const struct sim *sim, double t, double span[2]);

/* ice/heat_grains.c */
/** Whether grains take part: some solid has a heat capacity. */
bool heat_has_grains(const struct scene *scene);
/** The points' temperatures, capacities and conductivities in cells, and the exchange with the fluid. */
void heat_grains_gather(const struct sim *sim, struct ice *ice);
/** Points take what their cell has warmed, change [size] K; what cells do not see of held points fades. */
void heat_grains_scatter(const struct sim *sim, const struct ice *ice, const double *change, double dt);

/* ice/heat_solve.c */
/** Changes of temperature in dt, phase.change, which comes as 0, from the W that come in at the old ones, phase.rest:
 * symmetric and positive definite, by conjugate gradients with the cells' own 2 x 2 blocks inverted. */
enum status heat_solve(const struct grid *g, struct heat *heat, double dt) MUST_CHECK;

/* ice/heat_create.c */
/** J/(kg K) at constant volume. */
double ice_heat_capacity(const struct sim *sim);
/** Temperatures at the start; fails where one is at or below 0 K. */
enum status ice_heat_create(struct sim *sim, struct ice *ice) MUST_CHECK;
void        ice_heat_destroy(struct heat *heat);
/** Adds the heat of the fluid to the ledger. */
void ice_heat_measure(const struct sim *sim, struct ledger *l);

#endif
