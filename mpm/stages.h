/* The stages of the solid, one file each; module.c lists them. */
#ifndef MPM_STAGES_H
#define MPM_STAGES_H

#include "mpm/mpm.h"

/* what a run of points reports after a stress update: largest wave speed and speed (m/s), plastic work of the step (J),
 * power of the stress (W), points that could not be strained */
enum { SEEN_WAVE, SEEN_SPEED, SEEN_PLASTIC, SEEN_POWER, SEEN_BAD, N_SEEN };

enum status mpm_sort_points(struct sim *sim, double dt);
enum status mpm_points_to_nodes(struct sim *sim, double dt);
enum status mpm_load_surfaces(struct sim *sim, double dt);
enum status mpm_fold_nodes(struct sim *sim, double dt);
enum status mpm_join_bodies(struct sim *sim, double dt);
enum status mpm_watch_sides(struct sim *sim, double dt);
enum status mpm_resolve_contact(struct sim *sim, double dt);
enum status mpm_meet_walls(struct sim *sim, double dt);
enum status mpm_press_sides(struct sim *sim, double dt);
enum status mpm_rub_sides(struct sim *sim, double dt);
enum status mpm_expel_points(struct sim *sim, double dt);
enum status mpm_join_velocities(struct sim *sim, double dt);
enum status mpm_share_push(struct sim *sim, double dt);
enum status mpm_hold_sides(struct sim *sim, double dt);
enum status mpm_absorb_waves(struct sim *sim, double dt);
enum status mpm_damp_nodes(struct sim *sim, double dt);
enum status mpm_advance_nodes(struct sim *sim, double dt);
enum status mpm_nodes_to_points(struct sim *sim, double dt);
enum status mpm_move_and_strain(struct sim *sim, double dt);
enum status mpm_move_markers(struct sim *sim, double dt);
enum status mpm_remap_momentum(struct sim *sim, double dt);
enum status mpm_smooth_strain(struct sim *sim, double dt);
enum status mpm_smooth_strain_again(struct sim *sim, double dt);
enum status mpm_take_smoothed(struct sim *sim, double dt);
enum status mpm_deform_points(struct sim *sim, double dt);
enum status mpm_update_stress(struct sim *sim, double dt);
double      mpm_stress_dt(const struct sim *sim);
double      mpm_walls_dt(const struct sim *sim);
enum status mpm_part_points(struct sim *sim, double dt);

/** Nodes to points of one group of points (a solid): what a kernel needs besides the run. */
struct g2p_args mpm_motion(const struct sim *sim, const struct mpm *m, double dt, int group);
/** Velocity of a body's nodes = momentum / mass where there is enough mass, else zero; walls at time t. */
void mpm_velocities(const struct sim *sim, const struct mpm *m, const struct body_nodes *b, double t, double *vel_nc);
/** Deals with points outside the grid as numerics.mpm.stray says; the set must be sorted after it. */
enum status mpm_handle_strays(struct sim *sim, struct mpm *m) MUST_CHECK;
/** Adds mass, momentum and energy of point p; energies not yet at the time of the velocities. */
void mpm_measure_point(const struct sim *sim, const struct mpm *m, const double gravity[3], long p, struct ledger *l);
/** Sorts the set now, whether needed or not. */
enum status mpm_sort_now(struct sim *sim, struct mpm *m) MUST_CHECK;
/** Gradient at the points of their bodies' new nodal velocity, into gradv [n][dim][dim]. */
void mpm_gather_gradient(struct sim *sim, struct mpm *m, double *gradv);
/** A gradient taken at the places where a step ends becomes the one at those where it began. gradv [n][dim][dim] */
void mpm_refer_to_start(const struct sim *sim, const struct mpm *m, double dt, double *gradv);
/** Speeds of the starting state, for the first time step. */
enum status mpm_first_speeds(struct sim *sim, struct mpm *m) MUST_CHECK;

#endif
