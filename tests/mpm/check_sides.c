/* Sides that hold the solid: what they give it, and sides that move. theory 3.2 */
#include "constitutive/constitutive.h"
#include "core/tensor.h"
#include "mpm/stages.h"
#include "tests/scene_run.h"

static const char *const bases[] = {"numerics.basis=linear", "numerics.basis=gimp", "numerics.basis=quadratic",
                                    "numerics.basis=cubic"};
static const char *const transfers[] = {"numerics.transfer=pic", "numerics.transfer=flip", "numerics.transfer=apic",
                                        "numerics.transfer=aflip"};
static const char *const wall_bases[] = {"numerics.wall_basis=mirrored", "numerics.wall_basis=modified"};

#define HEAD                                                                                                           \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1.2, 1], \"h\": 0.1}, \"time\": {\"end\": 1}, \"start\": \"zero\", "         \
  "\"materials\": {\"m\": {\"model\": \"linear_elastic\", \"young\": 1e6, \"poisson\": 0.3, \"density\": 1000}}, "
#define GAUGE(side) "\"" side "\": {\"kind\": \"wall\", \"on\": \"" side "\", \"of\": \"impulse_x\"}"

/* a body that fills a corner and is thrown about */
#define CORNER                                                                                                         \
  HEAD "\"gravity\": [2, -9.81], \"gauges\": {" GAUGE("x_min") ", " GAUGE("x_max") ", " GAUGE(                         \
      "y_min") "}, "                                                                                                   \
               "\"solids\": {\"s\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [0, 0], \"max\": [1.2, "      \
               "0.6]}}, "                                                                                              \
               "\"velocity\": [\"0.3*sin(4*x) + y\", \"0.4*cos(3*x)*sin(5*y)\"]}}, "

#define MOVING "{\"velocity\": [\"0.2 + 3*t\", \"-0.1*cos(9*t)\"]}"

static const char *const corners[] = {
    CORNER "\"boundary\": {}}",
    CORNER "\"boundary\": {\"solid\": {\"y_min\": \"no_slip\", \"x_max\": \"no_slip\"}}}",
    CORNER "\"boundary\": {\"solid\": {\"y_min\": " MOVING ", \"x_min\": " MOVING ", \"x_max\": " MOVING "}}}",
};
enum { CORNERS = sizeof corners / sizeof *corners };

/* momentum changes by the weight and by what the sides say they gave, in every step */
static void momentum_is_accounted_for(const char *text, const char *const *sets)
{
  struct scene_run run;
  scene_open_with(text, sets, &run);
  const struct mpm *m = mpm_of(run.sim);
  for (int i = 0; i < 20; i++) {
    struct ledger before = scene_ledger(&run);
    double        dt = scene_step(&run, INFINITY), given[2] = {0};
    struct ledger after = scene_ledger(&run);
    double        mass = after.v[LEDGER_mass_solid], weight[2] = {2 * mass, -9.81 * mass};
    for (int side = X_MIN; side <= Y_MAX; side++)
      for (int d = 0; d < 2; d++) given[d] += dt * m->now.wall[side].force[d];
    for (int d = 0; d < 2; d++) {
      double change = after.v[LEDGER_momentum_x + d] - before.v[LEDGER_momentum_x + d];
      ck_assert_double_eq_tol(change, given[d] + dt * weight[d], 1e-8); /* momenta are some 1e3 */
      ck_assert_double_gt(fabs(given[d]), 1e-4);
    }
  }
  scene_close(&run);
}

START_TEST(impulses_of_sides)
{
  for (int basis = BASIS_GIMP; basis <= BASIS_CUBIC; basis++)
    for (int wall = 0; wall < 2; wall++)
      for (int transfer = 0; transfer < 4; transfer++) {
        const char *sets[] = {bases[basis],           transfers[transfer],       wall_bases[wall],
                              "numerics.dt_max=1e-3", "numerics.aflip_beta=0.4", NULL};
        momentum_is_accounted_for(corners[_i], sets);
      }
}
END_TEST

/* at rest a side carries the weight, and what was given since the start is its integral */
START_TEST(weight_at_rest)
{
  for (int basis = 0; basis < 4; basis++)
    for (int wall = 0; wall < 2; wall++) {
      static const char column[] = HEAD "\"gravity\": [0, -10], \"gauges\": {" GAUGE("y_min") ", " GAUGE(
          "x_min") "}, \"solids\": {\"s\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [0, 0], \"max\": [1.2, "
                   "0.6]}}}}}";
      const char      *sets[] = {bases[basis], wall_bases[wall], "start=at_rest", "numerics.rest_tolerance=1e-8", NULL};
      struct scene_run run;
      scene_open_with(column, sets, &run);
      const struct wall_numbers *base = &mpm_of(run.sim)->now.wall[Y_MIN], *left = base - Y_MIN + X_MIN;
      scene_steps(&run, 50, INFINITY);
      double weight = 1000 * 1.2 * 0.6 * 10;
      ck_assert_double_eq_tol(base->force[1], weight, 1e-5 * weight);
      ck_assert_double_eq_tol(base->impulse[1], weight * run.sim->t, 1e-5 * weight * run.sim->t);
      ck_assert_double_eq_tol(base->force[0], 0, 1e-9 * weight);
      /* sides press by K0 = nu/(1 - nu) of the vertical stress */
      ck_assert_double_eq_tol(left->force[0], 0.3 / 0.7 * 0.5 * 1000 * 10 * 0.6 * 0.6, wall ? 60 : 10);
      scene_close(&run);
    }
}
END_TEST

/* a body that moves with its rough side, wherever they go, is not strained */
START_TEST(riding_on_a_side)
{
  static const char text[] = HEAD
      "\"boundary\": {\"solid\": {\"y_min\": {\"velocity\": [0.5, 0]}, \"x_min\": \"open\", \"x_max\": \"open\"}}, "
      "\"solids\": {\"s\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [0.3, 0], \"max\": [0.8, 0.5]}}, "
      "\"velocity\": [0.5, 0]}}}";
  for (int basis = 0; basis < 4; basis++)
    for (int wall = 0; wall < 2; wall++)
      for (int musl = 0; musl < 2; musl++) {
        const char      *sets[] = {bases[basis], wall_bases[wall], musl ? "numerics.stress_timing=musl" : NULL, NULL};
        struct scene_run run;
        scene_open_with(text, sets, &run);
        const struct mpm *m = mpm_of(run.sim);
        scene_steps(&run, 30, 1e-3);
        for (long p = 0; p < m->points->n; p++) {
          ck_assert_double_eq_tol(m->vel_p[2 * p], 0.5, 1e-10);
          ck_assert_double_eq_tol(m->vel_p[2 * p + 1], 0, 1e-10);
          ck_assert_double_eq_tol(m->stress_p[6 * p + XY], 0, 1e-4); /* the modulus is 1e6 */
        }
        scene_close(&run);
      }
}
END_TEST

/* what a side that moves does is the energy that the body gains */
START_TEST(work_of_a_side)
{
  static const char text[] =
      HEAD "\"boundary\": {\"solid\": {\"y_min\": {\"velocity\": [\"0.3*sin(30*t)\", 0]}}}, \"solids\": {\"s\": "
           "{\"material\": \"m\", \"shape\": {\"box\": {\"min\": [0.2, 0], \"max\": [0.9, 0.4]}}}}}";
  static const char *const sets[] = {"numerics.dt_max=2e-5", "numerics.transfer=flip", NULL};
  struct scene_run         run;
  scene_open_with(text, sets, &run);
  double most = 0, worst = 0;
  while (run.sim->t < 0.3) {
    scene_step(&run, INFINITY);
    struct ledger l = scene_ledger(&run);
    most = fmax(most, fabs(l.v[LEDGER_work_walls]));
    worst = fmax(worst, fabs(l.v[LEDGER_kinetic_solid] + l.v[LEDGER_elastic] - l.v[LEDGER_work_walls]));
  }
  ck_assert_double_gt(most, 10);
  ck_assert_double_lt(worst, 0.02 * most);
  scene_close(&run);
}
END_TEST

/* sides that neither move nor have a gauge cost nothing */
START_TEST(only_watched_sides)
{
  struct scene_run run;
  scene_open(HEAD "\"solids\": {\"s\": {\"material\": \"m\", \"shape\": \"everywhere\"}}}", &run);
  for (int i = 0; i < run.plan.n_stages; i++) ck_assert_str_ne(run.plan.stages[i]->name, "mpm.watch_sides");
  ck_assert_ptr_null(mpm_of(run.sim)->watched);
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("sides");
  TCase *tcase = tcase_create("sides");
  tcase_add_loop_test(tcase, impulses_of_sides, 0, CORNERS);
  tcase_add_test(tcase, weight_at_rest);
  tcase_add_test(tcase, riding_on_a_side);
  tcase_add_test(tcase, work_of_a_side);
  tcase_add_test(tcase, only_watched_sides);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
