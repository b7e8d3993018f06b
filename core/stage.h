/* A stage: one thing that happens in a time step. */
#ifndef CORE_STAGE_H
#define CORE_STAGE_H

#include "core/status.h"

#include <stdbool.h>

struct scene;
struct sim;

enum slot {
#define SLOT(name, sentence) SLOT_##name,
#include "core/step_order.def"
#undef SLOT
  N_SLOTS
};

struct stage {
  const char *name;                     /* "folder.verb_object" */
  enum slot   slot;                     /* its line in core/step_order.def */
  const char *reads, *writes;           /* field names, checked with the plan; name?: only if another stage has it */
  const char *source, *when;            /* section of docs/theory.md; needed() in words, for explain */
  bool (*needed)(const struct scene *); /* NULL: always. Looks at the scene, never at the state */
  enum status (*run)(struct sim *, double dt);
  double (*dt_limit)(const struct sim *); /* s; NULL: this stage sets no limit */
};

#endif
