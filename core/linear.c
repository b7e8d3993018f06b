/* hypre Struct PCG + PFMG and CHOLMOD behind our own names; the true residual is always checked here. */
#include "core/linear.h"

#include "core/memory.h"
#include "core/parallel.h"

#include <cholmod.h>
#include <HYPRE.h>
#include <HYPRE_struct_ls.h>
#include <math.h>
#include <mpi.h>
#include <string.h>

/* below this CHOLMOD beats PFMG's set-up (measured: docs/performance.md) */
enum { DIRECT_CELLS = 1000, MAX_ITERATIONS = 200 };

struct linear {
  struct grid         grid;
  enum linear_method  method;
  double             *residual;
  double             *values; /* hypre: [cells][1 + dim] */
  double             *flat;   /* hypre: [cells] */
  bool                hypre_ready, direct_ready;
  HYPRE_StructGrid    hgrid;
  HYPRE_StructStencil stencil;
  HYPRE_StructMatrix  A;
  HYPRE_StructVector  b, x;
  HYPRE_StructSolver  pcg, pfmg;
  cholmod_common      common;
  cholmod_sparse     *matrix;
  cholmod_factor     *factor;
  cholmod_dense      *rhs;
};

static long cell_count(const struct grid *g) { return (long)g->n[0] * g->n[1] * g->n[2]; }

/* hypre needs MPI; both are started once, when the first system asks for them, and end with the program */
static void start_hypre(void)
{
  int started;
  MPI_Initialized(&started);
  if (started) return;
  MPI_Init(NULL, NULL);
  HYPRE_Init();
}

static void hypre_create(struct linear *l)
{
  const struct grid *g = &l->grid;
  int                lower[3] = {0, 0, 0}, upper[3] = {g->n[0] - 1, g->n[1] - 1, g->n[2] - 1}, turn[3] = {0, 0, 0};
  start_hypre();
  for (int d = 0; d < g->dim; d++) turn[d] = g->periodic[d] ? g->n[d] : 0;
  HYPRE_StructGridCreate(MPI_COMM_SELF, g->dim, &l->hgrid);
  HYPRE_StructGridSetExtents(l->hgrid, lower, upper);
  HYPRE_StructGridSetPeriodic(l->hgrid, turn);
  HYPRE_StructGridAssemble(l->hgrid);
  HYPRE_StructStencilCreate(g->dim, g->dim + 1, &l->stencil);
  for (int e = 0; e <= g->dim; e++) {
    int offset[3] = {e == 1, e == 2, e == 3};
    HYPRE_StructStencilSetElement(l->stencil, e, offset);
  }
  HYPRE_StructMatrixCreate(MPI_COMM_SELF, l->hgrid, l->stencil, &l->A);
  HYPRE_StructMatrixSetSymmetric(l->A, 1);
  HYPRE_StructMatrixInitialize(l->A);
  HYPRE_StructVectorCreate(MPI_COMM_SELF, l->hgrid, &l->b);
  HYPRE_StructVectorInitialize(l->b);
  HYPRE_StructVectorCreate(MPI_COMM_SELF, l->hgrid, &l->x);
  HYPRE_StructVectorInitialize(l->x);
  HYPRE_StructPFMGCreate(MPI_COMM_SELF, &l->pfmg);
  HYPRE_StructPFMGSetMaxIter(l->pfmg, 1);
  HYPRE_StructPFMGSetTol(l->pfmg, 0);
  HYPRE_StructPFMGSetZeroGuess(l->pfmg);
  HYPRE_StructPFMGSetRelaxType(l->pfmg, 1);
  HYPRE_StructPFMGSetRAPType(l->pfmg, 0);
  HYPRE_StructPCGCreate(MPI_COMM_SELF, &l->pcg);
  HYPRE_StructPCGSetMaxIter(l->pcg, MAX_ITERATIONS);
  HYPRE_StructPCGSetTol(l->pcg, 0);
  HYPRE_StructPCGSetPrecond(l->pcg, HYPRE_StructPFMGSolve, HYPRE_StructPFMGSetup, l->pfmg);
  l->hypre_ready = true;
}

static long flat_of(const struct grid *g, const int place[3])
{
  return ((long)place[2] * g->n[1] + place[1]) * g->n[0] + place[0];
}

/* lower triangle of the owned cells, pattern only; wraps on periodic axes */
static enum status direct_create(struct linear *l)
{
  const struct grid *g = &l->grid;
  long               n = cell_count(g), nz = 0;
  cholmod_start(&l->common);
  l->common.print = 0;
  l->common.supernodal = CHOLMOD_AUTO;
  l->matrix =
      cholmod_allocate_sparse((size_t)n, (size_t)n, (size_t)(n * (1 + g->dim)), 1, 1, -1, CHOLMOD_REAL, &l->common);
  l->rhs = cholmod_allocate_dense((size_t)n, 1, (size_t)n, CHOLMOD_REAL, &l->common);
  if (!l->matrix || !l->rhs)
    return FAIL(ERR_ENVIRONMENT,
                "linear: no memory for the direct solver on %ld cells; set numerics.pressure_solver to hypre", n);
  int *column = l->matrix->p, *row = l->matrix->i;
  for (long c = 0; c < n; c++) {
    int place[3] = {(int)(c % g->n[0]), (int)(c / g->n[0] % g->n[1]), (int)(c / g->n[0] / g->n[1])};
    column[c] = (int)nz;
    row[nz++] = (int)c;
    for (int d = 0; d < g->dim; d++) { /* neighbours with a larger number, each once */
      for (int s = -1; s <= 1; s += 2) {
        int next[3] = {place[0], place[1], place[2]};
        next[d] += s;
        if (next[d] < 0 || next[d] >= g->n[d]) {
          if (!g->periodic[d]) continue;
          next[d] -= s * g->n[d];
        }
        if (flat_of(g, next) > c) row[nz++] = (int)flat_of(g, next);
      }
    }
  }
  column[n] = (int)nz;
  ((double *)l->matrix->x)[0] = 0;
  cholmod_sort(l->matrix, &l->common);
  l->factor = cholmod_analyze(l->matrix, &l->common);
  if (!l->factor)
    return FAIL(ERR_ENVIRONMENT, "linear: CHOLMOD could not analyse %ld cells; set numerics.pressure_solver to hypre",
                n);
  l->direct_ready = true;
  return OK;
}

enum status linear_create(const struct grid *g, enum linear_method method, struct linear **linear)
{
  struct linear *l;
  long           n = cell_count(g);
  TRY(NEW(&l, 1));
  *linear = l;
  l->grid = *g;
  l->method = method == LINEAR_AUTO ? (n <= DIRECT_CELLS ? LINEAR_DIRECT : LINEAR_HYPRE) : method;
  TRY(NEW(&l->residual, g->size));
  if (l->method == LINEAR_DIRECT) return direct_create(l);
  TRY(NEW(&l->values, n * (1 + g->dim)));
  TRY(NEW(&l->flat, n));
  hypre_create(l);
  return OK;
}

static void hypre_destroy(struct linear *l)
{
  HYPRE_StructPCGDestroy(l->pcg);
  HYPRE_StructPFMGDestroy(l->pfmg);
  HYPRE_StructVectorDestroy(l->x);
  HYPRE_StructVectorDestroy(l->b);
  HYPRE_StructMatrixDestroy(l->A);
  HYPRE_StructStencilDestroy(l->stencil);
  HYPRE_StructGridDestroy(l->hgrid);
}

void linear_destroy(struct linear **linear)
{
  struct linear *l = *linear;
  if (!l) return;
  if (l->hypre_ready) hypre_destroy(l);
  if (l->direct_ready) {
    cholmod_free_factor(&l->factor, &l->common);
    cholmod_free_sparse(&l->matrix, &l->common);
    cholmod_free_dense(&l->rhs, &l->common);
    cholmod_finish(&l->common);
  }
  memory_free(&l->residual);
  memory_free(&l->values);
  memory_free(&l->flat);
  memory_free(linear);
}

/* index of the upper neighbour, wrapped on a periodic axis; its lower face holds the coupling */
static long upper_neighbour(const struct grid *g, long c, int d)
{
  if (!g->periodic[d]) return c + g->stride[d];
  int place[3];
  grid_place(g, c, place);
  return place[d] == g->n[d] - 1 ? c - (g->n[d] - 1) * g->stride[d] : c + g->stride[d];
}

static long lower_neighbour(const struct grid *g, long c, int d)
{
  if (!g->periodic[d]) return c - g->stride[d];
  int place[3];
  grid_place(g, c, place);
  return place[d] == 0 ? c + (g->n[d] - 1) * g->stride[d] : c - g->stride[d];
}

/* whether cell c has a neighbour across its upper face */
static bool has_upper(const struct grid *g, const int place[3], int d)
{
  return g->periodic[d] || place[d] < g->n[d] - 1;
}

/** Largest |b - A x| over owned cells; fills l->residual. */
static double residual_max(struct linear *l, const double *diagonal, const double *coupling, const double *b,
                           const double *x)
{
  const struct grid *g = &l->grid;
  struct box         cells = grid_cells(g);
  double             most = 0;
  FOR_BOX(g, cells, c)
  {
    double r = b[c] - diagonal[c] * x[c];
    for (int d = 0; d < g->dim; d++) {
      const double *k = coupling + d * g->size;
      long          up = upper_neighbour(g, c, d), low = lower_neighbour(g, c, d);
      r -= k[c] * x[low] + k[up] * x[up];
    }
    l->residual[c] = r;
  }
  FOR_BOX_SERIAL(g, cells, c) most = isfinite(l->residual[c]) ? fmax(most, fabs(l->residual[c])) : INFINITY;
  return most;
}

static void hypre_fill(struct linear *l, const double *diagonal, const double *coupling)
{
  const struct grid *g = &l->grid;
  struct box         cells = grid_cells(g);
  int                width = 1 + g->dim, entries[4] = {0, 1, 2, 3}, lower[3] = {0, 0, 0},
      upper[3] = {g->n[0] - 1, g->n[1] - 1, g->n[2] - 1};
  PARALLEL_FOR
  for (long r = 0; r < box_rows(&cells); r++) {
    long    c0 = box_row(g, &cells, r);
    double *v = l->values + r * g->n[0] * width;
    for (int i = 0; i < g->n[0]; i++, v += width) {
      int place[3];
      grid_place(g, c0 + i, place);
      v[0] = diagonal[c0 + i];
      for (int d = 0; d < g->dim; d++)
        v[1 + d] = has_upper(g, place, d) ? coupling[d * g->size + upper_neighbour(g, c0 + i, d)] : 0;
    }
  }
  HYPRE_StructMatrixSetBoxValues(l->A, lower, upper, width, entries, l->values);
  HYPRE_StructMatrixAssemble(l->A);
}

static void copy_flat(const struct grid *g, double *field, double *flat, bool to_flat)
{
  struct box cells = grid_cells(g);
  size_t     row = (size_t)g->n[0] * sizeof *flat;
  for (long r = 0; r < box_rows(&cells); r++) {
    double *f = field + box_row(g, &cells, r), *q = flat + r * g->n[0];
    memcpy(to_flat ? q : f, to_flat ? f : q, row);
  }
}

static double norm2(const double *v, long n)
{
  double s = 0;
  for (long i = 0; i < n; i++) s += v[i] * v[i];
  return sqrt(s);
}

static int hypre_run(struct linear *l, double *b, double *x, double tolerance)
{
  const struct grid *g = &l->grid;
  int                lower[3] = {0, 0, 0}, upper[3] = {g->n[0] - 1, g->n[1] - 1, g->n[2] - 1}, iterations = 0;
  copy_flat(g, b, l->flat, true);
  double absolute = tolerance, size = norm2(l->flat, cell_count(g));
  HYPRE_StructVectorSetBoxValues(l->b, lower, upper, l->flat);
  HYPRE_StructVectorAssemble(l->b);
  HYPRE_StructVectorSetConstantValues(l->x, 0);
  HYPRE_StructVectorAssemble(l->x);
  HYPRE_StructPCGSetTol(l->pcg, size > 0 ? fmin(0.5, absolute / size) : 0.5);
  HYPRE_StructPCGSetup(l->pcg, l->A, l->b, l->x);
  HYPRE_StructPCGSolve(l->pcg, l->A, l->b, l->x);
  HYPRE_StructPCGGetNumIterations(l->pcg, &iterations);
  HYPRE_ClearAllErrors();
  HYPRE_StructVectorGetBoxValues(l->x, lower, upper, l->flat);
  copy_flat(g, x, l->flat, false);
  return iterations;
}

static enum status direct_run(struct linear *l, const double *diagonal, const double *coupling, double *b, double *x)
{
  const struct grid *g = &l->grid;
  long               n = cell_count(g);
  if (!l->direct_ready) TRY(direct_create(l));
  const int *column = l->matrix->p, *row = l->matrix->i;
  double    *value = l->matrix->x;
  for (long c = 0; c < n; c++) {
    int  place[3] = {(int)(c % g->n[0]), (int)(c / g->n[0] % g->n[1]), (int)(c / g->n[0] / g->n[1])};
    long at = grid_at(g, place[0], place[1], place[2]);
    for (int e = column[c]; e < column[c + 1]; e++) {
      value[e] = row[e] == c ? diagonal[at] : 0; /* a coupling that has become zero must not keep its last value */
      for (int d = 0; d < g->dim && row[e] != c; d++) {
        long up = upper_neighbour(g, at, d), low = lower_neighbour(g, at, d);
        int  q[3];
        grid_place(g, up, q);
        if (has_upper(g, place, d) && flat_of(g, q) == row[e]) value[e] += coupling[d * g->size + up];
        grid_place(g, low, q);
        if ((g->periodic[d] || place[d] > 0) && flat_of(g, q) == row[e]) value[e] += coupling[d * g->size + at];
      }
    }
  }
  copy_flat(g, b, l->rhs->x, true);
  if (!cholmod_factorize(l->matrix, l->factor, &l->common) || l->common.status != CHOLMOD_OK)
    return FAIL(ERR_SOLVER, "pressure: the direct solver found the matrix not positive definite");
  cholmod_dense *solution = cholmod_solve(CHOLMOD_A, l->factor, l->rhs, &l->common);
  if (!solution) return FAIL(ERR_ENVIRONMENT, "pressure: no memory in the direct solver");
  copy_flat(g, x, solution->x, false);
  cholmod_free_dense(&solution, &l->common);
  return OK;
}

/* mean over active cells, taken out of v */
static void project(const struct grid *g, const double *active, double *v)
{
  struct box cells = grid_cells(g);
  double     sum = 0;
  long       n = 0;
  FOR_BOX_SERIAL(g, cells, c) if (active[c] != 0)
  {
    sum += v[c];
    n++;
  }
  FOR_BOX_SERIAL(g, cells, c) if (active[c] != 0) v[c] -= sum / (double)n;
}

/* the diagonal of one active cell is doubled: that fixes the constant and leaves a compatible solution's gradient alone
 */
static double *pinned(const struct grid *g, const double *active, const double *diagonal)
{
  struct box cells = grid_cells(g);
  FOR_BOX_SERIAL(g, cells, c) if (active[c] != 0) return (double *)diagonal + c;
  return NULL;
}

enum status linear_solve(struct linear *l, const double *diagonal, const double *coupling, bool singular,
                         const double *active, double tolerance, double *b, double *x, struct linear_report *report)
{
  const struct grid *g = &l->grid;
  struct box         cells = grid_cells(g);
  double            *pin = singular ? pinned(g, active, diagonal) : NULL;
  *report = (struct linear_report){0};
  if (singular) project(g, active, b);
  FOR_BOX(g, cells, c) x[c] = 0;
  report->residual = residual_max(l, diagonal, coupling, b, x);
  if (report->residual <= tolerance) return OK;
  if (!isfinite(report->residual))
    return FAIL(ERR_DIVERGED, "pressure: the volume equation's right-hand side is not finite");
  if (pin) *pin *= 2;
  if (l->method == LINEAR_HYPRE) {
    double aim = tolerance;
    hypre_fill(l, diagonal, coupling);
    for (int pass = 0; pass < 2 && report->residual > tolerance; pass++, aim *= 0.1) {
      report->iterations += hypre_run(l, b, x, aim);
      report->residual = residual_max(l, diagonal, coupling, b, x);
    }
    report->fell_back = !(report->residual <= tolerance);
  }
  if (l->method == LINEAR_DIRECT || report->fell_back) {
    TRY(direct_run(l, diagonal, coupling, b, x));
    report->residual = residual_max(l, diagonal, coupling, b, x);
  }
  if (pin) *pin *= 0.5;
  if (singular) {
    project(g, active, x);
    report->residual = residual_max(l, diagonal, coupling, b, x);
  }
  return OK;
}
