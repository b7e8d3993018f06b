/* `mpmice info FILE`: what is in a file of an output folder. */
#ifndef RUN_INFO_H
#define RUN_INFO_H

#include "core/status.h"

#include <stdio.h>

/** Lists a snapshot, a checkpoint (.hdf, .h5), gauges.csv or a .json file of a run. */
enum status info_print(const char *path, FILE *out) MUST_CHECK;

#endif
