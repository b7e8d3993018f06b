/* The registry of kernel variants, and the walk over coloured blocks. */
#include "mpm/kernels/kernels.h"

#define VARIANT(dim, basis) extern const struct kernels kernels_##dim##d_##basis;
#include "mpm/kernels/variants.def"
#undef VARIANT

static const struct kernels *const variants[] = {
#define VARIANT(dim, basis) &kernels_##dim##d_##basis,
#include "mpm/kernels/variants.def"
#undef VARIANT
};

const struct kernels *kernels_find(int dim, enum basis basis)
{
  for (size_t i = 0; i < sizeof variants / sizeof *variants; i++)
    if (variants[i]->dim == dim && variants[i]->basis == basis) return variants[i];
  return NULL;
}

void kernel_grid_create(const struct grid *g, const struct numerics *numerics, const struct side_condition *sides,
                        struct kernel_grid *kg)
{
  *kg = (struct kernel_grid){.g = *g, .inverse_h = 1 / g->h};
  for (int d = 0; d < g->dim; d++) {
    kg->low[d] = g->min[d];
    kg->half_width[d] = 0.5 * g->h / numerics->points_per_axis[d];
  }
  for (int side = 0; side < 2 * g->dim; side++)
    kg->modified[side] =
        sides[side].kind == SIDE_ABSORBING ||
        (numerics->wall_basis == WALL_MODIFIED && sides[side].kind != SIDE_OPEN && sides[side].kind != SIDE_PERIODIC);
}

long kernels_blocks_of_colour(const struct points *p, int dim, int colour)
{
  long n = 1;
  for (int d = 0; d < dim; d++) n *= (p->blocks[d] + 1 - (colour >> d & 1)) / 2;
  return n;
}

struct kernel_run kernels_run(const struct points *p, long block, int group)
{
  long              run = block * p->n_groups + group;
  struct kernel_run r = {.begin = p->start[run], .end = p->start[run + 1], .index = run};
  points_block_corner(p, block, r.corner);
  return r;
}
