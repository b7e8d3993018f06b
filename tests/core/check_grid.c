/* The grid: indices, places, boxes, offsets between cells, faces and nodes, periodic ghosts. */
#include "core/grid.h"
#include "core/parallel.h"

#include "tests/scene_run.h"

static struct grid make(int dim, bool periodic_x)
{
  const double min[3] = {-1, 2, 0.5};
  const int    n[3] = {7, 4, 3};
  const bool   periodic[3] = {periodic_x, false, false};
  struct grid  g;
  grid_create(dim, min, n, 0.25, periodic, &g);
  return g;
}

static long count(const struct grid *g, struct box b)
{
  long n = 0;
  FOR_BOX_SERIAL(g, b, c) n += c >= 0;
  return n;
}

START_TEST(places_and_indices_are_inverse)
{
  for (int dim = 2; dim <= 3; dim++) {
    struct grid g = make(dim, false);
    struct box  all = grid_all(&g);
    long        last = -1;
    FOR_BOX_SERIAL(&g, all, c)
    {
      int place[3];
      grid_place(&g, c, place);
      ck_assert_int_eq(grid_at(&g, place[0], place[1], place[2]), c);
      for (int d = 0; d < 3; d++) ck_assert(place[d] >= all.lo[d] && place[d] < all.hi[d]);
      ck_assert_int_gt(c, last);
      last = c;
    }
    ck_assert_int_eq(count(&g, all), g.size);
    ck_assert_int_eq(last, g.size - 1);
  }
}
END_TEST

START_TEST(positions)
{
  for (int dim = 2; dim <= 3; dim++) {
    struct grid g = make(dim, false);
    long        i = grid_at(&g, 2, -1, dim == 3 ? 1 : 0);
    double      x[3];
    grid_node(&g, i, x);
    ck_assert_double_eq(x[0], -0.5);
    ck_assert_double_eq(x[1], 1.75);
    ck_assert_double_eq(x[2], dim == 3 ? 0.75 : 0);
    grid_centre(&g, i, x);
    ck_assert_double_eq(x[0], -0.375);
    ck_assert_double_eq(x[1], 1.875);
    ck_assert_double_eq(x[2], dim == 3 ? 0.875 : 0);
    grid_face(&g, i, 1, x);
    ck_assert_double_eq(x[0], -0.375);
    ck_assert_double_eq(x[1], 1.75);
    ck_assert_double_eq(x[2], dim == 3 ? 0.875 : 0);
    ck_assert_double_eq(grid_cell_volume(&g), dim == 3 ? 0.015625 : 0.0625);
  }
}
END_TEST

START_TEST(boxes_count_what_is_owned)
{
  struct grid flat = make(2, false), deep = make(3, false), ring = make(3, true);
  ck_assert_int_eq(count(&flat, grid_cells(&flat)), 7 * 4);
  ck_assert_int_eq(count(&flat, grid_nodes(&flat)), 8 * 5);
  ck_assert_int_eq(count(&flat, grid_faces(&flat, 0)), 8 * 4);
  ck_assert_int_eq(count(&flat, grid_faces(&flat, 1)), 7 * 5);
  ck_assert_int_eq(count(&deep, grid_nodes(&deep)), 8 * 5 * 4);
  ck_assert_int_eq(count(&deep, grid_faces(&deep, 2)), 7 * 4 * 4);
  ck_assert_int_eq(count(&ring, grid_nodes(&ring)), 7 * 5 * 4);
}
END_TEST

/* the mean place of a cell's or face's nodes is its centre; a node is among the nodes of the faces at -offset */
START_TEST(offsets_lead_to_the_nodes)
{
  for (int dim = 2; dim <= 3; dim++) {
    struct grid g = make(dim, false);
    for (int axis = -1; axis < dim; axis++) {
      long   offset[8], at = grid_at(&g, 3, 2, dim == 3 ? 1 : 0);
      int    n = grid_node_offsets(&g, axis, offset);
      double mean[3] = {0}, centre[3];
      ck_assert_int_eq(n, axis < 0 ? 1 << dim : 1 << (dim - 1));
      for (int i = 0; i < n; i++) {
        double x[3];
        grid_node(&g, at + offset[i], x);
        for (int d = 0; d < 3; d++) mean[d] += x[d] / n;
      }
      if (axis < 0)
        grid_centre(&g, at, centre);
      else
        grid_face(&g, at, axis, centre);
      for (int d = 0; d < 3; d++) ck_assert_double_eq_tol(mean[d], centre[d], 1e-15);
    }
  }
}
END_TEST

START_TEST(periodic_ghosts)
{
  struct grid g = make(3, true);
  struct box  cells = grid_cells(&g);
  double     *field;
  must(NEW(&field, 2 * g.size));
  FOR_BOX_SERIAL(&g, cells, c)
  {
    field[2 * c] = (double)c;
    field[2 * c + 1] = -(double)c;
  }
  grid_fill_periodic(&g, 2, field);
  for (int i = -GHOST; i < g.n[0] + 1 + GHOST; i++) {
    long from = grid_at(&g, (i + g.n[0]) % g.n[0], 2, 1), to = grid_at(&g, i, 2, 1);
    ck_assert_double_eq(field[2 * to], (double)from);
    ck_assert_double_eq(field[2 * to + 1], -(double)from);
  }
  ck_assert_double_eq(field[2 * grid_at(&g, 3, -1, 1)], 0); /* other axes are left alone */
  memory_free(&field);
}
END_TEST

/* a grid with fewer cells than ghosts goes round more than once */
START_TEST(periodic_ghosts_of_a_narrow_grid)
{
  const double min[3] = {0};
  const int    n[3] = {2, 1, 3};
  struct grid  g;
  double      *field;
  grid_create(3, min, n, 1, (const bool[]){true, true, true}, &g);
  struct box cells = grid_cells(&g), all = grid_all(&g);
  must(NEW(&field, g.size));
  FOR_BOX_SERIAL(&g, cells, c) field[c] = (double)c;
  grid_fill_periodic(&g, 1, field);
  FOR_BOX_SERIAL(&g, all, c)
  {
    int place[3];
    grid_place(&g, c, place);
    for (int d = 0; d < 3; d++) place[d] = (place[d] + 6 * n[d]) % n[d];
    ck_assert_double_eq(field[c], (double)grid_at(&g, place[0], place[1], place[2]));
  }
  memory_free(&field);
}
END_TEST

/* the parallel walk visits what the serial one does, once */
START_TEST(walks_visit_once)
{
  struct grid g = make(3, false);
  struct box  b = grid_faces(&g, 1);
  double     *seen;
  must(NEW(&seen, g.size));
  parallel_set_threads(4);
  FOR_BOX(&g, b, c) seen[c] += 1;
  FOR_BOX_SERIAL(&g, b, c) seen[c] -= 1;
  for (long c = 0; c < g.size; c++) ck_assert_double_eq(seen[c], 0);
  memory_free(&seen);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("grid");
  TCase *tcase = tcase_create("grid");
  tcase_add_test(tcase, places_and_indices_are_inverse);
  tcase_add_test(tcase, positions);
  tcase_add_test(tcase, boxes_count_what_is_owned);
  tcase_add_test(tcase, offsets_lead_to_the_nodes);
  tcase_add_test(tcase, periodic_ghosts);
  tcase_add_test(tcase, periodic_ghosts_of_a_narrow_grid);
  tcase_add_test(tcase, walks_visit_once);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
