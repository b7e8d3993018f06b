/* How far points reach along an axis: fronts, heights. */
#ifndef RUN_GAUGE_EXTENT_H
#define RUN_GAUGE_EXTENT_H

#include "run/gauge_read.h"

/** Makes a gauge of kind "extent" ready. ERR_INPUT: an unknown word or body. */
enum status gauge_extent_create(const struct sim *sim, const struct gauge *gauge, struct gauge_reader *r) MUST_CHECK;
void        gauge_extent_destroy(struct gauge_reader *r);

#endif
