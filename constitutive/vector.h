/* Arithmetic of VECTORs, lane by lane, where C has none: choices, extremes, roots. Vectors go by pointer: by value they
 * would need a wide instruction set. */
#ifndef CONSTITUTIVE_VECTOR_H
#define CONSTITUTIVE_VECTOR_H

#include "constitutive/corotate.h"

/* What a comparison of two VECTORs gives: all bits of a lane where it holds. */
#define MASK long __attribute__((vector_size(LANES * sizeof(long))))

#define VECTOR_SELECT(mask, yes, no) ((VECTOR)(((MASK)(mask) & (MASK)(yes)) | (~(MASK)(mask) & (MASK)(no))))
#define VECTOR_MAX(a, b) VECTOR_SELECT((a) > (b), a, b)
#define VECTOR_MIN(a, b) VECTOR_SELECT((a) < (b), a, b)
#define VECTOR_ABS(a) VECTOR_SELECT((a) < 0.0, -(a), a)
#define VECTOR_ALL(x) ((x) + (VECTOR){0.0})

static inline void vector_sqrt(const VECTOR *a, VECTOR *root)
{
  for (int i = 0; i < LANES; i++) (*root)[i] = sqrt((*a)[i]);
}

static inline int vector_any(const MASK *mask)
{
  long any = 0;
  for (int i = 0; i < LANES; i++) any |= (*mask)[i];
  return any != 0;
}

#endif
