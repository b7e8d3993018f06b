/* Choice of solver, null space, and the true residual, which is always checked here. */
#include "core/linear.h"

#include "core/linear_parts.h"
#include "core/memory.h"
#include "core/parallel.h"

#include <math.h>
#include <string.h>

/* up to here CHOLMOD is faster than PFMG with its set-up; measured for 2D columns and squares */
enum { DIRECT_CELLS = 4000 };

/* what a row, or all of them, has: largest |v|, sum of squares, active cells; infinite if one is not finite */
struct extent {
  double most, square;
  long   active;
};

struct linear {
  struct grid           grid;
  enum linear_method    method;
  struct linear_matrix  matrix;
  bool                  singular, hypre_set, direct_set;
  const double         *active;
  struct extent        *rows;     /* [rows of cells] */
  long                  n_active; /* active cells */
  double               *pinned;   /* the diagonal with one entry doubled */
  struct linear_hypre  *hypre;
  struct linear_direct *direct;
};

long linear_cells(const struct grid *g) { return (long)g->n[0] * g->n[1] * g->n[2]; }

long linear_number(const struct grid *g, const int place[3])
{
  return ((long)place[2] * g->n[1] + place[1]) * g->n[0] + place[0];
}

long linear_upper(const struct grid *g, long cell, int axis)
{
  if (!g->periodic[axis]) return cell + g->stride[axis];
  int place[3];
  grid_place(g, cell, place);
  return place[axis] == g->n[axis] - 1 ? cell - (g->n[axis] - 1) * g->stride[axis] : cell + g->stride[axis];
}

long linear_lower(const struct grid *g, long cell, int axis)
{
  if (!g->periodic[axis]) return cell - g->stride[axis];
  int place[3];
  grid_place(g, cell, place);
  return place[axis] == 0 ? cell + (g->n[axis] - 1) * g->stride[axis] : cell - g->stride[axis];
}

struct linear_row linear_row(const struct grid *g, long row)
{
  int               place[3] = {0, (int)(row % g->n[1]), (int)(row / g->n[1])};
  struct linear_row r = {.first = grid_at(g, 0, place[1], place[2])};
  for (int d = 0; d < g->dim; d++) {
    long around = (g->n[d] - 1) * g->stride[d];
    bool last = d == 0 || place[d] == g->n[d] - 1, begins = d == 0 || place[d] == 0;
    r.up[d] = last && g->periodic[d] ? -around : g->stride[d];
    r.low[d] = begins && g->periodic[d] ? around : -g->stride[d];
    r.has_up[d] = !last || g->periodic[d];
  }
  return r;
}

void linear_to_flat(const struct grid *g, const double *field, double *flat)
{
  struct box cells = grid_cells(g);
  size_t     row = (size_t)g->n[0] * sizeof *flat;
  for (long r = 0; r < box_rows(&cells); r++) memcpy(flat + r * g->n[0], field + box_row(g, &cells, r), row);
}

void linear_from_flat(const struct grid *g, const double *flat, double *field)
{
  struct box cells = grid_cells(g);
  size_t     row = (size_t)g->n[0] * sizeof *flat;
  for (long r = 0; r < box_rows(&cells); r++) memcpy(field + box_row(g, &cells, r), flat + r * g->n[0], row);
}

enum status linear_create(const struct grid *g, enum linear_method method, struct linear **linear)
{
  struct linear *l;
  TRY(NEW(&l, 1));
  *linear = l;
  l->grid = *g;
  l->method = method != LINEAR_AUTO ? method : linear_cells(g) <= DIRECT_CELLS ? LINEAR_DIRECT : LINEAR_HYPRE;
  TRY(NEW(&l->rows, (long)g->n[1] * g->n[2]));
  TRY(NEW(&l->pinned, g->size));
  return l->method == LINEAR_DIRECT ? linear_direct_create(g, &l->direct) : linear_hypre_create(g, &l->hypre);
}

void linear_destroy(struct linear **linear)
{
  struct linear *l = *linear;
  if (!l) return;
  linear_hypre_destroy(&l->hypre);
  linear_direct_destroy(&l->direct);
  memory_free(&l->rows);
  memory_free(&l->pinned);
  memory_free(linear);
}

/* mean over active cells, taken out of v */
static void project(const struct linear *l, double *v)
{
  struct box cells = grid_cells(&l->grid);
  double     sum = 0;
  long       n = 0;
  FOR_BOX_SERIAL(&l->grid, cells, c) if (l->active[c] != 0)
  {
    sum += v[c];
    n++;
  }
  FOR_BOX_SERIAL(&l->grid, cells, c) if (l->active[c] != 0) v[c] -= sum / (double)n;
}

/* the diagonal of one active cell is doubled: that fixes the constant and leaves a compatible solution's gradient alone
 */
static void pin(struct linear *l, const double *diagonal)
{
  struct box cells = grid_cells(&l->grid);
  bool       done = false;
  FOR_BOX_SERIAL(&l->grid, cells, c)
  {
    bool here = !done && l->active[c] != 0;
    l->pinned[c] = here ? 2 * diagonal[c] : diagonal[c];
    done = done || here;
  }
}

void linear_set_matrix(struct linear *l, const double *diagonal, const double *coupling, bool singular,
                       const double *active)
{
  l->matrix = (struct linear_matrix){diagonal, coupling};
  l->singular = singular;
  l->active = active;
  l->hypre_set = l->direct_set = false;
  if (singular) pin(l, diagonal);
}

static void gather(const struct linear *l, struct linear_report *report)
{
  struct extent all = {0};
  for (long r = 0; r < (long)l->grid.n[1] * l->grid.n[2]; r++) {
    all.most = l->rows[r].most > all.most ? l->rows[r].most : all.most;
    all.square += l->rows[r].square;
    all.active += l->rows[r].active;
  }
  report->residual = isfinite(all.square) ? all.most : INFINITY;
  report->rms = isfinite(all.square) ? sqrt(all.square / (double)(all.active > 0 ? all.active : 1)) : INFINITY;
}

static inline void extend(struct extent *e, double v, double active)
{
  e->most = fabs(v) > e->most ? fabs(v) : e->most;
  e->square += v * v;
  e->active += active != 0;
}

/* of v */
static void measure(struct linear *l, const double *v, struct linear_report *report)
{
  const struct grid *g = &l->grid;
  PARALLEL_FOR
  for (long r = 0; r < (long)g->n[1] * g->n[2]; r++) {
    long          first = linear_row(g, r).first;
    struct extent e = {0};
    for (long c = first; c < first + g->n[0]; c++) extend(&e, v[c], l->active[c]);
    l->rows[r] = e;
  }
  gather(l, report);
}

/* b - A x of the cell at c; up, low: its neighbours along x lie so far away */
static inline double residual_at(const struct linear *l, const struct linear_row *row, long c, long up, long low,
                                 const double *b, const double *x)
{
  const double *k = l->matrix.coupling;
  double        r = b[c] - l->matrix.diagonal[c] * x[c] - (k[c] * x[c + low] + k[c + up] * x[c + up]);
  for (int d = 1; d < l->grid.dim; d++) {
    k += l->grid.size;
    r -= k[c] * x[c + row->low[d]] + k[c + row->up[d]] * x[c + row->up[d]];
  }
  return r;
}

/* of b - A x */
static void measure_residual(struct linear *l, const double *b, const double *x, struct linear_report *report)
{
  const struct grid *g = &l->grid;
  PARALLEL_FOR
  for (long q = 0; q < (long)g->n[1] * g->n[2]; q++) {
    struct linear_row row = linear_row(g, q);
    struct extent     e = {0};
    long              first = row.first, last = first + g->n[0] - 1;
    extend(&e, residual_at(l, &row, first, first == last ? row.up[0] : 1, row.low[0], b, x), l->active[first]);
    for (long c = first + 1; c < last; c++) extend(&e, residual_at(l, &row, c, 1, -1, b, x), l->active[c]);
    if (last > first) extend(&e, residual_at(l, &row, last, row.up[0], -1, b, x), l->active[last]);
    l->rows[q] = e;
  }
  gather(l, report);
}

static bool met(const struct linear_report *report, double tolerance) { return report->rms <= tolerance; }

/* PFMG, once more with a tenth of the tolerance where hypre's residual was not the true one, then SMG */
static void solve_hypre(struct linear *l, double tolerance, const double *b, double *x, struct linear_report *report)
{
  struct linear_matrix A = {l->singular ? l->pinned : l->matrix.diagonal, l->matrix.coupling};
  double               norm = tolerance * sqrt((double)l->n_active);
  if (!l->hypre_set) linear_hypre_set(l->hypre, &A);
  l->hypre_set = true;
  for (int pass = 0; pass < 3 && !met(report, tolerance); pass++) {
    report->smg = pass == 2;
    report->iterations += linear_hypre_solve(l->hypre, report->smg ? MULTIGRID_SMG : MULTIGRID_PFMG,
                                             pass > 0 ? 0.1 * norm : 0.99 * norm, b, x);
    measure_residual(l, b, x, report);
  }
}

static enum status solve_direct(struct linear *l, const double *b, double *x)
{
  struct linear_matrix A = {l->singular ? l->pinned : l->matrix.diagonal, l->matrix.coupling};
  if (!l->direct) TRY(linear_direct_create(&l->grid, &l->direct));
  if (!l->direct_set) TRY(linear_direct_set(l->direct, &A));
  l->direct_set = true;
  return linear_direct_solve(l->direct, b, x);
}

enum status linear_solve(struct linear *l, double tolerance, double *b, double *x, struct linear_report *report)
{
  *report = (struct linear_report){0};
  if (l->singular) project(l, b);
  measure(l, b, report);
  l->n_active = 0;
  for (long r = 0; r < (long)l->grid.n[1] * l->grid.n[2]; r++) l->n_active += l->rows[r].active;
  memset(x, 0, (size_t)l->grid.size * sizeof *x); /* ghosts too: the residual meets them with couplings of zero */
  if (met(report, l->method == LINEAR_DIRECT ? 0 : tolerance)) return OK; /* it owes no tolerance anything */
  if (!isfinite(report->residual))
    return FAIL(ERR_DIVERGED,
                "pressure: the volume equation's right-hand side is not finite; lower numerics.dt_factor");
  if (l->method == LINEAR_HYPRE) {
    solve_hypre(l, tolerance, b, x, report);
    report->fell_back = !met(report, tolerance);
  }
  bool direct = l->method == LINEAR_DIRECT || report->fell_back;
  if (direct) TRY(solve_direct(l, b, x));
  if (l->singular) project(l, x);
  if (l->singular || direct) measure_residual(l, b, x, report);
  return OK;
}
