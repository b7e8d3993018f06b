/* The cells' path through small scenes: stillness, limits of the elimination, exchange of momentum, mass, solvers. */
#include "ice/ice.h"

#include "coupling/coupling.h"
#include "mpm/mpm.h"
#include "tests/scene_run.h"

#define GRID "\"grid\": {\"min\": [0, 0], \"max\": [0.6, 1.2], \"h\": 0.1}, \"time\": {\"end\": 10}"
#define DOWN ", \"gravity\": [0, -9.81]"
#define WATER(more) ", \"fluid\": {\"path\": \"ice\", \"density\": 1000, \"viscosity\": 1e-3" more "}"
#define BELOW(y) ", \"region\": {\"box\": {\"min\": [null, null], \"max\": [null, " y "]}}"
#define MATERIALS                                                                                                      \
  ", \"materials\": {\"rock\": {\"model\": \"rigid\", \"density\": 2650, \"porosity\": 0.4, \"permeability\": 1e-3},"  \
  "\"soil\": {\"model\": \"linear_elastic\", \"young\": 1e6, \"poisson\": 0.3, \"density\": 2650, \"porosity\": 0.4, " \
  "\"permeability\": 1e-3}}"
#define BLOCK(material, x0, y0, x1, y1)                                                                                \
  ", \"solids\": {\"block\": {\"material\": \"" material "\", \"shape\": {\"box\": {\"min\": [" x0 ", " y0             \
  "], \"max\": [" x1 ", " y1 "]}}}}"
#define PERIODIC_X "\"x_min\": \"periodic\", \"x_max\": \"periodic\""
#define RING ", \"boundary\": {\"solid\": {" PERIODIC_X "}, \"fluid\": {" PERIODIC_X "}}"

/* m/s: fastest fluid in cells or through faces */
static double fastest(const struct scene_run *run)
{
  const struct ice  *ice = ice_of(run->sim);
  const struct grid *g = &run->sim->grid;
  struct box         cells = grid_cells(g);
  double             most = ice->now.speed;
  FOR_BOX_SERIAL(g, cells, c)
  for (int d = 0; d < g->dim; d++) most = fmax(most, fabs(ice->vel_cc[c * g->dim + d]));
  return most;
}

static double fastest_point(const struct scene_run *run)
{
  const struct mpm *m = mpm_of(run->sim);
  double            most = 0;
  for (long q = 0; q < m->points->n * run->sim->grid.dim; q++) most = fmax(most, fabs(m->vel_p[q]));
  return most;
}

/* ---- stillness ---- */

static const char *const still[] = {
    "{" GRID DOWN WATER("") "}",                                                            /* a closed box */
    "{" GRID DOWN WATER(", \"bulk_modulus\": 2e6") "}",                                     /* soft */
    "{" GRID DOWN WATER(BELOW("0.8")) "}",                                                  /* surface on a face */
    "{" GRID DOWN WATER(BELOW("0.875")) "}",                                                /* and inside a cell */
    "{" GRID DOWN WATER("") ", \"boundary\": {\"fluid\": {\"y_max\": {\"pressure\": 0}}}}", /* a given pressure above */
    "{" GRID DOWN WATER(", \"bulk_modulus\": \"infinite\"") "}",                            /* singular */
    "{" GRID ", \"gravity\": [3, 0]" WATER(", \"bulk_modulus\": \"infinite\"") "}",
    "{" GRID DOWN MATERIALS BLOCK("rock", "0.2", "0", "0.5", "0.5") WATER(BELOW("0.8")) "}", /* a held block */
    "{" GRID DOWN MATERIALS BLOCK("rock", "0.15", "0.22", "0.47", "1.2") WATER("") "}",
    "{\"grid\": {\"min\": [0, 0, 0], \"max\": [0.4, 0.6, 0.3], \"h\": 0.1}, \"time\": {\"end\": 1}, \"gravity\": [0, "
    "-9.81, 0]" MATERIALS ", \"solids\": {\"block\": {\"material\": \"rock\", \"shape\": {\"box\": {\"min\": [0.1, 0, "
    "0], \"max\": [0.2, 0.3, 0.2]}}}}" WATER("") "}",
};
enum { STILL = sizeof still / sizeof *still };

/* theta = 1/2 keeps the sound that round-off makes: 1e-16 K/(rho c) = 1.5e-13 m/s a step */
START_TEST(still_water_stays)
{
  for (int theta = 0; theta < 2; theta++)
    for (int hypre = 0; hypre < 2; hypre++) {
      const char *sets[] = {theta ? "numerics.theta=0.5" : "numerics.theta=1",
                            hypre ? "numerics.pressure_solver=hypre" : "numerics.pressure_solver=direct",
                            "numerics.dt_max=1e-3", NULL};
      struct scene_run run;
      scene_open_with(still[_i], sets, &run);
      const struct ice *ice = ice_of(run.sim);
      long              probe = grid_at(&run.sim->grid, 1, 1, 0);
      double            P = ice->P_cc[probe], mass = scene_ledger(&run).v[LEDGER_mass_fluid];
      scene_steps(&run, 100, INFINITY);
      ck_assert_double_lt(fastest(&run), theta ? 1e-11 : 1e-12);
      ck_assert_double_eq_tol(ice->P_cc[probe], P, 1e-9 * fabs(P));
      ck_assert_double_eq_tol(scene_ledger(&run).v[LEDGER_mass_fluid], mass, 1e-13 * mass);
      scene_close(&run);
    }
}
END_TEST

/* a porous body as heavy as the water it holds out floats without a move */
START_TEST(neutral_body_floats)
{
  const char *sets[] = {"materials.soil.density=1000", "fluid.bulk_modulus=infinite", "numerics.dt_max=1e-3", NULL};
  struct scene_run run;
  scene_open_with("{" GRID DOWN MATERIALS BLOCK("soil", "0.15", "0.3", "0.45", "0.8") WATER(BELOW("1")) "}", sets,
                  &run);
  scene_steps(&run, 100, INFINITY);
  ck_assert_double_lt(fastest(&run), 1e-12);
  ck_assert_double_lt(fastest_point(&run), 1e-12);
  scene_close(&run);
}
END_TEST

/* nothing moves, nothing has a pressure: the singular system meets a zero right-hand side */
START_TEST(nothing_at_all)
{
  const char      *sets[] = {"fluid.bulk_modulus=infinite", NULL};
  struct scene_run run;
  scene_open_with("{" GRID MATERIALS BLOCK("soil", "0.15", "0.3", "0.45", "0.8") WATER("") "}", sets, &run);
  scene_steps(&run, 20, 1e-3);
  ck_assert(ice_of(run.sim)->singular);
  ck_assert_double_eq(fastest(&run), 0);
  ck_assert_double_eq(fastest_point(&run), 0);
  ck_assert_double_eq(ice_of(run.sim)->P_cc[grid_at(&run.sim->grid, 2, 2, 0)], 0);
  scene_close(&run);
}
END_TEST

/* ---- elimination of drag ---- */

/* the answer of both phases at a face inside a medium, n r_u + phi r_s, for a permeability */
static double mobility(const char *permeability)
{
  const char      *sets[] = {permeability, NULL};
  struct scene_run run;
  scene_open_with("{" GRID DOWN MATERIALS BLOCK("soil", "null", "null", "null", "null") WATER("") "}", sets, &run);
  scene_step_to(&run, 1e-6, "ice.eliminate_drag");
  const struct ice *ice = ice_of(run.sim);
  long              f = grid_at(&run.sim->grid, 3, 5, 0);
  double            n = ice->porosity_fc[f];
  ck_assert_double_eq_tol(n, 0.4, 1e-14);
  double answer = n * ice->u_reply_fc[f] + (1 - n) * ice->s_reply_fc[f];
  if (ice->drag_fc[f] > 1e12)
    ck_assert_double_eq_tol(ice->u_reply_fc[f], ice->s_reply_fc[f], 1e-8 * ice->s_reply_fc[f]);
  scene_close(&run);
  return answer;
}

START_TEST(limits_of_drag)
{
  double free = mobility("materials.soil.permeability=1e3"), stuck = mobility("materials.soil.permeability=1e-14"),
         some = mobility("materials.soil.permeability=1e-3");
  double rho = 1000 * (1 + 9.81 * 1000 * 0.65 / 2.2e9); /* of the water at that face, nearly */
  ck_assert_double_eq_tol(free, 0.4 / rho + 0.6 / 2650, 1e-6 * free);
  ck_assert_double_eq_tol(stuck, 1 / (0.4 * rho + 0.6 * 2650), 1e-6 * stuck);
  ck_assert_double_gt(some, stuck);
  ck_assert_double_lt(some, free);
}
END_TEST

/* ---- momentum ---- */

/* water streams past and through soil in a ring, faster from row to row: drag passes momentum on and loses none. Slow,
 * because momentum does not travel with mass (theory 4.8), which is of second order in the velocity. */
START_TEST(drag_passes_momentum_on)
{
  static const char *const blocks[] = {BLOCK("soil", "null", "null", "null", "null"),
                                       BLOCK("soil", "null", "null", "null", "0.55")};
  for (int stiff = 0; stiff < 2; stiff++) {
    char        text[2048];
    const char *sets[] = {stiff ? "fluid.bulk_modulus=infinite" : "fluid.bulk_modulus=2.2e9",
                          "fluid.velocity=[\"1e-4*(1 + 2*y)\", 0]", "start=zero", NULL};
    struct scene_run run;
    snprintf(text, sizeof text, "{" GRID MATERIALS "%s" WATER("") RING "}", blocks[_i]);
    scene_open_with(text, sets, &run);
    struct ledger before = scene_ledger(&run);
    scene_steps(&run, 100, 1e-3);
    struct ledger after = scene_ledger(&run);
    ck_assert_double_lt(after.v[LEDGER_kinetic_fluid], 0.9 * before.v[LEDGER_kinetic_fluid]);
    ck_assert_double_gt(after.v[LEDGER_kinetic_solid], 0.01 * before.v[LEDGER_kinetic_fluid]);
    ck_assert_double_eq_tol(after.v[LEDGER_momentum_x], before.v[LEDGER_momentum_x],
                            1e-12 * before.v[LEDGER_momentum_x]);
    scene_close(&run);
  }
}
END_TEST

/* a soil of one porosity everywhere is set moving with its water: nothing slips, nothing changes */
START_TEST(common_motion_goes_on)
{
  const char *sets[] = {"fluid.velocity=[0.3, 0]", "solids.block.velocity=[0.3, 0]", "start=zero", "gravity=[0, 0]",
                        NULL};
  struct scene_run run;
  scene_open_with("{" GRID MATERIALS BLOCK("soil", "null", "null", "null", "null") WATER("") RING "}", sets, &run);
  const struct mpm *m = mpm_of(run.sim);
  const struct ice *ice = ice_of(run.sim);
  scene_steps(&run, 1000, 1e-3); /* half a turn */
  double worst = 0;
  for (long p = 0; p < m->points->n; p++) worst = fmax(worst, fabs(m->vel_p[2 * p] - 0.3));
  struct box cells = grid_cells(&run.sim->grid);
  FOR_BOX_SERIAL(&run.sim->grid, cells, c) worst = fmax(worst, fabs(ice->vel_cc[2 * c] - 0.3));
  ck_assert_double_lt(worst, 1e-9);
  scene_close(&run);
}
END_TEST

/* ---- mass ---- */

START_TEST(mass_in_a_closed_box)
{
  const char      *sets[] = {"start=zero", NULL};
  struct scene_run run;
  scene_open_with("{" GRID DOWN MATERIALS BLOCK("soil", "0.1", "0.3", "0.4", "0.9") WATER(BELOW("1")) "}", sets, &run);
  struct ledger before = scene_ledger(&run);
  scene_steps(&run, 300, INFINITY);
  struct ledger after = scene_ledger(&run);
  ck_assert_double_gt(fastest_point(&run), 1e-3);
  ck_assert_double_eq_tol(after.v[LEDGER_mass_fluid], before.v[LEDGER_mass_fluid], 1e-13 * before.v[LEDGER_mass_fluid]);
  ck_assert_double_eq(after.v[LEDGER_mass_fluid_out], 0);
  ck_assert_double_eq(after.v[LEDGER_mass_solid], before.v[LEDGER_mass_solid]);
  scene_close(&run);
}
END_TEST

/* what leaves through open sides is counted; a steady flow leaves as much as it lets in */
START_TEST(outflow_is_counted)
{
  static const char *const sides[] = {"\"x_min\": {\"pressure\": 1000}, \"x_max\": {\"pressure\": 0}",
                                      "\"x_min\": {\"velocity\": [\"0.01*min(1, t/0.1)\", 0]}, \"x_max\": \"open\"",
                                      "\"y_max\": {\"pressure\": 500}"};
  char                     text[2048];
  const char              *sets[] = {"fluid.bulk_modulus=1e6", "start=zero", NULL};
  struct scene_run         run;
  snprintf(text, sizeof text,
           "{" GRID MATERIALS BLOCK("rock", "0.2", "null", "0.4", "null")
               WATER("") ", \"boundary\": {\"fluid\": {%s}}}",
           sides[_i]);
  scene_open_with(text, sets, &run);
  double mass = scene_ledger(&run).v[LEDGER_mass_fluid];
  scene_steps(&run, 200, 1e-3);
  struct ledger after = scene_ledger(&run);
  ck_assert_double_gt(fabs(after.v[LEDGER_mass_fluid] - mass), 1e-6 * mass);
  ck_assert_double_gt(fabs(after.v[LEDGER_mass_fluid_out]), 1e-6 * mass);
  ck_assert_double_eq_tol(after.v[LEDGER_mass_fluid] + after.v[LEDGER_mass_fluid_out], mass, 1e-13 * mass);
  scene_close(&run);
}
END_TEST

/* ---- sound ---- */

/* energy that a standing wave keeps over two periods, with 25 steps a period */
static double energy_kept(const char *theta)
{
  const char      *sets[] = {theta, "fluid.bulk_modulus=1e6", "start=zero", "numerics.dt_max=1.5179e-3", NULL};
  struct scene_run run;
  scene_open_with("{" GRID WATER(", \"pressure\": \"10*cos(pi*y/1.2)\"") "}", sets, &run);
  double before = scene_ledger(&run).v[LEDGER_compression];
  scene_steps(&run, 100, INFINITY);
  struct ledger after = scene_ledger(&run);
  scene_close(&run);
  return (after.v[LEDGER_compression] + after.v[LEDGER_kinetic_fluid]) / before;
}

/* theta = 1 damps sound, 1/2 keeps it */
START_TEST(theta_and_sound)
{
  double kept = energy_kept("numerics.theta=0.5"), damped = energy_kept("numerics.theta=1");
  ck_assert_double_eq_tol(kept, 1, 0.02);
  ck_assert_double_lt(damped, 0.5);
}
END_TEST

/* ---- one answer, whatever the solver and nearly whatever the stiffness ---- */

#define SINKING "{" GRID DOWN MATERIALS BLOCK("soil", "0.1", "0.3", "0.4", "0.9") WATER(BELOW("1")) "}"

enum { VALUES = 512 };

struct state {
  double x[VALUES], P[VALUES]; /* displacements of the points, pressures of the cells */
};

static struct state sink(const char *how, const char *stiffness)
{
  const char      *sets[] = {"start=zero",
                             "numerics.dt_max=5e-4",
                             "numerics.pressure_tolerance=1e-13",
                             "numerics.ice.defect_tolerance=1e-13",
                             how,
                             stiffness,
                             NULL};
  struct scene_run run;
  struct state     s = {0};
  long             n = 0;
  scene_open_with(SINKING, sets, &run);
  scene_steps(&run, 100, INFINITY);
  const struct mpm *m = mpm_of(run.sim);
  struct box        cells = grid_cells(&run.sim->grid);
  ck_assert_int_lt(2 * m->points->n, VALUES);
  memcpy(s.x, m->displacement_p, (size_t)(2 * m->points->n) * sizeof *s.x);
  FOR_BOX_SERIAL(&run.sim->grid, cells, c) s.P[n++] = ice_of(run.sim)->P_cc[c];
  scene_close(&run);
  return s;
}

/* largest difference over the largest value */
static double difference(const double *a, const double *b)
{
  double apart = 0, size = 0;
  for (int q = 0; q < VALUES; q++) {
    apart = fmax(apart, fabs(a[q] - b[q]));
    size = fmax(size, fabs(a[q]));
  }
  ck_assert_double_gt(size, 1e-6);
  return apart / size;
}

/* the volume that a solve may leave, 1e-13 of a cell, is a pressure of 1e-13 K */
START_TEST(solvers_agree)
{
  static const char *const stiffness[] = {"fluid.bulk_modulus=1e7", "fluid.bulk_modulus=2.2e9"};
  for (int i = 0; i < 2; i++) {
    struct state a = sink("numerics.pressure_solver=hypre", stiffness[i]),
                 b = sink("numerics.pressure_solver=direct", stiffness[i]);
    ck_assert_double_lt(difference(a.x, b.x), i ? 1e-7 : 1e-9);
    ck_assert_double_lt(difference(a.P, b.P), i ? 1e-7 : 1e-9);
  }
}
END_TEST

START_TEST(infinite_is_the_limit_of_stiff)
{
  struct state a = sink("fluid.bulk_modulus=infinite", NULL), b = sink("fluid.bulk_modulus=1e13", NULL);
  ck_assert_double_lt(difference(a.x, b.x), 1e-5);
  ck_assert_double_lt(difference(a.P, b.P), 1e-5);
}
END_TEST

/* ---- periodic axes ---- */

/* a body that sinks across the seam of a ring does as one that sinks elsewhere */
START_TEST(the_seam_is_nowhere)
{
  static const char *const shapes[] = {
      "solids.block.shape={\"box\": {\"min\": [0.1, 0.3], \"max\": [0.4, 0.9]}}",
      "solids.block.shape={\"union\": [{\"box\": {\"min\": [0.4, 0.3], \"max\": [0.6, 0.9]}}, {\"box\": {\"min\": [0, "
      "0.3], \"max\": [0.1, 0.9]}}]}"};
  struct scene_run runs[2];
  for (int i = 0; i < 2; i++) {
    const char *sets[] = {shapes[i], "start=zero", "numerics.pressure_solver=direct", NULL};
    scene_open_with("{" GRID DOWN MATERIALS BLOCK("soil", "0", "0", "1", "1") WATER(BELOW("1")) RING "}", sets,
                    &runs[i]);
    scene_steps(&runs[i], 100, 1e-3);
  }
  const struct grid *g = &runs[0].sim->grid;
  struct box         cells = grid_cells(g);
  double             apart = 0, size = 0;
  FOR_BOX_SERIAL(g, cells, c)
  {
    int place[3];
    grid_place(g, c, place);
    double here = ice_of(runs[0].sim)->P_cc[c],
           there = ice_of(runs[1].sim)->P_cc[grid_at(g, (place[0] + 3) % 6, place[1], 0)];
    apart = fmax(apart, fabs(here - there));
    size = fmax(size, fabs(here));
  }
  ck_assert_double_gt(fastest_point(&runs[0]), 1e-3);
  ck_assert_double_lt(apart, 1e-10 * size);
  scene_close(&runs[0]);
  scene_close(&runs[1]);
}
END_TEST

/* a column between smooth walls, or a ring of one or two cells: the same column */
START_TEST(thin_rings)
{
  static const char *const width[] = {"grid.max=[0.1, 1.2]", "grid.max=[0.2, 1.2]"};
  static const char *const text = "{" GRID DOWN MATERIALS BLOCK("soil", "null", "0.3", "null", "0.9") WATER(BELOW("1"));
  for (int n = 0; n < 2; n++) {
    const char      *sets[] = {width[n], "start=zero", "fluid.bulk_modulus=1e7", NULL};
    char             open[2048], ring[2048];
    struct scene_run a, b;
    snprintf(open, sizeof open, "%s}", text);
    snprintf(ring, sizeof ring, "%s" RING "}", text);
    scene_open_with(open, sets, &a);
    scene_open_with(ring, sets, &b);
    scene_steps(&a, 100, 1e-3);
    scene_steps(&b, 100, 1e-3);
    ck_assert_double_gt(fastest_point(&a), 1e-3);
    for (int j = 0; j < 10; j++) {
      long   c = grid_at(&a.sim->grid, 0, j, 0);
      double P = ice_of(a.sim)->P_cc[c];
      ck_assert_double_eq_tol(ice_of(b.sim)->P_cc[c], P, 1e-10 * fabs(P));
    }
    scene_close(&a);
    scene_close(&b);
  }
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("ice");
  TCase *tcase = tcase_create("cells");
  tcase_add_loop_test(tcase, still_water_stays, 0, STILL);
  tcase_add_test(tcase, neutral_body_floats);
  tcase_add_test(tcase, nothing_at_all);
  tcase_add_test(tcase, limits_of_drag);
  tcase_add_loop_test(tcase, drag_passes_momentum_on, 0, 2);
  tcase_add_test(tcase, common_motion_goes_on);
  tcase_add_test(tcase, mass_in_a_closed_box);
  tcase_add_loop_test(tcase, outflow_is_counted, 0, 3);
  tcase_add_test(tcase, theta_and_sound);
  tcase_add_test(tcase, solvers_agree);
  tcase_add_test(tcase, infinite_is_the_limit_of_stiff);
  tcase_add_test(tcase, the_seam_is_nowhere);
  tcase_add_test(tcase, thin_rings);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
