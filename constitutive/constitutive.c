/* The list of skeleton laws. */
#include "constitutive/constitutive.h"

#include <string.h>

#define LAW(name) extern const struct constitutive_model constitutive_##name;
#include "constitutive/constitutive.def"
#undef LAW

const struct constitutive_model *const constitutive_models[] = {
#define LAW(name) &constitutive_##name,
#include "constitutive/constitutive.def"
#undef LAW
    NULL};

const struct constitutive_model *constitutive_find(const char *name)
{
  for (const struct constitutive_model *const *law = constitutive_models; *law; law++)
    if (strcmp((*law)->name, name) == 0) return *law;
  return NULL;
}
