/* checkpoint.h5: everything a run needs to go on bitwise. */
#ifndef RUN_CHECKPOINT_H
#define RUN_CHECKPOINT_H

#include "core/sim.h"

/* What a run keeps besides the sim: counters of events, sums for the summary, results of metrics so far, as numbers
 * (whole ones are exact up to 2^53). Names are unique; n may not change between writing and reading. */
struct checkpoint_item {
  const char *name;
  long        n;
  double     *v; /* [n] */
};

/** Writes <folder>/checkpoint.h5: state fields, point sets, time, ledgers, solver report, items, and the hash of
 *  <folder>/scene.used.json. The previous checkpoint stays until the new one is complete. */
enum status checkpoint_write(const char *folder, const struct sim *sim, int n_items,
                             const struct checkpoint_item *items) MUST_CHECK;
/** Restores a sim that was just created from the same scene. ERR_INPUT: no checkpoint, an unreadable one, or one of
 *  another scene.used.json or another plan. */
enum status checkpoint_read(const char *folder, struct sim *sim, int n_items,
                            const struct checkpoint_item *items) MUST_CHECK;
/** The same points, fields and items as the start of another run: time, step, ledgers and reports of the sim stay. */
enum status checkpoint_start(const char *folder, struct sim *sim, int n_items,
                             const struct checkpoint_item *items) MUST_CHECK;

#endif
