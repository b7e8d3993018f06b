/* Heat of the solid: profiles that must stay, series, heat that is kept and counted, the limit of the step. */
#include "mpm/heat.h"

#include "references/reference.h"
#include "tests/scene_run.h"

static const char *const bases[] = {"numerics.basis=linear", "numerics.basis=gimp", "numerics.basis=quadratic",
                                    "numerics.basis=cubic"};
static const char *const walls[] = {"numerics.wall_basis=mirrored", "numerics.wall_basis=modified"};

#define STONE "{\"model\": \"rigid\", \"density\": 2000, \"heat_capacity\": 500, \"conductivity\": 2}"
/* a bar along x that fills the grid: diffusivity 2e-6 m2/s */
#define BAR(grid, temperature)                                                                                         \
  "{\"grid\": " grid ", \"time\": {\"end\": 1e6}, \"start\": \"zero\", \"materials\": {\"stone\": " STONE "},"         \
  "\"solids\": {\"bar\": {\"material\": \"stone\", \"shape\": \"everywhere\", \"temperature\": \"" temperature "\"}}}"
#define FLAT "{\"min\": [-0.2, 0], \"max\": [0.8, null], \"h\": 0.1}"
#define DEEP "{\"min\": [-0.2, 0, 1], \"max\": [0.8, 0.2, 1.2], \"h\": 0.1}"

/* largest departure of the points from a function of x and t, K */
static double departure(const struct scene_run *run, double (*exact)(const double x[3], double t))
{
  const struct mpm *m = mpm_of(run->sim);
  double            most = 0, x[3] = {0};
  int               dim = run->sim->grid.dim;
  for (long p = 0; p < m->points->n; p++) {
    memcpy(x, m->x_p + p * dim, (size_t)dim * sizeof *x);
    most = fmax(most, fabs(m->temperature_p[p] - exact(x, run->sim->t)));
  }
  return most;
}

/* ---- profiles that stay as they are ---- */

static double rising(const double x[3], double t)
{
  (void)t;
  return 302 + 10 * x[0];
}

/* steady between two temperatures, and between a flux, 2 W/(m K) 10 K/m into the upper side, and a temperature */
START_TEST(linear_profiles_stay)
{
  static const char *const upper[] = {"boundary.heat.x_max={\"temperature\": 310}",
                                      "boundary.heat.x_max={\"flux\": 20}"};
  static const char *const points[] = {"numerics.points_per_cell=1", "numerics.points_per_cell=[2,2]",
                                       "numerics.points_per_cell=[3,2]", "numerics.points_per_cell=[2,2,1]"};
  for (int basis = 0; basis < 4; basis++)
    for (int i = 0; i < 4; i++)
      for (int w = 0; w < 2; w++) {
        const char      *sets[] = {bases[basis], walls[w], points[i], "boundary.heat.x_min={\"temperature\": 300}",
                                   upper[_i],    NULL};
        struct scene_run run;
        scene_open_with(i < 3 ? BAR(FLAT, "302+10*x") : BAR(DEEP, "302+10*x"), sets, &run);
        scene_steps(&run, 30, INFINITY);
        ck_assert_msg(departure(&run, rising) < 2e-11, "%s, %s, %s: %g K", bases[basis], walls[w], points[i],
                      departure(&run, rising));
        scene_close(&run);
      }
}
END_TEST

/* ---- against the series ---- */

struct trial {
  const char *sets[3];                /* of the scene */
  double      amplitude, fixed, flux; /* of the reference */
  double      tolerance;              /* of T over its scale, with 10 cells */
};

/* the bar of 1 m from x = -0.2 at Fourier number 0.1 */
static double series_error(const struct trial *trial, const struct scene_run *run, double *heat_in)
{
  const struct reference *r = reference_find("heated_bar");
  const struct mpm       *m = mpm_of(run->sim);
  double worst = 0, named[] = {2, 500, 2000, 1, 0.1, -0.2, 300, trial->amplitude, trial->fixed, trial->flux};
  void  *prm = calloc(1, r->param_size);
  for (int i = 0; r->params[i].name; i++) memcpy((char *)prm + r->params[i].offset, &named[i], sizeof named[i]);
  for (long p = 0; p < m->points->n; p++) {
    double x[1][3] = {{m->x_p[2 * p], 0, 0}}, T;
    must(r->value(prm, reference_quantity(r, "temperature"), 1, (const double(*)[3])x, run->sim->t, &T));
    worst = fmax(worst, fabs(m->temperature_p[p] - T) / r->scale(prm, 0));
  }
  const double nowhere[1][3] = {{0}};
  must(r->value(prm, reference_quantity(r, "heat_in"), 1, nowhere, run->sim->t, heat_in));
  free(prm);
  return worst;
}

static const struct trial trials[] = {
    {{"solids.bar.temperature=300+5*cos(pi*(x+0.2))", NULL}, 5, 0, 0, 0.012},
    {{"boundary.heat.x_min={\"temperature\": 310}", NULL}, 0, 310, 0, 8e-3},
    {{"boundary.heat.x_min={\"flux\": 20}", NULL}, 0, 0, 20, 3e-3},
};
enum { TRIALS = sizeof trials / sizeof *trials };

START_TEST(follows_the_series)
{
  const struct trial *trial = &trials[_i];
  for (int basis = 0; basis < 4; basis++) {
    const char      *sets[] = {bases[basis], trial->sets[0], NULL};
    struct scene_run run;
    double           heat_in, scale = 0.1 * 1e6 * 10, t_end = 0.1 / 2e-6;
    scene_open_with(BAR(FLAT, "300"), sets, &run);
    double start = scene_ledger(&run).v[LEDGER_heat];
    while (run.sim->t < t_end * (1 - 1e-12)) scene_step(&run, t_end - run.sim->t);
    double error = series_error(trial, &run, &heat_in);
    printf("%s, %s: %.2e\n", trial->sets[0], bases[basis], error);
    ck_assert_double_lt(error, trial->tolerance);
    struct ledger l = scene_ledger(&run);
    ck_assert_double_eq_tol(l.v[LEDGER_heat], start + l.v[LEDGER_heat_sides], 1e-12 * start);
    ck_assert_double_eq_tol(l.v[LEDGER_heat_sides], heat_in, trial->fixed > 0 ? 2e-3 * scale : 1e-12 * scale);
    scene_close(&run);
  }
}
END_TEST

/* T(0) = 300 + r t and insulated at the other end: once started so, all points rise with r */
static const double rate = 1e-5, alpha = 2e-6;

static double lagging(const double x[3], double t)
{
  double z = x[0] + 0.2;
  return 300 + rate * (t - (z - 0.5 * z * z) / alpha);
}

START_TEST(follows_a_side_that_warms)
{
  const char      *sets[] = {bases[_i], "boundary.heat.x_min={\"temperature\": \"300+1e-5*t\"}", NULL};
  struct scene_run run;
  scene_open_with(BAR(FLAT, "300-5*((x+0.2)-0.5*(x+0.2)^2)"), sets, &run);
  while (run.sim->t < 5e4) scene_step(&run, 1e3);
  ck_assert_double_lt(departure(&run, lagging), 0.02); /* of 2.5 K across the bar */
  scene_close(&run);
}
END_TEST

/* ---- two materials ---- */

/* 100 K over half a metre of 2 and half a metre of 8 W/(m K): 320 W/m2, 80 K and 20 K */
static double kinked(const double x[3], double t)
{
  (void)t;
  double z = x[0] + 0.2;
  return z < 0.5 ? 400 - 160 * z : 320 - 40 * (z - 0.5);
}

/* the same two cells and more from the kink; nearer, the points' own temperature is not looked at */
static double kinked_away(const double x[3], double t) { return fabs(x[0] - 0.3) > 0.2 ? kinked(x, t) : NAN; }

START_TEST(conducts_through_two_materials)
{
  static const char text[] =
      "{\"grid\": " FLAT ", \"time\": {\"end\": 1e9}, \"start\": \"zero\", \"materials\": {"
      "\"a\": " STONE ", \"b\": {\"model\": \"rigid\", \"density\": 1000, \"porosity\": 0.5, "
      "\"heat_capacity\": 900, \"conductivity\": 16}}, \"solids\": {"
      "\"low\": {\"material\": \"a\", \"shape\": {\"box\": {\"min\": [-0.2, null], \"max\": [0.3, null]}}},"
      "\"high\": {\"material\": \"b\", \"shape\": {\"box\": {\"min\": [0.3, null], \"max\": [0.8, null]}}}},"
      "\"boundary\": {\"heat\": {\"x_min\": {\"temperature\": 400}, \"x_max\": {\"temperature\": 300}}}}";
  const char      *sets[] = {bases[_i], NULL};
  struct scene_run run;
  scene_open_with(text, sets, &run);
  while (run.sim->t < 2e6) scene_step(&run, INFINITY);
  printf("two materials, %s: %.2f K, away from the kink %.2f K\n", bases[_i], departure(&run, kinked),
         departure(&run, kinked_away));
  ck_assert_double_lt(departure(&run, kinked), 6);      /* the kink, rounded over a cell of 16 K */
  ck_assert_double_lt(departure(&run, kinked_away), 4); /* as that resists: first order */
  double before = scene_ledger(&run).v[LEDGER_heat_sides];
  scene_steps(&run, 10, INFINITY);
  ck_assert_double_eq_tol(scene_ledger(&run).v[LEDGER_heat_sides], before,
                          1e-3); /* as much out as in: 0.1 m 320 W/m2 */
  scene_close(&run);
}
END_TEST

/* ---- what is kept ---- */

/* sum of m c (T - mean)2 */
static double unrest(const struct scene_run *run)
{
  const struct mpm *m = mpm_of(run->sim);
  double            mass = 0, mean = 0, sum = 0;
  for (long p = 0; p < m->points->n; p++) mass += m->mass_p[p], mean += m->mass_p[p] * m->temperature_p[p];
  mean /= mass;
  for (long p = 0; p < m->points->n; p++)
    sum += m->mass_p[p] * (m->temperature_p[p] - mean) * (m->temperature_p[p] - mean);
  return sum;
}

#define ROUGH "\"temperature\": \"300+50*sin(1000*x*x+700*y+300*z)\""

/* A body that points make rough ends, with temperatures that differ from point to point, at the very limit of the step:
 * differences only ever fade, and the heat stays. */
START_TEST(roughness_fades_and_heat_stays)
{
  static const char disk[] =
      "{\"grid\": {\"min\": [0, 0], \"max\": [1, 1], \"h\": 0.1}, \"time\": {\"end\": 1e6}, \"start\": \"zero\", "
      "\"materials\": {\"stone\": " STONE "}, \"solids\": {\"disk\": {\"material\": \"stone\", "
      "\"shape\": {\"circle\": {\"centre\": [0.41, 0.43], \"radius\": 0.37}}, " ROUGH "}}}";
  static const char ball[] =
      "{\"grid\": {\"min\": [0, 0, 0], \"max\": [1, 1, 1], \"h\": 0.2}, \"time\": {\"end\": 1e6}, \"start\": \"zero\", "
      "\"materials\": {\"stone\": " STONE "}, \"solids\": {\"ball\": {\"material\": \"stone\", "
      "\"shape\": {\"sphere\": {\"centre\": [0.51, 0.43, 0.6], \"radius\": 0.39}}, " ROUGH "}}}";
  static const char *const points[] = {"numerics.points_per_cell=1", "numerics.points_per_cell=4",
                                       "numerics.points_per_cell=9", "numerics.points_per_cell=8"};
  for (int i = 0; i < 4; i++) {
    const char      *sets[] = {bases[_i], "numerics.dt_factor=1", points[i], NULL};
    struct scene_run run;
    scene_open_with(i < 3 ? disk : ball, sets, &run);
    double first = unrest(&run), last = first, heat = scene_ledger(&run).v[LEDGER_heat];
    for (int step = 0; step < 40; step++) {
      scene_step(&run, INFINITY);
      ck_assert_msg(unrest(&run) <= last * (1 + 1e-12), "%s, %s: step %d", bases[_i], points[i], step);
      last = unrest(&run);
    }
    ck_assert_double_lt(last, 0.2 * first);
    ck_assert_double_eq_tol(scene_ledger(&run).v[LEDGER_heat], heat, 1e-12 * heat);
    ck_assert_double_eq(scene_ledger(&run).v[LEDGER_heat_sides], 0);
    scene_close(&run);
  }
}
END_TEST

/* a flux enters where the body covers the side, half of it here, and nowhere else */
START_TEST(flux_enters_the_covered_part)
{
  static const char text[] =
      "{\"grid\": {\"min\": [0, 0], \"max\": [1, 0.5], \"h\": 0.1}, \"time\": {\"end\": 1e6}, \"start\": \"zero\", "
      "\"materials\": {\"stone\": " STONE "}, \"solids\": {\"left\": {\"material\": \"stone\", "
      "\"shape\": {\"box\": {\"min\": [0, 0], \"max\": [0.5, 0.3]}}}}, "
      "\"boundary\": {\"heat\": {\"y_min\": {\"flux\": \"100*t\"}, \"y_max\": {\"flux\": 1e9}}}}";
  const char      *sets[] = {bases[_i], NULL};
  struct scene_run run;
  scene_open_with(text, sets, &run);
  double heat = scene_ledger(&run).v[LEDGER_heat];
  scene_steps(&run, 20, 100);
  struct ledger l = scene_ledger(&run);
  ck_assert_double_eq_tol(l.v[LEDGER_heat_sides] / (0.5 * 0.5 * 100 * run.sim->t * run.sim->t), 1, 1e-12);
  ck_assert_double_eq_tol(l.v[LEDGER_heat], heat + l.v[LEDGER_heat_sides], 1e-12 * heat);
  scene_close(&run);
}
END_TEST

/* one period of a profile on a ring: exp(-alpha k2 t) */
static double around(const double x[3], double t)
{
  double k = 2 * M_PI;
  return 300 + 5 * sin(k * (x[0] + 0.2)) * exp(-alpha * k * k * t);
}

START_TEST(goes_round_a_periodic_axis)
{
  const char *sets[] = {bases[_i], "boundary.solid={\"x_min\": \"periodic\", \"x_max\": \"periodic\"}", "grid.h=0.05",
                        NULL};
  struct scene_run run;
  scene_open_with(BAR(FLAT, "300+5*sin(2*pi*(x+0.2))"), sets, &run);
  double heat = scene_ledger(&run).v[LEDGER_heat];
  while (run.sim->t < 1e4) scene_step(&run, 1e4 - run.sim->t);
  ck_assert_double_lt(departure(&run, around), 0.06); /* of 2.3 K that are left */
  ck_assert_double_eq_tol(scene_ledger(&run).v[LEDGER_heat], heat, 1e-12 * heat);
  scene_close(&run);
}
END_TEST

START_TEST(temperatures_are_in_kelvin)
{
  struct loaded_scene *loaded;
  struct plan          plan;
  struct sim          *sim = NULL;
  char                 file[] = "/tmp/check_heat_XXXXXX.json";
  static const char    text[] = BAR(FLAT, "20-200*x");
  int                  handle = mkstemps(file, 5);
  struct run_options   options = {.argument = file, .until = INFINITY};
  ck_assert_int_eq(write(handle, text, strlen(text)), (long)strlen(text));
  close(handle);
  must(scene_load(&options, &loaded));
  unlink(file);
  must(plan_build(&loaded->scene, &plan));
  ck_assert_int_eq(sim_create(&loaded->scene, &plan, &sim), ERR_INPUT);
  ck_assert_ptr_nonnull(strstr(status_message(), "solids.bar.temperature"));
  ck_assert_ptr_nonnull(strstr(status_message(), "give it in K"));
  sim_destroy(&sim);
  scene_unload(&loaded);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("heat");
  TCase *tcase = tcase_create("heat");
  tcase_add_loop_test(tcase, linear_profiles_stay, 0, 2);
  tcase_add_loop_test(tcase, follows_the_series, 0, TRIALS);
  tcase_add_loop_test(tcase, follows_a_side_that_warms, 0, 4);
  tcase_add_loop_test(tcase, conducts_through_two_materials, 0, 4);
  tcase_add_loop_test(tcase, roughness_fades_and_heat_stays, 0, 4);
  tcase_add_loop_test(tcase, flux_enters_the_covered_part, 0, 4);
  tcase_add_loop_test(tcase, goes_round_a_periodic_axis, 0, 4);
  tcase_add_test(tcase, temperatures_are_in_kelvin);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
