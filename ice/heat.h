/* Heat of the fluid: when it is solved, how it is carried. theory 4.12 */
#ifndef ICE_HEAT_H
#define ICE_HEAT_H

#include "ice/ice.h"

/** J/kg/K at constant volume. */
double ice_heat_capacity(const struct sim *sim);

/* ice/heat_carry.c: within ice.advect, sweep by sweep. */
/** Temperature, and density, of what would flow in at face f of a side: the side's, or that of the cell inside. */
void ice_heat_beyond(const struct sim *sim, struct ice *ice, int side, long f);
/** What the sweep brings every cell, before masses change. */
void ice_heat_gather(const struct sim *sim, struct ice *ice, int axis);
/** Temperatures after the sweep, when the masses have changed. */
void ice_heat_settle(const struct sim *sim, struct ice *ice);

/** Fails where a cell starts at or below 0 K. */
enum status ice_heat_create(struct sim *sim, struct ice *ice) MUST_CHECK;
/** Adds the heat of the fluid to the ledger. */
void ice_heat_measure(const struct sim *sim, struct ledger *l);

#endif
