/* Shear stress of the water: its value, its decay, and where it has no stage. */
#include "mpm/mpm.h"
#include "tests/twopoint/water.h"

#define PERIODIC                                                                                                       \
  "\"boundary\": {\"solid\": {\"x_min\": \"periodic\", \"x_max\": \"periodic\", \"y_min\": \"periodic\", \"y_max\": "  \
  "\"periodic\"}, \"fluid\": {\"x_min\": \"periodic\", \"x_max\": \"periodic\", \"y_min\": \"periodic\", \"y_max\": "  \
  "\"periodic\"}}"
#define WAVE(more)                                                                                                     \
  "{\"title\": \"t\", \"grid\": {\"min\": [0, 0], \"max\": [0.1, 1], \"h\": 0.025}, \"gravity\": [0, 0],"              \
  "\"start\": \"zero\", \"time\": {\"end\": 1}, \"fluid\": {\"path\": \"twopoint\", \"density\": 1, \"bulk_modulus\":" \
  "100, \"viscosity\": 0.02, \"region\": \"everywhere\", \"velocity\": [\"sin(6.283185307179586*y)\", 0]},"            \
  "\"numerics\": {\"basis\": \"cubic\" " more "}, " PERIODIC "}"

/* 1/s: decay of the velocity over 0.3 s */
static double decay(const char *scene, bool shear)
{
  struct water_run run;
  struct ledger    before, after;
  water_open(scene, &run);
  sim_measure(run.sim, &before);
  while (run.sim->t < 0.3) water_step(&run, NULL);
  sim_measure(run.sim, &after);
  ck_assert_double_lt(fabs(after.v[LEDGER_momentum_x]), 1e-13);
  ck_assert(shear == (run.water->shear_w != NULL));
  double rate = -0.5 * log(after.v[LEDGER_kinetic_fluid] / before.v[LEDGER_kinetic_fluid]) / run.sim->t;
  water_close(&run);
  return rate;
}

/* u = sin(ky) decays as exp(-nu k2 t), and without shear only as the transfers damp it; that has no shear stress */
START_TEST(a_shear_wave_decays)
{
  double damping = decay(WAVE(", \"twopoint\": {\"shear\": false}"), false), rate = decay(WAVE(""), true);
  ck_assert_double_lt(damping, 0.15);
  ck_assert_double_eq_tol(rate - damping, 0.02 * 4 * M_PI * M_PI, 0.02 * rate);
}
END_TEST

/* du/dy = g: tau_xy = mu g, nothing else; 3D likewise */
static void couette(const char *scene, int dim)
{
  struct water_run run;
  double           mu = 0.02, slope = 3;
  water_open(scene, &run);
  struct twopoint *w = run.water;
  struct box       all = grid_all(&run.sim->grid);
  FOR_BOX_SERIAL(&run.sim->grid, all, i)
  {
    double x[3];
    grid_node(&run.sim->grid, i, x);
    for (int d = 0; d < dim; d++) w->water_vel_new_nc[i * dim + d] = d == 0 ? slope * x[dim - 1] : 0;
  }
  water_ok(twopoint_nodes_to_points(run.sim, 1e-6));
  for (long p = 0; p < w->points->n; p++)
    for (int q = 0; q < 6; q++)
      ck_assert_double_eq_tol(w->shear_w[6 * p + q], q == (dim == 2 ? 3 : 5) ? mu * slope : 0, 1e-13);
  water_close(&run);
}

#define BOX(min, max, gravity)                                                                                         \
  "{\"title\": \"t\", \"grid\": {\"min\": " min ", \"max\": " max ", \"h\": 0.1}, \"gravity\": " gravity ","           \
  "\"start\": \"zero\", \"time\": {\"end\": 1}, \"fluid\": {\"path\": \"twopoint\", \"density\": 1, \"bulk_modulus\":" \
  "100, \"viscosity\": 0.02, \"region\": \"everywhere\"}, \"numerics\": {\"basis\": \"cubic\"}}"

START_TEST(shear_stress_of_couette_flow)
{
  couette(BOX("[0, 0]", "[0.3, 0.4]", "[0, 0]"), 2);
  couette(BOX("[0, 0, 0]", "[0.3, 0.3, 0.3]", "[0, 0, 0]"), 3);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("twopoint.shear");
  TCase *tests = tcase_create("shear");
  tcase_add_test(tests, a_shear_wave_decays);
  tcase_add_test(tests, shear_stress_of_couette_flow);
  suite_add_tcase(suite, tests);
  return water_main(suite);
}
