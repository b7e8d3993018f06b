/* Tables over time: a column of a CSV file as a function of t; values over time and place. */
#include "run/table_read.h"

#include "core/memory.h"
#include "core/scene.h"
#include "run/files.h"
#include "run/scene_tables.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CSV_BYTES = 64 << 20, COLUMNS = 64, LINE = 8192 };

struct table_keys {
  char   file[LONGEST_PATH];
  char   column[NAME_LENGTH]; /* "": the second */
  double scale;
};

/* Where the reading of a file stands. */
struct csv {
  const struct reader *reader;
  char                 path[LONGEST_PATH];
  char                *text;
  const char          *at; /* next line */
  int                  row, n_columns;
  char                 line[LINE];
  char                *cell[COLUMNS];
};

/* ---- the keys ---- */

static enum status read_file(struct reader *reader, const cJSON *value, struct table_keys *keys)
{
  if (!cJSON_IsString(value))
    return reader_fail(reader, "expected the name of a file, found %s; write \"shaking.csv\"", json_type(value));
  if (strlen(value->valuestring) >= LONGEST_PATH)
    return reader_fail(reader, "more than %d characters; give a shorter path", LONGEST_PATH - 1);
  memcpy(keys->file, value->valuestring, strlen(value->valuestring) + 1);
  return OK;
}

static enum status check_keys(const struct reader *reader, const cJSON *value)
{
  struct names names = {.n = 3, .name = {"table", "column", "scale"}};
  if (!json_member(value, "table"))
    return reader_fail(reader, "an object stands for a table over time and has no \"table\"; write {\"table\": "
                               "\"shaking.csv\", \"column\": \"v_x\"}, a number or an expression");
  for (const cJSON *member = value->child; member; member = member->next) {
    bool known = json_is_comment(member);
    for (int i = 0; i < names.n; i++) known = known || strcmp(names.name[i], member->string) == 0;
    if (!known) return reader_unknown(reader, "key", member->string, &names);
  }
  return OK;
}

static enum status read_keys(struct reader *reader, const cJSON *value, struct table_keys *keys)
{
  static const struct param table[] = {{.name = "column",
                                        .type = PARAM_TEXT,
                                        .offset = offsetof(struct table_keys, column),
                                        .meaning = "name of a column"},
                                       {.name = "scale",
                                        .type = PARAM_NUMBER,
                                        .offset = offsetof(struct table_keys, scale),
                                        .min = -1e300,
                                        .max = 1e300,
                                        .meaning = "factor on what the table holds"},
                                       PARAM_END};
  size_t                    mark = reader_enter(reader, "table");
  *keys = (struct table_keys){.scale = 1};
  TRY(read_file(reader, json_member(value, "table"), keys));
  reader_leave(reader, mark);
  for (const struct param *p = table; p->name; p++) {
    if (!json_member(value, p->name)) continue;
    reader_enter(reader, p->name);
    TRY(params_read_value(reader, p, json_member(value, p->name), keys));
    reader_leave(reader, mark);
  }
  return OK;
}

/* relative to the folder of the scene: of the one that a scene.used.json was made from */
static enum status find_path(const struct reader *reader, const char *file, char path[LONGEST_PATH])
{
  const cJSON *origin = json_find(reader->root, "origin.file");
  const char  *scene = cJSON_IsString(origin) ? origin->valuestring : reader->file, *slash = strrchr(scene, '/');
  int          folder = slash && file[0] != '/' ? (int)(slash - scene) + 1 : 0;
  if (snprintf(path, LONGEST_PATH, "%.*s%s", folder, scene, file) < LONGEST_PATH) return OK;
  return reader_fail(reader, "the path of %.40s... is longer than %d characters; move the file", file,
                     LONGEST_PATH - 1);
}

/* ---- the file ---- */

static enum status fail_row(const struct csv *csv, const char *what)
{
  return reader_fail(csv->reader, "%s: row %d: %s", csv->path, csv->row, what);
}

/* without spaces around */
static char *trim(char *word)
{
  size_t n;
  word += strspn(word, " \t\r");
  for (n = strlen(word); n > 0 && strchr(" \t\r", word[n - 1]); n--) word[n - 1] = '\0';
  return word;
}

/* The next line that is neither empty nor a comment (#), cut into cells; false: the file ends. */
static enum status next_row(struct csv *csv, bool *found)
{
  *found = false;
  while (*csv->at && !*found) {
    size_t n = strcspn(csv->at, "\n");
    csv->row++;
    if (n >= LINE) return fail_row(csv, "it has more than 8191 characters; split the table");
    memcpy(csv->line, csv->at, n);
    csv->line[n] = '\0';
    csv->at += n + (csv->at[n] == '\n');
    char *line = trim(csv->line);
    if (*line == '\0' || *line == '#') continue;
    *found = true;
    csv->n_columns = 0;
    for (char *cell = line, *end; cell; cell = end) {
      end = strchr(cell, ',');
      if (end) *end++ = '\0';
      if (csv->n_columns == COLUMNS) return fail_row(csv, "it has more than 64 columns; remove some");
      csv->cell[csv->n_columns++] = trim(cell);
    }
  }
  return OK;
}

/* Index of a column by its name, with or without a unit in brackets: "v_x [m/s]". */
static enum status find_column(const struct csv *csv, const char *name, int *column)
{
  struct names names = {0};
  *column = 1;
  if (csv->n_columns < 2) return fail_row(csv, "one column is not a table over time; write t,v and a row per time");
  if (*name == '\0') return OK;
  for (int i = 1; i < csv->n_columns; i++) {
    const char *cell = csv->cell[i], *unit = strstr(cell, " [");
    size_t      n = unit ? (size_t)(unit - cell) : strlen(cell);
    names_add(&names, cell);
    *column = i;
    if (strcmp(cell, name) == 0 || (strlen(name) == n && strncmp(cell, name, n) == 0)) return OK;
  }
  return reader_unknown(csv->reader, "column", name, &names);
}

static enum status read_number(const struct csv *csv, int column, double *number)
{
  char what[200], *end;
  if (column >= csv->n_columns) {
    snprintf(what, sizeof what, "it has %d columns and the table needs %d; complete it", csv->n_columns, column + 1);
    return fail_row(csv, what);
  }
  *number = strtod(csv->cell[column], &end);
  if (end != csv->cell[column] && *end == '\0' && isfinite(*number)) return OK;
  snprintf(what, sizeof what, "\"%.60s\" in column %d is not a number; correct it", csv->cell[column], column + 1);
  return fail_row(csv, what);
}

static enum status read_rows(struct csv *csv, int column, double scale, double *t, double *v, int *n)
{
  bool found;
  for (*n = 0;; (*n)++) {
    TRY(next_row(csv, &found));
    if (!found) break;
    TRY(read_number(csv, 0, &t[*n]));
    TRY(read_number(csv, column, &v[*n]));
    v[*n] *= scale;
    if (*n > 0 && !(t[*n] > t[*n - 1])) return fail_row(csv, "its time is not after that of the row before; sort them");
  }
  return *n > 0 ? OK : reader_fail(csv->reader, "%s: it has no row of numbers; give at least one", csv->path);
}

static long count_lines(const char *text)
{
  long n = 1;
  for (; *text; text++) n += *text == '\n';
  return n;
}

static enum status read_csv(struct csv *csv, const struct table_keys *keys, double **t, double **v, struct function *f)
{
  bool found;
  int  column, n;
  csv->at = csv->text;
  TRY(next_row(csv, &found));
  if (!found)
    return reader_fail(csv->reader, "%s: the file is empty; give a row of names and rows of numbers", csv->path);
  TRY(find_column(csv, keys->column, &column));
  TRY(NEW(t, count_lines(csv->text)));
  TRY(NEW(v, count_lines(csv->text)));
  TRY(read_rows(csv, column, keys->scale, *t, *v, &n));
  return function_table(n, *t, *v, f);
}

enum status table_read(struct reader *reader, const cJSON *value, struct function *f)
{
  struct table_keys keys;
  struct csv        csv = {.reader = reader};
  double           *t = NULL, *v = NULL;
  size_t            size;
  *f = (struct function){0, NULL};
  TRY(check_keys(reader, value));
  TRY(read_keys(reader, value, &keys));
  TRY(find_path(reader, keys.file, csv.path));
  if (files_read(csv.path, CSV_BYTES, &csv.text, &size) != OK) return reader_wrap(reader);
  enum status status = read_csv(&csv, &keys, &t, &v, f);
  memory_free(&t);
  memory_free(&v);
  memory_free(&csv.text);
  return status;
}

/* ---- tables over time and place ---- */

static enum status read_places(struct csv *csv, struct profile *p)
{
  bool found;
  csv->at = csv->text;
  TRY(NEW(&p->t, count_lines(csv->text)));
  TRY(NEW(&p->x, count_lines(csv->text)));
  TRY(NEW(&p->v, count_lines(csv->text)));
  TRY(next_row(csv, &found)); /* names */
  for (p->n = 0;; p->n++) {
    TRY(next_row(csv, &found));
    if (!found) break;
    TRY(read_number(csv, 0, &p->t[p->n]));
    TRY(read_number(csv, 1, &p->x[p->n]));
    TRY(read_number(csv, 2, &p->v[p->n]));
    if (p->n > 0 && p->t[p->n] < p->t[p->n - 1])
      return fail_row(csv, "its time is before that of the row before; sort them");
  }
  return p->n > 0 ? OK : reader_fail(csv->reader, "%s: it has no row of numbers; give at least one", csv->path);
}

static enum status read_profile(struct reader *reader, const cJSON *value, void *at)
{
  struct csv        csv = {.reader = reader};
  struct table_keys keys;
  size_t            size;
  if (cJSON_IsNull(value)) return OK;
  TRY(read_file(reader, value, &keys));
  TRY(find_path(reader, keys.file, csv.path));
  if (files_read(csv.path, CSV_BYTES, &csv.text, &size) != OK) return reader_wrap(reader);
  enum status status = read_places(&csv, at);
  memory_free(&csv.text);
  return status;
}

static void destroy_profile(void *at)
{
  struct profile *p = at;
  memory_free(&p->t);
  memory_free(&p->x);
  memory_free(&p->v);
}

const struct value_kind value_profile = {"file", read_profile, destroy_profile, "{\"type\": [\"string\", \"null\"]}"};
