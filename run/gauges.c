/* Gauges: numbers sampled over time, in gauges.csv and kept for the metrics. */
#include "run/gauges.h"

#include "core/memory.h"
#include "run/files.h"
#include "run/gauge_read.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { DEFAULT_SAMPLES = 1000, SPARE = 16, CSV_LIMIT = 1 << 30 };

struct gauges {
  char                 path[LONGEST_PATH];
  FILE                *file; /* NULL until the first sample */
  int                  n_columns;
  struct gauge_reader *readers; /* [n_columns] */
  int                 *minus;   /* [n_columns] column that is taken off; -1: none */
  double              *now;     /* [n_columns] before anything is taken off */
  long                 n, capacity;
  double              *t, *v; /* [capacity] s, [n_columns][capacity] */
};

double gauges_interval(const struct scene *scene)
{
  return scene->output.gauge_interval > 0 ? scene->output.gauge_interval : scene->time_end / DEFAULT_SAMPLES;
}

/* ---- creation ---- */

static int find_column(const struct gauges *g, const char *name)
{
  for (int c = 0; c < g->n_columns; c++)
    if (strcmp(g->readers[c].name, name) == 0) return c;
  return -1;
}

static enum status find_minus(const struct scene *scene, struct gauges *g)
{
  TRY(NEW(&g->minus, g->n_columns));
  TRY(NEW(&g->now, g->n_columns));
  for (int c = 0; c < g->n_columns; c++) g->minus[c] = -1;
  for (int i = 0; i < scene->n_gauges; i++) {
    const struct gauge *gauge = &scene->gauges[i];
    if (*gauge->minus) g->minus[find_column(g, gauge->name)] = find_column(g, gauge->minus);
  }
  return OK;
}

static enum status create_readers(const struct sim *sim, const struct marker_finder *markers, struct gauges *g)
{
  int n = 0;
  for (int i = 0; i < sim->scene->n_gauges; i++) n += gauge_columns(&sim->scene->gauges[i]);
  TRY(NEW(&g->readers, n));
  for (int i = 0; i < sim->scene->n_gauges; i++)
    for (int s = 0; s < gauge_columns(&sim->scene->gauges[i]); s++)
      TRY(gauge_reader_create(sim, &sim->scene->gauges[i], s, markers, &g->readers[g->n_columns++]));
  return find_minus(sim->scene, g);
}

static enum status create_in(const struct sim *sim, const char *folder, const struct marker_finder *markers,
                             struct gauges *g)
{
  const struct scene *scene = sim->scene;
  TRY(files_path(folder, "gauges.csv", g->path));
  TRY(create_readers(sim, markers, g));
  g->capacity = (long)ceil(scene->time_end / gauges_interval(scene)) + SPARE;
  TRY(NEW(&g->t, g->capacity));
  return NEW(&g->v, g->n_columns * g->capacity);
}

enum status gauges_create(const struct sim *sim, const char *folder,
                          void (*marker_range)(const struct sim *, const char *name, long *first, long *end),
                          struct gauges **gauges)
{
  const struct marker_finder markers = {marker_range};
  TRY(NEW(gauges, 1));
  enum status s = create_in(sim, folder, &markers, *gauges);
  if (s != OK) gauges_destroy(gauges);
  return s;
}

void gauges_destroy(struct gauges **gauges)
{
  struct gauges *g = *gauges;
  if (!g) return;
  if (g->file) fclose(g->file);
  for (int c = 0; c < g->n_columns; c++) gauge_reader_destroy(&g->readers[c]);
  memory_free(&g->readers);
  memory_free(&g->minus);
  memory_free(&g->now);
  memory_free(&g->t);
  memory_free(&g->v);
  memory_free(gauges);
}

/* ---- the table in memory ---- */

static enum status enlarge(struct gauges *g)
{
  const long capacity = 2 * g->capacity;
  double    *t, *v;
  TRY(NEW(&t, capacity));
  TRY(NEW(&v, g->n_columns * capacity));
  memcpy(t, g->t, (size_t)g->n * sizeof *t);
  for (int c = 0; c < g->n_columns; c++) memcpy(&v[c * capacity], &g->v[c * g->capacity], (size_t)g->n * sizeof *v);
  memory_free(&g->t);
  memory_free(&g->v);
  g->t = t;
  g->v = v;
  g->capacity = capacity;
  return OK;
}

enum status gauges_series(const struct gauges *gauges, const char *name, long *n, const double **t, const double **v)
{
  int c = find_column(gauges, name);
  if (c < 0)
    return FAIL(ERR_INPUT, "gauge \"%s\": there is none of that name; samples of a line are name.0, ...", name);
  *n = gauges->n;
  *t = gauges->t;
  *v = &gauges->v[c * gauges->capacity];
  return OK;
}

const char *gauges_unit(const struct gauges *gauges, const char *name)
{
  int c = find_column(gauges, name);
  return c < 0 ? "-" : gauges->readers[c].unit;
}

/* ---- the file ---- */

static enum status failed(const struct gauges *g)
{
  return FAIL(ERR_ENVIRONMENT, "%s: cannot be written: %s", g->path, strerror(errno));
}

/* As few digits as bring the same number back. */
static void print_number(FILE *file, double v)
{
  char text[32];
  snprintf(text, sizeof text, "%.15g", v);
  if (strtod(text, NULL) != v) snprintf(text, sizeof text, "%.17g", v);
  fputs(text, file);
}

static void print_header(const struct gauges *g, FILE *file)
{
  fprintf(file, "t [s]");
  for (int c = 0; c < g->n_columns; c++) fprintf(file, ",%s [%s]", g->readers[c].name, g->readers[c].unit);
  fprintf(file, "\n");
}

static void print_row(const struct gauges *g, long row, FILE *file)
{
  print_number(file, g->t[row]);
  for (int c = 0; c < g->n_columns; c++) {
    fputc(',', file);
    print_number(file, g->v[c * g->capacity + row]);
  }
  fputc('\n', file);
}

static enum status start_file(struct gauges *g)
{
  g->file = fopen(g->path, "w");
  if (!g->file) return failed(g);
  print_header(g, g->file);
  return OK;
}

enum status gauges_sample(struct gauges *gauges, const struct sim *sim)
{
  struct gauges *g = gauges;
  if (g->n > 0 && g->t[g->n - 1] == sim->t) return OK;
  if (g->n == g->capacity) TRY(enlarge(g));
  if (!g->file) TRY(start_file(g));
  g->t[g->n] = sim->t;
  for (int c = 0; c < g->n_columns; c++) g->now[c] = gauge_reader_read(&g->readers[c], sim);
  for (int c = 0; c < g->n_columns; c++)
    g->v[c * g->capacity + g->n] = g->now[c] - (g->minus[c] >= 0 ? g->now[g->minus[c]] : 0);
  print_row(g, g->n++, g->file);
  return fflush(g->file) == 0 ? OK : failed(g);
}

enum status gauges_flush(struct gauges *gauges)
{
  if (!gauges->file) TRY(start_file(gauges));
  if (fflush(gauges->file) != 0 || fsync(fileno(gauges->file)) != 0) return failed(gauges);
  return OK;
}

/* ---- resume ---- */

static enum status parse_row(struct gauges *g, const char *line, double t_last, bool *later)
{
  char  *end;
  double t = strtod(line, &end);
  *later = t > t_last;
  if (*later) return OK;
  if (g->n == g->capacity) TRY(enlarge(g));
  g->t[g->n] = t;
  for (int c = 0; c < g->n_columns && *end == ','; c++) g->v[c * g->capacity + g->n] = strtod(end + 1, &end);
  if (*end != '\n') return FAIL(ERR_INPUT, "%s: row %ld is damaged; run the scene again", g->path, g->n + 2);
  g->n++;
  return OK;
}

static bool has_header(const struct gauges *g, const char *text)
{
  char   wanted[NAME_LENGTH * 3];
  size_t n = strlen("t [s]");
  if (strncmp(text, "t [s]", n) != 0) return false;
  for (int c = 0; c < g->n_columns; c++) {
    int m = snprintf(wanted, sizeof wanted, ",%s [%s]", g->readers[c].name, g->readers[c].unit);
    if (strncmp(text + n, wanted, (size_t)m) != 0) return false;
    n += (size_t)m;
  }
  return text[n] == '\n';
}

static enum status parse(struct gauges *g, const char *text, double t_last)
{
  bool later = false;
  if (!has_header(g, text)) return FAIL(ERR_INPUT, "%s: its columns are not the gauges of the scene", g->path);
  for (const char *line = strchr(text, '\n') + 1; *line && !later; line = strchr(line, '\n') + 1) {
    if (!strchr(line, '\n')) break; /* cut off while it was written, so later than the checkpoint */
    TRY(parse_row(g, line, t_last, &later));
  }
  return OK;
}

/* The kept rows alone, then open to go on. */
static enum status rewrite(struct gauges *g)
{
  char made[LONGEST_PATH + 4];
  snprintf(made, sizeof made, "%s.tmp", g->path);
  FILE *file = fopen(made, "w");
  if (!file) return failed(g);
  print_header(g, file);
  for (long row = 0; row < g->n; row++) print_row(g, row, file);
  bool bad = ferror(file) != 0;
  if (fclose(file) != 0 || bad) return failed(g);
  TRY(files_commit(g->path));
  g->file = fopen(g->path, "a");
  return g->file ? OK : failed(g);
}

enum status gauges_resume(struct gauges *gauges, double t)
{
  char  *text;
  size_t n;
  TRY(files_read(gauges->path, CSV_LIMIT, &text, &n));
  enum status s = parse(gauges, text, t);
  memory_free(&text);
  return s == OK ? rewrite(gauges) : s;
}
