/* `mpmice info FILE`: what is in a file of an output folder. */
#include "run/info.h"

#include "core/memory.h"
#include "run/files.h"
#include "run/h5.h"
#include "run/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { INFO_BYTES = 1 << 30, MAX_COLUMNS = 1024, LISTED = 4 };

static bool ends_with(const char *path, const char *end)
{
  size_t n = strlen(path), m = strlen(end);
  return n >= m && strcmp(path + n - m, end) == 0;
}

static enum status info_arrays(const char *path, FILE *out)
{
  struct h5 h;
  TRY(h5_open(path, &h));
  enum status s = h5_list(&h, out);
  h5_close(&h);
  return s;
}

/* ---- tables ---- */

/* A column of gauges.csv. */
struct column {
  const char *name; /* not ended by 0 */
  int         length;
  double      first, last, least, most;
};

static int split_header(const char *text, struct column *column)
{
  int n = 0;
  for (const char *at = text; n < MAX_COLUMNS; n++) {
    size_t length = strcspn(at, ",\n");
    column[n] = (struct column){.name = at, .length = (int)length, .least = INFINITY, .most = -INFINITY};
    at += length;
    if (*at != ',') return n + 1;
    at++;
  }
  return n;
}

/* The row at `at`; NULL: it is not n numbers and a line's end. */
static const char *add_row(const char *at, bool first, int n, struct column *column)
{
  for (int c = 0; c < n; c++) {
    char  *end;
    double v = strtod(at, &end);
    if (end == at || *end != (c + 1 < n ? ',' : '\n')) return NULL;
    if (first) column[c].first = v;
    column[c].last = v;
    column[c].least = fmin(column[c].least, v);
    column[c].most = fmax(column[c].most, v);
    at = end + 1;
  }
  return at;
}

static enum status info_rows(const char *path, const char *text, struct column *column, FILE *out)
{
  int         n = split_header(text, column);
  long        rows = 0;
  const char *at = strchr(text, '\n');
  for (at = at ? at + 1 : NULL; at && *at; rows++) at = add_row(at, rows == 0, n, column);
  if (!at) return FAIL(ERR_INPUT, "%s: line %ld is not %d numbers; the file is damaged or no table", path, rows + 1, n);
  fprintf(out, "%ld rows\n%-32s %14s %14s %14s %14s\n", rows, "column", "first", "last", "least", "most");
  for (int c = 0; c < n && rows > 0; c++)
    fprintf(out, "%-32.*s %14.6g %14.6g %14.6g %14.6g\n", column[c].length, column[c].name, column[c].first,
            column[c].last, column[c].least, column[c].most);
  return OK;
}

static enum status info_table(const char *path, FILE *out)
{
  char          *text;
  size_t         n;
  struct column *column = NULL;
  TRY(files_read(path, INFO_BYTES, &text, &n));
  enum status s = NEW(&column, MAX_COLUMNS);
  if (s == OK) s = info_rows(path, text, column, out);
  memory_free(&column);
  memory_free(&text);
  return s;
}

/* ---- trees ---- */

static void print_leaf(const cJSON *item, FILE *out)
{
  if (cJSON_IsString(item))
    fprintf(out, "%s\n", item->valuestring);
  else if (cJSON_IsNumber(item))
    fprintf(out, "%.10g\n", item->valuedouble);
  else if (cJSON_IsObject(item) || cJSON_IsArray(item))
    fprintf(out, "none\n");
  else
    fprintf(out, "%s\n", cJSON_IsNull(item) ? "null" : cJSON_IsTrue(item) ? "true" : "false");
}

/* "key: value", a level of indentation per object; of long lists the first and the last entries. */
static void print_tree(const cJSON *object, int depth, FILE *out)
{
  const int n = cJSON_GetArraySize(object);
  int       i = 0;
  for (const cJSON *item = object->child; item; item = item->next, i++) {
    if (!item->string && i == LISTED && n > 2 * LISTED) fprintf(out, "%*s... %d more\n", 2 * depth, "", n - 2 * LISTED);
    if (!item->string && i >= LISTED && i < n - LISTED) continue;
    if (item->string)
      fprintf(out, "%*s%s: ", 2 * depth, "", item->string);
    else
      fprintf(out, "%*s- ", 2 * depth, "");
    if (!item->child) {
      print_leaf(item, out);
      continue;
    }
    fprintf(out, "\n");
    print_tree(item, depth + 1, out);
  }
}

static enum status info_tree(const char *path, FILE *out)
{
  cJSON *json;
  TRY(json_load(path, &json));
  print_tree(json, 0, out);
  cJSON_Delete(json);
  return OK;
}

enum status info_print(const char *path, FILE *out)
{
  if (ends_with(path, ".hdf") || ends_with(path, ".h5")) return info_arrays(path, out);
  if (ends_with(path, ".csv")) return info_table(path, out);
  if (ends_with(path, ".json") || ends_with(path, ".series")) return info_tree(path, out);
  return FAIL(ERR_INPUT, "%s: info knows .hdf, .h5, .csv, .json and .series; give one file of an output folder", path);
}
