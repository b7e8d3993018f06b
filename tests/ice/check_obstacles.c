/* Liquid around obstacles: at rest, pushed by what moves, through slanted walls, over slopes, behind gates. */
#include "ice/obstacles.h"

#include "tests/scene_run.h"

#define LIQUID(more) "\"fluid\": {\"path\": \"ice\"" more "}, \"numerics\": {\"ice\": {\"advection\": true}}"
#define BOX(x, y, h) "\"grid\": {\"min\": [0, 0], \"max\": [" x ", " y "], \"h\": " h "}, \"time\": {\"end\": 100}, "
#define DOWN "\"gravity\": [0, -9.81], "
#define REGION(low, high) ", \"region\": {\"box\": {\"min\": " low ", \"max\": " high "}}"

static double mass(const struct scene_run *run) { return scene_ledger(run).v[LEDGER_mass_fluid]; }
static double energy(const struct scene_run *run) { return scene_ledger(run).v[LEDGER_kinetic_fluid]; }

/* nothing is where obstacles are */
static void check_closed_cells(const struct scene_run *run)
{
  const struct ice *ice = ice_of(run->sim);
  struct box        cells = grid_cells(&run->sim->grid);
  FOR_BOX_SERIAL(&run->sim->grid, cells, c) ck_assert(ice->open_cc[c] > 0 || ice->mass_cc[c] == 0);
}

/* ---- rest ---- */

/* a roof of 45 degrees under and through the surface, a ball that it cuts above, below and in the middle */
#define HILLS                                                                                                          \
  "\"obstacles\": {\"roof\": {\"shape\": {\"polygon\": [[0.313, 0], [1, 0.687], [1.687, 0]]}}, \"ball\": {\"shape\": " \
  "{\"circle\": {\"centre\": [0.33, 0.51], \"radius\": 0.13}}}}, "

START_TEST(rest)
{
  static const char *const depth[] = {"0.5", "0.512", "0.45", "0.57", "0.733"};
  char                     text[1024];
  struct scene_run         run;
  snprintf(text, sizeof text, "{" BOX("2", "1", "0.05") DOWN HILLS LIQUID(REGION("[0, 0]", "[2, %s]")) "}", depth[_i]);
  scene_open(text, &run);
  double start = mass(&run);
  scene_steps(&run, 300, 0.01);
  ck_assert_msg(energy(&run) < 0.5 * start * 1e-20, "depth %s: %g J", depth[_i], energy(&run));
  ck_assert_double_eq_tol(mass(&run), start, 1e-12 * start);
  check_closed_cells(&run);
  scene_close(&run);
}
END_TEST

/* the same in space, around a ball and a wedge */
START_TEST(rest_3d)
{
  struct scene_run run;
  scene_open(
      "{\"grid\": {\"min\": [0, 0, 0], \"max\": [1, 1, 1], \"h\": 0.1}, \"time\": {\"end\": 9}, \"gravity\": [0, "
      "0, -9.81], \"obstacles\": {\"ball\": {\"shape\": {\"sphere\": {\"centre\": [0.47, 0.52, 0.4], \"radius\": "
      "0.23}}}, \"wedge\": {\"shape\": {\"half_space\": {\"point\": [0.2, 0.2, 0], \"normal\": [1, 0.7, 1]}}}}, "
      "\"fluid\": {\"path\": \"ice\", \"region\": {\"box\": {\"min\": [0, 0, 0], \"max\": [1, 1, 0.43]}}}, "
      "\"numerics\": {\"ice\": {\"advection\": true}}}",
      &run);
  double start = mass(&run);
  scene_steps(&run, 100, 0.02);
  ck_assert_msg(energy(&run) < 0.5 * start * 1e-20, "%g J", energy(&run));
  scene_close(&run);
}
END_TEST

/* ---- what moves ---- */

/* A wall pushes in slowly, cutting cells anywhere: the water behind it stands as high as its volume says. The mean of
 * the pressure over a period of its waves. */
START_TEST(piston)
{
  struct scene_run run;
  double           sum = 0;
  scene_open("{" BOX("1", "1", "0.05") DOWN "\"obstacles\": {\"piston\": {\"shape\": {\"box\": {\"min\": [-2, null], "
                                            "\"max\": [0.113, null]}}, \"velocity\": [\"0.1*(1 - step(t - 2))\", "
                                            "0]}}, " LIQUID(REGION("[0, 0]", "[1, 0.4]")) "}",
             &run);
  const struct sim *sim = run.sim;
  double            start = mass(&run), height = 0.4 * 0.887 / 0.687;
  ck_assert_double_eq_tol(start, 1000 * 0.4 * 0.887, 0.1);
  while (sim->t < 2.1) {
    scene_step(&run, 0.02);
    ck_assert_double_lt(ice_of(sim)->now.defect_max, 2e-3);
  }
  for (int i = 0; i < 400; i++) {
    scene_step(&run, 0.01);
    sum += ice_of(sim)->P_cc[grid_at(&sim->grid, 19, 0, 0)] / 400;
  }
  ck_assert_double_eq_tol(sum, 9810 * (height - 0.025), 9810 * height * 0.005);
  ck_assert_double_eq_tol(mass(&run), start, 1e-12 * start);
  check_closed_cells(&run);
  scene_close(&run);
}
END_TEST

/* A disk starts in a full closed box: the liquid takes the energy of the added mass, rho pi r^2, and a little for the
 * walls: 1 + 2 (r/L)^2 pi^2/12 times that in a square of side L. It goes on over many cells. */
START_TEST(disk_in_a_full_box)
{
  struct scene_run run;
  scene_open(
      "{" BOX("2", "2", "0.05") "\"gravity\": [0, 0], \"start\": \"zero\", \"obstacles\": {\"disk\": {\"shape\": "
                                "{\"circle\": {\"centre\": [0.81, 1], \"radius\": 0.2}}, \"velocity\": [0.5, "
                                "0]}}, " LIQUID(", \"bulk_modulus\": \"infinite\"") "}",
      &run);
  double start = mass(&run), added = 0.5 * 1000 * M_PI * 0.04 * 0.25;
  scene_step(&run, 1e-3);
  ck_assert_msg(energy(&run) > 0.95 * added && energy(&run) < 1.15 * added, "%g J, %g is expected", energy(&run),
                added);
  while (run.sim->t < 0.8) {
    scene_step(&run, 0.02);
    ck_assert_double_lt(ice_of(run.sim)->now.defect_max, 1e-5);
  }
  ck_assert_double_eq_tol(mass(&run), start, 1e-12 * start);
  check_closed_cells(&run);
  scene_close(&run);
}
END_TEST

/* a gate holds the water, and lets it go when its time is over */
START_TEST(gate)
{
  struct scene_run run;
  scene_open("{" BOX("1", "0.6", "0.05") DOWN
             "\"obstacles\": {\"gate\": {\"shape\": {\"box\": {\"min\": [0.4, null], "
             "\"max\": [0.46, null]}}, \"until\": 0.2}}, " LIQUID(REGION("[0, 0]", "[0.4, 0.4]")) "}",
             &run);
  double start = mass(&run);
  while (run.sim->t < 0.19) scene_step(&run, 0.01);
  ck_assert_double_lt(energy(&run), 1e-20);
  while (run.sim->t < 0.5) scene_step(&run, 0.01);
  ck_assert_double_gt(energy(&run), 50);
  ck_assert_double_eq_tol(mass(&run), start, 1e-12 * start);
  scene_close(&run);
}
END_TEST

/* ---- what flows ---- */

/* volume per time through the plane of faces in front of column i, m2/s */
static double flux_at(const struct sim *sim, int i)
{
  double sum = 0;
  for (int j = 0; j < sim->grid.n[1]; j++) sum += ice_of(sim)->water_fc[grid_at(&sim->grid, i, j, 0)] * sim->grid.h;
  return sum;
}

/* Between parallel walls of slope 1/2, uniform flow parallel to them from side to side: nothing leaks, the flux is that
 * of the inlet everywhere, and the stream has its direction. */
START_TEST(slanted_channel)
{
  struct scene_run run;
  scene_open(
      "{" BOX("2", "1.6", "0.05") "\"gravity\": [0, 0], \"start\": \"zero\", \"obstacles\": {\"low\": {\"shape\": "
                                  "{\"half_space\": {\"point\": [0, 0.113], \"normal\": [-0.5, 1]}}}, \"high\": "
                                  "{\"shape\": {\"half_space\": {\"point\": [0, 0.527], \"normal\": [0.5, "
                                  "-1]}}}}, \"boundary\": {\"fluid\": {\"x_min\": {\"velocity\": [1, 0.5]}, "
                                  "\"x_max\": {\"pressure\": 0}}}, " LIQUID(
                                      ", \"bulk_modulus\": \"infinite\", \"velocity\": [1, 0.5]") "}",
      &run);
  const struct sim *sim = run.sim;
  double            start = mass(&run), most = 0;
  ck_assert_double_eq_tol(start, 1000 * 0.414 * 2, 2);
  for (int i = 0; i < 150; i++) scene_step(&run, 0.02);
  double in = flux_at(sim, 0);
  ck_assert_double_eq_tol(in, 0.414, 1e-3);
  for (int i = 0; i <= 40; i++) ck_assert_double_eq_tol(flux_at(sim, i), in, 1e-7);
  ck_assert_double_eq_tol(mass(&run), start, 1e-6 * start);
  for (int i = 10; i < 30; i++) {
    long c = grid_at(&sim->grid, i, (int)((0.32 + 0.5 * (i + 0.5) * 0.05) / 0.05), 0);
    most = fmax(most, fabs(ice_of(sim)->vel_cc[2 * c] - 1) + fabs(ice_of(sim)->vel_cc[2 * c + 1] - 0.5));
  }
  ck_assert_msg(most < 0.05, "stream off by %g", most);
  check_closed_cells(&run);
  scene_close(&run);
}
END_TEST

/* a column of water falls on a slope of 45 degrees: no energy comes from nowhere, no water is lost */
START_TEST(dam_break_on_a_slope)
{
  struct scene_run run;
  scene_open("{" BOX("1.5", "1", "0.05") DOWN
             "\"start\": \"zero\", \"obstacles\": {\"slope\": {\"shape\": {\"polygon\": "
             "[[0, 0], [0, 0.9], [0.9, 0]]}}}, " LIQUID(REGION("[0.3, 0.3]", "[0.7, 0.9]")) "}",
             &run);
  double start = mass(&run), least = INFINITY;
  while (run.sim->t < 1.5) {
    struct ledger l = scene_ledger(&run);
    double        now = l.v[LEDGER_kinetic_fluid] + l.v[LEDGER_potential];
    least = fmin(least, now);
    ck_assert_msg(now < least + 0.02 * 1236, "energy rises from %g to %g at %g s", least, now, run.sim->t);
    scene_step(&run, 0.01);
  }
  ck_assert_double_eq_tol(mass(&run), start, 1e-12 * start);
  check_closed_cells(&run);
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("ice obstacles");
  TCase *liquid = tcase_create("liquid");
  tcase_set_timeout(liquid, 120);
  tcase_add_loop_test(liquid, rest, 0, 5);
  tcase_add_test(liquid, rest_3d);
  tcase_add_test(liquid, piston);
  tcase_add_test(liquid, disk_in_a_full_box);
  tcase_add_test(liquid, gate);
  tcase_add_test(liquid, slanted_channel);
  tcase_add_test(liquid, dam_break_on_a_slope);
  suite_add_tcase(suite, liquid);
  return run_suite(suite);
}
