/* Viscous stress: eddies in a known shear, stress that varies, the order in time, walls that move. */
#include "ice/ice.h"

#include "tests/scene_run.h"

#define LIQUID(more)                                                                                                   \
  ", \"start\": \"zero\", \"fluid\": {\"path\": \"ice\", \"bulk_modulus\": \"infinite\"" more                          \
  "}, \"numerics\": {\"ice\": {\"advection\": true}}"
#define SHEARED                                                                                                        \
  "{\"grid\": {\"min\": [0, 0], \"max\": [null, 1], \"h\": 0.0625}, \"time\": {\"end\": 10}" LIQUID(                   \
      ", \"density\": 800, \"viscosity\": 0.5, \"velocity\": [\"3*y\", 0]") ", \"boundary\": {\"fluid\": {\"x_min\": " \
                                                                            "\"periodic\", \"x_max\": \"periodic\", "  \
                                                                            "\"y_min\": \"no_slip\", "                 \
                                                                            "\"y_max\": {\"velocity\": [3, 0]}}}}"

/* uniform shear between a wall that holds and one that moves: |S| = 3, it stays, and mu = mu_0 + rho (C h)^2 |S| */
START_TEST(eddies_of_a_shear)
{
  const char      *sets[] = {"numerics.ice.smagorinsky=0.17", NULL};
  struct scene_run run;
  scene_open_with(SHEARED, sets, &run);
  const struct ice *ice = ice_of(run.sim);
  struct box        cells = grid_cells(&run.sim->grid);
  double            expected = 0.5 + 800 * pow(0.17 * 0.0625, 2) * 3;
  for (int i = 0; i < 20; i++) {
    scene_step(&run, 1);
    FOR_BOX_SERIAL(&run.sim->grid, cells, c)
    {
      double x[3];
      grid_centre(&run.sim->grid, c, x);
      ck_assert_double_eq_tol(ice->mu_cc[c], expected, 1e-12 * expected);
      ck_assert_double_eq_tol(ice->vel_cc[2 * c], 3 * x[1], 1e-11);
    }
  }
  ck_assert_double_eq_tol(ice->now.viscosity, expected / 800, 1e-12);
  scene_close(&run);
}
END_TEST

/* pure strain u = (x, -y) and rotation (-y, x) in the middle of a box: |S| = 2 and 0 */
START_TEST(eddies_of_strain_and_rotation)
{
  static const char *const velocity[] = {"fluid.velocity=[\"x\", \"-y\"]", "fluid.velocity=[\"-y\", \"x\"]"};
  static const double      strain[] = {2, 0};
  const char              *sets[] = {velocity[_i], "numerics.ice.smagorinsky=0.2", NULL};
  struct scene_run         run;
  scene_open_with("{\"grid\": {\"min\": [-1, -1], \"max\": [1, 1], \"h\": 0.125}, \"time\": {\"end\": 1}" LIQUID(
                      ", \"density\": 800, \"viscosity\": 0") "}",
                  sets, &run);
  scene_step_to(&run, 1e-3, "ice.measure_eddies");
  const struct ice *ice = ice_of(run.sim);
  double            expected = 800 * pow(0.2 * 0.125, 2) * strain[_i];
  ck_assert_double_eq_tol(ice->mu_cc[grid_at(&run.sim->grid, 5, 9, 0)], expected, 1e-12);
  scene_close(&run);
}
END_TEST

/* C so small that eddies count for nothing: the full symmetric stress makes the vortex decay as the plain one does */
#define RING                                                                                                           \
  ", \"boundary\": {\"fluid\": {\"x_min\": \"periodic\", \"x_max\": \"periodic\", \"y_min\": \"periodic\", "           \
  "\"y_max\": \"periodic\"}}"
#define VORTEX                                                                                                         \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.0625}, \"time\": {\"end\": 1}" LIQUID(                       \
      ", \"density\": 1, \"viscosity\": 0.05, \"velocity\": [\"sin(2*pi*x)*cos(2*pi*y)\", "                            \
      "\"-cos(2*pi*x)*sin(2*pi*y)\"], \"pressure\": \"0.25*(cos(4*pi*x) + cos(4*pi*y))\"") RING "}"

static double energy_left(const char *grid, const char *eddies)
{
  const char      *sets[] = {grid, eddies, NULL};
  struct scene_run run;
  scene_open_with(VORTEX, sets, &run);
  while (run.sim->t < 0.2 - 1e-9) scene_step(&run, 0.002);
  double energy = scene_ledger(&run).v[LEDGER_kinetic_fluid];
  scene_close(&run);
  return energy;
}

/* what the symmetric stress makes of the energy beyond what the plain one does, relative */
static double beyond_plain(const char *grid)
{
  return energy_left(grid, "numerics.ice.smagorinsky=1e-6") / energy_left(grid, "numerics.ice.smagorinsky=0") - 1;
}

START_TEST(symmetric_stress)
{
  double coarse = beyond_plain("grid.h=0.0625"), fine = beyond_plain("grid.h=0.03125");
  ck_assert_msg(fabs(fine) < 0.005 && fabs(coarse / fine) > 3.5, "%g, %g", coarse, fine);
  ck_assert(energy_left("grid.h=0.0625", "numerics.ice.smagorinsky=0.5") <
            0.9 * energy_left("grid.h=0.0625", "numerics.ice.smagorinsky=0"));
}
END_TEST

/* stress that varies neither makes nor takes momentum, whatever flows */
START_TEST(momentum_stays)
{
  const char      *sets[] = {"numerics.ice.smagorinsky=0.3", "fluid.viscosity=0",
                             "fluid.velocity=[\"1+sin(2*pi*y)+0.3*cos(4*pi*x)\", \"cos(2*pi*x)\"]", NULL};
  struct scene_run run;
  scene_open_with(VORTEX, sets, &run);
  double before = scene_ledger(&run).v[LEDGER_momentum_x];
  scene_steps(&run, 40, 0.005);
  ck_assert_double_eq_tol(scene_ledger(&run).v[LEDGER_momentum_x], before, 1e-12);
  scene_close(&run);
}
END_TEST

/* shear wave between rough walls, u = sin(pi y) exp(-nu pi^2 t): the error that is left when the steps are halved */
#define WAVE                                                                                                           \
  "{\"grid\": {\"min\": [0, 0], \"max\": [null, 1], \"h\": 0.1}, \"time\": {\"end\": 1}" LIQUID(                       \
      ", \"density\": 1, \"viscosity\": 0.4, \"velocity\": [\"sin(pi*y)\", 0]") ", \"boundary\": {\"fluid\": "         \
                                                                                "{\"x_min\": \"periodic\", "           \
                                                                                "\"x_max\": \"periodic\", \"y_min\": " \
                                                                                "\"no_slip\", "                        \
                                                                                "\"y_max\": \"no_slip\"}}}"

static double wave_left(double dt)
{
  struct scene_run run;
  scene_open(WAVE, &run);
  for (int i = 0; i < (int)lround(0.2 / dt); i++) scene_step(&run, dt);
  double u = ice_of(run.sim)->vel_cc[2 * grid_at(&run.sim->grid, 0, 5, 0)];
  scene_close(&run);
  return u;
}

START_TEST(order_in_time)
{
  double coarse = wave_left(0.004), middle = wave_left(0.002), fine = wave_left(0.001);
  double order = log2((coarse - middle) / (middle - fine));
  ck_assert_msg(order > 1.9, "order %g: %.12g %.12g %.12g", order, coarse, middle, fine);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("ice viscosity");
  TCase *stress = tcase_create("stress");
  tcase_add_test(stress, eddies_of_a_shear);
  tcase_add_loop_test(stress, eddies_of_strain_and_rotation, 0, 2);
  tcase_add_test(stress, symmetric_stress);
  tcase_add_test(stress, momentum_stays);
  tcase_add_test(stress, order_in_time);
  suite_add_tcase(suite, stress);
  return run_suite(suite);
}
