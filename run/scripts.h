/* The Python scripts of report/, which draw what a run left. */
#ifndef RUN_SCRIPTS_H
#define RUN_SCRIPTS_H

#include "core/status.h"

/** Runs report/<name> with a folder as its argument and waits. ERR_INPUT: the script found nothing to draw there;
 *  ERR_ENVIRONMENT: it cannot run here. */
enum status script_run(const char *name, const char *folder) MUST_CHECK;

#endif
