/* hypre: Struct PCG with one PFMG V-cycle as preconditioner. The only file that knows hypre and MPI. */
#include "core/linear_parts.h"
#include "core/memory.h"
#include "core/parallel.h"

#include <HYPRE.h>
#include <HYPRE_struct_ls.h>
#include <math.h>
#include <mpi.h>

enum { MAX_ITERATIONS = 200 };

struct linear_hypre {
  struct grid         grid;
  int                 lower[3], upper[3]; /* corners of the owned box */
  double             *values;             /* [cells][1 + dim] */
  double             *flat;               /* [cells] */
  HYPRE_StructGrid    box;
  HYPRE_StructStencil stencil;
  HYPRE_StructMatrix  A;
  HYPRE_StructVector  b, x;
  HYPRE_StructSolver  pcg, pfmg;
};

/* hypre needs MPI; both are started once, when the first system asks for them, and end with the program */
static void start_libraries(void)
{
  int started;
  MPI_Initialized(&started);
  if (started) return;
  MPI_Init(NULL, NULL);
  HYPRE_Init();
}

static void create_structures(struct linear_hypre *l)
{
  const struct grid *g = &l->grid;
  int                turn[3] = {0, 0, 0};
  for (int d = 0; d < g->dim; d++) turn[d] = g->periodic[d] ? g->n[d] : 0;
  HYPRE_StructGridCreate(MPI_COMM_SELF, g->dim, &l->box);
  HYPRE_StructGridSetExtents(l->box, l->lower, l->upper);
  HYPRE_StructGridSetPeriodic(l->box, turn);
  HYPRE_StructGridAssemble(l->box);
  HYPRE_StructStencilCreate(g->dim, g->dim + 1, &l->stencil);
  for (int e = 0; e <= g->dim; e++) {
    int offset[3] = {e == 1, e == 2, e == 3};
    HYPRE_StructStencilSetElement(l->stencil, e, offset);
  }
  HYPRE_StructMatrixCreate(MPI_COMM_SELF, l->box, l->stencil, &l->A);
  HYPRE_StructMatrixSetSymmetric(l->A, 1);
  HYPRE_StructMatrixInitialize(l->A);
  HYPRE_StructVectorCreate(MPI_COMM_SELF, l->box, &l->b);
  HYPRE_StructVectorInitialize(l->b);
  HYPRE_StructVectorCreate(MPI_COMM_SELF, l->box, &l->x);
  HYPRE_StructVectorInitialize(l->x);
}

static void destroy_solver(struct linear_hypre *l)
{
  if (!l->pcg) return;
  HYPRE_StructPCGDestroy(l->pcg);
  HYPRE_StructPFMGDestroy(l->pfmg);
}

/* A solver serves one matrix. Set up a second time it would leak its hierarchy, and coarsen from the spacings that the
 * first set-up doubled: five times more iterations. */
static void create_solver(struct linear_hypre *l)
{
  destroy_solver(l);
  HYPRE_StructPFMGCreate(MPI_COMM_SELF, &l->pfmg);
  HYPRE_StructPFMGSetMaxIter(l->pfmg, 1);
  HYPRE_StructPFMGSetTol(l->pfmg, 0);
  HYPRE_StructPFMGSetZeroGuess(l->pfmg);
  HYPRE_StructPFMGSetRelaxType(l->pfmg, 1);
  HYPRE_StructPFMGSetRAPType(l->pfmg, 0);
  HYPRE_StructPCGCreate(MPI_COMM_SELF, &l->pcg);
  HYPRE_StructPCGSetMaxIter(l->pcg, MAX_ITERATIONS);
  HYPRE_StructPCGSetTwoNorm(l->pcg, 1);
  HYPRE_StructPCGSetPrecond(l->pcg, HYPRE_StructPFMGSolve, HYPRE_StructPFMGSetup, l->pfmg);
}

enum status linear_hypre_create(const struct grid *g, struct linear_hypre **hypre)
{
  struct linear_hypre *l;
  long                 n = linear_cells(g);
  TRY(NEW(&l, 1));
  *hypre = l;
  l->grid = *g;
  for (int d = 0; d < 3; d++) l->upper[d] = g->n[d] - 1;
  TRY(NEW(&l->values, n * (1 + g->dim)));
  TRY(NEW(&l->flat, n));
  start_libraries();
  create_structures(l);
  return OK;
}

void linear_hypre_destroy(struct linear_hypre **hypre)
{
  struct linear_hypre *l = *hypre;
  if (!l) return;
  destroy_solver(l);
  if (l->box) {
    HYPRE_StructVectorDestroy(l->x);
    HYPRE_StructVectorDestroy(l->b);
    HYPRE_StructMatrixDestroy(l->A);
    HYPRE_StructStencilDestroy(l->stencil);
    HYPRE_StructGridDestroy(l->box);
  }
  memory_free(&l->values);
  memory_free(&l->flat);
  memory_free(hypre);
}

void linear_hypre_set(struct linear_hypre *l, const struct linear_matrix *A)
{
  const struct grid *g = &l->grid;
  struct box         cells = grid_cells(g);
  int                width = 1 + g->dim, entries[4] = {0, 1, 2, 3};
  PARALLEL_FOR
  for (long r = 0; r < box_rows(&cells); r++) {
    long    c0 = box_row(g, &cells, r);
    double *v = l->values + r * g->n[0] * width;
    for (int i = 0; i < g->n[0]; i++, v += width) {
      int place[3];
      grid_place(g, c0 + i, place);
      v[0] = A->diagonal[c0 + i];
      for (int d = 0; d < g->dim; d++) {
        bool beyond = place[d] == g->n[d] - 1 && !g->periodic[d];
        v[1 + d] = beyond ? 0 : A->coupling[d * g->size + linear_upper(g, c0 + i, d)];
      }
    }
  }
  HYPRE_StructMatrixSetBoxValues(l->A, l->lower, l->upper, width, entries, l->values);
  HYPRE_StructMatrixAssemble(l->A);
  create_solver(l);
  HYPRE_StructPCGSetup(l->pcg, l->A, l->b, l->x);
}

static double norm2(const double *v, long n)
{
  double s = 0;
  for (long i = 0; i < n; i++) s += v[i] * v[i];
  return sqrt(s);
}

int linear_hypre_solve(struct linear_hypre *l, double tolerance, const double *b, double *x)
{
  int iterations = 0;
  linear_to_flat(&l->grid, b, l->flat);
  double size = norm2(l->flat, linear_cells(&l->grid));
  HYPRE_StructVectorSetBoxValues(l->b, l->lower, l->upper, l->flat);
  HYPRE_StructVectorAssemble(l->b);
  HYPRE_StructVectorSetConstantValues(l->x, 0);
  HYPRE_StructVectorAssemble(l->x);
  HYPRE_StructPCGSetTol(l->pcg, fmin(0.5, tolerance / size));
  HYPRE_StructPCGSolve(l->pcg, l->A, l->b, l->x);
  HYPRE_StructPCGGetNumIterations(l->pcg, &iterations);
  HYPRE_ClearAllErrors(); /* "not converged" is judged by the true residual */
  HYPRE_StructVectorGetBoxValues(l->x, l->lower, l->upper, l->flat);
  linear_from_flat(&l->grid, l->flat, x);
  return iterations;
}
