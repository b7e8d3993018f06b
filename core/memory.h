/* The only allocator. Everything is allocated while a plan is built; a step allocates nothing (memory_calls() proves
 * it). */
#ifndef CORE_MEMORY_H
#define CORE_MEMORY_H

#include "core/status.h"

#include <stddef.h>

/** n zeroed elements of `size` bytes, aligned to a cache line, into *pointer. ERR_ENVIRONMENT: no memory. */
enum status memory_new(size_t n, size_t size, void *pointer) MUST_CHECK;
/** Frees *pointer and sets it to NULL; *pointer may be NULL. */
void memory_free(void *pointer);
/** Number of allocations so far. */
long memory_calls(void);

#define NEW(pointer, n) memory_new((size_t)(n), sizeof **(pointer), (pointer))

#endif
