/* What a run says of its start at rest: how it was found, and whether it moves. */
#include "run/start_check.h"

#include "tests/scene_run.h"

#define BED                                                                                                            \
  "{\"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.1}, \"time\": {\"end\": 1}, \"gravity\": [0, -9.81], "       \
  "\"materials\": {\"soil\": {\"model\": \"linear_elastic\", \"young\": 1e6, \"poisson\": 0.3, \"density\": 1600}}, "  \
  "\"solids\": {\"bed\": {\"material\": \"soil\", \"shape\": {\"box\": {\"min\": [0, 0], \"max\": [0.5, 0.5]}}}}, "    \
  "\"obstacles\": {\"wall\": {\"shape\": {\"box\": {\"min\": [0.5, null], \"max\": [0.7, null]}}}}}"

/* runs so many steps; text: what is printed then */
static struct start_record record_after(const char *const *sets, int steps, char text[256])
{
  struct scene_run    run;
  struct start_motion motion = {0};
  struct start_record record;
  FILE               *file = fmemopen(text, 256, "w");
  scene_open_with(BED, sets, &run);
  for (int i = 0; i < steps; i++) {
    scene_step(&run, INFINITY);
    start_check_step(run.sim, &motion);
  }
  start_check_fill(run.sim, &motion, &record);
  start_check_print(&record, file);
  fclose(file);
  scene_close(&run);
  return record;
}

START_TEST(settled)
{
  char                text[256] = "";
  struct start_record r = record_after(NULL, 0, text);
  ck_assert(r.computed && r.settled && r.still && !r.moves);
  ck_assert_int_gt(r.steps, 0);
  ck_assert_double_le(r.unbalanced, 1e-3);
  ck_assert_double_gt(r.column, r.unbalanced);
  ck_assert_ptr_nonnull(strstr(text, "steps of the static solve"));
  r = record_after(NULL, 40, text); /* later steps do not count */
  ck_assert_double_gt(r.motion.fall, 0);
  ck_assert_double_lt(r.motion.speed, 0.01 * r.motion.fall);
  ck_assert(!r.moves);
  ck_assert_ptr_nonnull(strstr(text, "largest velocity of the solid after 10 steps"));
  ck_assert_ptr_null(strstr(text, "WARNING"));
}
END_TEST

/* columns alone, leaning on a wall that they know nothing of, and with a gate that they lean on no more */
START_TEST(not_at_rest)
{
  static const char *const alone[] = {"obstacles={}", "numerics.rest_steps=0", NULL};
  char                     text[256] = "";
  struct start_record      r = record_after(alone, 0, text);
  ck_assert(r.computed && !r.settled);
  ck_assert_ptr_nonnull(strstr(text, "numerics.rest_steps is 0"));
  r = record_after(alone, 10, text);
  ck_assert(r.still && r.moves);
  ck_assert_ptr_nonnull(strstr(text, "WARNING"));
}
END_TEST

/* what lets the solid go, or sets it going, is no fault of the start */
START_TEST(not_judged)
{
  static const char *const sets[][2] = {
      {"obstacles.wall.until=0", NULL},
      {"obstacles.wall.velocity=[1, 0]", NULL},
      {"solids.bed.velocity=[0.1, 0]", NULL},
      {"gravity=[\"t\", -9.81]", NULL},
      {"boundary.solid.y_min={\"velocity\": [1, 0]}", NULL},
      {"loads={\"top\": {\"on\": {\"box\": {\"min\": [0, 0.5], \"max\": [0.5, 0.5]}}, \"traction\": [0, -1]}}", NULL}};
  char                text[256] = "";
  struct start_record r = record_after(sets[_i], 10, text);
  ck_assert(r.computed && r.settled && !r.still && !r.moves);
  ck_assert_ptr_null(strstr(text, "WARNING"));
}
END_TEST

START_TEST(nothing_to_say)
{
  static const char *const sets[][2] = {{"start=zero", NULL}, {"gravity=[0, 0]", NULL}};
  char                     text[256] = "";
  struct start_record      r = record_after(sets[_i], 10, text);
  ck_assert(!r.computed);
  ck_assert_str_eq(text, "");
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("start_check");
  TCase *tcase = tcase_create("starts");
  tcase_add_test(tcase, settled);
  tcase_add_test(tcase, not_at_rest);
  tcase_add_loop_test(tcase, not_judged, 0, 6);
  tcase_add_loop_test(tcase, nothing_to_say, 0, 2);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
