/* Snapshots of the fields: fields.<set>.<NNNNN>.hdf (VTKHDF UnstructuredGrid 1.0) and fields.<set>.hdf.series. */
#include "run/output.h"

#include "core/memory.h"
#include "core/parallel.h"
#include "run/fields.h"
#include "run/h5.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { VTK_VERTEX = 1, VTK_QUAD = 9, VTK_HEXAHEDRON = 12 };
enum { PADDED = 9, DEFAULT_SNAPSHOTS = 20 };

/* What VTK wants to know of a set besides its data; of points every entry but x is the same count upwards. */
struct mesh {
  long           n_points, n_cells, n_corners; /* corners of all cells */
  double        *x;                            /* [n_points][3] m */
  long          *connectivity, *offsets;       /* [n_corners], [n_cells + 1] */
  unsigned char *types;                        /* [n_cells] */
};

struct output_writer {
  char        folder[LONGEST_PATH];
  long        count, capacity;
  double     *times;   /* [capacity] s, of the snapshots written */
  double     *values;  /* [largest set][PADDED], one field made ready */
  struct mesh mesh[3]; /* cells, solid, water; n_cells 0: no such set */
};

static const enum where written[3] = {AT_CELL, AT_SOLID, AT_WATER};

double output_interval(const struct scene *scene)
{
  return scene->output.interval > 0 ? scene->output.interval : scene->time_end / DEFAULT_SNAPSHOTS;
}

/* ---- the sets as VTK sees them ---- */

static enum status mesh_create(long n_points, long n_cells, long n_corners, struct mesh *m)
{
  *m = (struct mesh){.n_points = n_points, .n_cells = n_cells, .n_corners = n_corners};
  TRY(NEW(&m->x, 3 * n_points));
  TRY(NEW(&m->connectivity, n_corners));
  TRY(NEW(&m->offsets, n_cells + 1));
  return NEW(&m->types, n_cells);
}

static void mesh_destroy(struct mesh *m)
{
  memory_free(&m->x);
  memory_free(&m->connectivity);
  memory_free(&m->offsets);
  memory_free(&m->types);
}

static enum status mesh_of_points(const struct points *p, struct mesh *m)
{
  if (!p) return OK;
  TRY(mesh_create(p->n, p->n, p->n, m));
  for (long i = 0; i < p->n; i++) {
    m->connectivity[i] = m->offsets[i] = i;
    m->types[i] = VTK_VERTEX;
  }
  m->offsets[p->n] = p->n;
  return OK;
}

static void mesh_nodes(const struct grid *g, const long n[3], struct mesh *m)
{
  for (long i = 0; i < m->n_points; i++) {
    const long at[3] = {i % n[0], i / n[0] % n[1], i / (n[0] * n[1])};
    for (int d = 0; d < 3; d++) m->x[3 * i + d] = d < g->dim ? g->min[d] + g->h * (double)at[d] : 0;
  }
}

/* Corners of a cell in VTK's order: round the lower side, then round the upper one. */
static void mesh_corners(const long n[3], const long cell[3], int n_corners, long *corner)
{
  static const int round[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                  {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (int i = 0; i < n_corners; i++)
    corner[i] = cell[0] + round[i][0] + n[0] * (cell[1] + round[i][1] + n[1] * (cell[2] + round[i][2]));
}

/* Owned cells as quads or hexahedra, first axis fastest. */
static enum status mesh_of_cells(const struct grid *g, struct mesh *m)
{
  const long n[3] = {g->n[0] + 1, g->n[1] + 1, g->dim == 3 ? g->n[2] + 1 : 1};
  const int  corners = g->dim == 3 ? 8 : 4;
  const long n_cells = (long)g->n[0] * g->n[1] * g->n[2];
  TRY(mesh_create(n[0] * n[1] * n[2], n_cells, corners * n_cells, m));
  mesh_nodes(g, n, m);
  for (long c = 0; c < n_cells; c++) {
    const long cell[3] = {c % g->n[0], c / g->n[0] % g->n[1], c / ((long)g->n[0] * g->n[1])};
    mesh_corners(n, cell, corners, &m->connectivity[corners * c]);
    m->offsets[c + 1] = corners * (c + 1);
    m->types[c] = g->dim == 3 ? VTK_HEXAHEDRON : VTK_QUAD;
  }
  return OK;
}

/* ---- values, made ready ---- */

static int padded_components(const struct field_view *v)
{
  const int components = v->field->components;
  return components == VECTOR || components == FLUID_VECTORS ? 3 : components == MATRIX ? 9 : v->components;
}

/* One entry with the missing components of 2D as zeros. */
static void pad(const struct field_view *v, int dim, long entry, double *padded)
{
  const double *own = &v->data[entry * v->components];
  const int     n = padded_components(v);
  if (n == v->components) {
    memcpy(padded, own, (size_t)n * sizeof *own);
    return;
  }
  memset(padded, 0, (size_t)n * sizeof *own);
  for (int i = 0; i < v->components; i++) padded[i / dim * 3 + i % dim] = own[i];
}

static void make_ready(const struct grid *g, const struct field_view *v, double *values)
{
  const int        n = padded_components(v);
  const struct box cells = grid_cells(g);
  if (v->field->at != AT_CELL) {
    for (long p = 0; p < v->n; p++) pad(v, g->dim, p, &values[p * n]);
    return;
  }
  FOR_BOX_SERIAL(g, cells, c)
  {
    pad(v, g->dim, c, values);
    values += n;
  }
}

/* Most doubles any written field of the sets needs. */
static long largest_field(const struct sim *sim)
{
  struct field_view v;
  long              most = 0;
  for (int cursor = 0; fields_next(sim, &cursor, &v);) {
    long n = v.n * (v.components > PADDED ? v.components : PADDED);
    if (n > most) most = n;
  }
  return most;
}

/* ---- creation ---- */

/* A run without values at cells writes no cells. */
static bool writes_cells(const struct sim *sim)
{
  struct field_view v;
  for (int cursor = 0; fields_next(sim, &cursor, &v);)
    if (v.field->at == AT_CELL && v.field->output) return true;
  return false;
}

static enum status create_in(const struct sim *sim, const char *folder, struct output_writer *o)
{
  const struct scene *scene = sim->scene;
  snprintf(o->folder, sizeof o->folder, "%s", folder);
  o->capacity = (long)ceil(scene->time_end / output_interval(scene)) + scene->output.n_times + 4;
  TRY(NEW(&o->times, o->capacity));
  TRY(NEW(&o->values, largest_field(sim)));
  if (writes_cells(sim)) TRY(mesh_of_cells(&sim->grid, &o->mesh[0]));
  TRY(mesh_of_points(sim->points[SET_SOLID], &o->mesh[1]));
  return mesh_of_points(sim->points[SET_WATER], &o->mesh[2]);
}

enum status output_create(const struct sim *sim, const char *folder, struct output_writer **output)
{
  TRY(NEW(output, 1));
  enum status s = create_in(sim, folder, *output);
  if (s != OK) output_destroy(output);
  return s;
}

void output_destroy(struct output_writer **output)
{
  struct output_writer *o = *output;
  if (!o) return;
  for (int i = 0; i < 3; i++) mesh_destroy(&o->mesh[i]);
  memory_free(&o->times);
  memory_free(&o->values);
  memory_free(output);
}

long output_count(const struct output_writer *output) { return output->count; }

/* ---- one snapshot ---- */

static enum status snapshot_path(const struct output_writer *o, enum where at, long number, char path[LONGEST_PATH])
{
  char name[64];
  snprintf(name, sizeof name, "fields.%s.%05ld.hdf", fields_set(at), number);
  return files_path(o->folder, name, path);
}

static enum status write_header(struct h5 *h, const struct sim *sim)
{
  static const long version[2] = {1, 0};
  TRY(h5_group(h, "VTKHDF"));
  TRY(h5_set(h, "VTKHDF", "Version", H5_LONG, 2, version));
  TRY(h5_set_text(h, "VTKHDF", "Type", "UnstructuredGrid"));
  TRY(h5_group(h, "mpmice"));
  TRY(h5_set_text(h, "mpmice", "scene", sim->scene->name));
  TRY(h5_set_text(h, "mpmice", "title", sim->scene->title));
  TRY(h5_set(h, "mpmice", "time", H5_DOUBLE, 1, &sim->t));
  return h5_set(h, "mpmice", "step", H5_LONG, 1, &sim->step);
}

static enum status write_mesh(struct h5 *h, const struct mesh *m)
{
  TRY(h5_write(h, "VTKHDF/NumberOfPoints", H5_LONG, 1, 0, &m->n_points));
  TRY(h5_write(h, "VTKHDF/NumberOfCells", H5_LONG, 1, 0, &m->n_cells));
  TRY(h5_write(h, "VTKHDF/NumberOfConnectivityIds", H5_LONG, 1, 0, &m->n_corners));
  TRY(h5_write(h, "VTKHDF/Points", H5_DOUBLE, m->n_points, 3, m->x));
  TRY(h5_set_text(h, "VTKHDF/Points", "unit", "m"));
  TRY(h5_write(h, "VTKHDF/Connectivity", H5_LONG, m->n_corners, 0, m->connectivity));
  TRY(h5_write(h, "VTKHDF/Offsets", H5_LONG, m->n_cells + 1, 0, m->offsets));
  return h5_write(h, "VTKHDF/Types", H5_BYTE, m->n_cells, 0, m->types);
}

static enum status write_field(const struct output_writer *o, struct h5 *h, const struct sim *sim,
                               const struct field_view *v)
{
  char       own[3 * NAME_LENGTH], name[4 * NAME_LENGTH];
  const int  n = padded_components(v);
  const long rows = v->field->at == AT_CELL ? o->mesh[0].n_cells : v->n;
  fields_copy_name(sim->scene, v->field->output, v->copy, own);
  snprintf(name, sizeof name, "VTKHDF/%s/%s", v->field->at == AT_CELL ? "CellData" : "PointData", own);
  make_ready(&sim->grid, v, o->values);
  TRY(h5_write(h, name, H5_DOUBLE, rows, n == 1 ? 0 : n, o->values));
  TRY(h5_set_text(h, name, "unit", v->field->unit));
  return h5_set_text(h, name, "meaning", v->field->meaning);
}

static enum status write_groups(struct h5 *h, const struct points *p)
{
  TRY(h5_write(h, "VTKHDF/PointData/group", H5_BYTE, p->n, 0, p->group));
  TRY(h5_set_text(h, "VTKHDF/PointData/group", "unit", "-"));
  return h5_set_text(h, "VTKHDF/PointData/group", "meaning", "which solid of the scene, counted from 0");
}

/* Points may have become fewer than the mesh has room for, and they have moved. */
static enum status place_points(const struct sim *sim, enum where at, const struct points *p, struct mesh *m)
{
  struct field_view x;
  if (!fields_positions(sim, at, &x))
    return FAIL(ERR_INPUT, "output: no module of this run holds positions of the %s points", fields_set(at));
  m->n_points = m->n_cells = m->n_corners = p->n;
  for (long i = 0; i < p->n; i++) pad(&x, sim->grid.dim, i, &m->x[3 * i]);
  return OK;
}

static enum status write_set(struct output_writer *o, const struct sim *sim, struct h5 *h, int set)
{
  const struct points *p =
      written[set] == AT_CELL ? NULL : sim->points[written[set] == AT_SOLID ? SET_SOLID : SET_WATER];
  struct field_view v;
  TRY(write_header(h, sim));
  if (p) TRY(place_points(sim, written[set], p, &o->mesh[set]));
  TRY(write_mesh(h, &o->mesh[set]));
  if (p) TRY(write_groups(h, p));
  for (int cursor = 0; fields_next(sim, &cursor, &v);)
    if (v.field->at == written[set] && v.field->output) TRY(write_field(o, h, sim, &v));
  return OK;
}

static enum status write_file(struct output_writer *o, const struct sim *sim, int set)
{
  char      path[LONGEST_PATH];
  struct h5 h;
  TRY(snapshot_path(o, written[set], o->count, path));
  TRY(h5_create(path, &h));
  enum status s = write_set(o, sim, &h, set);
  if (s == OK) return h5_commit(&h);
  h5_abandon(&h);
  return s;
}

/* ---- the series of snapshots ---- */

static void print_series(const struct output_writer *o, enum where at, FILE *file)
{
  fprintf(file, "{\"file-series-version\": \"1.0\", \"files\": [");
  for (long i = 0; i < o->count; i++)
    fprintf(file, "%s\n  {\"name\": \"fields.%s.%05ld.hdf\", \"time\": %.17g}", i ? "," : "", fields_set(at), i,
            o->times[i]);
  fprintf(file, "\n]}\n");
}

static enum status write_series(const struct output_writer *o, enum where at)
{
  char name[64], path[LONGEST_PATH], made[LONGEST_PATH + 4];
  snprintf(name, sizeof name, "fields.%s.hdf.series", fields_set(at));
  TRY(files_path(o->folder, name, path));
  snprintf(made, sizeof made, "%s.tmp", path);
  FILE *file = fopen(made, "w");
  if (!file) return FAIL(ERR_ENVIRONMENT, "%s: cannot be written", made);
  print_series(o, at, file);
  bool bad = ferror(file) != 0;
  if (fclose(file) == 0 && !bad) return files_commit(path);
  unlink(made);
  return FAIL(ERR_ENVIRONMENT, "%s: cannot be written; is the disk full?", path);
}

/* Snapshots of an earlier run from `number` on would be taken for ours. */
static enum status forget_from(const struct output_writer *o, long number)
{
  char path[LONGEST_PATH];
  for (int set = 0; set < 3; set++)
    for (long i = number;; i++) {
      TRY(snapshot_path(o, written[set], i, path));
      if (unlink(path) != 0) break;
    }
  return OK;
}

static enum status remember_time(struct output_writer *o, double t)
{
  double *more;
  if (o->count == o->capacity) {
    TRY(NEW(&more, 2 * o->capacity));
    memcpy(more, o->times, (size_t)o->count * sizeof *more);
    memory_free(&o->times);
    o->times = more;
    o->capacity *= 2;
  }
  o->times[o->count++] = t;
  return OK;
}

enum status output_write(struct output_writer *output, const struct sim *sim)
{
  if (output->count == 0) TRY(forget_from(output, 0));
  for (int set = 0; set < 3; set++)
    if (output->mesh[set].x) TRY(write_file(output, sim, set));
  TRY(remember_time(output, sim->t));
  for (int set = 0; set < 3; set++)
    if (output->mesh[set].x) TRY(write_series(output, written[set]));
  return OK;
}

static enum status read_time(const struct output_writer *o, long number, double *t)
{
  char      path[LONGEST_PATH];
  struct h5 h;
  int       set = o->mesh[0].x ? 0 : o->mesh[1].x ? 1 : 2;
  TRY(snapshot_path(o, written[set], number, path));
  TRY(h5_open(path, &h));
  enum status s = h5_get(&h, "mpmice", "time", H5_DOUBLE, 1, t);
  h5_close(&h);
  return s;
}

enum status output_resume(struct output_writer *output, long count)
{
  double t;
  output->count = 0;
  for (long i = 0; i < count; i++) {
    TRY(read_time(output, i, &t));
    TRY(remember_time(output, t));
  }
  return forget_from(output, count);
}
