/* What the verbs of the command line do. */
#ifndef RUN_VERBS_H
#define RUN_VERBS_H

#include "core/status.h"
#include "run/options.h"

/** Validates a scene with its variants and prints what would run, per fluid path. */
enum status verb_check(const struct run_options *options) MUST_CHECK;
/** Prints the plan. */
enum status verb_explain(const struct run_options *options) MUST_CHECK;
/** The scene on several fluid paths: a table, and compare.json. */
enum status verb_compare(const struct run_options *options) MUST_CHECK;
/** Error against run time over ladders of parameters: tables, and study.json. */
enum status verb_study(const struct run_options *options) MUST_CHECK;
/** Where a scene stays stable over a product of parameters: maps, and stress.json. */
enum status verb_stress(const struct run_options *options) MUST_CHECK;
/** What is in a file of an output folder. */
enum status verb_info(const struct run_options *options) MUST_CHECK;
/** The standard pictures of the runs at or below a folder. */
enum status verb_plot(const struct run_options *options) MUST_CHECK;
/** Shipped cases, fluid paths, laws, references, stages, parameters. */
enum status verb_list(const struct run_options *options) MUST_CHECK;
/** The JSON Schema of a scene. */
enum status verb_schema(const struct run_options *options) MUST_CHECK;
/** Writes a commented starter scene. */
enum status verb_new(const struct run_options *options) MUST_CHECK;

#endif
