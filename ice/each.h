/* Several fluids with velocities of their own: what the stages share. theory 4.17 */
#ifndef ICE_EACH_H
#define ICE_EACH_H

#include "ice/ice.h"

/** Share of fluid k of a cell that lies in its lower half along an axis. */
double each_lower(const struct grid *g, const struct ice *ice, int k, int axis, long c);
/** Moves the fluids of every cell by what their mean has been moved. */
void each_follow_mean(struct sim *sim, struct ice *ice);
/** Cells take the changes of their faces, fluid by fluid. */
void each_move(struct sim *sim, struct ice *ice);
/** What the fluids carry through the faces of an axis after a sweep of the first. */
void each_pass(struct sim *sim, struct ice *ice, int axis, double dt);

#endif
