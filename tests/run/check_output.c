/* Snapshots: what h5py and VTK read is what the fields held; files are whole or absent; nothing is allocated. */
#include "run/output.h"
#include "tests/run/fake.h"

#include "run/files.h"

#include <sys/wait.h>

/* exit status of a script below tests/ with the folder and a number as its arguments */
static int script(const char *name, const char *folder, int number)
{
  char command[512];
  snprintf(command, sizeof command, "/usr/bin/python3 %s/tests/%s '%s' %d", MPMICE_SOURCE_DIR, name, folder, number);
  int s = system(command);
  return WIFEXITED(s) ? WEXITSTATUS(s) : -1;
}

static void write_two(struct fake_run *r, struct output_writer **o)
{
  fake_ok(output_create(&r->sim, r->folder, o));
  long before = memory_calls();
  for (int i = 0; i < 2; i++) {
    r->sim.t = 0.25 * (i + 1);
    fake_ok(output_write(*o, &r->sim));
  }
  ck_assert_int_eq(memory_calls(), before);
  ck_assert_int_eq(output_count(*o), 2);
}

START_TEST(readable_elsewhere)
{
  struct fake_run       r;
  struct output_writer *o;
  fake_create(_i, &r);
  write_two(&r, &o);
  ck_assert_int_eq(script("run/read_output.py", r.folder, _i), 0);
  int opened = script("open_in_paraview.py", r.folder, _i);
  if (opened == 77) printf("neither ParaView nor VTK here: its part of the test is left out\n");
  ck_assert_msg(opened == 0 || opened == 77, "VTK reads something else than was written");
  output_destroy(&o);
  ck_assert_ptr_null(o);
  fake_destroy(&r);
}
END_TEST

START_TEST(resume_forgets_later_snapshots)
{
  struct fake_run       r;
  struct output_writer *o;
  char                  path[LONGEST_PATH], *text;
  size_t                n;
  fake_create(2, &r);
  write_two(&r, &o);
  output_destroy(&o);
  fake_ok(output_create(&r.sim, r.folder, &o));
  fake_ok(output_resume(o, 1));
  ck_assert_int_eq(output_count(o), 1);
  fake_ok(files_path(r.folder, "fields.cells.00001.hdf", path));
  ck_assert(!files_exists(path));
  r.sim.t = 0.75;
  fake_ok(output_write(o, &r.sim));
  fake_ok(files_path(r.folder, "fields.cells.hdf.series", path));
  fake_ok(files_read(path, 1 << 20, &text, &n));
  ck_assert_ptr_nonnull(strstr(text, "\"time\": 0.25"));
  ck_assert_ptr_nonnull(strstr(text, "\"time\": 0.75"));
  ck_assert_ptr_null(strstr(text, "\"time\": 0.5}"));
  memory_free(&text);
  output_destroy(&o);
  fake_destroy(&r);
}
END_TEST

START_TEST(says_when_it_cannot_write)
{
  struct fake_run       r;
  struct output_writer *o;
  char                  folder[80];
  fake_create(2, &r);
  snprintf(folder, sizeof folder, "%s/none", r.folder);
  fake_ok(output_create(&r.sim, folder, &o));
  ck_assert_int_eq(output_write(o, &r.sim), ERR_ENVIRONMENT);
  ck_assert_ptr_nonnull(strstr(status_message(), "none/fields.cells.00000.hdf"));
  ck_assert_int_eq(output_count(o), 0);
  output_destroy(&o);
  fake_destroy(&r);
}
END_TEST

/* Nothing to show at cells, no file of cells; a resume then asks the other sets for the times. */
START_TEST(no_cells_without_values)
{
  struct fake_run       r;
  struct output_writer *o;
  char                  path[LONGEST_PATH];
  fake_create(2, &r);
  memory_free(&r.state.P_cc);
  memory_free(&r.state.vel_cc);
  write_two(&r, &o);
  output_destroy(&o);
  fake_ok(files_path(r.folder, "fields.cells.00000.hdf", path));
  ck_assert(!files_exists(path));
  fake_ok(files_path(r.folder, "fields.solid.00000.hdf", path));
  ck_assert(files_exists(path));
  fake_ok(output_create(&r.sim, r.folder, &o));
  fake_ok(output_resume(o, 2));
  ck_assert_int_eq(output_count(o), 2);
  output_destroy(&o);
  fake_destroy(&r);
}
END_TEST

/* A set may lose points while it runs. */
START_TEST(fewer_points)
{
  struct fake_run       r;
  struct output_writer *o;
  fake_create(2, &r);
  fake_ok(output_create(&r.sim, r.folder, &o));
  r.sim.points[SET_WATER]->n -= 7;
  fake_ok(output_write(o, &r.sim));
  int opened = script("open_in_paraview.py", r.folder, 2);
  ck_assert(opened == 0 || opened == 77);
  output_destroy(&o);
  fake_destroy(&r);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("output");
  TCase *tests = tcase_create("output");
  tcase_set_timeout(tests, 60);
  tcase_add_loop_test(tests, readable_elsewhere, 2, 4);
  tcase_add_test(tests, resume_forgets_later_snapshots);
  tcase_add_test(tests, says_when_it_cannot_write);
  tcase_add_test(tests, no_cells_without_values);
  tcase_add_test(tests, fewer_points);
  suite_add_tcase(suite, tests);
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed != 0;
}
