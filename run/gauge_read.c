/* Readers: a gauge of the scene made ready to give its number at any time. */
#include "run/gauge_read.h"
#include "run/gauge_extent.h"
#include "run/gauge_level.h"

#include "core/memory.h"
#include "core/parallel.h"
#include "ice/ice.h"
#include "mpm/mpm.h"
#include "run/scene_tables.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { AXES = 3 };

/* ---- a place among cells: multi-linear between the centres, constant beyond the last ---- */

static double read_cells_at(const struct gauge_reader *r, const struct sim *sim)
{
  double v = 0;
  (void)sim;
  for (int i = 0; i < 8; i++)
    if (r->weight[i] > 0) v += r->weight[i] * r->view.data[r->cell[i] * r->view.components + r->component];
  return v;
}

void gauge_reader_weigh(const struct grid *g, struct gauge_reader *r)
{
  int    lower[AXES] = {0, 0, 0};
  double part[AXES] = {0, 0, 0};
  for (int d = 0; d < g->dim; d++) {
    double s = (r->x[d] - g->min[d]) / g->h - 0.5, last = g->n[d] - 1;
    s = s < 0 ? 0 : s > last ? last : s;
    lower[d] = s < last ? (int)s : g->n[d] - 1;
    part[d] = s - lower[d];
  }
  for (int i = 0; i < 8; i++) {
    const int up[AXES] = {i & 1, i >> 1 & 1, i >> 2 & 1};
    r->weight[i] = 1;
    for (int d = 0; d < AXES; d++) r->weight[i] *= up[d] ? part[d] : 1 - part[d];
    r->cell[i] = r->weight[i] > 0 ? grid_at(g, lower[0] + up[0], lower[1] + up[1], lower[2] + up[2]) : 0;
  }
}

/* ---- a place among points: mean of those within h, weighted by nearness ---- */

static const struct points *points_of(const struct sim *sim, enum where at)
{
  return sim->points[at == AT_SOLID ? SET_SOLID : SET_WATER];
}

/* A point within h of x, one block margin and a step's way out of its block. */
static bool block_near(const struct grid *g, const struct points *p, long block, const double x[3])
{
  const int reach = BLOCK_MARGIN + 2;
  int       corner[AXES];
  points_block_corner(p, block, corner);
  for (int d = 0; d < g->dim; d++) {
    double s = (x[d] - g->min[d]) / g->h;
    if (s < corner[d] - reach || s > corner[d] + p->block_edge + reach) return false;
  }
  return true;
}

static double nearness(const struct grid *g, const double *a, const double *b)
{
  double r2 = 0;
  for (int d = 0; d < g->dim; d++) r2 += (a[d] - b[d]) * (a[d] - b[d]);
  double w = 1 - sqrt(r2) / g->h;
  return w > 0 ? w : 0;
}

/* NaN where no point is near: a gauge in the void shows nothing. */
static double read_points_at(const struct gauge_reader *r, const struct sim *sim)
{
  const struct points *p = points_of(sim, r->view.field->at);
  struct field_view    x;
  double               sum = 0, weight = 0;
  if (!fields_positions(sim, r->view.field->at, &x)) return NAN;
  for (long b = 0; b < p->n_blocks; b++) {
    if (!block_near(&sim->grid, p, b, r->x)) continue;
    for (long i = p->start[b * p->n_groups]; i < p->start[(b + 1) * p->n_groups]; i++) {
      double w = nearness(&sim->grid, &x.data[i * x.components], r->x);
      weight += w;
      sum += w * r->view.data[i * r->view.components + r->component];
    }
  }
  return weight > 0 ? sum / weight : NAN;
}

/* ---- regions ---- */

static double sum_cells(const struct gauge_reader *r)
{
  double sum = 0;
  for (long i = 0; i < r->n_cells; i++) sum += r->view.data[r->cells[i] * r->view.components + r->component];
  return sum;
}

static double read_cells_mean(const struct gauge_reader *r, const struct sim *sim)
{
  (void)sim;
  return sum_cells(r) / (double)r->n_cells;
}

static double read_cells_integral(const struct gauge_reader *r, const struct sim *sim)
{
  return sum_cells(r) * grid_cell_volume(&sim->grid);
}

/* Sum over the points in the region, each times its weight (volume, or 1); *weight: sum of the weights. */
static double sum_points(const struct gauge_reader *r, const struct sim *sim, const double *volume, double *weight)
{
  const struct points *p = points_of(sim, r->view.field->at);
  struct field_view    x;
  double               sum = 0;
  *weight = 0;
  if (!fields_positions(sim, r->view.field->at, &x)) return 0;
  for (long i = 0; i < p->n; i++) {
    double at[AXES] = {0, 0, 0}, w = volume ? volume[i] : 1;
    memcpy(at, &x.data[i * x.components], (size_t)x.components * sizeof *at);
    if (!shape_contains(r->region, at)) continue;
    *weight += w;
    sum += w * r->view.data[i * r->view.components + r->component];
  }
  return sum;
}

static double read_points_mean(const struct gauge_reader *r, const struct sim *sim)
{
  double weight, sum = sum_points(r, sim, r->volume.data, &weight);
  return weight > 0 ? sum / weight : NAN;
}

static double read_points_integral(const struct gauge_reader *r, const struct sim *sim)
{
  double weight;
  return sum_points(r, sim, r->volume.data, &weight);
}

static enum status collect_cells(const struct sim *sim, const struct gauge *gauge, struct gauge_reader *r)
{
  const struct box cells = grid_cells(&sim->grid);
  double           x[AXES];
  TRY(NEW(&r->cells, (size_t)sim->grid.n[0] * (size_t)sim->grid.n[1] * (size_t)sim->grid.n[2]));
  FOR_BOX_SERIAL(&sim->grid, cells, c)
  {
    grid_centre(&sim->grid, c, x);
    if (shape_contains(&gauge->region, x)) r->cells[r->n_cells++] = c;
  }
  if (r->n_cells > 0) return OK;
  return FAIL(ERR_INPUT, "gauges.%s.region: holds no cell centre; make it larger than a cell", gauge->name);
}

/* ---- markers and the ledger ---- */

static double mean_of_markers(const struct gauge_reader *r, const struct field_view *v)
{
  double sum = 0;
  for (long i = r->first; i < r->end; i++) sum += v->data[i * v->components + r->component];
  return sum / (double)(r->end - r->first);
}

static double read_position(const struct gauge_reader *r, const struct sim *sim)
{
  (void)sim;
  return mean_of_markers(r, &r->view);
}

static double read_displacement(const struct gauge_reader *r, const struct sim *sim)
{
  (void)sim;
  double sum = 0;
  for (long i = r->first; i < r->end; i++) {
    long at = i * r->view.components + r->component;
    sum += r->view.data[at] - r->start.data[at];
  }
  return sum / (double)(r->end - r->first);
}

/* of the markers from gauge->x */
static double read_distance(const struct gauge_reader *r, const struct sim *sim)
{
  double sum = 0;
  for (long i = r->first; i < r->end; i++) {
    double r2 = 0;
    for (int d = 0; d < sim->grid.dim; d++) r2 += pow(r->view.data[i * r->view.components + d] - r->x[d], 2);
    sum += sqrt(r2);
  }
  return sum / (double)(r->end - r->first);
}

static double read_wall(const struct gauge_reader *r, const struct sim *sim)
{
  (void)sim;
  return *r->number;
}

static double read_ledger(const struct gauge_reader *r, const struct sim *sim) { return sim->ledger.v[r->ledger]; }

static double read_energy(const struct gauge_reader *r, const struct sim *sim)
{
  const double *v = sim->ledger.v;
  (void)r;
  return v[LEDGER_kinetic_solid] + v[LEDGER_kinetic_fluid] + v[LEDGER_potential] + v[LEDGER_elastic] +
         v[LEDGER_compression];
}

/* energy with what was taken since the start, without what was done: it stays, but for what no account sees */
static double read_balance(const struct gauge_reader *r, const struct sim *sim)
{
  const double *v = sim->ledger.v;
  double        taken = v[LEDGER_plastic] + v[LEDGER_friction] + v[LEDGER_damping] + v[LEDGER_absorbed];
  return read_energy(r, sim) + taken + v[LEDGER_energy_out] - v[LEDGER_work_loads] - v[LEDGER_work_walls];
}

/* potential energy that is gone since the start */
static double read_released(const struct gauge_reader *r, const struct sim *sim)
{
  (void)r;
  return sim->ledger_start.v[LEDGER_potential] - sim->ledger.v[LEDGER_potential];
}

/* what is made of several entries of the ledger, J; NULL: no such word */
static double (*find_sum(const char *of))(const struct gauge_reader *, const struct sim *)
{
  if (strcmp(of, "energy") == 0) return read_energy;
  if (strcmp(of, "balance") == 0) return read_balance;
  return strcmp(of, "released") == 0 ? read_released : NULL;
}

double gauge_reader_read(struct gauge_reader *reader, const struct sim *sim)
{
  if (reader->view.field) fields_refresh(sim, &reader->view);
  if (reader->volume.field) fields_refresh(sim, &reader->volume);
  if (reader->start.field) fields_refresh(sim, &reader->start);
  return reader->read(reader, sim);
}

/* ---- from the scene's gauge to a reader ---- */

static enum status find_field(const struct sim *sim, const struct gauge *gauge, struct gauge_reader *r)
{
  char why[512];
  if (fields_component(sim, gauge->of, &r->view, &r->component) == OK) {
    snprintf(r->unit, sizeof r->unit, "%s", r->view.field->unit);
    return OK;
  }
  snprintf(why, sizeof why, "%s", status_message());
  return FAIL(ERR_INPUT, "gauges.%s.of: %s", gauge->name, why);
}

/* null in a scene is infinite here: the middle of that axis */
static double coordinate(const struct grid *g, int axis, double x)
{
  return isfinite(x) ? x : g->min[axis] + 0.5 * g->h * g->n[axis];
}

void gauge_reader_place(const struct grid *g, const struct gauge *gauge, int sample, double x[3])
{
  double part = gauge_is_line(gauge) && gauge->n > 1 ? (double)sample / (gauge->n - 1) : 0;
  for (int d = 0; d < g->dim; d++) {
    double from = coordinate(g, d, gauge->x[d]), to = coordinate(g, d, gauge->to[d]);
    x[d] = from + part * (to - from);
  }
}

static enum status create_point(const struct sim *sim, const struct gauge *gauge, int sample, struct gauge_reader *r)
{
  TRY(find_field(sim, gauge, r));
  gauge_reader_place(&sim->grid, gauge, sample, r->x);
  r->read = r->view.field->at == AT_CELL ? read_cells_at : read_points_at;
  if (r->view.field->at == AT_CELL) gauge_reader_weigh(&sim->grid, r);
  return OK;
}

static void find_volume(const struct sim *sim, struct gauge_reader *r)
{
  struct field_view v;
  for (int cursor = 0; fields_next(sim, &cursor, &v);)
    if (v.field->at == r->view.field->at && v.field->output && strcmp(v.field->output, "volume") == 0) r->volume = v;
}

static enum status create_region(const struct sim *sim, const struct gauge *gauge, struct gauge_reader *r)
{
  const bool integral = gauge->kind == GAUGE_INTEGRAL;
  TRY(find_field(sim, gauge, r));
  if (integral) snprintf(r->unit, sizeof r->unit, "%s m%d", r->view.field->unit, sim->grid.dim);
  r->region = &gauge->region;
  if (r->view.field->at == AT_CELL) {
    r->read = integral ? read_cells_integral : read_cells_mean;
    return collect_cells(sim, gauge, r);
  }
  find_volume(sim, r);
  r->read = integral ? read_points_integral : read_points_mean;
  if (!integral || r->volume.data) return OK;
  return FAIL(ERR_INPUT, "gauges.%s: points of %s have no volume to integrate with; take the kind \"mean\"",
              gauge->name, fields_set(r->view.field->at));
}

static int find_ledger(const char *of, const char **unit)
{
  static const char *const name[] = {
#define LEDGER(name, unit, meaning) #name,
#include "core/ledger.def"
#undef LEDGER
  };
  static const char *const units[] = {
#define LEDGER(name, unit, meaning) unit,
#include "core/ledger.def"
#undef LEDGER
  };
  for (int i = 0; i < N_LEDGER; i++)
    if (strcmp(name[i], of) == 0) {
      *unit = units[i];
      return i;
    }
  return -1;
}

/* "displacement_y", "position_x": true, with the component and which of the two */
static bool marker_quantity(const char *of, int dim, int *component, bool *displacement)
{
  const char *dash = strrchr(of, '_');
  if (!dash || dash[1] < 'x' || dash[1] > 'z' || dash[2] != '\0') return false;
  *component = dash[1] - 'x';
  *displacement = strncmp(of, "displacement", (size_t)(dash - of)) == 0 && dash - of == 12;
  return *component < dim && (*displacement || (strncmp(of, "position", 8) == 0 && dash - of == 8));
}

static enum status create_marker(const struct sim *sim, const struct gauge *gauge, const struct marker_finder *markers,
                                 struct gauge_reader *r)
{
  bool displacement = false, distance = strcmp(gauge->of, "distance") == 0;
  if (!distance && !marker_quantity(gauge->of, sim->grid.dim, &r->component, &displacement))
    return FAIL(ERR_INPUT,
                "gauges.%s.of: \"%s\" is not known of a load or tracer; say displacement_x, position_x or distance",
                gauge->name, gauge->of);
  if (!fields_named(sim, "x_m", &r->view) || !fields_named(sim, "x0_m", &r->start))
    return FAIL(ERR_INPUT, "gauges.%s: nothing in this scene moves markers; add a solid", gauge->name);
  markers->range(sim, gauge->on, &r->first, &r->end);
  if (r->first >= r->end)
    return FAIL(ERR_INPUT, "gauges.%s.on: there is no load or tracer \"%s\"", gauge->name, gauge->on);
  r->read = distance ? read_distance : displacement ? read_displacement : read_position;
  memcpy(r->x, gauge->x, sizeof r->x);
  snprintf(r->unit, sizeof r->unit, "m");
  return OK;
}

/* heat into the grid through a side over the last step, W */
static enum status create_side_heat(const struct sim *sim, const struct gauge *gauge, struct gauge_reader *r)
{
  const struct ice *ice = ice_of(sim);
  int               side = 0;
  while (side < 2 * sim->grid.dim && strcmp(side_names[side], gauge->on) != 0) side++;
  if (!ice || !ice->swell_cc || side == 2 * sim->grid.dim)
    return FAIL(ERR_INPUT, "gauges.%s: there is no heat of \"%s\"; give a side of a scene whose fluid conducts heat",
                gauge->name, gauge->on);
  r->number = &ice->now.heat_side[side];
  r->read = read_wall;
  snprintf(r->unit, sizeof r->unit, "W");
  return OK;
}

/* "force_x", "impulse_x", "displacement_x" of a side or an obstacle */
static enum status create_wall(const struct sim *sim, const struct gauge *gauge, struct gauge_reader *r)
{
  const struct mpm *m = mpm_of(sim);
  const char       *dash = strrchr(gauge->of, '_');
  int               wall, axis = dash ? dash[1] - 'x' : -1;
  if (strcmp(gauge->of, "heat") == 0) return create_side_heat(sim, gauge, r);
  if (!m || !mpm_wall_find(sim, gauge->on, &wall) || axis < 0 || axis >= sim->grid.dim)
    return FAIL(ERR_INPUT,
                "gauges.%s: there is no %s of \"%s\"; give an obstacle or a side, and force_x, impulse_x or heat",
                gauge->name, gauge->of, gauge->on);
  const struct wall_numbers *numbers = &m->now.wall[wall];
  bool                       force = *gauge->of == 'f', impulse = *gauge->of == 'i';
  r->number = (force ? numbers->force : impulse ? numbers->impulse : numbers->displacement) + axis;
  r->read = read_wall;
  snprintf(r->unit, sizeof r->unit, force ? "N" : impulse ? "N s" : "m");
  return OK;
}

int gauge_columns(const struct gauge *gauge) { return gauge_is_line(gauge) && gauge->n > 1 ? gauge->n : 1; }

enum status gauge_reader_create(const struct sim *sim, const struct gauge *gauge, int sample,
                                const struct marker_finder *markers, struct gauge_reader *reader)
{
  const char *unit = "J";
  memset(reader, 0, sizeof *reader);
  snprintf(reader->name, sizeof reader->name, "%s", gauge->name);
  if (gauge_is_line(gauge)) snprintf(reader->name, sizeof reader->name, "%s.%d", gauge->name, sample);
  if (gauge->kind == GAUGE_POINT || gauge->kind == GAUGE_LINE) return create_point(sim, gauge, sample, reader);
  if (gauge->kind == GAUGE_TRACER || gauge->kind == GAUGE_LOAD) return create_marker(sim, gauge, markers, reader);
  if (gauge->kind == GAUGE_WALL) return create_wall(sim, gauge, reader);
  if (gauge->kind == GAUGE_EXTENT) return gauge_extent_create(sim, gauge, reader);
  if (gauge->kind == GAUGE_LEVEL || gauge->kind == GAUGE_LEVELS) return gauge_level_create(sim, gauge, sample, reader);
  reader->ledger = gauge->kind == GAUGE_INTEGRAL ? find_ledger(gauge->of, &unit) : -1;
  reader->read = gauge->kind == GAUGE_INTEGRAL ? find_sum(gauge->of) : NULL;
  if (reader->ledger < 0 && !reader->read) return create_region(sim, gauge, reader);
  snprintf(reader->unit, sizeof reader->unit, "%s", unit);
  if (!reader->read) reader->read = read_ledger;
  return OK;
}

void gauge_reader_destroy(struct gauge_reader *reader)
{
  memory_free(&reader->cells);
  gauge_extent_destroy(reader);
}
