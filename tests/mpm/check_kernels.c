/* The loops between points and nodes, for every dimension and basis: what must hold exactly. */
#include "tests/mpm/kernel_bench.h"

static void p2g(struct bench *b, bool affine)
{
  const struct p2g_args args = {.x = b->x,
                                .vel = b->vel,
                                .affine = affine ? b->affine : NULL,
                                .mass = b->mass,
                                .volume = b->volume,
                                .stress = b->stress,
                                .mass_nc = b->mass_nc,
                                .mom_nc = b->mom_nc,
                                .force_nc = b->force_nc};
  FOR_RUNS(b->points, &b->kg.g, run, group) b->k->p2g(&b->kg, &run, &args);
}

static void gather(struct bench *b, const double *node, double *value, double *gradient)
{
  const struct gather_args args = {.n = 1, .x = b->x, .node = {node}, .value = {value}, .gradient = {gradient}};
  FOR_RUNS(b->points, &b->kg.g, run, group) b->k->gather(&b->kg, &run, &args);
}

/* ---- nodes to points ---- */

static double linear_field(const double *x, int dim) { return 3 + 2 * x[0] - 5 * x[1] + (dim == 3 ? 7 * x[2] : 0); }

static void reproduces(int variant, int wall_basis, double away)
{
  static const double slope[3] = {2, -5, 7};
  struct bench        b;
  create(variant, wall_basis, away, &b);
  struct box all = grid_all(&b.kg.g);
  FOR_BOX_SERIAL(&b.kg.g, all, c)
  {
    double x[3];
    int    place[3];
    bool   ghost = false;
    grid_node(&b.kg.g, c, x);
    grid_place(&b.kg.g, c, place);
    for (int d = 0; d < b.dim; d++) ghost = ghost || place[d] < 0 || place[d] > b.kg.g.n[d];
    b.mass_nc[c] = ghost && wall_basis == WALL_MODIFIED ? 1e9 : linear_field(x, b.dim);
  }
  gather(&b, b.mass_nc, b.mass, b.affine);
  for (long p = 0; p < N; p++) {
    ck_assert_double_eq_tol(b.mass[p], linear_field(b.x + p * b.dim, b.dim), 1e-12);
    for (int d = 0; d < b.dim; d++) ck_assert_double_eq_tol(b.affine[p * b.dim + d], slope[d], 1e-11);
  }
  destroy(&b);
}

START_TEST(linear_fields_inside) { reproduces(_i, WALL_MIRRORED, 1.5); }
END_TEST
/* ghosts hold nonsense: modified functions do not look at them */
START_TEST(linear_fields_up_to_modified_walls) { reproduces(_i, WALL_MODIFIED, 0); }
END_TEST

/* components of vectors, gradients as rows of matrices, several scalars at once */
START_TEST(gather_strides)
{
  struct bench b;
  unsigned     seed = 2;
  create(_i, WALL_MIRRORED, 0, &b);
  int dim = b.dim;
  for (long q = 0; q < dim * b.kg.g.size; q++) b.mom_nc[q] = next_random(&seed);
  struct gather_args args = {.n = dim, .x = b.x, .gradient_stride = dim * dim};
  for (int d = 0; d < dim; d++) {
    args.node[d] = b.mom_nc + d;
    args.stride[d] = dim;
    args.value[d] = b.vel + (long)d * N;
    args.gradient[d] = b.affine + d * dim;
  }
  FOR_RUNS(b.points, &b.kg.g, run, group) b.k->gather(&b.kg, &run, &args);
  for (int d = 0; d < dim; d++) {
    for (long c = 0; c < b.kg.g.size; c++) b.mass_nc[c] = b.mom_nc[c * dim + d];
    gather(&b, b.mass_nc, b.mass, b.stress);
    for (long p = 0; p < N; p++) {
      ck_assert_double_eq(b.mass[p], b.vel[(long)d * N + p]);
      for (int e = 0; e < dim; e++) ck_assert_double_eq(b.stress[p * dim + e], b.affine[(p * dim + d) * dim + e]);
    }
  }
  destroy(&b);
}
END_TEST

/* ---- points to nodes ---- */

static double sum_of(const struct bench *b, const double *field, int n, int component)
{
  double sum = 0;
  for (long c = 0; c < b->kg.g.size; c++) sum += field[c * n + component];
  return sum;
}

/* sum of x_a f_b - x_b f_a over nodes */
static double moment_of(const struct bench *b, const double *field, int a, int c)
{
  double sum = 0, x[3];
  for (long i = 0; i < b->kg.g.size; i++) {
    grid_node(&b->kg.g, i, x);
    sum += x[a] * field[i * b->dim + c] - x[c] * field[i * b->dim + a];
  }
  return sum;
}

START_TEST(mass_and_momentum_are_kept)
{
  for (int affine = 0; affine < 2; affine++) {
    struct bench b;
    create(_i, WALL_MIRRORED, 0, &b);
    double mass = 0, mom[3] = {0};
    for (long p = 0; p < N; p++) {
      mass += b.mass[p];
      for (int d = 0; d < b.dim; d++) mom[d] += b.mass[p] * b.vel[p * b.dim + d];
    }
    p2g(&b, affine);
    ck_assert_double_eq_tol(sum_of(&b, b.mass_nc, 1, 0), mass, 1e-11);
    for (int d = 0; d < b.dim; d++) {
      ck_assert_double_eq_tol(sum_of(&b, b.mom_nc, b.dim, d), mom[d], 1e-11);
      ck_assert_double_eq_tol(sum_of(&b, b.force_nc, b.dim, d), 0, 1e-12);
    }
    destroy(&b);
  }
}
END_TEST

/* second moment of the weights of a point along an axis, m2 */
static double second_moment(const struct bench *b, const double *x, int axis)
{
  long   node[MAX_SUPPORT];
  double w[MAX_SUPPORT], at[3], sum = 0;
  b->k->weights(&b->kg, x, node, w, NULL);
  for (int q = 0; q < b->k->n_support; q++) {
    grid_node(&b->kg.g, node[q], at);
    sum += w[q] * (at[axis] - x[axis]) * (at[axis] - x[axis]);
  }
  return sum;
}

/* spin in the matrix C counts with the second moments; symmetric stress turns nothing */
START_TEST(angular_momentum_is_kept)
{
  struct bench b;
  create(_i, WALL_MIRRORED, 2, &b);
  p2g(&b, true);
  for (int a = 0; a < b.dim; a++)
    for (int c = a + 1; c < b.dim; c++) {
      double exact = 0;
      for (long p = 0; p < N; p++) {
        const double *x = b.x + p * b.dim, *v = b.vel + p * b.dim, *C = b.affine + p * b.dim * b.dim;
        exact += b.mass[p] * (x[a] * v[c] - x[c] * v[a] + second_moment(&b, x, a) * C[c * b.dim + a] -
                              second_moment(&b, x, c) * C[a * b.dim + c]);
      }
      ck_assert_double_eq_tol(moment_of(&b, b.mom_nc, a, c), exact, 1e-11);
      ck_assert_double_eq_tol(moment_of(&b, b.force_nc, a, c), 0, 1e-12);
    }
  destroy(&b);
}
END_TEST

/* D of T(28), where it is a constant */
START_TEST(the_moment_of_splines)
{
  struct bench b;
  create(_i, WALL_MIRRORED, 2, &b);
  for (long p = 0; p < N && b.k->moment > 0; p++)
    for (int d = 0; d < b.dim; d++)
      ck_assert_double_eq_tol(second_moment(&b, b.x + p * b.dim, d), b.k->moment * b.kg.g.h * b.kg.g.h, 1e-15);
  destroy(&b);
}
END_TEST

/* the tiles of blocks against plain sums of weights, with points as far out of their block as they may go */
START_TEST(tiles_are_plain_sums)
{
  struct bench b;
  unsigned     seed = 8;
  create(_i, WALL_MIRRORED, 0, &b);
  const struct grid *g = &b.kg.g;
  double            *plain;
  must(NEW(&plain, g->size));
  for (long q = 0; q < N * b.dim; q++) {
    int d = (int)(q % b.dim);
    b.x[q] += 0.999 * g->h * (2 * next_random(&seed) - 1);
    b.x[q] = fmin(fmax(b.x[q], g->min[d]), g->min[d] + g->n[d] * g->h * (1 - 1e-12));
  }
  ck_assert(!points_need_sort(g, b.points, b.x));
  struct scatter_args args = {
      .n = 2, .x = b.x, .weight = b.mass, .value = {b.volume}, .factor = {0, -2}, .node = {b.mass_nc, b.vel_nc}};
  FOR_RUNS(b.points, g, run, group) b.k->scatter(&b.kg, &run, &args);
  for (long p = 0; p < N; p++) {
    long   node[MAX_SUPPORT];
    double w[MAX_SUPPORT];
    b.k->weights(&b.kg, b.x + p * b.dim, node, w, NULL);
    for (int q = 0; q < b.k->n_support; q++) plain[node[q]] += w[q] * b.mass[p] * b.volume[p];
  }
  for (long c = 0; c < g->size; c++) ck_assert_double_eq_tol(b.mass_nc[c], plain[c], 1e-15);
  double mass = 0;
  for (long p = 0; p < N; p++) mass += b.mass[p];
  ck_assert_double_eq_tol(sum_of(&b, b.vel_nc, 1, 0), -2 * mass, 1e-10);
  memory_free(&plain);
  destroy(&b);
}
END_TEST

/* with a point's gradient, scatter puts the linear field itself on the nodes */
START_TEST(scatter_carries_gradients)
{
  static const double slope[3] = {2, -5, 7};
  struct bench        b;
  create(_i, WALL_MIRRORED, 0, &b);
  for (long p = 0; p < N; p++) {
    b.volume[p] = linear_field(b.x + p * b.dim, b.dim);
    for (int d = 0; d < b.dim; d++) b.vel[p * b.dim + d] = slope[d];
  }
  struct scatter_args args = {.n = 2,
                              .x = b.x,
                              .weight = b.mass,
                              .value = {NULL, b.volume},
                              .gradient = {NULL, b.vel},
                              .node = {b.mass_nc, b.vel_nc}};
  FOR_RUNS(b.points, &b.kg.g, run, group) b.k->scatter(&b.kg, &run, &args);
  for (long c = 0; c < b.kg.g.size; c++) {
    double x[3];
    if (!(b.mass_nc[c] > 1e-6)) continue;
    grid_node(&b.kg.g, c, x);
    ck_assert_double_eq_tol(b.vel_nc[c] / b.mass_nc[c], linear_field(x, b.dim), 1e-11);
  }
  destroy(&b);
}
END_TEST

/* a point's flux meets the gradients of the weights, beside its value and gradient */
START_TEST(scatter_carries_fluxes)
{
  struct bench b;
  double      *plain;
  create(_i, WALL_MIRRORED, 0, &b);
  must(NEW(&plain, b.kg.g.size));
  struct scatter_args args = {.n = 2,
                              .factor = {0, 3},
                              .x = b.x,
                              .weight = b.mass,
                              .value = {NULL, b.volume},
                              .gradient = {NULL, b.affine},
                              .flux = {NULL, b.vel},
                              .node = {b.mass_nc, b.vel_nc}};
  for (long q = 0; q < N * b.dim; q++) b.affine[q] = 0.3 * sin((double)q), b.vel[q] = cos(0.7 * (double)q);
  FOR_RUNS(b.points, &b.kg.g, run, group) b.k->scatter(&b.kg, &run, &args);
  for (long p = 0; p < N; p++) {
    long   node[MAX_SUPPORT];
    double w[MAX_SUPPORT], slope[MAX_SUPPORT][3], x[3];
    b.k->weights(&b.kg, b.x + p * b.dim, node, w, slope);
    for (int q = 0; q < b.k->n_support; q++) {
      double value = b.volume[p] * w[q];
      grid_node(&b.kg.g, node[q], x);
      for (int d = 0; d < b.dim; d++)
        value += w[q] * b.affine[p * b.dim + d] * (x[d] - b.x[p * b.dim + d]) + slope[q][d] * b.vel[p * b.dim + d];
      plain[node[q]] += 3 * b.mass[p] * value;
    }
  }
  for (long c = 0; c < b.kg.g.size; c++) ck_assert_double_eq_tol(b.vel_nc[c], plain[c], 1e-11);
  memory_free(&plain);
  destroy(&b);
}
END_TEST

/* ---- there and back ---- */

/* a field with constant gradient L on points: velocity and C */
static void set_motion(struct bench *b, double L[3][3])
{
  for (long p = 0; p < N; p++)
    for (int d = 0; d < b->dim; d++) {
      b->vel[p * b->dim + d] = d + 1;
      for (int e = 0; e < b->dim; e++) {
        b->vel[p * b->dim + d] += L[d][e] * b->x[p * b->dim + e];
        b->affine[(p * b->dim + d) * b->dim + e] = L[d][e];
      }
    }
}

static void nodal_velocity(struct bench *b)
{
  for (long c = 0; c < b->kg.g.size; c++)
    for (int d = 0; d < b->dim; d++)
      b->vel_nc[c * b->dim + d] = b->mass_nc[c] > 0 ? b->mom_nc[c * b->dim + d] / b->mass_nc[c] : 0;
}

/* affine motions, rotation among them, come back from the nodes as they went: APIC */
START_TEST(affine_motion_survives)
{
  double rotation[3][3] = {{0, -3, 1}, {3, 0, -2}, {-1, 2, 0}}, any[3][3] = {{1, -3, 2}, {0.5, 2, -2}, {-1, 4, -1}};
  for (int turn = 0; turn < 2; turn++) {
    struct bench b;
    double       vel[3 * N], x[3 * N], gradv[9 * N], displacement[3 * N] = {0};
    create(_i, WALL_MIRRORED, 2, &b);
    set_motion(&b, turn ? rotation : any);
    memcpy(vel, b.vel, sizeof vel);
    memcpy(x, b.x, sizeof x);
    p2g(&b, true);
    nodal_velocity(&b);
    memset(b.affine, 0, 9 * N * sizeof(double));
    const struct g2p_args args = {.dt = 1e-3,
                                  .beta = 1,
                                  .vel_old_nc = b.vel_nc,
                                  .vel_nc = b.vel_nc,
                                  .x = b.x,
                                  .displacement = displacement,
                                  .vel = b.vel,
                                  .affine = b.affine,
                                  .gradv = gradv};
    FOR_RUNS(b.points, &b.kg.g, run, group) b.k->g2p(&b.kg, &run, &args);
    for (long q = 0; q < N * b.dim; q++) {
      ck_assert_double_eq_tol(b.vel[q], vel[q], 1e-12);
      ck_assert_double_eq_tol(b.x[q], x[q] + 1e-3 * vel[q], 1e-14);
      ck_assert_double_eq_tol(displacement[q], 1e-3 * vel[q], 1e-15);
      for (int e = 0; e < b.dim; e++) {
        double exact = turn ? rotation[q % b.dim][e] : any[q % b.dim][e];
        ck_assert_double_eq_tol(b.affine[q * b.dim + e], exact, 1e-10);
        ck_assert_double_eq_tol(gradv[q * b.dim + e], exact, 1e-10);
      }
    }
    destroy(&b);
  }
}
END_TEST

/* v = beta sum w v_new + (1 - beta) (v + sum w (v_new - v_old)): T(30) */
START_TEST(blends)
{
  for (int half = 0; half < 3; half++) {
    struct bench b;
    double       beta = 0.5 * half, new_p[3 * N], old_p[3 * N], vel[3 * N], *old_nc, *component;
    unsigned     seed = 4;
    create(_i, WALL_MIRRORED, 0, &b);
    must(NEW(&old_nc, 3 * b.kg.g.size));
    must(NEW(&component, b.kg.g.size));
    for (long q = 0; q < b.dim * b.kg.g.size; q++) {
      b.vel_nc[q] = next_random(&seed);
      old_nc[q] = next_random(&seed);
    }
    for (int d = 0; d < b.dim; d++) {
      for (long c = 0; c < b.kg.g.size; c++) component[c] = b.vel_nc[c * b.dim + d];
      gather(&b, component, new_p + (long)d * N, NULL);
      for (long c = 0; c < b.kg.g.size; c++) component[c] = old_nc[c * b.dim + d];
      gather(&b, component, old_p + (long)d * N, NULL);
    }
    memcpy(vel, b.vel, sizeof vel);
    const struct g2p_args args = {
        .dt = 0, .beta = beta, .vel_old_nc = old_nc, .vel_nc = b.vel_nc, .x = b.x, .vel = b.vel};
    FOR_RUNS(b.points, &b.kg.g, run, group) b.k->g2p(&b.kg, &run, &args);
    for (long p = 0; p < N; p++)
      for (int d = 0; d < b.dim; d++) {
        double to = new_p[(long)d * N + p], from = old_p[(long)d * N + p];
        double exact = beta * to + (1 - beta) * (vel[p * b.dim + d] + to - from);
        ck_assert_double_eq_tol(b.vel[p * b.dim + d], exact, 1e-13);
      }
    memory_free(&old_nc);
    memory_free(&component);
    destroy(&b);
  }
}
END_TEST

/* uniform stress pushes no node inside a body that fills the lattice: sum V grad w = 0 */
START_TEST(uniform_pressure_pushes_nothing_inside)
{
  struct bench b;
  create_grid(_i, WALL_MIRRORED, &b);
  const struct grid *g = &b.kg.g;
  double            *force, gauss[2] = {0.5 - 0.5 / sqrt(3.0), 0.5 + 0.5 / sqrt(3.0)};
  must(NEW(&force, 3 * g->size));
  int lower[3] = {6, 2, b.dim == 3 ? 1 : 0}, n = 48; /* six cells per axis around node (9, 5, 4) */
  for (long i = 0; i < (long)n * n * (b.dim == 3 ? n : 1); i++) {
    long   node[MAX_SUPPORT], at[3] = {i % n, i / n % n, i / n / n};
    double w[MAX_SUPPORT], slope[MAX_SUPPORT][3], x[3];
    for (int d = 0; d < 3; d++) x[d] = g->min[d] + g->h * (lower[d] + 0.25 * ((double)(at[d] / 2) + gauss[at[d] % 2]));
    b.k->weights(&b.kg, x, node, w, slope);
    for (int q = 0; q < b.k->n_support; q++)
      for (int d = 0; d < b.dim; d++) force[node[q] * b.dim + d] += slope[q][d] * pow(g->h / 8, b.dim);
  }
  for (int d = 0; d < b.dim; d++)
    ck_assert_double_eq_tol(force[grid_at(g, 9, 5, b.dim == 3 ? 4 : 0) * b.dim + d], 0, 1e-15);
  memory_free(&force);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("kernels");
  TCase *tcase = tcase_create("every dimension and basis");
  tcase_add_loop_test(tcase, linear_fields_inside, 0, VARIANTS);
  tcase_add_loop_test(tcase, linear_fields_up_to_modified_walls, 0, VARIANTS);
  tcase_add_loop_test(tcase, gather_strides, 0, VARIANTS);
  tcase_add_loop_test(tcase, mass_and_momentum_are_kept, 0, VARIANTS);
  tcase_add_loop_test(tcase, angular_momentum_is_kept, 0, VARIANTS);
  tcase_add_loop_test(tcase, the_moment_of_splines, 0, VARIANTS);
  tcase_add_loop_test(tcase, tiles_are_plain_sums, 0, VARIANTS);
  tcase_add_loop_test(tcase, scatter_carries_gradients, 0, VARIANTS);
  tcase_add_loop_test(tcase, scatter_carries_fluxes, 0, VARIANTS);
  tcase_add_loop_test(tcase, affine_motion_survives, 0, VARIANTS);
  tcase_add_loop_test(tcase, blends, 0, VARIANTS);
  tcase_add_loop_test(tcase, uniform_pressure_pushes_nothing_inside, 0, VARIANTS);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
