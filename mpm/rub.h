/* Sides with friction in a fluid: they hold the solid along their normal, and rub by its effective stress. theory 3.12
 */
#ifndef MPM_RUB_H
#define MPM_RUB_H

#include "mpm/mpm.h"

/** Whether a side rubs in a scene with a fluid. Without one it is a wall that the solid may leave (mpm/walls.h). */
bool        rub_present(const struct scene *scene);
enum status rub_create(const struct sim *sim, struct mpm *m) MUST_CHECK;
void        rub_destroy(struct mpm *m);
/** Slows velocities vel_nc [size][dim] of nodes on such sides down by friction over dt: predicted ones, before a fluid
 * hears of them, or the final ones. */
void rub_nodes(const struct sim *sim, const struct mpm *m, double dt, double *vel_nc);

#endif
