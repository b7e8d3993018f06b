/* Sides of a liquid that carries its momentum: what flows in brings its velocity, what flows out neither comes back nor
 * grows; sides that hold, slide, open and repeat, also where they meet in a corner. */
#include "ice/ice.h"

#include "tests/scene_run.h"

#define SCENE(box, sides, more)                                                                                        \
  "{\"grid\": " box ", \"time\": {\"end\": 10}, \"start\": \"zero\", \"gravity\": [0, 0], \"boundary\": {\"fluid\": "  \
  "{" sides "}}, \"numerics\": {\"ice\": {\"advection\": true}}, \"fluid\": {\"path\": \"ice\", \"density\": 1000, "   \
  "\"bulk_modulus\": \"infinite\"" more "}}"
#define BAR "{\"min\": [0, 0], \"max\": [1, 0.2], \"h\": 0.05}"
#define BOX "{\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.0625}"

static double velocity(const struct scene_run *run, int i, int j, int d)
{
  return ice_of(run->sim)->vel_cc[2 * grid_at(&run->sim->grid, i, j, 0) + d];
}

/* largest difference of velocity component d from a value */
static double farthest(const struct scene_run *run, int d, double value)
{
  struct box cells = grid_cells(&run->sim->grid);
  double     most = 0;
  FOR_BOX_SERIAL(&run->sim->grid, cells, c) most = fmax(most, fabs(ice_of(run->sim)->vel_cc[2 * c + d] - value));
  return most;
}

static void run_to(struct scene_run *run, double t)
{
  while (run->sim->t < t - 1e-12) scene_step(run, t - run->sim->t);
}

/* an inlet that follows time pushes the whole bar along; nothing else happens */
START_TEST(inlet_in_time)
{
  struct scene_run run;
  scene_open(SCENE(BAR, "\"x_min\": {\"velocity\": [\"0.5 + 0.5*t\", 0]}, \"x_max\": {\"pressure\": 0}",
                   ", \"viscosity\": 0, \"velocity\": [0.5, 0]"),
             &run);
  double mass = scene_ledger(&run).v[LEDGER_mass_fluid];
  for (int i = 0; i < 40; i++) {
    scene_step(&run, 0.02);
    ck_assert_double_lt(farthest(&run, 0, 0.5 + 0.5 * run.sim->t), 1e-8);
    ck_assert_double_lt(farthest(&run, 1, 0), 1e-10);
  }
  ck_assert_double_eq_tol(scene_ledger(&run).v[LEDGER_mass_fluid], mass, 1e-9 * mass);
  ck_assert_double_eq_tol(scene_ledger(&run).v[LEDGER_mass_fluid_out], 0, 1e-9 * mass);
  scene_close(&run);
}
END_TEST

/* a transverse velocity that an inlet brings travels with the flow and leaves by a side of given pressure: in the end
 * the bar is all of it, and the rest of the old one does not come back */
START_TEST(inflow_carries_its_velocity)
{
  struct scene_run run;
  scene_open(SCENE("{\"min\": [0, 0], \"max\": [1, null], \"h\": 0.025}",
                   "\"x_min\": {\"velocity\": [1, 0.3]}, \"x_max\": {\"pressure\": 0}, \"y_min\": \"periodic\", "
                   "\"y_max\": \"periodic\"",
                   ", \"viscosity\": 0, \"velocity\": [1, 0]"),
             &run);
  run_to(&run, 0.5);
  ck_assert_double_eq_tol(velocity(&run, 8, 0, 1), 0.3, 0.003);
  ck_assert_double_eq_tol(velocity(&run, 32, 0, 1), 0, 0.003);
  double carried = 0;
  for (int i = 0; i < 40; i++) carried += 0.025 * velocity(&run, i, 0, 1);
  ck_assert_double_eq_tol(carried, 0.5 * 0.3, 0.002);
  run_to(&run, 2);
  ck_assert_double_lt(farthest(&run, 1, 0.3), 1e-6);
  ck_assert_double_lt(farthest(&run, 0, 1), 1e-6);
  scene_close(&run);
}
END_TEST

/* a vortex that a stream carries out through a side of given pressure: its energy goes with it and stays away */
#define VORTEX                                                                                                         \
  ", \"viscosity\": 0, \"velocity\": [\"1 - 2*(y - 0.5)*exp(-((x - 0.5)^2 + (y - 0.5)^2)/0.02)\", "                    \
  "\"2*(x - 0.5)*exp(-((x - 0.5)^2 + (y - 0.5)^2)/0.02)\"]"

START_TEST(vortex_leaves)
{
  struct scene_run run;
  scene_open(SCENE(BOX, "\"x_min\": {\"velocity\": [1, 0]}, \"x_max\": {\"pressure\": 0}", VORTEX), &run);
  double strongest = fmax(farthest(&run, 1, 0), farthest(&run, 0, 1));
  while (run.sim->t < 2) {
    scene_step(&run, 0.02);
    ck_assert_double_lt(fmax(farthest(&run, 1, 0), farthest(&run, 0, 1)), 1.5 * strongest);
  }
  ck_assert_double_lt(farthest(&run, 1, 0), 0.03 * strongest);
  ck_assert_double_lt(farthest(&run, 0, 1), 0.03 * strongest);
  scene_close(&run);
}
END_TEST

/* pressures on both ends: the bar is accelerated by their difference, whatever enters and leaves */
START_TEST(pressure_drives)
{
  struct scene_run run;
  scene_open(SCENE(BAR, "\"x_min\": {\"pressure\": 500}, \"x_max\": {\"pressure\": 0}",
                   ", \"viscosity\": 0, \"pressure\": \"500*(1 - x)\""),
             &run);
  for (int i = 0; i < 40; i++) {
    scene_step(&run, 0.02);
    ck_assert_double_lt(farthest(&run, 0, 0.5 * run.sim->t), 1e-8);
  }
  scene_close(&run);
}
END_TEST

/* an open side is one of pressure 0; smooth sides and symmetry let pass along them and nothing through */
START_TEST(sides_that_are_the_same)
{
  static const char *const one[] = {"boundary.fluid.x_max=open", "boundary.fluid.y_max=symmetry",
                                    "boundary.fluid.y_min=symmetry"};
  static const char *const other[] = {"boundary.fluid.x_max={\"pressure\":0}", "boundary.fluid.y_max=slip",
                                      "boundary.fluid.y_min=slip"};
  const char              *first[] = {one[_i], NULL}, *second[] = {other[_i], NULL};
  struct scene_run         a, b;
#define STREAM SCENE(BOX, "\"x_min\": {\"velocity\": [1, 0]}, \"x_max\": {\"pressure\": 0}", VORTEX)
  scene_open_with(STREAM, first, &a);
  scene_open_with(STREAM, second, &b);
  scene_steps(&a, 20, 0.02);
  scene_steps(&b, 20, 0.02);
  struct box cells = grid_cells(&a.sim->grid);
  FOR_BOX_SERIAL(&a.sim->grid, cells, c)
  for (int d = 0; d < 2; d++) ck_assert_double_eq(ice_of(a.sim)->vel_cc[2 * c + d], ice_of(b.sim)->vel_cc[2 * c + d]);
  scene_close(&a);
  scene_close(&b);
}
END_TEST

/* the lid of a box moves: inlet along itself, no-slip, smooth and open sides meet in its corners. Bounded, mass kept,
 * and the liquid turns */
START_TEST(sides_meet_in_corners)
{
  static const char *const last[] = {"boundary.fluid.x_max=no_slip", "boundary.fluid.x_max=slip",
                                     "boundary.fluid.x_max={\"pressure\":0}", "boundary.fluid.x_max=symmetry"};
  const char              *sets[] = {last[_i], NULL};
  struct scene_run         run;
  scene_open_with(SCENE(BOX, "\"x_min\": \"no_slip\", \"y_min\": \"slip\", \"y_max\": {\"velocity\": [1, 0]}",
                        ", \"viscosity\": 10"),
                  sets, &run);
  run_to(&run, 2);
  ck_assert_double_gt(velocity(&run, 8, 15, 0), 0.2);
  ck_assert_double_lt(velocity(&run, 8, 3, 0), _i == 2 ? 0.5 : 0);
  ck_assert_double_lt(fmax(farthest(&run, 0, 0), farthest(&run, 1, 0)), 1);
  const struct ledger l = scene_ledger(&run);
  ck_assert_double_eq_tol(l.v[LEDGER_mass_fluid], 1000, 1e-6);
  scene_close(&run);
}
END_TEST

/* what holds and repeats: a stream between periodic ends, the walls slow it and momentum is theirs */
START_TEST(periodic_stream_loses_to_walls)
{
  struct scene_run run;
  scene_open(SCENE(BAR,
                   "\"x_min\": \"periodic\", \"x_max\": \"periodic\", \"y_min\": \"no_slip\", \"y_max\": \"no_slip\"",
                   ", \"viscosity\": 1, \"velocity\": [1, 0]"),
             &run);
  double before = scene_ledger(&run).v[LEDGER_momentum_x];
  run_to(&run, 1);
  struct ledger l = scene_ledger(&run);
  ck_assert_double_lt(l.v[LEDGER_momentum_x], 0.9 * before);
  ck_assert_double_eq_tol(l.v[LEDGER_momentum_x] + l.v[LEDGER_shear_x], before, 1e-10 * before);
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("ice sides");
  TCase *sides = tcase_create("sides");
  tcase_set_timeout(sides, 120);
  tcase_add_test(sides, inlet_in_time);
  tcase_add_test(sides, inflow_carries_its_velocity);
  tcase_add_test(sides, vortex_leaves);
  tcase_add_test(sides, pressure_drives);
  tcase_add_loop_test(sides, sides_that_are_the_same, 0, 3);
  tcase_add_loop_test(sides, sides_meet_in_corners, 0, 4);
  tcase_add_test(sides, periodic_stream_loses_to_walls);
  suite_add_tcase(suite, sides);
  return run_suite(suite);
}
