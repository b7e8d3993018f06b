/* The OpenMP macros. Loops run over rows of a box, or over blocks of one colour; sums go through fixed rows, so that
 * results do not depend on the number of threads. */
#ifndef CORE_PARALLEL_H
#define CORE_PARALLEL_H

#include "core/grid.h"

#define PARALLEL_FOR _Pragma("omp parallel for schedule(static)")
/* iterations of very different cost */
#define PARALLEL_FOR_DYNAMIC _Pragma("omp parallel for schedule(dynamic, 1)")

/* for (every index c of the box), rows in parallel:  FOR_BOX(g, b, c) { ... }  */
#define FOR_BOX(g, b, c)                                                                                               \
  PARALLEL_FOR for (long row_ = 0; row_ < box_rows(&(b));                                                              \
                    row_++) for (long c = box_row(g, &(b), row_), end_ = c + box_length(&(b)); c < end_; c++)
/* the same on one thread */
#define FOR_BOX_SERIAL(g, b, c)                                                                                        \
  for (long row_ = 0; row_ < box_rows(&(b)); row_++)                                                                   \
    for (long c = box_row(g, &(b), row_), end_ = c + box_length(&(b)); c < end_; c++)

int  parallel_threads(void);
void parallel_set_threads(int n);
/** As many threads as so many points and cells keep busy, all at most. OMP_NUM_THREADS, where it is set, decides. */
void parallel_choose_threads(long items);

#endif
