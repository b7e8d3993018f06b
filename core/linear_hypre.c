/* hypre: Struct PCG with one V-cycle of PFMG or SMG as preconditioner. The only file of the program that knows hypre
 * and MPI. */
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
  HYPRE_StructSolver  pcg[2], cycle[2]; /* by enum multigrid; NULL: not set up for this matrix */
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

static void destroy_solvers(struct linear_hypre *l)
{
  if (l->pcg[MULTIGRID_PFMG]) HYPRE_StructPFMGDestroy(l->cycle[MULTIGRID_PFMG]);
  if (l->pcg[MULTIGRID_SMG]) HYPRE_StructSMGDestroy(l->cycle[MULTIGRID_SMG]);
  for (int m = 0; m < 2; m++) {
    if (l->pcg[m]) HYPRE_StructPCGDestroy(l->pcg[m]);
    l->pcg[m] = NULL;
  }
}

/* red-black sweeps, forwards before and backwards after the coarser grid: symmetric, as CG asks, and two iterations
 * fewer than Jacobi's */
static void create_pfmg(HYPRE_StructSolver pcg, HYPRE_StructSolver *pfmg)
{
  HYPRE_StructPFMGCreate(MPI_COMM_SELF, pfmg);
  HYPRE_StructPFMGSetMaxIter(*pfmg, 1);
  HYPRE_StructPFMGSetTol(*pfmg, 0);
  HYPRE_StructPFMGSetZeroGuess(*pfmg);
  HYPRE_StructPFMGSetRelaxType(*pfmg, 2);
  HYPRE_StructPFMGSetRAPType(*pfmg, 0);
  HYPRE_StructPCGSetPrecond(pcg, HYPRE_StructPFMGSolve, HYPRE_StructPFMGSetup, *pfmg);
}

static void create_smg(HYPRE_StructSolver pcg, HYPRE_StructSolver *smg)
{
  HYPRE_StructSMGCreate(MPI_COMM_SELF, smg);
  HYPRE_StructSMGSetMaxIter(*smg, 1);
  HYPRE_StructSMGSetTol(*smg, 0);
  HYPRE_StructSMGSetZeroGuess(*smg);
  HYPRE_StructSMGSetNumPreRelax(*smg, 1);
  HYPRE_StructSMGSetNumPostRelax(*smg, 1);
  HYPRE_StructPCGSetPrecond(pcg, HYPRE_StructSMGSolve, HYPRE_StructSMGSetup, *smg);
}

/* A solver serves one matrix. Set up a second time it would leak its hierarchy, and coarsen from the spacings that the
 * first set-up doubled: five times more iterations. */
static void create_solver(struct linear_hypre *l, enum multigrid multigrid)
{
  HYPRE_StructPCGCreate(MPI_COMM_SELF, &l->pcg[multigrid]);
  HYPRE_StructPCGSetMaxIter(l->pcg[multigrid], MAX_ITERATIONS);
  HYPRE_StructPCGSetTwoNorm(l->pcg[multigrid], 1);
  HYPRE_StructPCGSetTol(l->pcg[multigrid], 0);
  (multigrid == MULTIGRID_SMG ? create_smg : create_pfmg)(l->pcg[multigrid], &l->cycle[multigrid]);
  HYPRE_StructPCGSetup(l->pcg[multigrid], l->A, l->b, l->x);
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
  destroy_solvers(l);
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
  int                width = 1 + g->dim, nx = g->n[0], entries[4] = {0, 1, 2, 3};
  PARALLEL_FOR
  for (long r = 0; r < (long)g->n[1] * g->n[2]; r++) {
    struct linear_row row = linear_row(g, r);
    double           *v = l->values + r * nx * width;
    for (int i = 0; i < nx; i++) v[i * width] = A->diagonal[row.first + i];
    for (int d = 0; d < g->dim; d++) {
      const double *k = A->coupling + d * g->size + row.first + (d == 0 ? 1 : row.up[d]);
      for (int i = 0; i < nx; i++) v[i * width + 1 + d] = d == 0 || row.has_up[d] ? k[i] : 0;
    }
    long last = row.first + nx - 1;
    v[(nx - 1) * width + 1] = row.has_up[0] ? A->coupling[last + row.up[0]] : 0;
  }
  HYPRE_StructMatrixSetBoxValues(l->A, l->lower, l->upper, width, entries, l->values);
  HYPRE_StructMatrixAssemble(l->A);
  destroy_solvers(l);
}

static double norm2(const double *v, long n)
{
  double s = 0;
  for (long i = 0; i < n; i++) s += v[i] * v[i];
  return sqrt(s);
}

int linear_hypre_solve(struct linear_hypre *l, enum multigrid multigrid, double tolerance, const double *b, double *x)
{
  int iterations = 0;
  if (!l->pcg[multigrid]) create_solver(l, multigrid);
  HYPRE_StructVectorSetConstantValues(l->x, 0);
  linear_to_flat(&l->grid, b, l->flat);
  HYPRE_StructVectorSetBoxValues(l->b, l->lower, l->upper, l->flat);
  HYPRE_StructPCGSetTol(l->pcg[multigrid], fmin(0.5, tolerance / norm2(l->flat, linear_cells(&l->grid))));
  HYPRE_StructPCGSolve(l->pcg[multigrid], l->A, l->b, l->x);
  HYPRE_StructPCGGetNumIterations(l->pcg[multigrid], &iterations);
  HYPRE_ClearAllErrors(); /* "not converged" is judged by the true residual */
  HYPRE_StructVectorGetBoxValues(l->x, l->lower, l->upper, l->flat);
  linear_from_flat(&l->grid, l->flat, x);
  return iterations;
}
