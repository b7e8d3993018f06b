/* Walks the field tables of the planned modules: what output, checkpoint, gauges and metrics know of them. */
#include "run/fields.h"

#include "constitutive/constitutive.h"

#include <stdio.h>
#include <string.h>

static double *data_of(const struct sim *sim, int module, const struct field *f)
{
  double *data;
  memcpy(&data, (const char *)sim->states[module] + f->offset, sizeof data);
  return data;
}

static long entries(const struct sim *sim, enum where at)
{
  switch (at) {
  case AT_SOLID:
    return sim->points[SET_SOLID] ? sim->points[SET_SOLID]->n : 0;
  case AT_WATER:
    return sim->points[SET_WATER] ? sim->points[SET_WATER]->n : 0;
  case AT_MARKER:
    return sim->n_markers;
  default:
    return sim->grid.size;
  }
}

static long length_of(const struct sim *sim, const struct field *f)
{
  return entries(sim, f->at) * field_components(f, sim->scene) * (f->at == AT_FACE ? sim->grid.dim : 1);
}

bool fields_next(const struct sim *sim, int *cursor, struct field_view *view)
{
  int left = (*cursor)++;
  for (int m = 0; m < sim->n_modules; m++)
    for (int i = 0; i < sim->modules[m]->n_fields; i++) {
      const struct field *f = &sim->modules[m]->fields[i];
      int                 copies = field_copies(f, sim->scene), copy = left;
      left -= copies;
      if (left >= 0) continue;
      double *data = data_of(sim, m, f);
      if (!data) return fields_next(sim, cursor, view);
      *view = (struct field_view){
          sim->modules[m],     f, data + copy * length_of(sim, f), field_components(f, sim->scene), copy,
          entries(sim, f->at),
      };
      return true;
    }
  return false;
}

void fields_refresh(const struct sim *sim, struct field_view *view)
{
  for (int m = 0; m < sim->n_modules; m++)
    if (sim->modules[m] == view->module)
      view->data = data_of(sim, m, view->field) + view->copy * length_of(sim, view->field);
  view->n = entries(sim, view->field->at);
}

long fields_length(const struct sim *sim, const struct field_view *view)
{
  return view->n * view->components * (view->field->at == AT_FACE ? sim->grid.dim : 1);
}

bool fields_positions(const struct sim *sim, enum where at, struct field_view *view)
{
  int cursor = 0;
  while (fields_next(sim, &cursor, view))
    if (view->field->at == at && view->field->components == VECTOR && strncmp(view->field->name, "x_", 2) == 0)
      return true;
  return false;
}

bool fields_named(const struct sim *sim, const char *name, struct field_view *view)
{
  int cursor = 0;
  while (fields_next(sim, &cursor, view))
    if (strcmp(view->field->name, name) == 0) return true;
  return false;
}

const char *fields_set(enum where at)
{
  switch (at) {
  case AT_CELL:
    return "cells";
  case AT_SOLID:
    return "solid";
  case AT_WATER:
    return "water";
  default:
    return NULL;
  }
}

/* name of a history component where all laws of the scene that have it agree; NULL: they do not */
static const char *history_name(const struct scene *scene, int component)
{
  const char *name = NULL;
  for (int i = 0; i < scene->n_materials; i++) {
    const struct constitutive_model *model = scene->materials[i].model;
    if (component >= model->n_history) continue;
    if (name && strcmp(name, model->history[component]) != 0) return NULL;
    name = model->history[component];
  }
  return name;
}

void fields_copy_name(const struct scene *scene, const char *name, int copy, char own[3 * NAME_LENGTH])
{
  static const char first[] = "_fluid";
  size_t            n = strlen(name), tail = sizeof first - 1;
  if (copy > 0 && n > tail && strcmp(name + n - tail, first) == 0) n -= tail;
  snprintf(own, 3 * NAME_LENGTH, "%.*s%s%s", (int)n, name, copy > 0 ? "_" : "",
           copy > 0 ? scene_fluid(scene, copy)->name : "");
}

const char *fields_suffix(const struct field *f, const struct scene *scene, int component)
{
  static const char *const vector[] = {"x", "y", "z"}, *const symmetric[] = {"xx", "yy", "zz", "xy", "yz", "xz"};
  static const char *const matrix[] = {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};
  static const char *const number[] = {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"};
  switch (f->components) {
  case 1:
  case FLUIDS:
    return "";
  case VECTOR:
  case FLUID_VECTORS:
    return vector[component];
  case SYMMETRIC:
    return symmetric[component];
  case MATRIX:
    return matrix[component / scene->dim * 3 + component % scene->dim];
  case HISTORY:
    return history_name(scene, component) ? history_name(scene, component) : number[component % 10];
  default:
    return component < 10 ? number[component] : "?";
  }
}

/* Whether `of`, without a set in front, is component c of the field. */
static bool is_component(const struct field_view *v, const struct scene *scene, int c, const char *of)
{
  const char *suffix = fields_suffix(v->field, scene, c);
  char        name[3 * NAME_LENGTH];
  fields_copy_name(scene, v->field->output, v->copy, name);
  size_t n = strlen(name);
  if (strncmp(of, name, n) != 0) return false;
  return *suffix ? of[n] == '_' && strcmp(of + n + 1, suffix) == 0 : of[n] == '\0';
}

static bool find(const struct sim *sim, enum where at, const char *of, struct field_view *view, int *component)
{
  const char *set = fields_set(at), *dot = strchr(of, '.');
  int         cursor = 0;
  if (dot && (strncmp(of, set, strlen(set)) != 0 || of + strlen(set) != dot)) return false;
  while (fields_next(sim, &cursor, view))
    for (*component = 0; *component < view->components; (*component)++)
      if (view->field->at == at && view->field->output &&
          is_component(view, sim->scene, *component, dot ? dot + 1 : of))
        return true;
  return false;
}

static enum status unknown(const struct sim *sim, const char *of)
{
  char              list[512] = "";
  size_t            n = 0;
  int               cursor = 0;
  struct field_view v;
  while (fields_next(sim, &cursor, &v))
    for (int c = 0; v.field->output && fields_set(v.field->at) && c < v.components && n < sizeof list; c++) {
      const char *suffix = fields_suffix(v.field, sim->scene, c);
      char        name[3 * NAME_LENGTH];
      fields_copy_name(sim->scene, v.field->output, v.copy, name);
      n += (size_t)snprintf(list + n, sizeof list - n, "%s%s.%s%s%s", n ? ", " : "", fields_set(v.field->at), name,
                            *suffix ? "_" : "", suffix);
    }
  return FAIL(ERR_INPUT, "\"%s\" is no field of this run; there are: %s", of, list);
}

enum status fields_component(const struct sim *sim, const char *of, struct field_view *view, int *component)
{
  static const enum where order[] = {AT_CELL, AT_SOLID, AT_WATER};
  for (int i = 0; i < 3; i++)
    if (find(sim, order[i], of, view, component)) return OK;
  return unknown(sim, of);
}
