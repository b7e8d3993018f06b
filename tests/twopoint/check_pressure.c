/* Pressure from the flux: uniform compression is exact, averages keep what is linear, walls included. */
#include "coupling/coupling.h"
#include "mpm/mpm.h"
#include "tests/twopoint/water.h"

#define GRID2 "\"grid\": {\"min\": [0, 0], \"max\": [0.5, 0.4], \"h\": 0.1}, \"gravity\": [0, 0],"
#define GRID3 "\"grid\": {\"min\": [0, 0, 0], \"max\": [0.5, 0.4, 0.3], \"h\": 0.1}, \"gravity\": [0, 0, 0],"
#define FLUID                                                                                                          \
  "\"start\": \"zero\", \"time\": {\"end\": 1}, \"fluid\": {\"path\": \"twopoint\", \"density\": 1000,"                \
  "\"bulk_modulus\": 2e9, \"viscosity\": 1e-3, \"drag\": {\"law\": \"darcy\"}, \"region\": \"everywhere\"},"           \
  "\"numerics\": {\"basis\": \"cubic\", \"stress_timing\": \"usl\"}"
#define SAND                                                                                                           \
  "\"materials\": {\"sand\": {\"model\": \"linear_elastic\", \"young\": 1e7, \"poisson\": 0.3, \"density\": 2650,"     \
  "\"porosity\": 0.3, \"permeability\": 1e-3}}, \"solids\": {\"all\": {\"material\": \"sand\","                        \
  "\"shape\": {\"box\": {\"min\": [0, 0], \"max\": [0.5, 0.4]}}}},"

static const char bare2[] = "{\"title\": \"t\", " GRID2 FLUID "}";
static const char bare3[] = "{\"title\": \"t\", " GRID3 FLUID "}";
static const char soil2[] = "{\"title\": \"t\", " GRID2 SAND FLUID "}";

/* a velocity field that shrinks space at the rate `rate` along every axis, at all nodes */
static void shrink(const struct sim *sim, double rate, double *vel_nc)
{
  const struct grid *g = &sim->grid;
  struct box         all = grid_all(g);
  FOR_BOX_SERIAL(g, all, i)
  {
    double x[3];
    grid_node(g, i, x);
    for (int d = 0; d < g->dim; d++) vel_nc[i * g->dim + d] = -rate * x[d];
  }
}

/* from nodal velocities to pressures, as in a step */
static void strain(struct water_run *run, double dt)
{
  if (run->water->coupling) water_ok(twopoint_strain_water(run->sim, dt));
  water_ok(twopoint_nodes_to_points(run->sim, dt));
  water_ok(twopoint_gather_water(run->sim, dt));
  water_ok(twopoint_average_and_update(run->sim, dt));
  water_ok(twopoint_average_pressure(run->sim, dt)); /* step 0 is averaged */
}

static void find_porosity(struct water_run *run)
{
  water_ok((run->water->coupling ? twopoint_find_porosity : twopoint_find_fill)(run->sim, 0));
}

/* water and skeleton, if any, shrink alike: ln J falls by rate * dim * dt / n at every point */
static void compress(const char *scene, double n)
{
  struct water_run run;
  water_open(scene, &run);
  struct twopoint *w = run.water;
  int              dim = run.sim->grid.dim;
  double           rate = 1e-3, dt = 1e-4, J = exp(-rate * dim * dt / n);
  find_porosity(&run);
  shrink(run.sim, rate, w->water_vel_new_nc);
  if (w->mpm) shrink(run.sim, rate, w->mpm->vel_new_nc);
  strain(&run, dt);
  for (long p = 0; p < w->points->n; p++) {
    ck_assert_double_eq_tol(w->porosity_w[p], n, 1e-12);
    ck_assert_double_eq_tol(w->J_w[p], J, 1e-15);
    ck_assert_double_eq_tol(w->P_w[p], 2e9 * (1 / J - 1), 1e-8 * 2e9 * (1 / J - 1));
  }
  water_close(&run);
}

START_TEST(uniform_compression_2d) { compress(bare2, 1); }
END_TEST
START_TEST(uniform_compression_3d) { compress(bare3, 1); }
END_TEST
START_TEST(uniform_compression_of_soil) { compress(soil2, 0.3); }
END_TEST

/* water alone flows into soil that stands still: what the flux form counts is n v_f */
START_TEST(flux_counts_the_water_that_is_there)
{
  struct water_run run;
  water_open(soil2, &run);
  struct twopoint *w = run.water;
  double           rate = 1e-3, dt = 1e-4;
  find_porosity(&run);
  shrink(run.sim, rate, w->water_vel_new_nc);
  twopoint_clear(run.sim, 2, w->mpm->vel_new_nc);
  strain(&run, dt);
  for (long p = 0; p < w->points->n; p++) ck_assert_double_eq_tol(w->J_w[p], exp(-rate * 2 * dt), 1e-15);
  water_close(&run);
}
END_TEST

static double linear(const double *x, int dim) { return 5 - 3 * x[0] + 7 * x[1] + (dim == 3 ? 2 * x[2] : 0); }

static void average_linear(const char *scene)
{
  static const double slope[3] = {-3, 7, 2};
  struct water_run    run;
  water_open(scene, &run);
  struct twopoint *w = run.water;
  int              dim = run.sim->grid.dim;
  find_porosity(&run);
  for (long p = 0; p < w->points->n; p++) {
    w->P_w[p] = linear(w->x_w + p * dim, dim);
    memcpy(w->gradP_w + p * dim, slope, (size_t)dim * sizeof *slope);
    w->volume_w[p] *= 1 + 0.3 * sin(40 * w->x_w[p * dim]); /* points of different weight */
  }
  twopoint_average(run.sim, w, w->P_w, w->gradP_w, true);
  for (long p = 0; p < w->points->n; p++) {
    ck_assert_double_eq_tol(w->P_w[p], linear(w->x_w + p * dim, dim), 1e-12);
    for (int d = 0; d < dim; d++) ck_assert_double_eq_tol(w->gradP_w[p * dim + d], slope[d], 1e-11);
  }
  water_close(&run);
}

START_TEST(average_keeps_linear_fields)
{
  average_linear(bare2);
  average_linear(bare3);
}
END_TEST

/* ... and flattens what alternates from point to point: to nothing inside, to a tenth at walls */
START_TEST(average_removes_checkerboard)
{
  struct water_run run;
  water_open(bare2, &run);
  struct twopoint *w = run.water;
  find_porosity(&run);
  for (long p = 0; p < w->points->n; p++)
    w->P_w[p] = ((long)floor(w->x_w[2 * p] / 0.05) + (long)floor(w->x_w[2 * p + 1] / 0.05)) % 2 ? 1 : -1;
  twopoint_average(run.sim, w, w->P_w, w->gradP_w, true);
  for (long p = 0; p < w->points->n; p++) ck_assert_double_lt(fabs(w->P_w[p]), 0.12);
  water_close(&run);
}
END_TEST

START_TEST(expansion_is_capped)
{
  struct water_run run;
  water_open(bare2, &run);
  struct twopoint *w = run.water;
  find_porosity(&run);
  shrink(run.sim, -1, w->water_vel_new_nc);
  strain(&run, 0.01);
  for (long p = 0; p < w->points->n; p++) ck_assert_double_eq_tol(w->J_w[p], 1.001, 1e-12);
  water_close(&run);
}
END_TEST

/* the volume that water fills is grains and water: in a box full of both it is the box */
START_TEST(water_fills_the_pores)
{
  struct water_run run;
  water_open(soil2, &run);
  struct twopoint *w = run.water;
  double           filled = 0, mass = 0;
  for (long p = 0; p < w->points->n; p++) {
    filled += w->volume_w[p];
    mass += w->mass_w[p];
  }
  ck_assert_double_eq_tol(filled, 0.5 * 0.4, 1e-14);
  ck_assert_double_eq_tol(mass, 0.3 * 1000 * 0.5 * 0.4, 1e-10);
  water_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("twopoint.pressure");
  TCase *tests = tcase_create("pressure");
  tcase_add_test(tests, uniform_compression_2d);
  tcase_add_test(tests, uniform_compression_3d);
  tcase_add_test(tests, uniform_compression_of_soil);
  tcase_add_test(tests, flux_counts_the_water_that_is_there);
  tcase_add_test(tests, average_keeps_linear_fields);
  tcase_add_test(tests, average_removes_checkerboard);
  tcase_add_test(tests, expansion_is_capped);
  tcase_add_test(tests, water_fills_the_pores);
  suite_add_tcase(suite, tests);
  return water_main(suite);
}
