/* Walks the field tables of the planned modules: what output, checkpoint, gauges and metrics know of them. */
#ifndef RUN_FIELDS_H
#define RUN_FIELDS_H

#include "core/sim.h"

#include <stdbool.h>

/* A field where it lives now. */
struct field_view {
  const struct module *module;
  const struct field  *field;
  double              *data; /* [n][components]; faces [dim][n][components] */
  int                  components;
  int                  copy; /* the fluid that it belongs to */
  long                 n;    /* entries: points, markers, or grid.size with ghosts */
};

/** Fields of all planned modules, one after the other; *cursor starts at 0. false: no more. Fields that the plan does
 *  not hold (NULL pointer) are passed over. */
bool fields_next(const struct sim *sim, int *cursor, struct field_view *view);
/** Looks again where the field lives and how many entries it has: points come and go. */
void fields_refresh(const struct sim *sim, struct field_view *view);
/** Doubles in the field. */
long fields_length(const struct sim *sim, const struct field_view *view);
/** Positions of a point set: x_p of the solid, the first x_* with VECTOR components of the water. */
bool fields_positions(const struct sim *sim, enum where at, struct field_view *view);
/** The field of that name in its table, such as "x_m". */
bool fields_named(const struct sim *sim, const char *name, struct field_view *view);

/** One component of a written field by its output name: "P", "vel_y", "stress_xy"; "solid.vel_x", "water.vel_x",
 *  "cells.P" where a name exists in more than one set, else cells come first, then solid, then water. ERR_INPUT names
 *  the unknown word and lists what there is. */
enum status fields_component(const struct sim *sim, const char *of, struct field_view *view, int *component) MUST_CHECK;

/** Name of the written set: cells, solid, water; NULL for places that are not written. */
const char *fields_set(enum where at);
/** Name of a copy of a field made from its name or output name: of the first fluid as it stands, of others with their
 *  name, "mass_fluid" -> "mass_air", "saturation" -> "saturation_air". */
void fields_copy_name(const struct scene *scene, const char *name, int copy, char own[3 * NAME_LENGTH]);
/** Suffix of a component, "x", "yy", "3"; "" for a scalar. */
const char *fields_suffix(const struct field *f, const struct scene *scene, int component);

#endif
