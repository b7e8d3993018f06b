/* Sides of the grid that hold the solid's nodes: sums on their ghosts, and what they did to the solid. theory 3.2 */
#ifndef MPM_SIDES_H
#define MPM_SIDES_H

#include "mpm/mpm.h"

/** What the sides do to the nodes of the solid: a side with friction is open, mpm.meet_walls stops the solid there. */
void sides_of_solid(const struct scene *scene, struct side_condition sides[SIDES]);
/** Whether a side that holds moves or has a gauge: only then its impulses are counted. */
bool        sides_watched(const struct scene *scene);
enum status sides_create(struct sim *sim, struct mpm *m) MUST_CHECK;
void        sides_destroy(struct mpm *m);

/* which sums of a body's nodes are folded: all of a step, forces of loads that came later, or MUSL's second gathering
 */
enum fold { FOLD_STEP, FOLD_LOADS, FOLD_REMAP };
/** What fell on the ghosts of a body goes to their images; of watched sides it is kept for their account. The image of
 * a momentum behind a side that moves with w at time t is 2 w m - p. */
void sides_fold(const struct sim *sim, struct mpm *m, int body, enum fold what, double t);

#endif
