/* Heat of the fluid: carried with the mass. */
#include "ice/ice.h"

#include "tests/scene_run.h"

#define RING                                                                                                           \
  ", \"boundary\": {\"fluid\": {\"x_min\": \"periodic\", \"x_max\": \"periodic\", \"y_min\": \"periodic\", "           \
  "\"y_max\": \"periodic\"}}"
#define UNIT                                                                                                           \
  "\"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.03125}, \"time\": {\"end\": 10}, \"start\": \"zero\""
#define FLUID(more) ", \"fluid\": {\"path\": \"ice\", " more "}, \"numerics\": {\"ice\": {\"advection\": true}}"

static double heat_balance(const struct scene_run *run)
{
  struct ledger l = scene_ledger(run);
  return l.v[LEDGER_heat_fluid] + l.v[LEDGER_heat_fluid_out];
}

/* least and largest temperature of the cells that hold liquid */
static void find_span(const struct scene_run *run, double *least, double *largest)
{
  const struct ice *ice = ice_of(run->sim);
  struct box        cells = grid_cells(&run->sim->grid);
  *least = INFINITY;
  *largest = -INFINITY;
  FOR_BOX_SERIAL(&run->sim->grid, cells, c)
  {
    if (!(ice->mass_cc[c] > 0)) continue;
    *least = fmin(*least, ice->T_cc[c]);
    *largest = fmax(*largest, ice->T_cc[c]);
  }
}

/* ---- uniform temperature ---- */

/* a vortex that compresses the liquid by some per cent */
#define VORTEX                                                                                                         \
  "{" UNIT FLUID("\"density\": 1, \"bulk_modulus\": 10, \"viscosity\": 0.01, \"pressure\": \"0.25*(cos(4*pi*x) + "     \
                 "cos(4*pi*y))\", \"velocity\": [\"sin(2*pi*x)*cos(2*pi*y)\", \"-cos(2*pi*x)*sin(2*pi*y)\"], "         \
                 "\"temperature\": 300, \"eos\": {\"law\": \"linear_water\", \"expansion\": 0.01}") RING "}"
/* a dam that breaks */
#define DAM                                                                                                            \
  "{" UNIT ", \"gravity\": [0, -9.81]" FLUID(                                                                          \
      "\"region\": {\"box\": {\"min\": [0, 0], \"max\": [0.3, 0.6]}}, \"temperature\": 300") "}"

START_TEST(uniform_stays_uniform)
{
  static const char *const scenes[] = {VORTEX, DAM};
  struct scene_run         run;
  double                   least, largest;
  scene_open(scenes[_i], &run);
  double heat = heat_balance(&run);
  scene_steps(&run, 200, 0.005);
  find_span(&run, &least, &largest);
  ck_assert_msg(largest - least < 300 * 1e-12, "temperatures from %.16g to %.16g K", least, largest);
  ck_assert_double_eq_tol(heat_balance(&run), heat, 1e-12 * heat);
  scene_close(&run);
}
END_TEST

/* ---- a hill of warm liquid carried round ---- */

#define HILL                                                                                                           \
  "{" UNIT FLUID("\"density\": 1, \"bulk_modulus\": 1e4, \"velocity\": [1, 0.5], \"temperature\": "                    \
                 "\"300 + 0.5*(1 - cos(2*pi*x))*(1 - cos(2*pi*y))\"") RING "}"

static double hill_error(const char *set)
{
  const char      *sets[] = {set, NULL};
  struct scene_run run;
  double           error = 0, least, largest;
  scene_open_with(HILL, sets, &run);
  const struct grid *g = &run.sim->grid;
  struct box         cells = grid_cells(g);
  double             heat = heat_balance(&run);
  while (run.sim->t < 2) scene_step(&run, 2 - run.sim->t);
  FOR_BOX_SERIAL(g, cells, c)
  {
    double x[3], exact;
    grid_centre(g, c, x);
    exact = 300 + 0.5 * (1 - cos(2 * M_PI * x[0])) * (1 - cos(2 * M_PI * x[1]));
    error += fabs(ice_of(run.sim)->T_cc[c] - exact) / (g->n[0] * g->n[1]);
  }
  find_span(&run, &least, &largest);
  ck_assert_msg(least > 300 - 1e-9 && largest < 302, "%g to %g K", least, largest);
  ck_assert_double_eq_tol(heat_balance(&run), heat, 1e-12 * heat);
  scene_close(&run);
  return error;
}

START_TEST(hill_comes_back)
{
  double coarse = hill_error("grid.h=0.03125"), fine = hill_error("grid.h=0.015625"), order = log2(coarse / fine);
  ck_assert_msg(fine < 0.01 && order > 1.6, "order %g: %g, %g K", order, coarse, fine);
}
END_TEST

/* ---- liquid of another temperature flows in ---- */

#define PIPE                                                                                                           \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1, null], \"h\": 0.05}, \"time\": {\"end\": 10}, \"start\": \"zero\"" FLUID( \
      "\"velocity\": [0.2, 0], \"temperature\": 280, \"eos\": {\"law\": \"linear_water\", \"expansion\": 2e-4}") ", "  \
                                                                                                                 "\"b" \
                                                                                                                 "oun" \
                                                                                                                 "dar" \
                                                                                                                 "y\"" \
                                                                                                                 ": "  \
                                                                                                                 "{\"" \
                                                                                                                 "flu" \
                                                                                                                 "id"  \
                                                                                                                 "\":" \
                                                                                                                 " {"  \
                                                                                                                 "\"x" \
                                                                                                                 "_mi" \
                                                                                                                 "n\"" \
                                                                                                                 ": "  \
                                                                                                                 "{\"" \
                                                                                                                 "vel" \
                                                                                                                 "oci" \
                                                                                                                 "ty"  \
                                                                                                                 "\":" \
                                                                                                                 " ["  \
                                                                                                                 "0."  \
                                                                                                                 "2, " \
                                                                                                                 "0]}" \
                                                                                                                 ", "  \
                                                                                                                 "\"x" \
                                                                                                                 "_ma" \
                                                                                                                 "x\"" \
                                                                                                                 ": "  \
                                                                                                                 "{\"" \
                                                                                                                 "pre" \
                                                                                                                 "ssu" \
                                                                                                                 "re"  \
                                                                                                                 "\":" \
                                                                                                                 " 0}" \
                                                                                                                 "}, " \
                                                                                                                 "\"h" \
                                                                                                                 "eat" \
                                                                                                                 "\":" \
                                                                                                                 " "   \
                                                                                                                 "{\"" \
                                                                                                                 "x_"  \
                                                                                                                 "min" \
                                                                                                                 "\":" \
                                                                                                                 " {"  \
                                                                                                                 "\"t" \
                                                                                                                 "emp" \
                                                                                                                 "era" \
                                                                                                                 "tur" \
                                                                                                                 "e\"" \
                                                                                                                 ": "  \
                                                                                                                 "310" \
                                                                                                                 "}}}" \
                                                                                                                 "}"

START_TEST(inflow_brings_its_temperature)
{
  struct scene_run run;
  double           least, largest;
  scene_open(PIPE, &run);
  double heat = heat_balance(&run), half = 0.2 * 0.05 * 2 * 1000 * 4186 * 310; /* J in 2 s */
  scene_steps(&run, 20, 0.1);
  ck_assert_double_eq_tol(heat_balance(&run), heat, 1e-12 * heat);
  ck_assert_double_eq_tol(scene_ledger(&run).v[LEDGER_heat_fluid_out], half * (280.0 / 310 - 1), 0.02 * half);
  scene_steps(&run, 180, 0.1);
  find_span(&run, &least, &largest);
  ck_assert_msg(least > 309.999 && largest < 310 + 1e-9, "%g to %g K", least, largest);
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("ice heat");
  TCase *tcase = tcase_create("carried");
  tcase_set_timeout(tcase, 60);
  tcase_add_loop_test(tcase, uniform_stays_uniform, 0, 2);
  tcase_add_test(tcase, hill_comes_back);
  tcase_add_test(tcase, inflow_brings_its_temperature);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
