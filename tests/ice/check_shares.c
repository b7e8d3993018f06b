/* Shares of cells and faces inside shapes, and the way out of them. */
#include "ice/shares.h"

#include "tests/scene_run.h"

static double inside(const struct grid *g, const struct shape *shape, const double x[3], int axis)
{
  struct places p = places_of(shape);
  return share_inside(g, &p, x, axis);
}

static double way_out(const struct grid *g, const struct shape *shape, const double x[3], int axis, int sign)
{
  struct places p = places_of(shape);
  return share_way_out(g, &p, x, axis, sign, 1.5);
}

static const struct grid square = {.dim = 2, .h = 0.1}, cube = {.dim = 3, .h = 0.1};

/* half-plane through a point, at any angle: the share below is known by symmetry, and from a corner cut off */
START_TEST(planes)
{
  const struct shape slope = {.kind = SHAPE_HALF_SPACE, .dim = 2, .normal = {1, 1, 0}, .centre = {0.05, 0, 0}};
  const double       centre[3] = {0, 0, 0}, face[3] = {0.05, 0, 0}, low[3] = {0, -0.05, 0};
  ck_assert_double_eq_tol(inside(&square, &slope, centre, -1), 1 - 0.125, 1e-12);
  ck_assert_double_eq_tol(inside(&square, &slope, face, 0), 0.5, 1e-12);
  ck_assert_double_eq_tol(inside(&square, &slope, low, 1), 1, 1e-12);
  ck_assert_double_eq_tol(way_out(&square, &slope, centre, 0, 1), 0.5, 1e-12);
  ck_assert_double_eq_tol(way_out(&square, &slope, centre, 1, -1), 1.5, 1e-12);
  ck_assert_double_eq_tol(way_out(&square, &slope, (const double[3]){0.2, 0, 0}, 0, 1), 0, 1e-12);
}
END_TEST

/* flat surfaces along the cells are exact, and nothing is left of round-off where they lie on a face */
START_TEST(boxes)
{
  const struct shape box = {.kind = SHAPE_BOX, .dim = 3, .min = {-1, -1, -1}, .max = {0.02, 0.05, 1}};
  const double       centre[3] = {0, 0, 0}, beyond[3] = {0, 0.1, 0}, face[3] = {0, 0.05, 0};
  ck_assert_double_eq_tol(inside(&cube, &box, centre, -1), 0.7, 1e-12);
  ck_assert(inside(&cube, &box, beyond, -1) == 0);
  ck_assert_double_eq_tol(inside(&cube, &box, centre, 1), 0.7, 1e-12);
  ck_assert_double_eq_tol(inside(&cube, &box, face, 2), 0.35, 1e-12);
}
END_TEST

/* what a slope leaves over of a cell, half filled, and its slices; a slope that has moved away leaves everything */
START_TEST(rest_of_a_cell)
{
  const struct shape slope = {.kind = SHAPE_HALF_SPACE, .dim = 2, .normal = {1, 1, 0}};
  const struct shape water = {.kind = SHAPE_HALF_SPACE, .dim = 2, .normal = {0, 1, 0}};
  const double       centre[3] = {0, 0, 0};
  struct places      p = places_of(&slope), w = places_of(&water);
  double             slice[SHARE_PARTS];
  ck_assert_double_eq_tol(share_left(&square, &p, NULL, centre, 1, slice), 0.5, 1e-12);
  for (int k = 0; k < SHARE_PARTS; k++)
    ck_assert_double_eq_tol(slice[k], (k + 0.5) / (SHARE_PARTS * SHARE_PARTS), 1e-12);
  ck_assert_double_eq_tol(share_left(&square, &p, &w, centre, 1, slice), 0.25, 1e-12);
  p.moved[0][1] = -0.1;
  ck_assert_double_eq_tol(share_left(&square, &p, &w, centre, 1, slice), 0.5, 1e-12);
  ck_assert_double_eq_tol(share_left(&square, &p, NULL, centre, 1, slice), 1, 1e-12);
}
END_TEST

/* cells of a grid over a ball, together its volume, of second order in h */
static double ball_error(double h, int dim)
{
  struct grid        g = {.dim = dim, .h = h};
  const struct shape ball = {.kind = SHAPE_BALL, .dim = dim, .centre = {0.013, 0.007, 0.011}, .radius = 0.8};
  double             sum = 0, exact = dim == 3 ? 4 / 3.0 * M_PI * 0.512 : M_PI * 0.64;
  int                n = (int)(1 / h + 0.5);
  for (int i = -n; i < n; i++)
    for (int j = -n; j < n; j++)
      for (int k = dim == 3 ? -n : 0; k < (dim == 3 ? n : 1); k++) {
        const double x[3] = {(i + 0.5) * h, (j + 0.5) * h, dim == 3 ? (k + 0.5) * h : 0};
        sum += inside(&g, &ball, x, -1) * pow(h, dim);
      }
  return sum / exact - 1;
}

START_TEST(balls)
{
  ck_assert_double_lt(fabs(ball_error(0.2, 2)), 2e-4);
  ck_assert_double_lt(fabs(ball_error(0.2, 3)), 5e-4);
  ck_assert_double_gt(fabs(ball_error(0.2, 2) / ball_error(0.1, 2)), 3);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("ice shares");
  TCase *shares = tcase_create("shares");
  tcase_add_test(shares, planes);
  tcase_add_test(shares, boxes);
  tcase_add_test(shares, rest_of_a_cell);
  tcase_add_test(shares, balls);
  suite_add_tcase(suite, shares);
  return run_suite(suite);
}
