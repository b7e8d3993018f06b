/* Heat of the fluid: conducted, and exchanged with the grains of a skeleton. */
#include "ice/ice.h"
#include "mpm/mpm.h"

#include "tests/scene_run.h"

#define GRID(x, y, h) "\"grid\": {\"min\": [0, 0], \"max\": [" x ", " y "], \"h\": " h "}, \"time\": {\"end\": 1e9}"
#define ADVECTION ", \"numerics\": {\"ice\": {\"advection\": true}}"
#define DARCY ", \"numerics\": {\"ice\": {\"advection\": true, \"shear\": false}}"

/* all heat inside, without what came in */
static double heat_balance(const struct scene_run *run)
{
  struct ledger l = scene_ledger(run);
  return l.v[LEDGER_heat] + l.v[LEDGER_heat_fluid] + l.v[LEDGER_heat_fluid_out] - l.v[LEDGER_heat_sides];
}

static double heat_inside(const struct scene_run *run)
{
  struct ledger l = scene_ledger(run);
  return l.v[LEDGER_heat] + l.v[LEDGER_heat_fluid];
}

/* largest difference of the fluid's temperature from T(x) */
static double largest_error(const struct scene_run *run, double (*T)(double x))
{
  const struct grid *g = &run->sim->grid;
  struct box         cells = grid_cells(g);
  double             most = 0;
  FOR_BOX_SERIAL(g, cells, c)
  {
    double x[3];
    grid_centre(g, c, x);
    most = fmax(most, fabs(ice_of(run->sim)->T_cc[c] - T(x[0])));
  }
  return most;
}

/* ---- still water ---- */

#define BAR                                                                                                            \
  "{" GRID("1", "null", "0.05") ", \"start\": \"zero\", \"fluid\": {\"path\": \"ice\", \"density\": 2500, "            \
                                "\"viscosity\": 0, \"temperature\": "                                                  \
                                "\"300 + 5*cos(pi*x)\", \"conductivity\": 0.4, \"eos\": {\"law\": \"linear_water\", "  \
                                "\"heat_capacity\": 835}}" ADVECTION "}"

static const double fourier = 2500 * 835 / 0.4; /* s */
static double       cosine(double x) { return 300 + 5 * exp(-M_PI * M_PI * 0.1) * cos(M_PI * x); }

static double bar_error(const char *h, const char *dt)
{
  char             set[2][64];
  const char      *sets[] = {set[0], set[1], NULL};
  struct scene_run run;
  snprintf(set[0], sizeof set[0], "grid.h=%s", h);
  snprintf(set[1], sizeof set[1], "numerics.dt_max=%s", dt);
  scene_open_with(BAR, sets, &run);
  double heat = heat_inside(&run), end = 0.1 * fourier;
  while (run.sim->t < end) scene_step(&run, end - run.sim->t);
  ck_assert_double_eq_tol(heat_inside(&run), heat, 1e-12 * heat);
  double error = largest_error(&run, cosine);
  scene_close(&run);
  return error;
}

/* few long steps do, and up to the step of an explicit scheme all is of second order */
START_TEST(cosine_fades)
{
  double free_steps = bar_error("0.05", "1e9"), coarse = bar_error("0.1", "5000"), fine = bar_error("0.05", "1250");
  ck_assert_msg(free_steps < 0.01 * 5, "%g K with the steps that accuracy wants", free_steps);
  ck_assert_msg(log2(coarse / fine) > 1.9, "%g and %g K", coarse, fine);
}
END_TEST

static double line(double x) { return 310 - 20 * x; }

/* T fixed at one end, a flux into the other; steps of 20000 s end in the steady state */
START_TEST(sides_hold)
{
  const char      *sets[] = {"boundary.heat.x_min={\"temperature\":310}", "boundary.heat.x_max={\"flux\":-8}", NULL};
  struct scene_run run;
  scene_open_with(BAR, sets, &run);
  double balance = heat_balance(&run);
  while (run.sim->t < 4e7) scene_step(&run, 2e4);
  ck_assert_msg(largest_error(&run, line) < 1e-6, "%g K off the line", largest_error(&run, line));
  ck_assert_double_eq_tol(heat_balance(&run), balance, 1e-11 * balance);
  ck_assert_double_eq_tol(ice_of(run.sim)->now.heat_side[X_MIN], 8 * 0.05, 1e-7);
  ck_assert_double_eq_tol(ice_of(run.sim)->now.heat_side[X_MAX], -8 * 0.05, 1e-12);
  scene_close(&run);
}
END_TEST

/* ---- grains ---- */

#define SAND(T)                                                                                                        \
  ", \"materials\": {\"sand\": {\"model\": \"rigid\", \"density\": 2500, \"porosity\": 0.4, \"grain_diameter\": "      \
  "1e-3, \"heat_capacity\": 800, \"conductivity\": 0.4}}, \"solids\": {\"bed\": {\"material\": \"sand\", \"shape\": "  \
  "\"everywhere\", \"temperature\": " T "}}"
#define WATER(T, more)                                                                                                 \
  ", \"fluid\": {\"path\": \"ice\", \"temperature\": " T ", \"conductivity\": 0.6, \"drag\": {\"law\": "               \
  "\"kozeny_carman\"}, \"eos\": {\"law\": \"linear_water\", \"heat_capacity\": 4000}" more "}" DARCY
#define BED "{" GRID("0.4", "0.3", "0.1") ", \"start\": \"zero\"" SAND("290") WATER("310", ", \"viscosity\": 1e-3") "}"

static const double of_fluid = 0.4 * 1000 * 4000, of_grains = 0.6 * 2500 * 800; /* J/(m3 K) */

/* difference of temperatures at rate H (1/C_f + 1/C_s) */
START_TEST(exchange_levels)
{
  struct scene_run run;
  double           rate = 1e6 * (1 / of_fluid + 1 / of_grains), end = 1 / rate;
  scene_open(BED, &run);
  double heat = heat_inside(&run), mean = (of_fluid * 310 + of_grains * 290) / (of_fluid + of_grains);
  while (run.sim->t < end) scene_step(&run, fmin(end / 100, end - run.sim->t));
  double T = ice_of(run.sim)->T_cc[grid_at(&run.sim->grid, 1, 1, 0)];
  ck_assert_double_eq_tol((T - mean) / (310 - mean), exp(-1), 0.004);
  for (int i = 0; i < 50; i++) scene_step(&run, 600);
  for (long p = 0; p < run.sim->points[SET_SOLID]->n; p++)
    ck_assert_double_eq_tol(mpm_of(run.sim)->temperature_p[p], mean, 1e-9);
  ck_assert_double_eq_tol(heat_inside(&run), heat, 1e-13 * heat);
  scene_close(&run);
}
END_TEST

/* between two temperatures heat goes through water and grains side by side; points lie on the line too */
START_TEST(bed_conducts)
{
  const char *sets[] = {"boundary.heat.x_min={\"temperature\":310}", "boundary.heat.x_max={\"temperature\":290}", NULL};
  struct scene_run run;
  scene_open_with(BED, sets, &run);
  double balance = heat_balance(&run);
  for (int i = 0; i < 300; i++) scene_step(&run, 1e5);
  double through = (0.4 * 0.6 + 0.6 * 0.4) * 20 / 0.4 * 0.3;
  ck_assert_double_eq_tol(ice_of(run.sim)->now.heat_side[X_MIN], through, 1e-7 * through);
  ck_assert_double_eq_tol(ice_of(run.sim)->now.heat_side[X_MAX], -through, 1e-7 * through);
  for (long p = 0; p < run.sim->points[SET_SOLID]->n; p++)
    ck_assert_double_eq_tol(mpm_of(run.sim)->temperature_p[p], 310 - 50 * mpm_of(run.sim)->x_p[2 * p], 1e-6);
  ck_assert_double_eq_tol(heat_balance(&run), balance, 1e-11 * balance);
  scene_close(&run);
}
END_TEST

/* a skeleton that moves conducts on its nodes and exchanges in cells */
START_TEST(moving_grains_exchange)
{
  static const char scene[] =
      "{" GRID("0.4", "0.4", "0.1") ", \"gravity\": [0, -9.81], \"start\": \"zero\", \"materials\": {\"sand\": "
                                    "{\"model\": \"linear_elastic\", \"young\": 1e6, \"poisson\": 0.3, \"density\": "
                                    "2500, \"porosity\": 0.4, \"grain_diameter\": 1e-2, \"heat_capacity\": 800, "
                                    "\"conductivity\": 0.4}}, \"solids\": {\"bed\": {\"material\": \"sand\", "
                                    "\"shape\": {\"box\": {\"min\": [0.1, 0.1], \"max\": [0.3, 0.3]}}, "
                                    "\"temperature\": 290}}" WATER("310", "") "}";
  struct scene_run run;
  scene_open(scene, &run);
  double heat = heat_inside(&run), before = scene_ledger(&run).v[LEDGER_heat];
  scene_steps(&run, 100, 1e-3);
  ck_assert_double_eq_tol(heat_inside(&run), heat, 1e-12 * heat);
  double gained = scene_ledger(&run).v[LEDGER_heat] - before, first = 1e6 * 0.2 * 0.2 * 20 * run.sim->t;
  ck_assert_msg(gained > 0.8 * first && gained < first, "%g of %g J", gained, first);
  scene_close(&run);
}
END_TEST

/* ---- flow ---- */

#define CAVITY                                                                                                         \
  "{" GRID("1", "1", "0.0625") ", \"gravity\": [0, -100], \"fluid\": {\"path\": \"ice\", \"density\": 1, "             \
                               "\"bulk_modulus\": 1e6, \"viscosity\": 8.4261498e-3, \"temperature\": \"305 - 10*x\", " \
                               "\"conductivity\": 1186.7817, \"eos\": {\"law\": \"linear_water\", \"expansion\": "     \
                               "1e-3, \"reference_temperature\": 300, \"heat_capacity\": 1e5}}, \"boundary\": "        \
                               "{\"heat\": {\"x_min\": {\"temperature\": 305}, \"x_max\": {\"temperature\": 295}}, "   \
                               "\"fluid\": {\"x_min\": \"no_slip\", \"x_max\": \"no_slip\", \"y_min\": \"no_slip\", "  \
                               "\"y_max\": \"no_slip\"}}" ADVECTION "}"

/* Ra 1e4: what came in is what is there, and buoyancy doubles what goes through (2.245 on a fine grid) */
START_TEST(cavity)
{
  struct scene_run run;
  scene_open(CAVITY, &run);
  double balance = heat_balance(&run);
  while (run.sim->t < 20) scene_step(&run, 20 - run.sim->t);
  double Nu = ice_of(run.sim)->now.heat_side[X_MIN] / 11867.817;
  ck_assert_msg(Nu > 2.245 && Nu < 2.5, "Nu %g", Nu);
  ck_assert_double_eq_tol(heat_balance(&run), balance, 1e-12 * balance);
  ck_assert_double_lt(ice_of(run.sim)->now.defect_max, 1e-5);
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("ice conduction");
  TCase *tcase = tcase_create("heat");
  tcase_set_timeout(tcase, 60);
  tcase_add_test(tcase, cosine_fades);
  tcase_add_test(tcase, sides_hold);
  tcase_add_test(tcase, exchange_levels);
  tcase_add_test(tcase, bed_conducts);
  tcase_add_test(tcase, moving_grains_exchange);
  tcase_add_test(tcase, cavity);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
