/* The command line, and the starter scene of `mpmice new`. */
#include "run/arguments.h"
#include "run/scene_read.h"
#include "run/verbs.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST = 12 };

static enum status read_words(const char *const words[], struct run_options *o, bool *help)
{
  const struct verb *verb;
  int                n = 0;
  while (words[n]) n++;
  TRY(arguments_find_verb(words[0], &verb));
  return arguments_read(verb, n - 1, (char *const *)(words + 1), o, help);
}

START_TEST(reads_options)
{
  static const char *const words[] = {"run",    "--fluid",   "ice", "case+a",      "--set=grid.h=0.1", "--set",
                                      "seed=2", "--threads", "2",   "--until=0.5", "--quick",          NULL};
  struct run_options       o;
  bool                     help;
  ck_assert_msg(read_words(words, &o, &help) == OK, "%s", status_message());
  ck_assert_str_eq(o.argument, "case+a");
  ck_assert_str_eq(o.fluid, "ice");
  ck_assert_int_eq(o.n_sets, 2);
  ck_assert_str_eq(o.sets[0], "grid.h=0.1");
  ck_assert_str_eq(o.sets[1], "seed=2");
  ck_assert_int_eq(o.threads, 2);
  ck_assert_double_eq(o.until, 0.5);
  ck_assert(o.quick && !o.force && !o.quiet && !help);
}
END_TEST

START_TEST(defaults_and_help)
{
  static const char *const plain[] = {"run", "case", NULL}, *const asked[] = {"run", "--help", NULL};
  struct run_options o;
  bool               help;
  ck_assert_int_eq(read_words(plain, &o, &help), OK);
  ck_assert(isinf(o.until) && o.threads == 0 && !o.out);
  ck_assert_int_eq(read_words(asked, &o, &help), OK);
  ck_assert(help);
}
END_TEST

static const struct {
  const char *words[MOST], *said;
} bad[] = {
    {{"rnu"}, "unknown command \"rnu\"; did you mean \"run\"? valid are: run, resume, "},
    {{"run"}, "run: SCENE is missing; write mpmice run SCENE"},
    {{"run", "a", "b"}, "\"b\" is one argument too many"},
    {{"run", "a", "--fluit", "ice"}, "run: unknown option \"--fluit\"; did you mean \"--fluid\"?"},
    {{"check", "a", "--threads", "2"}, "check: unknown option \"--threads\""},
    {{"run", "a", "--out"}, "--out needs a value; write --out DIR"},
    {{"run", "a", "--threads", "0"}, "--threads: \"0\" is not a number in [1, 1024]"},
    {{"run", "a", "--threads", "1.5"}, "\"1.5\" is not a whole number"},
    {{"run", "a", "--threads", "two"}, "\"two\" is not a number"},
    {{"run", "a", "--until", "nan"}, "--until: \"nan\" is not a number"},
    {{"run", "a", "--quick=yes"}, "--quick takes no value"},
    {{"schema", "a"}, "one argument too many"},
};

START_TEST(tells_what_is_wrong)
{
  struct run_options o;
  bool               help;
  ck_assert_int_eq(read_words(bad[_i].words, &o, &help), ERR_INPUT);
  ck_assert_msg(strstr(status_message(), bad[_i].said) != NULL, "no \"%s\" in: %s", bad[_i].said, status_message());
}
END_TEST

START_TEST(every_verb_explains_itself)
{
  for (const struct verb *v = verbs; v->name; v++) {
    char  *text = NULL;
    size_t n = 0;
    FILE  *out = open_memstream(&text, &n);
    arguments_help(v, out);
    fclose(out);
    ck_assert_msg(strstr(text, v->summary) && strstr(text, "--help"), "%s", text);
    free(text);
  }
}
END_TEST

/* the starter scene is valid, on every variant, and is not overwritten unasked */
START_TEST(starter_scene)
{
  char name[] = "/tmp/check_new_XXXXXX", file[64], argument[80];
  ck_assert_ptr_nonnull(mkdtemp(name));
  snprintf(file, sizeof file, "%s/starter.json", name);
  struct run_options   o = {.argument = file};
  struct loaded_scene *l = NULL;
  ck_assert_int_eq(verb_new(&o), OK);
  ck_assert_int_eq(verb_new(&o), ERR_INPUT);
  ck_assert_ptr_nonnull(strstr(status_message(), "--force"));
  o.force = true;
  ck_assert_int_eq(verb_new(&o), OK);
  snprintf(argument, sizeof argument, "%s+loose", file);
  for (int i = 0; i < 4; i++) {
    struct run_options read = {.argument = i % 2 ? argument : file, .quick = i > 1};
    ck_assert_msg(scene_load(&read, &l) == OK, "%s", status_message());
    scene_unload(&l);
  }
  unlink(file);
  rmdir(name);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("arguments");
  TCase *tcase = tcase_create("arguments");
  tcase_add_test(tcase, reads_options);
  tcase_add_test(tcase, defaults_and_help);
  tcase_add_loop_test(tcase, tells_what_is_wrong, 0, sizeof bad / sizeof *bad);
  tcase_add_test(tcase, every_verb_explains_itself);
  tcase_add_test(tcase, starter_scene);
  suite_add_tcase(suite, tcase);
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_ENV);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed != 0;
}
