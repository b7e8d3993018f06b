/* A fields.def declares every field of a module once; from it come the member, the allocation, the output and the
 * checkpoint. */
#ifndef CORE_FIELD_H
#define CORE_FIELD_H

#include <stddef.h>

enum where { AT_NODE, AT_CELL, AT_FACE, AT_SOLID, AT_WATER, AT_MARKER };

/* STATE is carried from step to step and checkpointed; SCRATCH is made anew in every step and poisoned in debug runs.
 */
enum field_kind { STATE, SCRATCH };

/* Whether scratch is filled with NaN before every step: a stage that reads what this step has not written shows. */
#ifdef MPMICE_POISON
enum { FIELD_POISON = 1 };
#else
enum { FIELD_POISON = 0 };
#endif

/* components: a number, or one that depends on the dimension, or on the materials (history of their laws). FLUIDS: one
 * number (FLUID_VECTORS: one vector) for every fluid of the scene, in a copy of the field for each: [fluid][size], the
 * first fluid in front. */
enum { VECTOR = -1, MATRIX = -2, HISTORY = -3, FLUIDS = -4, FLUID_VECTORS = -5, SYMMETRIC = 6 };

struct scene;

struct field {
  const char     *name; /* suffix _nc _cc _fc _p says where */
  enum where      at;
  int             components; /* faces: per axis; layout [dim][size] */
  enum field_kind kind;
  const char     *output; /* name in output files; NULL: not written */
  const char     *unit, *meaning;
  size_t          offset; /* of the double * in the module's state */
};

/** Components of a field in this scene. */
int field_components(const struct field *f, const struct scene *scene);
/** Copies of it: one, or one for every fluid. */
int field_copies(const struct field *f, const struct scene *scene);

/* A module's state starts with   FIELDS_MEMBERS   and its table is made with   FIELDS_TABLE(struct mpm).
 * FIELD(name, at, components, kind, output, unit, meaning) */
#define FIELD_MEMBER(name, at, components, kind, output, unit, meaning) double *name;
#define FIELD_ROW(type, name, at, components, kind, output, unit, meaning)                                             \
  {#name, at, components, kind, output, unit, meaning, offsetof(type, name)},

#endif
