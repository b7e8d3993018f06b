/* The start at rest against closed forms: pressure of a compressible column, weight of the skeleton, stress of points.
 */
#include "mpm/at_rest.h"

#include "mpm/mpm.h"
#include "tests/scene_run.h"

#define SCENE(grid, rest)                                                                                              \
  "{\"grid\": {" grid "}, \"time\": {\"end\": 1}, \"materials\": {"                                                    \
  "\"sand\": {\"model\": \"linear_elastic\", \"young\": 1e7, \"poisson\": 0.3, \"density\": 2650, \"porosity\": 0.4,"  \
  "\"permeability\": 1e-3}, \"clay\": {\"model\": \"linear_elastic\", \"young\": 1e7, \"poisson\": 0.3, \"density\": " \
  "2000, \"porosity\": 0.5, \"permeability\": 1e-6}}, " rest "}"
#define FLAT "\"min\": [0, 0], \"max\": [1, 2], \"h\": 0.1"
#define DOWN "\"gravity\": [0, -9.81], "
#define SAND                                                                                                           \
  "\"solids\": {\"bed\": {\"material\": \"sand\", \"shape\": {\"box\": {\"min\": [null, null], \"max\": [null, 1]}}}}"
#define LAYERS                                                                                                         \
  "\"solids\": {\"low\": {\"material\": \"clay\", \"shape\": {\"box\": {\"min\": [null, null], \"max\": [null, "       \
  "0.6]}}},"                                                                                                           \
  "\"high\": {\"material\": \"sand\", \"shape\": {\"box\": {\"min\": [null, 0.6], \"max\": [null, 1]}}}}"
#define WATER(top, K)                                                                                                  \
  "\"fluid\": {\"path\": \"ice\", \"density\": 1000, \"bulk_modulus\": " K ", \"region\": {\"box\": {\"min\": [null, " \
  "null], \"max\": [null, " top "]}}}"

static const double g = 9.81;

static struct rest rest_at(const struct scene_run *run, double x, double y)
{
  struct rest  rest;
  const double at[3] = {x, y, 0};
  must(at_rest_column(run->sim->scene, at, &rest));
  return rest;
}

/* dP/ds = rho0 (1 + P/K) g */
static double column(double depth, double K) { return K * expm1(1000 * g * depth / K); }

START_TEST(water_alone)
{
  static const char *const words[] = {"fluid.bulk_modulus=2.2e9", "fluid.bulk_modulus=1e6"};
  static const double      K[] = {2.2e9, 1e6};
  for (int i = 0; i < 2; i++) {
    const char *const all[] = {words[i], NULL};
    struct scene_run  run;
    scene_open_with(SCENE(FLAT, DOWN WATER("1.57", "1e9")), all, &run);
    for (double y = 0.05; y < 1.5; y += 0.3) {
      double exact = column(1.57 - y, K[i]);
      ck_assert_double_eq_tol(rest_at(&run, 0.5, y).pressure, exact, 1e-10 * exact);
      ck_assert_double_eq(rest_at(&run, 0.5, y).effective, 0);
    }
    ck_assert_double_eq(rest_at(&run, 0.5, 1.6).pressure, 0);
    scene_close(&run);
  }
}
END_TEST

/* the grid's end is a surface where the water reaches it */
START_TEST(full_grid)
{
  struct scene_run run;
  scene_open(SCENE(FLAT, DOWN WATER("9", "\"infinite\"")), &run);
  ck_assert_double_eq_tol(rest_at(&run, 0.5, 0.25).pressure, 1000 * g * 1.75, 1e-8);
  scene_close(&run);
}
END_TEST

START_TEST(dry_soil)
{
  struct scene_run run;
  scene_open(SCENE(FLAT, DOWN SAND), &run);
  for (int i = 0; i < 20; i++) { /* where points are: 2 per cell */
    double y = 0.025 + 0.05 * i;
    ck_assert_double_eq_tol(rest_at(&run, 0.275, y).effective, -0.6 * 2650 * g * (1 - y), 1e-9);
    ck_assert_double_eq(rest_at(&run, 0.275, y).pressure, 0);
  }
  ck_assert_double_eq(rest_at(&run, 0.275, 1.025).effective, 0);
  scene_close(&run);
}
END_TEST

/* the water above weighs on water and grains alike: only buoyant weight counts */
START_TEST(soil_under_water)
{
  struct scene_run run;
  scene_open(SCENE(FLAT, DOWN SAND ", " WATER("1.8", "1e6")), &run);
  for (int i = 0; i < 20; i++) {
    double y = 0.025 + 0.05 * i, P = column(1.8 - y, 1e6), top = column(0.8, 1e6);
    double exact = -0.6 * (2650 * g * (1 - y) - (P - top));
    ck_assert_double_eq_tol(rest_at(&run, 0.275, y).pressure, P, 1e-10 * P);
    ck_assert_double_eq_tol(rest_at(&run, 0.275, y).effective, exact, 1e-9 * fabs(exact));
  }
  scene_close(&run);
}
END_TEST

/* dry above the water table */
START_TEST(water_table_inside_layers)
{
  struct scene_run run;
  scene_open(SCENE(FLAT, DOWN LAYERS ", " WATER("0.5", "\"infinite\"")), &run);
  double sand = 0.6 * 2650 * g * 0.4, clay = 0.5 * 2000 * g;
  ck_assert_double_eq_tol(rest_at(&run, 0.275, 0.825).effective, -0.6 * 2650 * g * 0.175, 1e-9);
  ck_assert_double_eq_tol(rest_at(&run, 0.275, 0.525).effective, -sand - clay * 0.075, 1e-9);
  ck_assert_double_eq_tol(rest_at(&run, 0.275, 0.225).effective, -sand - clay * 0.1 - 0.5 * 1000 * g * 0.275, 1e-8);
  ck_assert_double_eq_tol(rest_at(&run, 0.275, 0.225).pressure, 1000 * g * 0.275, 1e-8);
  scene_close(&run);
}
END_TEST

START_TEST(other_directions)
{
  const char *const columns[] = {"numerics.rest_steps=0", NULL};
  struct scene_run  run;
  scene_open_with(SCENE(FLAT, "\"gravity\": [4, 0], \"solids\": {\"bed\": {\"material\": \"sand\", \"shape\": "
                              "{\"box\": {\"min\": [0.5, null], \"max\": [null, null]}}}}"),
                  columns, &run);
  ck_assert_double_eq_tol(rest_at(&run, 0.825, 1).effective, -0.6 * 2650 * 4 * 0.325, 1e-9);
  const struct mpm *m = mpm_of(run.sim);
  for (long p = 0; p < m->points->n; p++) { /* lateral is what is across gravity */
    double along = -0.6 * 2650 * 4 * (m->x_p[2 * p] - 0.5);
    ck_assert_double_eq_tol(m->stress_p[6 * p], along, 1e-9);
    ck_assert_double_eq_tol(m->stress_p[6 * p + 1], along * 3 / 7, 1e-9);
    ck_assert_double_eq_tol(m->stress_p[6 * p + 2], along * 3 / 7, 1e-9);
    ck_assert_double_eq_tol(m->stress_p[6 * p + 3], 0, 1e-9);
  }
  scene_close(&run);
}
END_TEST

/* up along a slope of gravity: the column is weighed along it */
START_TEST(oblique_gravity)
{
  struct scene_run run;
  double           up[3], size;
  scene_open(SCENE(FLAT, "\"gravity\": [3, -4], " WATER("1.57", "\"infinite\"")), &run);
  at_rest_up(run.sim->scene, up, &size);
  ck_assert_double_eq_tol(size, 5, 1e-15);
  ck_assert_double_eq_tol(up[0], -0.6, 1e-15);
  ck_assert_double_eq_tol(up[1], 0.8, 1e-15);
  ck_assert_double_eq_tol(rest_at(&run, 0.95, 1.17).pressure, 1000 * 5 * 0.5, 1e-7);
  scene_close(&run);
}
END_TEST

/* a column that leaves through a periodic side goes on at the other */
START_TEST(oblique_and_periodic)
{
  struct scene_run run;
  scene_open(SCENE(FLAT, "\"gravity\": [3, -4], \"boundary\": {\"solid\": {\"x_min\": \"periodic\", \"x_max\": "
                         "\"periodic\"}}, " SAND),
             &run);
  for (double x = 0.025; x < 1; x += 0.05) {
    double effective = rest_at(&run, x, 0.225).effective;
    ck_assert_double_eq_tol(effective, -0.6 * 2650 * 5 * 0.775 / 0.8, 0.6 * 2650 * 5 * 0.05);
    ck_assert_double_eq_tol(effective, rest_at(&run, 0.525, 0.225).effective, 1e-9);
  }
  scene_close(&run);
}
END_TEST

START_TEST(nothing_to_weigh)
{
  static const char *const scenes[] = {SCENE(FLAT, "\"gravity\": [0, 0], " SAND),
                                       SCENE(FLAT, "\"gravity\": [0, \"-9.81*t\"], " SAND),
                                       SCENE(FLAT, DOWN "\"start\": \"zero\", " SAND)};
  for (int i = 0; i < 3; i++) {
    struct scene_run run;
    scene_open(scenes[i], &run);
    const struct mpm *m = mpm_of(run.sim);
    for (long q = 0; q < 6 * m->points->n; q++) ck_assert_double_eq(m->stress_p[q], 0);
    if (i < 2) ck_assert_double_eq(rest_at(&run, 0.5, 0.5).effective, 0);
    scene_close(&run);
  }
}
END_TEST

/* and a body that rests between smooth walls stays: its discrete weight is in balance to the tail of the surface */
START_TEST(soil_stays)
{
  struct scene_run run;
  scene_open(SCENE(FLAT, DOWN SAND), &run);
  const struct mpm *m = mpm_of(run.sim);
  double            moved = 0;
  while (run.sim->t < 0.5) scene_step(&run, INFINITY);
  for (long p = 0; p < m->points->n; p++) moved = fmax(moved, fabs(m->displacement_p[2 * p + 1]));
  ck_assert_double_lt(moved, 0.01 * 0.6 * 2650 * g / (2 * 1.35e7)); /* of the settlement of a sudden weight */
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("at_rest");
  TCase *tcase = tcase_create("columns");
  tcase_add_test(tcase, water_alone);
  tcase_add_test(tcase, full_grid);
  tcase_add_test(tcase, dry_soil);
  tcase_add_test(tcase, soil_under_water);
  tcase_add_test(tcase, water_table_inside_layers);
  tcase_add_test(tcase, other_directions);
  tcase_add_test(tcase, oblique_gravity);
  tcase_add_test(tcase, oblique_and_periodic);
  tcase_add_test(tcase, nothing_to_weigh);
  tcase_add_test(tcase, soil_stays);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
