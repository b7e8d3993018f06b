/* exp and ln of groups against libm's, over all that they take. */
#include "constitutive/exponential.h"
#include "tests/constitutive/element.h"

START_TEST(exponential)
{
  double worst = 0.0;
  for (double size = 1e-20; size < EXPONENT_MOST; size *= 1.003) {
    VECTOR x = VECTOR_ALL(0.0), result, whole;
    x[0] = size, x[1] = -size, x[2] = 1e300, x[3] = -1e300;
    vector_exp(&x, &whole, &result);
    for (int i = 0; i < 2; i++) worst = fmax(worst, fabs(result[i] / expm1(x[i]) - 1.0));
    for (int i = 0; i < 2; i++) worst = fmax(worst, fabs(whole[i] / exp(x[i]) - 1.0));
    ck_assert_double_eq(result[LANES - 1], 0.0);
    ck_assert_double_eq_tol(result[2] / expm1(EXPONENT_MOST), 1.0, 1e-15);
    ck_assert_double_eq(result[3], -1.0);
  }
  printf("exp(x), exp(x) - 1: %.1e\n", worst);
  ck_assert_double_le(worst, 5e-16);
}
END_TEST

START_TEST(logarithm)
{
  double worst = 0.0;
  for (double size = 1e-16; size < EXPONENT_MOST; size *= 1.003) {
    VECTOR x = VECTOR_ALL(1.0), result;
    x[0] = 1.0 + size, x[1] = exp(size), x[2] = exp(-size);
    vector_log(&x, &result);
    for (int i = 0; i < 3; i++)
      if (x[i] != 1.0) worst = fmax(worst, fabs(result[i] / log(x[i]) - 1.0));
    ck_assert_double_eq(result[LANES - 1], 0.0);
  }
  printf("ln(x): %.1e\n", worst);
  ck_assert_double_le(worst, 5e-16);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("constitutive/exponential");
  TCase *tests = tcase_create("exponential");
  tcase_add_test(tests, exponential);
  tcase_add_test(tests, logarithm);
  suite_add_tcase(suite, tests);
  return element_run(suite);
}
