/* The list of drag laws. */
#include "coupling/drag.h"

#include <string.h>

#define DRAG(name) extern const struct drag_law drag_##name;
#include "coupling/drag.def"
#undef DRAG

const struct drag_law *const drag_laws[] = {
#define DRAG(name) &drag_##name,
#include "coupling/drag.def"
#undef DRAG
    NULL};

const struct drag_law *drag_find(const char *name)
{
  for (const struct drag_law *const *law = drag_laws; *law; law++)
    if (strcmp((*law)->name, name) == 0) return *law;
  return NULL;
}
