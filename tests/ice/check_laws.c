/* Every kind of equation of state in cells: sound travels as the law says, and a pressure that is none of its own stops
 * the run. */
#include "eos/eos.h"
#include "ice/ice.h"
#include "tests/scene_run.h"

/* a closed box of 1 m; half a wave stands in it */
#define BOX "\"grid\": {\"min\": [0, 0], \"max\": [1, null], \"h\": 0.02}, \"time\": {\"end\": 10}, \"start\": \"zero\""
#define NUMERICS ", \"numerics\": {\"theta\": 0.5, \"ice\": {\"memory\": 1}}"
#define FLUID(density, pressure, eos)                                                                                  \
  "{" BOX NUMERICS ", \"fluid\": {\"path\": \"ice\", \"density\": " density                                            \
  ", \"viscosity\": 0, \"pressure\": \"" pressure "\", \"eos\": " eos "}}"

static const char *const scenes[] = {
    FLUID("1000", "100*cos(pi*x)", "\"linear_water\""),
    FLUID("1000", "1e8 + 100*cos(pi*x)", "\"tait\""),
    FLUID("1000", "1e8 + 100*cos(pi*x)", "\"stiffened_gas\""),
    FLUID("1.1766", "101325 + 0.1*cos(pi*x)", "\"isothermal_gas\""),
    FLUID("1.1766", "101325 + 0.1*cos(pi*x)", "{\"law\": \"ideal_gas\", \"reference_temperature\": 300}"),
};
enum { SCENES = sizeof scenes / sizeof *scenes };

/* m/s, at the pressure of a cell */
static double sound_speed(const struct scene_run *run, long c)
{
  const struct fluid *f = &run->sim->scene->fluid;
  double              speed;
  f->eos->sound_speed(f->eos_params, 1, &ice_of(run->sim)->P_cc[c], NULL, &speed);
  return speed;
}

/* after half a period 2 L/c the pressures of both ends have changed places; 200 steps, so the error of the period is
 * (pi/200)^2/12 + (pi/100)^2/24 of it */
START_TEST(sound)
{
  struct scene_run run;
  scene_open(scenes[_i], &run);
  const struct ice *ice = ice_of(run.sim);
  long              low = grid_at(&run.sim->grid, 0, 0, 0), high = grid_at(&run.sim->grid, 49, 0, 0);
  double            half = 1 / sound_speed(&run, low), before = ice->P_cc[low] - ice->P_cc[high];
  double            mass = scene_ledger(&run).v[LEDGER_mass_fluid];
  scene_steps(&run, 50, half / 100);
  ck_assert_double_lt(fabs(ice->P_cc[low] - ice->P_cc[high]), 2e-3 * before);
  scene_steps(&run, 50, half / 100);
  ck_assert_double_eq_tol(ice->P_cc[high] - ice->P_cc[low], before, 1e-4 * before);
  ck_assert_double_eq_tol(run.sim->t, half, 1e-12 * half);
  ck_assert_double_eq_tol(scene_ledger(&run).v[LEDGER_mass_fluid], mass, 1e-13 * mass);
  scene_close(&run);
}
END_TEST

/* no gas has no pressure */
START_TEST(vacuum)
{
  struct scene_run run;
  scene_open(FLUID("1.1766", "0", "\"ideal_gas\""), &run);
  ck_assert_int_eq(ice_update_properties(run.sim, 1e-3), ERR_DIVERGED);
  ck_assert_ptr_nonnull(strstr(status_message(), "ice: 50 cells have a pressure outside the range of ideal_gas, a"));
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("ice/laws");
  TCase *tests = tcase_create("laws");
  tcase_add_loop_test(tests, sound, 0, SCENES);
  tcase_add_test(tests, vacuum);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}
