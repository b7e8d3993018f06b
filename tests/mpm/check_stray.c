/* Points that leave the grid: stop, put back, delete; what they take along is in the ledger; the set really shrinks. */
#include "mpm/stages.h"

#include "core/parallel.h"
#include "run/checkpoint.h"
#include "run/files.h"
#include "tests/scene_run.h"

/* a block that slides out of an open side */
#define SCENE                                                                                                          \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1, 0.4], \"h\": 0.05}, \"time\": {\"end\": 1}, \"start\": \"zero\","         \
  "\"materials\": {\"soil\": {\"model\": \"linear_elastic\", \"young\": 1e5, \"poisson\": 0.3, \"density\": 2000}},"   \
  "\"solids\": {\"block\": {\"material\": \"soil\", \"shape\": {\"box\": {\"min\": [0.3, 0], \"max\": [0.7, 0.3]}},"   \
  "\"velocity\": [3, \"x\"]}}, \"gravity\": [0, -9.81],"                                                               \
  "\"boundary\": {\"solid\": {\"x_max\": \"open\"}}}"

static const char *const clamp[] = {"numerics.mpm.stray=clamp", NULL};
static const char *const delete[] = {"numerics.mpm.stray=delete", NULL};

static double sum(const struct ledger *l, const enum ledger_entry *entries, int n)
{
  double total = 0;
  for (int i = 0; i < n; i++) total += l->v[entries[i]];
  return total;
}

static const enum ledger_entry masses[] = {LEDGER_mass_solid, LEDGER_mass_solid_out, LEDGER_mass_solid_lost};
static const enum ledger_entry along_x[] = {LEDGER_momentum_x, LEDGER_momentum_out_x};

/* steps until something fails or `n` are done */
static enum status step_freely(struct scene_run *run, int n)
{
  for (int i = 0; i < n; i++) {
    const char *by;
    double      dt = fmin(1e-3, sim_dt_limit(run->sim, &run->plan, &by));
    run->sim->dt = dt;
    for (int s = 0; s < run->plan.n_stages; s++) {
      enum status status = run->plan.stages[s]->run(run->sim, dt);
      if (status != OK) return status;
    }
    run->sim->t += dt;
    run->sim->step++;
  }
  return OK;
}

START_TEST(stops_by_default)
{
  struct scene_run run;
  scene_open(SCENE, &run);
  ck_assert_int_eq(step_freely(&run, 400), ERR_DIVERGED);
  ck_assert_ptr_nonnull(strstr(status_message(), "solids.block"));
  ck_assert_ptr_nonnull(strstr(status_message(), "numerics.mpm.stray"));
  scene_close(&run);
}
END_TEST

/* everything leaves, and everything is accounted for */
START_TEST(flows_out_of_an_open_side)
{
  struct scene_run run;
  scene_open_with(SCENE, delete, &run);
  struct mpm   *m = mpm_of(run.sim);
  struct ledger start = scene_ledger(&run), now;
  long          all = m->points->n, before = all;
  while (m->points->n > 0) {
    scene_step(&run, 1e-3);
    ck_assert_int_le(m->points->n, before);
    before = m->points->n;
    now = scene_ledger(&run);
    ck_assert_double_eq_tol(sum(&now, masses, 3), start.v[LEDGER_mass_solid], 1e-10);
    ck_assert_double_eq_tol(sum(&now, along_x, 2), start.v[LEDGER_momentum_x], 1e-9);
    ck_assert_double_lt(run.sim->t, 0.5);
  }
  ck_assert_double_eq_tol(now.v[LEDGER_mass_solid_out], start.v[LEDGER_mass_solid], 1e-10);
  ck_assert_double_eq(now.v[LEDGER_mass_solid_lost], 0);
  ck_assert_double_eq(m->now.strays.flowed_out, (double)all);
  ck_assert_double_gt(now.v[LEDGER_energy_out], start.v[LEDGER_kinetic_solid]);
  scene_steps(&run, 3, 1e-3); /* an empty set goes on */
  scene_close(&run);
}
END_TEST

/* moves the points of the column nearest x = 0.3 to the left of the grid; returns how many */
static int push_out(struct mpm *m)
{
  int n = 0;
  for (long p = 0; p < m->points->n; p++)
    if (m->x_p[2 * p] < 0.32) {
      m->x_p[2 * p] -= 0.4;
      m->vel_p[2 * p] = -5;
      n++;
    }
  return n;
}

START_TEST(deleted_behind_a_wall_is_lost)
{
  struct scene_run run;
  scene_open_with(SCENE, delete, &run);
  struct mpm   *m = mpm_of(run.sim);
  long          all = m->points->n;
  int           n = push_out(m);
  struct ledger before = scene_ledger(&run);
  for (long p = 0; p < all; p++) m->displacement_p[2 * p] = m->x_p[2 * p]; /* a label that must follow */
  must(mpm_sort_points(run.sim, 1e-3));
  struct ledger after = scene_ledger(&run);
  ck_assert_int_gt(n, 0);
  ck_assert_int_eq(m->points->n, all - n);
  ck_assert_double_eq(m->now.strays.deleted, n);
  ck_assert_double_eq_tol(after.v[LEDGER_mass_solid_lost], n * m->mass_p[0], 1e-12);
  ck_assert_double_eq(after.v[LEDGER_mass_solid_out], 0);
  ck_assert_double_eq_tol(sum(&after, along_x, 2), before.v[LEDGER_momentum_x], 1e-10);
  for (long p = 0; p < m->points->n; p++) {
    ck_assert(points_inside(&run.sim->grid, m->x_p + 2 * p));
    ck_assert_double_eq(m->displacement_p[2 * p], m->x_p[2 * p]);
  }
  scene_close(&run);
}
END_TEST

START_TEST(clamped_points_stay_inside)
{
  struct scene_run run;
  scene_open_with(SCENE, clamp, &run);
  struct mpm   *m = mpm_of(run.sim);
  long          all = m->points->n;
  int           n = push_out(m), found = 0;
  struct ledger before = scene_ledger(&run);
  must(mpm_sort_points(run.sim, 1e-3));
  struct ledger after = scene_ledger(&run);
  ck_assert_int_eq(m->points->n, all);
  ck_assert_double_eq(m->now.strays.put_back, n);
  for (long p = 0; p < all; p++) {
    ck_assert(points_inside(&run.sim->grid, m->x_p + 2 * p));
    if (m->x_p[2 * p] > 0.1) continue;
    found++;
    ck_assert_double_eq(m->vel_p[2 * p], 0);
    ck_assert_double_eq_tol(m->displacement_p[2 * p], 0.0875, 1e-6); /* from x = 0.3125 - 0.4 */
  }
  ck_assert_int_eq(found, n);
  ck_assert_double_eq_tol(after.v[LEDGER_momentum_out_x], -5 * n * m->mass_p[0], 1e-10);
  ck_assert_double_eq_tol(sum(&after, along_x, 2), before.v[LEDGER_momentum_x], 1e-10);
  ck_assert_double_gt(after.v[LEDGER_energy_out], 0);
  scene_steps(&run, 100, 1e-3);
  scene_close(&run);
}
END_TEST

/* a place that is no number has no side: that run is lost whatever the scene says */
START_TEST(no_number_is_never_forgiven)
{
  struct scene_run run;
  scene_open_with(SCENE, _i ? clamp : delete, &run);
  mpm_of(run.sim)->x_p[5] = NAN;
  ck_assert_int_eq(mpm_sort_points(run.sim, 1e-3), ERR_DIVERGED);
  scene_close(&run);
}
END_TEST

static void same_points(const struct scene_run *a, const struct scene_run *b)
{
  const struct mpm *m = mpm_of(a->sim), *o = mpm_of(b->sim);
  size_t            n = (size_t)m->points->n;
  ck_assert_int_eq(m->points->n, o->points->n);
  ck_assert(memcmp(m->x_p, o->x_p, 2 * n * sizeof(double)) == 0);
  ck_assert(memcmp(m->vel_p, o->vel_p, 2 * n * sizeof(double)) == 0);
  ck_assert(memcmp(m->stress_p, o->stress_p, 6 * n * sizeof(double)) == 0);
  ck_assert(memcmp(&m->now, &o->now, sizeof m->now) == 0);
}

START_TEST(the_same_bits_with_any_number_of_threads)
{
  struct scene_run one, more;
  scene_open_with(SCENE, delete, &one);
  scene_steps(&one, 150, 1e-3);
  ck_assert_double_gt(mpm_of(one.sim)->now.strays.flowed_out, 0);
  ck_assert_int_gt(mpm_of(one.sim)->points->n, 0);
  scene_open_with(SCENE, delete, &more);
  parallel_set_threads(4);
  scene_steps(&more, 150, 1e-3);
  parallel_set_threads(1);
  same_points(&one, &more);
  scene_close(&one);
  scene_close(&more);
}
END_TEST

/* a checkpoint of a set that has shrunk, read into one that has not */
START_TEST(resumes_with_the_same_bits)
{
  char             folder[] = "/tmp/check_stray_XXXXXX", used[64], file[64];
  struct scene_run whole, first, second;
  ck_assert_ptr_nonnull(mkdtemp(folder));
  snprintf(used, sizeof used, "%s/scene.used.json", folder);
  snprintf(file, sizeof file, "%s/checkpoint.h5", folder);
  must(files_replace(used, "{}", 2));
  scene_open_with(SCENE, delete, &whole);
  scene_open_with(SCENE, delete, &first);
  scene_open_with(SCENE, delete, &second);
  scene_steps(&whole, 200, 1e-3);
  scene_steps(&first, 140, 1e-3);
  ck_assert_int_lt(mpm_of(first.sim)->points->n, mpm_of(second.sim)->points->n);
  int                    n = sizeof(struct mpm_numbers) / sizeof(double);
  struct checkpoint_item out = {"mpm", n, (double *)&mpm_of(first.sim)->now};
  struct checkpoint_item in = {"mpm", n, (double *)&mpm_of(second.sim)->now};
  must(checkpoint_write(folder, first.sim, 1, &out));
  must(checkpoint_read(folder, second.sim, 1, &in));
  scene_steps(&second, 60, 1e-3);
  same_points(&whole, &second);
  unlink(used);
  unlink(file);
  rmdir(folder);
  scene_close(&whole);
  scene_close(&first);
  scene_close(&second);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("stray points");
  TCase *tcase = tcase_create("stray");
  tcase_add_test(tcase, stops_by_default);
  tcase_add_test(tcase, flows_out_of_an_open_side);
  tcase_add_test(tcase, deleted_behind_a_wall_is_lost);
  tcase_add_test(tcase, clamped_points_stay_inside);
  tcase_add_loop_test(tcase, no_number_is_never_forgiven, 0, 2);
  tcase_add_test(tcase, the_same_bits_with_any_number_of_threads);
  tcase_add_test(tcase, resumes_with_the_same_bits);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
