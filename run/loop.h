/* A run from a scene to its summary. */
#ifndef RUN_LOOP_H
#define RUN_LOOP_H

#include "core/status.h"
#include "run/options.h"

/** Runs options->argument into options->out (or out/<scene>-<path>). ERR_METRIC: done, but a metric missed its limit;
 *  INTERRUPTED: stopped by a signal, checkpoint and summary written. */
enum status run_scene(const struct run_options *options) MUST_CHECK;
/** Goes on in the folder options->argument from its last checkpoint, to options->until. */
enum status run_resume(const struct run_options *options) MUST_CHECK;

#endif
