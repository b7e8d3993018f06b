/* Several fluids with one velocity: layers at rest, a drop that travels, a standing wave under air, names of fields. */
#include "ice/ice.h"

#include "mpm/mpm.h"
#include "run/fields.h"
#include "tests/scene_run.h"

#define DOWN ", \"gravity\": [0, -9.81]"
#define MOVING ", \"numerics\": {\"dt_max\": 1e-3, \"ice\": {\"advection\": true}}"
#define WATER(more)                                                                                                    \
  ", \"fluid\": {\"path\": \"ice\", \"eos\": {\"law\": \"linear_water\", \"reference_pressure\": 101325}" more "}"
#define BELOW(y) ", \"region\": {\"box\": {\"min\": [null, null], \"max\": [null, " y "]}}"
#define AIR ", \"fluids\": {\"air\": {}}"
#define COLUMN "\"grid\": {\"min\": [0, 0], \"max\": [0.2, 2], \"h\": 0.05}, \"time\": {\"end\": 10}"
#define OIL                                                                                                            \
  ", \"fluids\": {\"oil\": {\"density\": 850, \"bulk_modulus\": 1.5e9, \"viscosity\": 0.05, \"eos\": {\"law\": "       \
  "\"linear_water\", \"reference_pressure\": 101325}, \"region\": {\"box\": {\"min\": [null, null], \"max\": [null, "  \
  "1.23]}}}, \"air\": {}}"
#define TANK "\"grid\": {\"min\": [0, 0], \"max\": [0.3, 0.4], \"h\": 0.02}, \"time\": {\"end\": 10}"
#define STONES                                                                                                         \
  ", \"materials\": {\"stone\": {\"model\": \"rigid\", \"density\": 2650, \"porosity\": 0.49, \"grain_diameter\": "    \
  "0.016, \"permeability\": 0.1}}, \"solids\": {\"dam\": {\"material\": \"stone\", \"shape\": {\"box\": {\"min\": "    \
  "[0.1, 0], \"max\": [0.2, 0.4]}}}}"

static double fastest(const struct scene_run *run)
{
  const struct ice  *ice = ice_of(run->sim);
  const struct grid *g = &run->sim->grid;
  struct box         cells = grid_cells(g);
  double             most = ice->now.speed;
  FOR_BOX_SERIAL(g, cells, c)
  for (int d = 0; d < g->dim; d++) most = fmax(most, fabs(ice->vel_cc[c * g->dim + d]));
  return most;
}

/* ---- rest ---- */

static const struct {
  const char *text;
  double      base; /* Pa: lowest cell, 0: not known */
} still[] = {
    {"{" COLUMN DOWN WATER(BELOW("1")) AIR MOVING "}", 110901.314},
    {"{" COLUMN DOWN WATER(BELOW("1.02")) AIR MOVING "}", 0},
    {"{" COLUMN DOWN WATER(BELOW("1.04")) AIR MOVING "}", 0},
    {"{" COLUMN DOWN WATER(BELOW("1")) AIR MOVING ", \"boundary\": {\"fluid\": {\"y_max\": \"open\"}}}", 110901.314},
    {"{" COLUMN DOWN WATER(BELOW("0.61")) OIL MOVING "}", 0}, /* three layers */
    {"{" COLUMN ", \"gravity\": [0, 9.81]" WATER(
         ", \"region\": {\"box\": {\"min\": [null, 1.01], \"max\": [null, null]}}") AIR MOVING "}",
     0},
    {"{" TANK DOWN WATER(BELOW("0.2")) AIR STONES MOVING "}", 0},
    {"{" TANK DOWN WATER(BELOW("0.207")) AIR STONES MOVING "}", 0},
    {"{\"grid\": {\"min\": [0, 0, 0], \"max\": [0.15, 0.5, 0.1], \"h\": 0.05}, \"time\": {\"end\": 1}, \"gravity\": "
     "[0, -9.81, 0], \"fluid\": {\"path\": \"ice\", \"eos\": {\"law\": \"linear_water\", \"reference_pressure\": "
     "101325}, \"region\": {\"box\": {\"min\": [null, null, null], \"max\": [null, 0.22, null]}}}" AIR MOVING "}",
     0},
};
enum { STILL = sizeof still / sizeof *still };

START_TEST(layers_stay)
{
  for (int hypre = 0; hypre < 2; hypre++) {
    const char      *sets[] = {hypre ? "numerics.pressure_solver=hypre" : "numerics.pressure_solver=direct", NULL};
    struct scene_run run;
    scene_open_with(still[_i].text, sets, &run);
    const struct ice *ice = ice_of(run.sim);
    long              base = grid_at(&run.sim->grid, 1, 0, 0);
    double            P = ice->P_cc[base];
    struct ledger     before = scene_ledger(&run), after;
    if (still[_i].base > 0) ck_assert_double_eq_tol(P, still[_i].base, 1e-3);
    scene_steps(&run, 200, INFINITY);
    after = scene_ledger(&run);
    ck_assert_msg(fastest(&run) < 1e-10, "%g m/s", fastest(&run));
    ck_assert_double_eq_tol(ice->P_cc[base], P, 1e-9 * P);
    for (int e = 0; e < 2; e++) {
      int entry = e ? LEDGER_mass_others : LEDGER_mass_fluid;
      ck_assert_double_gt(before.v[entry], 1e-3);
      ck_assert_double_eq_tol(after.v[entry], before.v[entry], 1e-14 * before.v[entry]);
    }
    scene_close(&run);
  }
}
END_TEST

/* ---- a drop ---- */

#define RING                                                                                                           \
  ", \"boundary\": {\"fluid\": {\"x_min\": \"periodic\", \"x_max\": \"periodic\", \"y_min\": \"periodic\", "           \
  "\"y_max\": \"periodic\"}}"
#define DROP(velocity)                                                                                                 \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.05}, \"time\": {\"end\": 10}" WATER(                         \
      ", \"velocity\": " velocity                                                                                      \
      ", \"region\": {\"circle\": {\"centre\": [0.5, 0.5], \"radius\": 0.2}}") ", \"fluids\": {\"air\": "              \
                                                                               "{\"velocity\": [1, 0.5]}}" RING        \
                                                                               ", \"numerics\": {\"dt_max\": 0.02, "   \
                                                                               "\"ice\": {\"advection\": true}}}"

/* what moves together goes on together, with a ratio of densities of 1000 */
START_TEST(common_motion)
{
  struct scene_run run;
  scene_open(DROP("[1, 0.5]"), &run);
  const struct ice *ice = ice_of(run.sim);
  struct box        cells = grid_cells(&run.sim->grid);
  scene_steps(&run, 100, INFINITY);
  ck_assert_double_gt(run.sim->t, 1);
  FOR_BOX_SERIAL(&run.sim->grid, cells, c)
  {
    ck_assert_double_eq_tol(ice->vel_cc[2 * c], 1, 1e-9);
    ck_assert_double_eq_tol(ice->vel_cc[2 * c + 1], 0.5, 1e-9);
    ck_assert_double_eq_tol(ice->P_cc[c], 101325, 1e-3);
  }
  scene_close(&run);
}
END_TEST

/* a drop flies into air: momentum and both masses stay, the air does not get faster than the drop pushes it */
START_TEST(drop_in_air)
{
  struct scene_run run;
  scene_open(DROP("[3, -1]"), &run);
  struct ledger before = scene_ledger(&run), after;
  scene_steps(&run, 200, INFINITY);
  after = scene_ledger(&run);
  for (int d = 0; d < 2; d++) {
    double p = before.v[LEDGER_momentum_x + d];
    ck_assert_double_eq_tol(after.v[LEDGER_momentum_x + d], p, 1e-9 * fabs(p));
  }
  ck_assert_double_eq_tol(after.v[LEDGER_mass_fluid], before.v[LEDGER_mass_fluid], 1e-13 * before.v[LEDGER_mass_fluid]);
  ck_assert_double_eq_tol(after.v[LEDGER_mass_others], before.v[LEDGER_mass_others],
                          1e-13 * before.v[LEDGER_mass_others]);
  ck_assert_double_lt(after.v[LEDGER_kinetic_fluid], before.v[LEDGER_kinetic_fluid]);
  ck_assert_double_lt(run.sim->defect_rms_max, 1e-3);
  ck_assert_msg(fastest(&run) < 6.5, "%g m/s", fastest(&run));
  scene_close(&run);
}
END_TEST

/* ---- velocities of their own ---- */

#define SLIP                                                                                                           \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1, 0.1], \"h\": 0.1}, \"time\": {\"end\": 1}, \"start\": \"zero\"" WATER(    \
      ", \"pressure\": 101325, \"viscosity\": 0, \"velocity\": [1, 0]" BELOW(                                          \
          "0.03")) ", \"fluids\": {\"oil\": {\"density\": 500, \"bulk_modulus\": 1e9, \"viscosity\": 0, "              \
                   "\"velocity\": [0.2, 0], "                                                                          \
                   "\"eos\": {\"law\": \"linear_water\", \"reference_pressure\": 101325}}}, \"boundary\": "            \
                   "{\"fluid\": {\"x_min\": "                                                                          \
                   "\"periodic\", \"x_max\": \"periodic\"}}, \"numerics\": {\"dt_max\": 1e-3, \"ice\": "               \
                   "{\"advection\": true}}}"

/* two layers that slide on one another: free of one another, slowed down by the exchange, one from the first step on;
 * momentum stays to round-off */
START_TEST(layers_slide)
{
  static const char *const exchange[] = {"fluid.exchange=0", "fluid.exchange=500", "fluid.exchange=1e15"};
  static const double      X[] = {0, 500, INFINITY};
  const char              *sets[] = {exchange[_i], NULL};
  struct scene_run         run;
  scene_open_with(SLIP, sets, &run);
  const struct ice *ice = ice_of(run.sim);
  double            rb[2] = {300, 350}, mean = (rb[0] * 1 + rb[1] * 0.2) / 650, t = 0.2;
  double            left = isinf(X[_i]) ? 0 : 0.8 * exp(-X[_i] * t * (1 / rb[0] + 1 / rb[1]));
  struct ledger     before = scene_ledger(&run);
  while (run.sim->t < t) scene_step(&run, t - run.sim->t);
  long c = grid_at(&run.sim->grid, 4, 0, 0), size = run.sim->grid.size;
  ck_assert_double_eq_tol(ice->each_cc[2 * c], mean + rb[1] / 650 * left, 1e-3);
  ck_assert_double_eq_tol(ice->each_cc[2 * (size + c)], mean - rb[0] / 650 * left, 1e-3);
  ck_assert_double_eq_tol(scene_ledger(&run).v[LEDGER_momentum_x], before.v[LEDGER_momentum_x], 1e-12);
  scene_close(&run);
}
END_TEST

/* layers rest, free of one another or not, clear and in stones; a large exchange moves as one velocity does */
START_TEST(layers_rest_apart)
{
  static const char *const exchange[] = {"fluid.exchange=0", "fluid.exchange=1e5", "fluid.exchange=1e15"};
  static const int         which[] = {0, 1, 6, 7};
  for (int i = 0; i < 4; i++) {
    const char      *sets[] = {exchange[_i], NULL};
    struct scene_run run;
    scene_open_with(still[which[i]].text, sets, &run);
    struct ledger before = scene_ledger(&run), after;
    scene_steps(&run, 100, INFINITY);
    after = scene_ledger(&run);
    ck_assert_msg(fastest(&run) < 1e-10, "%g m/s", fastest(&run));
    ck_assert_double_eq_tol(after.v[LEDGER_mass_others], before.v[LEDGER_mass_others],
                            1e-14 * before.v[LEDGER_mass_others]);
    scene_close(&run);
  }
}
END_TEST

static double drop_after(const char *exchange, double *energy)
{
  const char      *sets[] = {exchange, NULL};
  struct scene_run run;
  scene_open_with(DROP("[3, -1]"), sets, &run);
  struct ledger before = scene_ledger(&run), after;
  scene_steps(&run, 100, 2e-3);
  after = scene_ledger(&run);
  for (int d = 0; d < 2; d++) {
    double p = before.v[LEDGER_momentum_x + d];
    double lost = fabs(after.v[LEDGER_momentum_x + d] / p - 1);
    ck_assert_msg(lost < 1e-10, "%s: momentum off by %g", exchange, lost);
  }
  *energy = after.v[LEDGER_kinetic_fluid] / before.v[LEDGER_kinetic_fluid];
  double t = run.sim->t;
  scene_close(&run);
  return t;
}

START_TEST(large_exchange_is_one_velocity)
{
  double one, large, none;
  ck_assert_double_eq_tol(drop_after("fluid.exchange=infinite", &one), drop_after("fluid.exchange=1e15", &large), 1e-2);
  drop_after("fluid.exchange=0", &none);
  ck_assert_msg(fabs(one - large) < 0.003, "energy left: %g, %g", one, large);
  ck_assert_double_gt(none, 0.9);
}
END_TEST

/* ---- standing wave under air ---- */

#define WAVE                                                                                                           \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1, 0.75], \"h\": 0.03125}, \"time\": {\"end\": 10}" DOWN WATER(              \
      ", \"viscosity\": 0, \"region\": {\"polygon\": [[0, 0], [1, 0], [1, 0.49], [0.9, 0.49049], [0.8, 0.49191], "     \
      "[0.7, 0.49412], [0.6, 0.49691], [0.5, 0.5], [0.4, 0.50309], [0.3, 0.50588], [0.2, 0.50809], [0.1, 0.50951], "   \
      "[0, 0.51]]}") AIR ", \"numerics\": {\"ice\": {\"advection\": true}}}"

/* kinetic energy has twice the frequency of the first mode, omega^2 = g pi tanh(pi/2) */
START_TEST(wave_under_air)
{
  struct scene_run run;
  double           peaks[3], values[3], before[2] = {0, 0}, t0 = 0, most = 0;
  double           exact = 2 * M_PI / sqrt(9.81 * M_PI * tanh(0.5 * M_PI));
  int              n = 0;
  scene_open(WAVE, &run);
  while (n < 3) {
    scene_step(&run, 0.01);
    double now = scene_ledger(&run).v[LEDGER_kinetic_fluid], t = run.sim->t;
    if (before[1] > before[0] && before[1] >= now && before[1] > 0.1) {
      double dt = t - t0, curve = before[0] - 2 * before[1] + now;
      peaks[n] = t - dt + 0.5 * dt * (before[0] - now) / curve;
      values[n++] = before[1];
    }
    before[0] = before[1];
    before[1] = now;
    t0 = t;
    most = fmax(most, fastest(&run));
  }
  ck_assert_msg(fabs(peaks[2] - peaks[0] - exact) < 0.007 * exact, "period %g s, should be %g", peaks[2] - peaks[0],
                exact);
  ck_assert_msg(values[2] > 0.98 * values[0] && values[2] < 1.02 * values[0], "kinetic energy after a period: %g of it",
                values[2] / values[0]);
  ck_assert_msg(most < 0.2, "air at %g m/s over water at 0.06", most);
  scene_close(&run);
}
END_TEST

/* ---- names ---- */

START_TEST(fields_of_fluids)
{
  struct scene_run  run;
  struct field_view v;
  int               component;
  scene_open(still[0].text, &run);
  const struct ice *ice = ice_of(run.sim);
  long              size = run.sim->grid.size;
  must(fields_component(run.sim, "mass_fluid", &v, &component));
  ck_assert_ptr_eq(v.data, ice->mass_cc);
  must(fields_component(run.sim, "mass_air", &v, &component));
  ck_assert_ptr_eq(v.data, ice->mass_cc + size);
  must(fields_component(run.sim, "cells.saturation_air", &v, &component));
  ck_assert_ptr_eq(v.data, ice->alpha_cc + size);
  must(fields_component(run.sim, "density_air", &v, &component));
  ck_assert_ptr_eq(v.data, ice->rho_cc + size);
  ck_assert_int_eq(fields_component(run.sim, "density_oil", &v, &component), ERR_INPUT);
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("ice fluids");
  TCase *fluids = tcase_create("fluids");
  tcase_set_timeout(fluids, 120);
  tcase_add_loop_test(fluids, layers_stay, 0, STILL);
  tcase_add_test(fluids, common_motion);
  tcase_add_test(fluids, drop_in_air);
  tcase_add_loop_test(fluids, layers_slide, 0, 3);
  tcase_add_loop_test(fluids, layers_rest_apart, 0, 3);
  tcase_add_test(fluids, large_exchange_is_one_velocity);
  tcase_add_test(fluids, wave_under_air);
  tcase_add_test(fluids, fields_of_fluids);
  suite_add_tcase(suite, fluids);
  return run_suite(suite);
}
