/* Hybrid strain smoothing: what it must not change, and what it smooths. */
#include "mpm/stages.h"

#include "tests/scene_run.h"

/* a block of 8 x 6 cells that touches nothing and strains evenly, or by a checkerboard of the points */
#define BLOCK                                                                                                          \
  "{\"grid\": {\"min\": [-1, 0], \"max\": [1, 2], \"h\": 0.1}, \"time\": {\"end\": 1}, \"start\": \"zero\","           \
  "\"materials\": {\"m\": {\"model\": \"linear_elastic\", \"young\": 1, \"poisson\": 0.3, \"density\": 1000}},"        \
  "\"solids\": {\"block\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [-0.4, 1], \"max\": [0.4, 1.6]}},"     \
  "\"velocity\": [%s]}}}"

static const char *const timings[] = {"numerics.stress_timing=usl", "numerics.stress_timing=musl"};
static const char *const bases[] = {"numerics.basis=linear", "numerics.basis=gimp", "numerics.basis=quadratic",
                                    "numerics.basis=cubic"};

static void open_block(const char *velocity, const char *const *sets, struct scene_run *run)
{
  char text[1024];
  snprintf(text, sizeof text, BLOCK, velocity);
  scene_open_with(text, sets, run);
}

/* turning, shear and swelling: the same in every point, and so it stays */
START_TEST(even_strain_stays)
{
  for (int basis = 0; basis < 4; basis++) {
    const char      *sets[] = {"numerics.mpm.smoothing=1", timings[_i], bases[basis], NULL};
    struct scene_run run;
    open_block("\"0.2*x-0.5*y\", \"0.7*x+0.1*y\"", sets, &run);
    scene_step_to(&run, 1e-3, "mpm.take_smoothed");
    const struct mpm *m = mpm_of(run.sim);
    double            expected[4] = {0.2, -0.5, 0.7, 0.1}, tolerance = _i ? 1e-3 : 1e-10; /* musl: of O(dt) */
    for (long p = 0; p < 4 * m->points->n; p++) ck_assert_double_eq_tol(m->gradv_p[p], expected[p % 4], tolerance);
    scene_close(&run);
  }
}
END_TEST

/* of one solid */
static double rate_of_volume(const struct mpm *m, int solid)
{
  double rate = 0;
  for (long p = 0; p < m->points->n; p++)
    if (m->points->group[p] == solid) rate += m->volume_p[p] * (m->gradv_p[4 * p] + m->gradv_p[4 * p + 3]);
  return rate;
}

static double roughness(const struct mpm *m)
{
  double sum = 0, square = 0, n = (double)m->points->n;
  for (long p = 0; p < m->points->n; p++) {
    double rate = m->gradv_p[4 * p] + m->gradv_p[4 * p + 3];
    sum += rate;
    square += rate * rate;
  }
  return sqrt(square / n - sum * sum / (n * n));
}

/* a short wave is flattened, in proportion to the share, and the rate of the whole volume is kept */
START_TEST(short_waves_are_flattened)
{
  double rate[3], rough[3];
  for (int i = 0; i < 3; i++) {
    char        share[40];
    const char *sets[] = {share, timings[0], NULL};
    snprintf(share, sizeof share, "numerics.mpm.smoothing=%g", i == 0 ? 1e-9 : 0.5 * i);
    struct scene_run run;
    open_block("\"0.02*sin(pi*x/0.1)+0.1*x\", 0", sets, &run);
    scene_step_to(&run, 1e-3, "mpm.take_smoothed");
    rate[i] = rate_of_volume(mpm_of(run.sim), 0);
    rough[i] = roughness(mpm_of(run.sim));
    scene_close(&run);
  }
  ck_assert_double_eq_tol(rate[1], rate[0], 1e-10);
  ck_assert_double_eq_tol(rate[2], rate[0], 1e-10);
  ck_assert_double_lt(rough[2], 0.5 * rough[0]);
  ck_assert_double_gt(rough[1], rough[2]);
  ck_assert_double_lt(rough[1], rough[0]);
}
END_TEST

/* what one solid swells by, it keeps, though the other one shares its nodes */
START_TEST(solids_are_smoothed_apart)
{
  static const char two[] =
      "{\"grid\": {\"min\": [-1, 0], \"max\": [1, 2], \"h\": 0.1}, \"time\": {\"end\": 1}, \"start\": \"zero\","
      "\"materials\": {\"m\": {\"model\": \"linear_elastic\", \"young\": 1, \"poisson\": 0.3, \"density\": 1000}},"
      "\"solids\": {\"still\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [-0.4, 0.5], \"max\": [0.4, 1]}}},"
      "\"moving\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [-0.4, 1], \"max\": [0.4, 1.5]}},"
      "\"velocity\": [\"x\", \"y*y-1\"]}}}";
  double rate[2];
  for (int i = 0; i < 2; i++) {
    const char      *sets[] = {i ? "numerics.mpm.smoothing=1" : "numerics.mpm.smoothing=1e-12", NULL};
    struct scene_run run;
    scene_open_with(two, sets, &run);
    scene_step_to(&run, 1e-3, "mpm.take_smoothed");
    rate[i] = rate_of_volume(mpm_of(run.sim), 0);
    scene_close(&run);
  }
  ck_assert_double_gt(fabs(rate[0]), 1e-3);
  ck_assert_double_eq_tol(rate[1], rate[0], 1e-11);
}
END_TEST

/* ---- what it is for: a column of dry sand whose gate is taken away ---- */

#define COLUMN                                                                                                         \
  "{\"grid\": {\"min\": [0, 0], \"max\": [0.3976, 0.1624], \"h\": 0.0056}, \"time\": {\"end\": 1}, \"gravity\": [0, "  \
  "-9.81],"                                                                                                            \
  "\"materials\": {\"sand\": {\"model\": \"mohr_coulomb\", \"young\": 1e6, \"poisson\": 0.3, \"density\": 2500,"       \
  "\"friction_angle_deg\": 28}}, \"solids\": {\"column\": {\"material\": \"sand\", \"shape\": {\"box\": {\"min\": "    \
  "[0, 0],"                                                                                                            \
  "\"max\": [0.056, 0.1344]}}}}, \"boundary\": {\"solid\": {\"y_min\": {\"friction\": 0.53}}},"                        \
  "\"obstacles\": {\"gate\": {\"shape\": {\"half_space\": {\"point\": [0.056, 0], \"normal\": [-1, 0]}}, \"until\": "  \
  "0}},"                                                                                                               \
  "\"numerics\": {\"aflip_beta\": 0.01}}"

/* Pa: standard deviation of sigma_yy about its mean over the points within 2 h along both axes */
static double unevenness(const struct scene_run *run)
{
  const struct mpm *m = mpm_of(run->sim);
  double            reach = 2 * run->sim->grid.h, sum = 0, square = 0, n = (double)m->points->n;
  for (long p = 0; p < m->points->n; p++) {
    double mean = 0, around = 0;
    for (long q = 0; q < m->points->n; q++) {
      if (fabs(m->x_p[2 * q] - m->x_p[2 * p]) > reach || fabs(m->x_p[2 * q + 1] - m->x_p[2 * p + 1]) > reach) continue;
      mean += m->stress_p[6 * q + 1];
      around++;
    }
    double apart = m->stress_p[6 * p + 1] - mean / around;
    sum += apart;
    square += apart * apart;
  }
  return sqrt(square / n - sum * sum / (n * n));
}

static double collapse(const char *smoothing, const char *basis, const char *timing)
{
  const char      *sets[] = {smoothing, basis, timing, NULL};
  struct scene_run run;
  scene_open_with(COLUMN, sets, &run);
  while (run.sim->t < 0.2) scene_step(&run, 1);
  double result = unevenness(&run);
  scene_close(&run);
  return result;
}

/* half and less of what is without: quadratic functions with usl, cubic ones with musl */
START_TEST(stresses_of_a_collapse_are_smooth)
{
  const char *basis = bases[2 + _i], *timing = timings[_i];
  double      rough = collapse("numerics.mpm.smoothing=0", basis, timing);
  double      smooth = collapse("numerics.mpm.smoothing=1", basis, timing);
  ck_assert_msg(smooth <= 0.5 * rough, "%s %s: %g Pa, without smoothing %g Pa", basis, timing, smooth, rough);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("smoothing");
  TCase *tcase = tcase_create("hybrid");
  tcase_add_loop_test(tcase, even_strain_stays, 0, 2);
  tcase_add_test(tcase, short_waves_are_flattened);
  tcase_add_test(tcase, solids_are_smoothed_apart);
  tcase_add_loop_test(tcase, stresses_of_a_collapse_are_smooth, 0, 2);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
