/* Absorbing sides of the grid. */
#ifndef MPM_ABSORB_H
#define MPM_ABSORB_H

#include "mpm/mpm.h"

/** Whether some side absorbs. */
bool absorb_present(const struct scene *scene);
/** Dashpots from the points as they are, sorted; nothing where no side absorbs. */
enum status absorb_create(struct sim *sim, struct mpm *m) MUST_CHECK;
void        absorb_destroy(struct mpm *m);
/** Keeps as reaction what would balance the bodies' forces and weights at the sides' nodes now, into reaction_nc. */
void absorb_hold(struct sim *sim, struct mpm *m);
/** What the dashpots leave of predicted velocities after dt: for fluid paths. vel_nc [size][dim] */
void absorb_slow(const struct sim *sim, const struct mpm *m, double dt, double *vel_nc);

#endif
