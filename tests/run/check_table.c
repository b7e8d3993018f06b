/* Tables over time in scenes: values, relative paths, and what is wrong with a file in one sentence. */
#include "tests/scene_run.h"

#include <sys/stat.h>

#define SCENE                                                                                                          \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.5}, \"time\": {\"end\": 1}, \"start\": \"zero\","            \
  "\"materials\": {\"m\": {\"model\": \"linear_elastic\", \"young\": 1e6, \"poisson\": 0.3, \"density\": 1000}},"      \
  "\"solids\": {\"s\": {\"material\": \"m\", \"shape\": \"everywhere\"}}, \"gravity\": [%s, -9.81]}"

static char folder[] = "/tmp/check_table_XXXXXX";

static void write_file(const char *name, const char *text, char *path, size_t size)
{
  snprintf(path, size, "%s/%s", folder, name);
  FILE *f = fopen(path, "w");
  ck_assert_ptr_nonnull(f);
  fputs(text, f);
  fclose(f);
}

/* loads a scene whose gravity along x is `value`, beside a file table.csv */
static enum status load(const char *csv, const char *value, struct loaded_scene **loaded)
{
  char text[2048], path[256], table[256];
  write_file("table.csv", csv, table, sizeof table);
  snprintf(text, sizeof text, SCENE, value);
  write_file("scene.json", text, path, sizeof path);
  struct run_options options = {.argument = path, .until = INFINITY};
  return scene_load(&options, loaded);
}

#define CSV "# shaking, made up\n\nt [s], a_x [m/s2],b\r\n-1,3,5\n0.5, 1e0 ,7\n# in between\n2,4,8\n"

static const struct {
  const char *value;
  double      t, expected;
} good[] = {
    {"{\"table\": \"table.csv\", \"column\": \"a_x\"}", 0.5, 1},
    {"{\"table\": \"table.csv\", \"column\": \"a_x [m/s2]\"}", 1.25, 2.5},
    {"{\"table\": \"table.csv\", \"column\": \"b\", \"scale\": -2}", -0.25, -12},
    {"{\"table\": \"table.csv\", \"//\": \"the second column\"}", 99, 4},
    {"{\"table\": \"table.csv\"}", -99, 3},
};

START_TEST(values)
{
  const double         origin[3] = {0};
  struct loaded_scene *loaded = NULL;
  must(load(CSV, good[_i].value, &loaded));
  ck_assert_double_eq_tol(function_value(&loaded->scene.gravity[0], origin, good[_i].t), good[_i].expected, 1e-14);
  scene_unload(&loaded);
}
END_TEST

static const struct {
  const char *csv, *value, *fault, *remedy;
} bad[] = {
    {CSV, "{\"table\": 3}", "gravity.0.table: expected the name of a file, found a number", "write \"shaking.csv\""},
    {CSV, "{\"column\": \"a_x\"}", "gravity.0: an object stands for a table over time and has no \"table\"", "write {"},
    {CSV, "{\"table\": \"table.csv\", \"colum\": \"b\"}", "unknown key \"colum\"", "did you mean \"column\"?"},
    {CSV, "{\"table\": \"table.csv\", \"scale\": \"b\"}", "gravity.0.scale: expected a number", "it is the factor"},
    {CSV, "{\"table\": \"nothing.csv\"}", "nothing.csv: cannot be opened", "No such file"},
    {CSV, "{\"table\": \"table.csv\", \"column\": \"a_y\"}", "unknown column \"a_y\"", "valid are: a_x [m/s2], b"},
    {"", "{\"table\": \"table.csv\"}", "table.csv: the file is empty", "give a row of names"},
    {"t,v\n", "{\"table\": \"table.csv\"}", "table.csv: it has no row of numbers", "give at least one"},
    {"t\n1\n", "{\"table\": \"table.csv\"}", "row 1: one column is not a table over time", "write t,v"},
    {"t,v\n0,1\n\n1\n", "{\"table\": \"table.csv\"}", "row 4: it has 1 columns and the table needs 2", "complete it"},
    {"t,v\n0,1 m\n", "{\"table\": \"table.csv\"}", "row 2: \"1 m\" in column 2 is not a number", "correct it"},
    {"t,v\n0,nan\n", "{\"table\": \"table.csv\"}", "row 2: \"nan\" in column 2 is not a number", "correct it"},
    {"t,v\n0,1\n0,2\n", "{\"table\": \"table.csv\"}", "row 3: its time is not after", "sort them"},
};

START_TEST(faults)
{
  struct loaded_scene *loaded = NULL;
  ck_assert_int_eq(load(bad[_i].csv, bad[_i].value, &loaded), ERR_INPUT);
  ck_assert_msg(strstr(status_message(), bad[_i].fault) && strstr(status_message(), bad[_i].remedy), "it says: %s",
                status_message());
  ck_assert_ptr_null(loaded);
}
END_TEST

/* scene.used.json lies elsewhere and still finds the file of the scene it was made from */
START_TEST(used_scene)
{
  struct loaded_scene *loaded = NULL, *again = NULL;
  char                 used[256];
  const double         origin[3] = {0};
  must(load(CSV, good[0].value, &loaded));
  snprintf(used, sizeof used, "%s/out", folder);
  mkdir(used, 0777);
  snprintf(used, sizeof used, "%s/out/scene.used.json", folder);
  must(scene_write_used(loaded, used));
  scene_unload(&loaded);
  struct run_options options = {.argument = used, .until = INFINITY};
  must(scene_load(&options, &again));
  ck_assert_double_eq(function_value(&again->scene.gravity[0], origin, 0.5), 1);
  scene_unload(&again);
}
END_TEST

/* where tests are not forked, the name of the last one stands there */
static void make_folder(void)
{
  memset(folder + strlen(folder) - 6, 'X', 6);
  ck_assert_ptr_nonnull(mkdtemp(folder));
}

static void remove_folder(void)
{
  static const char *const names[] = {"out/scene.used.json", "out", "scene.json", "table.csv", ""};
  for (int i = 0; i < 5; i++) {
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, names[i]);
    remove(path);
  }
}

int main(void)
{
  Suite *suite = suite_create("table");
  TCase *tcase = tcase_create("tables");
  tcase_add_checked_fixture(tcase, make_folder, remove_folder);
  tcase_add_loop_test(tcase, values, 0, sizeof good / sizeof *good);
  tcase_add_loop_test(tcase, faults, 0, sizeof bad / sizeof *bad);
  tcase_add_test(tcase, used_scene);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
