/* What no single value can tell: whether the parts of a scene fit together. */
#ifndef RUN_SCENE_CHECK_H
#define RUN_SCENE_CHECK_H

#include "core/scene.h"
#include "run/params.h"

/** Whole cells, one-cell axes, points per axis, periodic pairs, materials that suit fluid and drag, metrics. Completes
 *  the scene: cells, max, middle of a null coordinate. */
enum status scene_check(struct reader *reader, struct scene *scene) MUST_CHECK;
/** Solids inside the grid, not empty, not overlapping; loads on a solid; tracers and gauges inside the grid. */
enum status scene_check_places(struct reader *reader, struct scene *scene) MUST_CHECK;
/** Gauges and metrics speak of fields, ledger entries and movements that this scene has. */
enum status scene_check_words(struct reader *reader, const struct scene *scene) MUST_CHECK;

/** Every solid has a heat capacity or none; sides that heat or cool have something to conduct it. run/scene_heat.c */
enum status scene_check_heat(struct reader *reader, const struct scene *scene) MUST_CHECK;
/** Whether a prescribed motion of the fluid is all there is. */
enum status scene_check_motion(struct reader *reader, const struct scene *scene) MUST_CHECK;

/** Points of the regular lattice (points per axis in every cell) that lie in a shape. */
long scene_count_points(const struct scene *scene, const struct shape *shape);

#endif
