/* Heat of the solid: when it is solved, its stages, its sides. theory 3.8 */
#ifndef MPM_HEAT_H
#define MPM_HEAT_H

#include "mpm/mpm.h"

/** Some material of a solid has a heat capacity: points have a temperature. */
bool heat_solved(const struct scene *scene);
/** Heat goes through nodes: something conducts, or bodies rub. Not in a skeleton that is held in a fluid whose energy
 * is solved: its path conducts for both. */
bool heat_flows(const struct scene *scene);
/** Some side of the grid has a given temperature or flux (enum heat_kind). */
bool heat_has_side(const struct scene *scene, int kind);

enum status mpm_heat_to_nodes(struct sim *sim, double dt);
enum status mpm_conduct_heat(struct sim *sim, double dt);
enum status mpm_fill_sides(struct sim *sim, double dt);
enum status mpm_heat_sides(struct sim *sim, double dt);
enum status mpm_clear_heat_source(struct sim *sim, double dt);
enum status mpm_warm_nodes(struct sim *sim, double dt);
enum status mpm_heat_to_points(struct sim *sim, double dt);
enum status mpm_heat_by_work(struct sim *sim, double dt);
double      mpm_heat_dt(const struct sim *sim);

/** Temperatures at the start; scratch. */
enum status mpm_create_heat(struct sim *sim, struct mpm *m) MUST_CHECK;

/* mpm/heat_sides.c: sides on the nodes' heat content (J) and temperature (K) at time t, in this order; folding comes
 * before the last. */
/** Images beyond sides with a flux are warmer or colder: adds that to the heat content in temperature_nc. */
void heat_lift(struct sim *sim, struct mpm *m, double t);
/** What fell on ghost nodes beyond sides of given temperature T becomes 2 capacity_nc T - field; capacity_nc NULL: an
 *  increment, T = 0. */
void heat_reflect(const struct sim *sim, const struct mpm *m, double t, const double *capacity_nc, double *field);
/** Nodes on sides of given temperature get it (increment: zero), then ghosts from inside. */
void heat_bound(const struct sim *sim, struct mpm *m, double t, bool increment, double *field);

#endif
