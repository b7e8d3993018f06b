/* Transport of a sharp surface: bodies that come back, fronts in pores, drops, walls, symmetry, threads, conservation.
 */
#include "tests/ice/advect.h"

#include "tests/scene_run.h"

static const bool closed[3] = {false, false, false};

/* ---- bodies that come back ---- */

static const struct {
  const struct flow *flow;
  double             error;
} bodies[] = {{&flow_zalesak, 0.02}, {&flow_reversed, 0.0025}};

START_TEST(bodies_come_back)
{
  const struct flow *flow = bodies[_i].flow;
  struct tank        t;
  parallel_set_threads(1);
  must(tank_open(2, (const int[]){100, 100, 1}, 0.01, closed, &t));
  tank_fill(&t, flow);
  long calls = memory_calls();
  int  steps = tank_run(&t, flow, flow->end, 0.5);
  ck_assert_int_eq(memory_calls(), calls);
  struct tank_result r = tank_result(&t);
  printf("%s: %d steps, L1 %.3f %% of its area, area off by %.1e, fill from %.1e to 1 %+.1e, thickness %.2f cells\n",
         flow->name, steps, 100 * r.error, r.drift, t.least, t.most - 1, r.thickness);
  ck_assert_double_lt(r.error, bodies[_i].error);
  ck_assert_double_lt(fabs(r.drift), 1e-13);
  ck_assert_double_ge(t.least, 0);
  ck_assert_double_le(t.most, 1 + 1e-12);
  ck_assert_double_lt(r.thickness, 1.2);
  tank_close(&t);
}
END_TEST

/* ---- a tank of N cells a side ---- */

enum { N = 10 };

static void open_tank(int dim, bool periodic, struct tank *t)
{
  parallel_set_threads(1);
  must(tank_open(dim, (const int[]){N, N, N}, 1, (const bool[]){periodic, periodic, periodic}, t));
}

/* Water drives a flat front along an axis into a tank whose far half is porous, up or down: the front is where the
 * water that came in says. Ghosts of the near side are open and full, those of the far side open and empty. */
START_TEST(fronts_move_into_pores)
{
  int         dim = _i / 6 + 2, axis = _i / 2 % 3, up = _i % 2;
  struct tank t;
  double      came = 0, worst = 0, dt = 0.17, F = 0.8;
  if (axis >= dim) return;
  open_tank(dim, false, &t);
  const struct grid *g = &t.grid;
  struct box         all = grid_all(g), cells = grid_cells(g);
  FOR_BOX_SERIAL(g, all, c)
  {
    int at[3];
    grid_place(g, c, at);
    bool inside = true;
    for (int d = 0; d < dim; d++) inside = inside && (d == axis || (at[d] >= 0 && at[d] < N));
    int from_source = up ? at[axis] : N - 1 - at[axis];
    t.pore[c] = !inside ? 0 : from_source >= N / 2 ? 0.4 : 1;
    t.fill[c] = inside ? from_source < 0 : NAN;
    t.flux[axis][c] = inside ? (up ? F : -F) : 0;
  }
  for (int step = 0; step < 38; step++) {
    plic_begin(&t.plic, t.fill);
    for (int k = 0; k < dim; k++) {
      int a = plic_axis(g, step, k);
      plic_sweep(&t.plic, a, dt, t.flux[a], t.fill, t.passed);
    }
    came += F * dt;
    FOR_BOX_SERIAL(g, cells, c)
    {
      int at[3];
      grid_place(g, c, at);
      int    i = up ? at[axis] : N - 1 - at[axis], near = i < N / 2 ? i : N / 2;
      double before = near + 0.4 * (i - near); /* pores nearer to the source */
      worst = fmax(worst, fabs(t.fill[c] - fmin(1, fmax(0, (came - before) / t.pore[c]))));
    }
  }
  ck_assert_double_lt(worst, 1e-12);
  tank_close(&t);
}
END_TEST

/* water far from other water moves on with the flow, be there ever so little */
START_TEST(drops_travel)
{
  int         dim = _i;
  struct tank t;
  const long  steps = 20;
  double      speed[3] = {0.3, -0.2, 0.25}, moment[3] = {0, 0, 0}, total = 0, dt = 1;
  open_tank(dim, true, &t);
  const struct grid *g = &t.grid;
  struct box         cells = grid_cells(g);
  long               c0 = grid_at(g, 2, 7, dim == 3 ? 2 : 0);
  t.water[c0] = 0.3;
  for (int d = 0; d < dim; d++)
    for (long f = 0; f < g->size; f++) t.flux[d][f] = speed[d];
  for (long s = 0; s < steps; s++) tank_step(&t, s, dt / steps * 10);
  FOR_BOX_SERIAL(g, cells, c)
  {
    double x[3];
    grid_centre(g, c, x);
    total += t.water[c];
    for (int d = 0; d < dim; d++) moment[d] += t.water[c] * x[d];
  }
  double start[3];
  grid_centre(g, c0, start);
  ck_assert_double_eq_tol(total, 0.3, 1e-15);
  for (int d = 0; d < dim; d++) ck_assert_double_eq_tol(moment[d] / total, start[d] + speed[d] * 10, 0.3);
  tank_close(&t);
}
END_TEST

/* random flow without divergence past closed cells, from a stream function that is constant in them; in 3D in planes */
static void random_flow(struct tank *t, unsigned short state[3], double courant)
{
  const struct grid *g = &t->grid;
  static double      stream[N + 1][N + 1];
  for (int j = 0; j <= N; j++)
    for (int i = 0; i <= N; i++) {
      bool wall = i == 0 || i == N || j == 0 || j == N, block = i >= 3 && i <= 5 && j >= 3 && j <= 7;
      stream[j][i] = wall ? 0 : block ? 0.1 * courant : 0.25 * courant * (2 * erand48(state) - 1);
    }
  for (int k = 0; k < g->n[2]; k++)
    for (int j = 0; j <= N; j++)
      for (int i = 0; i <= N; i++) {
        long f = grid_at(g, i, j, k);
        if (j < N) t->flux[0][f] = stream[j + 1][i] - stream[j][i];
        if (i < N) t->flux[1][f] = stream[j][i] - stream[j][i + 1];
      }
}

static void random_water(struct tank *t, unsigned short state[3])
{
  const struct grid *g = &t->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX_SERIAL(g, cells, c)
  {
    int at[3];
    grid_place(g, c, at);
    bool block = at[0] >= 3 && at[0] < 5 && at[1] >= 3 && at[1] < 7;
    t->pore[c] = block ? 0 : 0.5 + 0.5 * erand48(state);
    t->water[c] = t->pore[c] * fmin(1, fmax(0, 2 * erand48(state) - 0.5));
  }
}

static double water_of(const struct tank *t)
{
  struct box  cells = grid_cells(&t->grid);
  long double total = 0;
  FOR_BOX_SERIAL(&t->grid, cells, c) total += t->water[c];
  return (double)total;
}

START_TEST(flow_without_divergence_neither_makes_nor_overfills)
{
  int            dim = _i;
  struct tank    t;
  unsigned short state[3] = {1, 2, 3};
  open_tank(dim, false, &t);
  random_water(&t, state);
  double before = water_of(&t);
  for (int s = 0; s < 300; s++) {
    random_flow(&t, state, 1);
    tank_step(&t, s, 0.5); /* up to half a cell along each axis, as pores are at least half a cell */
    tank_bounds(&t);
  }
  ck_assert_double_eq_tol(water_of(&t), before, 1e-14 * before);
  ck_assert_double_ge(t.least, -1e-15);
  ck_assert_double_le(t.most, 1 + 1e-13);
  tank_close(&t);
}
END_TEST

/* any fluxes, however large: what passes a face is no more than its donor held and no more than the flux, and water
 * stays what it is in all */
START_TEST(passed_is_limited_by_donor_and_flux)
{
  int            dim = _i;
  struct tank    t;
  unsigned short state[3] = {3, 2, 1};
  open_tank(dim, false, &t);
  const struct grid *g = &t.grid;
  struct box         cells = grid_cells(g);
  random_water(&t, state);
  double before = water_of(&t), over = 0;
  for (int s = 0; s < 100; s++) {
    int        axis = s % dim;
    long       st = g->stride[axis];
    struct box faces = grid_faces(g, axis);
    FOR_BOX_SERIAL(g, cells, c) t.fill[c] = t.pore[c] > 0 ? t.water[c] / t.pore[c] : NAN;
    FOR_BOX_SERIAL(g, faces, f)
    {
      bool open = t.pore[f] > 0 && t.pore[f - st] > 0;
      t.flux[axis][f] = open ? pow(2 * erand48(state) - 1, 5) : 0;
    }
    plic_begin(&t.plic, t.fill);
    plic_sweep(&t.plic, axis, 1.5, t.flux[axis], t.fill, t.passed);
    FOR_BOX_SERIAL(g, faces, f)
    {
      double v = 1.5 * t.flux[axis][f], passed = v > 0 ? t.passed[f] : -t.passed[f];
      double held = fmax(0, v > 0 ? t.water[f - st] : t.water[f]);
      over = fmax(over, isnan(passed) ? INFINITY : fmax(-passed, passed - fmin(fabs(v), held)));
    }
    FOR_BOX_SERIAL(g, cells, c) t.water[c] -= t.passed[c + st] - t.passed[c];
  }
  ck_assert_double_lt(over, 1e-15);
  ck_assert_double_eq_tol(water_of(&t), before, 1e-14 * before);
  tank_close(&t);
}
END_TEST

/* ---- the same bits ---- */

static void run_random(struct tank *t, int threads)
{
  unsigned short state[3] = {5, 5, 5};
  open_tank(3, false, t);
  random_water(t, state);
  parallel_set_threads(threads);
  for (int s = 0; s < 30; s++) {
    random_flow(t, state, 0.5);
    tank_step(t, s, 0.5);
  }
}

START_TEST(any_number_of_threads)
{
  struct tank one, more;
  run_random(&one, 1);
  for (int threads = 2; threads <= 4; threads += 2) {
    run_random(&more, threads);
    ck_assert_mem_eq(one.water, more.water, (size_t)one.grid.size * sizeof *one.water);
    ck_assert_mem_eq(one.passed, more.passed, (size_t)one.grid.size * sizeof *one.passed);
    tank_close(&more);
  }
  tank_close(&one);
}
END_TEST

/* mirrored across x or y, axes exchanged: 2D */
START_TEST(mirrored_and_turned_flow)
{
  int            turn = _i, swap = turn >> 2, axis[2] = {swap, 1 - swap};
  unsigned short state[3] = {6, 7, 8};
  struct tank    t, u;
  open_tank(2, false, &t);
  open_tank(2, false, &u);
  random_water(&t, state);
  for (int s = 0; s < 20; s++) {
    random_flow(&t, state, 0.5);
    for (int j = 0; j <= N; j++)
      for (int i = 0; i <= N; i++) {
        const int at[2] = {i, j};
        int       cell[2], face[2];
        for (int d = 0; d < 2; d++) cell[axis[d]] = turn >> d & 1 ? N - 1 - at[d] : at[d];
        long c = grid_at(&t.grid, i, j, 0);
        if (i < N && j < N && s == 0) {
          u.pore[grid_at(&u.grid, cell[0], cell[1], 0)] = t.pore[c];
          u.water[grid_at(&u.grid, cell[0], cell[1], 0)] = t.water[c];
        }
        for (int a = 0; a < 2; a++) {
          if (at[1 - a] == N) continue;
          bool mirror = turn >> a & 1;
          face[axis[a]] = cell[axis[a]] + (mirror ? 1 : 0);
          face[axis[1 - a]] = cell[axis[1 - a]];
          u.flux[axis[a]][grid_at(&u.grid, face[0], face[1], 0)] = (mirror ? -1 : 1) * t.flux[a][c];
        }
      }
    tank_step(&t, s, 0.5);
    tank_step(&u, s + swap, 0.5);
  }
  for (int j = 0; j < N; j++)
    for (int i = 0; i < N; i++) {
      const int at[2] = {i, j};
      int       cell[2];
      for (int d = 0; d < 2; d++) cell[axis[d]] = turn >> d & 1 ? N - 1 - at[d] : at[d];
      ck_assert_double_eq(u.water[grid_at(&u.grid, cell[0], cell[1], 0)], t.water[grid_at(&t.grid, i, j, 0)]);
    }
  tank_close(&t);
  tank_close(&u);
}
END_TEST

/* each axis once a step, and every order once in as many steps as there are */
START_TEST(orders_alternate)
{
  for (int dim = 2; dim <= 3; dim++) {
    struct grid g = {.dim = dim};
    int         seen[64] = {0}, orders = dim == 2 ? 2 : 6;
    for (long step = 0; step < orders; step++) {
      int axes = 0, code = 0;
      for (int k = 0; k < dim; k++) {
        axes |= 1 << plic_axis(&g, step, k);
        code = 4 * code + plic_axis(&g, step, k);
      }
      ck_assert_int_eq(axes, (1 << dim) - 1);
      ck_assert_int_eq(seen[code]++, 0);
    }
  }
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("plic_sweep");
  TCase *tcase = tcase_create("plic_sweep");
  tcase_add_loop_test(tcase, bodies_come_back, 0, 2);
  tcase_add_loop_test(tcase, fronts_move_into_pores, 0, 12);
  tcase_add_loop_test(tcase, drops_travel, 2, 4);
  tcase_add_loop_test(tcase, flow_without_divergence_neither_makes_nor_overfills, 2, 4);
  tcase_add_loop_test(tcase, passed_is_limited_by_donor_and_flux, 2, 4);
  tcase_add_test(tcase, any_number_of_threads);
  tcase_add_loop_test(tcase, mirrored_and_turned_flow, 1, 8);
  tcase_add_test(tcase, orders_alternate);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
