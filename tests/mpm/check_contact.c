/* Bodies in contact: they push and rub, together they keep their momentum, apart they feel nothing. */
#include "mpm/mpm.h"
#include "tests/scene_run.h"

/* a slab on a slab that is stuck to the floor, without ends; h 0.025 */
#define SLAB_ON_SLAB                                                                                                   \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1, 0.4], \"h\": 0.025}, \"time\": {\"end\": 1}, \"gravity\": [0, -9.81],"    \
  "\"start\": \"at_rest\", \"materials\": {\"stone\": {\"model\": \"linear_elastic\", \"young\": 1e6, \"poisson\": 0," \
  "\"density\": 2000}}, \"boundary\": {\"solid\": {\"x_min\": \"periodic\", \"x_max\": \"periodic\", \"y_min\": "      \
  "\"no_slip\"}}, \"solids\": {\"slab\": {\"material\":"                                                               \
  "\"stone\", \"shape\": {\"box\": {\"min\": [0, 0], \"max\": [1, 0.1]}}}, \"block\": {\"material\": \"stone\","       \
  "\"shape\": {\"box\": {\"min\": [0, 0.1], \"max\": [1, 0.2]}}, \"velocity\": [0.5, 0]}},"                            \
  "\"contact\": {\"friction\": 0.3}, \"numerics\": {\"aflip_beta\": 0.05}}"

/* mean of the block's velocity; 200 kg per metre */
static double block_speed(const struct scene_run *run, int axis)
{
  const struct mpm *m = mpm_of(run->sim);
  double            mass = 0, momentum = 0;
  for (long p = 0; p < m->points->n; p++) {
    if (m->points->group[p] != 1) continue;
    mass += m->mass_p[p];
    momentum += m->mass_p[p] * m->vel_p[2 * p + axis];
  }
  return momentum / mass;
}

static double energy(const struct ledger *l)
{
  return l->v[LEDGER_kinetic_solid] + l->v[LEDGER_elastic] + l->v[LEDGER_potential];
}

/* the slab carries the block's weight and what throws it up: v = v0 - mu (g t + v_y); what it loses goes into friction
 */
START_TEST(friction_slows)
{
  static const char *const bases[] = {"numerics.basis=quadratic", "numerics.basis=cubic", "numerics.basis=gimp"};
  const char              *sets[] = {bases[_i], NULL};
  struct scene_run         run;
  scene_open_with(SLAB_ON_SLAB, sets, &run);
  while (run.sim->t < 0.1) scene_step(&run, INFINITY);
  double speed = block_speed(&run, 0), wanted = 0.5 - 0.3 * (9.81 * run.sim->t + block_speed(&run, 1));
  ck_assert_msg(fabs(speed - wanted) < 0.01 * 0.5, "%s: %g m/s, should be %g", bases[_i], speed, wanted);
  struct ledger now = scene_ledger(&run);
  double        lost = energy(&run.sim->ledger_start) - energy(&now), friction = now.v[LEDGER_friction];
  ck_assert_msg(fabs(friction - lost) < 0.02 * lost, "friction %g J, lost %g J", friction, lost);
  scene_close(&run);
}
END_TEST

/* what friction takes is found as heat */
START_TEST(friction_heats)
{
  const char      *sets[] = {"materials.stone.heat_capacity=800", "materials.stone.conductivity=2", NULL};
  struct scene_run run;
  scene_open_with(SLAB_ON_SLAB, sets, &run);
  while (run.sim->t < 0.05) scene_step(&run, INFINITY);
  struct ledger now = scene_ledger(&run);
  double        gained = now.v[LEDGER_heat] - run.sim->ledger_start.v[LEDGER_heat];
  ck_assert_double_gt(now.v[LEDGER_friction], 1);
  ck_assert_double_eq_tol(gained, now.v[LEDGER_friction], 1e-12 * now.v[LEDGER_heat]);
  scene_close(&run);
}
END_TEST

START_TEST(without_friction_it_slides)
{
  const char      *sets[] = {"contact.friction=0", NULL};
  struct scene_run run;
  scene_open_with(SLAB_ON_SLAB, sets, &run);
  while (run.sim->t < 0.1) scene_step(&run, INFINITY);
  ck_assert_double_eq_tol(block_speed(&run, 0), 0.5, 1e-10);
  ck_assert_double_eq(scene_ledger(&run).v[LEDGER_friction], 0);
  const struct mpm *m = mpm_of(run.sim);
  for (long p = 0; p < m->points->n; p++) /* it rests on the slab */
    if (m->points->group[p] == 1) ck_assert_double_lt(fabs(m->displacement_p[2 * p + 1]), 0.1 * 0.025);
  scene_close(&run);
}
END_TEST

START_TEST(infinite_friction_sticks)
{
  const char      *sets[] = {"contact.friction=infinite", "solids.block.velocity=[0, 0]", "gravity=[3, -9.81]", NULL};
  struct scene_run run;
  scene_open_with(SLAB_ON_SLAB, sets, &run);
  while (run.sim->t < 0.1) scene_step(&run, INFINITY);
  const struct mpm *m = mpm_of(run.sim);
  for (long p = 0; p < m->points->n; p++) /* its shear swings by 0.5 mm; free, it would have gone 15 mm */
    ck_assert_double_lt(fabs(m->displacement_p[2 * p]), 1e-3);
  scene_close(&run);
}
END_TEST

/* three bars in a row, the first one moves: momentum goes on, and each has its own body or shares one */
#define ROW                                                                                                            \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1.6, 0.1], \"h\": 0.02}, \"time\": {\"end\": 1}, \"materials\": {\"steel\":" \
  "{\"model\": \"linear_elastic\", \"young\": 1e6, \"poisson\": 0, \"density\": 1000}}, \"start\": \"zero\","          \
  "\"solids\": {\"a\": {\"material\": \"steel\", \"shape\": {\"box\": {\"min\": [0.2, 0], \"max\": [0.4, 0.1]}},"      \
  "\"velocity\": [0.1, 0]}, \"b\": {\"material\": \"steel\", \"shape\": {\"box\": {\"min\": [0.44, 0], \"max\":"       \
  "[0.64, 0.1]}}}, \"c\": {\"material\": \"steel\", \"shape\": {\"box\": {\"min\": [0.68, 0], \"max\": [0.88, "        \
  "0.1]}}}},"                                                                                                          \
  "\"contact\": {}, \"numerics\": {\"aflip_beta\": 0}}"

static double body_speed(const struct scene_run *run, int group)
{
  const struct mpm *m = mpm_of(run->sim);
  double            momentum = 0;
  for (long p = 0; p < m->points->n; p++)
    if (m->points->group[p] == group) momentum += m->mass_p[p] * m->vel_p[2 * p];
  return momentum / 20; /* kg/m */
}

/* equal bars hand their speed on: the last one leaves with it */
START_TEST(cradle)
{
  struct scene_run run;
  scene_open(ROW, &run);
  ck_assert_int_eq(mpm_of(run.sim)->n_bodies, 3);
  double total = 20 * 0.1;
  while (run.sim->t < 1.0) scene_step(&run, INFINITY);
  ck_assert_double_eq_tol(scene_ledger(&run).v[LEDGER_momentum_x], total, 1e-13 * total * (double)run.sim->step);
  ck_assert_msg(body_speed(&run, 2) > 0.095, "the last bar has %g m/s of 0.1", body_speed(&run, 2));
  ck_assert_double_lt(fabs(body_speed(&run, 0)), 0.004);
  ck_assert_double_lt(fabs(body_speed(&run, 1)), 0.004);
  scene_close(&run);
}
END_TEST

/* a gap of 0.04 is closed after 0.4 s; until half a cell is left nothing may happen */
START_TEST(apart_nothing_happens)
{
  struct scene_run run;
  scene_open(ROW, &run);
  while (run.sim->t < 0.29) scene_step(&run, INFINITY);
  ck_assert_double_eq_tol(body_speed(&run, 0), 0.1, 1e-13);
  ck_assert_double_eq_tol(body_speed(&run, 1), 0, 1e-13);
  scene_close(&run);
}
END_TEST

START_TEST(parts_are_one_body)
{
  const char      *sets[] = {"solids.a.part_of=left", "solids.b.part_of=left", NULL};
  struct scene_run run;
  scene_open_with(ROW, sets, &run);
  ck_assert_int_eq(run.sim->scene->n_bodies, 2);
  ck_assert_int_eq(run.sim->scene->solids[1].body, 0);
  ck_assert_int_eq(run.sim->scene->solids[2].body, 1);
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("mpm contact");
  TCase *bodies = tcase_create("bodies");
  tcase_set_timeout(bodies, 60);
  tcase_add_loop_test(bodies, friction_slows, 0, 3);
  tcase_add_test(bodies, friction_heats);
  tcase_add_test(bodies, without_friction_it_slides);
  tcase_add_test(bodies, infinite_friction_sticks);
  tcase_add_test(bodies, cradle);
  tcase_add_test(bodies, apart_nothing_happens);
  tcase_add_test(bodies, parts_are_one_body);
  suite_add_tcase(suite, bodies);
  return run_suite(suite);
}
