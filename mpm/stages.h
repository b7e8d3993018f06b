/* The stages of the solid, one file each; module.c lists them. */
#ifndef MPM_STAGES_H
#define MPM_STAGES_H

#include "mpm/mpm.h"

/* what a run of points reports after a stress update: wave speed, speed, plastic work */
enum { RUN_SPEEDS = 3 };

enum status mpm_sort_points(struct sim *sim, double dt);
enum status mpm_points_to_nodes(struct sim *sim, double dt);
enum status mpm_load_surfaces(struct sim *sim, double dt);
enum status mpm_fold_nodes(struct sim *sim, double dt);
enum status mpm_advance_nodes(struct sim *sim, double dt);
enum status mpm_nodes_to_points(struct sim *sim, double dt);
enum status mpm_remap_momentum(struct sim *sim, double dt);
enum status mpm_update_stress(struct sim *sim, double dt);
double      mpm_stress_dt(const struct sim *sim);

/** Markers ride on the new nodal velocity; the loads' work is counted. */
void mpm_move_markers(struct sim *sim, struct mpm *m, double dt);
/** Sorts the set now, whether needed or not. */
enum status mpm_sort_now(struct sim *sim, struct mpm *m) MUST_CHECK;
/** Velocity gradient of a nodal field at the points, into gradv_p. */
void mpm_gather_gradient(struct sim *sim, struct mpm *m, const double *vel_nc);
/** Speeds of the starting state, for the first time step. */
enum status mpm_first_speeds(struct sim *sim, struct mpm *m) MUST_CHECK;

#endif
