/* The static solve of a start at rest: closed forms, what it leaves alone, what it cannot hold. */
#include "mpm/settle.h"

#include "constitutive/constitutive.h"
#include "mpm/at_rest.h"
#include "tests/scene_run.h"

#define MATERIALS                                                                                                      \
  "\"time\": {\"end\": 1}, \"materials\": {\"soil\": {\"model\": \"linear_elastic\", \"young\": 2.57e6, \"poisson\": " \
  "0.33, \"density\": 2650, \"porosity\": 0.4, \"permeability\": 1e-3}}, "
#define SLOPE                                                                                                          \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1.6, 0.64], \"h\": 0.04}, \"gravity\": [0, -9.81], " MATERIALS               \
  "\"solids\": {\"slope\": {\"material\": \"soil\", \"shape\": {\"polygon\": [[0, 0], [1.0, 0], [0.5, 0.5], [0, "      \
  "0.5]]}}}, \"boundary\": {\"solid\": {\"y_min\": \"no_slip\"}}"
#define WATER                                                                                                          \
  ", \"fluid\": {\"path\": \"ice\", \"density\": 1000, \"bulk_modulus\": 2e7, \"region\": {\"box\": {\"min\": [null, " \
  "null], \"max\": [null, 0.6]}}}"

static const double g = 9.81;

static double largest(const double *v, long n)
{
  double most = 0;
  for (long i = 0; i < n; i++) most = fmax(most, fabs(v[i]));
  return most;
}

/* an endless layer under oblique gravity carries its weight by stresses that balance alone decides:
 * stress_yy = rho g_y d, stress_xy = rho g_x d */
START_TEST(layer_on_a_slope)
{
  static const char text[] =
      "{\"grid\": {\"min\": [0, 0], \"max\": [0.2, 1.2], \"h\": 0.04}, \"gravity\": [3, -9], " MATERIALS
      "\"numerics\": {\"rest_tolerance\": 1e-9}, \"solids\": {\"layer\": {\"material\": \"soil\", \"shape\": "
      "{\"box\": {\"min\": [null, null], \"max\": [null, 1]}}}}, \"boundary\": {\"solid\": {\"y_min\": \"no_slip\", "
      "\"x_min\": \"periodic\", \"x_max\": \"periodic\"}}}";
  static const char *const sets[][2] = {{NULL, NULL}, {"materials.soil.model=neo_hookean", NULL}};
  struct scene_run         run;
  scene_open_with(text, sets[_i], &run);
  const struct mpm *m = mpm_of(run.sim);
  ck_assert(m->rest.computed && m->rest.settled);
  ck_assert_double_gt(m->rest.column, 0.01);
  ck_assert_double_lt(m->rest.unbalanced, 1e-9);
  for (long p = 0; p < m->points->n; p++) {
    double depth = 1 - m->x_p[2 * p + 1], rb = 0.6 * 2650;
    ck_assert_double_eq_tol(m->stress_p[6 * p + 1], -rb * 9 * depth, 0.2 * rb * 9 * 0.04); /* of a cell's weight */
    ck_assert_double_eq_tol(m->stress_p[6 * p + 3], rb * 3 * depth, 0.2 * rb * 3 * 0.04);
  }
  scene_close(&run);
}
END_TEST

static double moved(const char *text, const char *const *sets, int steps)
{
  struct scene_run run;
  scene_open_with(text, sets, &run);
  const struct mpm *m = mpm_of(run.sim);
  scene_steps(&run, steps, INFINITY);
  double most = largest(m->displacement_p, 2 * m->points->n);
  scene_close(&run);
  return most;
}

START_TEST(slope_stays)
{
  static const char *const        columns[] = {"numerics.rest_steps=0", NULL},
                           *const basis[][3] = {{"numerics.basis=quadratic", NULL},
                                                {"numerics.basis=cubic", "numerics.transfer=flip", NULL},
                                                {"numerics.basis=gimp", "numerics.transfer=pic", NULL},
                                                {"numerics.basis=linear", NULL},
                                                {"numerics.stress_timing=musl", NULL}};
  double                          alone = moved(SLOPE "}", columns, 200), settled = moved(SLOPE "}", basis[_i], 200);
  ck_assert_double_gt(alone, 1e-4);
  ck_assert_double_lt(settled, 0.01 * alone);
}
END_TEST

/* the fluid's own scheme carries the same weight: the same stillness */
START_TEST(slope_under_water_stays)
{
  static const char *const columns[] = {"numerics.rest_steps=0", NULL};
  double                   alone = moved(SLOPE WATER "}", columns, 100), settled = moved(SLOPE WATER "}", NULL, 100);
  ck_assert_double_lt(settled, 0.01 * alone);
}
END_TEST

/* the shape given is the loaded one: places, volumes, velocities */
START_TEST(what_stays)
{
  static const char *const sets[][2] = {{NULL}, {"materials.soil.model=neo_hookean", NULL}};
  struct scene_run         run;
  scene_open_with(SLOPE ", \"tracers\": {\"crest\": [0.49, 0.49]}}", sets[_i], &run);
  const struct mpm *m = mpm_of(run.sim);
  long              n = m->points->n;
  ck_assert_int_gt(m->rest.steps, 10);
  ck_assert_double_eq(largest(m->vel_p, 2 * n), 0);
  ck_assert_double_eq(largest(m->affine_p, 4 * n), 0);
  ck_assert_double_eq(largest(m->displacement_p, 2 * n), 0);
  ck_assert_double_eq(m->x_m[0], 0.49);
  ck_assert_double_eq(run.sim->t, 0);
  ck_assert_double_eq(m->now.plastic, 0);
  for (long p = 0; p < n; p++) {
    double place = m->x_p[2 * p] / 0.02 - 0.5;
    ck_assert_double_eq_tol(place, round(place), 1e-10);
    ck_assert_double_eq(m->volume_p[p], 0.02 * 0.02);
  }
  scene_close(&run);
}
END_TEST

/* a law that knows F alone finds in F the stress that the solve left */
START_TEST(stress_follows_from_F)
{
  static const char *const sets[] = {"materials.soil.model=neo_hookean", NULL};
  struct scene_run         run;
  scene_open_with(SLOPE "}", sets, &run);
  const struct mpm      *m = mpm_of(run.sim);
  const struct material *material = scene_material(run.sim->scene, 0);
  for (long p = 0; p < m->points->n; p++) {
    const double *F = m->F_p + 4 * p;
    double        wide[9] = {F[0], F[1], 0, F[2], F[3], 0, 0, 0, 1}, stress[6];
    material->model->update(material->model_params, 1, 0, wide, wide, stress, NULL, NULL);
    for (int k = 0; k < 6; k++) ck_assert_double_eq_tol(stress[k], m->stress_p[6 * p + k], 1e-6);
  }
  scene_close(&run);
}
END_TEST

/* a start with velocity keeps it: stress is that of rest */
START_TEST(velocity_is_kept)
{
  static const char *const sets[] = {"solids.slope.velocity=[\"y\", 0.5]", NULL};
  struct scene_run         run, still;
  scene_open_with(SLOPE "}", sets, &run);
  scene_open(SLOPE "}", &still);
  const struct mpm *m = mpm_of(run.sim), *s = mpm_of(still.sim);
  for (long p = 0; p < m->points->n; p++) {
    ck_assert_double_eq(m->vel_p[2 * p], m->x_p[2 * p + 1]);
    ck_assert_double_eq(m->vel_p[2 * p + 1], 0.5);
  }
  ck_assert_int_eq(memcmp(m->stress_p, s->stress_p, (size_t)m->points->n * 6 * sizeof(double)), 0);
  scene_close(&run);
  scene_close(&still);
}
END_TEST

/* walls stand still and loads wait for the run */
START_TEST(what_does_not_act)
{
  static const char *const moving[] = {
      "boundary.solid.y_min={\"velocity\": [1, 0]}",
      "loads={\"top\": {\"on\": {\"box\": {\"min\": [0, 0.5], \"max\": [0.5, 0.5]}}, \"traction\": [0, -1e4]}}",
      "gravity=[\"5*t\", \"-9.81*(1+t)\"]", NULL};
  struct scene_run run, still;
  scene_open_with(SLOPE "}", moving, &run);
  scene_open(SLOPE "}", &still);
  const struct mpm *m = mpm_of(run.sim), *s = mpm_of(still.sim);
  ck_assert(m->rest.settled);
  ck_assert_int_eq(memcmp(m->stress_p, s->stress_p, (size_t)m->points->n * 6 * sizeof(double)), 0);
  ck_assert_double_eq(m->now.work_loads, 0);
  scene_close(&run);
  scene_close(&still);
}
END_TEST

START_TEST(threads_do_not_matter)
{
  static const char *const few[] = {"numerics.rest_steps=20", NULL};
  struct scene_run         one, many;
  scene_open_with(SLOPE WATER "}", few, &one);
  scene_open_with(SLOPE WATER "}", few, &many);
  const struct mpm *m = mpm_of(one.sim);
  for (int threads = 2; threads <= 4; threads += 2) {
    sim_destroy(&many.sim);
    parallel_set_threads(threads);
    must(sim_create(&many.loaded->scene, &many.plan, &many.sim));
    const struct mpm *other = mpm_of(many.sim);
    ck_assert_int_eq(other->rest.steps, m->rest.steps);
    ck_assert_int_eq(memcmp(m->stress_p, other->stress_p, (size_t)m->points->n * 6 * sizeof(double)), 0);
  }
  scene_close(&many);
  scene_close(&one);
}
END_TEST

/* Steep soil yields to a state that holds, inside its strength and with no history; without cohesion nothing holds it.
 * Taylor's stability number of 45 degrees and phi 23 is 0.055: 480 Pa hold it at the limit. */
START_TEST(plastic_slope)
{
  static const char *const cohesion[] = {"materials.soil.cohesion=780", "materials.soil.cohesion=240"};
  const char *const        sets[] = {
             "materials.soil={\"model\": \"mohr_coulomb\", \"young\": 2.57e6, \"poisson\": 0.33, \"density\": 1682, "
                    "\"friction_angle_deg\": 23, \"tension_strength\": 0}",
             cohesion[_i], NULL};
  struct scene_run run;
  scene_open_with(SLOPE "}", sets, &run);
  const struct mpm      *m = mpm_of(run.sim);
  const struct material *material = scene_material(run.sim->scene, 0);
  double                 outside = 0;
  ck_assert(m->rest.settled == (_i == 0));
  if (_i == 1) ck_assert_double_gt(m->rest.unbalanced, 0.01);
  ck_assert_double_eq(m->now.plastic, 0);
  ck_assert_double_eq(largest(m->history_p, m->points->n * run.sim->scene->n_history), 0);
  for (long p = 0; p < m->points->n; p++)
    outside = fmax(outside, material->model->yield(material->model_params, m->stress_p + 6 * p, m->history_p));
  ck_assert_double_lt(outside, 1e-6 * 1682 * g * 0.5);
  scene_close(&run);
}
END_TEST

/* in mid-air */
START_TEST(nothing_holds_it)
{
  static const char text[] =
      "{\"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.05}, \"gravity\": [0, -9.81], " MATERIALS
      "\"solids\": {\"block\": {\"material\": \"soil\", \"shape\": {\"box\": {\"min\": [0.4, 0.4], \"max\": [0.6, "
      "0.7]}}}}}";
  struct scene_run run;
  scene_open(text, &run);
  const struct mpm *m = mpm_of(run.sim);
  ck_assert(m->rest.computed && !m->rest.settled);
  ck_assert_double_gt(m->rest.unbalanced, 0.9);
  ck_assert_int_lt(m->rest.steps, 2000);
  scene_close(&run);
}
END_TEST

/* columns stand by themselves but for the share of the nodes beyond the surface */
START_TEST(level_ground)
{
  static const char text[] =
      "{\"grid\": {\"min\": [0, 0], \"max\": [0.2, 1.2], \"h\": 0.05}, \"gravity\": [0, -9.81], " MATERIALS
      "\"solids\": {\"bed\": {\"material\": \"soil\", \"shape\": {\"box\": {\"min\": [null, null], \"max\": [null, "
      "1]}}}}}";
  static const char *const columns[] = {"numerics.rest_steps=0", NULL};
  struct scene_run         run, only;
  scene_open(text, &run);
  scene_open_with(text, columns, &only);
  const struct mpm *m = mpm_of(run.sim), *o = mpm_of(only.sim);
  ck_assert_double_lt(m->rest.column, 0.1);
  ck_assert_int_lt(m->rest.steps, 100);
  for (long p = 0; p < m->points->n; p++)
    for (int k = 0; k < 6; k++)
      ck_assert_double_eq_tol(m->stress_p[6 * p + k], o->stress_p[6 * p + k], 0.01 * 0.6 * 2650 * g);
  scene_close(&run);
  scene_close(&only);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("settle");
  TCase *tcase = tcase_create("static solve");
  tcase_add_loop_test(tcase, layer_on_a_slope, 0, 2);
  tcase_add_loop_test(tcase, slope_stays, 0, 5);
  tcase_add_test(tcase, slope_under_water_stays);
  tcase_add_loop_test(tcase, what_stays, 0, 2);
  tcase_add_test(tcase, stress_follows_from_F);
  tcase_add_test(tcase, velocity_is_kept);
  tcase_add_test(tcase, what_does_not_act);
  tcase_add_test(tcase, threads_do_not_matter);
  tcase_add_loop_test(tcase, plastic_slope, 0, 2);
  tcase_add_test(tcase, nothing_holds_it);
  tcase_add_test(tcase, level_ground);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
