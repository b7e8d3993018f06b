/* Thread count. */
#include "core/parallel.h"

#include <omp.h>

int  parallel_threads(void) { return omp_get_max_threads(); }
void parallel_set_threads(int n) { omp_set_num_threads(n); }
