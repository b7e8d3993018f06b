/* Before a step scratch fields are poisoned in debug builds; state is left alone. */
#include "run/plan.h"

#include "tests/run/fake.h"

#include <math.h>

START_TEST(poison_meets_scratch_only)
{
  struct fake_run r;
  fake_create(2, &r);
  const long n = r.sim.points[SET_SOLID]->n;
  sim_poison(&r.sim);
  for (long q = 0; q < r.sim.grid.size; q++) ck_assert(isnan(r.state.mass_nc[q]) == FIELD_POISON);
  for (long q = 0; q < 4 * n; q++) ck_assert(isnan(r.state.grad_p[q]) == FIELD_POISON);
  for (long q = 0; q < 2 * n; q++) ck_assert(isfinite(r.state.vel_p[q]));
  for (long q = 0; q < 2 * r.sim.grid.size; q++) ck_assert(isfinite(r.state.flux_fc[q]));
  ck_assert_ptr_null(r.state.absent_p);
  fake_destroy(&r);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("sim_create");
  TCase *tcase = tcase_create("poison");
  tcase_add_test(tcase, poison_meets_scratch_only);
  suite_add_tcase(suite, tcase);
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_ENV);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed != 0;
}
