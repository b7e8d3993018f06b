/* Planes whose fill is put into cells come back; walls, obstacles, curved surfaces, symmetry. */
#include "ice/plic.h"

#include "tests/scene_run.h"

enum { N = 7 };

struct cells {
  struct grid grid;
  double     *pore, *fill;
  struct plic plic;
};

static void open_cells(int dim, struct cells *s)
{
  grid_create(dim, (const double[]){0, 0, 0}, (const int[]){N, N, N}, 1, (const bool[]){false, false, false}, &s->grid);
  must(NEW(&s->pore, s->grid.size));
  must(NEW(&s->fill, s->grid.size));
  must(plic_create(&s->grid, s->pore, &s->plic));
  struct box all = grid_all(&s->grid), cells = grid_cells(&s->grid);
  FOR_BOX_SERIAL(&s->grid, all, c) s->fill[c] = NAN; /* closed cells are not looked at */
  FOR_BOX_SERIAL(&s->grid, cells, c) s->pore[c] = 0.4;
}

static void close_cells(struct cells *s)
{
  plic_destroy(&s->plic);
  memory_free(&s->pore);
  memory_free(&s->fill);
}

/* fill of the open cells below a plane; offset from the middle of the grid */
static void put_plane(struct cells *s, const double normal[3], double offset)
{
  const struct grid *g = &s->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX_SERIAL(g, cells, c)
  {
    double x[3], d = offset;
    grid_centre(g, c, x);
    for (int a = 0; a < g->dim; a++) d -= normal[a] * (x[a] - 0.5 * N);
    s->fill[c] = s->pore[c] > 0 ? plic_volume(normal, d) : NAN;
  }
}

/* largest difference of a component of the normals in cells with a surface, `margin` cells from the sides */
static double miss(struct cells *s, const double normal[3], int margin)
{
  const struct grid *g = &s->grid;
  struct box         cells = grid_cells(g);
  double             worst = 0;
  for (int d = 0; d < g->dim; d++) {
    cells.lo[d] += margin;
    cells.hi[d] -= margin;
  }
  FOR_BOX_SERIAL(g, cells, c)
  {
    struct plane p;
    if (!(s->pore[c] > 0) || !plic_mixed(s->fill[c])) continue;
    plic_reconstruct(&s->plic, s->fill, c, &p);
    for (int d = 0; d < 3; d++) worst = fmax(worst, isnan(p.normal[d]) ? INFINITY : fabs(p.normal[d] - normal[d]));
    ck_assert_double_eq_tol(plic_volume(p.normal, p.offset), s->fill[c], 1e-15);
  }
  return worst;
}

/* a direction whose components are at most `slope` times the one along the axis; axis < 0: along any */
static void direction(int dim, int axis, double slope, unsigned short state[3], double normal[3])
{
  int a = axis < 0 ? (int)(dim * erand48(state)) : axis;
  for (int d = 0; d < 3; d++) normal[d] = d < dim ? slope * (2 * erand48(state) - 1) : 0;
  normal[a] = erand48(state) < 0.5 ? -1 : 1;
  plic_normalise(normal);
}

START_TEST(every_line_comes_back)
{
  unsigned short state[3] = {1, 2, 3};
  struct cells   s;
  double         normal[3], worst = 0;
  open_cells(2, &s);
  for (int i = 0; i < 2000; i++) {
    direction(2, -1, 1, state, normal);
    put_plane(&s, normal, erand48(state) - 0.5);
    worst = fmax(worst, miss(&s, normal, 1));
  }
  ck_assert_double_lt(worst, 1e-13);
  close_cells(&s);
}
END_TEST

/* Cells at x < 3 are closed over a height. 0: none; all: the surface meets a wall; 3: it lies in the lowest cells above
 * an obstacle, or liquid hangs there, and runs on beside it. */
START_TEST(gentle_planes_come_back_beside_walls_and_obstacles)
{
  static const int    height[] = {0, N, 3};
  static const double slope[] = {0.25, 0.25, 0.05};
  int                 dim = _i / 3 + 2, kind = _i % 3;
  unsigned short      state[3] = {4, 5, 6};
  struct cells        s;
  double              normal[3], worst = 0;
  open_cells(dim, &s);
  struct box block = grid_cells(&s.grid);
  block.hi[0] = 3;
  block.hi[1] = height[kind];
  FOR_BOX_SERIAL(&s.grid, block, c) s.pore[c] = 0;
  for (int i = 0; i < 500; i++) {
    direction(dim, kind ? 1 : -1, slope[kind], state, normal);
    put_plane(&s, normal, (kind == 2 ? 0.2 : 1) * (erand48(state) - 0.5));
    worst = fmax(worst, miss(&s, normal, 0));
  }
  ck_assert_double_lt(worst, 1e-13);
  close_cells(&s);
}
END_TEST

/* in 3D exact where the columns are complete, near it elsewhere */
START_TEST(planes_in_space)
{
  unsigned short state[3] = {7, 8, 9};
  struct cells   s;
  double         normal[3], gentle = 0, any = 0;
  open_cells(3, &s);
  for (int i = 0; i < 300; i++) {
    direction(3, -1, 0.3, state, normal);
    put_plane(&s, normal, erand48(state) - 0.5);
    gentle = fmax(gentle, miss(&s, normal, 1));
    direction(3, -1, 1, state, normal);
    put_plane(&s, normal, erand48(state) - 0.5);
    any = fmax(any, miss(&s, normal, 1));
  }
  printf("planes in space: components off by at most %.1e\n", any);
  ck_assert_double_lt(gentle, 1e-13);
  ck_assert_double_lt(any, 0.01);
  close_cells(&s);
}
END_TEST

/* fill that nothing says a direction of still gives a plane with that fill */
START_TEST(lonely_cells_get_some_plane)
{
  int          dim = _i;
  struct cells s;
  struct plane p;
  const double up[3] = {0, 1, 0};
  open_cells(dim, &s);
  put_plane(&s, up, -N);
  long c = grid_at(&s.grid, 3, 3, dim == 3 ? 3 : 0);
  s.fill[c] = 0.3;
  plic_reconstruct(&s.plic, s.fill, c, &p);
  ck_assert_double_eq_tol(plic_volume(p.normal, p.offset), 0.3, 1e-15);
  for (int d = 0; d < dim; d++) s.pore[c + s.grid.stride[d]] = s.pore[c - s.grid.stride[d]] = 0;
  plic_reconstruct(&s.plic, s.fill, c, &p);
  ck_assert_double_eq_tol(plic_volume(p.normal, p.offset), 0.3, 1e-15);
  close_cells(&s);
}
END_TEST

/* fill of the mirrored, and in 2D of the turned cells: the normal is mirrored, turned, to the last bit */
START_TEST(symmetric_to_the_last_bit)
{
  int            dim = _i;
  unsigned short state[3] = {3, 1, 4};
  struct cells   s, t;
  open_cells(dim, &s);
  open_cells(dim, &t);
  int  middle = dim == 3 ? 3 : 0, n = dim == 3 ? 27 : 9;
  long c = grid_at(&s.grid, 3, 3, middle), *step = s.grid.stride;
  for (int i = 0; i < 3000; i++) {
    for (int turn = 0; turn < 16; turn++) {
      int            swap = turn >> 3, axis[3] = {swap, 1 - swap, 2};
      unsigned short same[3] = {state[0], state[1], state[2]};
      struct plane   p, q;
      if (swap && dim == 3) break;
      for (int j = 0; j < n; j++) {
        int    at[3] = {j % 3 - 1, j / 3 % 3 - 1, dim == 3 ? j / 9 - 1 : 0}, to[3];
        double f = 1.6 * erand48(same) - 0.3, open = erand48(same) > 0.05 || j == n / 2;
        if (j == n / 2) f = 0.1 + 0.5 * (f + 0.3);
        for (int d = 0; d < 3; d++) to[axis[d]] = turn >> d & 1 ? -at[d] : at[d];
        long from = c + at[0] * step[0] + at[1] * step[1] + at[2] * step[2];
        long into = c + to[0] * step[0] + to[1] * step[1] + to[2] * step[2];
        s.pore[from] = t.pore[into] = open;
        s.fill[from] = t.fill[into] = open > 0 ? fmin(1, fmax(0, f)) : NAN;
      }
      plic_reconstruct(&s.plic, s.fill, c, &p);
      plic_reconstruct(&t.plic, t.fill, c, &q);
      bool equal = p.offset == q.offset;
      for (int d = 0; d < dim; d++) equal = equal && q.normal[axis[d]] == (turn >> d & 1 ? -1 : 1) * p.normal[d];
      ck_assert(equal);
      if (turn == 15 || (dim == 3 && turn == 7)) memcpy(state, same, sizeof same);
    }
  }
  close_cells(&s);
  close_cells(&t);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("plic_normal");
  TCase *tcase = tcase_create("plic_normal");
  tcase_add_test(tcase, every_line_comes_back);
  tcase_add_loop_test(tcase, gentle_planes_come_back_beside_walls_and_obstacles, 0, 6);
  tcase_add_test(tcase, planes_in_space);
  tcase_add_loop_test(tcase, lonely_cells_get_some_plane, 2, 4);
  tcase_add_loop_test(tcase, symmetric_to_the_last_bit, 2, 4);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
