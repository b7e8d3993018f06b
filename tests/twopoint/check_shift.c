/* Points that crowd together part again, and nothing else changes; those in balance stay. */
#include "mpm/mpm.h"
#include "tests/twopoint/water.h"

#define SCENE(dim_grid, numerics)                                                                                      \
  "{\"title\": \"t\", \"grid\": " dim_grid ", \"gravity\": [0, 0], \"start\": \"zero\", \"time\": {\"end\": 1},"       \
  "\"fluid\": {\"path\": \"twopoint\", \"density\": 1000, \"bulk_modulus\": 2e6, \"region\": \"everywhere\"},"         \
  "\"numerics\": {\"basis\": \"cubic\"" numerics "}}"
#define GRID2 "{\"min\": [0, 0], \"max\": [0.8, 0.6], \"h\": 0.1}"
#define JITTER ", \"twopoint\": {\"jitter\": 0.4}"

static double excess(struct water_run *run)
{
  const struct twopoint *w = run->water;
  double                 sum = 0;
  struct box             nodes = grid_nodes(&run->sim->grid);
  water_ok(twopoint_gather_water(run->sim, 0));
  FOR_BOX_SERIAL(&run->sim->grid, nodes, i)
  {
    double e = fmax(0, w->water_volume_nc[i] / w->water_room_nc[i] - 1);
    sum += w->water_room_nc[i] * e * e;
  }
  return sum;
}

/* every correction lowers what it descends on; after many little is left beyond what is tolerated */
START_TEST(crowds_part)
{
  struct water_run run;
  water_open(SCENE(GRID2, JITTER), &run);
  double before = excess(&run), first = before;
  for (int i = 0; i < 300; i++) {
    water_ok(twopoint_shift_points(run.sim, 0));
    double now = excess(&run);
    ck_assert_double_le(now, before * (1 + 1e-12));
    before = now;
  }
  ck_assert_double_lt(before, 0.01 * first);
  water_close(&run);
}
END_TEST

START_TEST(only_places_change)
{
  struct water_run run;
  struct ledger    before, after;
  water_open(SCENE(GRID2, JITTER), &run);
  for (int i = 0; i < 5; i++) water_step(&run, NULL);
  sim_measure(run.sim, &before);
  excess(&run);
  water_ok(twopoint_shift_points(run.sim, 0));
  sim_measure(run.sim, &after);
  ck_assert_double_eq(after.v[LEDGER_momentum_x], before.v[LEDGER_momentum_x]);
  ck_assert_double_eq(after.v[LEDGER_kinetic_fluid], before.v[LEDGER_kinetic_fluid]);
  ck_assert_double_eq(after.v[LEDGER_compression], before.v[LEDGER_compression]);
  water_close(&run);
}
END_TEST

START_TEST(a_lattice_stays)
{
  struct water_run run;
  water_open(SCENE(GRID2, ""), &run);
  size_t  bytes = (size_t)run.water->points->n * 2 * sizeof(double);
  double *x = malloc(bytes);
  memcpy(x, run.water->x_w, bytes);
  excess(&run);
  water_ok(twopoint_shift_points(run.sim, 0));
  ck_assert_mem_eq(x, run.water->x_w, bytes);
  free(x);
  water_close(&run);
}
END_TEST

/* points that are alike start alike, others do not */
START_TEST(jitter_follows_the_seed)
{
  struct water_run run[3];
  for (int i = 0; i < 3; i++)
    water_open(i == 2 ? SCENE(GRID2, JITTER "}, \"seed\": 2, \"output\": {") : SCENE(GRID2, JITTER), &run[i]);
  size_t bytes = (size_t)run[0].water->points->n * 2 * sizeof(double);
  double far = 0;
  ck_assert_mem_eq(run[0].water->x_w, run[1].water->x_w, bytes);
  for (long i = 0; i < 20; i++) far = fmax(far, fabs(run[0].water->x_w[i] - run[2].water->x_w[i]));
  ck_assert_double_gt(far, 1e-3);
  for (int i = 0; i < 3; i++) water_close(&run[i]);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("twopoint.shift");
  TCase *tests = tcase_create("shift");
  tcase_add_test(tests, crowds_part);
  tcase_add_test(tests, only_places_change);
  tcase_add_test(tests, a_lattice_stays);
  tcase_add_test(tests, jitter_follows_the_seed);
  suite_add_tcase(suite, tests);
  return water_main(suite);
}
