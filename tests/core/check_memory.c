/* The allocator: zeroed, aligned, counted; what cannot be had is an error. */
#include "core/memory.h"

#include "tests/scene_run.h"

#include <stdint.h>

START_TEST(zeroed_and_aligned)
{
  for (int n = 0; n < 200; n += 13) {
    double *x;
    must(NEW(&x, n));
    ck_assert_ptr_nonnull(x);
    ck_assert_int_eq((uintptr_t)x % 64, 0);
    for (int i = 0; i < n; i++) {
      ck_assert_double_eq(x[i], 0);
      x[i] = i; /* the next allocation may get this memory */
    }
    memory_free(&x);
    ck_assert_ptr_null(x);
  }
}
END_TEST

START_TEST(calls_are_counted)
{
  char *a, *b;
  long  before = memory_calls();
  must(NEW(&a, 1));
  must(NEW(&b, 1));
  ck_assert_int_eq(memory_calls(), before + 2);
  memory_free(&a);
  memory_free(&b);
  memory_free(&b);
  ck_assert_int_eq(memory_calls(), before + 2);
}
END_TEST

START_TEST(too_much_is_an_error)
{
  double *x = NULL;
  ck_assert_int_eq(memory_new(SIZE_MAX / 4, 8, &x), ERR_ENVIRONMENT);
  ck_assert_ptr_null(x);
  ck_assert_ptr_nonnull(strstr(status_message(), "overflow"));
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("memory");
  TCase *tcase = tcase_create("memory");
  tcase_add_test(tcase, zeroed_and_aligned);
  tcase_add_test(tcase, calls_are_counted);
  tcase_add_test(tcase, too_much_is_an_error);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
