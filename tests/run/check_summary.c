/* summary.json as docs and scripts expect it, what info says of files, and what progress prints. */
#include "run/info.h"
#include "run/json.h"
#include "run/progress.h"
#include "run/summary.h"
#include "tests/run/fake.h"

#include "run/files.h"

#include <math.h>
#include <signal.h>
#include <sys/wait.h>
#include <time.h>

static const struct metric_entry metrics[] = {
    {"rms", "-", "theory.P", 0.01, 0.02, true, true},
    {"free", "Pa", "", 3.5, 0, false, true},
    {"lost", "s", "theory.period", NAN, 0.1, true, false},
};

static struct run_record record(void)
{
  static const struct count_entry    limited[] = {{"mpm.update_stress", 41}, {"numerics.dt_max", 1}};
  static const struct stage_entry    stages[] = {{"mpm.sort_points", 42, 0.25}};
  static const struct left_out_entry left_out[] = {{"twopoint", "only when \"fluid.path\" says so"}};
  return (struct run_record){.scene = "fake+soft",
                             .fluid_path = "ice",
                             .version = "1",
                             .status = "done",
                             .threads = 2,
                             .ranks = 1,
                             .cells = 3000000000,
                             .points_deleted = 3,
                             .points_flowed_out = 5,
                             .density_change = 0.002,
                             .steps = 42,
                             .t_end = 0.1,
                             .dt_min = 1e-5,
                             .dt_mean = 0.1 / 42,
                             .dt_max = 3e-3,
                             .n_limited_by = 2,
                             .limited_by = limited,
                             .n_stages = 1,
                             .stages = stages,
                             .n_left_out = 1,
                             .left_out = left_out,
                             .n_metrics = 3,
                             .metrics = metrics,
                             .solves = 4,
                             .iterations = 10};
}

static double number(const cJSON *root, const char *path)
{
  const cJSON *item = json_find(root, path);
  ck_assert_msg(cJSON_IsNumber(item), "%s is no number", path);
  return item->valuedouble;
}

START_TEST(summary_holds_what_it_promises)
{
  static const char *const keys[] = {"scene",   "fluid_path",   "version",         "threads",        "ranks",
                                     "cells",   "points_solid", "points_fluid",    "points_strayed", "steps",
                                     "t_end",   "dt",           "wall_s",          "cpu_s",          "peak_rss_bytes",
                                     "stages",  "left_out",     "pressure_solver", "volume_defect",  "ledger",
                                     "metrics", "status",       "density_change"};
  struct fake_run          r;
  const struct run_record  rec = record();
  char                     path[LONGEST_PATH];
  cJSON                   *root;
  fake_create(2, &r);
  fake_ok(summary_write(r.folder, &rec));
  fake_ok(files_path(r.folder, "summary.json", path));
  fake_ok(json_load(path, &root));
  ck_assert_int_eq(cJSON_GetArraySize(root), (int)(sizeof keys / sizeof *keys));
  for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
    ck_assert_msg(json_member(root, keys[i]) != NULL, "%s", keys[i]);
  ck_assert_double_eq(number(root, "cells"), 3e9);
  ck_assert_double_eq(number(root, "points_strayed.put_back"), 0);
  ck_assert_double_eq(number(root, "points_strayed.deleted"), 3);
  ck_assert_double_eq(number(root, "points_strayed.flowed_out"), 5);
  ck_assert_double_eq(number(root, "dt.mean"), 0.1 / 42);
  ck_assert_double_eq(number(json_find(root, "dt.limited_by"), "numerics.dt_max"), 1);
  ck_assert_double_eq(number(root, "pressure_solver.iterations_mean"), 2.5);
  ck_assert_double_eq(number(root, "stages.0.seconds"), 0.25);
  ck_assert_str_eq(json_find(root, "left_out.0.why")->valuestring, "only when \"fluid.path\" says so");
  ck_assert(cJSON_IsTrue(json_find(root, "metrics.rms.pass")) && cJSON_IsFalse(json_find(root, "metrics.lost.pass")));
  ck_assert_double_eq(number(root, "metrics.rms.limit"), 0.02);
  ck_assert(cJSON_IsNull(json_find(root, "metrics.free.limit")) && cJSON_IsNull(json_find(root, "metrics.lost.value")));
  cJSON_Delete(root);
  fake_destroy(&r);
}
END_TEST

/* What info_print says of a file; free it. */
static char *info(const struct fake_run *r, const char *name, enum status expected)
{
  char   path[LONGEST_PATH], *said = NULL;
  size_t n;
  FILE  *out = open_memstream(&said, &n);
  fake_ok(files_path(r->folder, name, path));
  ck_assert_int_eq(info_print(path, out), expected);
  fclose(out);
  return said;
}

static void says(const struct fake_run *r, const char *name, const char *words)
{
  char *said = info(r, name, OK);
  ck_assert_msg(strstr(said, words) != NULL, "no \"%s\" in:\n%s", words, said);
  free(said);
}

static void make(const struct fake_run *r, const char *name, const char *text)
{
  char path[LONGEST_PATH];
  fake_ok(files_path(r->folder, name, path));
  fake_ok(files_replace(path, text, strlen(text)));
}

START_TEST(info_tells_of_files)
{
  struct fake_run         r;
  const struct run_record rec = record();
  fake_create(2, &r);
  fake_ok(summary_write(r.folder, &rec));
  says(&r, "summary.json", "\n    mpm.update_stress: 41\n");
  says(&r, "summary.json", "points_fluid: 0\n");
  make(&r, "gauges.csv", "t [s],p [Pa]\n0,4\n0.5,-2e3\n1,nan\n1.5,7\n");
  says(&r, "gauges.csv", "4 rows\n");
  says(&r, "gauges.csv",
       "p [Pa]                                        4              7          -2000              7\n");
  make(&r, "bad.csv", "t [s],p [Pa]\n0,4\n0.5\n");
  free(info(&r, "bad.csv", ERR_INPUT));
  ck_assert_ptr_nonnull(strstr(status_message(), "bad.csv: line 3 "));
  make(&r, "empty.csv", "");
  free(info(&r, "empty.csv", ERR_INPUT));
  make(&r, "bad.hdf", "text");
  free(info(&r, "bad.hdf", ERR_INPUT));
  free(info(&r, "none.json", ERR_INPUT));
  free(info(&r, "plan.txt", ERR_INPUT));
  fake_destroy(&r);
}
END_TEST

START_TEST(progress_is_plain_off_a_terminal)
{
  struct progress p;
  char           *said = NULL;
  size_t          n = 0;
  FILE           *out = open_memstream(&said, &n), *file = tmpfile();
  progress_start(&p, file, false, 0, 2, 0);
  ck_assert(!p.terminal);
  p.out = out;
  progress_step(&p, 0.25, 1e-3, 100);
  fflush(out);
  ck_assert_int_eq(n, 0); /* too early for a line */
  p.wall_first -= 20;
  p.wall_shown -= 20;
  progress_step(&p, 0.25, 1e-3, 100);
  ck_assert_ptr_nonnull(
      strstr(said, "Progress 12.5%  t = 0.25 s, dt = 0.001 s, 5 steps/s, left 2 min 20 s, estimated finish 2"));
  ck_assert_ptr_null(strpbrk(said, "\r\033"));
  size_t before = n;
  progress_step(&p, 0.26, 1e-3, 110);
  fflush(out);
  ck_assert_int_eq(n, before);
  progress_end(&p, 2, 800);
  ck_assert_ptr_nonnull(strstr(said, "Reached t = 2 s after 800 steps in 20 s\n"));
  fclose(out);
  fclose(file);
  free(said);
}
END_TEST

START_TEST(quiet_is_quiet)
{
  struct progress p;
  FILE           *out = tmpfile();
  progress_start(&p, out, true, 0, 2, 0);
  p.wall_shown -= 20;
  progress_step(&p, 0.25, 1e-3, 100);
  progress_end(&p, 2, 800);
  ck_assert_int_eq(ftell(out), 0);
  fclose(out);
}
END_TEST

/* In a child of its own: the flag stays raised. */
START_TEST(signals_are_heard)
{
  int   how;
  pid_t child = fork();
  if (child == 0) {
    progress_catch_signals();
    if (progress_stop_asked()) _exit(1);
    raise(_i);
    if (!progress_stop_asked()) _exit(2);
    raise(_i); /* the same request, told twice */
    for (struct timespec rest = {2, 100000000}; nanosleep(&rest, &rest);) continue;
    raise(_i); /* the second one ends at once */
    _exit(3);
  }
  ck_assert_int_eq(waitpid(child, &how, 0), child);
  ck_assert(WIFEXITED(how) && WEXITSTATUS(how) == 128 + _i);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("summary");
  TCase *tests = tcase_create("summary");
  tcase_add_test(tests, summary_holds_what_it_promises);
  tcase_add_test(tests, info_tells_of_files);
  tcase_add_test(tests, progress_is_plain_off_a_terminal);
  tcase_add_test(tests, quiet_is_quiet);
  tcase_add_loop_test(tests, signals_are_heard, SIGINT, SIGINT + 1);
  tcase_add_loop_test(tests, signals_are_heard, SIGTERM, SIGTERM + 1);
  suite_add_tcase(suite, tests);
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed != 0;
}
