/* A parameter and the values that runs of one scene give it: "h=0.04,0.02,0.01". */
#ifndef RUN_SWEEP_H
#define RUN_SWEEP_H

#include "core/status.h"
#include "run/json.h"
#include "run/options.h"

enum { MAX_STEPS = 32, STEP_LENGTH = 64 };

struct sweep {
  char key[JSON_PATH]; /* of the scene; h, dt, ppc, basis, transfer, K, mu stand for the usual ones */
  int  n;
  char value[MAX_STEPS][STEP_LENGTH];
};

/** Reads KEY=VALUE,VALUE,...; `option` starts messages. */
enum status sweep_read(const char *option, const char *text, struct sweep *sweep) MUST_CHECK;
/** The options of a run with value `i`, added to options->sets; `word` holds the override as long as it is used. */
enum status sweep_apply(const struct sweep *sweep, int i, char word[JSON_PATH + STEP_LENGTH],
                        struct run_options *options) MUST_CHECK;
/** Values as JSON: numbers where they are, else texts. */
cJSON *sweep_values(const struct sweep *sweep);

#endif
