/* Local damping: decay of a bar's first mode, the state of rest it leaves alone, and where the energy went. */
#include "mpm/stages.h"

#include "tests/scene_run.h"

/* the bar of cases/bar_vibration, started at its largest velocity; period 0.04 s */
#define BAR                                                                                                            \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1.08, null], \"h\": 0.04}, \"time\": {\"end\": 1}, \"start\": \"zero\","     \
  "\"materials\": {\"m\": {\"model\": \"linear_elastic\", \"young\": 1e7, \"poisson\": 0, \"density\": 1000}},"        \
  "\"solids\": {\"bar\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [0, null], \"max\": [1, null]}},"        \
  "\"velocity\": [\"0.1*sin(pi*x/2)\", 0]}}, \"tracers\": {\"tip\": [1, 0.02]},"                                       \
  "\"numerics\": {\"transfer\": \"flip\"}, \"boundary\": {\"solid\": {\"x_min\": \"no_slip\"}}}"

/* a soil column under its weight */
#define COLUMN                                                                                                         \
  "{\"grid\": {\"min\": [0, 0], \"max\": [null, 1.2], \"h\": 0.05}, \"time\": {\"end\": 1}, \"gravity\": [0, -9.81],"  \
  "\"materials\": {\"m\": {\"model\": \"linear_elastic\", \"young\": 1e6, \"poisson\": 0.3, \"density\": 1500}},"      \
  "\"solids\": {\"soil\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [null, 0], \"max\": [null, 1]}}}}}"

static double mechanical(const struct ledger *l)
{
  return l->v[LEDGER_kinetic_solid] + l->v[LEDGER_elastic] + l->v[LEDGER_potential];
}

/* of one component all nodes of a mode change sign together: between two turns the mode sees the mass m/(1 - alpha) on
 * its way to the middle and m/(1 + alpha) beyond it */
START_TEST(a_mode_decays_by_the_known_factor)
{
  const char      *sets[] = {"numerics.mpm.damping=0.1", NULL};
  struct scene_run run;
  double           peak[8] = {0};
  int              n = 0;
  scene_open_with(BAR, sets, &run);
  struct mpm *m = mpm_of(run.sim);
  double      before = 0, now = 0, rate = 0;
  while (n < 8) {
    scene_step(&run, 1e-4);
    double u = m->x_m[0] - m->x0_m[0], new_rate = u - now;
    if (rate != 0 && rate * new_rate < 0) peak[n++] = fabs(now);
    rate = new_rate;
    before = fmax(before, fabs(u));
    now = u;
  }
  for (int i = 1; i < n; i++) ck_assert_double_eq_tol(peak[i] / peak[i - 1], sqrt(0.9 / 1.1), 0.01);
  scene_close(&run);
}
END_TEST

START_TEST(the_ledger_holds_what_is_taken)
{
  const char      *sets[] = {"numerics.mpm.damping=0.2", NULL};
  struct scene_run run;
  scene_open_with(BAR, sets, &run);
  struct ledger start = scene_ledger(&run);
  scene_steps(&run, 400, 1e-4);
  struct ledger end = scene_ledger(&run);
  ck_assert_double_lt(mechanical(&end), 0.5 * mechanical(&start));
  ck_assert_double_eq_tol(mechanical(&end) + end.v[LEDGER_damping], mechanical(&start), 2e-3 * mechanical(&start));
  scene_close(&run);
}
END_TEST

START_TEST(a_column_comes_to_the_same_rest)
{
  const char      *sets[] = {"start=zero", "numerics.mpm.damping=0.5", NULL};
  struct scene_run run, still;
  scene_open_with(COLUMN, sets, &run);
  scene_open(COLUMN, &still);
  struct mpm *m = mpm_of(run.sim), *at_rest = mpm_of(still.sim);
  double      load = 1500 * 9.81;
  scene_steps(&run, 6000, 1e-3);
  ck_assert_double_lt(scene_ledger(&run).v[LEDGER_kinetic_solid], 1e-12 * load);
  for (long p = 0; p < m->points->n; p++)
    ck_assert_double_eq_tol(m->stress_p[6 * p + 1], at_rest->stress_p[6 * p + 1], 0.02 * load);
  scene_close(&run);
  scene_close(&still);
}
END_TEST

/* what is at rest feels nothing: the same bits with and without */
START_TEST(rest_is_left_alone)
{
  const char      *sets[] = {"gravity=[0,0]", "start=zero", "numerics.mpm.damping=0.7", NULL};
  struct scene_run run;
  scene_open_with(COLUMN, sets, &run);
  scene_steps(&run, 50, 1e-3);
  struct mpm *m = mpm_of(run.sim);
  for (long p = 0; p < 2 * m->points->n; p++) ck_assert_double_eq(m->displacement_p[p], 0);
  ck_assert_double_eq(m->now.damping, 0);
  scene_close(&run);
}
END_TEST

/* a wall that drives a bar gives whatever force it takes: its nodes are not counted. One step of even motion against
 * a weight along it. */
START_TEST(a_driven_wall_is_not_counted)
{
  const char      *sets[] = {"numerics.mpm.damping=0.3",     "boundary.solid.x_min={\"velocity\": [0.1, 0]}",
                             "solids.bar.velocity=[0.1, 0]", "numerics.wall_basis=modified",
                             "gravity=[-9.81, 0]",           NULL};
  struct scene_run run;
  scene_open_with(BAR, sets, &run);
  double      dt = scene_step(&run, 1e-4), free_mass = 0;
  struct mpm *m = mpm_of(run.sim);
  struct box  nodes = grid_nodes(&run.sim->grid), wall = nodes;
  wall.hi[0] = 1;
  FOR_BOX_SERIAL(&run.sim->grid, nodes, c) free_mass += m->mass_nc[c];
  FOR_BOX_SERIAL(&run.sim->grid, wall, c) free_mass -= m->mass_nc[c];
  double expected = dt * free_mass * 0.3 * 9.81 * (0.1 - 0.5 * dt * 1.3 * 9.81);
  ck_assert_double_eq_tol(m->now.damping, expected, 1e-12);
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("damping");
  TCase *tcase = tcase_create("local");
  tcase_add_test(tcase, a_mode_decays_by_the_known_factor);
  tcase_add_test(tcase, the_ledger_holds_what_is_taken);
  tcase_add_test(tcase, a_column_comes_to_the_same_rest);
  tcase_add_test(tcase, rest_is_left_alone);
  tcase_add_test(tcase, a_driven_wall_is_not_counted);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
