/* Walls on nodal fields: folding and ghosts are adjoint, rooms add up to the domain, velocities obey the sides. */
#include "mpm/mpm.h"

#include "tests/scene_run.h"

enum { TURNS = 4 };
static int                   n[3] = {9, 7, 6};
static const double          low[3] = {-0.2, 0, 1};
static const enum basis      bases[] = {BASIS_LINEAR, BASIS_GIMP, BASIS_QUADRATIC, BASIS_CUBIC};
static int                   per_axis = 2; /* points per cell and axis */
static struct kernel_grid    kg;
static const struct kernels *kernels;

static double next_random(unsigned *seed)
{
  *seed = *seed * 1664525u + 1013904223u;
  return *seed / 4294967296.0;
}

static void create(int dim, enum basis basis, int wall_basis, const struct side_condition *sides)
{
  const struct numerics numerics = {.wall_basis = wall_basis, .points_per_axis = {per_axis, per_axis, per_axis}};
  bool                  periodic[3];
  struct grid           g;
  for (int d = 0; d < 3; d++) periodic[d] = sides[2 * d].kind == SIDE_PERIODIC;
  grid_create(dim, low, n, 0.1, periodic, &g);
  kernel_grid_create(&g, &numerics, sides, &kg);
  kernels = kernels_find(dim, basis);
}

/* all kinds of walls once: slip, no-slip, symmetry, periodic; the last turns have periodic axes of one and two cells */
static void choose_sides(int turn, struct side_condition *sides)
{
  static const int kinds[][SIDES] = {
      {SIDE_SLIP, SIDE_NO_SLIP, SIDE_SYMMETRY, SIDE_SLIP, SIDE_NO_SLIP, SIDE_NO_SLIP},
      {SIDE_PERIODIC, SIDE_PERIODIC, SIDE_SLIP, SIDE_NO_SLIP, SIDE_SLIP, SIDE_SYMMETRY},
      {SIDE_PERIODIC, SIDE_PERIODIC, SIDE_PERIODIC, SIDE_PERIODIC, SIDE_PERIODIC, SIDE_PERIODIC},
      {SIDE_PERIODIC, SIDE_PERIODIC, SIDE_PERIODIC, SIDE_PERIODIC, SIDE_NO_SLIP, SIDE_SLIP},
  };
  n[0] = turn == 3 ? 1 : 9;
  n[1] = turn == 3 ? 2 : 7;
  for (int s = 0; s < SIDES; s++) sides[s] = (struct side_condition){.kind = kinds[turn][s]};
}

/* what points can reach: the nodes and the first ghosts, two where points may have left a periodic axis */
static struct box reach(void)
{
  struct box b = grid_nodes(&kg.g);
  for (int d = 0; d < kg.g.dim; d++) {
    b.lo[d] = kg.g.periodic[d] ? -2 : -1;
    b.hi[d] = kg.g.n[d] + (kg.g.periodic[d] ? 3 : 2);
  }
  return b;
}

/* sum over nodes of q u, q as gathered from points and u seen through ghosts, is that of q folded and u on owned nodes:
 * what points give the nodes and take from them is the same work */
START_TEST(fold_and_ghosts_are_adjoint)
{
  for (int dim = 2; dim <= 3; dim++)
    for (int m = 1; m <= dim; m += dim - 1) {
      struct side_condition sides[SIDES];
      double               *q, *u, before = 0, after = 0;
      unsigned              seed = 9;
      choose_sides(_i, sides);
      create(dim, BASIS_CUBIC, WALL_MIRRORED, sides);
      struct box all = reach(), owned = grid_nodes(&kg.g);
      must(NEW(&q, m * kg.g.size));
      must(NEW(&u, m * kg.g.size));
      FOR_BOX_SERIAL(&kg.g, all, c) for (int i = 0; i < m; i++) q[c * m + i] = next_random(&seed) - 0.5;
      FOR_BOX_SERIAL(&kg.g, owned, c) for (int i = 0; i < m; i++) u[c * m + i] = next_random(&seed) - 0.5;
      boundary_ghosts(&kg, sides, m, 0, u);
      FOR_BOX_SERIAL(&kg.g, all, c) for (int i = 0; i < m; i++) before += q[c * m + i] * u[c * m + i];
      boundary_fold(&kg, sides, m, q);
      FOR_BOX_SERIAL(&kg.g, owned, c) for (int i = 0; i < m; i++) after += q[c * m + i] * u[c * m + i];
      ck_assert_double_eq_tol(before, after, 1e-12);
      ck_assert_double_gt(fabs(before), 1e-3);
      memory_free(&q);
      memory_free(&u);
    }
}
END_TEST

/* sums of scalars are kept */
START_TEST(fold_keeps_sums)
{
  struct side_condition sides[SIDES];
  double               *q, before = 0, after = 0;
  unsigned              seed = 1;
  choose_sides(_i, sides);
  create(3, BASIS_CUBIC, WALL_MIRRORED, sides);
  struct box all = reach(), owned = grid_nodes(&kg.g);
  must(NEW(&q, kg.g.size));
  FOR_BOX_SERIAL(&kg.g, all, c) before += q[c] = next_random(&seed);
  boundary_fold(&kg, sides, 1, q);
  FOR_BOX_SERIAL(&kg.g, owned, c) after += q[c];
  ck_assert_double_eq_tol(after, before, 1e-11);
  memory_free(&q);
}
END_TEST

/* weights summed over the lattice of points that fills the domain */
static void fill_lattice(double *field)
{
  const struct grid *g = &kg.g;
  double             volume = pow(g->h / per_axis, g->dim);
  long               m[3] = {per_axis * g->n[0], per_axis * g->n[1], g->dim == 3 ? per_axis * g->n[2] : 1};
  for (long i = 0; i < m[0] * m[1] * m[2]; i++) {
    long   node[MAX_SUPPORT], at[3] = {i % m[0], i / m[0] % m[1], i / m[0] / m[1]};
    double w[MAX_SUPPORT], x[3];
    for (int d = 0; d < 3; d++) x[d] = g->min[d] + g->h * ((double)at[d] + 0.5) / per_axis;
    kernels->weights(&kg, x, node, w, NULL);
    for (int q = 0; q < kernels->n_support; q++) field[node[q]] += w[q] * volume;
  }
}

static void check_room(int dim, enum basis basis, int wall_basis, const struct side_condition *sides)
{
  double *field, sum = 0;
  create(dim, basis, wall_basis, sides);
  must(NEW(&field, kg.g.size));
  fill_lattice(field);
  boundary_fold(&kg, sides, 1, field);
  struct box owned = grid_nodes(&kg.g);
  double     worst = 0;
  FOR_BOX_SERIAL(&kg.g, owned, c)
  {
    double room = boundary_room(&kg, basis, c);
    worst = fmax(worst, fabs(room - field[c]));
    sum += room;
  }
  ck_assert_double_lt(worst, 1e-15);
  double domain = 1;
  for (int d = 0; d < dim; d++) domain *= kg.g.h * kg.g.n[d];
  ck_assert_double_eq_tol(sum, domain, 1e-13);
  memory_free(&field);
}

START_TEST(rooms_are_sums_of_weights)
{
  for (int dim = 2; dim <= 3; dim++)
    for (int wall_basis = WALL_MIRRORED; wall_basis <= WALL_MODIFIED; wall_basis++)
      for (int turn = 0; turn < TURNS; turn++)
        for (per_axis = 1; per_axis <= 3; per_axis++) {
          struct side_condition sides[SIDES];
          choose_sides(turn, sides);
          check_room(dim, bases[_i], wall_basis, sides);
        }
}
END_TEST

/* an open side: its ghosts are advanced too and share the volume */
START_TEST(rooms_at_open_sides)
{
  struct side_condition sides[SIDES] = {{.kind = SIDE_OPEN}};
  double               *field;
  create(2, bases[_i], WALL_MIRRORED, sides);
  must(NEW(&field, kg.g.size));
  fill_lattice(field);
  boundary_fold(&kg, sides, 1, field);
  struct box nodes = boundary_nodes(&kg.g, sides);
  double     sum = 0, reached = 0;
  FOR_BOX_SERIAL(&kg.g, nodes, c) reached += field[c];
  for (long c = 0; c < kg.g.size; c++) sum += field[c];
  ck_assert_double_eq_tol(reached, 0.01 * n[0] * n[1], 1e-13);
  ck_assert_double_eq_tol(sum, reached, 1e-13);
  memory_free(&field);
}
END_TEST

/* a linear field keeps its value and gradient where ghosts continue it: mirrored for what is even or odd there */
START_TEST(velocities_obey_the_sides)
{
  struct side_condition sides[SIDES];
  double               *v;
  choose_sides(0, sides);
  sides[X_MAX].kind = SIDE_VELOCITY;
  must(function_parse("2*t + y", &sides[X_MAX].velocity[0]));
  sides[X_MAX].velocity[1].constant = -1;
  create(2, BASIS_QUADRATIC, WALL_MIRRORED, sides);
  must(NEW(&v, 2 * kg.g.size));
  for (long q = 0; q < 2 * kg.g.size; q++) v[q] = 7;
  boundary_velocity(&kg.g, sides, 0.5, v);
  const double *left = v + 2 * grid_at(&kg.g, 0, 3, 0), *right = v + 2 * grid_at(&kg.g, n[0], 3, 0),
               *inside = v + 2 * grid_at(&kg.g, 4, 3, 0), *bottom = v + 2 * grid_at(&kg.g, 4, 0, 0);
  ck_assert_double_eq(left[0], 0); /* slip */
  ck_assert_double_eq(left[1], 7);
  ck_assert_double_eq_tol(right[0], 1 + 0.3, 1e-15); /* prescribed */
  ck_assert_double_eq(right[1], -1);
  ck_assert_double_eq(inside[0], 7);
  ck_assert_double_eq(bottom[0], 7); /* symmetry */
  ck_assert_double_eq(bottom[1], 0);
  boundary_ghosts(&kg, sides, 2, 0.5, v);
  const double *beyond = v + 2 * grid_at(&kg.g, n[0] + 1, 3, 0), *before = v + 2 * grid_at(&kg.g, n[0] - 1, 3, 0);
  for (int d = 0; d < 2; d++) ck_assert_double_eq_tol(0.5 * (beyond[d] + before[d]), right[d], 1e-14);
  function_destroy(&sides[X_MAX].velocity[0]);
  memory_free(&v);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("boundary");
  TCase *tcase = tcase_create("walls");
  tcase_add_loop_test(tcase, fold_and_ghosts_are_adjoint, 0, TURNS);
  tcase_add_loop_test(tcase, fold_keeps_sums, 0, TURNS);
  tcase_add_loop_test(tcase, rooms_are_sums_of_weights, 0, 4);
  tcase_add_loop_test(tcase, rooms_at_open_sides, 0, 4);
  tcase_add_test(tcase, velocities_obey_the_sides);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
