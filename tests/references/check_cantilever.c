/* The finite-element cantilever: against beam theory where it is stiff, against itself with other elements where it is
 * soft, and the table that cases/cantilever is compared with. */
#include "references/cantilever.h"

#include "run/oscillation.h"
#include "tests/scene_run.h"

/* cases/cantilever, and the elements of its table */
static const struct cantilever soft = {
    .length = 4, .height = 1, .young = 1e6, .poisson = 0.3, .density = 1000, .gravity = 9.81, .n = {16, 4}, .order = 3};
enum { SAMPLES = 301 };
#define INTERVAL 0.01
#define TABLE MPMICE_SOURCE_DIR "/cases/cantilever/tip_fem.csv"

static struct cantilever_sample soft_tip[SAMPLES]; /* solved once for all tests */

static void solve(const struct cantilever *c, double interval, int n, struct cantilever_sample *samples)
{
  must(cantilever_solve(c, interval, n, samples));
}

static void solve_soft(void) { solve(&soft, INTERVAL, SAMPLES, soft_tip); }

/* A slender beam that hardly bends: Euler and Bernoulli's first mode, 1.8751^2 sqrt(E' I/(rho A L^4)), E' = E/(1 -
 * nu^2), is high by shear and turning of sections, of order (H/L)^2. The mean of a swing is the deflection rho g A
 * L^4/(8 E' I).
 */
START_TEST(a_little_bent_beam_swings_as_theory_says)
{
  enum { N = 201 };
  const struct cantilever  c = {.length = 10,
                                .height = 1,
                                .young = 1e6,
                                .poisson = 0.3,
                                .density = 1000,
                                .gravity = 1e-3,
                                .n = {4, 1},
                                .order = 4};
  struct cantilever_sample s[N];
  double                   t[N], u[N], frequency, decay, stiff = 1e6 / 0.91 / 12, pi = acos(-1.0), mean = 0;
  double                   expected = 1.8751 * 1.8751 / (2 * pi) * sqrt(stiff / (1000 * 1e4));
  solve(&c, 2 / expected / (N - 1), N, s);
  for (int i = 0; i < N; i++) {
    t[i] = s[i].t;
    u[i] = s[i].tip[1];
    mean += i > 0 ? u[i] / (N - 1) : 0;
  }
  must(oscillation_fit(N, t, u, &frequency, &decay));
  ck_assert_double_eq_tol(frequency, expected, 0.015 * expected);
  ck_assert_double_lt(frequency, expected);
  ck_assert_double_eq_tol(mean, -1000 * 1e-3 * 1e4 / (8 * stiff), 0.02 * fabs(mean));
}
END_TEST

START_TEST(energy_is_kept)
{
  const struct cantilever_sample *s = soft_tip;
  double                          lowest = 0;
  for (int i = 0; i < SAMPLES; i++) {
    lowest = fmin(lowest, s[i].tip[1]);
    ck_assert_double_lt(fabs(s[i].energy), 1e-5 * 4000 * 9.81);
  }
  ck_assert_double_eq_tol(lowest, -3.725, 2e-3);
}
END_TEST

/* other sizes and another order: the same motion to 1e-3 of the tip's way */
START_TEST(other_elements_agree)
{
  struct cantilever               other = soft;
  const struct cantilever_sample *s = soft_tip;
  struct cantilever_sample        o[SAMPLES];
  other.n[0] = 10;
  other.n[1] = 2;
  other.order = 4;
  solve(&other, INTERVAL, SAMPLES, o);
  for (int i = 0; i < SAMPLES; i++)
    for (int d = 0; d < 2; d++) ck_assert_double_eq_tol(o[i].tip[d], s[i].tip[d], 1.5e-3 * 3.725);
}
END_TEST

/* With CHECK_CANTILEVER_WRITE set, writes the table instead. */
START_TEST(the_table_is_this_solution)
{
  const struct cantilever_sample *s = soft_tip;
  double                          t, u[2];
  char                            line[128];
  if (getenv("CHECK_CANTILEVER_WRITE")) {
    FILE *out = fopen(TABLE, "w");
    ck_assert_ptr_nonnull(out);
    fprintf(out, "t,u_x,u_y\n");
    for (int i = 0; i < SAMPLES; i++) fprintf(out, "%.2f,%.6f,%.6f\n", s[i].t, s[i].tip[0], s[i].tip[1]);
    fclose(out);
    return;
  }
  FILE *in = fopen(TABLE, "r");
  ck_assert_ptr_nonnull(in);
  ck_assert_ptr_nonnull(fgets(line, sizeof line, in));
  for (int i = 0; i < SAMPLES; i++) {
    ck_assert_int_eq(fscanf(in, "%lf,%lf,%lf", &t, &u[0], &u[1]), 3);
    ck_assert_double_eq_tol(t, s[i].t, 1e-9);
    for (int d = 0; d < 2; d++) ck_assert_double_eq_tol(u[d], s[i].tip[d], 1e-5);
  }
  fclose(in);
}
END_TEST

/* when a curve is half the way from its value at t = from to that at t = to; samples every INTERVAL */
static double half_way(const struct cantilever_sample *s, double from, double to)
{
  int    i = (int)(from / INTERVAL + 0.5), last = (int)(to / INTERVAL + 0.5);
  double half = 0.5 * (s[i].tip[1] + s[last].tip[1]);
  while (s[i].tip[1] < half) i++;
  return s[i].t - INTERVAL * (s[i].tip[1] - half) / (s[i].tip[1] - s[i - 1].tip[1]);
}

/* what the metrics of the scene expect */
START_TEST(the_numbers_of_the_case_are_this_solution)
{
  const struct cantilever_sample *s = soft_tip;
  int                             lowest = 0, highest = 200;
  for (int i = 0; i < SAMPLES; i++) {
    if (s[i].tip[1] < s[lowest].tip[1]) lowest = i;
    if (i > 200 && s[i].tip[1] > s[highest].tip[1]) highest = i;
  }
  ck_assert_double_eq_tol(s[lowest].t, 1.08, 1e-9);
  ck_assert_double_eq_tol(s[lowest].tip[1], -3.7252, 1e-3);
  ck_assert_double_eq_tol(s[highest].t, 2.6, 1e-9);
  ck_assert_double_eq_tol(half_way(s, 1.25, 2.6), 2.1222, 1e-4);
}
END_TEST

START_TEST(refuses_elements_without_a_middle)
{
  struct cantilever        c = soft;
  struct cantilever_sample s[2];
  c.n[1] = 3;
  ck_assert_int_eq(cantilever_solve(&c, 0.1, 2, s), ERR_INPUT);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("cantilever");
  TCase *tcase = tcase_create("cantilever");
  tcase_add_unchecked_fixture(tcase, solve_soft, NULL);
  tcase_add_test(tcase, a_little_bent_beam_swings_as_theory_says);
  tcase_add_test(tcase, energy_is_kept);
  tcase_add_test(tcase, other_elements_agree);
  tcase_add_test(tcase, the_table_is_this_solution);
  tcase_add_test(tcase, the_numbers_of_the_case_are_this_solution);
  tcase_add_test(tcase, refuses_elements_without_a_middle);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
