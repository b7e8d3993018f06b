/* Expressions: values, precedence, and what a wrong text is told. */
#include "core/function.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double place[3] = {2, 3, 5};
static const double now = 0.25;

static double value_of(const char *text)
{
  struct function f;
  ck_assert_msg(function_parse(text, &f) == OK, "%s: %s", text, status_message());
  double value = function_value(&f, place, now);
  function_destroy(&f);
  return value;
}

/* x = 2, y = 3, z = 5, t = 0.25; values by hand */
static const struct {
  const char *text;
  double      value;
} good[] = {
    {"1", 1},
    {" -2.5e-1 ", -0.25},
    {".5", 0.5},
    {"1e4*min(1, t/0.001)", 1e4},
    {"1e4*min(1, t/0.5)", 5e3},
    {"1+2*3", 7},
    {"(1+2)*3", 9},
    {"8/4/2", 1},
    {"8-4-2", 2},
    {"-2^2", -4},
    {"2^-1", 0.5},
    {"2^3^2", 512},
    {"--2", 2},
    {"+x", 2},
    {"2*-3", -6},
    {"x*y+z", 11},
    {"min(y, x, z)", 2},
    {"max(y, x, z)", 5},
    {"abs(-3)+sqrt(16)", 7},
    {"exp(0)+log(1)", 1},
    {"sin(pi/2)+cos(0)+tan(0)+tanh(0)", 2},
    {"floor(-1.5)", -2},
    {"step(0)", 1},
    {"step(-1e-300)", 0},
    {"step(t-0.2)*(1-step(t-0.3))", 1},
    {"((((((((((x))))))))))", 2},
};

START_TEST(good_texts)
{
  ck_assert_double_eq_tol(value_of(good[_i].text), good[_i].value, 1e-15 * fmax(1, fabs(good[_i].value)));
}
END_TEST

static const struct {
  const char *text, *fragment;
} bad[] = {
    {"", "column 1; expected a number"},
    {"1+", "column 3; expected a number"},
    {"1 2", "column 3: found '2'; expected an operator or the end"},
    {"(1", "column 3; expected an operator or \")\""},
    {"1)", "column 2: found ')'"},
    {"q", "column 1: found 'q'; expected x, y, z, t, pi"},
    {"2*tt", "column 3"},
    {"sin 1", "\"(\" after the name of a function"},
    {"sin()", "column 5"},
    {"min(1)", "a second argument"},
    {"sin(1, 2)", "expected \")\""},
    {"0x10", "column 2"},
    {"inf", "column 1"},
    {"nan", "column 1"},
    {"1e999", "a number that a double can hold"},
    {"1/0", "is not finite"},
    {"log(0)", "is not finite"},
    {"1..2", "column 3"},
    {"x @ y", "found '@'"},
};

START_TEST(bad_texts)
{
  struct function f;
  ck_assert_int_eq(function_parse(bad[_i].text, &f), ERR_INPUT);
  ck_assert_msg(strstr(status_message(), bad[_i].fragment) != NULL, "\"%s\" is told: %s", bad[_i].text,
                status_message());
  ck_assert_ptr_null(f.expression);
}
END_TEST

START_TEST(constants_need_no_program)
{
  struct function f;
  ck_assert_int_eq(function_parse("2*pi", &f), OK);
  ck_assert_ptr_null(f.expression);
  ck_assert_ptr_null(function_text(&f));
  ck_assert_double_eq(f.constant, 2 * acos(-1.0));
  function_destroy(&f);
  ck_assert_int_eq(function_parse("2*t", &f), OK);
  ck_assert_str_eq(function_text(&f), "2*t");
  function_destroy(&f);
  ck_assert_double_eq(function_value(&f, place, now), 0);
}
END_TEST

/* nesting and length beyond any stack end in a message, not in a crash */
START_TEST(deep_texts)
{
  enum { N = 100000 };
  struct function   f;
  static const char pieces[] = {'(', '-', '^'};
  char             *text = malloc(2 * N + 2);
  for (int p = 0; p < 3; p++) {
    memset(text, pieces[p], N);
    text[N] = '\0';
    ck_assert_int_eq(function_parse(text, &f), ERR_INPUT);
  }
  for (int i = 0; i < N; i++) memcpy(text + 2 * i, "1+", 2);
  memcpy(text + 2 * N, "t", 2);
  ck_assert_int_eq(function_parse(text, &f), OK);
  ck_assert_double_eq(function_value(&f, place, now), N + 0.25);
  function_destroy(&f);
  for (int i = 0; i < 40; i++) memcpy(text + 4 * i, "x+(t", 4);
  memset(text + 160, ')', 40);
  text[200] = '\0';
  ck_assert_int_eq(function_parse(text, &f), ERR_INPUT);
  free(text);
}
END_TEST

START_TEST(tables)
{
  const double    t[] = {-1, 0.5, 0.75, 3}, v[] = {4, 1, 2, -7}, *row_t, *row_v;
  struct function f = {0, NULL};
  ck_assert_int_eq(function_rows(&f, &row_t, &row_v), 0);
  ck_assert_int_eq(function_table(4, t, v, &f), OK);
  for (int i = 0; i < 4; i++) ck_assert_double_eq(function_value(&f, place, t[i]), v[i]);
  ck_assert_double_eq(function_value(&f, place, -0.25), 2.5);
  ck_assert_double_eq(function_value(&f, place, 2.5), -5);
  ck_assert_double_eq(function_value(&f, place, -9), 4);
  ck_assert_double_eq(function_value(&f, place, 9), -7);
  ck_assert_ptr_nonnull(f.expression);
  ck_assert_ptr_null(function_text(&f));
  ck_assert_int_eq(function_rows(&f, &row_t, &row_v), 4);
  ck_assert(row_t[2] == 0.75 && row_v[3] == -7);
  function_destroy(&f);
  ck_assert_int_eq(function_table(1, t, v, &f), OK);
  ck_assert_double_eq(function_value(&f, place, 7), 4);
  function_destroy(&f);
}
END_TEST

START_TEST(what_varies_in_space)
{
  static const char *const texts[] = {"2", "2*t", "sin(t) + 0*z", "x", "t + y"};
  for (int i = 0; i < 5; i++) {
    struct function f;
    ck_assert_int_eq(function_parse(texts[i], &f), OK);
    ck_assert(function_varies_in_space(&f) == (i >= 2));
    function_destroy(&f);
  }
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("function");
  TCase *tcase = tcase_create("expressions");
  tcase_add_loop_test(tcase, good_texts, 0, sizeof good / sizeof *good);
  tcase_add_test(tcase, tables);
  tcase_add_test(tcase, what_varies_in_space);
  tcase_add_loop_test(tcase, bad_texts, 0, sizeof bad / sizeof *bad);
  tcase_add_test(tcase, constants_need_no_program);
  tcase_add_test(tcase, deep_texts);
  suite_add_tcase(suite, tcase);
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_ENV);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed != 0;
}
