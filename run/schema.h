/* The tables of a scene as documents: JSON Schema 2020-12, and a reference of every parameter. */
#ifndef RUN_SCHEMA_H
#define RUN_SCHEMA_H

#include "core/status.h"

#include <stdbool.h>
#include <stdio.h>

/** JSON Schema of a scene file. */
enum status schema_print(FILE *out) MUST_CHECK;
/** Every key with type, unit, range, default and meaning, as text or as Markdown (docs/parameters.md). */
void reference_print(FILE *out, bool markdown);

#endif
