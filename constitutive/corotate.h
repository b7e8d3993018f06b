/* The driver of rate laws: dF = R U of a step; the law answers the strain log U in the frame before the rotation, then
 * the stress turns with R. This is objective for steps of any size, and strains of the same axes add up to ln J
 * exactly. theory 1, Skeleton models; M(11)-(14) with the polar decomposition of the step instead of that of all steps.
 */
#ifndef CONSTITUTIVE_COROTATE_H
#define CONSTITUTIVE_COROTATE_H

#include "core/tensor.h"

/* Points go through a law in groups of LANES, component by component: a VECTOR holds one component of the whole group.
 * So a law is vector code on any machine, and a point gets the same bits in whatever company it comes. */
enum { LANES = 8 };
#define VECTOR double __attribute__((vector_size(LANES * sizeof(double))))
/* What a comparison of two VECTORs gives: all bits of a lane where it holds. */
#define MASK long __attribute__((vector_size(LANES * sizeof(long))))

struct corotate_group {
  VECTOR strain[6]; /* log U, tensor components */
  VECTOR stress[6]; /* Pa; the law adds what the strain asks for */
  VECTOR R[9];
  MASK   plane; /* points that move in the plane xy alone */
};

/** Number of points of the group that starts at point p of n. */
static inline int corotate_members(int n, int p) { return n - p < LANES ? n - p : LANES; }

/** Loads m points and decomposes their dF [m][9]. Returns how many have no decomposition (singular, turned inside out,
 * not finite): they count as unstrained, and what they had stays. */
int corotate_begin(int m, const double *dF, const double *stress, struct corotate_group *group);

/** Turns the stresses and stores them, [m][6]. */
void corotate_end(int m, struct corotate_group *group, double *stress);

#endif
