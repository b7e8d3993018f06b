/* Points that swell too far: no stress until they are dense again, their volume kept, their energy counted. */
#include "mpm/stages.h"

#include "tests/scene_run.h"

/* a block in the void that swells, or is torn along x, at a given rate */
#define BLOCK                                                                                                          \
  "{\"grid\": {\"min\": [-2, -2], \"max\": [2, 2], \"h\": 0.1}, \"time\": {\"end\": 1}, \"start\": \"zero\","          \
  "\"materials\": {\"m\": {\"model\": \"%s\", \"young\": 1e3, \"poisson\": 0.2, \"density\": 1000}},"                  \
  "\"solids\": {\"block\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [-0.4, -0.4], \"max\": [0.4, 0.4]}},"  \
  "\"velocity\": [\"10*x\", \"10*y\"]}}, \"numerics\": {\"mpm\": {\"max_expansion\": 0.3}}}"

static const char *const laws[] = {"linear_elastic", "neo_hookean"};

static void open_block(const char *law, const char *const *sets, struct scene_run *run)
{
  char text[1024];
  snprintf(text, sizeof text, BLOCK, law);
  scene_open_with(text, sets, run);
}

static double determinant(const struct mpm *m, long p)
{
  const double *F = m->F_p + 4 * p;
  return F[0] * F[3] - F[1] * F[2];
}

static double largest_stress(const struct mpm *m, long p)
{
  double most = 0;
  for (int q = 0; q < 6; q++) most = fmax(most, fabs(m->stress_p[6 * p + q]));
  return most;
}

/* everything flies apart: at the end all points have parted; on the way they carry stress exactly while they have not
 */
START_TEST(points_part_at_the_bound)
{
  struct scene_run run;
  open_block(laws[_i], NULL, &run);
  const struct mpm *m = mpm_of(run.sim);
  double            volume = m->volume_p[0];
  while (run.sim->t < 0.03) {
    scene_step(&run, 1e-4);
    for (long p = 0; p < m->points->n; p++) {
      double J = determinant(m, p);
      ck_assert_double_eq_tol(m->volume_p[p], J * volume, 1e-10 * volume);
      ck_assert(m->parted_p[p] == 1 || J <= 1.3);
      ck_assert((largest_stress(m, p) == 0) == (m->parted_p[p] == 1));
      if (m->parted_p[p] == 1) ck_assert_double_eq_tol(m->F_p[4 * p], sqrt(J), 1e-12);
    }
  }
  for (long p = 0; p < m->points->n; p++) ck_assert_double_eq(m->parted_p[p], 1);
  struct ledger l = scene_ledger(&run);
  ck_assert_double_eq_tol(l.v[LEDGER_elastic], 0, 1e-12 * l.v[LEDGER_kinetic_solid]);
  ck_assert_double_gt(l.v[LEDGER_plastic], 0);
  ck_assert_double_eq_tol(l.v[LEDGER_plastic] + l.v[LEDGER_kinetic_solid],
                          run.sim->ledger_start.v[LEDGER_kinetic_solid],
                          1e-3 * run.sim->ledger_start.v[LEDGER_kinetic_solid]);
  scene_close(&run);
}
END_TEST

/* turned about, the same points close again: no stress before they are as dense as at the start, pressure after */
START_TEST(closing_makes_no_pressure)
{
  struct scene_run run;
  open_block(laws[_i], NULL, &run);
  struct mpm *m = mpm_of(run.sim);
  while (run.sim->t < 0.03) scene_step(&run, 1e-4);
  for (long p = 0; p < 2 * m->points->n; p++) m->vel_p[p] *= -1;
  for (long p = 0; p < 4 * m->points->n; p++) m->affine_p[p] *= -1;
  bool closed = false;
  for (int i = 0; i < 400 && !closed; i++) {
    scene_step(&run, 1e-4);
    for (long p = 0; p < m->points->n; p++) {
      if (m->parted_p[p] == 1) ck_assert_double_eq(largest_stress(m, p), 0);
      if (m->parted_p[p] == 1) ck_assert_double_gt(determinant(m, p), 1);
      closed = closed || (m->parted_p[p] == 0 && m->stress_p[6 * p] < 0);
    }
  }
  ck_assert(closed);
  scene_close(&run);
}
END_TEST

START_TEST(off_by_default)
{
  const char      *sets[] = {"numerics.mpm.max_expansion=infinite", NULL};
  struct scene_run run;
  open_block(laws[0], sets, &run);
  ck_assert_ptr_null(mpm_of(run.sim)->parted_p);
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("parted points");
  TCase *tcase = tcase_create("parted");
  tcase_add_loop_test(tcase, points_part_at_the_bound, 0, 2);
  tcase_add_loop_test(tcase, closing_makes_no_pressure, 0, 2);
  tcase_add_test(tcase, off_by_default);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
