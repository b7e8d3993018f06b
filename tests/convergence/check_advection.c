/* Bodies of liquid that a flow stretches and brings back: errors on finer and finer grids are printed, their order is
 * held. In three dimensions at the end of half the usual period: after all of it sheets were thinner than a cell. */
#include "tests/ice/advect.h"

#include "tests/scene_run.h"

static const struct ladder {
  const struct flow *flow;
  int                coarsest, grids;
  double             order, last; /* least order; largest error on the finest grid */
} ladders[] = {{&flow_reversed, 50, 3, 1.7, 8e-4}, {&flow_ball_3d, 32, 2, 1.7, 0.03}};

static double error_of(const struct flow *flow, int n)
{
  struct tank t;
  must(tank_open(flow->dim, (const int[]){n, n, n}, 1.0 / n, (const bool[]){false, false, false}, &t));
  tank_fill(&t, flow);
  tank_run(&t, flow, flow->end, 0.5);
  struct tank_result r = tank_result(&t);
  ck_assert_double_lt(fabs(r.drift), 1e-13);
  ck_assert_double_ge(t.least, 0);
  ck_assert_double_le(t.most, 1 + 1e-12);
  tank_close(&t);
  return r.error;
}

START_TEST(errors_fall_with_the_square_of_h)
{
  const struct ladder *ladder = &ladders[_i];
  double               error = 0, lowest = INFINITY;
  parallel_set_threads(1);
  printf("%s, T %g\n", ladder->flow->name, ladder->flow->end);
  for (int i = 0; i < ladder->grids; i++) {
    double last = error;
    error = error_of(ladder->flow, ladder->coarsest << i);
    printf("  n %3d  error %.3e", ladder->coarsest << i, error);
    if (i > 0) printf("  order %.2f", log2(last / error));
    if (i > 0) lowest = fmin(lowest, log2(last / error));
    printf("\n");
  }
  fflush(stdout);
  ck_assert_double_ge(lowest, ladder->order);
  ck_assert_double_lt(error, ladder->last);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("advection");
  TCase *tcase = tcase_create("advection");
  tcase_add_loop_test(tcase, errors_fall_with_the_square_of_h, 0, 2);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
