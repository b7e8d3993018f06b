/* The pressure systems: hypre and CHOLMOD against known solutions and each other; the residual that is reported. */
#include "core/linear.h"

#include "tests/scene_run.h"

struct system {
  struct grid    g;
  double        *diagonal, *coupling, *active, *b, *x, *exact;
  bool           singular;
  double         scale; /* largest |b| */
  struct linear *linear;
};

struct kind {
  int    dim, n[3];
  bool   periodic[3];
  double storage, jump; /* added to the diagonal; ratio of conductivities */
  bool   holes, open;   /* cells without a pressure; pressure given beyond x_max */
};

/* dead: above a slope, and one cell in the middle */
static bool is_active(const struct kind *kind, const int place[3])
{
  bool lonely = place[0] == kind->n[0] / 2 && place[1] == kind->n[1] / 3;
  return !kind->holes || (!lonely && 2 * place[1] < kind->n[1] + place[0]);
}

/* patches of 3 cells with 1 or jump, by turns; they cross the borders of coarser grids */
static double conductivity(const struct kind *kind, const struct grid *g, long c)
{
  int place[3];
  grid_place(g, c, place);
  return (place[0] / 3 + place[1] / 3 + place[2] / 3) % 2 ? kind->jump : 1;
}

static long lower(const struct grid *g, long c, int d)
{
  int place[3];
  grid_place(g, c, place);
  if (place[d] > 0) return c - g->stride[d];
  return g->periodic[d] ? c + (g->n[d] - 1) * g->stride[d] : -1;
}

static long upper(const struct grid *g, long c, int d)
{
  int place[3];
  grid_place(g, c, place);
  if (place[d] < g->n[d] - 1) return c + g->stride[d];
  return g->periodic[d] ? c - (g->n[d] - 1) * g->stride[d] : -1;
}

/* one coupling for every pair of active neighbours: harmonic mean */
static void fill_couplings(const struct kind *kind, struct system *s)
{
  const struct grid *g = &s->g;
  struct box         cells = grid_cells(g);
  for (int d = 0; d < g->dim; d++) FOR_BOX_SERIAL(g, cells, c)
    {
      long low = lower(g, c, d);
      if (low < 0 || s->active[c] == 0 || s->active[low] == 0) continue;
      double k = -2 / (1 / conductivity(kind, g, c) + 1 / conductivity(kind, g, low));
      s->coupling[d * g->size + c] = k;
      s->diagonal[c] -= k;
      s->diagonal[low] -= k;
    }
}

static void multiply(const struct system *s, const double *x, double *b)
{
  const struct grid *g = &s->g;
  struct box         cells = grid_cells(g);
  FOR_BOX_SERIAL(g, cells, c)
  {
    b[c] = s->diagonal[c] * x[c];
    for (int d = 0; d < g->dim; d++) {
      long low = lower(g, c, d), up = upper(g, c, d);
      if (low >= 0) b[c] += s->coupling[d * g->size + c] * x[low];
      if (up >= 0) b[c] += s->coupling[d * g->size + up] * x[up];
    }
  }
}

static void fill_cells(const struct kind *kind, struct system *s)
{
  struct box cells = grid_cells(&s->g);
  FOR_BOX_SERIAL(&s->g, cells, c)
  {
    int place[3];
    grid_place(&s->g, c, place);
    s->active[c] = is_active(kind, place);
    s->diagonal[c] = s->active[c] != 0 ? kind->storage + (kind->open && place[0] == s->g.n[0] - 1) : 1;
  }
}

/* smooth, with mean zero over active cells */
static void fill_exact(struct system *s)
{
  struct box cells = grid_cells(&s->g);
  double     mean = 0, n = 0;
  FOR_BOX_SERIAL(&s->g, cells, c)
  {
    double x[3];
    grid_centre(&s->g, c, x);
    s->exact[c] = s->active[c] * (sin(2 * x[0] + 1) + x[1] * x[1] - x[2]);
    mean += s->exact[c];
    n += s->active[c];
  }
  FOR_BOX_SERIAL(&s->g, cells, c) s->exact[c] -= s->active[c] * mean / n;
}

static void create(const struct kind *kind, enum linear_method method, struct system *s)
{
  const double min[3] = {0, 0, 0};
  *s = (struct system){.singular = kind->storage == 0 && !kind->open};
  grid_create(kind->dim, min, kind->n, 0.1, kind->periodic, &s->g);
  double **fields[] = {&s->diagonal, &s->active, &s->b, &s->x, &s->exact};
  for (int i = 0; i < 5; i++) must(NEW(fields[i], s->g.size));
  must(NEW(&s->coupling, kind->dim * s->g.size));
  fill_cells(kind, s);
  fill_couplings(kind, s);
  fill_exact(s);
  multiply(s, s->exact, s->b);
  for (long c = 0; c < s->g.size; c++) s->scale = fmax(s->scale, fabs(s->b[c]));
  for (long c = 0; c < s->g.size; c++) s->x[c] = NAN; /* what a solve must not look at */
  must(linear_create(&s->g, method, &s->linear));
}

static void destroy(struct system *s)
{
  linear_destroy(&s->linear);
  ck_assert_ptr_null(s->linear);
  double **fields[] = {&s->diagonal, &s->active, &s->b, &s->x, &s->exact, &s->coupling};
  for (int i = 0; i < 6; i++) memory_free(fields[i]);
}

static struct linear_report solve(struct system *s, double tolerance)
{
  struct linear_report report;
  linear_set_matrix(s->linear, s->diagonal, s->coupling, s->singular, s->active);
  must(linear_solve(s->linear, tolerance, s->b, s->x, &report));
  return report;
}

/* largest |b - A x|, by the test's own product */
static double true_residual(const struct system *s)
{
  struct box cells = grid_cells(&s->g);
  double    *product, most = 0;
  must(NEW(&product, s->g.size));
  multiply(s, s->x, product);
  FOR_BOX_SERIAL(&s->g, cells, c) most = fmax(most, fabs(s->b[c] - product[c]));
  memory_free(&product);
  return most;
}

static double error(const struct system *s)
{
  struct box cells = grid_cells(&s->g);
  double     most = 0, size = 0;
  FOR_BOX_SERIAL(&s->g, cells, c)
  {
    most = fmax(most, fabs(s->x[c] - s->exact[c]));
    size = fmax(size, fabs(s->exact[c]));
  }
  return most / size;
}

static const struct kind kinds[] = {
    {2, {20, 30, 1}, {false, false, false}, 0, 1000, false, true},
    {2, {33, 17, 1}, {false, false, false}, 0.01, 1000, true, false},
    {2, {1, 54, 1}, {false, false, false}, 1e-3, 1, false, false},
    {2, {16, 2, 1}, {true, true, false}, 0.01, 1000, false, false},
    {2, {2, 2, 1}, {true, true, false}, 0.5, 1, false, false},
    {2, {24, 20, 1}, {true, false, false}, 0, 1000, false, false},
    {2, {2, 15, 1}, {true, false, false}, 0, 1000, false, false},
    {2, {24, 20, 1}, {false, false, false}, 0, 1, true, false},
    {3, {9, 8, 10}, {false, false, false}, 0, 1000, true, true},
    {3, {8, 2, 6}, {true, true, false}, 0.01, 1000, false, false},
    {3, {7, 8, 9}, {false, false, false}, 0, 1000, false, false},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

/* both find the solution the right-hand side was made from, and say truly how well */
static void finds(const struct kind *kind, enum linear_method method)
{
  struct system s;
  create(kind, method, &s);
  struct linear_report report = solve(&s, 1e-12 * s.scale);
  ck_assert(!report.fell_back);
  ck_assert_double_le(report.rms, 1e-12 * s.scale);
  ck_assert_double_le(report.residual, 1e-11 * s.scale);
  ck_assert_double_eq_tol(report.residual, true_residual(&s), 1e-14 * s.scale);
  ck_assert_double_lt(error(&s), 1e-8);
  if (method == LINEAR_DIRECT) ck_assert_int_eq(report.iterations, 0);
  destroy(&s);
}

START_TEST(hypre_finds_the_solution) { finds(&kinds[_i], LINEAR_HYPRE); }
END_TEST
START_TEST(direct_finds_the_solution) { finds(&kinds[_i], LINEAR_DIRECT); }
END_TEST

/* a cell without a pressure keeps zero, the mean over the others is zero where the system is singular */
START_TEST(dead_cells_stay_zero)
{
  for (int method = LINEAR_HYPRE; method <= LINEAR_DIRECT; method++) {
    struct system s;
    create(&kinds[7], method, &s);
    struct box cells = grid_cells(&s.g);
    double     mean = 0;
    solve(&s, 1e-12 * s.scale);
    FOR_BOX_SERIAL(&s.g, cells, c)
    {
      if (s.active[c] == 0) ck_assert_double_eq_tol(s.x[c], 0, 1e-14);
      mean += s.x[c];
    }
    ck_assert_double_eq_tol(mean, 0, 1e-11);
    destroy(&s);
  }
}
END_TEST

/* what no solution can take up is taken out of the right-hand side */
START_TEST(singular_projects)
{
  for (int method = LINEAR_HYPRE; method <= LINEAR_DIRECT; method++) {
    struct system s;
    create(&kinds[5], method, &s);
    struct box cells = grid_cells(&s.g);
    FOR_BOX_SERIAL(&s.g, cells, c) s.b[c] += 5;
    struct linear_report report = solve(&s, 1e-12 * s.scale);
    ck_assert_double_le(report.residual, 1e-11 * s.scale);
    ck_assert_double_lt(error(&s), 1e-8);
    destroy(&s);
  }
}
END_TEST

/* one object, several matrices, several right-hand sides of each; a coupling that became zero leaves no trace */
START_TEST(matrices_replace_each_other)
{
  for (int method = LINEAR_HYPRE; method <= LINEAR_DIRECT; method++) {
    struct system first, second;
    struct kind   other = kinds[1];
    other.holes = false;
    create(&other, method, &first);
    create(&kinds[1], method, &second);
    solve(&first, 1e-12 * first.scale);
    struct linear *own = second.linear;
    second.linear = first.linear;
    solve(&second, 1e-12 * second.scale);
    ck_assert_double_lt(error(&second), 1e-8);
    for (long c = 0; c < second.g.size; c++) {
      second.b[c] *= -2;
      second.exact[c] *= -2;
    }
    struct linear_report report;
    must(linear_solve(second.linear, 1e-12 * second.scale, second.b, second.x, &report));
    ck_assert_double_lt(error(&second), 1e-8);
    second.linear = own;
    destroy(&first);
    destroy(&second);
  }
}
END_TEST

/* what lies below the tolerance is not thrown away where it costs nothing to keep: steps add up */
START_TEST(direct_solves_small_ones_too)
{
  struct system s;
  create(&kinds[0], LINEAR_DIRECT, &s);
  solve(&s, 2 * s.scale);
  ck_assert_double_lt(error(&s), 1e-8);
  destroy(&s);
}
END_TEST

START_TEST(nothing_to_do)
{
  for (int method = LINEAR_HYPRE; method <= LINEAR_DIRECT; method++) {
    struct system s;
    create(&kinds[0], method, &s);
    for (long c = 0; c < s.g.size; c++) {
      s.b[c] = 0;
      s.x[c] = 7;
    }
    struct linear_report report = solve(&s, 0);
    ck_assert_int_eq(report.iterations, 0);
    ck_assert_double_eq(report.residual, 0);
    ck_assert_double_eq(s.x[grid_at(&s.g, 3, 4, 0)], 0);
    destroy(&s);
  }
}
END_TEST

/* a tolerance below round-off: the direct solver takes over and what is left is told */
START_TEST(hypre_falls_back)
{
  struct system s;
  create(&kinds[0], LINEAR_HYPRE, &s);
  struct linear_report report = solve(&s, 1e-25 * s.scale);
  ck_assert(report.fell_back);
  ck_assert_double_gt(report.residual, 1e-25 * s.scale);
  ck_assert_double_eq_tol(report.residual, true_residual(&s), 1e-14 * s.scale);
  ck_assert_double_lt(error(&s), 1e-10);
  destroy(&s);
}
END_TEST

START_TEST(what_cannot_be_solved_is_an_error)
{
  struct system        s;
  struct linear_report report;
  create(&kinds[0], LINEAR_DIRECT, &s);
  long c = grid_at(&s.g, 4, 4, 0);
  linear_set_matrix(s.linear, s.diagonal, s.coupling, false, s.active);
  s.b[c] = NAN;
  ck_assert_int_eq(linear_solve(s.linear, 1e-12, s.b, s.x, &report), ERR_DIVERGED);
  s.b[c] = 1;
  s.diagonal[c] = -s.diagonal[c];
  linear_set_matrix(s.linear, s.diagonal, s.coupling, false, s.active);
  ck_assert_int_eq(linear_solve(s.linear, 1e-12 * s.scale, s.b, s.x, &report), ERR_SOLVER);
  destroy(&s);
}
END_TEST

START_TEST(solves_allocate_nothing)
{
  for (int method = LINEAR_HYPRE; method <= LINEAR_DIRECT; method++) {
    struct system s;
    create(&kinds[0], method, &s);
    long before = memory_calls();
    solve(&s, 1e-10 * s.scale);
    ck_assert_int_eq(memory_calls(), before);
    destroy(&s);
  }
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("linear");
  TCase *tcase = tcase_create("solvers");
  tcase_add_loop_test(tcase, hypre_finds_the_solution, 0, KINDS);
  tcase_add_loop_test(tcase, direct_finds_the_solution, 0, KINDS);
  tcase_add_test(tcase, dead_cells_stay_zero);
  tcase_add_test(tcase, singular_projects);
  tcase_add_test(tcase, matrices_replace_each_other);
  tcase_add_test(tcase, direct_solves_small_ones_too);
  tcase_add_test(tcase, nothing_to_do);
  tcase_add_test(tcase, hypre_falls_back);
  tcase_add_test(tcase, what_cannot_be_solved_is_an_error);
  tcase_add_test(tcase, solves_allocate_nothing);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
