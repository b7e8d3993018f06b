/* Our solve of the volume equation against hypre alone, bare calls on the same matrices and right-hand sides to the
 * same residual, in turns, one thread: us per solve, iterations. usage: bench_pressure SCENE STEPS [SKIP [TOLERANCE]]
 */
#include "ice/ice.h"
#include "run/options.h"
#include "run/plan.h"
#include "run/scene_read.h"

#include "core/memory.h"
#include "core/parallel.h"

#include <HYPRE.h>
#include <HYPRE_struct_ls.h>
#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

struct bare {
  int                 lower[3], upper[3];
  double             *values, *b, *x; /* [cells][1 + dim], [cells] */
  HYPRE_StructGrid    box;
  HYPRE_StructStencil stencil;
  HYPRE_StructMatrix  A;
  HYPRE_StructVector  rhs, solution;
};

static double now_s(void)
{
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static enum status bare_create(const struct grid *g, struct bare *bare)
{
  long n = (long)g->n[0] * g->n[1] * g->n[2];
  int  turn[3] = {0, 0, 0};
  for (int d = 0; d < 3; d++) bare->upper[d] = g->n[d] - 1;
  for (int d = 0; d < g->dim; d++) turn[d] = g->periodic[d] ? g->n[d] : 0;
  TRY(NEW(&bare->values, n * (1 + g->dim)));
  TRY(NEW(&bare->b, n));
  TRY(NEW(&bare->x, n));
  HYPRE_StructGridCreate(MPI_COMM_SELF, g->dim, &bare->box);
  HYPRE_StructGridSetExtents(bare->box, bare->lower, bare->upper);
  HYPRE_StructGridSetPeriodic(bare->box, turn);
  HYPRE_StructGridAssemble(bare->box);
  HYPRE_StructStencilCreate(g->dim, g->dim + 1, &bare->stencil);
  for (int e = 0; e <= g->dim; e++) {
    int offset[3] = {e == 1, e == 2, e == 3};
    HYPRE_StructStencilSetElement(bare->stencil, e, offset);
  }
  HYPRE_StructMatrixCreate(MPI_COMM_SELF, bare->box, bare->stencil, &bare->A);
  HYPRE_StructMatrixSetSymmetric(bare->A, 1);
  HYPRE_StructMatrixInitialize(bare->A);
  HYPRE_StructVectorCreate(MPI_COMM_SELF, bare->box, &bare->rhs);
  HYPRE_StructVectorInitialize(bare->rhs);
  HYPRE_StructVectorCreate(MPI_COMM_SELF, bare->box, &bare->solution);
  HYPRE_StructVectorInitialize(bare->solution);
  return OK;
}

/* the system that the last solve left in the state, as hypre wants it: not timed */
static void bare_fill(const struct grid *g, const struct ice *ice, struct bare *bare)
{
  struct box cells = grid_cells(g);
  long       i = 0;
  FOR_BOX_SERIAL(g, cells, c)
  {
    bare->b[i] = ice->rhs_cc[c];
    bare->values[i * (1 + g->dim)] = ice->diagonal_cc[c];
    for (int d = 0; d < g->dim; d++)
      bare->values[i * (1 + g->dim) + 1 + d] = ice->coupling_fc[d * g->size + c + g->stride[d]];
    i++;
  }
}

static double norm2(const double *v, long n)
{
  double s = 0;
  for (long i = 0; i < n; i++) s += v[i] * v[i];
  return sqrt(s);
}

/* set-up and solve until the 2-norm of the residual is below `norm` */
static int bare_solve(const struct grid *g, struct bare *bare, double norm)
{
  HYPRE_StructSolver pcg, pfmg;
  long               n = (long)g->n[0] * g->n[1] * g->n[2];
  int                iterations, entries[4] = {0, 1, 2, 3};
  HYPRE_StructMatrixSetBoxValues(bare->A, bare->lower, bare->upper, 1 + g->dim, entries, bare->values);
  HYPRE_StructMatrixAssemble(bare->A);
  HYPRE_StructVectorSetBoxValues(bare->rhs, bare->lower, bare->upper, bare->b);
  HYPRE_StructVectorSetConstantValues(bare->solution, 0);
  HYPRE_StructPFMGCreate(MPI_COMM_SELF, &pfmg);
  HYPRE_StructPFMGSetMaxIter(pfmg, 1);
  HYPRE_StructPFMGSetTol(pfmg, 0);
  HYPRE_StructPFMGSetZeroGuess(pfmg);
  HYPRE_StructPFMGSetRelaxType(pfmg, 2);
  HYPRE_StructPFMGSetRAPType(pfmg, 0);
  HYPRE_StructPCGCreate(MPI_COMM_SELF, &pcg);
  HYPRE_StructPCGSetMaxIter(pcg, 200);
  HYPRE_StructPCGSetTwoNorm(pcg, 1);
  HYPRE_StructPCGSetTol(pcg, norm / norm2(bare->b, n));
  HYPRE_StructPCGSetPrecond(pcg, HYPRE_StructPFMGSolve, HYPRE_StructPFMGSetup, pfmg);
  HYPRE_StructPCGSetup(pcg, bare->A, bare->rhs, bare->solution);
  HYPRE_StructPCGSolve(pcg, bare->A, bare->rhs, bare->solution);
  HYPRE_StructPCGGetNumIterations(pcg, &iterations);
  HYPRE_StructVectorGetBoxValues(bare->solution, bare->lower, bare->upper, bare->x);
  HYPRE_StructPCGDestroy(pcg);
  HYPRE_StructPFMGDestroy(pfmg);
  return iterations;
}

/* 2-norm that the residual may have: rms over cells with a pressure as ice/pressure.c asks for */
static double allowed_norm(const struct sim *sim, const struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             most = 0, wet = 0;
  FOR_BOX_SERIAL(g, cells, c)
  {
    most = fmax(most, fabs(ice->rhs_cc[c]));
    wet += ice->wet_cc[c] > 0;
  }
  double least = 1e-13 * grid_cell_volume(g) / sim->dt;
  return fmax(least, sim->scene->numerics.pressure_tolerance * most) * sqrt(wet);
}

static enum status measure(const struct run_options *options, int skip, int steps, double tolerance)
{
  struct loaded_scene *loaded;
  struct plan          plan;
  struct sim          *sim;
  struct bare          bare = {0};
  double               ours = 0, alone = 0, iterations = 0;
  const char          *by;
  TRY(scene_load(options, &loaded));
  if (tolerance > 0) loaded->scene.numerics.pressure_tolerance = tolerance;
  TRY(plan_build(&loaded->scene, &plan));
  TRY(sim_create(&loaded->scene, &plan, &sim));
  TRY(bare_create(&sim->grid, &bare));
  for (int i = 0; i < skip + steps; i++) {
    sim->dt = sim_dt_limit(sim, &plan, &by);
    for (int s = 0; s < plan.n_stages; s++) {
      double start = now_s();
      TRY(plan.stages[s]->run(sim, sim->dt));
      if (i < skip || strcmp(plan.stages[s]->name, "ice.solve_pressure") != 0) continue;
      ours += now_s() - start;
      const struct ice *ice = ice_of(sim);
      bare_fill(&sim->grid, ice, &bare);
      double norm = allowed_norm(sim, ice);
      start = now_s();
      iterations += bare_solve(&sim->grid, &bare, norm);
      alone += now_s() - start;
    }
    if (i == skip - 1) sim->solver = (struct solver_report){0};
    sim->t += sim->dt;
    sim->step++;
  }
  long cells = (long)sim->grid.n[0] * sim->grid.n[1] * sim->grid.n[2];
  printf("ours %.1f ns per cell (%.1f iterations), hypre alone %.1f (%.1f): ratio %.3f; residual %.2g\n",
         1e9 * ours / steps / (double)cells, (double)sim->solver.iterations / (double)sim->solver.solves,
         1e9 * alone / steps / (double)cells, iterations / steps, ours / alone, sim->solver.residual_max);
  sim_destroy(&sim);
  scene_unload(&loaded);
  return OK;
}

int main(int argc, char **argv)
{
  if (argc < 3) {
    fprintf(stderr, "usage: bench_pressure SCENE STEPS [SKIP [TOLERANCE]]\n");
    return EXIT_FAILURE;
  }
  struct run_options options = {.argument = argv[1], .until = INFINITY, .fluid = "ice"};
  parallel_set_threads(1);
  if (measure(&options, argc > 3 ? atoi(argv[3]) : 1, atoi(argv[2]), argc > 4 ? atof(argv[4]) : 0) == OK)
    return EXIT_SUCCESS;
  fprintf(stderr, "bench_pressure: %s\n", status_message());
  return EXIT_FAILURE;
}
