/* The printed forms run, differ from ours where they must, and surface nodes are found. */
#include "mpm/mpm.h"
#include "tests/twopoint/water.h"

#define STILL(numerics)                                                                                                \
  "{\"title\": \"t\", \"grid\": {\"min\": [0, 0], \"max\": [0.2, 1.2], \"h\": 0.05}, \"gravity\": [0, -9.81],"         \
  "\"start\": \"at_rest\", \"time\": {\"end\": 1}, \"fluid\": {\"path\": \"twopoint\", \"density\": 1000,"             \
  "\"bulk_modulus\": 2e6, \"region\": {\"box\": {\"min\": [0, 0], \"max\": [0.2, 1]}}},"                               \
  "\"numerics\": {\"basis\": \"cubic\", \"twopoint\": {" numerics "}}}"
#define PRINTED "\"as_printed\": true, \"averaging_interval\": 1, \"surface_fill\": 0.5"

/* RMS of P over rho g H after half a second */
static double rest_error(const char *scene)
{
  struct water_run run;
  double           sum = 0, K = 2e6, weight = 9810;
  water_open(scene, &run);
  while (run.sim->t < 0.5) water_step(&run, NULL);
  for (long p = 0; p < run.water->points->n; p++) {
    double error = run.water->P_w[p] - K * expm1(weight * (1 - run.water->x_w[2 * p + 1]) / K);
    sum += error * error / (double)run.water->points->n;
  }
  water_close(&run);
  return sqrt(sum) / weight;
}

/* averages of the accumulated Jacobian diffuse it: water at rest loses its pressure */
START_TEST(averages_of_what_has_accumulated_sink)
{
  ck_assert_double_lt(rest_error(STILL("")), 2e-3);
  ck_assert_double_gt(rest_error(STILL(PRINTED)), 5e-3);
}
END_TEST

/* a uniform compression is a uniform compression in these forms too: what they lack are gradients of porosity */
START_TEST(uniform_compression)
{
  struct water_run run;
  water_open("{\"title\": \"t\", \"grid\": {\"min\": [0, 0], \"max\": [0.4, 0.4], \"h\": 0.1}, \"gravity\": [0, 0],"
             "\"start\": \"zero\", \"time\": {\"end\": 1}, \"materials\": {\"sand\": {\"model\": \"linear_elastic\","
             "\"young\": 1e7, \"poisson\": 0.3, \"density\": 2650, \"porosity\": 0.3, \"permeability\": 1e-3}},"
             "\"solids\": {\"all\": {\"material\": \"sand\", \"shape\": \"everywhere\"}}, \"fluid\": {\"path\":"
             "\"twopoint\", \"density\": 1000, \"bulk_modulus\": 2e9, \"viscosity\": 1e-3, \"drag\": {\"law\":"
             "\"darcy\"}, \"region\": \"everywhere\"}, \"numerics\": {\"basis\": \"cubic\", \"twopoint\": {" PRINTED
             "}}}",
             &run);
  struct twopoint *w = run.water;
  struct box       all = grid_all(&run.sim->grid);
  double           rate = 1e-3, dt = 1e-4;
  water_ok(twopoint_find_porosity_printed(run.sim, dt));
  FOR_BOX_SERIAL(&run.sim->grid, all, i)
  {
    double x[3];
    grid_node(&run.sim->grid, i, x);
    for (int d = 0; d < 2; d++) w->water_vel_new_nc[2 * i + d] = w->mpm->vel_new_nc[2 * i + d] = -rate * x[d];
  }
  water_ok(twopoint_strain_solid_printed(run.sim, dt));
  water_ok(twopoint_nodes_to_points(run.sim, dt));
  water_ok(twopoint_update_pressure_printed(run.sim, dt));
  for (long p = 0; p < w->points->n; p++) {
    ck_assert_double_eq_tol(w->porosity_w[p], 0.3, 1e-12);
    ck_assert_double_eq_tol(w->P_w[p], 2e9 / 0.3 * 2 * rate * dt, 1e-6 * 2e9 / 0.3 * 2 * rate * dt);
  }
  water_close(&run);
}
END_TEST

/* the surface stands on nodes at y = 1: theirs and those above */
START_TEST(surface_nodes)
{
  struct water_run run;
  water_open(STILL("\"surface_fill\": 0.6"), &run);
  struct box nodes = grid_nodes(&run.sim->grid);
  water_step(&run, NULL);
  FOR_BOX_SERIAL(&run.sim->grid, nodes, i)
  {
    double x[3];
    grid_node(&run.sim->grid, i, x);
    ck_assert_int_eq(run.water->surface_nc[i] > 0, x[1] > 0.99);
  }
  water_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("twopoint.printed");
  TCase *tests = tcase_create("printed");
  tcase_add_test(tests, averages_of_what_has_accumulated_sink);
  tcase_add_test(tests, uniform_compression);
  tcase_add_test(tests, surface_nodes);
  suite_add_tcase(suite, tests);
  return water_main(suite);
}
