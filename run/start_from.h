/* A run that starts where another one ended. */
#ifndef RUN_START_FROM_H
#define RUN_START_FROM_H

#include "run/checkpoint.h"
#include "run/scene_read.h"

/** Fills a sim that was just created, and items, from the run that the scene names as start_from, if it names one; its
 *  ledger starts there. ERR_INPUT: no such run, or one of another grid, solids, tracers, loads or fluid path. */
enum status start_from(const struct loaded_scene *loaded, struct sim *sim, int n_items,
                       const struct checkpoint_item *items) MUST_CHECK;

#endif
