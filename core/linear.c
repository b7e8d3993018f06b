/* Choice of solver, null space, and the true residual, which is always checked here. */
#include "core/linear.h"

#include "core/linear_parts.h"
#include "core/memory.h"
#include "core/parallel.h"

#include <math.h>
#include <string.h>

/* up to here CHOLMOD is faster than PFMG with its set-up; measured for 2D columns and squares */
enum { DIRECT_CELLS = 4000 };

struct linear {
  struct grid           grid;
  enum linear_method    method;
  struct linear_matrix  matrix;
  bool                  singular, hypre_set, direct_set;
  const double         *active;
  double               *residual, *pinned; /* pinned: the diagonal with one entry doubled */
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
  TRY(NEW(&l->residual, g->size));
  TRY(NEW(&l->pinned, g->size));
  return l->method == LINEAR_DIRECT ? linear_direct_create(g, &l->direct) : linear_hypre_create(g, &l->hypre);
}

void linear_destroy(struct linear **linear)
{
  struct linear *l = *linear;
  if (!l) return;
  linear_hypre_destroy(&l->hypre);
  linear_direct_destroy(&l->direct);
  memory_free(&l->residual);
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

/* largest |b - A x| over owned cells */
static double residual_max(struct linear *l, const double *b, const double *x)
{
  const struct grid *g = &l->grid;
  struct box         cells = grid_cells(g);
  double             most = 0;
  FOR_BOX(g, cells, c)
  {
    double r = b[c] - l->matrix.diagonal[c] * x[c];
    for (int d = 0; d < g->dim; d++) {
      const double *k = l->matrix.coupling + d * g->size;
      long          up = linear_upper(g, c, d);
      r -= k[c] * x[linear_lower(g, c, d)] + k[up] * x[up];
    }
    l->residual[c] = r;
  }
  FOR_BOX_SERIAL(g, cells, c) most = isfinite(l->residual[c]) ? fmax(most, fabs(l->residual[c])) : INFINITY;
  return most;
}

static void solve_hypre(struct linear *l, double tolerance, const double *b, double *x, struct linear_report *report)
{
  struct linear_matrix A = {l->singular ? l->pinned : l->matrix.diagonal, l->matrix.coupling};
  if (!l->hypre_set) linear_hypre_set(l->hypre, &A);
  l->hypre_set = true;
  for (int pass = 0; pass < 2 && report->residual > tolerance; pass++) {
    report->iterations += linear_hypre_solve(l->hypre, pass ? 0.1 * tolerance : tolerance, b, x);
    report->residual = residual_max(l, b, x);
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
  memset(x, 0, (size_t)l->grid.size * sizeof *x); /* ghosts too: the residual meets them with couplings of zero */
  report->residual = residual_max(l, b, x);
  if (report->residual <= (l->method == LINEAR_DIRECT ? 0 : tolerance)) return OK; /* it owes no tolerance anything */
  if (!isfinite(report->residual))
    return FAIL(ERR_DIVERGED,
                "pressure: the volume equation's right-hand side is not finite; lower numerics.dt_factor");
  if (l->method == LINEAR_HYPRE) {
    solve_hypre(l, tolerance, b, x, report);
    report->fell_back = !(report->residual <= tolerance);
  }
  if (l->method == LINEAR_DIRECT || report->fell_back) TRY(solve_direct(l, b, x));
  if (l->singular) project(l, x);
  report->residual = residual_max(l, b, x);
  return OK;
}
