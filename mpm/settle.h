/* The start at rest where columns do not stand by themselves: a static solve on the points' given places. theory 2.5 */
#ifndef MPM_SETTLE_H
#define MPM_SETTLE_H

#include "mpm/mpm.h"

/** Brings the stresses of a start at rest into balance at the nodes: nothing is done where the columns balance. What it
 *  found stands in m->rest. Loads do not act, walls stand still, the fluid is at rest. */
enum status mpm_settle(struct sim *sim, struct mpm *m) MUST_CHECK;

#endif
