/* Momentum between water and skeleton: action is reaction, and drag acts with the velocities at the end of the step. */
#include "coupling/coupling.h"
#include "mpm/mpm.h"
#include "tests/twopoint/water.h"

/* soil and water drift through each other in free space, a part of the water beside the soil */
static const char drifting[] =
    "{\"title\": \"drift\", \"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.05}, \"time\": {\"end\": 1},"
    "\"gravity\": [0, 0], \"start\": \"zero\","
    "\"materials\": {\"sand\": {\"model\": \"linear_elastic\", \"young\": 1e6, \"poisson\": 0.3, \"density\": 2650,"
    "  \"porosity\": 0.4, \"permeability\": 1e-2, \"grain_diameter\": 1e-2}},"
    "\"solids\": {\"block\": {\"material\": \"sand\", \"shape\": {\"box\": {\"min\": [0.3, 0.3], \"max\": [0.7, 0.6]}},"
    "  \"velocity\": [\"0.2*sin(9*y)\", \"-0.1*cos(7*x)\"]}},"
    "\"fluid\": {\"path\": \"twopoint\", \"density\": 1000, \"bulk_modulus\": 1e7, \"viscosity\": 1e-3,"
    "  \"drag\": {\"law\": \"ergun\"}, \"region\": {\"box\": {\"min\": [0.3, 0.4], \"max\": [0.7, 0.75]}},"
    "  \"velocity\": [\"0.5*cos(8*y)\", \"0.3*sin(5*x)\"], \"pressure\": \"1e4*sin(6*x)\"},"
    "\"numerics\": {\"basis\": \"cubic\", \"stress_timing\": \"usl\"}}";

/* what the water gains and the solid gets is what the pressure gives to both, node by node */
START_TEST(nothing_is_lost_at_a_node)
{
  struct water_run run;
  water_open(drifting, &run);
  water_step(&run, NULL);
  double                 dt = water_step(&run, "twopoint.exchange_momentum"), largest = 0, error = 0;
  const struct twopoint *w = run.water;
  struct box             nodes = grid_nodes(&run.sim->grid);
  FOR_BOX_SERIAL(&run.sim->grid, nodes, i)
  for (int d = 0; d < 2; d++) {
    long at = i * 2 + d;
    if (!(w->water_mass_nc[i] > w->mass_floor)) continue;
    double gained = w->water_mass_nc[i] * (w->water_vel_new_nc[at] - w->water_vel_nc[at]);
    double given = dt * w->water_force_nc[at];
    largest = fmax(largest, fmax(fabs(given), fabs(w->coupling->dmom_nc[at])));
    error = fmax(error, fabs(gained + w->coupling->dmom_nc[at] - given));
  }
  ck_assert_double_gt(largest, 1e-3);
  ck_assert_double_lt(error, 1e-13 * largest);
  water_close(&run);
}
END_TEST

/* impulse of drag on the solid, from what the solid's own stage makes of it, is dt D (v_f - v_s) with the new
 * velocities */
START_TEST(drag_is_implicit)
{
  struct water_run run;
  water_open(drifting, &run);
  water_step(&run, NULL);
  double                 dt = water_step(&run, "mpm.advance_nodes"), largest = 0, error = 0;
  const struct twopoint *w = run.water;
  struct box             nodes = grid_nodes(&run.sim->grid);
  FOR_BOX_SERIAL(&run.sim->grid, nodes, i)
  for (int d = 0; d < 2; d++) {
    long at = i * 2 + d;
    if (!(w->water_mass_nc[i] > w->mass_floor && w->mpm->mass_nc[i] > w->mpm->mass_floor)) continue;
    double slip = w->water_vel_new_nc[at] - w->mpm->vel_new_nc[at];
    double impulse = w->mpm->mass_nc[i] * (w->mpm->vel_new_nc[at] - w->solid_star_nc[at]);
    largest = fmax(largest, fabs(impulse));
    error = fmax(error, fabs(impulse - dt * w->drag_nc[i] * slip));
  }
  ck_assert_double_gt(largest, 1e-4);
  ck_assert_double_lt(error, 1e-12 * largest);
  water_close(&run);
}
END_TEST

/* the coefficient belongs to the slip at the end of the step, for a law that is linear in it */
START_TEST(drag_coefficient_knows_the_new_slip)
{
  struct water_run run;
  water_open(drifting, &run);
  water_step(&run, NULL);
  water_step(&run, "mpm.advance_nodes");
  const struct twopoint *w = run.water;
  const struct coupling *c = w->coupling;
  struct box             nodes = grid_nodes(&run.sim->grid);
  int                    n = 0;
  FOR_BOX_SERIAL(&run.sim->grid, nodes, i)
  {
    if (!(w->drag_nc[i] > 1)) continue;
    double slip = hypot(w->water_vel_new_nc[2 * i] - w->mpm->vel_new_nc[2 * i],
                        w->water_vel_new_nc[2 * i + 1] - w->mpm->vel_new_nc[2 * i + 1]);
    double fill = c->bulk_nc[i] / c->room_nc[i], medium = 1 - c->solid_nc[i] / c->bulk_nc[i], K;
    coupling_drag(run.sim->scene, &run.sim->scene->fluid, 1, &w->porosity_nc[i], &fill, &medium, &slip,
                  &c->permeability, &c->diameter, &K);
    K *= c->room_nc[i] * fmin(1, w->water_volume_nc[i] / c->bulk_nc[i]);
    ck_assert_double_eq_tol(w->drag_nc[i], K, 1e-9 * K);
    n++;
  }
  ck_assert_int_gt(n, 20);
  water_close(&run);
}
END_TEST

START_TEST(momentum_and_mass_stay)
{
  struct water_run run;
  struct ledger    before, after;
  water_open(drifting, &run);
  sim_measure(run.sim, &before);
  for (int i = 0; i < 60; i++) water_step(&run, NULL);
  sim_measure(run.sim, &after);
  double scale = (after.v[LEDGER_mass_solid] + after.v[LEDGER_mass_fluid]) * 0.1;
  ck_assert_double_eq(after.v[LEDGER_mass_fluid], before.v[LEDGER_mass_fluid]);
  ck_assert_double_eq(after.v[LEDGER_mass_solid], before.v[LEDGER_mass_solid]);
  ck_assert_double_eq_tol(after.v[LEDGER_momentum_x], before.v[LEDGER_momentum_x], 1e-12 * scale);
  ck_assert_double_eq_tol(after.v[LEDGER_momentum_y], before.v[LEDGER_momentum_y], 1e-12 * scale);
  /* they did exchange something: drag brings the two together */
  ck_assert_double_lt(after.v[LEDGER_kinetic_fluid], 0.9 * before.v[LEDGER_kinetic_fluid]);
  water_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("twopoint.exchange");
  TCase *tests = tcase_create("exchange");
  tcase_add_test(tests, nothing_is_lost_at_a_node);
  tcase_add_test(tests, drag_is_implicit);
  tcase_add_test(tests, drag_coefficient_knows_the_new_slip);
  tcase_add_test(tests, momentum_and_mass_stay);
  suite_add_tcase(suite, tests);
  return water_main(suite);
}
