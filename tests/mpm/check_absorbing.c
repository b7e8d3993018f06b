/* Absorbing sides: what comes back from them, where the energy went, and bodies that rest on them. */
#include "mpm/absorb.h"
#include "mpm/stages.h"

#include "core/parallel.h"
#include "tests/scene_run.h"

/* A bar between two absorbing ends: a pulse of 2.5 h in its middle leaves by both of them. c = 100 m/s, also of shear
 * waves where young is 2e7. */
#define BAR                                                                                                            \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1, null], \"h\": 0.02}, \"time\": {\"end\": 1}, \"start\": \"zero\","        \
  "\"materials\": {\"m\": {\"model\": \"linear_elastic\", \"young\": 1e7, \"poisson\": 0, \"density\": 1000}},"        \
  "\"solids\": {\"bar\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [0, null], \"max\": [1, null]}},"        \
  "\"velocity\": [\"0.1*exp(-((x-0.5)/0.05)^2/2)\", 0]}}, \"numerics\": {\"aflip_beta\": 0.05},"                       \
  "\"boundary\": {\"solid\": {\"x_min\": \"absorbing\", \"x_max\": \"absorbing\"}}}"

/* soil in a box whose base and sides absorb */
#define SOIL                                                                                                           \
  "{\"grid\": {\"min\": [0, 0], \"max\": [%s, 1.3], \"h\": 0.1}, \"time\": {\"end\": 1}, \"gravity\": [0, -9.81],"     \
  "\"materials\": {\"m\": {\"model\": \"linear_elastic\", \"young\": 5e6, \"poisson\": 0.3, \"density\": 2000}},"      \
  "\"solids\": {\"soil\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [null, 0], \"max\": [null, 1]}}}},"     \
  "\"tracers\": {\"base\": [0.05, 0]},"                                                                                \
  "\"boundary\": {\"solid\": {%s\"y_min\": \"absorbing\"}}}"

static const char *const bases[] = {"numerics.basis=linear", "numerics.basis=gimp", "numerics.basis=quadratic",
                                    "numerics.basis=cubic"};

static void open_soil(const char *width, const char *sides, const char *const *sets, struct scene_run *run)
{
  char text[1024];
  snprintf(text, sizeof text, SOIL, width, sides);
  scene_open_with(text, sets, run);
}

static double mechanical(const struct ledger *l)
{
  return l->v[LEDGER_kinetic_solid] + l->v[LEDGER_elastic] + l->v[LEDGER_potential];
}

static double largest_speed(const struct mpm *m)
{
  double most = 0;
  for (long p = 0; p < 2 * m->points->n; p++) most = fmax(most, fabs(m->vel_p[p]));
  return most;
}

/* Both halves of 0.05 m/s are out after 7 ms. At a fixed end they would be back, at their full height. Cubic splines
 * leave a trail of short waves of the lumped mass, which has nothing to do with the ends. */
START_TEST(a_pulse_does_not_come_back)
{
  const double     limit[] = {0.01, 0.01, 0.02, 0.05};
  const char      *sets[] = {bases[_i], NULL}, *held[] = {bases[_i], "boundary.solid.x_min=no_slip", NULL};
  struct scene_run run, fixed;
  scene_open_with(BAR, sets, &run);
  scene_open_with(BAR, held, &fixed);
  while (run.sim->t < 9e-3) scene_step(&run, 1e-4);
  while (fixed.sim->t < 9e-3) scene_step(&fixed, 1e-4);
  ck_assert_double_lt(largest_speed(mpm_of(run.sim)), limit[_i] * 0.05);
  ck_assert_double_gt(largest_speed(mpm_of(fixed.sim)), 0.8 * 0.05);
  scene_close(&run);
  scene_close(&fixed);
}
END_TEST

START_TEST(a_shear_pulse_does_not_come_back)
{
  const char      *sets[] = {"solids.bar.velocity=[0, \"0.1*exp(-((x-0.5)/0.05)^2/2)\"]",
                             "boundary.solid.y_min=periodic",
                             "boundary.solid.y_max=periodic",
                             "materials.m.young=2e7",
                             "numerics.basis=gimp",
                             NULL};
  struct scene_run run;
  scene_open_with(BAR, sets, &run);
  while (run.sim->t < 9e-3) scene_step(&run, 1e-4);
  ck_assert_double_lt(largest_speed(mpm_of(run.sim)), 0.01 * 0.05);
  scene_close(&run);
}
END_TEST

/* Energies are those of points, the dashpots' work is that of nodes with their lumped mass: 1 % for a pulse of 2.5 h, a
 * quarter of that for one of 5 h. */
START_TEST(the_ledger_holds_what_left)
{
  const char      *sets[] = {"numerics.basis=linear", "solids.bar.velocity=[\"0.1*exp(-((x-0.5)/0.1)^2/2)\", 0]", NULL};
  struct scene_run run;
  scene_open_with(BAR, sets, &run);
  double start = mechanical(&run.sim->ledger_start);
  while (run.sim->t < 8e-3) {
    scene_step(&run, 1e-4);
    struct ledger l = scene_ledger(&run);
    ck_assert_double_eq_tol(mechanical(&l) + l.v[LEDGER_absorbed], start, 5e-3 * start);
  }
  ck_assert_double_gt(scene_ledger(&run).v[LEDGER_absorbed], 0.99 * start);
  scene_close(&run);
}
END_TEST

/* the side asks for no smaller step, and at the limit of the elastic wave nothing grows */
START_TEST(it_does_not_limit_the_step)
{
  const char      *sets[] = {"numerics.dt_factor=1", bases[_i], NULL};
  struct scene_run run, free;
  const char      *by;
  scene_open_with(BAR, sets, &run);
  sets[2] = "boundary.solid.x_min=slip";
  const char *other[] = {sets[0], sets[1], "boundary.solid.x_min=slip", "boundary.solid.x_max=slip", NULL};
  scene_open_with(BAR, other, &free);
  ck_assert_double_eq(sim_dt_limit(run.sim, &run.plan, &by), sim_dt_limit(free.sim, &free.plan, &by));
  scene_steps(&run, 3000, 1);
  ck_assert_double_lt(largest_speed(mpm_of(run.sim)), 1e-3);
  scene_close(&run);
  scene_close(&free);
}
END_TEST

/* 100 periods 4 L/c of a metre of soil on an absorbing base: 6.9 s */
START_TEST(a_column_at_rest_does_not_creep)
{
  const char      *sets[] = {bases[_i], NULL};
  struct scene_run run;
  open_soil("null", "", sets, &run);
  const struct mpm *m = mpm_of(run.sim);
  while (run.sim->t < 6.9) scene_step(&run, 1);
  ck_assert_double_lt(fabs(m->x_m[1] - m->x0_m[1]), 1e-4 * run.sim->grid.h);
  scene_close(&run);
}
END_TEST

START_TEST(sides_hold_soil_at_rest)
{
  struct scene_run run;
  open_soil("1", "\"x_min\": \"absorbing\", \"x_max\": \"absorbing\",", NULL, &run);
  const struct mpm *m = mpm_of(run.sim);
  scene_steps(&run, 1000, 1);
  for (long p = 0; p < 2 * m->points->n; p++) ck_assert_double_lt(fabs(m->displacement_p[p]), 1e-4 * 0.1);
  scene_close(&run);
}
END_TEST

/* without what held it at the start the column sinks at once */
START_TEST(the_reaction_carries_the_weight)
{
  struct scene_run run;
  open_soil("null", "", NULL, &run);
  struct mpm *m = mpm_of(run.sim);
  double      held = 0;
  struct box  nodes = grid_nodes(&run.sim->grid);
  FOR_BOX_SERIAL(&run.sim->grid, nodes, c) held += m->reaction_nc[2 * c + 1];
  ck_assert_double_eq_tol(held, 2000 * 9.81 * 0.1, 1e-5 * 2000 * 9.81 * 0.1); /* a column of 0.1 x 1 m */
  memset(m->reaction_nc, 0, (size_t)(2 * run.sim->grid.size) * sizeof(double));
  scene_steps(&run, 100, 1);
  ck_assert_double_lt(m->x_m[1] - m->x0_m[1], -1e-3);
  scene_close(&run);
}
END_TEST

/* with a fluid only shear waves are taken, the normal component is held */
START_TEST(with_water_the_normal_component_is_held)
{
  const char *sets[] = {_i ? "fluid={\"path\": \"twopoint\", \"region\": {\"box\": {\"min\": [null, 0], \"max\": "
                             "[null, 1]}}}"
                           : "fluid={\"path\": \"ice\", \"region\": {\"box\": {\"min\": [null, 0], \"max\": [null, "
                             "1]}}}",
                        "materials.m.porosity=0.3", "materials.m.permeability=1e-3", NULL};
  struct scene_run run;
  open_soil("null", "", sets, &run);
  const struct mpm *m = mpm_of(run.sim);
  scene_steps(&run, 200, 1);
  ck_assert_double_lt(fabs(m->x_m[1] - m->x0_m[1]), 1e-12);
  ck_assert_double_eq(m->now.absorbed, 0);
  scene_close(&run);
}
END_TEST

START_TEST(the_same_bits_with_any_number_of_threads)
{
  struct scene_run one, more;
  scene_open(BAR, &one);
  scene_open(BAR, &more);
  scene_steps(&one, 50, 1e-4);
  parallel_set_threads(4);
  scene_steps(&more, 50, 1e-4);
  parallel_set_threads(1);
  const struct mpm *m = mpm_of(one.sim), *o = mpm_of(more.sim);
  ck_assert(memcmp(m->vel_p, o->vel_p, 2 * (size_t)m->points->n * sizeof(double)) == 0);
  ck_assert(memcmp(&m->now, &o->now, sizeof m->now) == 0);
  scene_close(&one);
  scene_close(&more);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("absorbing sides");
  TCase *tcase = tcase_create("absorbing");
  tcase_add_loop_test(tcase, a_pulse_does_not_come_back, 0, 4);
  tcase_add_test(tcase, a_shear_pulse_does_not_come_back);
  tcase_add_test(tcase, the_ledger_holds_what_left);
  tcase_add_loop_test(tcase, it_does_not_limit_the_step, 0, 4);
  tcase_add_loop_test(tcase, a_column_at_rest_does_not_creep, 0, 4);
  tcase_add_test(tcase, sides_hold_soil_at_rest);
  tcase_add_test(tcase, the_reaction_carries_the_weight);
  tcase_add_loop_test(tcase, with_water_the_normal_component_is_held, 0, 2);
  tcase_add_test(tcase, the_same_bits_with_any_number_of_threads);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
