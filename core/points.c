/* Order of a set of points: counting sort by block, group and cell. */
#include "core/points.h"

#include "core/memory.h"
#include "core/parallel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int cells_per_block(const struct points *p, int dim)
{
  return dim == 3 ? p->block_edge * p->block_edge * p->block_edge : p->block_edge * p->block_edge;
}

enum status points_create(const struct grid *g, long n, int n_groups, int max_components, struct points **points)
{
  struct points *p;
  TRY(NEW(&p, 1));
  *points = p;
  p->n = n;
  p->n_groups = n_groups;
  p->block_edge = g->dim == 3 ? BLOCK_3D : BLOCK_2D;
  p->n_blocks = 1;
  for (int d = 0; d < 3; d++) {
    p->blocks[d] = d < g->dim ? (g->n[d] + p->block_edge - 1) / p->block_edge : 1;
    p->n_blocks *= p->blocks[d];
  }
  p->n_runs = p->n_blocks * n_groups;
  TRY(NEW(&p->group, n));
  TRY(NEW(&p->start, p->n_runs + 1));
  TRY(NEW(&p->order, n));
  TRY(NEW(&p->key, n));
  TRY(NEW(&p->count, p->n_runs * cells_per_block(p, g->dim) + 1));
  return NEW(&p->shelf, n * max_components);
}

void points_destroy(struct points **points)
{
  if (!*points) return;
  memory_free(&(*points)->group);
  memory_free(&(*points)->start);
  memory_free(&(*points)->order);
  memory_free(&(*points)->key);
  memory_free(&(*points)->count);
  memory_free(&(*points)->shelf);
  memory_free(points);
}

void points_block_corner(const struct points *p, long block, int corner[3])
{
  for (int d = 0; d < 3; d++) {
    corner[d] = (int)(block % p->blocks[d]) * p->block_edge;
    block /= p->blocks[d];
  }
}

int points_colours(const struct grid *g) { return g->dim == 3 ? 8 : 4; }

long points_block_of_colour(const struct points *p, int dim, int colour, long i)
{
  long block = 0, factor = 1;
  for (int d = 0; d < dim; d++) {
    int odd = colour >> d & 1, n = (p->blocks[d] + 1 - odd) / 2;
    if (n == 0) return -1;
    block += (2 * (i % n) + odd) * factor;
    i /= n;
    factor *= p->blocks[d];
  }
  return i == 0 ? block : -1;
}

void points_wrap(const struct grid *g, long n, double *x)
{
  int dim = g->dim;
  for (int d = 0; d < dim; d++) {
    if (!g->periodic[d]) continue;
    double length = g->n[d] * g->h;
    PARALLEL_FOR
    for (long q = 0; q < n; q++) {
      double turns = floor((x[q * dim + d] - g->min[d]) / length);
      if (turns != 0) x[q * dim + d] -= turns * length;
    }
  }
}

/* whether one of n points lies outside [low, high) in cells; x [n][dim]. dim is a constant where this is called */
static inline bool strayed(const struct grid *g, int dim, long n, const double *x, const double *low,
                           const double *high)
{
  double inverse_h = 1 / g->h;
  long   out = 0;
  for (long q = 0; q < n; q++)
    for (int d = 0; d < dim; d++) {
      double s = (x[q * dim + d] - g->min[d]) * inverse_h;
      out |= !((s >= low[d]) & (s < high[d]));
    }
  return out;
}

bool points_need_sort(const struct grid *g, const struct points *p, const double *x)
{
  int need = 0;
  PARALLEL_FOR
  for (long block = 0; block < p->n_blocks; block++) {
    int    corner[3];
    double low[3] = {0}, high[3] = {0};
    long   first = p->start[block * p->n_groups], n = p->start[(block + 1) * p->n_groups] - first;
    points_block_corner(p, block, corner);
    for (int d = 0; d < g->dim; d++) {
      low[d] = fmax(corner[d] - BLOCK_MARGIN, 0);
      high[d] = fmin(corner[d] + p->block_edge + BLOCK_MARGIN, g->n[d]);
    }
    if (g->dim == 3 ? strayed(g, 3, n, x + 3 * first, low, high) : strayed(g, 2, n, x + 2 * first, low, high)) {
#pragma omp atomic write
      need = 1;
    }
  }
  return need;
}

/* cell of a point along one axis; a point exactly on the upper end of the grid belongs to the last cell; -1: outside */
static int cell_of(const struct grid *g, double x, int d)
{
  double s = (x - g->min[d]) / g->h;
  if (!(s >= 0 && s <= g->n[d])) return -1;
  int c = (int)floor(s);
  return c < g->n[d] ? c : g->n[d] - 1;
}

bool points_inside(const struct grid *g, const double *x)
{
  for (int d = 0; d < g->dim; d++)
    if (cell_of(g, x[d], d) < 0) return false;
  return true;
}

void points_keep_inside(const struct grid *g, struct points *p, const double *x)
{
  long n = 0;
  for (long q = 0; q < p->n; q++)
    if (points_inside(g, x + q * g->dim)) p->order[n++] = q;
  p->n = n;
}

static long sort_key(const struct grid *g, const struct points *p, const double *x, int group)
{
  long block = 0, factor = 1, local = 0, local_factor = 1;
  for (int d = 0; d < g->dim; d++) {
    int c = cell_of(g, x[d], d);
    if (c < 0) return -1;
    block += c / p->block_edge * factor;
    factor *= p->blocks[d];
    local += c % p->block_edge * local_factor;
    local_factor *= p->block_edge;
  }
  return (block * p->n_groups + group) * cells_per_block(p, g->dim) + local;
}

enum status points_sort(const struct grid *g, struct points *p, const double *x)
{
  int  per_block = cells_per_block(p, g->dim);
  long bins = p->n_runs * per_block, lost = -1;
  memset(p->count, 0, (size_t)(bins + 1) * sizeof *p->count);
  PARALLEL_FOR
  for (long q = 0; q < p->n; q++) p->key[q] = sort_key(g, p, x + q * g->dim, p->group[q]);
  for (long q = 0; q < p->n; q++) {
    if (p->key[q] < 0)
      lost = q;
    else
      p->count[p->key[q] + 1]++;
  }
  if (lost >= 0)
    return FAIL(ERR_DIVERGED,
                "points: a point left the grid at (%g, %g, %g); extend grid.min/grid.max or close the side",
                x[lost * g->dim], x[lost * g->dim + 1], g->dim == 3 ? x[lost * g->dim + 2] : 0.0);
  for (long b = 0; b < bins; b++) p->count[b + 1] += p->count[b];
  for (long r = 0; r <= p->n_runs; r++) p->start[r] = p->count[r * per_block];
  for (long q = 0; q < p->n; q++) p->order[p->count[p->key[q]]++] = q;
  return OK;
}

void points_permute(struct points *p, int components, double *array)
{
  size_t row = (size_t)components * sizeof *array;
  PARALLEL_FOR
  for (long q = 0; q < p->n; q++) memcpy(p->shelf + q * components, array + p->order[q] * components, row);
  PARALLEL_FOR
  for (long q = 0; q < p->n; q++) memcpy(array + q * components, p->shelf + q * components, row);
}

void points_permute_fields(struct points *p, const struct scene *scene, enum where at, const struct field *fields,
                           int n_fields, void *state)
{
  for (int i = 0; i < n_fields; i++) {
    double *array = *(double **)((char *)state + fields[i].offset);
    if (fields[i].at == at && fields[i].kind == STATE && array)
      points_permute(p, field_components(&fields[i], scene), array);
  }
}

void points_sorted(struct points *p)
{
  unsigned char *shelf = (unsigned char *)p->shelf;
  for (long q = 0; q < p->n; q++) shelf[q] = p->group[p->order[q]];
  memcpy(p->group, shelf, (size_t)p->n);
}
