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

/* the normal is the gradient of the distance, by differences, at places all around */
static void normals_are_gradients(const struct shape *s, int dim)
{
  const double e = 1e-6;
  int          tried = 0;
  for (int i = 0; i < 2000; i++) {
    double x[3], normal[3], difference[3] = {0}, length = 0;
    for (int d = 0; d < 3; d++) x[d] = d < dim ? 4 * fmod((i + 1) * (0.754877666 - 0.2 * d), 1) - 1.5 : 0;
    for (int d = 0; d < dim; d++) {
      double up[3] = {x[0], x[1], x[2]}, low[3] = {x[0], x[1], x[2]};
      up[d] += e;
      low[d] -= e;
      difference[d] = (shape_distance(s, up) - shape_distance(s, low)) / (2 * e);
      length += difference[d] * difference[d];
    }
    if (fabs(length - 1) > 1e-3) continue; /* two faces are equally near */
    shape_normal(s, x, normal);
    for (int d = 0; d < 3; d++) ck_assert_double_eq_tol(normal[d], difference[d], 1e-4);
    tried++;
  }
  ck_assert_int_gt(tried, 1800);
}

START_TEST(normals)
{
  double       turned[5][2] = {{0, 0}, {-0.5, 1}, {0.2, 0.6}, {1, 1.5}, {1, -0.5}};
  struct shape corner = box(0, 0, 1, 1), high = box(0.2, 0.3, INFINITY, INFINITY),
               ball = {.kind = SHAPE_BALL, .dim = 2, .centre = {0.4, 0.3, 0}, .radius = 0.7},
               plane = {.kind = SHAPE_HALF_SPACE, .dim = 2, .centre = {0.1, 0.2, 0}, .normal = {-1, 2, 0}},
               polygon = {.kind = SHAPE_POLYGON, .dim = 2, .n = 5, .vertices = turned},
               parts[] = {polygon, ball, plane}, cube = {.kind = SHAPE_BOX, .dim = 3, .max = {1, 1, 1}};
  const struct shape simple[] = {corner, high, ball, plane, polygon};
  for (int i = 0; i < 5; i++) normals_are_gradients(&simple[i], 2);
  for (int kind = SHAPE_UNION; kind <= SHAPE_INTERSECTION; kind++) {
    struct shape combined = {.kind = (enum shape_kind)kind, .dim = 2, .n = 3, .parts = parts};
    normals_are_gradients(&combined, 2);
  }
  normals_are_gradients(&cube, 3);
}
END_TEST

/* of a plane to the last bits, on it and far away */
START_TEST(normal_of_a_plane)
{
  const struct shape plane = {.kind = SHAPE_HALF_SPACE, .dim = 2, .centre = {1, 1, 0}, .normal = {0.5, sqrt(3) / 2, 0}};
  double             edge[3][2] = {{0, 0}, {3, 3}, {3, 0}};
  const struct shape polygon = {.kind = SHAPE_POLYGON, .dim = 2, .n = 3, .vertices = edge};
  for (int i = -3; i < 20; i++) {
    double x[3] = {1 + i * 0.1, 1 + i * 0.1 + (i % 2) * 1e-9, 0}, normal[3];
    shape_normal(&plane, x, normal);
    ck_assert_double_eq_tol(normal[0], 0.5, 1e-15);
    ck_assert_double_eq_tol(normal[1], sqrt(3) / 2, 1e-15);
    shape_normal(&polygon, x, normal);
    ck_assert_double_eq_tol(normal[0], -sqrt(0.5), 1e-15);
    ck_assert_double_eq_tol(normal[1], sqrt(0.5), 1e-15);
  }
}
END_TEST

START_TEST(no_surface_no_normal)
{
  const double       x[3] = {0.3, 0.2, 0};
  double             normal[3] = {1, 1, 1};
  const struct shape everywhere = {.kind = SHAPE_EVERYWHERE}, wide = box(-INFINITY, -INFINITY, INFINITY, INFINITY);
  shape_normal(&everywhere, x, normal);
  ck_assert_double_eq(normal[0], 0);
  shape_normal(&wide, x, normal);
  ck_assert_double_eq(normal[0] + normal[1], 0);
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
  tcase_add_test(tcase, normals);
  tcase_add_test(tcase, normal_of_a_plane);
  tcase_add_test(tcase, no_surface_no_normal);
  suite_add_tcase(suite, tcase);
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_ENV);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed != 0;
}
