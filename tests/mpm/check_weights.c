/* Weights and their gradients for every dimension and basis: sums, differences, smoothness, walls. */
#include "tests/mpm/kernel_bench.h"

START_TEST(weights_sum_to_one)
{
  for (int wall_basis = 0; wall_basis < BOTH_WALLS; wall_basis++) {
    struct bench b;
    create(_i, wall_basis, 0, &b);
    for (long p = 0; p < N; p++) {
      long   node[MAX_SUPPORT];
      double w[MAX_SUPPORT], slope[MAX_SUPPORT][3], sum = 0, total[3] = {0};
      b.k->weights(&b.kg, b.x + p * b.dim, node, w, slope);
      for (int q = 0; q < b.k->n_support; q++) {
        sum += w[q];
        for (int d = 0; d < 3; d++) total[d] += slope[q][d];
      }
      ck_assert_double_eq_tol(sum, 1, 1e-14);
      for (int d = 0; d < b.dim; d++) ck_assert_double_eq_tol(total[d], 0, 1e-12);
    }
    destroy(&b);
  }
}
END_TEST

/* weight of one node as seen from x; 0 where it is not among the nodes */
static double weight_of(const struct bench *b, const double *x, long which, double slope[3])
{
  long   node[MAX_SUPPORT];
  double w[MAX_SUPPORT], slopes[MAX_SUPPORT][3];
  b->k->weights(&b->kg, x, node, w, slopes);
  for (int d = 0; d < 3; d++) slope[d] = 0;
  for (int q = 0; q < b->k->n_support; q++)
    if (node[q] == which) {
      memcpy(slope, slopes[q], 3 * sizeof *slope);
      return w[q];
    }
  return 0;
}

START_TEST(gradients_are_differences_of_weights)
{
  for (int wall_basis = 0; wall_basis < BOTH_WALLS; wall_basis++) {
    struct bench b;
    double       e = 1e-6, least = 0.02, worst = 0;
    int          met = 0;
    create(_i, wall_basis, 0.01, &b);
    for (long p = 0; p < N; p++) {
      long   node[MAX_SUPPORT];
      double w[MAX_SUPPORT], slope[MAX_SUPPORT][3], x[3], none[3];
      bool   kink = false;
      for (int d = 0; d < b.dim; d++) {
        double s = (b.x[p * b.dim + d] - b.kg.g.min[d]) / b.kg.g.h;
        kink = kink || fabs(4 * s - round(4 * s)) < least; /* pieces of all bases end at quarters of cells */
      }
      if (kink) continue;
      b.k->weights(&b.kg, b.x + p * b.dim, node, w, slope);
      for (int q = 0; q < b.k->n_support; q++)
        for (int d = 0; d < b.dim; d++) {
          memcpy(x, b.x + p * b.dim, (size_t)b.dim * sizeof *x);
          x[d] += e;
          double up = weight_of(&b, x, node[q], none);
          x[d] -= 2 * e;
          double down = weight_of(&b, x, node[q], none);
          worst = fmax(worst, fabs(slope[q][d] - (up - down) / (2 * e)));
        }
      met++;
    }
    ck_assert_double_lt(worst, 1e-6);
    ck_assert_int_gt(met, 100);
    destroy(&b);
  }
}
END_TEST

/* weights, and but for the linear basis their gradients, do not jump where a piece ends */
START_TEST(weights_are_smooth_across_cells)
{
  for (int wall_basis = 0; wall_basis < BOTH_WALLS; wall_basis++) {
    struct bench b;
    double       e = 1e-10;
    create_grid(_i, wall_basis, &b);
    bool smooth = b.k->basis != BASIS_LINEAR;
    for (int quarter = 1; quarter < 4 * b.kg.g.n[0]; quarter++)
      for (int i = -1; i <= b.kg.g.n[0] + 1; i++) {
        double x[3] = {0, 0.731, 1.33}, before[3], after[3];
        long   node = grid_at(&b.kg.g, i, 5, b.dim == 3 ? 3 : 0);
        x[0] = b.kg.g.min[0] + 0.25 * b.kg.g.h * quarter - e;
        double low = weight_of(&b, x, node, before);
        x[0] += 2 * e;
        double high = weight_of(&b, x, node, after);
        ck_assert_double_eq_tol(low, high, 1e-7);
        for (int d = 0; d < b.dim && smooth; d++) ck_assert_double_eq_tol(before[d], after[d], 1e-5);
      }
  }
}
END_TEST

/* a point on the upper wall is treated as one on the lower */
START_TEST(both_walls_are_alike)
{
  for (int wall_basis = 0; wall_basis < BOTH_WALLS; wall_basis++) {
    struct bench b;
    create_grid(_i, wall_basis, &b);
    for (int i = -1; i <= 2; i++) {
      const struct grid *g = &b.kg.g;
      double             x[3] = {g->min[0], 0.75, 1.25}, low_slope[3], high_slope[3];
      double             low = weight_of(&b, x, grid_at(g, i, 5, b.dim == 3 ? 2 : 0), low_slope);
      x[0] = g->min[0] + g->n[0] * g->h;
      double high = weight_of(&b, x, grid_at(g, g->n[0] - i, 5, b.dim == 3 ? 2 : 0), high_slope);
      ck_assert_double_eq_tol(low, high, 1e-13);
      if (b.k->basis != BASIS_LINEAR) ck_assert_double_eq_tol(low_slope[0], -high_slope[0], 1e-12);
    }
  }
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("weights");
  TCase *tcase = tcase_create("every dimension and basis");
  tcase_add_loop_test(tcase, weights_sum_to_one, 0, VARIANTS);
  tcase_add_loop_test(tcase, gradients_are_differences_of_weights, 0, VARIANTS);
  tcase_add_loop_test(tcase, weights_are_smooth_across_cells, 0, VARIANTS);
  tcase_add_loop_test(tcase, both_walls_are_alike, 0, VARIANTS);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
