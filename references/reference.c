/* The list of reference solutions. */
#include "references/reference.h"

#include <string.h>

#define REFERENCE(name) extern const struct reference reference_##name;
#include "references/references.def"
#undef REFERENCE

const struct reference *const references[] = {
#define REFERENCE(name) &reference_##name,
#include "references/references.def"
#undef REFERENCE
    NULL};

const struct reference *reference_find(const char *name)
{
  for (const struct reference *const *r = references; *r; r++)
    if (strcmp((*r)->name, name) == 0) return *r;
  return NULL;
}

int reference_quantity(const struct reference *reference, const char *word)
{
  size_t length = strlen(word);
  int    index = 0;
  for (const char *q = reference->quantities; q; index++) {
    const char *bar = strchr(q, '|');
    size_t      n = bar ? (size_t)(bar - q) : strlen(q);
    if (n == length && strncmp(q, word, n) == 0) return index;
    q = bar ? bar + 1 : NULL;
  }
  return -1;
}
