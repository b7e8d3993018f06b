/* Checkpoints: what comes back is bitwise what was written; the previous one survives a failure; strangers are refused.
 */
#include "run/checkpoint.h"
#include "tests/run/fake.h"

#include "run/fields.h"
#include "run/files.h"

#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

static double                       items[] = {3, 1e9 + 1, -0.1};
static const struct checkpoint_item item[] = {{"counters", 2, items}, {"dt_sum", 1, items + 2}};
enum { N_ITEMS = sizeof item / sizeof *item };

static void write_scene(const struct fake_run *r, const char *text)
{
  char path[LONGEST_PATH];
  fake_ok(files_path(r->folder, "scene.used.json", path));
  fake_ok(files_replace(path, text, strlen(text)));
}

/* Values that no formula would bring back: every bit pattern counts, the smallest and the sign of zero too. */
static void scramble(struct fake_run *r, unsigned seed)
{
  struct field_view v;
  srand(seed);
  for (int cursor = 0; fields_next(&r->sim, &cursor, &v);)
    for (long i = 0; i < fields_length(&r->sim, &v); i++)
      v.data[i] = i == 0 ? -0.0 : i == 1 ? 5e-324 : (rand() - RAND_MAX / 2) * 1e-3 / 7;
  for (int i = 0; i < N_LEDGER; i++) {
    r->sim.ledger.v[i] = rand() / 3.0;
    r->sim.ledger_start.v[i] = rand() / 7.0;
  }
  r->sim.t = rand() / 11.0;
  r->sim.dt = rand() / 13.0;
  r->sim.dt_limit = rand() / 17.0;
  r->sim.step = rand();
  r->sim.solver = (struct solver_report){rand(), rand(), rand(), rand(), rand(), rand(), rand() / 19.0};
  r->sim.defect_rms_max = rand() / 23.0;
  r->sim.defect_max = rand() / 29.0;
}

/* What a checkpoint carries, one after the other. */
static long gather(const struct fake_run *r, double *all)
{
  struct field_view v;
  long              n = 0;
  for (int cursor = 0; fields_next(&r->sim, &cursor, &v);) {
    if (v.field->kind != STATE) continue;
    memcpy(&all[n], v.data, (size_t)fields_length(&r->sim, &v) * sizeof *all);
    n += fields_length(&r->sim, &v);
  }
  for (int s = 0; s < N_SETS; s++) {
    const struct points *p = r->sim.points[s];
    all[n++] = (double)p->n;
    for (long i = 0; i < p->n; i++) all[n++] = p->group[i];
    for (long i = 0; i <= p->n_runs; i++) all[n++] = (double)p->start[i];
  }
  memcpy(&all[n], &r->sim.ledger, sizeof r->sim.ledger);
  memcpy(&all[n + N_LEDGER], &r->sim.ledger_start, sizeof r->sim.ledger);
  n += 2 * N_LEDGER;
  const struct solver_report *s = &r->sim.solver;
  const double                rest[] = {r->sim.t,
                                        r->sim.dt,
                                        r->sim.dt_limit,
                                        (double)r->sim.step,
                                        (double)s->solves,
                                        (double)s->iterations,
                                        (double)s->smg,
                                        (double)s->fallbacks,
                                        (double)s->equilibria,
                                        (double)s->equilibrium_steps,
                                        s->residual_max,
                                        r->sim.defect_rms_max,
                                        r->sim.defect_max};
  memcpy(&all[n], rest, sizeof rest);
  return n + (long)(sizeof rest / sizeof *rest);
}

enum { ROOM = 200000 };

START_TEST(comes_back_bitwise)
{
  static double   before[ROOM], after[ROOM];
  struct fake_run r;
  fake_create(_i, &r);
  write_scene(&r, "{}");
  scramble(&r, 1);
  r.sim.points[SET_WATER]->n -= 5; /* fewer than at creation */
  long n = gather(&r, before);
  ck_assert_int_lt(n, ROOM);
  long calls = memory_calls();
  fake_ok(checkpoint_write(r.folder, &r.sim, N_ITEMS, item));
  ck_assert_int_le(memory_calls() - calls, 1); /* the text of the scene, to hash it */
  r.sim.points[SET_WATER]->n += 5;
  scramble(&r, 2);
  memset(r.sim.points[SET_SOLID]->start, 7, sizeof(long));
  memset(items, 0, sizeof items);
  fake_ok(checkpoint_read(r.folder, &r.sim, N_ITEMS, item));
  ck_assert_int_eq(gather(&r, after), n);
  ck_assert_mem_eq(before, after, (size_t)n * sizeof *before);
  ck_assert(items[0] == 3 && items[1] == 1e9 + 1 && items[2] == -0.1);
  fake_destroy(&r);
}
END_TEST

/* As a start of another run: fields, points and items come, the numbers of the sim stay. */
START_TEST(start_of_another)
{
  static double   first[ROOM], second[ROOM], after[ROOM];
  struct fake_run r;
  fake_create(2, &r);
  write_scene(&r, "{}");
  scramble(&r, 1);
  long n = gather(&r, first), numbers = 2 * N_LEDGER + 13;
  fake_ok(checkpoint_write(r.folder, &r.sim, N_ITEMS, item));
  scramble(&r, 2);
  gather(&r, second);
  memset(items, 0, sizeof items);
  fake_ok(checkpoint_start(r.folder, &r.sim, N_ITEMS, item));
  ck_assert_int_eq(gather(&r, after), n);
  ck_assert_mem_eq(after, first, (size_t)(n - numbers) * sizeof *first);
  ck_assert_mem_ne(after, second, (size_t)(n - numbers) * sizeof *first);
  ck_assert_mem_eq(&after[n - numbers], &second[n - numbers], (size_t)numbers * sizeof *first);
  ck_assert(items[0] == 3 && items[1] == 1e9 + 1 && items[2] == -0.1);
  fake_destroy(&r);
}
END_TEST

START_TEST(previous_survives)
{
  static double                before[ROOM], after[ROOM];
  struct fake_run              r;
  char                         path[LONGEST_PATH];
  const struct checkpoint_item twice[] = {{"same", 1, items}, {"same", 1, items}}; /* fails near the end of the file */
  fake_create(2, &r);
  write_scene(&r, "{}");
  scramble(&r, 1);
  long n = gather(&r, before);
  fake_ok(checkpoint_write(r.folder, &r.sim, 0, NULL));
  scramble(&r, 2);
  ck_assert_int_eq(checkpoint_write(r.folder, &r.sim, 2, twice), ERR_ENVIRONMENT);
  fake_ok(files_path(r.folder, "checkpoint.h5.tmp", path));
  ck_assert(!files_exists(path));
  fake_ok(checkpoint_read(r.folder, &r.sim, 0, NULL));
  ck_assert_int_eq(gather(&r, after), n);
  ck_assert_mem_eq(before, after, (size_t)n * sizeof *before);
  fake_destroy(&r);
}
END_TEST

/* In a child of its own, which must end as usual after the failure: HDF5 would like to close the file once more. */
START_TEST(full_disk)
{
  struct fake_run r;
  char            path[LONGEST_PATH];
  int             how;
  fake_create(2, &r);
  write_scene(&r, "{}");
  pid_t child = fork();
  if (child == 0) {
    const struct rlimit limit = {20000, RLIM_INFINITY};
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &limit);
    enum status s = checkpoint_write(r.folder, &r.sim, 0, NULL);
    exit(s == ERR_ENVIRONMENT && strstr(status_message(), "File too large") && !strchr(status_message(), '\n') ? 0 : 1);
  }
  ck_assert_int_eq(waitpid(child, &how, 0), child);
  ck_assert(WIFEXITED(how));
  ck_assert_int_eq(WEXITSTATUS(how), 0);
  fake_ok(files_path(r.folder, "checkpoint.h5", path));
  ck_assert(!files_exists(path));
  fake_ok(files_path(r.folder, "checkpoint.h5.tmp", path));
  ck_assert(!files_exists(path));
  fake_destroy(&r);
}
END_TEST

static void refused(struct fake_run *r, int n_items, const char *word)
{
  ck_assert_int_eq(checkpoint_read(r->folder, &r->sim, n_items, item), ERR_INPUT);
  ck_assert_msg(strstr(status_message(), word) != NULL, "%s", status_message());
}

START_TEST(strangers_are_refused)
{
  struct fake_run r;
  char            path[LONGEST_PATH];
  fake_create(2, &r);
  write_scene(&r, "{}");
  refused(&r, 0, "no checkpoint");
  fake_ok(checkpoint_write(r.folder, &r.sim, 0, NULL));
  write_scene(&r, "{ }");
  refused(&r, 0, "scene.used.json");
  write_scene(&r, "{}");
  refused(&r, 1, "counters");
  r.sim.n_markers++;
  refused(&r, 0, "markers");
  r.sim.n_markers--;
  r.sim.points[SET_SOLID]->n--;
  refused(&r, 0, "points/solid/n");
  r.sim.points[SET_SOLID]->n++;
  fake_ok(checkpoint_read(r.folder, &r.sim, 0, NULL));
  fake_ok(files_path(r.folder, "checkpoint.h5", path));
  ck_assert_int_eq(truncate(path, 3000), 0);
  refused(&r, 0, "checkpoint.h5");
  fake_ok(files_replace(path, "not HDF5", 8));
  refused(&r, 0, "checkpoint.h5");
  fake_destroy(&r);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("checkpoint");
  TCase *tests = tcase_create("checkpoint");
  tcase_set_timeout(tests, 60);
  tcase_add_loop_test(tests, comes_back_bitwise, 2, 4);
  tcase_add_test(tests, start_of_another);
  tcase_add_test(tests, previous_survives);
  tcase_add_test(tests, full_disk);
  tcase_add_test(tests, strangers_are_refused);
  suite_add_tcase(suite, tests);
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed != 0;
}
