/* The shock tube of Sod on finer and finer grids: mean sizes of the errors are printed, their orders are held. First
 * order is all that a shock allows, and a contact that spreads with the cube root of the steps leaves less. */
#include "ice/ice.h"
#include "references/reference.h"

#include "tests/scene_run.h"

static const char scene[] =
    "{\"grid\": {\"min\": [0, 0], \"max\": [1, null], \"h\": 0.01}, \"time\": {\"end\": 0.2}, \"gravity\": [0, 0], "
    "\"start\": \"zero\", \"fluid\": {\"path\": \"ice\", \"density\": 1, \"viscosity\": 0, \"eos\": {\"law\": "
    "\"ideal_gas\", \"reference_pressure\": 1, \"reference_temperature\": 1, \"heat_capacity\": 2.5}, \"pressure\": "
    "\"1 - 0.9*step(x - 0.5)\", \"temperature\": \"1 - 0.2*step(x - 0.5)\"}, \"references\": {\"exact\": {\"kind\": "
    "\"riemann\", \"left_density\": 1, \"left_pressure\": 1, \"right_density\": 0.125, \"right_pressure\": 0.1}}, "
    "\"numerics\": {\"ice\": {\"shocks\": true, \"acoustic_courant\": 0.4}}}";

enum { DENSITY, VELOCITY, PRESSURE, N_ERRORS };
static const char *const names[N_ERRORS] = {"density", "vel_x", "P"};

/* theta; limits of the errors with 200 cells, and of their orders */
static const struct ladder {
  const char *theta;
  double      most[N_ERRORS], order;
} ladders[] = {{"numerics.theta=0.5", {0.005, 0.010, 0.004}, 0.8}, {"numerics.theta=1.0", {0.010, 0.020, 0.008}, 0.8}};

/* mean sizes of the differences to the exact solution at the centres of the cells */
static void compare(const struct scene_run *run, double error[N_ERRORS])
{
  const struct ice           *ice = ice_of(run->sim);
  const struct reference_use *use = &run->loaded->scene.references[0];
  const struct grid          *g = &run->sim->grid;
  struct box                  cells = grid_cells(g);
  for (int k = 0; k < N_ERRORS; k++) {
    int quantity = reference_quantity(use->reference, names[k]);
    error[k] = 0;
    FOR_BOX_SERIAL(g, cells, c)
    {
      double x[1][3], exact, own = k == DENSITY ? ice->rho_cc[c] : k == VELOCITY ? ice->vel_cc[2 * c] : ice->P_cc[c];
      grid_centre(g, c, x[0]);
      must(use->reference->value(use->params, quantity, 1, (const double(*)[3])x, 0.2, &exact));
      error[k] += fabs(own - exact) / g->n[0];
    }
  }
}

static void errors_of(const char *theta, int n, double error[N_ERRORS])
{
  char             h[64];
  const char      *sets[] = {theta, h, NULL};
  struct scene_run run;
  snprintf(h, sizeof h, "grid.h=%.17g", 1.0 / n);
  scene_open_with(scene, sets, &run);
  while (run.sim->t < 0.2) scene_step(&run, 0.2 - run.sim->t);
  compare(&run, error);
  scene_close(&run);
}

START_TEST(errors_fall_with_h)
{
  const struct ladder *ladder = &ladders[_i];
  double               error[N_ERRORS], last[N_ERRORS] = {0};
  printf("tube of Sod, %s\n", ladder->theta);
  for (int n = 100; n <= 400; n *= 2) {
    errors_of(ladder->theta, n, error);
    printf("  n %3d ", n);
    for (int k = 0; k < N_ERRORS; k++) {
      double order = log2(last[k] / error[k]);
      printf("  %s %.5f", names[k], error[k]);
      if (n > 100) printf(" order %.2f", order);
      if (n > 100) ck_assert_double_ge(order, ladder->order);
      if (n == 200) ck_assert_double_lt(error[k], ladder->most[k]);
      last[k] = error[k];
    }
    printf("\n");
  }
  fflush(stdout);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("shock");
  TCase *tcase = tcase_create("shock");
  tcase_add_loop_test(tcase, errors_fall_with_h, 0, 2);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
