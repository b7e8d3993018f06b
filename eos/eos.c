/* The list of equations of state. */
#include "eos/eos.h"

#include <string.h>

#define EOS(name) extern const struct eos eos_##name;
#include "eos/eos.def"
#undef EOS

const struct eos *const eos_laws[] = {
#define EOS(name) &eos_##name,
#include "eos/eos.def"
#undef EOS
    NULL};

const struct eos *eos_find(const char *name)
{
  for (const struct eos *const *law = eos_laws; *law; law++)
    if (strcmp((*law)->name, name) == 0) return *law;
  return NULL;
}
