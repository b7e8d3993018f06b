/* Rigid walls through scenes whose answer is known: balance on any plane, friction, gaps, points. theory 3.11 */
#include "constitutive/constitutive.h"
#include "core/tensor.h"
#include "mpm/stages.h"
#include "mpm/walls.h"
#include "tests/scene_run.h"

static const char *const bases[] = {"numerics.basis=linear", "numerics.basis=gimp", "numerics.basis=quadratic",
                                    "numerics.basis=cubic"};

#define GRID "\"grid\": {\"min\": [0, 0], \"max\": [2, 1.2], \"h\": 0.1}, \"time\": {\"end\": 9}, \"start\": \"zero\", "
#define SOIL                                                                                                           \
  "\"materials\": {\"m\": {\"model\": \"linear_elastic\", \"young\": 1e7, \"poisson\": 0.3, \"density\": 1000}}, "

static const struct wall_numbers *account(const struct scene_run *run, const char *name)
{
  int wall;
  ck_assert(mpm_wall_find(run->sim, name, &wall));
  return &mpm_of(run->sim)->now.wall[wall];
}

/* ---- balance ---- */

/* everything above a plane through (1, 0.6), and the plane */
#define HALF                                                                                                           \
  "{" GRID SOIL "\"solids\": {\"s\": {\"material\": \"m\", \"shape\": {\"difference\": [\"everywhere\", "              \
  "{\"half_space\": {\"point\": [1, 0.6], \"normal\": [%.17g, %.17g]}}]}}}, \"obstacles\": {\"plane\": "               \
  "{\"friction\": "                                                                                                    \
  "%g, \"shape\": {\"half_space\": {\"point\": [1, 0.6], \"normal\": [%.17g, %.17g]}}}}}"

static void open_half(double angle, double friction, const char *const *sets, struct scene_run *run, double n[2])
{
  char text[2048];
  n[0] = sin(angle);
  n[1] = cos(angle);
  snprintf(text, sizeof text, HALF, n[0], n[1], friction, n[0], n[1]);
  scene_open_with(text, sets, run);
}

/* Uniform pressure along the normal: whatever the angle, the lattice and the basis, the wall's pressure has just the
 * force that this stress puts on every node, so nothing moves within reach of the wall. */
START_TEST(uniform_pressure_is_balanced)
{
  for (int basis = 0; basis < 4; basis++) {
    const char      *sets[] = {bases[basis], NULL};
    struct scene_run run;
    double           n[2], moved = 0, pushed = 0, x[3];
    open_half(0.1 + 0.15 * _i, basis % 2 * 0.5, sets, &run, n);
    const struct mpm *m = mpm_of(run.sim);
    for (long p = 0; p < m->points->n; p++) {
      m->stress_p[6 * p + XX] = -1e3 * n[0] * n[0];
      m->stress_p[6 * p + YY] = -1e3 * n[1] * n[1];
      m->stress_p[6 * p + XY] = -1e3 * n[0] * n[1];
    }
    scene_step_to(&run, 1e-4, "mpm.meet_walls");
    struct box nodes = grid_nodes(&run.sim->grid);
    FOR_BOX_SERIAL(&run.sim->grid, nodes, c)
    {
      grid_node(&run.sim->grid, c, x);
      double above = (x[0] - 1) * n[0] + (x[1] - 0.6) * n[1];
      bool   edge = x[0] < 0.35 || x[0] > 1.65 || x[1] < 0.35 || x[1] > 0.85;
      if (above > 0.1 || edge || !(m->mass_nc[c] > m->mass_floor)) continue;
      for (int d = 0; d < 2; d++) {
        pushed = fmax(pushed, 1e-4 * fabs(m->force_nc[2 * c + d]));
        moved = fmax(moved, m->mass_nc[c] * fabs(m->vel_new_nc[2 * c + d]));
      }
    }
    ck_assert_double_gt(pushed, 1e-3);
    ck_assert_double_lt(moved, 2e-3 * pushed);
    scene_close(&run);
  }
}
END_TEST

/* a column that rests on a plane at any height between nodes: its weight, the stress at its lowest points, no creep */
START_TEST(column_at_rest)
{
  static const char column[] =
      "{\"grid\": {\"min\": [0, 0], \"max\": [0.3, 1.2], \"h\": 0.1}, \"time\": {\"end\": 9}, \"gravity\": [0, "
      "-10], " SOIL
      "\"solids\": {\"s\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [null, %g], \"max\": [null, 0.9]}}}}, "
      "\"obstacles\": {\"floor\": {\"shape\": {\"half_space\": {\"point\": [0, %g], \"normal\": [0, 1]}}}}}";
  double floor = 0.2 + 0.021 * _i;
  for (int basis = 0; basis < 4; basis++) {
    char             text[1024];
    const char      *sets[] = {bases[basis], "numerics.rest_tolerance=1e-6", NULL};
    struct scene_run run;
    snprintf(text, sizeof text, column, floor, floor);
    scene_open_with(text, sets, &run);
    const struct mpm *m = mpm_of(run.sim);
    double            low = INFINITY, stress = 0, mass = 0;
    for (int i = 0; i < 100; i++) {
      scene_step(&run, INFINITY);
      for (long p = 0; p < m->points->n; p++) ck_assert_double_lt(fabs(m->displacement_p[2 * p + 1]), 1e-7);
    }
    for (long p = 0; p < m->points->n; p++) {
      mass += m->mass_p[p];
      if (m->x_p[2 * p + 1] > low) continue;
      low = m->x_p[2 * p + 1];
      stress = m->stress_p[6 * p + YY];
    }
    ck_assert_double_eq_tol(account(&run, "floor")->force[1], 10 * mass, 1e-4 * mass);
    ck_assert_double_eq_tol(stress, -1e4 * (mass / 300 - 0.025), 0.03 * 7000);
    scene_close(&run);
  }
}
END_TEST

/* ---- friction ---- */

/* a block that slides down a plane of 30 deg from left to right, 1 m/s at the start */
#define BLOCK                                                                                                          \
  "{" GRID SOIL "\"gravity\": [0, -9.81], \"solids\": {\"s\": {\"material\": \"m\", \"shape\": {\"polygon\": [[0.3, "  \
  "0.82679492], [0.73301270, 0.57679492], [0.83301270, 0.75], [0.4, 1]]}, \"velocity\": [0.8660254, -0.5]}}, "         \
  "\"obstacles\": {\"slope\": {\"friction\": 0.3, \"shape\": {\"half_space\": {\"point\": [0, 1], \"normal\": [0.5, "  \
  "0.8660254037844386]}}}}}"

static const double normal[2] = {0.5, 0.8660254037844386}, down[2] = {0.8660254037844386, -0.5};

static double along(const double force[3], const double axis[2]) { return force[0] * axis[0] + force[1] * axis[1]; }

/* momentum is the weight's and the wall's, and what slides everywhere feels friction times the normal force, in every
 * step */
START_TEST(coulomb)
{
  for (int musl = 0; musl < 2; musl++) {
    const char      *sets[] = {bases[_i], musl ? "numerics.stress_timing=musl" : NULL, NULL};
    struct scene_run run;
    double           pressed = 0;
    scene_open_with(BLOCK, sets, &run);
    const struct wall_numbers *slope = account(&run, "slope");
    for (int i = 0; i < 40; i++) {
      struct ledger before = scene_ledger(&run);
      double        dt = scene_step(&run, 2e-4);
      struct ledger after = scene_ledger(&run);
      double        weight = -9.81 * after.v[LEDGER_mass_solid];
      double        N = along(slope->force, normal), T = along(slope->force, down);
      for (int d = 0; d < 2; d++)
        ck_assert_double_eq_tol(after.v[LEDGER_momentum_x + d] - before.v[LEDGER_momentum_x + d],
                                dt * (slope->force[d] + d * weight), 1e-9);
      ck_assert_double_ge(N, 0);
      ck_assert_double_eq_tol(T, -0.3 * N, 1e-9 * fabs(weight));
      pressed += dt * N;
    }
    ck_assert_double_gt(pressed, 1);
    ck_assert_double_eq_tol(along(slope->impulse, normal), pressed, 1e-9);
    scene_close(&run);
  }
}
END_TEST

/* beyond the angle of the plane the block stays, and nothing is lost; what moves is less than 1e-5 h */
START_TEST(sticks)
{
  for (int musl = 0; musl < 2; musl++) {
    const char      *sets[] = {bases[_i],
                               "solids.s.velocity=[0, 0]",
                               "obstacles.slope.friction=0.7",
                               "start=at_rest",
                               "numerics.rest_tolerance=1e-5",
                          musl ? "numerics.stress_timing=musl" : NULL,
                               NULL};
    struct scene_run run;
    scene_open_with(BLOCK, sets, &run);
    const struct mpm *m = mpm_of(run.sim);
    scene_steps(&run, 300, INFINITY);
    for (long p = 0; p < m->points->n; p++)
      for (int d = 0; d < 2; d++) ck_assert_double_lt(fabs(m->displacement_p[2 * p + d]), 1e-6);
    double weight = 9.81 * scene_ledger(&run).v[LEDGER_mass_solid];
    ck_assert_double_eq_tol(along(account(&run, "slope")->force, down), -0.5 * weight, 1e-3 * weight);
    ck_assert_double_lt(m->now.friction, 1e-7 * weight);
    scene_close(&run);
  }
}
END_TEST

/* a side with friction does what an obstacle there does */
START_TEST(side_or_obstacle)
{
  static const char side[] =
      "{" GRID SOIL "\"gravity\": [3, -9.81], \"boundary\": {\"solid\": {\"y_min\": {\"friction\": 0.2}}}, \"solids\": "
      "{\"s\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [0.3, 0], \"max\": [0.8, 0.4]}}}}}";
  static const char obstacle[] =
      "{\"grid\": {\"min\": [0, -0.5], \"max\": [2, 0.7], \"h\": 0.1}, \"time\": {\"end\": 9}, \"start\": "
      "\"zero\", " SOIL
      "\"gravity\": [3, -9.81], \"obstacles\": {\"floor\": {\"friction\": 0.2, \"shape\": {\"half_space\": {\"point\": "
      "[0, 0], \"normal\": [0, 1]}}}}, \"solids\": {\"s\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [0.3, "
      "0], \"max\": [0.8, 0.4]}}}}}";
  const char      *sets[] = {bases[_i], NULL};
  struct scene_run a, b;
  scene_open_with(side, sets, &a);
  scene_open_with(obstacle, sets, &b);
  scene_steps(&a, 60, 2e-4);
  scene_steps(&b, 60, 2e-4);
  ck_assert_double_gt(account(&a, "y_min")->impulse[1], 1);
  for (int d = 0; d < 2; d++) {
    double found = account(&a, "y_min")->impulse[d];
    ck_assert_double_eq_tol(found, account(&b, "floor")->impulse[d], 1e-5 * fabs(found));
  }
  scene_close(&a);
  scene_close(&b);
}
END_TEST

/* ---- gaps ---- */

/* nothing is felt before the body is there; then it does not go on; and it is let go */
START_TEST(gap_closes)
{
  static const char falling[] =
      "{" GRID SOIL "\"solids\": {\"s\": {\"material\": \"m\", \"velocity\": [0, -1], \"shape\": {\"box\": {\"min\": "
      "[0.5, 0.7], \"max\": [1, 0.9]}}}}, \"obstacles\": {\"floor\": {\"shape\": {\"half_space\": {\"point\": [0, "
      "0.55], \"normal\": [0, 1]}}}}}";
  const char  *sets[] = {bases[_i], NULL};
  struct scene_run run;
  double           first = INFINITY, last = 0, lowest = INFINITY;
  scene_open_with(falling, sets, &run);
  const struct mpm *m = mpm_of(run.sim);
  while (run.sim->t < 0.17) {
    scene_step(&run, 2e-4);
    ck_assert_double_ge(account(&run, "floor")->force[1], 0);
    if (account(&run, "floor")->force[1] > 0) {
      first = fmin(first, run.sim->t);
      last = run.sim->t;
    }
    for (long p = 0; p < m->points->n; p++) lowest = fmin(lowest, m->x_p[2 * p + 1]);
  }
  ck_assert_double_eq_tol(first, 0.15, 3e-4); /* a gap of 0.15 m at 1 m/s */
  ck_assert_double_lt(last, 0.158);           /* twice through the block with 116 m/s, and some */
  ck_assert_double_gt(lowest, 0.55 + 0.024);  /* half a point is 0.025 */
  ck_assert_double_gt(scene_ledger(&run).v[LEDGER_momentum_y], 20);
  scene_close(&run);
}
END_TEST

/* soil that runs over a wedge and down a bank: no point ends inside, none crept deep in a step */
START_TEST(points_stay_out)
{
  static const char soil[] =
      "{" GRID
      "\"gravity\": [0, -9.81], \"materials\": {\"m\": {\"model\": \"mohr_coulomb\", \"young\": 1e6, \"poisson\": "
      "0.3, \"density\": 2000, \"friction_angle_deg\": 25, \"cohesion\": 0}}, \"boundary\": {\"solid\": {\"y_min\": "
      "{\"friction\": 0.3}}}, \"solids\": {\"s\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [0, 0], "
      "\"max\": "
      "[0.5, 1]}}}}, \"obstacles\": {\"wedge\": {\"friction\": 0.3, \"shape\": {\"polygon\": [[0.7, -0.2], [0.7, 0], "
      "[0.85, 0.15], [1, 0], [1, -0.2]]}}, \"bank\": {\"shape\": {\"half_space\": {\"point\": [1.6, 0], \"normal\": "
      "[-0.5, 0.866]}}}}, \"numerics\": {\"aflip_beta\": 0.05}}";
  static const char *const names[] = {"y_min", "wedge", "bank"};
  struct scene_run         run;
  double                   front = 0;
  scene_open(soil, &run);
  const struct mpm *m = mpm_of(run.sim);
  while (run.sim->t < 0.9) scene_step(&run, INFINITY);
  for (long p = 0; p < m->points->n; p++) {
    const double x[3] = {m->x_p[2 * p], m->x_p[2 * p + 1], 0};
    ck_assert_double_gt(mpm_obstacle_distance(run.sim, x, run.sim->t, NULL), -1e-12);
    ck_assert_double_gt(x[1], -1e-12);
    front = fmax(front, x[0]);
  }
  ck_assert_double_gt(front, 1.3); /* it ran over the wedge */
  for (int i = 0; i < 3; i++) ck_assert_double_lt(account(&run, names[i])->depth, 0.02 * 0.1);
  scene_close(&run);
}
END_TEST

/* one point on the floor slides v^2/(2 mu g) far and lies still; what the floor gave is its weight and its momentum */
START_TEST(a_grain_alone)
{
  static const char text[] =
      "{" GRID      SOIL
      "\"gravity\": [0, -9.81], \"boundary\": {\"solid\": {\"y_min\": {\"friction\": 0.5}}}, \"solids\": {\"s\": "
      "{\"material\": \"m\", \"velocity\": [1, 0], \"shape\": {\"box\": {\"min\": [0.5, 0], \"max\": [0.55, 0.05]}}}}}";
  const char      *sets[] = {bases[_i], "numerics.aflip_beta=0.05", NULL};
  struct scene_run run;
  double           speed = 0;
  scene_open_with(text, sets, &run);
  const struct mpm *m = mpm_of(run.sim);
  ck_assert_int_eq(m->points->n, 1);
  while (run.sim->t < 0.5) {
    scene_step(&run, 5e-4);
    speed = fmax(speed, fabs(m->vel_p[1]));
  }
  ck_assert_double_eq_tol(m->displacement_p[0], 1 / (2 * 0.5 * 9.81), 1e-3);
  ck_assert_double_lt(speed, 0.01);
  ck_assert_double_lt(fabs(m->vel_p[0]), 1e-12);
  ck_assert_double_eq_tol(account(&run, "y_min")->impulse[0], -m->mass_p[0], 1e-9);
  ck_assert_double_eq_tol(account(&run, "y_min")->impulse[1], 0.5 * 9.81 * m->mass_p[0], 0.02 * m->mass_p[0]);
  ck_assert_double_eq_tol(m->now.friction, 0.5 * m->mass_p[0], 0.02 * m->mass_p[0]);
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("walls");
  TCase *tcase = tcase_create("walls");
  tcase_add_loop_test(tcase, uniform_pressure_is_balanced, 0, 7);
  tcase_add_loop_test(tcase, column_at_rest, 0, 5);
  tcase_add_loop_test(tcase, coulomb, BASIS_GIMP, 4);
  tcase_add_loop_test(tcase, sticks, BASIS_GIMP, 4);
  tcase_add_loop_test(tcase, side_or_obstacle, BASIS_GIMP, 4);
  tcase_add_loop_test(tcase, gap_closes, BASIS_GIMP, 4);
  tcase_add_test(tcase, points_stay_out);
  tcase_add_loop_test(tcase, a_grain_alone, BASIS_QUADRATIC, 4);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
