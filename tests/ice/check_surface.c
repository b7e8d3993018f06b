/* Liquid that moves: a surface at rest and as a standing wave, a vortex that decays, a channel. */
#include "ice/ice.h"

#include "tests/scene_run.h"

#define LIQUID(more) ", \"fluid\": {\"path\": \"ice\"" more "}, \"numerics\": {\"ice\": {\"advection\": true}}"
#define DOWN ", \"gravity\": [0, -9.81]"

static double fluid_energy(const struct scene_run *run) { return scene_ledger(run).v[LEDGER_kinetic_fluid]; }

/* ---- rest ---- */

#define BOX "\"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.05}, \"time\": {\"end\": 10}"

/* surface on a face, low and high inside a cell; 1000 steps */
START_TEST(rest)
{
  static const char *const depth[] = {"0.5", "0.512", "0.52", "0.54", "0.549"};
  char                     text[1024];
  struct scene_run         run;
  snprintf(text, sizeof text, "{" BOX DOWN LIQUID(", \"region\": {\"box\": {\"min\": [0, 0], \"max\": [1, %s]}}") "}",
           depth[_i]);
  scene_open(text, &run);
  double mass = scene_ledger(&run).v[LEDGER_mass_fluid];
  ck_assert_double_eq_tol(mass, 1000 * atof(depth[_i]), 15);
  scene_steps(&run, 1000, 0.01);
  ck_assert_msg(fluid_energy(&run) < 0.5 * mass * 1e-24, "depth %s: %g J", depth[_i], fluid_energy(&run));
  ck_assert_double_eq_tol(scene_ledger(&run).v[LEDGER_mass_fluid], mass, 1e-12 * mass);
  scene_close(&run);
}
END_TEST

/* ---- standing wave ---- */

/* a slope of 0.02 over a box of 1 x 1, depth 0.5: its first mode has omega^2 = g pi tanh(pi/2), kinetic energy twice
 * that frequency */
#define WAVE(h)                                                                                                        \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": " h "}, \"time\": {\"end\": 10}" DOWN LIQUID(                  \
      ", \"region\": {\"polygon\": [[0, 0], [1, 0], [1, 0.49], [0.9, 0.49049], [0.8, 0.49191], [0.7, 0.49412], "       \
      "[0.6, 0.49691], [0.5, 0.5], [0.4, 0.50309], [0.3, 0.50588], [0.2, 0.50809], [0.1, 0.50951], [0, 0.51]]}") "}"

static double wave_period(const char *text, double *energy_ratio)
{
  struct scene_run run;
  double           peaks[8], values[8], before[2] = {0, 0}, t0 = 0;
  int              n = 0;
  scene_open(text, &run);
  while (n < 3) {
    scene_step(&run, 0.01);
    double now = fluid_energy(&run), t = run.sim->t;
    if (before[1] > before[0] && before[1] >= now && before[1] > 0.1) {
      double dt = t - t0, curve = before[0] - 2 * before[1] + now;
      peaks[n] = t - dt + 0.5 * dt * (before[0] - now) / curve;
      values[n++] = before[1];
    }
    before[0] = before[1];
    before[1] = now;
    t0 = t;
  }
  scene_close(&run);
  *energy_ratio = values[2] / values[0];
  return peaks[2] - peaks[0];
}

START_TEST(standing_wave)
{
  double ratio, exact = 2 * M_PI / sqrt(9.81 * M_PI * tanh(0.5 * M_PI)), period = wave_period(WAVE("0.03125"), &ratio);
  ck_assert_msg(fabs(period - exact) < 0.007 * exact, "period %g s, should be %g", period, exact);
  ck_assert_msg(fabs(ratio - 1) < 0.01, "kinetic energy after a period: %g of the first", ratio);
}
END_TEST

/* ---- vortex ---- */

#define RING                                                                                                           \
  ", \"boundary\": {\"fluid\": {\"x_min\": \"periodic\", \"x_max\": \"periodic\", \"y_min\": \"periodic\", "           \
  "\"y_max\": "                                                                                                        \
  "\"periodic\"}}"
#define VORTEX                                                                                                         \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.03125}, \"time\": {\"end\": 1}, \"start\": \"zero\"" LIQUID( \
      ", \"density\": 1, \"bulk_modulus\": 1e4, \"viscosity\": 0.01, \"pressure\": \"0.25*(cos(4*pi*x) + "             \
      "cos(4*pi*y))\", \"velocity\": [\"sin(2*pi*x)*cos(2*pi*y)\", \"-cos(2*pi*x)*sin(2*pi*y)\"]") RING "}"

static double vortex_error(const char *set)
{
  const char      *sets[] = {set, NULL};
  struct scene_run run;
  scene_open_with(VORTEX, sets, &run);
  while (run.sim->t < 0.5) scene_step(&run, 0.5 - run.sim->t);
  double error = fluid_energy(&run) / (0.25 * exp(-4 * 0.01 * 4 * M_PI * M_PI * 0.5)) - 1;
  scene_close(&run);
  return error;
}

/* second order in space, the step shrinking with the cells */
START_TEST(vortex_decays)
{
  double coarse = vortex_error("grid.h=0.0625"), fine = vortex_error("grid.h=0.03125"), order = log2(coarse / fine);
  ck_assert_msg(fabs(fine) < 0.03, "energy off by %g", fine);
  ck_assert_msg(order > 1.9, "order %g: %g, %g", order, coarse, fine);
}
END_TEST

/* ---- channel ---- */

#define CHANNEL                                                                                                        \
  "{\"grid\": {\"min\": [0, 0], \"max\": [null, 1], \"h\": 0.0625}, \"time\": {\"end\": 20}, \"start\": \"zero\", "    \
  "\"gravity\": [1, 0]" LIQUID(                                                                                        \
      ", \"density\": 1, \"bulk_modulus\": \"infinite\", \"viscosity\": 0.1") ", \"boundary\": {\"fluid\": "           \
                                                                              "{\"x_min\": \"periodic\", \"x_max\": "  \
                                                                              "\"periodic\", \"y_min\": \"no_slip\", " \
                                                                              "\"y_max\": \"no_slip\"}}}"

/* between rough walls G y (1 - y)/(2 mu); central differences with the wall half a cell away shift it by G h^2/(8 mu)
 */
START_TEST(channel)
{
  struct scene_run run;
  scene_open(CHANNEL, &run);
  while (run.sim->t < 20) scene_step(&run, 20 - run.sim->t);
  const struct ice *ice = ice_of(run.sim);
  struct box        cells = grid_cells(&run.sim->grid);
  FOR_BOX_SERIAL(&run.sim->grid, cells, c)
  {
    double x[3];
    grid_centre(&run.sim->grid, c, x);
    ck_assert_double_eq_tol(ice->vel_cc[2 * c], x[1] * (1 - x[1]) / 0.2 + 0.0625 * 0.0625 / 0.8, 1e-6);
  }
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("ice surface");
  TCase *liquid = tcase_create("liquid");
  tcase_set_timeout(liquid, 120);
  tcase_add_loop_test(liquid, rest, 0, 5);
  tcase_add_test(liquid, standing_wave);
  tcase_add_test(liquid, vortex_decays);
  tcase_add_test(liquid, channel);
  suite_add_tcase(suite, liquid);
  return run_suite(suite);
}
