/* A prescribed motion: bodies that are carried once round come back where they were, and no pressure is planned. */
#include "ice/ice.h"

#include "tests/scene_run.h"

#define PERIODIC                                                                                                       \
  "\"boundary\": {\"fluid\": {\"x_min\": \"periodic\", \"x_max\": \"periodic\", \"y_min\": \"periodic\", "             \
  "\"y_max\": \"periodic\"}}"
#define SCENE(velocity, strength, sides)                                                                               \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.05}, \"time\": {\"end\": 1}, \"start\": \"zero\", "          \
  "\"fluid\": {\"path\": \"ice\", \"bulk_modulus\": \"infinite\", \"motion\": \"prescribed\", \"strength\": "          \
  "\"" strength "\", \"velocity\": " velocity                                                                          \
  ", \"region\": {\"box\": {\"min\": [0.22, 0.31], \"max\": [0.63, 0.72]}}}, " sides                                   \
  "\"numerics\": {\"ice\": {\"advection\": true}}}"

static double *copy_of(const double *from, long n)
{
  double *to;
  must(NEW(&to, n));
  memcpy(to, from, (size_t)n * sizeof *to);
  return to;
}

/* sum of |mass - what it was| over the sum of what it was, after one second */
static double away_after(const char *text)
{
  struct scene_run run;
  double           away = 0, all = 0, now = 0;
  scene_open(text, &run);
  const struct ice  *ice = ice_of(run.sim);
  const struct grid *g = &run.sim->grid;
  const struct box   cells = grid_cells(g);
  double            *start = copy_of(ice->mass_cc, g->size);
  ck_assert_ptr_null(ice->dP_cc);
  ck_assert_ptr_null(ice->u_fc);
  while (run.sim->t < 1 - 1e-12) ck_assert_double_gt(scene_step(&run, 1 - run.sim->t), 0);
  FOR_BOX_SERIAL(g, cells, c)
  {
    away += fabs(ice->mass_cc[c] - start[c]);
    all += start[c];
    now += ice->mass_cc[c];
  }
  ck_assert_double_eq_tol(now, all, 1e-12 * all);
  ck_assert_double_lt(run.sim->defect_max, 1e-12);
  memory_free(&start);
  scene_close(&run);
  return away / all;
}

/* corners are rounded a little */
START_TEST(once_round)
{
  ck_assert_double_lt(away_after(SCENE("[1, 0]", "1", PERIODIC ", ")), 0.03);
  ck_assert_double_lt(away_after(SCENE("[1, -1]", "1", PERIODIC ", ")), 0.05);
}
END_TEST

/* to and fro between closed sides, in a flow without divergence; far without the turn */
START_TEST(to_and_fro)
{
  static const char vortex[] = SCENE("[\"-sin(pi*x)*cos(pi*y)\", \"cos(pi*x)*sin(pi*y)\"]", "cos(pi*t)", ""),
                    turn[] = SCENE("[\"-sin(pi*x)*cos(pi*y)\", \"cos(pi*x)*sin(pi*y)\"]", "1", "");
  ck_assert_double_lt(away_after(vortex), 0.05);
  ck_assert_double_gt(away_after(turn), 0.2);
}
END_TEST

START_TEST(too_strong)
{
  struct scene_run run;
  scene_open(SCENE("[1, 0]", "1 + t", PERIODIC ", "), &run);
  ck_assert_int_eq(ice_carry_prescribed(run.sim, 0.01), ERR_INPUT);
  ck_assert_ptr_nonnull(strstr(status_message(), "fluid.strength"));
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("ice prescribed motion");
  TCase *motion = tcase_create("motion");
  tcase_add_test(motion, once_round);
  tcase_add_test(motion, to_and_fro);
  tcase_add_test(motion, too_strong);
  suite_add_tcase(suite, motion);
  return run_suite(suite);
}
