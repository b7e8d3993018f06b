/* Resistance of a space that a skeleton fills partly: what stands in series adds up, for every drag law. */
#include "coupling/coupling.h"

#include "tests/scene_run.h"

enum { N = 5 };
static const double fill[N] = {0, 0.1, 1, 0.35, 0.55}, medium = 0.4, kappa = 1e-9, diameter = 2e-3;

/* a scene with one drag law, default parameters: only what coupling_drag looks at */
static void drag_scene(const char *law, struct scene_run *run)
{
  char text[1024];
  snprintf(text, sizeof text,
           "{\"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.5}, \"time\": {\"end\": 1}, \"materials\": {\"m\": "
           "{\"model\": \"rigid\", \"density\": 2650, \"porosity\": 0.4, \"permeability\": 1e-3, \"grain_diameter\": "
           "2e-3}}, \"solids\": {\"b\": {\"material\": \"m\", \"shape\": \"everywhere\"}}, \"fluid\": {\"path\": "
           "\"ice\", \"density\": 1000, \"viscosity\": 1e-3, \"drag\": {\"law\": \"%s\"}}}",
           law);
  scene_open(text, run);
}

/* a superficial velocity q through five places of equal length, of which the skeleton fills shares that make two: the
 * pressure drop is that of two full ones */
START_TEST(places_in_series_add_up)
{
  for (const struct drag_law *const *law = drag_laws; *law; law++) {
    struct scene_run run;
    double           porosity[N], m[N], slip[N], permeability[N], D[N], K[N], drop = 0, length = 0, q = 0.05;
    drag_scene((*law)->name, &run);
    for (int i = 0; i < N; i++) {
      porosity[i] = 1 - fill[i] * (1 - medium);
      m[i] = medium;
      slip[i] = q / porosity[i];
      permeability[i] = kappa;
      D[i] = diameter;
      length += fill[i];
    }
    coupling_drag(run.sim->scene, &run.sim->scene->fluid, N, porosity, fill, m, slip, permeability, D, K);
    for (int i = 0; i < N; i++) drop += K[i] * slip[i] / porosity[i]; /* n grad P = K s */
    double             full[1] = {q / medium}, one[1];
    struct drag_medium whole = {
        .porosity = m, .slip = full, .permeability = permeability, .diameter = D, .density = 1000, .viscosity = 1e-3};
    (*law)->coefficient(run.sim->scene->fluid.drag_params, 1, &whole, one);
    double exact = length * one[0] * full[0] / medium;
    ck_assert_double_gt(exact, 0);
    ck_assert_double_eq_tol(drop, exact, 1e-13 * exact);
    ck_assert_double_eq(K[0], 0);
    scene_close(&run);
  }
}
END_TEST

START_TEST(permeability_of_a_material)
{
  struct scene_run run;
  drag_scene("darcy", &run);
  ck_assert_double_eq_tol(coupling_permeability(run.sim->scene, &run.sim->scene->materials[0]),
                          1e-3 * 1e-3 / (1000 * 9.81), 1e-24);
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("resistance");
  TCase *tcase = tcase_create("drag");
  tcase_add_test(tcase, places_in_series_add_up);
  tcase_add_test(tcase, permeability_of_a_material);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
