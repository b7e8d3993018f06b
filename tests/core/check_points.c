/* Order of points: a sort keeps every point with its group and arrays; blocks of one colour never share a node. */
#include "core/points.h"

#include "tests/scene_run.h"

enum { N = 3000, GROUPS = 3 };

struct cloud {
  struct grid    g;
  struct points *points;
  double        *x, *tag; /* [N][dim], [N]: number of the point at the start */
};

/* reproducible numbers in [0, 1) */
static double next_random(unsigned *seed)
{
  *seed = *seed * 1664525u + 1013904223u;
  return *seed / 4294967296.0;
}

static int group_of(double tag) { return (int)tag * 7 % GROUPS; }

static void create(int dim, struct cloud *c)
{
  const double min[3] = {-1, 0.5, 2};
  const int    n[3] = {21, 9, 7};
  const bool   periodic[3] = {false, false, false};
  unsigned     seed = 5;
  grid_create(dim, min, n, 0.1, periodic, &c->g);
  must(points_create(&c->g, N, GROUPS, 9, &c->points));
  must(NEW(&c->x, N * dim));
  must(NEW(&c->tag, N));
  for (long p = 0; p < N; p++) {
    c->tag[p] = (double)p;
    c->points->group[p] = (unsigned char)group_of(c->tag[p]);
    for (int d = 0; d < dim; d++) c->x[p * dim + d] = min[d] + n[d] * 0.1 * next_random(&seed);
  }
}

static void destroy(struct cloud *c)
{
  points_destroy(&c->points);
  ck_assert_ptr_null(c->points);
  memory_free(&c->x);
  memory_free(&c->tag);
}

static void sort(struct cloud *c)
{
  must(points_sort(&c->g, c->points, c->x));
  points_permute(c->points, c->g.dim, c->x);
  points_permute(c->points, 1, c->tag);
  points_sorted(c->points);
}

static int cell_of(const struct cloud *c, long p, int d)
{
  return (int)floor((c->x[p * c->g.dim + d] - c->g.min[d]) / c->g.h);
}

START_TEST(sort_keeps_every_point)
{
  for (int dim = 2; dim <= 3; dim++) {
    struct cloud c, old;
    bool         seen[N] = {false};
    create(dim, &c);
    create(dim, &old);
    sort(&c);
    for (long p = 0; p < N; p++) {
      long first = (long)c.tag[p];
      ck_assert(!seen[first]);
      seen[first] = true;
      ck_assert_mem_eq(c.x + p * dim, old.x + first * dim, (size_t)dim * sizeof *c.x);
      ck_assert_int_eq(c.points->group[p], group_of(c.tag[p]));
    }
    destroy(&c);
    destroy(&old);
  }
}
END_TEST

START_TEST(runs_hold_their_block_and_group)
{
  for (int dim = 2; dim <= 3; dim++) {
    struct cloud c;
    create(dim, &c);
    sort(&c);
    ck_assert_int_eq(c.points->start[0], 0);
    ck_assert_int_eq(c.points->start[c.points->n_runs], N);
    for (long run = 0; run < c.points->n_runs; run++) {
      int corner[3];
      points_block_corner(c.points, run / GROUPS, corner);
      for (long p = c.points->start[run]; p < c.points->start[run + 1]; p++) {
        ck_assert_int_eq(c.points->group[p], run % GROUPS);
        for (int d = 0; d < dim; d++) {
          int local = cell_of(&c, p, d) - corner[d];
          ck_assert(local >= 0 && local < c.points->block_edge);
        }
      }
    }
    ck_assert(!points_need_sort(&c.g, c.points, c.x));
    destroy(&c);
  }
}
END_TEST

/* a second sort of sorted points changes nothing */
START_TEST(sort_is_stable)
{
  struct cloud c;
  double       tag[N];
  create(2, &c);
  sort(&c);
  memcpy(tag, c.tag, sizeof tag);
  sort(&c);
  ck_assert_mem_eq(tag, c.tag, sizeof tag);
  destroy(&c);
}
END_TEST

START_TEST(a_sort_is_due_beyond_the_margin)
{
  struct cloud c;
  create(2, &c);
  sort(&c);
  long   p = c.points->start[GROUPS * 1]; /* first point of the second block, which begins at x = -0.2 */
  double own = c.x[2 * p];
  c.x[2 * p] = -0.2 - 0.99 * 0.1 * BLOCK_MARGIN;
  ck_assert(!points_need_sort(&c.g, c.points, c.x));
  c.x[2 * p] = -0.2 - 1.01 * 0.1 * BLOCK_MARGIN;
  ck_assert(points_need_sort(&c.g, c.points, c.x));
  c.x[2 * p] = NAN;
  ck_assert(points_need_sort(&c.g, c.points, c.x));
  c.x[2 * p] = own;
  ck_assert(!points_need_sort(&c.g, c.points, c.x));
  destroy(&c);
}
END_TEST

START_TEST(points_outside_diverge)
{
  const double outside[] = {-1.001, 1.101, NAN, INFINITY};
  for (size_t i = 0; i < sizeof outside / sizeof *outside; i++) {
    struct cloud c;
    create(2, &c);
    sort(&c);
    c.x[2 * 17] = outside[i];
    ck_assert(points_need_sort(&c.g, c.points, c.x));
    ck_assert_int_eq(points_sort(&c.g, c.points, c.x), ERR_DIVERGED);
    ck_assert_ptr_nonnull(strstr(status_message(), "left the grid"));
    destroy(&c);
  }
}
END_TEST

/* a point on the upper end of the grid belongs to the last cell */
START_TEST(the_end_of_the_grid_is_inside)
{
  struct cloud c;
  create(2, &c);
  c.x[0] = c.g.min[0] + c.g.n[0] * c.g.h;
  c.x[1] = c.g.min[1];
  must(points_sort(&c.g, c.points, c.x));
  destroy(&c);
}
END_TEST

START_TEST(every_block_has_one_colour)
{
  for (int dim = 2; dim <= 3; dim++) {
    struct cloud c;
    int          seen[512] = {0};
    create(dim, &c);
    ck_assert_int_lt(c.points->n_blocks, 512);
    for (int colour = 0; colour < points_colours(&c.g); colour++) {
      long i = 0, block;
      for (; (block = points_block_of_colour(c.points, dim, colour, i)) >= 0; i++) seen[block]++;
    }
    for (long b = 0; b < c.points->n_blocks; b++) ck_assert_int_eq(seen[b], 1);
    destroy(&c);
  }
}
END_TEST

/* nodes [first, last] along an axis that points of a block reach with the widest basis (two nodes below and above the
 * cell), wandered by the margin */
static void reach(const struct points *p, long block, int d, int *first, int *last)
{
  int corner[3];
  points_block_corner(p, block, corner);
  *first = corner[d] - BLOCK_MARGIN - 1;
  *last = corner[d] + p->block_edge - 1 + BLOCK_MARGIN + 2;
}

START_TEST(blocks_of_one_colour_share_no_node)
{
  for (int dim = 2; dim <= 3; dim++) {
    struct cloud c;
    long         a, b, pairs = 0;
    create(dim, &c);
    for (int colour = 0; colour < points_colours(&c.g); colour++)
      for (long i = 0; (a = points_block_of_colour(c.points, dim, colour, i)) >= 0; i++)
        for (long j = 0; j < i; j++) {
          bool apart = false;
          b = points_block_of_colour(c.points, dim, colour, j);
          for (int d = 0; d < dim; d++) {
            int first[2], last[2];
            reach(c.points, a, d, &first[0], &last[0]);
            reach(c.points, b, d, &first[1], &last[1]);
            apart = apart || last[0] < first[1] || last[1] < first[0];
          }
          ck_assert(apart);
          pairs++;
        }
    ck_assert_int_gt(pairs, 0);
    destroy(&c);
  }
}
END_TEST

struct holder {
  double *state, *scratch, *elsewhere, *absent;
};

/* only planned STATE arrays of the set itself follow the sort */
START_TEST(fields_follow_the_sort)
{
  const struct field fields[] = {
      {"a", AT_SOLID, 1, STATE, NULL, "-", "", offsetof(struct holder, state)},
      {"b", AT_SOLID, 1, SCRATCH, NULL, "-", "", offsetof(struct holder, scratch)},
      {"c", AT_NODE, 1, STATE, NULL, "-", "", offsetof(struct holder, elsewhere)},
      {"d", AT_SOLID, 1, STATE, NULL, "-", "", offsetof(struct holder, absent)},
  };
  struct cloud  c;
  struct holder h = {0};
  create(2, &c);
  double **each[] = {&h.state, &h.scratch, &h.elsewhere};
  for (int i = 0; i < 3; i++) {
    must(NEW(each[i], N));
    memcpy(*each[i], c.tag, N * sizeof(double));
  }
  double unsorted[N];
  memcpy(unsorted, c.tag, sizeof unsorted);
  must(points_sort(&c.g, c.points, c.x));
  points_permute_fields(c.points, &(struct scene){.dim = 2}, AT_SOLID, fields, 4, &h);
  points_permute(c.points, 1, c.tag);
  ck_assert_mem_eq(h.state, c.tag, sizeof unsorted);
  ck_assert_mem_eq(h.scratch, unsorted, sizeof unsorted);
  ck_assert_mem_eq(h.elsewhere, unsorted, sizeof unsorted);
  for (int i = 0; i < 3; i++) memory_free(each[i]);
  destroy(&c);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("points");
  TCase *tcase = tcase_create("order");
  tcase_add_test(tcase, sort_keeps_every_point);
  tcase_add_test(tcase, runs_hold_their_block_and_group);
  tcase_add_test(tcase, sort_is_stable);
  tcase_add_test(tcase, a_sort_is_due_beyond_the_margin);
  tcase_add_test(tcase, points_outside_diverge);
  tcase_add_test(tcase, the_end_of_the_grid_is_inside);
  tcase_add_test(tcase, every_block_has_one_colour);
  tcase_add_test(tcase, blocks_of_one_colour_share_no_node);
  tcase_add_test(tcase, fields_follow_the_sort);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
