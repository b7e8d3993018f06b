/* Shapes: signed distances against closed forms, borders, combinations. */
#include "core/shape.h"

#include "core/memory.h"

#include <check.h>
#include <math.h>
#include <string.h>

static double distance(const struct shape *s, double x, double y, double z)
{
  const double at[3] = {x, y, z};
  return shape_distance(s, at);
}

static bool contains(const struct shape *s, double x, double y, double z)
{
  const double at[3] = {x, y, z};
  return shape_contains(s, at);
}

static struct shape box(double x0, double y0, double x1, double y1)
{
  return (struct shape){.kind = SHAPE_BOX, .dim = 2, .min = {x0, y0, 0}, .max = {x1, y1, 0}};
}

START_TEST(everywhere_holds_all)
{
  const struct shape s = {.kind = SHAPE_EVERYWHERE};
  ck_assert(contains(&s, 1e30, -1e30, 0));
}
END_TEST

START_TEST(box_distances)
{
  const struct shape s = box(0, 0, 4, 2);
  ck_assert_double_eq(distance(&s, 1, 1, 99), -1);
  ck_assert_double_eq(distance(&s, 0.5, 1, 0), -0.5);
  ck_assert_double_eq(distance(&s, 7, 6, 0), 5);
  ck_assert_double_eq(distance(&s, 5, 1, 0), 1);
  ck_assert(contains(&s, 4, 2, 0));
  ck_assert(contains(&s, 4 + 5e-13, 1, 0));
  ck_assert(!contains(&s, 4 + 5e-12, 1, 0));
}
END_TEST

START_TEST(unbounded_box)
{
  struct shape s = box(-INFINITY, 0, INFINITY, 1);
  ck_assert_double_eq(distance(&s, 1e9, 0.25, 0), -0.25);
  ck_assert_double_eq(distance(&s, -1e9, 3, 0), 2);
  s = box(-INFINITY, -INFINITY, INFINITY, INFINITY);
  ck_assert(contains(&s, 0, 0, 0));
}
END_TEST

START_TEST(flat_box)
{
  const struct shape s = box(0, 1, 2, 1);
  ck_assert(contains(&s, 1, 1, 0));
  ck_assert_double_eq_tol(distance(&s, 1, 1.25, 0), 0.25, 1e-15);
}
END_TEST

START_TEST(box_in_3d)
{
  const struct shape s = {.kind = SHAPE_BOX, .dim = 3, .min = {0, 0, 0}, .max = {1, 1, 1}};
  ck_assert_double_eq_tol(distance(&s, 2, 3, 3), 3, 1e-15);
  ck_assert(!contains(&s, 0.5, 0.5, 1.5));
}
END_TEST

START_TEST(ball_distances)
{
  struct shape s = {.kind = SHAPE_BALL, .dim = 2, .centre = {1, 1, 0}, .radius = 2};
  ck_assert_double_eq(distance(&s, 4, 5, 77), 3);
  s.dim = 3;
  ck_assert_double_eq(distance(&s, 1, 1, 5), 3);
  ck_assert_double_eq(distance(&s, 1, 1, 0), -2);
}
END_TEST

START_TEST(half_space_distances)
{
  const struct shape s = {.kind = SHAPE_HALF_SPACE, .dim = 2, .centre = {0, 1, 0}, .normal = {3, 4, 0}};
  ck_assert_double_eq(distance(&s, 3, 5, 0), 5);
  ck_assert_double_eq(distance(&s, -3, -3, 0), -5);
  ck_assert(contains(&s, 4, -2, 0));
}
END_TEST

/* an L, given in both turns: inside, in the notch, beside a corner */
START_TEST(polygon_distances)
{
  const double corners[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  for (int turn = 0; turn < 2; turn++) {
    double vertices[6][2];
    for (int i = 0; i < 6; i++) memcpy(vertices[i], corners[turn ? 5 - i : i], sizeof vertices[i]);
    const struct shape s = {.kind = SHAPE_POLYGON, .dim = 2, .n = 6, .vertices = vertices};
    ck_assert_double_eq(distance(&s, 0.5, 1.5, 0), -0.5);
    ck_assert_double_eq(distance(&s, 1.5, 1.5, 0), 0.5);
    ck_assert_double_eq(distance(&s, 5, -4, 0), 5);
    ck_assert(contains(&s, 1, 1, 0));
    ck_assert(contains(&s, 2, 0, 0));
    ck_assert(!contains(&s, 2.1, 1, 0));
    ck_assert(!contains(&s, -1, 1, 0));
  }
}
END_TEST

START_TEST(combinations)
{
  struct shape parts[2] = {box(0, 0, 2, 2), box(1, 1, 3, 3)};
  struct shape s = {.kind = SHAPE_UNION, .dim = 2, .n = 2, .parts = parts};
  ck_assert(contains(&s, 0.5, 0.5, 0) && contains(&s, 2.5, 2.5, 0) && !contains(&s, 2.5, 0.5, 0));
  s.kind = SHAPE_INTERSECTION;
  ck_assert(contains(&s, 1.5, 1.5, 0) && !contains(&s, 0.5, 0.5, 0) && !contains(&s, 2.5, 2.5, 0));
  s.kind = SHAPE_DIFFERENCE;
  ck_assert(contains(&s, 0.5, 0.5, 0) && !contains(&s, 1.5, 1.5, 0) && !contains(&s, 2.5, 2.5, 0));
  ck_assert_double_eq_tol(distance(&s, 1.75, 1.25, 0), 0.25, 1e-15);
}
END_TEST

START_TEST(destroys_its_parts)
{
  struct shape s = {.kind = SHAPE_UNION, .dim = 2, .n = 1};
  ck_assert_int_eq(NEW(&s.parts, 1), OK);
  s.parts[0] = (struct shape){.kind = SHAPE_POLYGON, .dim = 2, .n = 3};
  ck_assert_int_eq(NEW(&s.parts[0].vertices, 3), OK);
  shape_destroy(&s);
  ck_assert_ptr_null(s.parts);
  shape_destroy(&s);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("shape");
  TCase *tcase = tcase_create("distances");
  tcase_add_test(tcase, everywhere_holds_all);
  tcase_add_test(tcase, box_distances);
  tcase_add_test(tcase, unbounded_box);
  tcase_add_test(tcase, flat_box);
  tcase_add_test(tcase, box_in_3d);
  tcase_add_test(tcase, ball_distances);
  tcase_add_test(tcase, half_space_distances);
  tcase_add_test(tcase, polygon_distances);
  tcase_add_test(tcase, combinations);
  tcase_add_test(tcase, destroys_its_parts);
  suite_add_tcase(suite, tcase);
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_ENV);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed != 0;
}
