/* How much of a line along an axis is liquid: depths, heights, fronts. */
#ifndef RUN_GAUGE_LEVEL_H
#define RUN_GAUGE_LEVEL_H

#include "run/gauge_read.h"

/** Makes a gauge of kind "level", or sample `sample` of "levels", ready. ERR_INPUT: an unknown axis, no liquid that
 * moves. */
enum status gauge_level_create(const struct sim *sim, const struct gauge *gauge, int sample,
                               struct gauge_reader *r) MUST_CHECK;

#endif
