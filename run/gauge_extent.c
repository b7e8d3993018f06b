/* How far points reach along an axis: fronts, heights. Grains that have left the body do not count: only points of the
 * largest connected cluster of cells that hold points do. */
#include "run/gauge_extent.h"

#include "core/memory.h"
#include "core/parallel.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct gauge_extent {
  enum where at;
  int        axis, group; /* group -1: all */
  bool       high, connected;
  int       *count;   /* [size] points of a cell that count */
  int       *cluster; /* [size] number of its cluster, -1: none */
  long      *waiting; /* [size] cells whose neighbours are still to be seen */
};

static const struct points *set_of(const struct sim *sim, const struct gauge_extent *e)
{
  return sim->points[e->at == AT_SOLID ? SET_SOLID : SET_WATER];
}

static long cell_of(const struct grid *g, const double x[3])
{
  int place[3] = {0, 0, 0};
  for (int d = 0; d < g->dim; d++) {
    int c = (int)floor((x[d] - g->min[d]) / g->h);
    place[d] = c < 0 ? 0 : c < g->n[d] ? c : g->n[d] - 1;
  }
  return grid_at(g, place[0], place[1], place[2]);
}

/* whether point i is asked for, and where it is */
static bool counts(const struct gauge_reader *r, const struct points *p, const struct field_view *places, long i,
                   double x[3])
{
  const struct gauge_extent *e = r->extent;
  memset(x, 0, 3 * sizeof *x);
  memcpy(x, &places->data[i * places->components], (size_t)places->components * sizeof *x);
  return (e->group < 0 || p->group[i] == e->group) && shape_contains(r->region, x);
}

/* ---- clusters ---- */

/* gives every cell that hangs together with `first` the number; returns how many points they hold */
static long fill_cluster(const struct grid *g, struct gauge_extent *e, long first, int number)
{
  long n = 0, points = 0;
  e->waiting[n++] = first;
  e->cluster[first] = number;
  while (n > 0) {
    long c = e->waiting[--n];
    points += e->count[c];
    for (int d = 0; d < g->dim; d++)
      for (int side = -1; side <= 1; side += 2) {
        long next = c + side * g->stride[d]; /* cells beyond the grid hold nothing */
        if (e->count[next] == 0 || e->cluster[next] >= 0) continue;
        e->cluster[next] = number;
        e->waiting[n++] = next;
      }
  }
  return points;
}

/* number of the cluster with the most points */
static int find_clusters(const struct grid *g, struct gauge_extent *e)
{
  const struct box cells = grid_cells(g);
  long             most = 0;
  int              n = 0, largest = -1;
  for (long c = 0; c < g->size; c++) e->cluster[c] = -1;
  FOR_BOX_SERIAL(g, cells, c)
  {
    if (e->count[c] == 0 || e->cluster[c] >= 0) continue;
    long points = fill_cluster(g, e, c, n);
    if (points > most) largest = n;
    most = points > most ? points : most;
    n++;
  }
  return largest;
}

static void count_points(const struct gauge_reader *r, const struct sim *sim, const struct points *p,
                         const struct field_view *places)
{
  double x[3];
  memset(r->extent->count, 0, (size_t)sim->grid.size * sizeof(int));
  for (long i = 0; i < p->n; i++)
    if (counts(r, p, places, i, x)) r->extent->count[cell_of(&sim->grid, x)]++;
}

/* ---- the number ---- */

/* NaN where no point is */
static double read_extent(const struct gauge_reader *r, const struct sim *sim)
{
  const struct gauge_extent *e = r->extent;
  const struct points       *p = set_of(sim, e);
  struct field_view          places;
  double                     x[3], far = NAN;
  int                        cluster = -1;
  if (!p || !fields_positions(sim, e->at, &places)) return NAN;
  if (e->connected) {
    count_points(r, sim, p, &places);
    cluster = find_clusters(&sim->grid, r->extent);
  }
  for (long i = 0; i < p->n; i++) {
    if (!counts(r, p, &places, i, x)) continue;
    if (e->connected && e->cluster[cell_of(&sim->grid, x)] != cluster) continue;
    if (!(e->high ? x[e->axis] <= far : x[e->axis] >= far)) far = x[e->axis];
  }
  return far;
}

/* "x_max" */
static bool read_word(const char *of, int dim, int *axis, bool *high)
{
  *axis = of[0] - 'x';
  *high = strcmp(of + 1, "_max") == 0;
  return *axis >= 0 && *axis < dim && (*high || strcmp(of + 1, "_min") == 0);
}

static enum status find_points(const struct sim *sim, const struct gauge *gauge, struct gauge_extent *e)
{
  const struct scene *scene = sim->scene;
  e->at = strcmp(gauge->on, "water") == 0 ? AT_WATER : AT_SOLID;
  e->group = -1;
  for (int s = 0; s < scene->n_solids; s++)
    if (strcmp(scene->solids[s].name, gauge->on) == 0) {
      e->at = AT_SOLID;
      e->group = s;
    }
  if (set_of(sim, e) && (e->group >= 0 || e->at == AT_WATER || !*gauge->on)) return OK;
  return FAIL(ERR_INPUT, "gauges.%s.on: there are no points of \"%s\"; name a solid, or leave it out for all",
              gauge->name, gauge->on);
}

enum status gauge_extent_create(const struct sim *sim, const struct gauge *gauge, struct gauge_reader *r)
{
  struct gauge_extent *e;
  TRY(NEW(&r->extent, 1));
  e = r->extent;
  e->connected = gauge->connected;
  if (!read_word(gauge->of, sim->grid.dim, &e->axis, &e->high))
    return FAIL(ERR_INPUT, "gauges.%s.of: \"%s\" is no end of an axis; say x_min, x_max, y_min, ...", gauge->name,
                gauge->of);
  TRY(find_points(sim, gauge, e));
  TRY(NEW(&e->count, sim->grid.size));
  TRY(NEW(&e->cluster, sim->grid.size));
  TRY(NEW(&e->waiting, sim->grid.size));
  r->region = &gauge->region;
  r->read = read_extent;
  snprintf(r->unit, sizeof r->unit, "m");
  return OK;
}

void gauge_extent_destroy(struct gauge_reader *r)
{
  if (!r->extent) return;
  memory_free(&r->extent->count);
  memory_free(&r->extent->cluster);
  memory_free(&r->extent->waiting);
  memory_free(&r->extent);
}
