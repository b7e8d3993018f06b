/* Symmetric positive (semi-)definite 5/7-point systems on the cells of a grid. The only header over hypre and
 * SuiteSparse. */
#ifndef CORE_LINEAR_H
#define CORE_LINEAR_H

#include "core/grid.h"
#include "core/status.h"

#include <stdbool.h>

enum linear_method { LINEAR_AUTO, LINEAR_HYPRE, LINEAR_DIRECT };

struct linear; /* opaque */

struct linear_report {
  int    iterations; /* 0: direct, or nothing to do */
  bool   smg;        /* hypre with PFMG missed the tolerance; SMG was asked */
  bool   fell_back;  /* the method asked for failed and the direct solver took over */
  double residual;   /* largest |b - A x|, computed by ourselves */
  double rms;        /* its rms over the active cells */
};

/** System over the owned cells of a grid. LINEAR_AUTO: direct for small grids. */
enum status linear_create(const struct grid *g, enum linear_method method, struct linear **linear) MUST_CHECK;
void        linear_destroy(struct linear **linear);

/** The matrix of the next solves. diagonal [size]; coupling [dim][size]: entry between a cell and its lower neighbour
 * along an axis, at their face, <= 0; both are borrowed until the next call. singular: constants are in the null space
 * over the cells with active [size] != 0 (borrowed too): right-hand sides are projected, solutions get mean zero there.
 */
void linear_set_matrix(struct linear *linear, const double *diagonal, const double *coupling, bool singular,
                       const double *active);

/** Solves A x = b from the guess x = 0 until the rms of b - A x over the active cells is at most tolerance (the direct
 * solver: always, to round-off); b, x [size]. The first solve of a matrix sets it up. hypre goes from PFMG to SMG to
 * the direct solver until one meets the tolerance; one that was not reached shows in the report. ERR_SOLVER: the matrix
 * is not positive definite (told by the direct solver). */
enum status linear_solve(struct linear *linear, double tolerance, double *b, double *x,
                         struct linear_report *report) MUST_CHECK;

#endif
