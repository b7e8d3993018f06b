/* A stencil row of four nodes along x as one vector: what the kernels compute with. */
#ifndef MPM_KERNELS_ROWS_H
#define MPM_KERNELS_ROWS_H

#include <math.h>
#include <string.h>

enum { ROW_NODES = 4 };
#define ROW double __attribute__((vector_size(ROW_NODES * sizeof(double))))
#define ROW_INT int __attribute__((vector_size(ROW_NODES * sizeof(int))))
#define ROW_MASK long __attribute__((vector_size(ROW_NODES * sizeof(long))))

/* one value in all lanes */
#define ROW_OF(a) ((ROW){0} + (a))

static inline ROW row_load(const double *from)
{
  ROW row;
  memcpy(&row, from, sizeof row);
  return row;
}

static inline void row_store(double *to, ROW row) { memcpy(to, &row, sizeof row); }

static inline ROW row_floor(ROW a) { return (ROW){floor(a[0]), floor(a[1]), floor(a[2]), floor(a[3])}; }

/* lanes where the mask is set from a, the others from b */
static inline ROW row_choose(ROW_MASK mask, ROW a, ROW b)
{
  return (ROW)((mask & (ROW_MASK)a) | (~mask & (ROW_MASK)b));
}

/* sums over the lanes of four rows: sum a, sum b, sum c, sum d */
static inline ROW row_sums(ROW a, ROW b, ROW c, ROW d)
{
  ROW ab = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  ROW cd = __builtin_shufflevector(c, d, 0, 4, 2, 6) + __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return __builtin_shufflevector(ab, cd, 0, 1, 6, 7) + __builtin_shufflevector(ab, cd, 2, 3, 4, 5);
}

#endif
