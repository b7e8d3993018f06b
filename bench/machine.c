/* What this machine can do, to judge the benchmarks by: memory bandwidth (triad) and rate of fused multiply-adds.
 * Prints JSON. */
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { N = 1 << 24, REPEATS = 8, CHAINS = 16, WIDTH = 8, ROUNDS = 1 << 22 };
#define VECTOR double __attribute__((vector_size(WIDTH * sizeof(double))))

/* GB/s of a[i] = b[i] + s c[i], three arrays of 128 MB, best of several passes */
static double triad(int threads, double *a, double *b, double *c)
{
  double best = 0;
  for (int pass = 0; pass < REPEATS; pass++) {
    double start = omp_get_wtime();
#pragma omp parallel for num_threads(threads) schedule(static)
    for (long i = 0; i < N; i++) a[i] = b[i] + 3.0 * c[i];
    double rate = 3.0 * N * sizeof(double) / (omp_get_wtime() - start) / 1e9;
    best = rate > best ? rate : best;
  }
  return best;
}

/* Gflop/s of one thread with enough independent chains to hide the latency */
static double multiply_adds(double *sink)
{
  VECTOR v[CHAINS], factor, term;
  for (int k = 0; k < WIDTH; k++) factor[k] = 0.999, term[k] = 1e-3;
  for (int i = 0; i < CHAINS; i++) v[i] = term * (double)i;
  clock_t start = clock(); /* its own: other programs may have the core */
  for (long round = 0; round < ROUNDS; round++)
    for (int i = 0; i < CHAINS; i++) v[i] = v[i] * factor + term;
  double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
  for (int i = 0; i < CHAINS; i++) *sink += v[i][0];
  return 2.0 * CHAINS * WIDTH * (double)ROUNDS / seconds / 1e9;
}

int main(void)
{
  double *a = malloc(N * sizeof *a), *b = malloc(N * sizeof *b), *c = malloc(N * sizeof *c);
  int     threads = omp_get_max_threads();
  if (!a || !b || !c) return EXIT_FAILURE;
#pragma omp parallel for schedule(static)
  for (long i = 0; i < N; i++) a[i] = 0, b[i] = 1, c[i] = 2;
  double one = triad(1, a, b, c), all = triad(threads, a, b, c), flops = multiply_adds(a);
  printf("{\"threads\": %d, \"triad_one_GB_s\": %.1f, \"triad_all_GB_s\": %.1f, \"fma_one_Gflop_s\": %.1f, \"check\": "
         "%g}\n",
         threads, one, all, flops, a[0]);
  free(a), free(b), free(c);
  return EXIT_SUCCESS;
}
