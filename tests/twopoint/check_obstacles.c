/* Water points around obstacles: at rest on floors between nodes, pushed by a wall, over a slope. */
#include "twopoint/twopoint.h"

#include "tests/scene_run.h"

#define NUMERICS "\"numerics\": {\"basis\": \"cubic\", \"stress_timing\": \"usl\"}"
#define SCENE(size, region, obstacle)                                                                                  \
  "{\"grid\": {\"min\": [0, 0], \"max\": " size ", \"h\": 0.05}, \"time\": {\"end\": 10}, \"gravity\": [0, -9.81], "   \
  "\"fluid\": {\"path\": \"twopoint\", \"bulk_modulus\": 2e6, \"region\": {\"box\": " region                           \
  "}}, \"obstacles\": {\"body\": {\"shape\": " obstacle "}}, " NUMERICS "}"

/* rms of P - rho g (0.7 - y) over the points, over rho g 0.6 */
static double pressure_error(const struct scene_run *run)
{
  const struct twopoint *w = twopoint_of(run->sim);
  double                 sum = 0;
  for (long p = 0; p < w->points->n; p++) sum += pow(w->P_w[p] - 9810 * (0.7 - w->x_w[2 * p + 1]), 2);
  return sqrt(sum / (double)w->points->n) / (9810 * 0.6);
}

static void check_outside(const struct scene_run *run)
{
  const struct twopoint *w = twopoint_of(run->sim);
  for (long p = 0; p < w->points->n; p++) {
    double x[3] = {w->x_w[2 * p], w->x_w[2 * p + 1], 0};
    for (int d = 0; d < 3; d++) x[d] -= w->now.wall[SIDES].displacement[d];
    ck_assert_double_gt(shape_distance(&run->sim->scene->obstacles[0].shape, x), -1e-9);
  }
}

/* the floor anywhere between two nodes */
START_TEST(rest_on_a_floor)
{
  static const char *const height[] = {"0.1", "0.113", "0.13", "0.145"};
  char                     text[1024];
  struct scene_run         run;
  snprintf(text, sizeof text,
           SCENE("[0.2, 1]", "{\"min\": [0, 0], \"max\": [1, 0.7]}",
                 "{\"half_space\": {\"point\": [0, %s], \"normal\": [0, 1]}}"),
           height[_i]);
  scene_open(text, &run);
  for (int i = 0; i < 250; i++) scene_step(&run, 1);
  ck_assert_msg(pressure_error(&run) < 0.004, "floor at %s: %g", height[_i], pressure_error(&run));
  ck_assert_double_lt(scene_ledger(&run).v[LEDGER_kinetic_fluid], 2e-3);
  check_outside(&run);
  scene_close(&run);
}
END_TEST

/* along a slope the lattice begins in steps: it settles, and the pressure is known to some per cent */
START_TEST(rest_on_a_slope)
{
  struct scene_run run;
  scene_open(SCENE("[0.4, 1]", "{\"min\": [0, 0], \"max\": [1, 0.7]}",
                   "{\"half_space\": {\"point\": [0, 0.1], \"normal\": [-0.5, 1]}}"),
             &run);
  for (int i = 0; i < 500; i++) scene_step(&run, 1);
  ck_assert_msg(pressure_error(&run) < 0.05, "%g", pressure_error(&run));
  check_outside(&run);
  scene_close(&run);
}
END_TEST

/* a wall pushes water together: in the end it lies as high as its volume says */
START_TEST(piston)
{
  struct scene_run run;
  scene_open(
      SCENE("[1, 1]", "{\"min\": [0, 0], \"max\": [1, 0.4]}",
            "{\"box\": {\"min\": [-2, null], \"max\": [0.1, null]}}, \"velocity\": [\"0.2*(1 - step(t - 1))\", 0]"),
      &run);
  double mass = scene_ledger(&run).v[LEDGER_mass_fluid], height = mass / 700, sum = 0;
  while (run.sim->t < 1.5) scene_step(&run, 1);
  for (int i = 0; i < 500; i++) {
    scene_step(&run, 1);
    sum += scene_ledger(&run).v[LEDGER_potential] / 500;
  }
  ck_assert_double_eq_tol(sum, 0.5 * mass * 9.81 * height, 0.01 * sum);
  check_outside(&run);
  scene_close(&run);
}
END_TEST

/* a column falls on a slope of 45 degrees: nothing gets through, energy only falls */
START_TEST(dam_break_on_a_slope)
{
  struct scene_run run;
  double           least = INFINITY;
  scene_open(
      SCENE("[1.5, 1]", "{\"min\": [0.3, 0.3], \"max\": [0.7, 0.9]}", "{\"polygon\": [[0, 0], [0, 0.9], [0.9, 0]]}"),
      &run);
  while (run.sim->t < 0.8) {
    struct ledger l = scene_ledger(&run);
    double        now = l.v[LEDGER_kinetic_fluid] + l.v[LEDGER_potential] + l.v[LEDGER_compression];
    least = fmin(least, now);
    ck_assert_msg(now < least + 0.01 * 1250, "energy rises from %g to %g J at %g s", least, now, run.sim->t);
    for (int i = 0; i < 20; i++) scene_step(&run, 1);
  }
  check_outside(&run);
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("twopoint obstacles");
  TCase *water = tcase_create("water");
  tcase_set_timeout(water, 120);
  tcase_add_loop_test(water, rest_on_a_floor, 0, 4);
  tcase_add_test(water, rest_on_a_slope);
  tcase_add_test(water, piston);
  tcase_add_test(water, dam_break_on_a_slope);
  suite_add_tcase(suite, water);
  return run_suite(suite);
}
