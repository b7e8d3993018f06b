/* Snapshots of the fields: fields.<set>.<NNNNN>.hdf (VTKHDF UnstructuredGrid 1.0) and fields.<set>.hdf.series. */
#ifndef RUN_OUTPUT_H
#define RUN_OUTPUT_H

#include "core/sim.h"

struct output_writer;

/** Allocates everything that snapshots of this plan need. The folder must exist. */
enum status output_create(const struct sim *sim, const char *folder, struct output_writer **output) MUST_CHECK;
void        output_destroy(struct output_writer **output);
/** Writes the present state of every set as the next snapshot; each file appears complete or not at all. */
enum status output_write(struct output_writer *output, const struct sim *sim) MUST_CHECK;
/** Snapshots written so far. */
long output_count(const struct output_writer *output);
/** After a checkpoint was read: goes on after `count` snapshots; later ones are forgotten and overwritten. */
enum status output_resume(struct output_writer *output, long count) MUST_CHECK;
/** s between snapshots: the scene's, or a twentieth of the end time. */
double output_interval(const struct scene *scene);

#endif
