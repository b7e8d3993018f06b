/* Obstacles that move, appear and vanish, thin ones, in 3D, across a periodic side, for several bodies and threads.
 * theory 3.11 */
#include "core/parallel.h"
#include "mpm/stages.h"
#include "mpm/walls.h"
#include "tests/scene_run.h"

#define GRID_ONLY "\"grid\": {\"min\": [0, 0], \"max\": [2, 1.2], \"h\": 0.1}, \"time\": {\"end\": 9}, "
#define GRID GRID_ONLY "\"start\": \"zero\", "
#define SOIL                                                                                                           \
  "\"materials\": {\"m\": {\"model\": \"linear_elastic\", \"young\": 1e6, \"poisson\": 0.3, \"density\": 1000}}, "
#define BLOCK(x0, y0, x1, y1)                                                                                          \
  "{\"material\": \"m\", \"shape\": {\"box\": {\"min\": [" #x0 ", " #y0 "], \"max\": [" #x1 ", " #y1 "]}}}"

static const struct wall_numbers *account(const struct scene_run *run, const char *name)
{
  int wall;
  ck_assert(mpm_wall_find(run->sim, name, &wall));
  return &mpm_of(run->sim)->now.wall[wall];
}

/* ---- in time ---- */

#define PLATE                                                                                                          \
  "{" GRID_ONLY "\"start\": \"at_rest\", " SOIL "\"gravity\": [0, -9.81], \"solids\": {\"s\": " BLOCK(                 \
      0.5, 0.35, 1.3,                                                                                                  \
      0.65) "}, \"obstacles\": {\"plate\": {\"friction\": \"infinite\", \"velocity\": [\"0.2*sin(20*t)\", "            \
            "\"0.05*sin(31*t)\"], \"shape\": {\"box\": {\"min\": [0.3, 0.1], \"max\": [1.5, 0.35]}}}}}"

/* the plate is where its velocity leads, the block rides on it, and the plate's work is what the block gains and loses
 */
START_TEST(moving_plate)
{
  struct scene_run run;
  double           most = 0, worst = 0;
  scene_open(PLATE, &run);
  const struct mpm *m = mpm_of(run.sim);
  struct ledger     start = scene_ledger(&run);
  while (run.sim->t < 0.5) {
    scene_step(&run, 2e-4);
    struct ledger l = scene_ledger(&run);
    double        gained = l.v[LEDGER_kinetic_solid] + l.v[LEDGER_elastic] + l.v[LEDGER_potential];
    gained -= start.v[LEDGER_kinetic_solid] + start.v[LEDGER_elastic] + start.v[LEDGER_potential];
    most = fmax(most, fabs(l.v[LEDGER_work_walls]));
    worst = fmax(worst, fabs(gained + l.v[LEDGER_friction] - l.v[LEDGER_work_walls]));
  }
  double t = run.sim->t, x = 0.01 * (1 - cos(20 * t)), y = 0.05 / 31 * (1 - cos(31 * t)), off = 0;
  ck_assert_double_eq_tol(account(&run, "plate")->displacement[0], x, 1e-7);
  ck_assert_double_eq_tol(account(&run, "plate")->displacement[1], y, 1e-7);
  for (long p = 0; p < m->points->n; p++) {
    off = fmax(off, fabs(m->displacement_p[2 * p] - x));
    off = fmax(off, fabs(m->displacement_p[2 * p + 1] - y));
  }
  ck_assert_double_lt(off, 3e-3); /* it swings a little */
  ck_assert_double_gt(most, 10);
  ck_assert_double_lt(worst, 0.03 * most);
  scene_close(&run);
}
END_TEST

/* a side that moves along itself drags with its friction, a smooth one not at all */
START_TEST(moving_side)
{
  static const char text[] =
      "{" GRID      SOIL
      "\"gravity\": [0, -9.81], \"boundary\": {\"solid\": {\"y_min\": {\"velocity\": [2, 0], \"friction\": "
      "0.3}}}, \"solids\": {\"s\": " BLOCK(0.5, 0, 1, 0.2) "}}";
  static const char *const smooth[] = {"boundary.solid.y_min.friction=0", NULL};
  for (int i = 0; i < 2; i++) {
    struct scene_run run;
    scene_open_with(text, i ? smooth : NULL, &run);
    while (run.sim->t < 0.3) scene_step(&run, 5e-4);
    struct ledger l = scene_ledger(&run);
    double        friction = i ? 0 : 0.3, t = run.sim->t, speed = friction * 9.81 * t;
    ck_assert_double_eq_tol(l.v[LEDGER_momentum_x] / 100, speed, 0.01 * speed + 1e-12);
    ck_assert_double_eq_tol(l.v[LEDGER_work_walls], friction * 981 * 2 * t, 0.01 * friction * 981 * 2 * t + 1e-12);
    scene_close(&run);
  }
}
END_TEST

/* a gate holds a body until its time, and a floor comes when it is told */
START_TEST(gates)
{
  static const char text[] = "{" GRID SOIL "\"gravity\": [0, -10], \"solids\": {\"s\": " BLOCK(
      0.5, 0.8, 0.9,
      1) "}, \"obstacles\": "
         "{\"gate\": {\"until\": 0.05, \"shape\": {\"box\": {\"min\": [0.3, 0.7], \"max\": [1.1, 0.8]}}}, \"floor\": "
         "{\"from\": 0.2, \"shape\": {\"half_space\": {\"point\": [0, 0.5], \"normal\": [0, 1]}}}}}";
  struct scene_run run;
  scene_open(text, &run);
  while (run.sim->t < 0.6) {
    scene_step(&run, 5e-4);
    bool gate = account(&run, "gate")->force[1] > 0, floor = account(&run, "floor")->force[1] > 0;
    ck_assert(!gate || run.sim->t < 0.0505);
    ck_assert(!floor || run.sim->t > 0.05 + sqrt(2 * 0.3 / 10) - 0.02);
  }
  ck_assert_double_gt(account(&run, "gate")->impulse[1], 0.5 * 0.05 * 10 * 80);
  ck_assert_double_gt(account(&run, "floor")->impulse[1], 80 * sqrt(2 * 0.3 * 10));
  const struct mpm *m = mpm_of(run.sim);
  for (long p = 0; p < m->points->n; p++) ck_assert_double_gt(m->x_p[2 * p + 1], 0.52);
  scene_close(&run);
}
END_TEST

/* what the start leans on is there before t = 0 only; distances and normals for others */
START_TEST(before_the_start)
{
  static const char text[] = "{" GRID SOIL "\"solids\": {\"s\": " BLOCK(
      0, 0, 0.4,
      1) "}, \"obstacles\": {\"gate\": {\"until\": 0, \"velocity\": [0, 1], "
         "\"shape\": {\"box\": {\"min\": [0.4, null], \"max\": [0.45, null]}}}, \"ball\": {\"shape\": {\"circle\": "
         "{\"centre\": [1.5, 0.5], \"radius\": 0.2}}}}}";
  struct scene_run run;
  double           normal[3];
  const double     near[3] = {0.5, 0.3, 0}, far[3] = {1.1, 0.5, 0};
  scene_open(text, &run);
  ck_assert_double_eq_tol(mpm_obstacle_distance(run.sim, near, 0, normal), 0.05, 1e-14);
  ck_assert_double_eq(normal[0], 1);
  ck_assert_double_eq_tol(mpm_obstacle_distance(run.sim, far, 0, normal), 0.2, 1e-14);
  ck_assert_double_eq(normal[0], -1);
  ck_assert_double_gt(mpm_obstacle_distance(run.sim, near, 1e-9, NULL), 0.7);
  ck_assert(wall_present(&run.sim->scene->obstacles[0], -1));
  double vel[3];
  wall_velocity(&run.sim->scene->obstacles[0], -1, vel);
  ck_assert_double_eq(vel[1], 0);
  scene_close(&run);
}
END_TEST

/* a moving wall limits the step to half a cell */
START_TEST(fast_walls)
{
  static const char *const sets[] = {"obstacles.plate.velocity=[\"300 + 0*t\", 400]", NULL};
  struct scene_run         run;
  scene_open_with(PLATE, sets, &run);
  ck_assert_double_eq_tol(mpm_walls_dt(run.sim), 0.5 * 0.1 / 500, 1e-15);
  scene_close(&run);
}
END_TEST

/* ---- in space ---- */

/* a wall half a cell thin keeps bodies on both sides apart from each other */
START_TEST(thin_wall)
{
  static const char text[] =
      "{" GRID      SOIL "\"gravity\": [4, 0], \"contact\": {\"friction\": 0}, \"solids\": {\"left\": " BLOCK(
               0.4, 0.3, 0.9, 0.8) ", \"right\": " BLOCK(1.05, 0.3, 1.6,
                                                         0.8) "}, \"obstacles\": {\"wall\": {\"shape\": {\"box\": {\"min\": "
                                                         "[0.9, null], \"max\": [0.95, null]}}}}}";
  struct scene_run run;
  scene_open(text, &run);
  const struct mpm *m = mpm_of(run.sim);
  while (run.sim->t < 0.25) scene_step(&run, INFINITY);
  for (long p = 0; p < m->points->n; p++) {
    bool left = m->points->group[p] == 0;
    if (left) ck_assert_double_lt(m->x_p[2 * p], 0.895);
    if (!left) ck_assert_double_eq_tol(m->vel_p[2 * p], 4 * run.sim->t, 1e-9);
  }
  ck_assert_double_eq_tol(account(&run, "wall")->impulse[0], -4 * 250 * run.sim->t, 0.2 * 4 * 250 * run.sim->t);
  scene_close(&run);
}
END_TEST

/* a plane that lies oblique to all axes: impulses along its normal, and friction against the slip */
START_TEST(oblique_in_3d)
{
  static const char text[] =
      "{\"grid\": {\"min\": [0, 0, 0], \"max\": [1, 1, 1], \"h\": 0.1}, \"time\": {\"end\": 9}, \"start\": "
      "\"zero\", " SOIL
      "\"solids\": {\"s\": {\"material\": \"m\", \"velocity\": [0.4, 0.4, -0.8], \"shape\": {\"difference\": "
      "[{\"box\": {\"min\": [0.3, 0.3, 0.3], \"max\": [0.8, 0.8, 0.8]}}, {\"half_space\": {\"point\": [0.5, 0.5, "
      "0.5], \"normal\": [1, 1, 1]}}]}}}, \"gravity\": [-5, -5, -5], \"obstacles\": {\"plane\": {\"friction\": 0.25, "
      "\"shape\": {\"half_space\": {\"point\": [0.5, 0.5, 0.5], \"normal\": [1, 1, 1]}}}}}";
  struct scene_run run;
  scene_open(text, &run);
  double              N, rest[3], slip[3] = {1 / sqrt(6), 1 / sqrt(6), -2 / sqrt(6)}, T = 0, across = 0;
  const struct ledger before = scene_ledger(&run);
  const double       *J = account(&run, "plane")->impulse;
  scene_steps(&run, 30, 2e-4);
  const struct ledger after = scene_ledger(&run);
  N = (J[0] + J[1] + J[2]) / sqrt(3);
  for (int d = 0; d < 3; d++) {
    rest[d] = J[d] - N / sqrt(3);
    T += rest[d] * slip[d];
    ck_assert_double_eq_tol(after.v[LEDGER_momentum_x + d] - before.v[LEDGER_momentum_x + d],
                            J[d] - 5 * after.v[LEDGER_mass_solid] * run.sim->t, 1e-9);
  }
  for (int d = 0; d < 3; d++) across = fmax(across, fabs(rest[d] - T * slip[d]));
  ck_assert_double_gt(N, 0.1);
  ck_assert_double_eq_tol(T, -0.25 * N, 1e-4 * N);
  ck_assert_double_lt(across, 0.02 * N); /* its corner is not symmetric about the slip */
  scene_close(&run);
}
END_TEST

/* a block that slides through a periodic side does what it does elsewhere */
START_TEST(across_a_periodic_side)
{
  static const char text[] =
      "{" GRID SOIL "\"boundary\": {\"solid\": {\"x_min\": \"periodic\", \"x_max\": \"periodic\"}}, \"gravity\": [3, "
      "-9.81], \"solids\": {\"s\": {\"material\": \"m\", \"velocity\": [1, 0], \"shape\": {\"box\": {\"min\": [0.6, "
      "0.35], \"max\": [1.1, 0.6]}}}}, \"obstacles\": {\"floor\": {\"friction\": 0.2, \"shape\": {\"half_space\": "
      "{\"point\": [0, 0.35], \"normal\": [0, 1]}}}}}";
  static const char *const sets[] = {"solids.s.shape={\"union\": [{\"box\": {\"min\": [1.6, 0.35], \"max\": [null, "
                                     "0.6]}}, {\"box\": {\"min\": [null, 0.35], \"max\": [0.1, 0.6]}}]}",
                                     NULL};
  struct scene_run         here, there;
  scene_open(text, &here);
  scene_open_with(text, sets, &there);
  scene_steps(&here, 50, 5e-4);
  scene_steps(&there, 50, 5e-4);
  ck_assert_int_eq(mpm_of(here.sim)->points->n, mpm_of(there.sim)->points->n);
  ck_assert_double_gt(account(&here, "floor")->impulse[1], 1);
  for (int d = 0; d < 2; d++) {
    double found = account(&here, "floor")->impulse[d];
    ck_assert_double_eq_tol(found, account(&there, "floor")->impulse[d], 1e-6 * fabs(found));
  }
  scene_close(&here);
  scene_close(&there);
}
END_TEST

/* two walls make a corner: both hold */
START_TEST(corner_of_two_walls)
{
  static const char text[] =
      "{" GRID_ONLY "\"start\": \"at_rest\", " SOIL "\"gravity\": [-6, -8], \"solids\": {\"s\": " BLOCK(
          0.35, 0.35, 0.8, 0.8) "}, \"obstacles\": {\"floor\": {\"shape\": {\"half_space\": {\"point\": [0, 0.35], "
                                "\"normal\": [0, 1]}}}, \"wall\": {\"shape\": {\"half_space\": {\"point\": [0.35, 0], "
                                "\"normal\": [1, 0]}}}}}";
  struct scene_run run;
  scene_open(text, &run);
  const struct mpm *m = mpm_of(run.sim);
  scene_steps(&run, 200, INFINITY);
  double mass = scene_ledger(&run).v[LEDGER_mass_solid];
  ck_assert_double_eq_tol(account(&run, "floor")->force[1], 8 * mass, 0.01 * mass);
  ck_assert_double_eq_tol(account(&run, "wall")->force[0], 6 * mass, 0.01 * mass);
  for (long p = 0; p < 2 * m->points->n; p++) ck_assert_double_lt(fabs(m->displacement_p[p]), 1e-5);
  scene_close(&run);
}
END_TEST

/* ---- bodies and threads ---- */

/* every body meets the floor by itself */
START_TEST(several_bodies)
{
  static const char text[] = "{" GRID_ONLY "\"start\": \"at_rest\", " SOIL
                             "\"gravity\": [0, -10], \"contact\": {\"friction\": 0.3}, \"solids\": "
                             "{\"a\": " BLOCK(0.3, 0.35, 0.7, 0.6) ", \"b\": " BLOCK(
                                 0.75, 0.35, 1.2, 0.7) "}, \"obstacles\": {\"floor\": {\"friction\": 0.5, "
                                                       "\"shape\": {\"half_space\": {\"point\": [0, 0.35], "
                                                       "\"normal\": [0, 1]}}}}}";
  struct scene_run run;
  scene_open(text, &run);
  struct ledger before = scene_ledger(&run);
  scene_steps(&run, 100, INFINITY);
  struct ledger after = scene_ledger(&run);
  double        weight = 10 * after.v[LEDGER_mass_solid] * run.sim->t;
  for (int d = 0; d < 2; d++)
    ck_assert_double_eq_tol(after.v[LEDGER_momentum_x + d] - before.v[LEDGER_momentum_x + d] + d * weight,
                            account(&run, "floor")->impulse[d], 1e-9 * weight);
  ck_assert_double_eq_tol(account(&run, "floor")->impulse[1], weight, 0.1 * weight);
  scene_close(&run);
}
END_TEST

static void bits_of(int threads, double *x, long *n)
{
  static const char *const sets[] = {"grid.h=0.05", "start=zero", "obstacles.plate.friction=0.3",
                                     "solids.s.velocity=[1, -1]", NULL};
  struct scene_run         run;
  scene_open_with(PLATE, sets, &run);
  parallel_set_threads(threads);
  scene_steps(&run, 30, INFINITY);
  const struct mpm *m = mpm_of(run.sim);
  *n = 2 * m->points->n;
  ck_assert_int_le(*n, 10000);
  memcpy(x, m->vel_p, (size_t)*n * sizeof *x);
  scene_close(&run);
}

START_TEST(same_bits)
{
  static double one[10000], more[10000];
  long          n, n_more;
  bits_of(1, one, &n);
  bits_of(_i, more, &n_more);
  ck_assert_int_eq(n, n_more);
  ck_assert_int_eq(memcmp(one, more, (size_t)n * sizeof *one), 0);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("obstacles");
  TCase *tcase = tcase_create("obstacles");
  tcase_add_test(tcase, moving_plate);
  tcase_add_test(tcase, moving_side);
  tcase_add_test(tcase, gates);
  tcase_add_test(tcase, before_the_start);
  tcase_add_test(tcase, fast_walls);
  tcase_add_test(tcase, thin_wall);
  tcase_add_test(tcase, oblique_in_3d);
  tcase_add_test(tcase, across_a_periodic_side);
  tcase_add_test(tcase, corner_of_two_walls);
  tcase_add_test(tcase, several_bodies);
  tcase_add_loop_test(tcase, same_bits, 2, 5);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
