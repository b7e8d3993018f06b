/* The only malloc. */
#include "core/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 64 };
static long calls;

enum status memory_new(size_t n, size_t size, void *pointer)
{
  void *block = NULL;
  if (size != 0 && n > (SIZE_MAX - ALIGNMENT) / size)
    return FAIL(ERR_ENVIRONMENT, "memory: %zu elements of %zu bytes overflow; use a coarser grid", n, size);
  size_t bytes = (n * size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
  if (bytes == 0) bytes = ALIGNMENT;
#pragma omp atomic
  calls++;
  block = aligned_alloc(ALIGNMENT, bytes);
  if (!block) return FAIL(ERR_ENVIRONMENT, "memory: no room for %zu bytes; use a coarser grid", bytes);
  memset(block, 0, bytes);
  memcpy(pointer, &block, sizeof block);
  return OK;
}

void memory_free(void *pointer)
{
  void *block = NULL, *none = NULL;
  memcpy(&block, pointer, sizeof block);
  free(block);
  memcpy(pointer, &none, sizeof none);
}

long memory_calls(void) { return calls; }
