/* Arithmetic of VECTORs, lane by lane, where C has none: choices, extremes, roots. Vectors go by pointer: by value they
 * would need a wide instruction set. */
#ifndef CONSTITUTIVE_VECTOR_H
#define CONSTITUTIVE_VECTOR_H

#include "constitutive/corotate.h"

#define VECTOR_SELECT(mask, yes, no) ((VECTOR)(((MASK)(mask) & (MASK)(yes)) | (~(MASK)(mask) & (MASK)(no))))
#define VECTOR_MAX(a, b) VECTOR_SELECT((a) > (b), a, b)
#define VECTOR_MIN(a, b) VECTOR_SELECT((a) < (b), a, b)
#define VECTOR_ABS(a) VECTOR_SELECT((a) < 0.0, -(a), a)
#define VECTOR_ALL(x) ((x) + (VECTOR){0.0})

static inline void vector_sqrt(const VECTOR *a, VECTOR *root)
{
  for (int i = 0; i < LANES; i++) (*root)[i] = sqrt((*a)[i]);
}

/* component k of eight records of so many doubles: in registers, as a detour over memory would wait for every store */
static inline void vector_gather(const double *record, int width, int k, VECTOR *v)
{
  const double *a = record + k, *b = a + 4L * width;
  *v = (VECTOR){a[0], a[width], a[2 * width], a[3 * width], b[0], b[width], b[2 * width], b[3 * width]};
}

static inline int vector_any(const MASK *mask)
{
  long any = 0;
  for (int i = 0; i < LANES; i++) any |= (*mask)[i];
  return any != 0;
}

/* Looks for the root of a growing function in every lane: secants, and halves of the bracket where they leave it. */
struct search {
  VECTOR low, high;      /* below and above the root */
  VECTOR at;             /* where the function is wanted next */
  VECTOR last, last_gap; /* where it is known from before, and its value there */
};

static inline void search_next(struct search *s, const VECTOR *gap)
{
  VECTOR secant = s->at - *gap * (s->at - s->last) / (*gap - s->last_gap);
  s->low = VECTOR_SELECT(*gap < 0.0, s->at, s->low);
  s->high = VECTOR_SELECT(*gap < 0.0, s->high, s->at);
  s->last = s->at;
  s->last_gap = *gap;
  s->at = VECTOR_SELECT((MASK)(secant > s->low) & (MASK)(secant < s->high), secant, 0.5 * (s->low + s->high));
}

#endif
