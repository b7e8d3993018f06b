/* Roughness of a field of points: what is linear has none, and a cubic has that of its second differences. */
#include "run/metric_parts.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>

enum { CELLS = 8, PER_AXIS = 2 };

/* of a x + b x^3 + y, points on a lattice up to the height of empty_above */
static double roughness(double a, double b, double empty_above)
{
  static double sums[3 * 4096];
  struct grid   g;
  struct scene  scene = {.numerics.points_per_axis = {PER_AXIS, PER_AXIS, 1}};
  struct sim    sim = {.scene = &scene};
  double        min[3] = {-0.4, 0, 0};
  int           cells[3] = {CELLS, CELLS, 1};
  bool          periodic[3] = {false, false, false};
  grid_create(2, min, cells, 0.1, periodic, &g);
  sim.grid = g;
  ck_assert_int_le(g.size, 4096);
  for (long i = 0; i < 2 * g.size; i++) sums[i] = 0;
  for (int i = 0; i < CELLS * PER_AXIS; i++)
    for (int j = 0; j < CELLS * PER_AXIS; j++) {
      double x[3] = {-0.4 + (i + 0.5) * 0.05, (j + 0.5) * 0.05, 0};
      if (x[1] < empty_above) metric_spread(&g, x, a * x[0] + b * x[0] * x[0] * x[0] + x[1], sums);
    }
  return metric_roughness(&g, metric_finish_spread(&sim, sums));
}

START_TEST(linear_is_smooth) { ck_assert_double_lt(roughness(3, 0, 1), 1e-14); }
END_TEST

/* second difference of x^3 is 6 h2 x; nodes that no wall cuts, with such neighbours: x from -0.1 to 0.1 */
START_TEST(cubic_is_rough)
{
  double spread = 0.1 * sqrt(2.0 / 3);
  ck_assert_double_eq_tol(roughness(1, 1, 1), 6 * 0.01 * spread, 1e-12);
  ck_assert_double_eq_tol(roughness(1, 1, 0.6), 6 * 0.01 * spread, 1e-12); /* a surface does not count */
}
END_TEST

START_TEST(nothing_to_measure) { ck_assert(isnan(roughness(1, 1, 0.1))); }
END_TEST

int main(void)
{
  Suite *suite = suite_create("run.metric_roughness");
  TCase *tests = tcase_create("roughness");
  tcase_add_test(tests, linear_is_smooth);
  tcase_add_test(tests, cubic_is_rough);
  tcase_add_test(tests, nothing_to_measure);
  suite_add_tcase(suite, tests);
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
