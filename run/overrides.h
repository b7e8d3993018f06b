/* Overrides: "key.path: value" from paths, variants, quick and --set, applied to the JSON of a scene. */
#ifndef RUN_OVERRIDES_H
#define RUN_OVERRIDES_H

#include "core/scene.h"
#include "run/files.h"
#include "run/options.h"
#include "run/sections.h"

enum { MAX_VARIANTS = 16 };

/* Everything that may change a scene. */
struct overrides {
  const char               *fluid; /* --fluid; NULL */
  int                       n_variants;
  char                      variants[MAX_VARIANTS][NAME_LENGTH];
  const struct run_options *options; /* quick and --set */
};

/** Applies them in the order paths.<path>, variants, quick, --set; path: the fluid path that results, "solid" without.
 */
enum status overrides_apply(const char *file, const struct section *section, const struct overrides *overrides,
                            cJSON *json, char path[NAME_LENGTH]) MUST_CHECK;
/** Checks the keys of a set that need not be applied: "variants.<name>", "quick", "paths.<path>". Names of materials,
 *  loads, ... are looked for when it is applied. */
enum status overrides_check(struct reader *reader, const struct section *section, const cJSON *set) MUST_CHECK;

#endif
