/* Tables of parameters against JSON objects. */
#include "run/params.h"

#include "core/memory.h"
#include "run/table_read.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MESSAGE = 1024, LINKS = 4 };

size_t reader_enter(struct reader *reader, const char *name)
{
  size_t mark = strlen(reader->path);
  snprintf(reader->path + mark, sizeof reader->path - mark, "%s%s", mark ? "." : "", name);
  return mark;
}

void reader_leave(struct reader *reader, size_t mark) { reader->path[mark] = '\0'; }

enum status reader_fail(const struct reader *reader, const char *format, ...)
{
  char    text[MESSAGE];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  return FAIL(ERR_INPUT, "%s: %s%s%s", reader->file, reader->path, *reader->path ? ": " : "", text);
}

enum status reader_wrap(const struct reader *reader)
{
  char text[MESSAGE];
  snprintf(text, sizeof text, "%s", status_message());
  return reader_fail(reader, "%s", text);
}

void params_range(const struct param *p, char *text, size_t size)
{
  char unit[48] = "";
  if (p->unit && *p->unit && strcmp(p->unit, "-") != 0) snprintf(unit, sizeof unit, " %s", p->unit);
  snprintf(text, size, "in [%.10g, %.10g]%s", p->min, p->max, unit);
}

static enum status fail_type(const struct reader *reader, const struct param *p, const cJSON *value,
                             const char *expected)
{
  char range[128] = "";
  bool number = p->type == PARAM_NUMBER || p->type == PARAM_INTEGER || p->type == PARAM_VECTOR;
  if (number) params_range(p, range, sizeof range);
  if (cJSON_IsString(value))
    return reader_fail(reader, "expected %s%s%s, found the text \"%.60s\"; it is the %s", expected, number ? " " : "",
                       range, value->valuestring, p->meaning);
  return reader_fail(reader, "expected %s%s%s, found %s; it is the %s", expected, number ? " " : "", range,
                     json_type(value), p->meaning);
}

/** Follows "=key.path" to the value that stands there. */
static enum status follow_links(const struct reader *reader, const cJSON **value)
{
  for (int i = 0; i < LINKS && cJSON_IsString(*value) && (*value)->valuestring[0] == '='; i++) {
    const char  *path = (*value)->valuestring + 1;
    const cJSON *target = json_find(reader->root, path);
    if (!target)
      return reader_fail(reader, "\"=%.100s\" points at nothing; give the path of a number, such as =grid.h", path);
    *value = target;
  }
  return OK;
}

static bool means_infinity(const struct param *p, const cJSON *value)
{
  if (!isinf(p->max)) return false;
  if (cJSON_IsString(value)) return strcmp(value->valuestring, "infinite") == 0;
  return cJSON_IsNull(value) && p->fallback && strcmp(p->fallback, "null") == 0;
}

static enum status check_range(const struct reader *reader, const struct param *p, double value)
{
  char range[128];
  if (value >= p->min && value <= p->max) return OK;
  params_range(p, range, sizeof range);
  return reader_fail(reader, "%.10g is outside [%.10g, %.10g]; choose the %s %s", value, p->min, p->max, p->meaning,
                     range);
}

static enum status read_number(struct reader *reader, const struct param *p, const cJSON *value, double *number)
{
  if (reader->links) TRY(follow_links(reader, &value));
  if (means_infinity(p, value)) {
    *number = INFINITY;
    return OK;
  }
  if (!cJSON_IsNumber(value)) return fail_type(reader, p, value, "a number");
  *number = value->valuedouble;
  return check_range(reader, p, *number);
}

static enum status read_integer(struct reader *reader, const struct param *p, const cJSON *value, int *number)
{
  double given = 0;
  if (!cJSON_IsNumber(value)) return fail_type(reader, p, value, "a whole number");
  given = value->valuedouble;
  if (given != floor(given)) return reader_fail(reader, "%.10g is not a whole number; round it", given);
  TRY(check_range(reader, p, given));
  if (fabs(given) > INT_MAX) return reader_fail(reader, "%.10g is too large; choose at most %d", given, INT_MAX);
  *number = (int)given;
  return OK;
}

static enum status read_text(struct reader *reader, const struct param *p, const cJSON *value, char *text)
{
  if (!cJSON_IsString(value)) return fail_type(reader, p, value, "a text");
  if (strlen(value->valuestring) >= NAME_LENGTH)
    return reader_fail(reader, "\"%.20s...\" has more than %d characters; shorten it", value->valuestring,
                       NAME_LENGTH - 1);
  memcpy(text, value->valuestring, strlen(value->valuestring) + 1);
  return OK;
}

static enum status read_choice(struct reader *reader, const struct param *p, const cJSON *value, int *index)
{
  struct names names = {0};
  char         buffer[512];
  names_add_words(&names, p->words, buffer, sizeof buffer);
  if (!cJSON_IsString(value)) return fail_type(reader, p, value, "a word");
  for (int i = 0; i < names.n; i++)
    if (strcmp(names.name[i], value->valuestring) == 0) {
      *index = i;
      return OK;
    }
  return reader_unknown(reader, "word", value->valuestring, &names);
}

static enum status check_axes(struct reader *reader, const struct param *p, const cJSON *value, const char *expected)
{
  if (!cJSON_IsArray(value)) return fail_type(reader, p, value, expected);
  if (cJSON_GetArraySize(value) != reader->dim)
    return reader_fail(reader, "%d entries in a grid of %d dimensions; give %d", cJSON_GetArraySize(value), reader->dim,
                       reader->dim);
  return OK;
}

static enum status read_axis(struct reader *reader, const struct param *p, const cJSON *value, double *x)
{
  if (cJSON_IsNull(value) && isinf(p->max)) {
    *x = INFINITY;
    return OK;
  }
  if (!cJSON_IsNumber(value)) return fail_type(reader, p, value, "a number");
  *x = value->valuedouble;
  return check_range(reader, p, *x);
}

static enum status read_vector(struct reader *reader, const struct param *p, const cJSON *value, double x[3])
{
  int d = 0;
  TRY(check_axes(reader, p, value, "a list of numbers"));
  for (const cJSON *axis = value->child; axis; axis = axis->next, d++) {
    char name[16];
    snprintf(name, sizeof name, "%d", d);
    size_t mark = reader_enter(reader, name);
    TRY(read_axis(reader, p, axis, &x[d]));
    reader_leave(reader, mark);
  }
  return OK;
}

enum status params_read_function(struct reader *reader, const cJSON *value, struct function *f)
{
  *f = (struct function){0, NULL};
  if (cJSON_IsNumber(value)) {
    f->constant = value->valuedouble;
    return OK;
  }
  if (cJSON_IsObject(value)) return table_read(reader, value, f);
  if (!cJSON_IsString(value))
    return reader_fail(reader,
                       "expected a number or an expression of x, y, z, t, found %s; write 9.81 or \"9.81*min(1, t)\"",
                       json_type(value));
  enum status status = function_parse(value->valuestring, f);
  return status == ERR_INPUT ? reader_wrap(reader) : status;
}

static enum status read_function3(struct reader *reader, const struct param *p, const cJSON *value,
                                  struct function f[3])
{
  int d = 0;
  TRY(check_axes(reader, p, value, "a list of numbers or expressions"));
  for (const cJSON *axis = value->child; axis; axis = axis->next, d++) {
    char name[16];
    snprintf(name, sizeof name, "%d", d);
    size_t mark = reader_enter(reader, name);
    TRY(params_read_function(reader, axis, &f[d]));
    reader_leave(reader, mark);
  }
  return OK;
}

enum status params_read_value(struct reader *reader, const struct param *p, const cJSON *value, void *base)
{
  void *at = (char *)base + p->offset;
  switch (p->type) {
  case PARAM_NUMBER:
    return read_number(reader, p, value, at);
  case PARAM_INTEGER:
    return read_integer(reader, p, value, at);
  case PARAM_CHOICE:
    return read_choice(reader, p, value, at);
  case PARAM_TEXT:
    return read_text(reader, p, value, at);
  case PARAM_VECTOR:
    return read_vector(reader, p, value, at);
  case PARAM_FUNCTION:
    return params_read_function(reader, value, at);
  case PARAM_FUNCTION3:
    return read_function3(reader, p, value, at);
  default:
    break;
  }
  if (!cJSON_IsBool(value)) return fail_type(reader, p, value, "true or false");
  *(bool *)at = cJSON_IsTrue(value);
  return OK;
}

enum status params_default(const char *fallback, enum param_type type, int dim, cJSON **json)
{
  bool per_axis = type == PARAM_VECTOR || type == PARAM_FUNCTION3;
  TRY(json_from_word(fallback, fallback, json));
  if (!per_axis || cJSON_IsArray(*json)) return OK;
  cJSON      *list = cJSON_CreateArray(), *one = *json;
  enum status status = list ? OK : FAIL(ERR_ENVIRONMENT, "no memory for the default %s", fallback);
  for (int d = 0; d < dim && status == OK; d++) status = json_add(list, NULL, cJSON_Duplicate(one, true));
  cJSON_Delete(one);
  *json = list;
  return status;
}

enum status params_complete(struct reader *reader, const struct param *table, cJSON *object)
{
  for (const struct param *p = table; p && p->name; p++) {
    cJSON *value = NULL;
    if (json_member(object, p->name) || !p->fallback) continue;
    TRY(params_default(p->fallback, p->type, reader->dim, &value));
    TRY(json_add(object, p->name, value));
  }
  return OK;
}

static enum status fail_missing(const struct reader *reader, const struct param *p)
{
  char range[128] = "";
  if (p->type == PARAM_NUMBER || p->type == PARAM_INTEGER) params_range(p, range, sizeof range);
  return reader_fail(reader, "is missing; give the %s%s%s", p->meaning, *range ? ", " : "", range);
}

enum status params_read(struct reader *reader, const struct param *table, const cJSON *object, void *base)
{
  for (const struct param *p = table; p && p->name; p++) {
    const cJSON *value = json_member(object, p->name);
    size_t       mark = reader_enter(reader, p->name);
    if (!value) return fail_missing(reader, p);
    TRY(params_read_value(reader, p, value, base));
    reader_leave(reader, mark);
  }
  return OK;
}

void params_destroy(const struct param *table, void *base)
{
  for (const struct param *p = table; p && p->name; p++) {
    struct function *f = (struct function *)((char *)base + p->offset);
    int              n = p->type == PARAM_FUNCTION ? 1 : p->type == PARAM_FUNCTION3 ? 3 : 0;
    for (int i = 0; i < n; i++) function_destroy(&f[i]);
  }
}
