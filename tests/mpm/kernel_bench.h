/* What the tests of kernels share: every variant, a grid, and a cloud of points on it with arrays of their own. */
#ifndef TESTS_MPM_KERNEL_BENCH_H
#define TESTS_MPM_KERNEL_BENCH_H

#include "mpm/kernels/kernels.h"
#include "mpm/mpm.h"
#include "tests/scene_run.h"

#define VARIANT(dim, basis) {dim, #basis},
static const struct {
  int         dim;
  const char *name;
} variants[] = {
#include "mpm/kernels/variants.def"
};
#undef VARIANT
enum { VARIANTS = sizeof variants / sizeof *variants, N = 600, BOTH_WALLS = 2 };

/* a grid, a cloud of points away from the walls or up to them, and their arrays */
struct bench {
  struct kernel_grid    kg;
  const struct kernels *k;
  struct points        *points;
  int                   dim;
  double               *x, *vel, *affine, *mass, *volume, *stress; /* of points */
  double               *mass_nc, *mom_nc, *force_nc, *vel_nc;
};

static const struct side_condition walls[SIDES]; /* SIDE_SLIP everywhere */

static inline double next_random(unsigned *seed)
{
  *seed = *seed * 1664525u + 1013904223u;
  return *seed / 4294967296.0;
}

static inline enum basis basis_of(int variant)
{
  const char *const words[] = {"linear", "gimp", "quadratic", "cubic"};
  int               b = 0;
  while (strcmp(words[b], variants[variant].name)) b++;
  return (enum basis)b;
}

static inline void create_grid(int variant, int wall_basis, struct bench *b)
{
  const double          min[3] = {-0.4, 0.2, 1};
  const int             n[3] = {19, 11, 9};
  const bool            periodic[3] = {false, false, false};
  const struct numerics numerics = {.wall_basis = wall_basis, .points_per_axis = {2, 2, 2}};
  struct grid           g;
  *b = (struct bench){.dim = variants[variant].dim};
  grid_create(b->dim, min, n, 0.1, periodic, &g);
  kernel_grid_create(&g, &numerics, walls, &b->kg);
  b->k = kernels_find(b->dim, basis_of(variant));
  ck_assert_ptr_nonnull(b->k);
}

/* points at least `away` cells from the walls */
static inline void create(int variant, int wall_basis, double away, struct bench *b)
{
  unsigned seed = 11;
  create_grid(variant, wall_basis, b);
  const struct grid *g = &b->kg.g;
  int                dim = b->dim;
  double           **of_points[] = {&b->x, &b->vel, &b->affine, &b->mass, &b->volume, &b->stress};
  double           **of_nodes[] = {&b->mass_nc, &b->mom_nc, &b->force_nc, &b->vel_nc};
  for (int i = 0; i < 6; i++) must(NEW(of_points[i], 9 * N));
  for (int i = 0; i < 4; i++) must(NEW(of_nodes[i], 3 * g->size));
  must(points_create(g, N, 2, 9, &b->points));
  for (long p = 0; p < N; p++) {
    b->points->group[p] = (unsigned char)(p % 2);
    b->mass[p] = 1 + next_random(&seed);
    b->volume[p] = 1e-3 * (1 + next_random(&seed));
    for (int d = 0; d < dim; d++) {
      b->x[p * dim + d] = g->min[d] + g->h * (away + (g->n[d] - 2 * away) * next_random(&seed));
      b->vel[p * dim + d] = next_random(&seed) - 0.5;
    }
    for (int q = 0; q < dim * dim; q++) b->affine[p * dim * dim + q] = next_random(&seed) - 0.5;
    for (int q = 0; q < 6; q++) b->stress[p * 6 + q] = next_random(&seed) - 0.5;
  }
  must(points_sort(g, b->points, b->x));
  points_permute(b->points, dim, b->x);
  points_sorted(b->points);
}

static inline void destroy(struct bench *b)
{
  double **arrays[] = {&b->x,      &b->vel,     &b->affine, &b->mass,     &b->volume,
                       &b->stress, &b->mass_nc, &b->mom_nc, &b->force_nc, &b->vel_nc};
  for (int i = 0; i < 10; i++) memory_free(arrays[i]);
  points_destroy(&b->points);
}

#endif
