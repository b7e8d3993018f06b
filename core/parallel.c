/* Thread count. */
#include "core/parallel.h"

#include <omp.h>
#include <stdlib.h>

/* below this, waking a thread in every loop of a step costs more than it saves */
enum { ITEMS_PER_THREAD = 16384 };

int  parallel_threads(void) { return omp_get_max_threads(); }
void parallel_set_threads(int n) { omp_set_num_threads(n); }

void parallel_choose_threads(long items)
{
  long n = 1 + items / ITEMS_PER_THREAD, all = omp_get_num_procs();
  if (!getenv("OMP_NUM_THREADS")) omp_set_num_threads((int)(n < all ? n : all));
}
