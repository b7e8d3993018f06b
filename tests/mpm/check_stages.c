/* The stages of the solid through small scenes whose answer is known. */
#include "mpm/stages.h"

#include "constitutive/constitutive.h"
#include "tests/scene_run.h"

/* a block that touches nothing, at rest, unstressed, of 10 x 6 cells */
#define BLOCK                                                                                                          \
  "{\"grid\": {\"min\": [-1, 0], \"max\": [1, 2], \"h\": 0.1}, \"time\": {\"end\": 1}, \"start\": \"zero\","           \
  "\"materials\": {\"m\": {\"model\": \"linear_elastic\", \"young\": 1e6, \"poisson\": 0.3, \"density\": 1000}},"      \
  "\"solids\": {\"block\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [-0.5, 1], \"max\": [0.5, 1.6]}}}}"

static const char *const transfers[] = {"numerics.transfer=pic", "numerics.transfer=flip", "numerics.transfer=apic",
                                        "numerics.transfer=aflip"};
static const char *const bases[] = {"numerics.basis=linear", "numerics.basis=gimp", "numerics.basis=quadratic",
                                    "numerics.basis=cubic"};

static double largest(const double *v, long n)
{
  double most = 0;
  for (long i = 0; i < n; i++) most = fmax(most, fabs(v[i]));
  return most;
}

/* ---- free fall ---- */

/* tolerance: of velocities, m/s. At the end of GIMP's support weights fall with the square of the distance and their
 * slopes do not: the round-off of stresses is amplified there. */
static void falls(const char *const *sets, bool three, double tolerance)
{
  static const char flat[] = BLOCK ", \"gravity\": [\"3*t\", -9.81], \"tracers\": {\"corner\": [0.5, 1]}}";
  static const char deep[] =
      "{\"grid\": {\"min\": [-1, 0, 0], \"max\": [1, 2, 1], \"h\": 0.2}, \"time\": {\"end\": 1}, \"start\": \"zero\","
      "\"materials\": {\"m\": {\"model\": \"neo_hookean\", \"young\": 1e6, \"poisson\": 0.3, \"density\": 1000}},"
      "\"solids\": {\"block\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [-0.4, 1, 0.4], \"max\": [0.4, "
      "1.6, 0.6]}}}}, \"tracers\": {\"corner\": [0.4, 1, 0.4]}, \"gravity\": [\"3*t\", -9.81, 0]}";
  struct scene_run run;
  double           vx = 0, vy = 0, sx = 0, sy = 0;
  scene_open_with(three ? deep : flat, sets, &run);
  const struct mpm *m = mpm_of(run.sim);
  int               dim = run.sim->grid.dim;
  for (int i = 0; i < 40; i++) {
    double t = run.sim->t, dt = scene_step(&run, 1e-3);
    vx += dt * 3 * (t + 0.5 * dt);
    vy -= dt * 9.81;
    sx += dt * vx;
    sy += dt * vy;
  }
  for (long p = 0; p < m->points->n; p++) {
    ck_assert_double_eq_tol(m->vel_p[p * dim], vx, tolerance);
    ck_assert_double_eq_tol(m->vel_p[p * dim + 1], vy, tolerance);
    ck_assert_double_eq_tol(m->displacement_p[p * dim], sx, tolerance);
    ck_assert_double_eq_tol(m->displacement_p[p * dim + 1], sy, tolerance);
  }
  ck_assert_double_lt(largest(m->stress_p, 6 * m->points->n), 1e6 * tolerance); /* the modulus is 1e6 */
  ck_assert_double_eq_tol(m->x_m[0], m->x0_m[0] + sx, tolerance);
  ck_assert_double_eq_tol(m->x_m[1], m->x0_m[1] + sy, tolerance);
  scene_close(&run);
}

START_TEST(free_fall_is_exact)
{
  for (int basis = 0; basis < 4; basis++)
    for (int musl = 0; musl < 2; musl++) {
      const char *sets[] = {transfers[_i], bases[basis], musl ? "numerics.stress_timing=musl" : NULL, NULL};
      double      tolerance = basis == BASIS_GIMP ? 1e-7 : 1e-13;
      falls(sets, false, tolerance);
      if (!musl) falls(sets, true, tolerance);
    }
}
END_TEST

/* ---- blends ---- */

START_TEST(blend_of_a_step)
{
  const double     exact[] = {1, 0, 1, 0.3};
  const char      *sets[] = {transfers[_i], "numerics.aflip_beta=0.3", NULL};
  struct scene_run run;
  scene_open_with(BLOCK "}", sets, &run);
  double dt = scene_step(&run, INFINITY);
  ck_assert_double_eq_tol(mpm_blend(run.sim, dt), exact[_i], 1e-15);
  double half = mpm_blend(run.sim, 0.5 * dt); /* two half steps damp as much as one */
  ck_assert_double_eq_tol((1 - half) * (1 - half), 1 - exact[_i], 1e-15);
  scene_close(&run);
}
END_TEST

/* velocities that vary from point to point, without a force: what each transfer leaves of them after a step */
START_TEST(transfers_of_noise)
{
  const char      *sets[] = {transfers[_i], "numerics.aflip_beta=0.25",
                             "solids.block.velocity=[\"0.1*sin(40*x)*cos(50*y)\", 0.2]", NULL};
  struct scene_run run;
  scene_open_with(BLOCK "}", sets, &run);
  const struct mpm *m = mpm_of(run.sim);
  long              n = m->points->n;
  double            v[2 * 4 * 60], gathered[4 * 60];
  ck_assert_int_eq(n, 4 * 60);
  memcpy(v, m->vel_p, sizeof v);
  scene_step_to(&run, INFINITY, "mpm.advance_nodes");
  struct gather_args args = {.n = 1, .x = m->x_p, .node = {m->vel_new_nc}, .stride = {2}, .value = {gathered}};
  FOR_RUNS(m->points, &run.sim->grid, part, group) m->kernels->gather(&m->kernel_grid, &part, &args);
  must(mpm_nodes_to_points(run.sim, run.sim->dt));
  const double share[] = {1, 0, 1, 0.25}; /* of the nodal velocity */
  double       moved = 0;
  for (long p = 0; p < n; p++) {
    ck_assert_double_eq_tol(m->vel_p[2 * p], share[_i] * gathered[p] + (1 - share[_i]) * v[2 * p], 1e-15);
    moved = fmax(moved, fabs(m->vel_p[2 * p] - v[2 * p]));
  }
  if (_i == TRANSFER_FLIP)
    ck_assert_double_lt(moved, 1e-15);
  else
    ck_assert_double_gt(moved, 1e-3);
  scene_close(&run);
}
END_TEST

/* ---- momentum ---- */

#define SPIN "solids.block.velocity=[\"1 - 5*(y - 1.3) + 2*x*x\", \"5*x - 2\"]"

/* the linear basis is left out: its slopes do not vanish with its weights, nodes of little mass are thrown about */
START_TEST(momentum_is_kept)
{
  for (int basis = BASIS_GIMP; basis < 4; basis++)
    for (int musl = 0; musl < 2; musl++) {
      const char      *sets[] = {transfers[_i], bases[basis], SPIN, musl ? "numerics.stress_timing=musl" : NULL, NULL};
      struct scene_run run;
      scene_open_with(BLOCK "}", sets, &run);
      struct ledger before = scene_ledger(&run);
      scene_steps(&run, 60, INFINITY);
      struct ledger after = scene_ledger(&run);
      for (int d = 0; d < 2; d++)
        ck_assert_double_eq_tol(after.v[LEDGER_momentum_x + d], before.v[LEDGER_momentum_x + d],
                                1e-11 * before.v[LEDGER_momentum_x]); /* nodes below mpm's mass_floor take a trace */
      ck_assert_double_eq(after.v[LEDGER_mass_solid], before.v[LEDGER_mass_solid]);
      ck_assert_double_gt(fabs(before.v[LEDGER_momentum_x]), 100);
      scene_close(&run);
    }
}
END_TEST

/* the splines' affine transfers keep angular momentum too */
START_TEST(angular_momentum_is_kept)
{
  for (int basis = BASIS_QUADRATIC; basis <= BASIS_CUBIC; basis++) {
    const char      *sets[] = {"numerics.transfer=apic", bases[basis], SPIN, NULL};
    struct scene_run run;
    scene_open_with(BLOCK "}", sets, &run);
    struct ledger before = scene_ledger(&run);
    scene_steps(&run, 60, INFINITY);
    struct ledger after = scene_ledger(&run);
    ck_assert_double_gt(fabs(before.v[LEDGER_angular_z]), 100);
    ck_assert_double_eq_tol(after.v[LEDGER_angular_z], before.v[LEDGER_angular_z],
                            1e-11 * fabs(before.v[LEDGER_angular_z]));
    scene_close(&run);
  }
}
END_TEST

/* ---- strain ---- */

/* one step of a linear velocity field strains by I + dt L; MUSL, which looks again, to second order in dt L. Only laws
 * that ask for F have it. */
START_TEST(strain_of_a_linear_field)
{
  static const double L[2][2] = {{3, -5}, {4, -2}};
  static const char  *laws[] = {"materials.m.model=linear_elastic", "materials.m.model=neo_hookean"};
  for (int basis = 0; basis < 4; basis++)
    for (int musl = 0; musl < 2; musl++) {
      const char      *sets[] = {"numerics.transfer=apic",
                                 bases[basis],
                                 laws[_i],
                                 "solids.block.velocity=[\"3*x - 5*y\", \"4*x - 2*y\"]",
                            musl ? "numerics.stress_timing=musl" : NULL,
                                 NULL};
      struct scene_run run;
      scene_open_with(BLOCK "}", sets, &run);
      const struct mpm *m = mpm_of(run.sim);
      double            tolerance = musl ? 25e-6 : 1e-14, dt = scene_step(&run, 1e-3),
             J = (1 + dt * L[0][0]) * (1 + dt * L[1][1]) - dt * dt * L[0][1] * L[1][0];
      ck_assert(_i == 1 || !m->F_p);
      for (long p = 0; p < m->points->n; p++) {
        for (int q = 0; q < 4 && _i == 1; q++)
          ck_assert_double_eq_tol(m->F_p[4 * p + q], (q % 3 == 0) + dt * L[q / 2][q % 2], tolerance);
        ck_assert_double_eq_tol(m->volume_p[p], 0.0025 * J, 0.0025 * 2 * tolerance);
      }
      scene_close(&run);
    }
}
END_TEST

/* points that are strained as soon as they have moved end up with the bits of those that first move all of them */
START_TEST(strained_at_once)
{
  const char      *sets[] = {"solids.block.velocity=[\"sin(9*y)\", \"cos(7*x)\"]", NULL};
  struct scene_run at_once, apart;
  scene_open_with(BLOCK "}", sets, &at_once);
  scene_open_with(BLOCK "}", sets, &apart);
  struct mpm *m = mpm_of(at_once.sim), *other = mpm_of(apart.sim);
  ck_assert_ptr_null(other->gradv_p);
  must(NEW(&other->gradv_p, 4 * other->points->n));
  for (int i = 0; i < 20; i++) {
    scene_step(&at_once, INFINITY);
    double dt = scene_step_to(&apart, INFINITY, "mpm.advance_nodes");
    must(mpm_nodes_to_points(apart.sim, dt));
    must(mpm_update_stress(apart.sim, dt));
  }
  ck_assert_mem_eq(m->x_p, other->x_p, (size_t)(2 * m->points->n) * sizeof(double));
  ck_assert_mem_eq(m->stress_p, other->stress_p, (size_t)(6 * m->points->n) * sizeof(double));
  ck_assert_mem_eq(&m->now, &other->now, sizeof m->now);
  memory_free(&other->gradv_p);
  scene_close(&at_once);
  scene_close(&apart);
}
END_TEST

/* ---- loads and markers ---- */

#define LOADED                                                                                                         \
  BLOCK ", \"loads\": {\"top\": {\"on\": {\"box\": {\"min\": [-0.5, 1.6], \"max\": [0.5, 1.6]}}, \"traction\": [200, " \
        "\"-1e3*(1 + x)\"]}, \"side\": {\"on\": {\"box\": {\"min\": [0.5, 1], \"max\": [0.5, 1.6]}}, \"pressure\": "   \
        "3e3}}, \"tracers\": {\"corner\": [-0.5, 1.6], \"inside\": [0.03, 1.21]}}"

/* total force and moment of the loads arrive at the nodes */
START_TEST(loads_arrive_whole)
{
  for (int basis = 0; basis < 4; basis++) {
    const char      *sets[] = {bases[basis], NULL};
    struct scene_run run;
    scene_open_with(LOADED, sets, &run);
    const struct mpm *m = mpm_of(run.sim);
    scene_step_to(&run, 1e-4, "mpm.load_surfaces");
    double force[2] = {0}, moment = 0, x[3];
    for (long c = 0; c < run.sim->grid.size; c++) {
      grid_node(&run.sim->grid, c, x);
      for (int d = 0; d < 2; d++) force[d] += m->force_nc[2 * c + d];
      moment += x[0] * m->force_nc[2 * c + 1] - x[1] * m->force_nc[2 * c];
    }
    double n = 40, lever = 0; /* the linear part, at the middle of 40 pieces */
    for (int i = 0; i < n; i++) {
      double at = -0.5 + (i + 0.5) / n;
      lever -= at * 1e3 * (1 + at) / n;
    }
    ck_assert_double_eq_tol(force[0], 200 - 3e3 * 0.6, 1e-9);
    ck_assert_double_eq_tol(force[1], -1e3, 1e-9);
    ck_assert_double_eq_tol(moment, lever - 1.6 * 200 + 1.3 * 3e3 * 0.6, 1e-9);
    scene_close(&run);
  }
}
END_TEST

/* a strip that walls or a periodic axis hold between them, pushed aside on its whole top */
#define STRIP                                                                                                          \
  "{\"grid\": {\"min\": [0, 0], \"max\": [0.4, 2], \"h\": 0.1}, \"time\": {\"end\": 1}, \"start\": \"zero\","          \
  "\"materials\": {\"m\": {\"model\": \"linear_elastic\", \"young\": 1e6, \"poisson\": 0.3, \"density\": 1000}},"      \
  "\"solids\": {\"strip\": {\"material\": \"m\", \"shape\": {\"box\": {\"min\": [null, 0.5], \"max\": [null, 1.5]}},"  \
  "\"velocity\": [\"0.1*sin(9*x)\", \"0.1*cos(7*x)\"]}}, \"loads\": {\"top\": {\"on\": {\"box\": {\"min\": [null, "    \
  "1.5], \"max\": [null, 1.5]}}, \"traction\": [\"1e3*(1 + x)\", \"-1e3*x\"]}}"

/* work of the loads is what their nodal forces do on the nodal velocities: markers push and ride with the same weights
 */
START_TEST(work_of_loads)
{
  static const char *const scenes[] = {LOADED, STRIP "}",
                                       STRIP ", \"boundary\": {\"solid\": {\"x_min\": \"no_slip\"}}}",
                                       STRIP ", \"boundary\": {\"solid\": {\"x_min\": \"periodic\", \"x_max\": "
                                             "\"periodic\"}}}"};
  for (int basis = 0; basis < 4; basis++) {
    const char      *sets[] = {bases[basis], NULL};
    struct scene_run run;
    double           work = 0;
    scene_open_with(scenes[_i], sets, &run);
    const struct mpm *m = mpm_of(run.sim);
    double            dt = scene_step_to(&run, INFINITY, "mpm.move_markers");
    struct box        nodes = grid_nodes(&run.sim->grid);
    FOR_BOX_SERIAL(&run.sim->grid, nodes, c) /* unstressed still: all force is load */
    for (int d = 0; d < 2; d++) work += dt * m->force_nc[2 * c + d] * m->vel_new_nc[2 * c + d];
    ck_assert_double_gt(fabs(work), 1e-3);
    ck_assert_double_eq_tol(m->now.work_loads, work, 1e-12 * fabs(work));
    scene_close(&run);
  }
}
END_TEST

/* and over a run it is the energy that the body gained */
START_TEST(work_is_energy)
{
  const char      *sets[] = {"numerics.transfer=flip", "numerics.dt_max=5e-5", NULL};
  struct scene_run run;
  scene_open_with(LOADED, sets, &run);
  scene_steps(&run, 400, INFINITY);
  struct ledger l = scene_ledger(&run);
  double        gained = l.v[LEDGER_kinetic_solid] + l.v[LEDGER_elastic];
  ck_assert_double_gt(l.v[LEDGER_elastic], 0.02 * gained);
  ck_assert_double_eq_tol(gained, l.v[LEDGER_work_loads], 0.02 * gained);
  scene_close(&run);
}
END_TEST

/* markers and tracers on faces and corners ride on a linear velocity field as if the body did not end there */
START_TEST(markers_on_a_linear_field)
{
  for (int basis = 0; basis < 4; basis++) {
    const char      *sets[] = {"numerics.transfer=apic",
                               bases[basis],
                               "loads.top.traction=[0, 0]",
                               "loads.side.pressure=0",
                               "solids.block.velocity=[\"3*x - 5*y + 1\", \"4*x - 2*y\"]",
                               NULL};
    struct scene_run run;
    scene_open_with(LOADED, sets, &run);
    const struct mpm *m = mpm_of(run.sim);
    double            dt = scene_step(&run, 1e-3);
    for (int i = 0; i < m->n_markers; i++) {
      const double *x0 = m->x0_m + 2 * i;
      ck_assert_double_eq_tol(m->x_m[2 * i], x0[0] + dt * (3 * x0[0] - 5 * x0[1] + 1), 1e-12);
      ck_assert_double_eq_tol(m->x_m[2 * i + 1], x0[1] + dt * (4 * x0[0] - 2 * x0[1]), 1e-12);
    }
    scene_close(&run);
  }
}
END_TEST

START_TEST(markers_are_found_by_name)
{
  struct scene_run run;
  long             first, end;
  scene_open(LOADED, &run);
  mpm_marker_range(run.sim, "top", &first, &end);
  ck_assert_int_eq(end - first, 40);
  mpm_marker_range(run.sim, "side", &first, &end);
  ck_assert_int_eq(first, 40);
  ck_assert_int_eq(end - first, 24);
  mpm_marker_range(run.sim, "inside", &first, &end);
  ck_assert_int_eq(end - first, 1);
  ck_assert_double_eq(mpm_of(run.sim)->x_m[2 * first], 0.03);
  mpm_marker_range(run.sim, "nobody", &first, &end);
  ck_assert_int_eq(end, 0);
  scene_close(&run);
}
END_TEST

/* ---- held material ---- */

#define HELD                                                                                                           \
  "{\"grid\": {\"min\": [0, 0], \"max\": [2, 2], \"h\": 0.1}, \"time\": {\"end\": 1}, \"start\": \"zero\","            \
  "\"gravity\": [0, -9.81], \"materials\": {\"rock\": {\"model\": \"rigid\", \"density\": 2500},"                      \
  "\"soil\": {\"model\": \"linear_elastic\", \"young\": 1e6, \"poisson\": 0.3, \"density\": 1000}},"                   \
  "\"solids\": {\"bed\": {\"material\": \"rock\", \"shape\": {\"box\": {\"min\": [0, 0], \"max\": [2, 0.5]}}}"

START_TEST(held_points_stay)
{
  struct scene_run run;
  scene_open(HELD ", \"block\": {\"material\": \"soil\", \"shape\": {\"box\": {\"min\": [0.5, 1], \"max\": [1, "
                  "1.5]}}}}}",
             &run);
  const struct mpm *m = mpm_of(run.sim);
  double            dt = scene_step(&run, 1e-3), mass = 0;
  for (long c = 0; c < run.sim->grid.size; c++) mass += isfinite(m->mass_nc[c]) ? m->mass_nc[c] : 0;
  ck_assert_double_eq_tol(mass, 250, 1e-9); /* the rock gives the nodes nothing */
  scene_steps(&run, 20, 1e-3);
  int held = 0;
  for (long p = 0; p < m->points->n; p++) {
    bool rock = run.sim->scene->materials[m->points->group[p]].model->held;
    held += rock;
    ck_assert_double_eq_tol(m->displacement_p[2 * p + 1], rock ? 0 : -9.81 * dt * dt * 21 * 22 / 2, 1e-12);
  }
  ck_assert_int_eq(held, 4 * 20 * 5);
  scene_close(&run);
}
END_TEST

/* where nothing moves nothing is planned */
START_TEST(only_held)
{
  struct scene_run run;
  scene_open(HELD "}}", &run);
  ck_assert_int_eq(run.plan.n_stages, 0);
  ck_assert_ptr_null(mpm_of(run.sim));
  scene_close(&run);
}
END_TEST

/* ---- periodic sides ---- */

/* a body that moves through a periodic side comes in on the other: as if the box did not end */
START_TEST(through_a_periodic_side)
{
  static const char text[] =
      "{\"grid\": {\"min\": [0, 0], \"max\": [2, 2], \"h\": 0.1}, \"time\": {\"end\": 1}, \"start\": \"zero\","
      "\"materials\": {\"m\": {\"model\": \"linear_elastic\", \"young\": 1e5, \"poisson\": 0.3, \"density\": 1000}},"
      "\"boundary\": {\"solid\": {\"x_min\": \"periodic\", \"x_max\": \"periodic\"}}, \"tracers\": {\"front\": [1.8, "
      "1]},"
      "\"solids\": {\"block\": {\"material\": \"m\", \"velocity\": [3, \"0.1*(x - 1.3)\"], \"shape\": {\"box\": "
      "{\"min\": [0.8, 0.6], \"max\": [1.8, 1.2]}}}}}";
  struct scene_run run;
  scene_open(text, &run);
  const struct mpm *m = mpm_of(run.sim);
  struct ledger     before = scene_ledger(&run);
  while (run.sim->t < 1) scene_step(&run, INFINITY);
  struct ledger after = scene_ledger(&run);
  for (int d = 0; d < 2; d++)
    ck_assert_double_eq_tol(after.v[LEDGER_momentum_x + d], before.v[LEDGER_momentum_x + d], 1e-9);
  double length = run.sim->grid.n[0] * run.sim->grid.h;
  points_wrap(&run.sim->grid, m->points->n, m->x_p); /* the next step would do so first */
  for (long p = 0; p < m->points->n; p++) {
    double turns = (0.05 + m->x_p[2 * p] - 0.05 - m->displacement_p[2 * p]) / length;
    ck_assert(m->x_p[2 * p] >= 0 && m->x_p[2 * p] < length && turns > -2 && turns < 1);
  }
  ck_assert_double_eq_tol(m->x_m[0], 1.8 + 3 * run.sim->t, 0.02); /* counts its turns */
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("stages");
  TCase *tcase = tcase_create("solid");
  tcase_add_loop_test(tcase, free_fall_is_exact, 0, 4);
  tcase_add_loop_test(tcase, blend_of_a_step, 0, 4);
  tcase_add_loop_test(tcase, transfers_of_noise, 0, 4);
  tcase_add_loop_test(tcase, momentum_is_kept, 0, 4);
  tcase_add_test(tcase, angular_momentum_is_kept);
  tcase_add_loop_test(tcase, strain_of_a_linear_field, 0, 2);
  tcase_add_test(tcase, strained_at_once);
  tcase_add_test(tcase, loads_arrive_whole);
  tcase_add_loop_test(tcase, work_of_loads, 0, 4);
  tcase_add_test(tcase, work_is_energy);
  tcase_add_test(tcase, markers_on_a_linear_field);
  tcase_add_test(tcase, markers_are_found_by_name);
  tcase_add_test(tcase, held_points_stay);
  tcase_add_test(tcase, only_held);
  tcase_add_test(tcase, through_a_periodic_side);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
