/* The only malloc. */
#include "core/memory.h"

#include <malloc.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

/* bytes: of a cache line, and of a huge page */
enum { ALIGNMENT = 64, HUGE_PAGE = 1 << 21 };
static long calls;

/* Big blocks ask for huge pages: a sweep over many arrays waits for the table of small ones. Each is a mapping of its
 * own, which goes back whole when it is freed. */
static void *reserve(size_t bytes)
{
  if (bytes < 2 * HUGE_PAGE) return aligned_alloc(ALIGNMENT, bytes);
#ifdef M_MMAP_THRESHOLD
  mallopt(M_MMAP_THRESHOLD, HUGE_PAGE); /* fixed, or it would grow with every block that is freed */
  mallopt(M_MMAP_MAX, 1 << 16);         /* a library of the solvers' forbids all when it is loaded */
#endif
  void *block = NULL;
  if (posix_memalign(&block, HUGE_PAGE, bytes) != 0) return NULL;
#ifdef MADV_HUGEPAGE
  madvise(block, bytes / HUGE_PAGE * HUGE_PAGE, MADV_HUGEPAGE); /* a wish: without them all works too */
#endif
  return block;
}

enum status memory_new(size_t n, size_t size, void *pointer)
{
  void *block = NULL;
  if (size != 0 && n > (SIZE_MAX - ALIGNMENT) / size)
    return FAIL(ERR_ENVIRONMENT, "memory: %zu elements of %zu bytes overflow; use a coarser grid", n, size);
  size_t bytes = (n * size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
  if (bytes == 0) bytes = ALIGNMENT;
#pragma omp atomic
  calls++;
  block = reserve(bytes);
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
