/* Scenes: what is read, in which order overrides apply, and that everything wrong is told in one sentence. */
#include "run/scene_read.h"

#include "constitutive/constitutive.h"
#include "core/memory.h"
#include "run/json.h"

#include <check.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A valid scene that uses most of what there is; the bad ones differ from it in one place. */
static const char base[] =
    "{\n"
    "  \"title\": \"test\", \"// remark\": [\"free\"],\n"
    "  \"grid\": {\"min\": [0, 0], \"max\": [null, 1.2], \"h\": 0.1},\n"
    "  \"time\": {\"end\": 2},\n"
    "  \"gravity\": [0, \"-9.81*min(1, t)\"],\n"
    "  \"start\": \"zero\",\n"
    "  \"materials\": {\"sand\": {\"model\": \"linear_elastic\", \"young\": 1e7, \"poisson\": 0.3, \"density\": 2650,"
    " \"porosity\": 0.3, \"permeability\": 1e-3}},\n"
    "  \"solids\": {\"column\": {\"material\": \"sand\", \"shape\": {\"box\": {\"min\": [null, 0], \"max\": [null, "
    "1]}}}},\n"
    "  \"fluid\": {\"path\": \"ice\", \"bulk_modulus\": 2e9},\n"
    "  \"boundary\": {\"solid\": {\"y_min\": \"no_slip\"}, \"fluid\": {\"y_max\": {\"pressure\": 0}}},\n"
    "  \"loads\": {\"top\": {\"on\": {\"box\": {\"min\": [null, 1], \"max\": [null, 1]}}, \"traction\": [0, -1e4]}},\n"
    "  \"tracers\": {\"tip\": [null, 0.9]},\n"
    "  \"gauges\": {\"base\": {\"kind\": \"point\", \"at\": [0.05, 0.05], \"of\": \"P\"},"
    " \"settlement\": {\"kind\": \"load\", \"on\": \"top\", \"of\": \"displacement_y\"}},\n"
    "  \"references\": {\"theory\": {\"kind\": \"terzaghi\", \"young\": \"=materials.sand.young\","
    " \"poisson\": \"=materials.sand.poisson\", \"porosity\": \"=materials.sand.porosity\","
    " \"permeability\": \"=materials.sand.permeability\", \"bulk_modulus\": \"=fluid.bulk_modulus\","
    " \"density\": \"=fluid.density\", \"height\": 1, \"load\": 1e4}},\n"
    "  \"metrics\": {\"p_rms_0.1\": {\"measure\": \"rms\", \"field\": \"P\", \"reference\": \"theory.P\", \"at\": 0.1,"
    " \"time\": \"scaled\"}},\n"
    "  \"numerics\": {\"points_per_cell\": 4},\n"
    "  \"variants\": {\"stiff\": {\"materials.sand.young\": 2e7, \"grid.h\": 0.05}, \"soft\": "
    "{\"materials.sand.young\": 5e6}},\n"
    "  \"quick\": {\"grid.h\": 0.2, \"time.end\": 1},\n"
    "  \"paths\": {\"twopoint\": {\"numerics.basis\": \"cubic\", \"grid.h\": 0.3}}\n"
    "}\n";

static char folder[] = "/tmp/check_scene_XXXXXX";
static char file[64];

static void make_folder(void)
{
  ck_assert_ptr_nonnull(mkdtemp(folder));
  snprintf(file, sizeof file, "%s/column.json", folder);
}

static void remove_folder(void)
{
  char                     path[96];
  static const char *const names[] = {"column.json", "used.json", "expected.json", "summary.json"};
  for (int i = 0; i < 4; i++) {
    snprintf(path, sizeof path, "%s/%s", folder, names[i]);
    unlink(path);
  }
  rmdir(folder);
  memcpy(folder + strlen(folder) - 6, "XXXXXX", 6);
}

static void write_text(const char *name, const char *text, size_t n)
{
  char path[96];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  FILE *out = fopen(path, "wb");
  ck_assert_ptr_nonnull(out);
  ck_assert_uint_eq(fwrite(text, 1, n, out), n);
  fclose(out);
}

/* the base with the first `old` replaced by `new` */
static void write_edited(const char *old, const char *new)
{
  char        text[2 * sizeof base];
  const char *at = strstr(base, old);
  ck_assert_msg(at != NULL, "the base scene does not hold %s", old);
  snprintf(text, sizeof text, "%.*s%s%s", (int)(at - base), base, new, at + strlen(old));
  write_text("column.json", text, strlen(text));
}

static enum status load(const struct run_options *options, struct loaded_scene **scene)
{
  struct run_options o = *options;
  if (!o.argument) o.argument = file;
  return scene_load(&o, scene);
}

static struct loaded_scene *load_good(const struct run_options *options)
{
  struct loaded_scene *scene;
  ck_assert_msg(load(options, &scene) == OK, "%s", status_message());
  return scene;
}

static double young(const struct loaded_scene *scene)
{
  return json_find(scene->json, "materials.sand.young")->valuedouble;
}

/* ---- good scenes ---- */

START_TEST(reads_the_base)
{
  write_text("column.json", base, strlen(base));
  struct loaded_scene *l = load_good(&(struct run_options){0});
  const struct scene  *s = &l->scene;
  ck_assert_str_eq(s->name, "column");
  ck_assert_str_eq(l->path, "ice");
  ck_assert_str_eq(l->variant, "base");
  ck_assert_int_eq(s->dim, 2);
  ck_assert_int_eq(s->cells[0], 1);
  ck_assert_int_eq(s->cells[1], 12);
  ck_assert_int_eq(s->cells[2], 1);
  ck_assert(s->one_cell[0] && !s->one_cell[1]);
  ck_assert_double_eq(s->max[0], 0.1);
  ck_assert_str_eq(s->materials[0].model->name, "linear_elastic");
  ck_assert_double_eq(s->materials[0].porosity, 0.3);
  ck_assert_double_eq(s->fluid.density, 1000);
  ck_assert_str_eq(s->fluid.path->name, "ice");
  ck_assert_int_eq(s->solid_side[Y_MIN].kind, SIDE_NO_SLIP);
  ck_assert_int_eq(s->solid_side[Y_MAX].kind, SIDE_SLIP);
  ck_assert_int_eq(s->fluid_side[Y_MAX].kind, SIDE_PRESSURE);
  ck_assert_double_eq(function_value(&s->gravity[1], s->min, 0.5), -4.905);
  ck_assert(isinf(s->solids[0].shape.min[0]) && s->solids[0].shape.min[0] < 0);
  ck_assert_double_eq(s->tracers[0].x[0], 0.05);
  ck_assert_int_eq(s->numerics.points_per_axis[0], 2);
  ck_assert(isinf(s->numerics.dt_max));
  ck_assert(s->metrics[0].scaled_time);
  scene_unload(&l);
  ck_assert_ptr_null(l);
}
END_TEST

START_TEST(overrides_in_order)
{
  static const struct {
    struct run_options options;
    const char        *plus;
    double             young, h;
    const char        *variant, *path;
    int                basis;
  } row[] = {
      {{0}, "", 1e7, 0.1, "base", "ice", BASIS_QUADRATIC},
      {{.fluid = "twopoint"}, "", 1e7, 0.3, "base", "twopoint", BASIS_CUBIC},
      {{.fluid = "twopoint"}, "+stiff", 2e7, 0.05, "stiff", "twopoint", BASIS_CUBIC},
      {{.quick = true}, "+stiff", 2e7, 0.2, "stiff+quick", "ice", BASIS_QUADRATIC},
      {{.quick = true}, "+stiff+soft", 5e6, 0.2, "stiff+soft+quick", "ice", BASIS_QUADRATIC},
      {{.quick = true}, "", 1e7, 0.2, "quick", "ice", BASIS_QUADRATIC},
      {{.quick = true, .n_sets = 2, .sets = {"grid.h=0.4", "materials.sand.young=3e7"}},
       "+soft",
       3e7,
       0.4,
       "soft+quick",
       "ice",
       BASIS_QUADRATIC},
      {{.n_sets = 1, .sets = {"fluid.path=twopoint"}}, "", 1e7, 0.3, "base", "twopoint", BASIS_CUBIC},
      {{.n_sets = 2, .sets = {"fluid.path=twopoint", "numerics.basis=linear"}},
       "",
       1e7,
       0.3,
       "base",
       "twopoint",
       BASIS_LINEAR},
  };
  char argument[96];
  write_text("column.json", base, strlen(base));
  for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
    struct run_options o = row[i].options;
    snprintf(argument, sizeof argument, "%s%s", file, row[i].plus);
    o.argument = argument;
    struct loaded_scene *l = load_good(&o);
    ck_assert_double_eq(young(l), row[i].young);
    ck_assert_double_eq(l->scene.h, row[i].h);
    ck_assert_str_eq(l->variant, row[i].variant);
    ck_assert_str_eq(l->path, row[i].path);
    ck_assert_int_eq(l->scene.numerics.basis, row[i].basis);
    scene_unload(&l);
  }
}
END_TEST

START_TEST(sets_any_value)
{
  write_text("column.json", base, strlen(base));
  struct run_options   o = {.n_sets = 6,
                            .sets = {"gravity=[0, \"-t\"]", "gravity.1=-3", "output.times=[0.5, 1]", "loads.top=null",
                                     "gauges.settlement=null", "fluid.bulk_modulus=infinite"}};
  struct loaded_scene *l = load_good(&o);
  ck_assert_double_eq(l->scene.gravity[1].constant, -3);
  ck_assert_int_eq(l->scene.output.n_times, 2);
  ck_assert_int_eq(l->scene.n_loads, 0);
  ck_assert(isinf(l->scene.fluid.bulk_modulus));
  scene_unload(&l);
  o = (struct run_options){.n_sets = 2, .sets = {"metrics.p_rms_0.1.at=0.5", "fluid.drag=kozeny_carman"}};
  o.sets[o.n_sets++] = "materials.sand.grain_diameter=1e-3";
  l = load_good(&o);
  ck_assert_double_eq(l->scene.metrics[0].at, 0.5);
  scene_unload(&l);
}
END_TEST

/* the used scene holds every default and makes the same scene again */
START_TEST(used_scene_is_a_fixed_point)
{
  char used[96], *texts[2];
  write_text("column.json", base, strlen(base));
  struct loaded_scene *l = load_good(&(struct run_options){.quick = true, .n_sets = 1, .sets = {"grid.h=0.05"}});
  snprintf(used, sizeof used, "%s/used.json", folder);
  ck_assert_int_eq(scene_write_used(l, used), OK);
  ck_assert_ptr_nonnull(json_find(l->json, "numerics.dt_factor"));
  ck_assert_ptr_nonnull(json_find(l->json, "fluid.eos.expansion"));
  ck_assert_ptr_null(json_find(l->json, "variants"));
  struct loaded_scene *again = load_good(&(struct run_options){.argument = used});
  texts[0] = cJSON_Print(l->json);
  texts[1] = cJSON_Print(again->json);
  ck_assert_double_eq(again->scene.h, 0.05);
  ck_assert_str_eq(texts[0], texts[1]);
  for (int i = 0; i < 2; i++) free(texts[i]);
  scene_unload(&l);
  scene_unload(&again);
}
END_TEST

START_TEST(expected_limits)
{
  static const char expected[] =
      "{\"base\": {\"ice\": {\"p_rms_0.1\": {\"value\": 0.001, \"limit\": 0.002, \"unit\": \"-\", \"reference\": "
      "\"case book\"}}}, \"stiff+quick\": {\"twopoint\": {\"p_rms_0.1\": {\"value\": 0.01}}}}";
  struct expectation e;
  char               argument[96];
  write_text("column.json", base, strlen(base));
  write_text("expected.json", expected, strlen(expected));
  struct loaded_scene *l = load_good(&(struct run_options){0});
  scene_expected(l, "p_rms_0.1", &e);
  ck_assert(e.has_limit && e.has_value);
  ck_assert_double_eq(e.limit, 0.002);
  ck_assert_str_eq(e.reference, "case book");
  scene_expected(l, "another", &e);
  ck_assert(!e.has_limit && !e.has_value);
  scene_unload(&l);
  snprintf(argument, sizeof argument, "%s+stiff", file);
  l = load_good(&(struct run_options){.argument = argument, .quick = true, .fluid = "twopoint"});
  scene_expected(l, "p_rms_0.1", &e);
  ck_assert(!e.has_limit && e.has_value);
  scene_unload(&l);
}
END_TEST

/* limits hold for any order of the variants; what could never be judged is refused */
START_TEST(expected_is_checked)
{
  static const struct {
    const char *text, *said;
  } row[] = {
      {"{\"soft+stiff\": {\"ice\": {\"p_rms_0.1\": {\"limit\": 1}}}}", NULL},
      {"{\"stiff+soft\": {\"ice\": {\"p_rms\": {\"limit\": 1}}}}",
       "stiff+soft.ice: unknown metric \"p_rms\"; did you mean \"p_rms_0.1\"?"},
      {"{\"stiff+soft\": {\"ice\": {\"p_rms_0.1\": {\"limt\": 1}}}}",
       "stiff+soft.ice.p_rms_0.1: unknown key \"limt\"; did you mean \"limit\"?"},
      {"{\"stiff+soft\": {\"ice\": {\"p_rms_0.1\": {\"limit\": \"1\"}}}}",
       "stiff+soft.ice.p_rms_0.1.limit: expected a number"},
      {"{\"stiff+soft\": {\"ice\": [1]}}", "stiff+soft.ice: expected an object of metrics"},
      {"{\"stiff+soft\": ", "the file ends inside the JSON"},
  };
  char argument[96];
  snprintf(argument, sizeof argument, "%s+stiff+soft", file);
  write_text("column.json", base, strlen(base));
  for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
    struct loaded_scene *l = NULL;
    struct expectation   e;
    write_text("expected.json", row[i].text, strlen(row[i].text));
    enum status status = load(&(struct run_options){.argument = argument}, &l);
    ck_assert_int_eq(status, row[i].said ? ERR_INPUT : OK);
    if (row[i].said)
      ck_assert_msg(strstr(status_message(), row[i].said) != NULL, "no \"%s\" in: %s", row[i].said, status_message());
    if (!l) continue;
    scene_expected(l, "p_rms_0.1", &e);
    ck_assert(e.has_limit);
    scene_unload(&l);
  }
}
END_TEST

START_TEST(folder_of_a_run)
{
  char directory[LONGEST_PATH];
  write_text("column.json", base, strlen(base));
  struct run_options   o = {.argument = file, .fluid = "twopoint"};
  struct loaded_scene *l = load_good(&o);
  ck_assert_int_eq(scene_out_directory(l, &o, directory, sizeof directory), OK);
  ck_assert_str_eq(directory, "out/column-twopoint");
  o.out = folder;
  ck_assert_int_eq(scene_out_directory(l, &o, directory, sizeof directory), OK);
  ck_assert_int_eq(scene_refuse_used_directory(&o, directory), OK);
  write_text("summary.json", "{}", 2);
  ck_assert_int_eq(scene_refuse_used_directory(&o, directory), ERR_INPUT);
  ck_assert_ptr_nonnull(strstr(status_message(), "--force"));
  o.force = true;
  ck_assert_int_eq(scene_refuse_used_directory(&o, directory), OK);
  scene_unload(&l);
}
END_TEST

START_TEST(shipped_cases)
{
  static const char *const names[] = {"terzaghi_column", "terzaghi_column+ramp1ms", "bar_vibration", "rotating_disk"};
  for (int i = 0; i < 4; i++) {
    struct loaded_scene *l = load_good(&(struct run_options){.argument = names[i], .quick = i == 0});
    ck_assert_str_eq(l->scene.name, names[i]);
    scene_unload(&l);
  }
}
END_TEST

/* ---- bad scenes ---- */

/* old -> new in the base; the sentence names the path and holds the remedy */
static const struct {
  const char *old, *new, *path, *remedy;
} bad[] = {
#define BAD(old, new, path, remedy) {old, new, path, remedy},
#include "bad_scenes.def"
#undef BAD
};

START_TEST(tells_what_is_wrong)
{
  struct loaded_scene *l = NULL;
  write_edited(bad[_i].old, bad[_i].new);
  enum status status = load(&(struct run_options){0}, &l);
  const char *said = status_message();
  ck_assert_msg(status == ERR_INPUT, "%s -> %s was let pass", bad[_i].old, bad[_i].new);
  ck_assert_ptr_null(l);
  ck_assert_msg(strncmp(said, file, strlen(file)) == 0, "the sentence does not start with the file: %s", said);
  ck_assert_msg(strstr(said, bad[_i].path) != NULL, "no \"%s\" in: %s", bad[_i].path, said);
  ck_assert_msg(strstr(said, bad[_i].remedy) != NULL, "no \"%s\" in: %s", bad[_i].remedy, said);
  ck_assert_msg(strchr(said, '\n') == NULL, "more than one line: %s", said);
}
END_TEST

static const struct {
  struct run_options options;
  const char        *said, *remedy;
} bad_options[] = {
    {{.argument = "terzaghi_colum"}, "unknown file or case \"terzaghi_colum\"", "did you mean \"terzaghi_column\"?"},
    {{.argument = "/nowhere/scene.json"}, "/nowhere/scene.json: there is no such file", "check the path"},
    {{.argument = "terzaghi_column+ramp"}, "variants: unknown variant \"ramp\"", "did you mean \"ramp1ms\"?"},
    {{.argument = "terzaghi_column+"}, "a variant has no name", "write SCENE+variant"},
    {{.argument = ""}, "no scene is named", "give the path"},
    {{.argument = "bar_vibration", .fluid = "ice"}, "the scene has no fluid", "leave --fluid out"},
    {{.argument = "terzaghi_column", .fluid = "fem"}, "fluid.path: unknown fluid path \"fem\"", "valid are:"},
    {{.argument = "terzaghi_column", .n_sets = 1, .sets = {"grid.h"}},
     "--set: \"grid.h\" is not key.path=value",
     "write --set"},
    {{.argument = "terzaghi_column", .n_sets = 1, .sets = {"gird.h=1"}},
     "--set: unknown key \"gird\"",
     "did you mean \"grid\"?"},
    {{.argument = "terzaghi_column", .n_sets = 1, .sets = {"materials.snd.young=1"}},
     "--set: materials: unknown name \"snd\"",
     "did you mean \"sand\"?"},
    {{.argument = "terzaghi_column", .n_sets = 1, .sets = {"gravity.7=1"}},
     "--set: the list has 2 elements",
     "give a number from 0 on"},
    {{.argument = "terzaghi_column", .n_sets = 1, .sets = {"grid.h.x=1"}},
     "--set: \"x\" is looked for in a number",
     "shorten the path"},
    {{.argument = "terzaghi_column", .n_sets = 1, .sets = {"variants.x=1"}},
     "--set: variants.x: an override cannot change overrides",
     "set the key itself"},
    {{.argument = "terzaghi_column", .n_sets = 1, .sets = {"grid.h=1e999"}},
     "--set grid.h: ",
     "write one that a double can hold"},
};

START_TEST(tells_what_is_wrong_with_options)
{
  struct loaded_scene *l = NULL;
  ck_assert_int_eq(load(&bad_options[_i].options, &l), ERR_INPUT);
  ck_assert_msg(strstr(status_message(), bad_options[_i].said) != NULL, "no \"%s\" in: %s", bad_options[_i].said,
                status_message());
  ck_assert_msg(strstr(status_message(), bad_options[_i].remedy) != NULL, "no \"%s\" in: %s", bad_options[_i].remedy,
                status_message());
}
END_TEST

/* ---- files that are no scenes ---- */

static void expect_refused(const char *text, size_t n, const char *said)
{
  struct loaded_scene *l = NULL;
  write_text("column.json", text, n);
  ck_assert_int_eq(load(&(struct run_options){0}, &l), ERR_INPUT);
  ck_assert_msg(strstr(status_message(), said) != NULL, "no \"%s\" in: %s", said, status_message());
}

START_TEST(no_scenes)
{
  char *deep = malloc(4000), *large = malloc(JSON_BYTES + 2);
  memset(deep, '[', 4000);
  memset(large, ' ', JSON_BYTES + 2);
  expect_refused("", 0, "line 1, column 1: the file ends inside the JSON");
  expect_refused("[1]", 3, "the file holds a list, not an object");
  expect_refused("{}", 2, "grid.min: is missing");
  expect_refused("{\0}", 3, "line 1, column 2: a zero byte");
  expect_refused(deep, 4000, "nested more than 32 deep");
  expect_refused(large, JSON_BYTES + 2, "more than the");
  free(deep);
  free(large);
}
END_TEST

/* a file cut at any byte is refused, except within the white space at its end */
START_TEST(cut_anywhere)
{
  struct loaded_scene *l = NULL;
  for (size_t n = 0; n < strlen(base) - 1; n++) {
    write_text("column.json", base, n);
    ck_assert_msg(load(&(struct run_options){0}, &l) == ERR_INPUT, "cut at byte %zu it was let pass", n);
  }
}
END_TEST

/* any single byte replaced: read or refused, never a crash */
START_TEST(any_byte_replaced)
{
  static const char bytes[] = {'"', '{', '}', '[', ']', ',', ':', '\\', '9', '-', 'e', ' ', '\x01', '\xff', '.', '='};
  char              text[sizeof base];
  int               refused = 0;
  for (size_t i = 0; i < strlen(base); i++) {
    memcpy(text, base, sizeof base);
    text[i] = bytes[(i * 7 + i / 16) % sizeof bytes];
    write_text("column.json", text, strlen(base));
    struct loaded_scene *l = NULL;
    enum status          status = load(&(struct run_options){0}, &l);
    ck_assert(status == OK || status == ERR_INPUT);
    refused += status != OK;
    scene_unload(&l);
  }
  ck_assert_int_gt(refused, (int)strlen(base) / 2);
}
END_TEST

static void add_bad(TCase *tcase)
{
  tcase_add_loop_test(tcase, tells_what_is_wrong, 0, sizeof bad / sizeof *bad);
  tcase_add_loop_test(tcase, tells_what_is_wrong_with_options, 0, sizeof bad_options / sizeof *bad_options);
  tcase_add_test(tcase, no_scenes);
  tcase_add_test(tcase, cut_anywhere);
  tcase_add_test(tcase, any_byte_replaced);
}

static void add_good(TCase *tcase)
{
  tcase_add_test(tcase, reads_the_base);
  tcase_add_test(tcase, overrides_in_order);
  tcase_add_test(tcase, sets_any_value);
  tcase_add_test(tcase, used_scene_is_a_fixed_point);
  tcase_add_test(tcase, expected_limits);
  tcase_add_test(tcase, expected_is_checked);
  tcase_add_test(tcase, folder_of_a_run);
  tcase_add_test(tcase, shipped_cases);
}

int main(void)
{
  Suite *suite = suite_create("scene");
  TCase *tcase = tcase_create("scenes");
  tcase_set_timeout(tcase, 60);
  tcase_add_checked_fixture(tcase, make_folder, remove_folder);
  add_good(tcase);
  add_bad(tcase);
  suite_add_tcase(suite, tcase);
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_ENV);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed != 0;
}
