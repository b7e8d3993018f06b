/* Many runs of one scene: on which paths, one run into a folder of its own, what is written about all of them. Used by
 * compare, study and stress. */
#ifndef RUN_SEVERAL_H
#define RUN_SEVERAL_H

#include "core/scene.h"
#include "run/files.h"
#include "run/json.h"
#include "run/options.h"

struct several {
  char scene[NAME_LENGTH], folder[LONGEST_PATH];
  int  n;
  char path[MAX_MODULES][NAME_LENGTH]; /* fluid paths; "solid" for a scene without a fluid */
  bool fluid;                          /* the scene has one */
};

/** Scene, paths of --fluid A,B,... (without it every path that can take the scene; the others are named with the
 * reason) and the folder: --out or out/<scene>-<verb>. */
enum status several_open(const struct run_options *options, const char *verb, struct several *s) MUST_CHECK;

/** Runs the scene on a path into folder/name. *how: what it came to; *summary: its summary.json (cJSON_Delete it), NULL
 * where there is none. A run that cannot start or fails numerically is a result; ERR_ENVIRONMENT and INTERRUPTED are
 * returned, ERR_INPUT as well where `input` is false. */
enum status several_run(const struct run_options *options, const struct several *s, const char *path, const char *name,
                        bool input, enum status *how, cJSON **summary) MUST_CHECK;

/** A number of a summary by its dotted path; NAN: none. */
double several_number(const cJSON *summary, const char *path);

/** Writes folder/file and takes the tree over; a NULL root is no memory. */
enum status several_write(const struct several *s, const char *file, cJSON *root) MUST_CHECK;

#endif
