/* Metrics: fields and gauges of an invented state against numbers known by hand, times, judgement, resume. */
#include "run/metrics.h"
#include "tests/run/fake.h"

#include "references/reference.h"
#include "run/gauges.h"
#include "run/scene_read.h"

#include <cjson/cJSON.h>
#include <math.h>

/* a second invented module: which cells are wet */
struct wetness {
  double *wet_cc;
};

static const struct field wet_fields[] = {
    FIELD_ROW(struct wetness, wet_cc, AT_CELL, 1, STATE, "wet", "-", "1 where there is water")};
static const struct module wet_module = {
    .name = "wet", .fields = wet_fields, .n_fields = 1, .state_size = sizeof(struct wetness)};
static const struct module *const both_modules[] = {&fake_module, &wet_module};

static const struct shape everywhere = {.kind = SHAPE_EVERYWHERE, .dim = 2};
/* cell centres x -0.15 ... 0.15, y 0.15, 0.25, 0.35: 4 x 3 cells */
static const struct shape low_left = {.kind = SHAPE_BOX, .dim = 2, .min = {-1, 0, -1}, .max = {0.2, 0.4, 1}};

static struct metric metric_of(const char *name, enum metric_measure measure, const char *field, const char *gauge)
{
  struct metric m = {.measure = (int)measure, .region = everywhere, .at = INFINITY, .to = INFINITY};
  snprintf(m.name, sizeof m.name, "%s", name);
  snprintf(m.field, sizeof m.field, "%s", field);
  snprintf(m.gauge, sizeof m.gauge, "%s", gauge);
  return m;
}

static void expect(struct metric *m, const char *text) { fake_ok(function_parse(text, &m->expected)); }

static struct gauge ledger_gauge(const char *name, const char *of)
{
  struct gauge g = {.kind = GAUGE_INTEGRAL, .region = everywhere};
  snprintf(g.name, sizeof g.name, "%s", name);
  snprintf(g.of, sizeof g.of, "%s", of);
  return g;
}

static void no_markers(const struct sim *sim, const char *name, long *first, long *end)
{
  (void)sim, (void)name;
  *first = *end = 0;
}

/* Results of the metrics of r->scene after samples of gauges and fields at the given times; ledger entries are set by
 * `fill` before each. Values in the order of the scene's metrics. */
static int evaluate(struct fake_run *r, int n_times, const double *times, void (*fill)(struct sim *, double t),
                    const struct loaded_scene *loaded, struct metric_entry *results)
{
  struct metrics            *metrics;
  struct gauges             *gauges;
  const struct metric_entry *entries;
  int                        n;
  fake_ok(gauges_create(&r->sim, r->folder, no_markers, &gauges));
  fake_ok(metrics_create(&r->sim, &metrics));
  for (int i = 0; i < n_times; i++) {
    r->sim.t = times[i];
    if (fill) fill(&r->sim, times[i]);
    long calls = memory_calls();
    fake_ok(metrics_sample(metrics, &r->sim));
    ck_assert_int_eq(memory_calls(), calls);
    fake_ok(gauges_sample(gauges, &r->sim));
  }
  fake_ok(metrics_finish(metrics, gauges, loaded, times[n_times - 1], &n, &entries));
  for (int i = 0; i < n; i++) results[i] = entries[i];
  for (int i = 0; i < n; i++) results[i].name = results[i].unit = NULL; /* they die with the metrics */
  metrics_destroy(&metrics);
  ck_assert_ptr_null(metrics);
  gauges_destroy(&gauges);
  return n;
}

static double evaluate_field(struct fake_run *r, struct metric *m)
{
  const double        end = 1;
  struct metric_entry result;
  r->scene.metrics = m, r->scene.n_metrics = 1;
  ck_assert_int_eq(evaluate(r, 1, &end, NULL, NULL, &result), 1);
  function_destroy(&m->expected);
  return result.value;
}

/* P = 100 + 10 x - 30 y: against itself, a constant off, a slope off; over a region; over its scale */
START_TEST(fields_of_cells)
{
  struct fake_run r;
  fake_create(2, &r);
  struct metric m = metric_of("m", MEASURE_RMS, "P", "");
  expect(&m, "100 + 10*x - 30*y");
  ck_assert_double_eq_tol(evaluate_field(&r, &m), 0, 1e-12);
  expect(&m, "97 + 10*x - 30*y");
  ck_assert_double_eq_tol(evaluate_field(&r, &m), 3, 1e-12);
  m.scale = 6;
  expect(&m, "97 + 10*x - 30*y");
  ck_assert_double_eq_tol(evaluate_field(&r, &m), 0.5, 1e-12);
  m = metric_of("m", MEASURE_RMS, "P", "");
  m.region = low_left;
  expect(&m, "100 - 30*y"); /* 10 x at -0.15, -0.05, 0.05, 0.15 */
  ck_assert_double_eq_tol(evaluate_field(&r, &m), 10 * sqrt((0.15 * 0.15 + 0.05 * 0.05) / 2), 1e-12);
  m.measure = MEASURE_MAX;
  expect(&m, "100 - 30*y");
  ck_assert_double_eq_tol(evaluate_field(&r, &m), 1.5, 1e-12);
  m.measure = MEASURE_MEAN; /* signed, over the mean of what is expected: 92.5 - 105 over 105 */
  expect(&m, "105");
  ck_assert_double_eq_tol(evaluate_field(&r, &m), (92.5 - 105) / 105, 1e-12);
  fake_destroy(&r);
}
END_TEST

START_TEST(fields_of_points)
{
  struct fake_run r;
  fake_create(2, &r);
  struct metric m = metric_of("m", MEASURE_MAX, "solid.vel_y", "");
  expect(&m, "2*(100 + 10*x - 30*y) + 0.25");
  ck_assert_double_eq_tol(evaluate_field(&r, &m), 0.25, 1e-11);
  m = metric_of("m", MEASURE_RMS, "stress_yy", "");
  m.region = low_left;
  expect(&m, "101 - 30*y"); /* two points per cell and axis: 10 x at +-0.025, ... +-0.175 */
  double squares = 0;
  for (int i = 0; i < 4; i++) squares += pow(10 * (0.025 + 0.05 * i), 2) / 4;
  ck_assert_double_eq_tol(evaluate_field(&r, &m), sqrt(squares), 1e-11);
  fake_destroy(&r);
}
END_TEST

/* Dry cells do not count: the rows above y 0.4 hold nonsense. */
START_TEST(dry_cells_do_not_count)
{
  struct fake_run r;
  struct wetness  wet;
  void           *states[2];
  fake_create(2, &r);
  fake_ok(NEW(&wet.wet_cc, r.sim.grid.size));
  states[0] = &r.state, states[1] = &wet;
  r.sim.modules = both_modules, r.sim.states = states, r.sim.n_modules = 2;
  const struct box cells = grid_cells(&r.sim.grid);
  FOR_BOX_SERIAL(&r.sim.grid, cells, c)
  {
    double x[3];
    grid_centre(&r.sim.grid, c, x);
    wet.wet_cc[c] = x[1] < 0.4;
    if (x[1] > 0.4) r.state.P_cc[c] = 1e30;
  }
  struct metric m = metric_of("m", MEASURE_RMS, "P", "");
  expect(&m, "98 + 10*x - 30*y");
  ck_assert_double_eq_tol(evaluate_field(&r, &m), 2, 1e-11);
  m = metric_of("m", MEASURE_MAX, "solid.vel_x", ""); /* points are not cells */
  ck_assert_double_gt(evaluate_field(&r, &m), 50);
  m = metric_of("m", MEASURE_ROUGHNESS, "P", "");
  ck_assert_double_eq_tol(evaluate_field(&r, &m), 0, 1e-11);
  memory_free(&wet.wet_cc);
  fake_destroy(&r);
}
END_TEST

/* A linear field has no roughness; a checkerboard of amplitude a on it has 8 a */
START_TEST(roughness)
{
  struct fake_run r;
  fake_create(2, &r);
  struct metric m = metric_of("m", MEASURE_ROUGHNESS, "P", "");
  ck_assert_double_eq_tol(evaluate_field(&r, &m), 0, 1e-11);
  const struct box cells = grid_cells(&r.sim.grid);
  FOR_BOX_SERIAL(&r.sim.grid, cells, c)
  {
    int place[3];
    grid_place(&r.sim.grid, c, place);
    r.state.P_cc[c] += (place[0] + place[1]) % 2 ? 0.25 : -0.25;
  }
  ck_assert_double_eq_tol(evaluate_field(&r, &m), 2, 1e-11);
  m.scale = 100;
  ck_assert_double_eq_tol(evaluate_field(&r, &m), 0.02, 1e-12);
  m = metric_of("m", MEASURE_L1, "P", "");
  expect(&m, "100 + 10*x - 30*y"); /* the mean size of the checkerboard itself */
  ck_assert_double_eq_tol(evaluate_field(&r, &m), 0.25, 1e-11);
  fake_destroy(&r);
}
END_TEST

/* The crest of a parabola is found between cells; along the longer axis of the region, its mean across the other */
START_TEST(crest)
{
  static const struct shape row = {.kind = SHAPE_BOX, .dim = 2, .min = {-1, 0.05, -1}, .max = {1, 0.25, 1}};
  struct fake_run           r;
  fake_create(2, &r);
  const struct box cells = grid_cells(&r.sim.grid);
  FOR_BOX_SERIAL(&r.sim.grid, cells, c)
  {
    double x[3];
    grid_centre(&r.sim.grid, c, x);
    r.state.P_cc[c] = 7 - 3 * (x[0] - 0.133) * (x[0] - 0.133);
  }
  struct metric m = metric_of("m", MEASURE_CREST, "P", "");
  m.region = row;
  expect(&m, "6.5");
  ck_assert_double_eq_tol(evaluate_field(&r, &m), 0.5 / 6.5, 1e-11);
  m = metric_of("m", MEASURE_CREST_PLACE, "P", "");
  m.region = row;
  m.scale = 1;
  expect(&m, "0.1");
  ck_assert_double_eq_tol(evaluate_field(&r, &m), 0.033, 1e-11);
  fake_destroy(&r);
}
END_TEST

/* A linear field does not scatter; every second column of points off by 2 a: a */
START_TEST(scatter)
{
  for (int dim = 2; dim <= 3; dim++) {
    struct fake_run r;
    fake_create(dim, &r);
    struct metric m = metric_of("m", MEASURE_SCATTER, "stress_yy", "");
    for (long p = 0; p < r.sim.points[SET_SOLID]->n; p++) { /* from three rows of cells to the four of a window */
      double *x = &r.state.x_p[p * dim], place[3] = {0};
      x[1] = 0.1 + (x[1] - 0.1) * 4 / 3;
      memcpy(place, x, (size_t)dim * sizeof *x);
      r.state.stress_p[6 * p + 1] = linear(place);
    }
    ck_assert_double_eq_tol(evaluate_field(&r, &m), 0, 1e-11);
    for (long p = 0; p < r.sim.points[SET_SOLID]->n; p++)
      r.state.stress_p[6 * p + 1] += (long)floor((r.state.x_p[p * dim] + 0.2) / 0.05) % 2 ? 0.25 : -0.25;
    ck_assert_double_eq_tol(evaluate_field(&r, &m), 0.25, 1e-11);
    fake_destroy(&r);
  }
}
END_TEST

static void oscillate(struct sim *sim, double t)
{
  sim->ledger.v[LEDGER_elastic] = 4 + 3 * t;
  sim->ledger.v[LEDGER_kinetic_solid] = 2 + exp(-1.5 * t) * sin(2 * M_PI * 6 * t);
}

enum { SAMPLES = 201 };

static void sample_times(double *times)
{
  for (int i = 0; i < SAMPLES; i++) times[i] = i / (double)(SAMPLES - 1);
}

/* Series 4 + 3 t and 2 + exp(-1.5 t) sin(12 pi t), and their sum, the energy */
START_TEST(gauges_over_time)
{
  struct fake_run     r;
  struct gauge        gauges[3] = {ledger_gauge("line", "elastic"), ledger_gauge("wave", "kinetic_solid"),
                                   ledger_gauge("sum", "energy")};
  struct metric       m[13];
  struct metric_entry e[13];
  double              times[SAMPLES];
  /* at t = 0.25 the line is 4.75, the wave 2 + exp(-0.375) sin(3 pi) = 2; at t = 1 the line is 7 */
  const double wanted[13] = {0.5,
                             3,
                             0.25,
                             1 / 2.125,
                             1.5 / 4.75,
                             0,
                             0,
                             7 / 4.75 - 1,
                             (4.75 + 2 - 1) / 2,
                             0.25 + 0.95 * 0.75,
                             4.75 / 6.75,
                             6.25 / 4.75 - 1,
                             1.5 / 6.25};
  sample_times(times);
  fake_create(2, &r);
  m[0] = metric_of("max", MEASURE_MAX, "", "line"), expect(&m[0], "4.5 + 3*t"), m[0].from = 0.2;
  m[1] = metric_of("rms", MEASURE_RMS, "", "line"), expect(&m[1], "1 + 3*t");
  m[2] = metric_of("offset", MEASURE_MAX, "", "line"), expect(&m[2], "4 + 3*t"), m[2].offset = -0.5, m[2].scale = 2;
  m[3] = metric_of("value", MEASURE_VALUE, "", "line"), expect(&m[3], "2.125"), m[3].at = 0.5, m[3].offset = -2.375;
  m[4] = metric_of("mean", MEASURE_MEAN, "", "line"), expect(&m[4], "2.5 + 3*t"), m[4].from = 0.5;
  m[5] = metric_of("frequency", MEASURE_FREQUENCY, "", "wave"), expect(&m[5], "6");
  m[6] = metric_of("decay", MEASURE_DECAY, "", "wave"), expect(&m[6], "1.5");
  m[7] = metric_of("drift", MEASURE_DRIFT, "", "line"), m[7].from = 0.25;
  m[8] = metric_of("energy", MEASURE_VALUE, "", "sum"), expect(&m[8], "1"), m[8].at = 0.25, m[8].scale = 2;
  m[9] = metric_of("reach", MEASURE_REACH, "", "line"), m[9].from = 0.25, m[9].share = 0.95;
  m[10] = metric_of("over", MEASURE_VALUE, "", "line"), m[10].at = 0.25;
  snprintf(m[10].over, sizeof m[10].over, "sum");
  m[12] = metric_of("gain", MEASURE_GAIN, "", "line"), m[12].from = 0.25, m[12].to = 0.75;
  snprintf(m[12].over, sizeof m[12].over, "line");
  m[11] = metric_of("change", MEASURE_CHANGE, "", "line"), m[11].from = 0.25, m[11].to = 0.75;
  r.scene.gauges = gauges, r.scene.n_gauges = 3, r.scene.metrics = m, r.scene.n_metrics = 13;
  ck_assert_int_eq(evaluate(&r, SAMPLES, times, oscillate, NULL, e), 13);
  for (int i = 0; i < 13; i++) {
    ck_assert_msg(fabs(e[i].value - wanted[i]) < 1e-6, "metric %d: %.10g, wanted %.10g", i, e[i].value, wanted[i]);
    ck_assert(e[i].pass && !e[i].has_limit);
    function_destroy(&m[i].expected);
  }
  fake_destroy(&r);
}
END_TEST

/* a cubic, highest at t = 0.4, that rings */
static void arch(struct sim *sim, double t)
{
  double s = t - 0.4;
  sim->ledger.v[LEDGER_elastic] = 5 - s * s * (2 + s) + 0.02 * sin(60 * M_PI * t);
  sim->ledger.v[LEDGER_kinetic_solid] = 5 - s * s * (2 + s);
  sim->ledger.v[LEDGER_momentum_x] = t;
}

START_TEST(peaks)
{
  struct fake_run r;
  struct gauge    gauges[3] = {ledger_gauge("rings", "elastic"), ledger_gauge("pure", "kinetic_solid"),
                               ledger_gauge("rises", "momentum_x")};
  struct metric   m[5] = {metric_of("peak", MEASURE_PEAK, "", "pure"), metric_of("time", MEASURE_PEAK_TIME, "", "pure"),
                          metric_of("peak2", MEASURE_PEAK, "", "rings"),
                          metric_of("time2", MEASURE_PEAK_TIME, "", "rings"),
                          metric_of("none", MEASURE_PEAK, "", "rises")};
  struct metric_entry e[5];
  double              times[SAMPLES];
  sample_times(times);
  fake_create(2, &r);
  for (int i = 0; i < 5; i++) expect(&m[i], "0"), m[i].from = 0.1, m[i].to = 0.9;
  r.scene.gauges = gauges, r.scene.n_gauges = 3, r.scene.metrics = m, r.scene.n_metrics = 5;
  ck_assert_int_eq(evaluate(&r, SAMPLES, times, arch, NULL, e), 5);
  ck_assert_double_eq_tol(e[0].value, 5, 1e-10);
  ck_assert_double_eq_tol(e[1].value, 0.4, 1e-10);
  ck_assert_double_eq_tol(e[2].value, 5, 1e-3);
  ck_assert_double_eq_tol(e[3].value, 0.4, 2e-3);
  ck_assert(!e[4].pass);
  for (int i = 0; i < 5; i++) function_destroy(&m[i].expected);
  fake_destroy(&r);
}
END_TEST

/* A bar that swings as the reference says, in the reference's own units of time and size, at the tracer's place */
static const double bar_params[6] = {1e7, 1000, 1, 1, 0.1, 0}; /* young, density, length, height, velocity, fixed end */

static void swing(struct sim *sim, double t)
{
  sim->ledger.v[LEDGER_elastic] = 2.5 * pow(sin(2 * M_PI * 25 * t), 2) + 0.05;
}

START_TEST(references_give_scale_and_time)
{
  struct fake_run      r;
  struct gauge         gauge = ledger_gauge("elastic", "elastic");
  struct reference_use use = {
      .name = "theory", .reference = reference_find("bar_vibration"), .params = (void *)bar_params};
  struct metric m[3] = {metric_of("rms", MEASURE_RMS, "", "elastic"), metric_of("value", MEASURE_VALUE, "", "elastic"),
                        metric_of("late", MEASURE_VALUE, "", "elastic")};
  struct metric_entry e[3];
  double              times[SAMPLES];
  fake_create(2, &r);
  for (int i = 0; i < SAMPLES; i++) times[i] = 0.08 * i / (SAMPLES - 1);
  r.scene.time_end = 0.08;
  for (int i = 0; i < 3; i++)
    snprintf(m[i].reference, sizeof m[i].reference, "theory.elastic"), m[i].scaled_time = true;
  m[1].at = 1.25; /* periods of 0.04 s */
  m[2].at = 2.5;  /* after the end */
  r.scene.gauges = &gauge, r.scene.n_gauges = 1, r.scene.metrics = m, r.scene.n_metrics = 3;
  r.scene.references = &use, r.scene.n_references = 1;
  ck_assert_int_eq(evaluate(&r, SAMPLES, times, swing, NULL, e), 2);
  ck_assert_double_eq_tol(e[0].value, 0.05 / 2.5, 1e-9);
  ck_assert_double_eq_tol(e[1].value, 0.05 / 2.5, 1e-9);
  fake_destroy(&r);
}
END_TEST

/* ---- against measured rows ---- */

/* a front that runs 0.05 s ahead of the table 4 + 3 t, and back to it */
START_TEST(rows_over_time)
{
  struct fake_run r;
  struct gauge    gauge = ledger_gauge("line", "elastic");
  struct metric   m[4] = {metric_of("shifted", MEASURE_FIT, "", "line"), metric_of("plain", MEASURE_FIT, "", "line"),
                          metric_of("little", MEASURE_FIT, "", "line"), metric_of("none", MEASURE_FIT, "", "line")};
  struct metric_entry e[4];
  double              times[SAMPLES];
  const double        t[4] = {0.1, 0.3, 0.5, 0.9}, v[4] = {4.15, 4.75, 5.35, 99};
  sample_times(times);
  fake_create(2, &r);
  for (int i = 0; i < 4; i++) {
    fake_ok(function_table(4, t, v, &m[i].expected));
    m[i].to = i == 3 ? 0.05 : 0.6; /* the last row does not count; none does */
  }
  m[0].shift = 0.2, m[2].shift = 0.02;
  r.scene.gauges = &gauge, r.scene.n_gauges = 1, r.scene.metrics = m, r.scene.n_metrics = 4;
  ck_assert_int_eq(evaluate(&r, SAMPLES, times, oscillate, NULL, e), 4);
  ck_assert_double_eq_tol(e[0].value, 0, 1e-9);
  ck_assert_double_eq_tol(e[1].value, 0.15, 1e-9);
  ck_assert_double_eq_tol(e[2].value, 0.09, 1e-9);
  ck_assert(isnan(e[3].value));
  for (int i = 0; i < 4; i++) function_destroy(&m[i].expected);
  fake_destroy(&r);
}
END_TEST

/* P = 100 + 10 x - 30 y along a line, rows 1 and 2 off at one time, 3 off at the other, later ones not asked for */
START_TEST(rows_over_time_and_place)
{
  struct fake_run r;
  struct gauge    line = {.name = "line", .kind = GAUGE_LINE, .of = "P", .x = {-0.1, 0.3}, .to = {1.1, 0.3}, .n = 7};
  struct metric   m[2] = {metric_of("m", MEASURE_PROFILE, "", "line"), metric_of("n", MEASURE_PROFILE, "", "line")};
  struct metric_entry e[2];
  double       t[5] = {0.2, 0.2, 0.6, 0.6, 0.9}, x[5] = {-0.05, 0.44, 0.2, 1.1, 0.5}, v[5], times[3] = {0, 0.5, 1};
  const double off[5] = {1, 2, 3, 3, 50};
  fake_create(2, &r);
  for (int i = 0; i < 5; i++) v[i] = linear((const double[]){x[i], 0.3, 0}) + off[i];
  for (int i = 0; i < 2; i++) m[i].profile = (struct profile){5, t, x, v}, m[i].to = 0.8;
  m[1].from = 0.5;
  r.scene.gauges = &line, r.scene.n_gauges = 1, r.scene.metrics = m, r.scene.n_metrics = 2;
  ck_assert_int_eq(evaluate(&r, 3, times, NULL, NULL, e), 2);
  ck_assert_double_eq_tol(e[0].value, 0.5 * (sqrt(2.5) + 3), 1e-9);
  ck_assert_double_eq_tol(e[1].value, 3, 1e-9);
  fake_destroy(&r);
}
END_TEST

/* the wave 2 + exp(-1.5 t) sin(12 pi t): from its first trough at 1/8 s to the crest after it; never above 3 */
START_TEST(rises_and_excesses)
{
  struct fake_run r;
  struct gauge    gauge = ledger_gauge("wave", "kinetic_solid");
  struct metric   m[3] = {metric_of("rise", MEASURE_RISE, "", "wave"), metric_of("excess", MEASURE_EXCESS, "", "wave"),
                          metric_of("never", MEASURE_EXCESS, "", "wave")};
  struct metric_entry e[3];
  double              times[SAMPLES];
  sample_times(times);
  fake_create(2, &r);
  expect(&m[1], "2 + exp(-1.5*t) - 0.25"), expect(&m[2], "3");
  m[0].from = 0.125;
  r.scene.gauges = &gauge, r.scene.n_gauges = 1, r.scene.metrics = m, r.scene.n_metrics = 3;
  ck_assert_int_eq(evaluate(&r, SAMPLES, times, oscillate, NULL, e), 3);
  ck_assert_double_eq_tol(e[0].value, exp(-1.5 * 0.125) + exp(-1.5 * 5 / 24.0), 5e-3);
  ck_assert_double_eq_tol(e[1].value, 0.25, 1e-3);
  ck_assert_double_eq(e[2].value, 0);
  for (int i = 0; i < 3; i++) function_destroy(&m[i].expected);
  fake_destroy(&r);
}
END_TEST

/* ---- a body among cells ---- */

/* the lower left 6 x 3 cells, of which one row is gone and lies elsewhere; a border one cell thick, and two */
START_TEST(bodies_among_cells)
{
  struct fake_run r;
  struct metric   misfit = metric_of("m", MEASURE_MISFIT, "saturation", ""),
                thick = metric_of("m", MEASURE_THICKNESS, "saturation", "");
  const struct shape body = {.kind = SHAPE_BOX, .dim = 2, .min = {-1, -1, -1}, .max = {0.4, 0.4, 1}};
  const double       border[2][4] = {{1, 0.5, 0, 0}, {1, 0.75, 0.25, 0}};
  fake_create(2, &r);
  fake_liquid(&r);
  const struct grid *g = &r.sim.grid;
  const struct box   cells = grid_cells(g);
  FOR_BOX_SERIAL(g, cells, c)
  {
    double x[3];
    grid_centre(g, c, x);
    r.state.alpha_cc[c] = x[0] < 0.4 ? x[1] < 0.3 : x[0] < 1 && x[1] < 0.2;
  }
  misfit.region = body;
  ck_assert_double_eq_tol(evaluate_field(&r, &misfit), 12.0 / 18, 1e-12);
  for (int k = 0; k < 2; k++) {
    FOR_BOX_SERIAL(g, cells, c)
    {
      double x[3];
      grid_centre(g, c, x);
      int i = (int)floor((x[0] + 0.2) / 0.1) - 8;
      r.state.alpha_cc[c] = border[k][i < 0 ? 0 : i > 3 ? 3 : i];
    }
    ck_assert_double_eq_tol(evaluate_field(&r, &thick), k + 1, 1e-12);
  }
  fake_destroy(&r);
}
END_TEST

/* A run that was to end early is judged by what it could reach. */
START_TEST(an_early_end)
{
  struct fake_run     r;
  struct gauge        gauge = ledger_gauge("line", "elastic");
  struct metric       m[3] = {metric_of("now", MEASURE_VALUE, "", "line"), metric_of("end", MEASURE_VALUE, "", "line"),
                              metric_of("field", MEASURE_MEAN, "P", "")};
  struct metric_entry e[3];
  const double        times[2] = {0, 0.5};
  fake_create(2, &r);
  m[0].at = 0.5;
  r.scene.gauges = &gauge, r.scene.n_gauges = 1, r.scene.metrics = m, r.scene.n_metrics = 3;
  ck_assert_int_eq(evaluate(&r, 2, times, oscillate, NULL, e), 1);
  ck_assert_double_eq_tol(e[0].value, 5.5, 1e-12);
  fake_destroy(&r);
}
END_TEST

/* Limits hold for magnitudes; what cannot be measured is missed. */
START_TEST(judgement)
{
  struct fake_run     r;
  struct gauge        gauge = ledger_gauge("line", "elastic");
  struct metric       m[4] = {metric_of("good", MEASURE_VALUE, "", "line"), metric_of("low", MEASURE_VALUE, "", "line"),
                              metric_of("flat", MEASURE_DRIFT, "", "line"), metric_of("free", MEASURE_VALUE, "", "line")};
  struct metric_entry e[4];
  struct loaded_scene loaded = {.expected = cJSON_Parse("{\"good\": {\"limit\": 0.1}, \"low\": {\"limit\": 0.1},"
                                                        " \"flat\": {\"limit\": 10}, \"free\": {\"unit\": \"-\"}}")};
  const double        times[3] = {0, 0.5, 1};
  fake_create(2, &r);
  for (int i = 0; i < 4; i++) expect(&m[i], i == 1 ? "9" : "7.5"); /* the line ends at 7 */
  m[2].from = 0.8, m[2].to = 0.9;                                  /* no sample there */
  r.scene.gauges = &gauge, r.scene.n_gauges = 1, r.scene.metrics = m, r.scene.n_metrics = 4;
  ck_assert_int_eq(evaluate(&r, 3, times, oscillate, &loaded, e), 4);
  ck_assert(e[0].has_limit && e[0].pass && e[0].limit == 0.1);
  ck_assert_double_eq_tol(e[0].value, -0.5 / 7.5, 1e-12);
  ck_assert(e[1].has_limit && !e[1].pass);
  ck_assert(isnan(e[2].value) && !e[2].pass);
  ck_assert(!e[3].has_limit && e[3].pass);
  for (int i = 0; i < 4; i++) function_destroy(&m[i].expected);
  cJSON_Delete(loaded.expected);
  fake_destroy(&r);
}
END_TEST

/* Times come in order and once; results taken before a checkpoint are kept, not measured again. */
START_TEST(times_and_resume)
{
  struct fake_run r;
  struct metrics *first, *second;
  struct metric   m[3] = {metric_of("late", MEASURE_MEAN, "P", ""), metric_of("early", MEASURE_MEAN, "P", ""),
                          metric_of("same", MEASURE_MAX, "P", "")};
  int             n;
  fake_create(2, &r);
  m[0].at = 0.75, m[1].at = m[2].at = 0.25;
  r.scene.metrics = m, r.scene.n_metrics = 3;
  fake_ok(metrics_create(&r.sim, &first));
  const double *times = metrics_times(first, &n);
  ck_assert_int_eq(n, 2);
  ck_assert(times[0] == 0.25 && times[1] == 0.75);
  fake_ok(metrics_sample(first, &r.sim)); /* t = 0.25 */
  double *values = metrics_values(first, &n), early = values[1];
  ck_assert(isnan(values[0]) && isfinite(early));
  fake_ok(metrics_create(&r.sim, &second));
  memcpy(metrics_values(second, &n), values, (size_t)n * sizeof *values);
  for (long c = 0; c < r.sim.grid.size; c++) r.state.P_cc[c] += 1000;
  r.sim.t = 0.75;
  fake_ok(metrics_sample(second, &r.sim));
  values = metrics_values(second, &n);
  ck_assert(values[1] == early);
  ck_assert_double_eq_tol(values[0] - early, 1000, 1e-9);
  metrics_destroy(&first), metrics_destroy(&second);
  fake_destroy(&r);
}
END_TEST

START_TEST(wrong_metrics)
{
  struct fake_run r;
  struct metrics *metrics = NULL;
  struct metric   m = metric_of("m", MEASURE_RMS, "temperature", "");
  fake_create(2, &r);
  r.scene.metrics = &m, r.scene.n_metrics = 1;
  ck_assert_int_eq(metrics_create(&r.sim, &metrics), ERR_INPUT);
  ck_assert_ptr_null(metrics);
  ck_assert_ptr_nonnull(strstr(status_message(), "metrics.m.field"));
  m = metric_of("m", MEASURE_SCATTER, "P", "");
  ck_assert_int_eq(metrics_create(&r.sim, &metrics), ERR_INPUT);
  m = metric_of("m", MEASURE_RMS, "P", "");
  m.region = (struct shape){.kind = SHAPE_BALL, .dim = 2, .centre = {50, 0, 0}, .radius = 1};
  m.at = 0.25;
  fake_ok(metrics_create(&r.sim, &metrics));
  ck_assert_int_eq(metrics_sample(metrics, &r.sim), ERR_INPUT);
  metrics_destroy(&metrics);
  fake_destroy(&r);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("metrics");
  TCase *tests = tcase_create("metrics");
  tcase_add_test(tests, fields_of_cells);
  tcase_add_test(tests, fields_of_points);
  tcase_add_test(tests, dry_cells_do_not_count);
  tcase_add_test(tests, roughness);
  tcase_add_test(tests, crest);
  tcase_add_test(tests, scatter);
  tcase_add_test(tests, gauges_over_time);
  tcase_add_test(tests, peaks);
  tcase_add_test(tests, references_give_scale_and_time);
  tcase_add_test(tests, rows_over_time);
  tcase_add_test(tests, rows_over_time_and_place);
  tcase_add_test(tests, rises_and_excesses);
  tcase_add_test(tests, bodies_among_cells);
  tcase_add_test(tests, an_early_end);
  tcase_add_test(tests, judgement);
  tcase_add_test(tests, times_and_resume);
  tcase_add_test(tests, wrong_metrics);
  suite_add_tcase(suite, tests);
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed != 0;
}
