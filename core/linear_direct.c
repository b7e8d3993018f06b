/* CHOLMOD: sparse Cholesky. The pattern is analysed once, a matrix factorised once. The only file that knows
 * SuiteSparse. */
#include "core/linear_parts.h"
#include "core/memory.h"

#include <cholmod.h>

struct linear_direct {
  struct grid     grid;
  cholmod_common  common;
  cholmod_sparse *A; /* lower triangle, columns are cells */
  cholmod_factor *factor;
  cholmod_dense  *rhs;
  long (*source)[2]; /* [entries] where the value comes from: a cell of the diagonal and -1, or one or two (a periodic
                        axis of two cells) entries of the coupling */
};

/* entries of one column: the diagonal, and every neighbour with a larger number once */
static long fill_column(struct linear_direct *l, long column, long entry)
{
  const struct grid *g = &l->grid;
  int               *row = l->A->i;
  int  place[3] = {(int)(column % g->n[0]), (int)(column / g->n[0] % g->n[1]), (int)(column / g->n[0] / g->n[1])};
  long cell = grid_at(g, place[0], place[1], place[2]), first = entry;
  row[entry] = (int)column;
  l->source[entry][0] = cell;
  l->source[entry++][1] = -1;
  for (int d = 0; d < g->dim; d++)
    for (int up = 0; up < 2; up++) {
      int  next[3];
      long neighbour = up ? linear_upper(g, cell, d) : linear_lower(g, cell, d);
      grid_place(g, neighbour, next);
      bool outside = next[d] < 0 || next[d] >= g->n[d];
      if (outside || linear_number(g, next) <= column) continue;
      long from = d * g->size + (up ? neighbour : cell), own = first;
      while (own < entry && row[own] != linear_number(g, next)) own++;
      if (own == entry) {
        row[entry] = (int)linear_number(g, next);
        l->source[entry][1] = -1;
        l->source[entry++][0] = from;
      } else
        l->source[own][1] = from;
    }
  return entry;
}

static enum status create_pattern(struct linear_direct *l)
{
  long n = linear_cells(&l->grid), entry = 0, most = n * (1 + l->grid.dim);
  TRY(NEW(&l->source, most));
  cholmod_start(&l->common);
  l->common.print = 0;
  l->common.final_ll = 1; /* LDL' would also take matrices that are not positive definite */
  l->A = cholmod_allocate_sparse((size_t)n, (size_t)n, (size_t)most, 0, 1, -1, CHOLMOD_REAL, &l->common);
  l->rhs = cholmod_allocate_dense((size_t)n, 1, (size_t)n, CHOLMOD_REAL, &l->common);
  if (!l->A || !l->rhs)
    return FAIL(ERR_ENVIRONMENT,
                "pressure: no memory for the direct solver on %ld cells; set numerics.pressure_solver to hypre", n);
  for (long c = 0; c < n; c++) {
    ((int *)l->A->p)[c] = (int)entry;
    entry = fill_column(l, c, entry);
  }
  ((int *)l->A->p)[n] = (int)entry;
  l->factor = cholmod_analyze(l->A, &l->common);
  if (!l->factor)
    return FAIL(ERR_ENVIRONMENT,
                "pressure: the direct solver cannot analyse %ld cells; set numerics.pressure_solver to hypre", n);
  return OK;
}

enum status linear_direct_create(const struct grid *g, struct linear_direct **direct)
{
  TRY(NEW(direct, 1));
  (*direct)->grid = *g;
  return create_pattern(*direct);
}

void linear_direct_destroy(struct linear_direct **direct)
{
  struct linear_direct *l = *direct;
  if (!l) return;
  cholmod_free_factor(&l->factor, &l->common);
  cholmod_free_sparse(&l->A, &l->common);
  cholmod_free_dense(&l->rhs, &l->common);
  cholmod_finish(&l->common);
  memory_free(&l->source);
  memory_free(direct);
}

enum status linear_direct_set(struct linear_direct *l, const struct linear_matrix *A)
{
  const int *column = l->A->p, *row = l->A->i;
  double    *value = l->A->x;
  for (long c = 0; c < linear_cells(&l->grid); c++)
    for (int e = column[c]; e < column[c + 1]; e++) {
      const long *from = l->source[e];
      value[e] = row[e] == c ? A->diagonal[from[0]] : A->coupling[from[0]] + (from[1] >= 0 ? A->coupling[from[1]] : 0);
    }
  if (cholmod_factorize(l->A, l->factor, &l->common) && l->common.status == CHOLMOD_OK) return OK;
  return FAIL(ERR_SOLVER,
              "pressure: the direct solver found a matrix that is not positive definite; lower numerics.dt_factor");
}

enum status linear_direct_solve(struct linear_direct *l, const double *b, double *x)
{
  linear_to_flat(&l->grid, b, l->rhs->x);
  cholmod_dense *solution = cholmod_solve(CHOLMOD_A, l->factor, l->rhs, &l->common);
  if (!solution)
    return FAIL(ERR_ENVIRONMENT, "pressure: no memory in the direct solver; set numerics.pressure_solver to hypre");
  linear_from_flat(&l->grid, solution->x, x);
  cholmod_free_dense(&solution, &l->common);
  return OK;
}
