/* Porosity that the water sees: of filled space, and steady from step to step. */
#include "coupling/coupling.h"
#include "mpm/mpm.h"
#include "tests/twopoint/water.h"

#define SAND                                                                                                           \
  "\"materials\": {\"sand\": {\"model\": \"linear_elastic\", \"young\": 1e7, \"poisson\": 0.3, \"density\": 2650,"     \
  "\"porosity\": 0.3, \"permeability\": 1e-3}}, \"solids\": {\"all\": {\"material\": \"sand\","                        \
  "\"shape\": {\"box\": {\"min\": [0, 0], \"max\": [null, 0.48]}}}},"

/* a loaded column that drains over its top: water stands above the soil there */
static const char draining[] =
    "{\"title\": \"t\", \"grid\": {\"min\": [0, 0], \"max\": [0.08, 0.64], \"h\": 0.04}, \"gravity\": [0, 0],"
    "\"start\": \"zero\", \"time\": {\"end\": 1}, " SAND "\"boundary\": {\"fluid\": {\"y_max\": {\"pressure\": 0}}},"
    "\"loads\": {\"top\": {\"on\": {\"box\": {\"min\": [null, 0.48], \"max\": [null, 0.48]}}, \"traction\": [0, "
    "-1e4]}},"
    "\"fluid\": {\"path\": \"twopoint\", \"density\": 1000, \"bulk_modulus\": 2.2e9, \"viscosity\": 1e-3,"
    "\"drag\": {\"law\": \"darcy\"}, \"region\": {\"box\": {\"min\": [null, 0], \"max\": [null, 0.48]}}},"
    "\"numerics\": {\"basis\": \"cubic\"}}";

/* the porosity of a step must not answer that of the step before: it did, with more than the error, turn by turn */
START_TEST(porosity_does_not_alternate)
{
  struct water_run run;
  double           before[512], largest = 0;
  water_open(draining, &run);
  const struct twopoint *w = run.water;
  ck_assert_int_lt(w->points->n, 512);
  for (int i = 0; i < 400; i++) {
    memcpy(before, w->porosity_w, (size_t)w->points->n * sizeof *before);
    water_step(&run, NULL);
  }
  for (long p = 0; p < w->points->n; p++) largest = fmax(largest, fabs(w->porosity_w[p] - before[p]));
  ck_assert_double_lt(largest, 1e-5);
  water_close(&run);
}
END_TEST

START_TEST(soil_at_a_surface_is_not_loose)
{
  struct water_run run;
  water_open(draining, &run);
  for (long p = 0; p < run.water->points->n; p++) ck_assert_double_eq_tol(run.water->porosity_w[p], 0.3, 1e-12);
  water_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("twopoint.porosity");
  TCase *tests = tcase_create("porosity");
  tcase_add_test(tests, porosity_does_not_alternate);
  tcase_add_test(tests, soil_at_a_surface_is_not_loose);
  suite_add_tcase(suite, tests);
  return water_main(suite);
}
