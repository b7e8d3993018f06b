/* The command line: which verb, and its options. */
#ifndef RUN_ARGUMENTS_H
#define RUN_ARGUMENTS_H

#include "core/status.h"
#include "run/options.h"

#include <stdio.h>

struct verb {
  const char *name, *argument, *options; /* argument: "SCENE", ... or NULL; options: "--fluid --set ..." */
  const char *summary, *details;
  enum status (*run)(const struct run_options *options);
};

/** Verbs that work; ends with a NULL name. */
extern const struct verb verbs[];

/** Reads what stands behind the verb; *help: --help was given. */
enum status arguments_read(const struct verb *verb, int n, char *const words[], struct run_options *options,
                           bool *help) MUST_CHECK;
/** The verb of that name; ERR_INPUT names the nearest. */
enum status arguments_find_verb(const char *name, const struct verb **verb) MUST_CHECK;
void        arguments_help(const struct verb *verb, FILE *out);
void        arguments_help_all(FILE *out);

#endif
