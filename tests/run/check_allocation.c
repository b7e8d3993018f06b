/* A step allocates nothing, whatever the path and the solver. */
#include "tests/scene_run.h"

#define SOIL                                                                                                           \
  "{\"grid\": {\"min\": [0, 0], \"max\": [0.6, 1.2], \"h\": 0.1}, \"time\": {\"end\": 10}, \"gravity\": [0, -9.81],"   \
  "\"start\": \"zero\", \"materials\": {\"soil\": {\"model\": \"linear_elastic\", \"young\": 1e6, \"poisson\": 0.3,"   \
  "\"density\": 2650, \"porosity\": 0.4, \"permeability\": 1e-3}, \"clay\": {\"model\": \"neo_hookean\", \"young\": "  \
  "1e6, \"poisson\": 0.3, \"density\": 2650, \"porosity\": 0.5, \"permeability\": 1e-5}},"                             \
  "\"solids\": {\"low\": {\"material\": \"soil\", \"shape\": {\"box\": {\"min\": [null, null], \"max\": [0.4, "        \
  "0.4]}}},"                                                                                                           \
  "\"high\": {\"material\": \"clay\", \"shape\": {\"box\": {\"min\": [null, 0.4], \"max\": [0.4, 0.8]}}}},"            \
  "\"loads\": {\"top\": {\"on\": {\"box\": {\"min\": [0, 0.8], \"max\": [0.4, 0.8]}}, \"traction\": [0, -100]}},"      \
  "\"tracers\": {\"corner\": [0.4, 0.8]}"
#define WATER(path)                                                                                                    \
  ", \"fluid\": {\"path\": \"" path "\", \"bulk_modulus\": 1e7, \"region\": {\"box\": {\"min\": [null, null], "        \
  "\"max\": [null, 1]}}}"

static const struct {
  const char *text, *set;
} scenes[] = {
    {SOIL "}", "numerics.stress_timing=usl"},
    {SOIL "}", "numerics.stress_timing=musl"},
    {SOIL
     ", \"boundary\": {\"solid\": {\"y_min\": {\"friction\": 0.4}}}, \"obstacles\": {\"wall\": {\"shape\": "
     "{\"half_space\": {\"point\": [0.42, 0], \"normal\": [-1, 0.1]}}}}, \"gauges\": {\"left\": {\"kind\": \"wall\", "
     "\"on\": \"x_min\", \"of\": \"force_x\"}}}",
     "numerics.stress_timing=musl"},
    {SOIL WATER("ice") "}", "numerics.pressure_solver=direct"},
    {SOIL WATER("ice") "}", "numerics.pressure_solver=hypre"},
    {SOIL WATER("twopoint") "}", "numerics.basis=cubic"},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

START_TEST(steps_allocate_nothing)
{
  const char      *sets[] = {scenes[_i].set, NULL};
  struct scene_run run;
  scene_open_with(scenes[_i].text, sets, &run);
  long before = memory_calls();
  scene_steps(&run, 50, INFINITY);
  ck_assert_int_eq(memory_calls(), before);
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("allocation");
  TCase *tcase = tcase_create("steps");
  tcase_add_loop_test(tcase, steps_allocate_nothing, 0, SCENES);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
