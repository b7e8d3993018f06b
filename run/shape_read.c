/* Shapes of a scene: {"box": {...}}, {"union": [...]}, "everywhere". */
#include "core/memory.h"
#include "core/shape.h"
#include "run/scene_tables.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const struct param box[] = {{"min", PARAM_VECTOR, offsetof(struct shape, min), "m", -1e9, INFINITY, NULL, NULL,
                                    "lower corner; null: unbounded along that axis"},
                                   {"max", PARAM_VECTOR, offsetof(struct shape, max), "m", -1e9, INFINITY, NULL, NULL,
                                    "upper corner; null: unbounded along that axis"},
                                   PARAM_END};
static const struct param ball[] = {
    {"centre", PARAM_VECTOR, offsetof(struct shape, centre), "m", -1e9, 1e9, NULL, NULL, "centre"},
    {"radius", PARAM_NUMBER, offsetof(struct shape, radius), "m", 1e-12, 1e9, NULL, NULL, "radius"},
    PARAM_END};
static const struct param half_space[] = {
    {"point", PARAM_VECTOR, offsetof(struct shape, centre), "m", -1e9, 1e9, NULL, NULL, "point on the plane"},
    {"normal", PARAM_VECTOR, offsetof(struct shape, normal), "-", -1e9, 1e9, NULL, NULL,
     "direction out of the half-space, of any length"},
    PARAM_END};

const struct shape_word shape_words[] = {
    {"box", SHAPE_BOX, 0, box, "min <= x <= max"},
    {"circle", SHAPE_BALL, 2, ball, "circle; in 3D a cylinder along z"},
    {"sphere", SHAPE_BALL, 3, ball, "ball, in 3D only"},
    {"half_space", SHAPE_HALF_SPACE, 0, half_space, "everything behind a plane"},
    {"polygon", SHAPE_POLYGON, 2, NULL, "list of three or more vertices [x, y], either turn; in 3D a prism along z"},
    {"union", SHAPE_UNION, 0, NULL, "list of shapes: in any of them"},
    {"difference", SHAPE_DIFFERENCE, 0, NULL, "list of shapes: in the first but in none of the others"},
    {"intersection", SHAPE_INTERSECTION, 0, NULL, "list of shapes: in all of them"},
    {NULL, SHAPE_EVERYWHERE, 0, NULL, NULL}};

static enum status read_shape(struct reader *reader, const cJSON *value, struct shape *s);

/** A null in "min" means unbounded downwards. */
static enum status finish_box(const struct reader *reader, struct shape *s)
{
  for (int d = 0; d < reader->dim; d++) {
    if (isinf(s->min[d])) s->min[d] = -INFINITY;
    if (s->min[d] > s->max[d])
      return reader_fail(reader, "min %.10g lies above max %.10g along %c; exchange them", s->min[d], s->max[d],
                         "xyz"[d]);
  }
  return OK;
}

static enum status finish_half_space(const struct reader *reader, struct shape *s)
{
  double length = sqrt(s->normal[0] * s->normal[0] + s->normal[1] * s->normal[1] + s->normal[2] * s->normal[2]);
  if (length < 1e-12) return reader_fail(reader, "the normal is zero; give the direction out of the half-space");
  for (int d = 0; d < 3; d++) s->normal[d] /= length;
  return OK;
}

static enum status check_members(struct reader *reader, const struct param *table, const cJSON *value)
{
  struct names names = {0};
  names_add_table(&names, table);
  if (!cJSON_IsObject(value))
    return reader_fail(reader, "expected an object {...}, found %s; give its %s and %s", json_type(value),
                       table[0].name, table[1].name);
  for (const cJSON *member = value->child; member; member = member->next)
    if (!json_is_comment(member) && strcmp(member->string, table[0].name) != 0 &&
        strcmp(member->string, table[1].name) != 0)
      return reader_unknown(reader, "key", member->string, &names);
  return OK;
}

static enum status read_simple(struct reader *reader, const struct shape_word *word, const cJSON *value,
                               struct shape *s)
{
  TRY(check_members(reader, word->params, value));
  if (word->dim == 3 && reader->dim == 2)
    return reader_fail(reader, "a sphere needs a grid of 3 dimensions; use a circle");
  TRY(params_read(reader, word->params, value, s));
  s->dim = word->dim ? word->dim : reader->dim;
  if (s->kind == SHAPE_BOX) return finish_box(reader, s);
  return s->kind == SHAPE_HALF_SPACE ? finish_half_space(reader, s) : OK;
}

static enum status read_vertex(struct reader *reader, const cJSON *value, double vertex[2])
{
  if (!cJSON_IsArray(value) || cJSON_GetArraySize(value) != 2)
    return reader_fail(reader, "a vertex is not a pair of numbers; write it as [x, y]");
  for (int d = 0; d < 2; d++) {
    const cJSON *x = cJSON_GetArrayItem(value, d);
    if (!cJSON_IsNumber(x)) return reader_fail(reader, "a vertex holds %s; write it as [x, y] in m", json_type(x));
    vertex[d] = x->valuedouble;
  }
  return OK;
}

static enum status read_polygon(struct reader *reader, const cJSON *value, struct shape *s)
{
  int    n = cJSON_IsArray(value) ? cJSON_GetArraySize(value) : 0;
  double area = 0;
  if (n < 3) return reader_fail(reader, "a polygon needs at least three vertices; give a list of [x, y]");
  TRY(NEW(&s->vertices, n));
  s->dim = 2;
  for (const cJSON *vertex = value->child; vertex; vertex = vertex->next)
    TRY(read_vertex(reader, vertex, s->vertices[s->n++]));
  for (int i = 0, j = n - 1; i < n; j = i++)
    area += 0.5 * (s->vertices[j][0] * s->vertices[i][1] - s->vertices[i][0] * s->vertices[j][1]);
  if (fabs(area) < 1e-18) return reader_fail(reader, "the polygon has no area; move its vertices off one line");
  return OK;
}

static enum status read_parts(struct reader *reader, const cJSON *value, struct shape *s)
{
  int n = cJSON_IsArray(value) ? cJSON_GetArraySize(value) : 0;
  if (n < 1)
    return reader_fail(reader, "expected a list of shapes, found %s; give at least one",
                       n == 0 && cJSON_IsArray(value) ? "an empty one" : json_type(value));
  TRY(NEW(&s->parts, n));
  s->dim = reader->dim;
  for (const cJSON *part = value->child; part; part = part->next) {
    char name[16];
    snprintf(name, sizeof name, "%d", s->n);
    size_t mark = reader_enter(reader, name);
    s->n++;
    TRY(read_shape(reader, part, &s->parts[s->n - 1]));
    reader_leave(reader, mark);
  }
  return OK;
}

static enum status read_word(struct reader *reader, const struct shape_word *word, const cJSON *value, struct shape *s)
{
  s->kind = word->kind;
  if (word->params) return read_simple(reader, word, value, s);
  return word->kind == SHAPE_POLYGON ? read_polygon(reader, value, s) : read_parts(reader, value, s);
}

static enum status fail_word(const struct reader *reader, const char *wrong)
{
  struct names names = {0};
  names_add(&names, "everywhere");
  for (const struct shape_word *w = shape_words; w->name; w++) names_add(&names, w->name);
  return reader_unknown(reader, "shape", wrong, &names);
}

static enum status read_shape(struct reader *reader, const cJSON *value, struct shape *s)
{
  const cJSON *only = NULL;
  int          n = 0;
  *s = (struct shape){.kind = SHAPE_EVERYWHERE, .dim = reader->dim};
  if (cJSON_IsString(value) && strcmp(value->valuestring, "everywhere") == 0) return OK;
  if (cJSON_IsString(value)) return fail_word(reader, value->valuestring);
  for (const cJSON *member = cJSON_IsObject(value) ? value->child : NULL; member; member = member->next)
    if (!json_is_comment(member)) {
      only = member;
      n++;
    }
  if (n != 1)
    return reader_fail(
        reader, "expected a shape, found %s%s; write {\"box\": {\"min\": [0, 0], \"max\": [1, 1]}} or \"everywhere\"",
        n > 1 ? "several keys in " : "", json_type(value));
  for (const struct shape_word *w = shape_words; w->name; w++) {
    if (strcmp(w->name, only->string) != 0) continue;
    size_t mark = reader_enter(reader, only->string);
    TRY(read_word(reader, w, only, s));
    reader_leave(reader, mark);
    return OK;
  }
  return fail_word(reader, only->string);
}

static enum status read(struct reader *reader, const cJSON *value, void *at) { return read_shape(reader, value, at); }
static void        destroy(void *at) { shape_destroy(at); }

const struct value_kind value_shape = {"shape", read, destroy, "{\"$ref\": \"#/$defs/shape\"}"};
