/* Heat of bodies that move: profiles ride along, plastic work and friction heat by what they do. */
#include "mpm/heat.h"

#include "tests/scene_run.h"

static const char *const bases[] = {"numerics.basis=linear", "numerics.basis=gimp", "numerics.basis=quadratic",
                                    "numerics.basis=cubic"};

/* a disk that touches nothing; diffusivity k/1e6 m2/s */
#define DISK(conductivity, velocity)                                                                                   \
  "{\"grid\": {\"min\": [-1, -1], \"max\": [1, 1], \"h\": 0.1}, \"time\": {\"end\": 10}, \"start\": \"zero\","         \
  "\"materials\": {\"m\": {\"model\": \"neo_hookean\", \"young\": 1e5, \"poisson\": 0.3, \"density\": 1000,"           \
  "\"heat_capacity\": 1000, \"conductivity\": " conductivity "}}, \"solids\": {\"disk\": {\"material\": \"m\","        \
  "\"shape\": {\"circle\": {\"centre\": [0, 0], \"radius\": 0.5}}, \"temperature\": \"300+10*x\", "                    \
  "\"velocity\": " velocity "}}}"

/* temperatures by the place that the points had at the start: they are sorted on the way */
static double start_of(const struct scene_run *run, long p, int d)
{
  const struct mpm *m = mpm_of(run->sim);
  return m->x_p[2 * p + d] - m->displacement_p[2 * p + d];
}

/* largest difference of two runs of the same body, K */
static double difference(const struct scene_run *a, const struct scene_run *b)
{
  const struct mpm *one = mpm_of(a->sim), *other = mpm_of(b->sim);
  double            most = 0;
  for (long p = 0; p < one->points->n; p++) {
    long   nearest = 0;
    double least = INFINITY;
    for (long q = 0; q < other->points->n; q++) {
      double r = hypot(start_of(a, p, 0) - start_of(b, q, 0), start_of(a, p, 1) - start_of(b, q, 1));
      if (r < least) least = r, nearest = q;
    }
    ck_assert_double_lt(least, 1e-9);
    most = fmax(most, fabs(one->temperature_p[p] - other->temperature_p[nearest]));
  }
  return most;
}

static void open_disk(const char *text, int basis, struct scene_run *run)
{
  const char *sets[] = {bases[basis], "numerics.transfer=apic", NULL};
  scene_open_with(text, sets, run);
}

/* half a turn and 4 cells of travel in 1.6 s; with hats, whose stress tears a body that turns, the travel alone */
#define FLIGHT(conductivity)                                                                                           \
  (_i == BASIS_LINEAR ? DISK(conductivity, "[0.25, 0.1]") : DISK(conductivity, "[\"0.25 - 2*y\", \"2*x\"]"))

/* Almost no conduction: the profile that the flight and 1000 steps leave is that of the start. */
START_TEST(profiles_ride_along)
{
  struct scene_run run;
  open_disk(FLIGHT("1e-3"), _i, &run);
  const struct mpm *m = mpm_of(run.sim);
  double            heat = scene_ledger(&run).v[LEDGER_heat];
  while (run.sim->t < 1.6) scene_step(&run, 1.6e-3);
  for (long p = 0; p < m->points->n; p++)
    ck_assert_double_eq_tol(m->temperature_p[p], 300 + 10 * start_of(&run, p, 0), 1e-3);
  ck_assert_double_eq_tol(scene_ledger(&run).v[LEDGER_heat], heat, 1e-12 * heat);
  scene_close(&run);
}
END_TEST

/* A body that conducts (alpha t = (0.13 m)2) on its flight cools as one at rest, and keeps its heat. */
START_TEST(conducts_on_the_move)
{
  struct scene_run moving, still;
  open_disk(FLIGHT("1e4"), _i, &moving);
  open_disk(DISK("1e4", "[0, 0]"), _i, &still);
  double heat = scene_ledger(&moving).v[LEDGER_heat];
  for (int i = 0; i < 1000; i++) {
    scene_step(&moving, 1.6e-3);
    scene_step(&still, 1.6e-3);
  }
  double off = difference(&moving, &still);
  printf("%s: a disk that moves is off by %.3f K of 10 K\n", bases[_i], off);
  ck_assert_double_lt(off, 0.06);
  ck_assert_double_eq_tol(scene_ledger(&moving).v[LEDGER_heat], heat, 1e-12 * heat);
  scene_close(&moving);
  scene_close(&still);
}
END_TEST

/* ---- plastic work ---- */

/* An undrained clay is sheared, k 100 Pa, beside a body without history. Without conduction every point warms by share
 * times k g V/(m c) in a step, g the step's plastic shear strain, and all of them by that share of the plastic work. */
START_TEST(plastic_work_heats)
{
  static const char text[] =
      "{\"grid\": {\"min\": [0, 0], \"max\": [2, 1], \"h\": 0.1}, \"time\": {\"end\": 10}, \"start\": \"zero\","
      "\"materials\": {\"clay\": {\"model\": \"von_mises\", \"young\": 1e5, \"poisson\": 0.3, \"shear_strength\": 100, "
      "\"density\": 1000, \"porosity\": 0.2, \"heat_capacity\": 2, \"work_to_heat\": 0.9}, \"plain\": {\"model\": "
      "\"neo_hookean\", \"young\": 1e5, \"poisson\": 0.3, \"density\": 1000, \"heat_capacity\": 2}}, \"solids\": {"
      "\"a\": {\"material\": \"clay\", \"shape\": {\"box\": {\"min\": [0.2, 0.2], \"max\": [0.8, 0.8]}}, "
      "\"velocity\": [\"0.5*y\", 0]},"
      "\"b\": {\"material\": \"plain\", \"shape\": {\"box\": {\"min\": [1.2, 0.2], \"max\": [1.8, 0.8]}}}}}";
  const char      *sets[] = {bases[_i], NULL};
  struct scene_run run;
  double          *before, *expected;
  scene_open_with(text, sets, &run);
  struct mpm *m = mpm_of(run.sim);
  long        n = m->points->n;
  double      heat = scene_ledger(&run).v[LEDGER_heat];
  must(NEW(&before, n));
  must(NEW(&expected, n));
  for (long p = 0; p < n; p++) expected[p] = 293.15;
  for (int step = 0; step < 40; step++) { /* too few to sort the points anew */
    memcpy(before, m->history_p, (size_t)n * sizeof *before);
    scene_step(&run, 1e-3);
    for (long p = 0; p < n; p++) {
      double g = sqrt(3) * (m->history_p[p] - before[p]);
      expected[p] += 0.9 * 100 * g * m->volume_p[p] / (m->mass_p[p] * 2);
      ck_assert_double_eq_tol(m->temperature_p[p], expected[p], 1e-10);
    }
  }
  struct ledger l = scene_ledger(&run);
  ck_assert_double_gt(l.v[LEDGER_plastic], 0.1);
  ck_assert_double_eq_tol(l.v[LEDGER_heat] - heat, 0.9 * l.v[LEDGER_plastic], 1e-13 * heat);
  memory_free(&before);
  memory_free(&expected);
  scene_close(&run);
}
END_TEST

/* ---- sources at nodes ---- */

/* What a stage adds to heat_source_nc, here 3 J at a node that bodies in contact share, reaches the points. */
START_TEST(sources_heat)
{
  static const char text[] =
      "{\"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.1}, \"time\": {\"end\": 10}, \"start\": \"zero\", "
      "\"contact\": {},"
      "\"materials\": {\"m\": {\"model\": \"neo_hookean\", \"young\": 1e5, \"poisson\": 0.3, \"density\": 1000, "
      "\"heat_capacity\": 2, \"conductivity\": 3}}, \"solids\": {"
      "\"a\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [0.2, 0.2], \"max\": [0.5, 0.8]}}},"
      "\"b\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [0.5, 0.2], \"max\": [0.8, 0.8]}}}}}";
  const char      *sets[] = {bases[_i], NULL};
  struct scene_run run;
  scene_open_with(text, sets, &run);
  struct mpm *m = mpm_of(run.sim);
  double      heat = scene_ledger(&run).v[LEDGER_heat], warmest = 0;
  ck_assert_ptr_nonnull(m->heat_source_nc);
  double dt = scene_step_to(&run, 1e-4, "mpm.advance_nodes");
  bool   after = false;
  m->heat_source_nc[grid_at(&run.sim->grid, 5, 5, 0)] += 3;
  for (int i = 0; i < run.plan.n_stages; i++) {
    if (after) must(run.plan.stages[i]->run(run.sim, dt));
    after = after || strcmp(run.plan.stages[i]->name, "mpm.advance_nodes") == 0;
  }
  ck_assert_double_eq_tol(scene_ledger(&run).v[LEDGER_heat], heat + 3, 1e-12 * heat);
  ck_assert_double_eq(scene_ledger(&run).v[LEDGER_heat_sides], 0);
  for (long p = 0; p < m->points->n; p++) {
    double far = hypot(m->x_p[2 * p] - 0.5, m->x_p[2 * p + 1] - 0.5);
    warmest = fmax(warmest, m->temperature_p[p] - 293.15);
    if (far > 0.3) ck_assert_double_eq_tol(m->temperature_p[p], 293.15, 1e-9);
  }
  ck_assert_double_gt(warmest, 0.05); /* 3 J in 0.01 m2 of 2e6 J/(m3 K) is 0.15 K */
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("heat_motion");
  TCase *tcase = tcase_create("heat_motion");
  tcase_add_loop_test(tcase, profiles_ride_along, 0, 4);
  tcase_add_loop_test(tcase, conducts_on_the_move, 0, 4);
  tcase_add_loop_test(tcase, plastic_work_heats, 0, 4);
  tcase_add_loop_test(tcase, sources_heat, 0, 4);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
