/* Gauges: what they read of known fields, the file they write, and how they go on after a resume. */
#include "run/gauges.h"
#include "tests/run/fake.h"

#include "run/files.h"

#include <math.h>

static const struct shape everywhere = {.kind = SHAPE_EVERYWHERE, .dim = 2};
/* the four cells round x = 0, y = 0.2 */
static const struct shape four_cells = {.kind = SHAPE_BOX, .dim = 2, .min = {-0.1, 0.1, 0}, .max = {0.1, 0.3, 0}};
static const struct shape no_cell = {.kind = SHAPE_BALL, .dim = 2, .centre = {0, 0.2, 0}, .radius = 0.01};

static void ranges(const struct sim *sim, const char *name, long *first, long *end)
{
  (void)sim;
  *first = strcmp(name, "tip") == 0 ? 2 : 0;
  *end = strcmp(name, "top") == 0 ? 2 : strcmp(name, "tip") == 0 ? 3 : 0;
}

static struct gauge gauge_of(const char *name, enum gauge_kind kind, const char *of)
{
  struct gauge g = {.kind = (int)kind};
  snprintf(g.name, sizeof g.name, "%s", name);
  snprintf(g.of, sizeof g.of, "%s", of);
  return g;
}

static double series_end(const struct gauges *g, const char *name)
{
  long          n;
  const double *t, *v;
  fake_ok(gauges_series(g, name, &n, &t, &v));
  ck_assert_int_gt(n, 0);
  return v[n - 1];
}

/* One gauge, one sample. */
static double sample(struct fake_run *r, struct gauge *gauge)
{
  struct gauges *g;
  r->scene.n_gauges = 1;
  r->scene.gauges = gauge;
  fake_ok(gauges_create(&r->sim, r->folder, ranges, &g));
  fake_ok(gauges_sample(g, &r->sim));
  double v = series_end(g, gauge->name);
  gauges_destroy(&g);
  return v;
}

static double point(struct fake_run *r, const char *of, double x, double y)
{
  struct gauge g = gauge_of("g", GAUGE_POINT, of);
  g.x[0] = x;
  g.x[1] = y;
  return sample(r, &g);
}

#define NEAR(a, b, tolerance) ck_assert_double_eq_tol(a, b, tolerance)

START_TEST(points_among_cells)
{
  struct fake_run r;
  fake_create(2, &r);
  const double inside[3] = {0.07, 0.33, 0}, corner[3] = {-0.15, 0.15, 0}, middle[3] = {0.8, 0.33, 0};
  NEAR(point(&r, "P", inside[0], inside[1]), linear(inside), 1e-12);
  NEAR(point(&r, "P", -0.2, 0.1), linear(corner), 1e-12); /* constant beyond the last centre */
  NEAR(point(&r, "P", -9, -9), linear(corner), 1e-12);
  NEAR(point(&r, "P", INFINITY, 0.33), linear(middle), 1e-12);
  NEAR(point(&r, "vel_fluid_x", 0.07, 0.33), 0.07, 1e-14);
  NEAR(point(&r, "vel_fluid_y", 0.07, 0.33), 0.33, 1e-14);
  fake_destroy(&r);
}
END_TEST

START_TEST(points_in_3d)
{
  struct fake_run r;
  struct gauge    g = gauge_of("g", GAUGE_POINT, "P");
  const double    x[3] = {0.07, 0.33, 0.21};
  fake_create(3, &r);
  memcpy(g.x, x, sizeof x);
  NEAR(sample(&r, &g), linear(x), 1e-12);
  snprintf(g.of, sizeof g.of, "stress_yz");
  g.x[0] = 0.1; /* a node of the lattice of cells: neighbours lie evenly round it */
  g.x[1] = 0.2;
  g.x[2] = 0.2;
  NEAR(sample(&r, &g), 4 + linear(g.x), 1e-12);
  fake_destroy(&r);
}
END_TEST

START_TEST(points_among_points)
{
  struct fake_run r;
  fake_create(2, &r);
  const double even[3] = {0, 0.2, 0};
  NEAR(point(&r, "stress_xy", even[0], even[1]), 3 + linear(even), 1e-12);
  NEAR(point(&r, "vel_y", even[0], even[1]), 2 * linear(even), 1e-12);
  NEAR(point(&r, "water.P", 0.1, 0.4), linear((double[]){0.1, 0.4, 0}), 1e-12);
  ck_assert(isnan(point(&r, "stress_xy", 0, 0.58))); /* nothing within h */
  fake_destroy(&r);
}
END_TEST

/* Far blocks are passed over, which must hide no point, even of those that wandered since they were sorted: compare
 * with the mean over all of them. */
START_TEST(blocks_hide_no_point)
{
  struct fake_run r;
  fake_create(2, &r);
  const long n = r.sim.points[SET_SOLID]->n;
  ck_assert_int_gt(r.sim.points[SET_SOLID]->n_blocks, 2);
  for (long p = 0; p < n; p++) r.state.x_p[2 * p] += p % 3 == 0 ? 0.19 : -0.19;
  for (int q = 0; q < 200; q++) {
    double x[2] = {-0.2 + 1.8 * q / 200, 0.1 + 0.35 * ((7 * q) % 200) / 200}, sum = 0, weight = 0;
    for (long p = 0; p < n; p++) {
      double d = hypot(r.state.x_p[2 * p] - x[0], r.state.x_p[2 * p + 1] - x[1]), w = d < 0.1 ? 1 - d / 0.1 : 0;
      sum += w * r.state.vel_p[2 * p];
      weight += w;
    }
    NEAR(point(&r, "vel_x", x[0], x[1]), sum / weight, 1e-11);
  }
  fake_destroy(&r);
}
END_TEST

START_TEST(lines)
{
  struct fake_run r;
  struct gauges  *g;
  struct gauge    line = gauge_of("line", GAUGE_LINE, "P");
  fake_create(2, &r);
  line.x[0] = -0.1;
  line.x[1] = 0.2;
  line.to[0] = 0.3;
  line.to[1] = 0.5;
  line.n = 5;
  r.scene.n_gauges = 1;
  r.scene.gauges = &line;
  fake_ok(gauges_create(&r.sim, r.folder, ranges, &g));
  fake_ok(gauges_sample(g, &r.sim));
  for (int i = 0; i < 5; i++) {
    char         name[32];
    const double x[3] = {-0.1 + 0.1 * i, 0.2 + 0.075 * i, 0};
    snprintf(name, sizeof name, "line.%d", i);
    NEAR(series_end(g, name), linear(x), 1e-12);
  }
  ck_assert_str_eq(gauges_unit(g, "line.3"), "Pa");
  gauges_destroy(&g);
  fake_destroy(&r);
}
END_TEST

/* Liquid below y = 0.1 + depth(x), depth = 0.1 + 0.05 (x + 0.2): columns of cells; points that swell by x. Both show
 * the same depth along y and the same length along x. */
static double depth_at(double x) { return 0.1 + 0.05 * (x + 0.2); }

static void fill_to_depth(struct fake_run *r)
{
  const struct grid *g = &r->sim.grid;
  const struct box   cells = grid_cells(g);
  FOR_BOX_SERIAL(g, cells, c)
  {
    double x[3];
    grid_centre(g, c, x);
    r->state.alpha_cc[c] = fmin(1, fmax(0, (depth_at(x[0]) - (x[1] - 0.15)) / g->h));
  }
  for (long p = 0; p < r->sim.points[SET_WATER]->n; p++)
    r->state.volume_w[p] = grid_cell_volume(g) / 4 * depth_at(r->state.x_w[2 * p]) / 0.5;
}

static double level(struct fake_run *r, const char *of, double x, double y)
{
  struct gauge g = gauge_of("g", GAUGE_LEVEL, of);
  g.x[0] = x;
  g.x[1] = y;
  return sample(r, &g);
}

START_TEST(levels)
{
  struct fake_run r;
  double          cells = 0;
  fake_create(2, &r);
  fake_liquid(&r);
  fill_to_depth(&r);
  for (int i = 0; i < 20; i++) cells += 0.1 * fmin(1, fmax(0, depth_at(-0.15 + 0.1 * i) / 0.1 - 1));
  for (int points = 0; points < 2; points++) {
    if (points) memory_free(&r.state.alpha_cc);
    NEAR(level(&r, "y", 0.4, NAN), depth_at(0.4), 1e-12);
    NEAR(level(&r, "y", 0.47, NAN), depth_at(0.47), points ? 2e-4 : 1e-12);
    NEAR(level(&r, "y", -0.2, NAN), depth_at(-0.15), points ? 1e-3 : 1e-12); /* the last centre */
    NEAR(level(&r, "y", 9, NAN), depth_at(1.75), points ? 1e-3 : 1e-12);
    NEAR(level(&r, "x", NAN, 0.1), points ? 2 * depth_at(0.8) / 0.5 : 2, 1e-12);
    if (!points) NEAR(level(&r, "x", NAN, 0.25), cells, 1e-12);
  }
  fake_destroy(&r);
}
END_TEST

START_TEST(regions)
{
  struct fake_run r;
  struct gauge    g = gauge_of("g", GAUGE_MEAN, "P");
  const double    centre[3] = {0, 0.2, 0};
  fake_create(2, &r);
  g.region = four_cells;
  NEAR(sample(&r, &g), linear(centre), 1e-12);
  g.kind = GAUGE_INTEGRAL;
  NEAR(sample(&r, &g), 0.04 * linear(centre), 1e-13);
  snprintf(g.of, sizeof g.of, "stress_zz");
  NEAR(sample(&r, &g), 0.04 * (2 + linear(centre)), 1e-13);
  g.region = everywhere; /* 20 x 3 cells hold solid */
  NEAR(sample(&r, &g), 0.6 * (2 + linear((double[]){0.8, 0.25, 0})), 1e-12);
  g.kind = GAUGE_MEAN;
  NEAR(sample(&r, &g), 2 + linear((double[]){0.8, 0.25, 0}), 1e-12);
  snprintf(g.of, sizeof g.of, "water.P");
  NEAR(sample(&r, &g), linear((double[]){0.8, 0.35, 0}), 1e-12);
  fake_destroy(&r);
}
END_TEST

/* solid fills x -0.2 ... 1.8, y 0.1 ... 0.4 by points at a quarter of a cell */
START_TEST(extents)
{
  struct fake_run r;
  struct gauge    g = gauge_of("g", GAUGE_EXTENT, "x_max");
  fake_create(2, &r);
  g.region = everywhere;
  NEAR(sample(&r, &g), 1.775, 1e-12);
  snprintf(g.of, sizeof g.of, "y_max");
  NEAR(sample(&r, &g), 0.375, 1e-12);
  g.region = four_cells;
  NEAR(sample(&r, &g), 0.275, 1e-12);
  snprintf(g.of, sizeof g.of, "x_min");
  NEAR(sample(&r, &g), -0.075, 1e-12);
  snprintf(g.on, sizeof g.on, "water");
  g.region = everywhere;
  snprintf(g.of, sizeof g.of, "y_max");
  NEAR(sample(&r, &g), 0.575, 1e-12);
  fake_destroy(&r);
}
END_TEST

/* the right part is cut off and a grain flies above it; the larger part counts */
START_TEST(extent_of_what_hangs_together)
{
  struct fake_run r;
  struct gauge    g = gauge_of("g", GAUGE_EXTENT, "x_max");
  fake_create(2, &r);
  for (long p = 0; p < r.sim.points[SET_SOLID]->n; p++) {
    double *x = &r.state.x_p[2 * p];
    if (x[0] > 1 && x[0] < 1.1) x[0] -= 0.1;                 /* an empty column of cells */
    if (x[0] > 1.7 && x[1] > 0.35) x[0] = 1.75, x[1] = 0.55; /* with one empty cell below */
  }
  g.region = everywhere;
  NEAR(sample(&r, &g), 1.775, 1e-12);
  g.connected = true;
  NEAR(sample(&r, &g), 0.975, 1e-12);
  snprintf(g.of, sizeof g.of, "y_max");
  NEAR(sample(&r, &g), 0.375, 1e-12);
  g.connected = false;
  NEAR(sample(&r, &g), 0.55, 1e-12);
  fake_destroy(&r);
}
END_TEST

START_TEST(one_gauge_minus_another)
{
  struct fake_run r;
  struct gauge    two[2] = {gauge_of("b", GAUGE_POINT, "P"), gauge_of("a", GAUGE_POINT, "P")};
  struct gauges  *g;
  fake_create(2, &r);
  two[0].x[1] = two[1].x[1] = 0.3;
  two[0].x[0] = 0.5;
  snprintf(two[0].minus, sizeof two[0].minus, "a");
  r.scene.n_gauges = 2;
  r.scene.gauges = two;
  fake_ok(gauges_create(&r.sim, r.folder, ranges, &g));
  fake_ok(gauges_sample(g, &r.sim));
  NEAR(series_end(g, "b"), 5, 1e-12);
  NEAR(series_end(g, "a"), linear((double[]){0, 0.3, 0}), 1e-12);
  gauges_destroy(&g);
  fake_destroy(&r);
}
END_TEST

START_TEST(markers_and_ledger)
{
  struct fake_run r;
  struct gauge    top = gauge_of("settlement", GAUGE_LOAD, "displacement_y"),
               tip = gauge_of("tip_x", GAUGE_TRACER, "position_x"), e = gauge_of("e", GAUGE_INTEGRAL, "kinetic_solid");
  fake_create(2, &r);
  const double x0[6] = {0, 1, 0.5, 1, 3, 4}, x[6] = {0, 0.9, 0.5, 0.7, 3.5, 4};
  memcpy(r.state.x0_m, x0, sizeof x0);
  memcpy(r.state.x_m, x, sizeof x);
  snprintf(top.on, sizeof top.on, "top");
  snprintf(tip.on, sizeof tip.on, "tip");
  r.sim.ledger.v[LEDGER_kinetic_solid] = 42;
  NEAR(sample(&r, &top), -0.2, 1e-15);
  ck_assert_double_eq(sample(&r, &tip), 3.5);
  ck_assert_double_eq(sample(&r, &e), 42);
  snprintf(e.of, sizeof e.of, "released");
  r.sim.ledger_start.v[LEDGER_potential] = 5;
  r.sim.ledger.v[LEDGER_potential] = 2;
  ck_assert_double_eq(sample(&r, &e), 3);
  snprintf(e.of, sizeof e.of, "energy");
  ck_assert_double_eq(sample(&r, &e), 44);
  snprintf(e.of, sizeof e.of, "balance");
  r.sim.ledger.v[LEDGER_friction] = 100;
  r.sim.ledger.v[LEDGER_plastic] = 200;
  r.sim.ledger.v[LEDGER_work_walls] = 1000;
  r.sim.ledger.v[LEDGER_work_loads] = 2000;
  ck_assert_double_eq(sample(&r, &e), 344 - 3000);
  fake_destroy(&r);
}
END_TEST

/* Two gauges, among them the ledger, at 0.1 s steps from sim->t on. */
static struct gauges *start_two(struct fake_run *r, struct gauge two[2])
{
  struct gauges *g;
  two[0] = gauge_of("p", GAUGE_POINT, "P");
  two[1] = gauge_of("e", GAUGE_INTEGRAL, "kinetic_solid");
  r->scene.n_gauges = 2;
  r->scene.gauges = two;
  fake_ok(gauges_create(&r->sim, r->folder, ranges, &g));
  return g;
}

static void sample_at(struct fake_run *r, struct gauges *g, int from, int end)
{
  for (int i = from; i < end; i++) {
    r->sim.t = i * 0.1;
    r->sim.ledger.v[LEDGER_kinetic_solid] = i / 3.0;
    fake_ok(gauges_sample(g, &r->sim));
  }
}

static char *read_csv(const struct fake_run *r)
{
  char   path[LONGEST_PATH], *text;
  size_t n;
  fake_ok(files_path(r->folder, "gauges.csv", path));
  fake_ok(files_read(path, 1 << 20, &text, &n));
  return text;
}

START_TEST(file_and_resume)
{
  struct fake_run r;
  struct gauge    two[2];
  long            n;
  const double   *t, *v;
  fake_create(2, &r);
  struct gauges *g = start_two(&r, two);
  long           calls = memory_calls();
  sample_at(&r, g, 0, 10);
  sample_at(&r, g, 9, 10); /* the same time again is no new row */
  ck_assert_int_eq(memory_calls(), calls);
  fake_ok(gauges_flush(g));
  gauges_destroy(&g);
  char *whole = read_csv(&r);
  ck_assert_int_eq(strncmp(whole, "t [s],p [Pa],e [J]\n0,", 21), 0);

  g = start_two(&r, two);
  fake_ok(gauges_resume(g, 6 * 0.1));
  fake_ok(gauges_series(g, "e", &n, &t, &v));
  ck_assert_int_eq(n, 7);
  for (int i = 0; i < 7; i++) ck_assert(t[i] == i * 0.1 && v[i] == i / 3.0);
  sample_at(&r, g, 6, 10);
  fake_ok(gauges_flush(g));
  char *resumed = read_csv(&r);
  ck_assert_str_eq(whole, resumed);
  memory_free(&whole);
  memory_free(&resumed);
  gauges_destroy(&g);
  fake_destroy(&r);
}
END_TEST

START_TEST(more_samples_than_announced)
{
  struct fake_run r;
  struct gauge    two[2];
  long            n;
  const double   *t, *v;
  fake_create(2, &r);
  struct gauges *g = start_two(&r, two);
  sample_at(&r, g, 0, 500);
  fake_ok(gauges_series(g, "e", &n, &t, &v));
  ck_assert_int_eq(n, 500);
  for (int i = 0; i < 500; i++) ck_assert(t[i] == i * 0.1 && v[i] == i / 3.0);
  gauges_destroy(&g);
  fake_destroy(&r);
}
END_TEST

static void refused(struct fake_run *r, struct gauge gauge, const char *word)
{
  struct gauges *g;
  r->scene.n_gauges = 1;
  r->scene.gauges = &gauge;
  ck_assert_int_eq(gauges_create(&r->sim, r->folder, ranges, &g), ERR_INPUT);
  ck_assert_ptr_null(g);
  ck_assert_msg(strstr(status_message(), word) != NULL, "%s", status_message());
}

START_TEST(wrong_gauges)
{
  struct fake_run r;
  struct gauge    empty = gauge_of("g", GAUGE_MEAN, "P"), nobody = gauge_of("g", GAUGE_LOAD, "displacement_y");
  fake_create(2, &r);
  empty.region = no_cell;
  refused(&r, gauge_of("g", GAUGE_POINT, "pressure"), "cells.vel_fluid_y");
  refused(&r, gauge_of("g", GAUGE_POINT, "vel"), "gauges.g.of: \"vel\"");
  refused(&r, gauge_of("g", GAUGE_POINT, "vel_z"), "\"vel_z\"");
  refused(&r, gauge_of("g", GAUGE_POINT, "water.stress_xx"), "\"water.stress_xx\"");
  refused(&r, gauge_of("g", GAUGE_POINT, "absent"), "\"absent\"");
  refused(&r, empty, "gauges.g.region");
  refused(&r, nobody, "gauges.g.on");
  refused(&r, gauge_of("g", GAUGE_TRACER, "velocity_y"), "gauges.g.of");
  refused(&r, gauge_of("g", GAUGE_LEVEL, "q"), "no axis");
  refused(&r, gauge_of("g", GAUGE_INTEGRAL, "water.P"), "volume");
  refused(&r, gauge_of("g", GAUGE_LEVEL, "y"), "no liquid moves");
  fake_destroy(&r);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("gauges");
  TCase *tests = tcase_create("gauges");
  tcase_add_test(tests, points_among_cells);
  tcase_add_test(tests, points_in_3d);
  tcase_add_test(tests, points_among_points);
  tcase_add_test(tests, blocks_hide_no_point);
  tcase_add_test(tests, lines);
  tcase_add_test(tests, levels);
  tcase_add_test(tests, regions);
  tcase_add_test(tests, extents);
  tcase_add_test(tests, extent_of_what_hangs_together);
  tcase_add_test(tests, one_gauge_minus_another);
  tcase_add_test(tests, markers_and_ledger);
  tcase_add_test(tests, file_and_resume);
  tcase_add_test(tests, more_samples_than_announced);
  tcase_add_test(tests, wrong_gauges);
  suite_add_tcase(suite, tests);
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed != 0;
}
