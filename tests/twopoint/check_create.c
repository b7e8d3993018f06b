/* The step limit's wave speed, and scenes that this path refuses. */
#include "tests/twopoint/water.h"

/* det(S - c2 R) over the product of what it subtracts */
static double residual(double n, double E, double rho_s, double rho, double K)
{
  double c = twopoint_fast_wave(n, E, rho_s, rho, K), c2 = c * c;
  double a = E + (1 - n) * (1 - n) * K / n - c2 * (1 - n) * rho_s, d = n * K - c2 * n * rho, b = (1 - n) * K;
  return (a * d - b * b) / (b * b);
}

START_TEST(fast_wave_is_an_eigenvalue)
{
  ck_assert_double_lt(fabs(residual(0.3, 1.346e7, 2650, 1000, 2.2e9)), 1e-12);
  ck_assert_double_lt(fabs(residual(0.45, 5e6, 2700, 998, 2e7)), 1e-12);
}
END_TEST

/* the larger of the two: above both the water's speed and the speed of the mixture locked by drag */
START_TEST(fast_wave_is_the_faster)
{
  double n = 0.3, E = 1.346e7, rho_s = 2650, rho = 1000, K = 2.2e9;
  double c = twopoint_fast_wave(n, E, rho_s, rho, K), locked = sqrt((K / n + E) / ((1 - n) * rho_s + n * rho));
  ck_assert_double_gt(c, sqrt(K / rho));
  ck_assert_double_gt(c, locked);
  ck_assert_double_eq_tol(c, 2035, 0.5); /* Zheng et al., section 4.1 */
  ck_assert_double_eq_tol(twopoint_fast_wave(0.4, 5e6 * 0.7 / (1.3 * 0.4), 2650, 1000, 2e7), 182, 0.5); /* 4.3 */
}
END_TEST

START_TEST(fast_wave_of_a_held_skeleton_is_sound)
{
  ck_assert_double_eq_tol(twopoint_fast_wave(0.4, 0, INFINITY, 1000, 2e6), sqrt(2e3), 1e-12);
}
END_TEST

static void refuses(const char *fluid, const char *side, const char *words)
{
  char             text[1024];
  struct water_run run;
  snprintf(text, sizeof text,
           "{\"title\": \"t\", \"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.1}, \"time\": {\"end\": 1},"
           "\"gravity\": [0, 0], \"start\": \"zero\", \"fluid\": {\"path\": \"twopoint\", %s},"
           "\"boundary\": {\"fluid\": {\"x_max\": %s}}}",
           fluid, side);
  ck_assert_int_eq(water_try(text, &run), ERR_INPUT);
  ck_assert_msg(strstr(status_message(), words) != NULL, "said: %s", status_message());
  water_close(&run);
}

#define WATER "\"density\": 1000, \"bulk_modulus\": 2e6, \"region\": {\"box\": {\"min\": [0, 0], \"max\": [1, 0.5]}}"

START_TEST(refusals_name_what_is_wrong)
{
  refuses("\"density\": 1000, \"bulk_modulus\": \"infinite\"", "\"slip\"", "needs a finite fluid.bulk_modulus");
  refuses(WATER, "{\"pressure\": 5}", "boundary.fluid.x_max.pressure");
  refuses(WATER, "{\"velocity\": [1, 0]}", "boundary.fluid.x_max.velocity");
}
END_TEST

START_TEST(sides_that_work_are_accepted)
{
  static const char *const sides[] = {"\"slip\"", "\"no_slip\"",       "\"symmetry\"",
                                      "\"open\"", "{\"pressure\": 0}", "{\"velocity\": [0, 1]}"};
  for (int i = 0; i < 6; i++) {
    char             text[1024];
    struct water_run run;
    snprintf(text, sizeof text,
             "{\"title\": \"t\", \"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.1}, \"time\": {\"end\": 1},"
             "\"gravity\": [0, 0], \"start\": \"zero\", \"fluid\": {\"path\": \"twopoint\", " WATER "},"
             "\"boundary\": {\"fluid\": {\"x_max\": %s}}}",
             sides[i]);
    water_open(text, &run);
    for (int q = 0; q < 3; q++) water_step(&run, NULL);
    ck_assert_double_lt(run.water->now.speed, i == 5 ? 1 : 1e-12); /* without gravity only a moving wall moves */
    water_close(&run);
  }
}
END_TEST

/* water that crosses a periodic side comes back at the other */
START_TEST(periodic_sides_bring_water_back)
{
  struct water_run run;
  water_open("{\"title\": \"t\", \"grid\": {\"min\": [0, 0], \"max\": [1, 0.4], \"h\": 0.1}, \"time\": {\"end\": 1},"
             "\"gravity\": [0, 0], \"start\": \"zero\", \"fluid\": {\"path\": \"twopoint\", \"density\": 1000,"
             "\"bulk_modulus\": 1e5, \"velocity\": [1, 0]}, \"numerics\": {\"basis\": \"cubic\"},"
             "\"boundary\": {\"fluid\": {\"x_min\": \"periodic\", \"x_max\": \"periodic\"},"
             "\"solid\": {\"x_min\": \"periodic\", \"x_max\": \"periodic\"}}}",
             &run);
  for (int i = 0; i < 60; i++) water_step(&run, NULL);
  ck_assert_double_gt(run.sim->t, 0.4);
  for (long p = 0; p < run.water->points->n; p++) {
    ck_assert(run.water->x_w[2 * p] >= 0 && run.water->x_w[2 * p] < 1);
    ck_assert_double_eq_tol(run.water->vel_w[2 * p], 1, 1e-12);
    ck_assert_double_eq_tol(run.water->P_w[p], 0, 1e-5);
  }
  water_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("twopoint.create");
  TCase *tests = tcase_create("create");
  tcase_add_test(tests, fast_wave_is_an_eigenvalue);
  tcase_add_test(tests, fast_wave_is_the_faster);
  tcase_add_test(tests, fast_wave_of_a_held_skeleton_is_sound);
  tcase_add_test(tests, refusals_name_what_is_wrong);
  tcase_add_test(tests, sides_that_work_are_accepted);
  tcase_add_test(tests, periodic_sides_bring_water_back);
  suite_add_tcase(suite, tests);
  return water_main(suite);
}
