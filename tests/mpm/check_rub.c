/* Friction on sides of the grid in a fluid: what presses, what rubs, what sticks. */
#include "mpm/rub.h"

#include "tests/scene_run.h"

/* A layer of soil under water on a rough base, as long as it likes: 0.8 m high, 0.4 m of it in the grid. From t = 0 on
 * it is pulled along the base with 2 m/s2. */
#define LAYER                                                                                                          \
  "{\"grid\": {\"min\": [0, 0], \"max\": [0.4, 1], \"h\": 0.1}, \"time\": {\"end\": 1},"                               \
  "\"gravity\": [\"2*min(1, t/1e-9)\", -9.81], \"materials\": {\"m\": {\"model\": \"linear_elastic\","                 \
  "\"young\": 1e7, \"poisson\": 0.3, \"density\": 2650, \"porosity\": 0.4, \"permeability\": 1e-3}},"                  \
  "\"solids\": {\"soil\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [0, 0], \"max\": [0.4, 0.8]}}}},"       \
  "\"fluid\": {\"density\": 1000, \"bulk_modulus\": 2e8, \"viscosity\": 1e-3,"                                         \
  "\"region\": {\"box\": {\"min\": [0, 0], \"max\": [0.4, 0.9]}}}, \"boundary\": {"                                    \
  "\"solid\": {\"x_min\": \"periodic\", \"x_max\": \"periodic\", \"y_min\": {\"friction\": 0.1}},"                     \
  "\"fluid\": {\"x_min\": \"periodic\", \"x_max\": \"periodic\"}}}"

static const char *const paths[] = {"fluid.path=ice", "fluid.path=twopoint"};
/* N; eight cells of height give it to 2 % */
static const double submerged = 0.6 * 1650 * 9.81 * 0.8 * 0.4;

/* momentum of both phases per impulse of gravity, less that of friction; water above the soil moves with gravity alone
 */
START_TEST(a_layer_slides_with_coulomb_friction)
{
  const char      *sets[] = {paths[_i], NULL};
  struct scene_run run;
  scene_open_with(LAYER, sets, &run);
  while (run.sim->t < 0.05) scene_step(&run, 1e-4);
  struct ledger l = scene_ledger(&run);
  double        t = run.sim->t, mass = 0.4 * 0.8 * (0.6 * 2650 + 0.4 * 1000) + 0.4 * 0.1 * 1000;
  ck_assert_double_eq_tol(l.v[LEDGER_momentum_x] / t, 2 * mass - 0.1 * submerged, 0.03 * 0.1 * submerged);
  ck_assert_double_eq_tol(-mpm_of(run.sim)->now.wall[Y_MIN].impulse[0] / t, 0.1 * submerged, 0.03 * 0.1 * submerged);
  scene_close(&run);
}
END_TEST

/* what friction can hold does not slip */
START_TEST(enough_friction_sticks)
{
  const char      *sets[] = {paths[_i], "boundary.solid.y_min.friction=0.7", NULL};
  struct scene_run run;
  double           most = 0;
  scene_open_with(LAYER, sets, &run);
  for (int i = 0; i < 200; i++) {
    scene_step(&run, 1e-4);
    const struct mpm *m = mpm_of(run.sim);
    for (int node = 0; node <= 4; node++)
      most = fmax(most, fabs(m->vel_new_nc[grid_at(&run.sim->grid, node, 0, 0) * 2]));
  }
  ck_assert_double_lt(most, 1e-12);
  scene_close(&run);
}
END_TEST

/* a side that moves along itself takes the soil with it, at most with its friction */
START_TEST(a_moving_side_drags)
{
  const char      *sets[] = {paths[_i], "gravity=[0, -9.81]",
                             "boundary.solid.y_min={\"velocity\": [5, 0], \"friction\": 0.1}", NULL};
  struct scene_run run;
  scene_open_with(LAYER, sets, &run);
  while (run.sim->t < 0.02) scene_step(&run, 1e-4);
  struct ledger l = scene_ledger(&run);
  ck_assert_double_eq_tol(l.v[LEDGER_momentum_x] / run.sim->t, 0.1 * submerged, 0.03 * 0.1 * submerged);
  ck_assert_double_gt(mpm_of(run.sim)->now.work_walls, 0);
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("sides that rub in a fluid");
  TCase *tcase = tcase_create("rub");
  tcase_add_loop_test(tcase, a_layer_slides_with_coulomb_friction, 0, 2);
  tcase_add_loop_test(tcase, enough_friction_sticks, 0, 2);
  tcase_add_loop_test(tcase, a_moving_side_drags, 0, 2);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
