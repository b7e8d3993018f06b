/* The tables of a scene: what may stand in it, in which order it is read. */
#ifndef RUN_SCENE_TABLES_H
#define RUN_SCENE_TABLES_H

#include "core/shape.h"
#include "run/sections.h"

extern const struct section scene_section;

/* Words of a shape. */
struct shape_word {
  const char         *name;
  enum shape_kind     kind;
  int                 dim;    /* 0: the grid's */
  const struct param *params; /* NULL: a list */
  const char         *meaning;
};

extern const struct shape_word shape_words[];

/* Values that are more than a number or a word. */
extern const struct value_kind value_shape, value_title, value_folder, value_notes, value_origin, value_side_solid,
    value_side_fluid, value_side_heat, value_material, value_points_per_cell, value_times, value_fluid_path,
    value_time_unit, value_profile, value_overrides, value_override_sets, value_path_overrides;

/** x_min, x_max, ...: SIDES of them. */
extern const char *const side_names[];

/** Registered laws as rows of a choice. */
bool constitutive_row(int i, struct row *row);
bool eos_row(int i, struct row *row);
bool drag_row(int i, struct row *row);
bool reference_row(int i, struct row *row);

#endif
