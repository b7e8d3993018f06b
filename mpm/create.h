/* Filling the state of the solid at the start. */
#ifndef MPM_CREATE_H
#define MPM_CREATE_H

#include "mpm/mpm.h"

/** Node arrays of the bodies. */
enum status mpm_create_bodies(struct sim *sim, struct mpm *m) MUST_CHECK;
void        mpm_destroy_bodies(struct mpm *m);
/** Points of every solid on their lattice, unstressed, with the scene's velocity. */
enum status mpm_create_points(struct sim *sim, struct mpm *m) MUST_CHECK;
/** Geostatic stress where the scene starts at rest. */
enum status mpm_start_stress(struct sim *sim, struct mpm *m) MUST_CHECK;
/** Markers on loaded surfaces and tracers. */
enum status mpm_create_markers(struct sim *sim, struct mpm *m) MUST_CHECK;
long        mpm_count_markers(const struct scene *scene);

#endif
