/* The two solvers behind linear.h, and what they share. Nobody else includes this. */
#ifndef CORE_LINEAR_PARTS_H
#define CORE_LINEAR_PARTS_H

#include "core/linear.h"

/* Borrowed: the present matrix, fields of the grid as linear.h describes them. */
struct linear_matrix {
  const double *diagonal, *coupling;
};

/** Owned cells in rows, x fastest. */
long linear_cells(const struct grid *g);
/** Number of an owned cell in that order. */
long linear_number(const struct grid *g, const int place[3]);
/** Neighbours of an owned cell along an axis, wrapped where it is periodic; elsewhere they may be ghosts. */
long linear_upper(const struct grid *g, long cell, int axis);
long linear_lower(const struct grid *g, long cell, int axis);
/* A row of owned cells along x: its first cell, and how far its neighbours across lie; at the ends along x wrapped
 * ones.
 */
struct linear_row {
  long first, up[3], low[3];
  bool has_up[3]; /* the upper neighbour is an owned cell; along x: of the last cell */
};
struct linear_row linear_row(const struct grid *g, long row);
/** Copies owned cells of a field to a dense array, or back. */
void linear_to_flat(const struct grid *g, const double *field, double *flat);
void linear_from_flat(const struct grid *g, const double *flat, double *field);

/* hypre Struct PCG, with one cycle of PFMG or SMG before each iteration */
struct linear_hypre;
enum multigrid { MULTIGRID_PFMG, MULTIGRID_SMG };
enum status linear_hypre_create(const struct grid *g, struct linear_hypre **hypre) MUST_CHECK;
void        linear_hypre_destroy(struct linear_hypre **hypre);
void        linear_hypre_set(struct linear_hypre *hypre, const struct linear_matrix *A);
/** From x = 0 until the 2-norm of the residual is below tolerance; returns the number of iterations. */
int linear_hypre_solve(struct linear_hypre *hypre, enum multigrid multigrid, double tolerance, const double *b,
                       double *x);

/* CHOLMOD */
struct linear_direct;
enum status linear_direct_create(const struct grid *g, struct linear_direct **direct) MUST_CHECK;
void        linear_direct_destroy(struct linear_direct **direct);
enum status linear_direct_set(struct linear_direct *direct, const struct linear_matrix *A) MUST_CHECK;
enum status linear_direct_solve(struct linear_direct *direct, const double *b, double *x) MUST_CHECK;

#endif
