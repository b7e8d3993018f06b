/* The verbs that look at what a run left: info, plot. */
#include "run/info.h"
#include "run/scripts.h"
#include "run/verbs.h"

#include <stdio.h>

enum status verb_info(const struct run_options *options) { return info_print(options->argument, stdout); }

enum status verb_plot(const struct run_options *options) { return script_run("plot.py", options->argument); }
