/* Water at rest stays at rest, bare, in a skeleton that is held, and in three dimensions; threads change no bit. */
#include "tests/twopoint/water.h"

#define WATER                                                                                                          \
  "\"title\": \"still\", \"time\": {\"end\": 1}, \"start\": \"at_rest\","                                              \
  "\"numerics\": {\"basis\": \"cubic\", \"stress_timing\": \"usl\"},"
#define BARE                                                                                                           \
  "\"fluid\": {\"path\": \"twopoint\", \"density\": 1000, \"bulk_modulus\": 2e6, \"viscosity\": 1e-3,"                 \
  "\"drag\": {\"law\": \"ergun\"}, \"region\": {\"half_space\": {\"point\": "
#define GRID2 "\"grid\": {\"min\": [0, 0], \"max\": [0.5, 1.2], \"h\": 0.05}, \"gravity\": [0, -9.81],"
#define GRID3 "\"grid\": {\"min\": [0, 0, 0], \"max\": [0.3, 1.2, 0.2], \"h\": 0.1}, \"gravity\": [0, -9.81, 0],"

static const char bare2[] = "{" WATER GRID2 BARE "[0, 1], \"normal\": [0, 1]}}}}";
static const char bare3[] = "{" WATER GRID3 BARE "[0, 1, 0], \"normal\": [0, 1, 0]}}}}";
static const char                           rock2[] =
    "{" WATER                               GRID2
    "\"materials\": {\"rock\": {\"model\": \"rigid\", \"density\": 2500, \"porosity\": 0.4, \"grain_diameter\": 1e-2}},"
    "\"solids\": {\"bed\": {\"material\": \"rock\", \"shape\": {\"box\": {\"min\": [0, 0], \"max\": [0.5, "
    "0.5]}}}}," BARE "[0, 1], \"normal\": [0, 1]}}}}";

struct figures {
  double rms, speed; /* RMS of P over rho g H, m/s */
};

static struct figures figures_of(const struct water_run *run)
{
  const struct twopoint *w = run->water;
  const double           K = 2e6, weight = 1000 * 9.81;
  int                    dim = run->sim->grid.dim;
  struct figures         f = {0, w->now.speed};
  for (long p = 0; p < w->points->n; p++) {
    double error = w->P_w[p] - K * expm1(weight * (1 - w->x_w[p * dim + 1]) / K);
    f.rms += error * error / (double)w->points->n;
  }
  f.rms = sqrt(f.rms) / weight;
  return f;
}

/* half a second; mass is exact */
static void stays(const char *scene, double rms, double speed)
{
  struct water_run run;
  struct ledger    before, after;
  water_open(scene, &run);
  ck_assert_double_lt(figures_of(&run).rms, 1e-5); /* rest pressures are integrated in steps */
  sim_measure(run.sim, &before);
  while (run.sim->t < 0.5) water_step(&run, NULL);
  sim_measure(run.sim, &after);
  struct figures f = figures_of(&run);
  ck_assert_double_lt(f.rms, rms);
  ck_assert_double_lt(f.speed, speed);
  ck_assert_double_eq(after.v[LEDGER_mass_fluid], before.v[LEDGER_mass_fluid]);
  double energy = 0;
  for (int i = LEDGER_kinetic_solid; i <= LEDGER_compression; i++) energy += after.v[i] - before.v[i];
  ck_assert_double_lt(energy, 1e-6 * before.v[LEDGER_potential]);
  water_close(&run);
}

/* what is left are the bed and the surface, where points cannot carry the weight of every node at once */
START_TEST(bare_water) { stays(bare2, 2e-3, 1e-3); }
END_TEST
START_TEST(water_in_rock) { stays(rock2, 2e-3, 1e-3); }
END_TEST
START_TEST(water_3d) { stays(bare3, 5e-3, 2e-3); }
END_TEST

/* smaller cells, smaller error: order at least 1.5 */
START_TEST(rest_converges)
{
  double rms[2];
  for (int i = 0; i < 2; i++) {
    char             scene[1024];
    struct water_run run;
    snprintf(scene, sizeof scene, "%s", bare2);
    memcpy(strstr(scene, "\"h\": 0.05"), i ? "\"h\":0.025" : "\"h\": 0.05", 9);
    water_open(scene, &run);
    while (run.sim->t < 0.2) water_step(&run, NULL);
    rms[i] = figures_of(&run).rms;
    water_close(&run);
  }
  ck_assert_double_gt(log2(rms[0] / rms[1]), 1.5);
}
END_TEST

static void few_steps(int threads, struct water_run *run)
{
  water_open(rock2, run);
  parallel_set_threads(threads);
  for (int i = 0; i < 30; i++) water_step(run, NULL);
}

START_TEST(threads_change_nothing)
{
  struct water_run one, more;
  few_steps(1, &one);
  size_t bytes = (size_t)one.water->points->n * sizeof(double);
  for (int threads = 2; threads <= 4; threads += 2) {
    few_steps(threads, &more);
    ck_assert_mem_eq(one.water->P_w, more.water->P_w, bytes);
    ck_assert_mem_eq(one.water->x_w, more.water->x_w, 2 * bytes);
    ck_assert_mem_eq(one.water->vel_w, more.water->vel_w, 2 * bytes);
    water_close(&more);
  }
  water_close(&one);
}
END_TEST

START_TEST(steps_allocate_nothing)
{
  struct water_run run;
  water_open(rock2, &run);
  long before = memory_calls();
  for (int i = 0; i < 12; i++) water_step(&run, NULL);
  ck_assert_int_eq(memory_calls(), before);
  water_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("twopoint.still_water");
  TCase *tests = tcase_create("still_water");
  tcase_add_test(tests, bare_water);
  tcase_add_test(tests, water_in_rock);
  tcase_add_test(tests, water_3d);
  tcase_add_test(tests, rest_converges);
  tcase_add_test(tests, threads_change_nothing);
  tcase_add_test(tests, steps_allocate_nothing);
  suite_add_tcase(suite, tests);
  return water_main(suite);
}
