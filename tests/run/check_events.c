/* Times at which a step must end: those that are nearly the same are one. */
#include "run/events.h"
#include "tests/scene_run.h"

/* Outputs every `interval` and at `extra`, a metric at `metric`; returns how many events there are. */
static int make(double interval, double extra, double metric, double t_end, struct events *events)
{
  struct scene scene = {.output = {.n_times = 1, .times = {extra}}};
  must(events_create(&scene, interval, &metric, 1, t_end, events));
  return events->n;
}

START_TEST(in_order)
{
  struct events e;
  ck_assert_int_eq(make(0.25, 0.3, 0.6, 1, &e), 6);
  const double t[] = {0.25, 0.3, 0.5, 0.6, 0.75, 1};
  const int kinds[] = {EVENT_OUTPUT, EVENT_OUTPUT, EVENT_OUTPUT, EVENT_METRIC, EVENT_OUTPUT, EVENT_OUTPUT | EVENT_END};
  for (int i = 0; i < e.n; i++) {
    ck_assert(fabs(e.event[i].t - t[i]) < 1e-12);
    ck_assert_int_eq(e.event[i].kinds, kinds[i]);
  }
  events_destroy(&e);
}
END_TEST

/* 0.999999999 and a metric at 0.9999999 would force steps of 1e-9 and 1e-7 s: they belong to the end. */
START_TEST(nearly_the_same)
{
  struct events e;
  ck_assert_int_eq(make(0.5, 1 - 1e-9, 1 - 1e-7, 1, &e), 2);
  ck_assert(e.event[1].t == 1);
  ck_assert_int_eq(e.event[1].kinds, EVENT_OUTPUT | EVENT_METRIC | EVENT_END);
  events_destroy(&e);
}
END_TEST

/* What is near is a matter of the interval, not of the end. */
START_TEST(apart)
{
  struct events e;
  ck_assert_int_eq(make(0.5, 1 - 1e-6, 0.5, 1, &e), 3);
  events_destroy(&e);
  ck_assert_int_eq(make(1e-3, 1 - 1e-8, 0.5, 1, &e), 1001);
  events_destroy(&e);
}
END_TEST

START_TEST(steps_end_there)
{
  struct events e;
  bool          last;
  ck_assert_int_eq(make(1, 0.5, 0.5, 1, &e), 2);
  ck_assert(fabs(events_step(&e, 0.1, 0.15, &last) - 0.4 / 3) < 1e-15 && !last);
  ck_assert(events_step(&e, 0.1, 0.4, &last) == 0.4 && last);
  events_destroy(&e);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("events");
  TCase *tests = tcase_create("times");
  tcase_add_test(tests, in_order);
  tcase_add_test(tests, nearly_the_same);
  tcase_add_test(tests, apart);
  tcase_add_test(tests, steps_end_there);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}
