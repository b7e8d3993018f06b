/* Planes in the unit cell against sums over corners, sampled columns and each other. */
#include "ice/plic.h"

#include "tests/scene_run.h"

enum { RANDOM = 20000 };

/* one assertion per normal would take longer than what is tested: the largest difference instead */
static void worse(double *worst, double a, double b)
{
  double difference = isnan(a - b) ? INFINITY : fabs(a - b);
  *worst = fmax(*worst, difference);
}

static double uniform(unsigned short state[3], double lo, double hi) { return lo + (hi - lo) * erand48(state); }

/* any direction; one component in three is tiny or zero */
static void any_normal(int dim, unsigned short state[3], double normal[3])
{
  normal[2] = 0;
  for (int d = 0; d < dim; d++) {
    double kind = uniform(state, 0, 6);
    normal[d] = uniform(state, -1, 1);
    if (kind < 1) normal[d] *= pow(10, -uniform(state, 0, 30));
    if (kind > 5.5) normal[d] *= kind < 5.7 ? 0 : pow(10, -uniform(state, 30, 300));
  }
  if (normal[0] == 0 && normal[1] == 0 && normal[2] == 0) normal[1] = 1;
  plic_normalise(normal);
}

/* volume as a sum over the corners that are below, in extended precision: fails for small components, so none */
static double corner_sum(int dim, const double normal[3], double offset)
{
  long double total = 0, product = 1;
  for (int d = 0; d < dim; d++) product *= (d + 1) * fabsl(normal[d]);
  for (int corner = 0; corner < 1 << dim; corner++) {
    long double below = offset, sign = 1, power = 1;
    for (int d = 0; d < dim; d++) {
      bool far = corner >> d & 1;
      below += (far ? -0.5L : 0.5L) * fabsl(normal[d]);
      sign *= far ? -1 : 1;
    }
    for (int d = 0; d < dim; d++) power *= below;
    if (below > 0) total += sign * power;
  }
  return (double)(total / product);
}

START_TEST(volumes_are_sums_over_corners)
{
  int            dim = _i;
  unsigned short state[3] = {1, 2, 3};
  double         worst = 0;
  for (int i = 0; i < RANDOM; i++) {
    double normal[3] = {0, 0, 0};
    for (int d = 0; d < dim; d++) normal[d] = uniform(state, 0.1, 1) * (uniform(state, -1, 1) < 0 ? -1 : 1);
    plic_normalise(normal);
    double offset = uniform(state, -0.6, 0.6), exact = corner_sum(dim, normal, offset);
    worse(&worst, plic_volume(normal, offset), exact);
  }
  ck_assert_double_lt(worst, 1e-15);
}
END_TEST

/* columns of liquid at sample points, along the largest component: clipped where a column is full or empty */
START_TEST(volumes_and_centroids_match_sampled_columns)
{
  enum { N = 200 };
  int            dim = _i, rows = dim == 3 ? N : 1;
  unsigned short state[3] = {3, 2, 1};
  for (int i = 0; i < 40; i++) {
    struct plane p;
    double       volume = 0, moment[3] = {0, 0, 0}, centroid[3];
    any_normal(dim, state, p.normal);
    p.offset = uniform(state, -0.5, 0.5);
    int a = 0;
    for (int d = 1; d < dim; d++)
      if (fabs(p.normal[d]) > fabs(p.normal[a])) a = d;
    int t = (a + 1) % dim, u = dim == 3 ? (a + 2) % 3 : 2;
    for (int j = 0; j < N; j++)
      for (int k = 0; k < rows; k++) {
        double x = (j + 0.5) / N - 0.5, y = dim == 3 ? (k + 0.5) / N - 0.5 : 0;
        double end = (p.offset - p.normal[t] * x - p.normal[u] * y) / p.normal[a];
        end = fmin(0.5, fmax(-0.5, end));
        double start = p.normal[a] > 0 ? -0.5 : 0.5, length = fabs(end - start) / (N * rows);
        volume += length;
        moment[a] += length * 0.5 * (start + end);
        moment[t] += length * x;
        if (dim == 3) moment[u] += length * y;
      }
    plic_centroid(&p, centroid);
    ck_assert_double_eq_tol(plic_volume(p.normal, p.offset), volume, 2e-5);
    for (int d = 0; d < 3; d++) ck_assert_double_eq_tol(centroid[d] * plic_volume(p.normal, p.offset), moment[d], 2e-5);
  }
}
END_TEST

START_TEST(offsets_invert_volumes)
{
  int            dim = _i;
  unsigned short state[3] = {5, 6, 7};
  double         worst = 0, furthest = 0;
  for (int i = 0; i < 20 * RANDOM; i++) {
    static const double special[] = {0, 1, 0.5, 1e-300, 1e-16, 1e-12, 1 - 1e-16, 1 - 1e-12};
    double              normal[3], volume = i % 9 < 8 ? uniform(state, 0, 1) : special[i / 9 % 8];
    if (i % 9 == 7) volume = pow(10, -uniform(state, 0, 20));
    any_normal(dim, state, normal);
    double offset = plic_offset(normal, volume), back = plic_volume(normal, offset);
    furthest = fmax(furthest, fabs(offset));
    worse(&worst, back, volume);
  }
  printf("%dD: volume of the offset of a volume: off by at most %.1e\n", dim, worst);
  ck_assert_double_lt(worst, 1e-14);
  ck_assert_double_le(furthest, 0.5 + 1e-15);
}
END_TEST

/* a component that fades away leaves the volume of the plane without it */
START_TEST(small_components_fade_out)
{
  unsigned short state[3] = {4, 4, 4};
  double         worst = 0;
  for (int i = 0; i < RANDOM; i++) {
    double size = pow(10, -uniform(state, 1, 320)), offset = uniform(state, -0.5, 0.5);
    double with[3] = {uniform(state, 0.1, 1), uniform(state, 0, 1), size}, without[3] = {with[0], with[1], 0};
    worse(&worst, plic_volume(with, offset) / (1e-15 + 10 * size), plic_volume(without, offset) / (1e-15 + 10 * size));
    with[1] = 0.7 * size;
    without[1] = 0;
    worse(&worst, plic_volume(with, offset) / (1e-15 + 10 * size), plic_volume(without, offset) / (1e-15 + 10 * size));
  }
  ck_assert_double_lt(worst, 1);
}
END_TEST

START_TEST(volume_grows_with_the_offset)
{
  int            dim = _i;
  unsigned short state[3] = {8, 8, 9};
  for (int i = 0; i < 200; i++) {
    double normal[3], last = 0, shrinks = 0;
    any_normal(dim, state, normal);
    for (int j = 0; j <= 200; j++) {
      double volume = plic_volume(normal, -0.55 + 1.1 * j / 200);
      shrinks = fmax(shrinks, last - volume);
      last = volume;
    }
    ck_assert_double_lt(shrinks, 1e-15);
    ck_assert_double_eq(last, 1);
  }
}
END_TEST

/* mirrored, with axes exchanged, with liquid and void exchanged: the same bits */
START_TEST(symmetric_to_the_last_bit)
{
  int            dim = _i;
  unsigned short state[3] = {1, 5, 9};
  double         worst = 0;
  for (int i = 0; i < RANDOM; i++) {
    double n[3], offset = uniform(state, -0.5, 0.5);
    any_normal(dim, state, n);
    double volume = plic_volume(n, offset), back = plic_offset(n, volume);
    for (int mirror = 0; mirror < 8; mirror++) {
      double m[3], turned[3] = {0, 0, 0};
      for (int d = 0; d < 3; d++) m[d] = mirror >> d & 1 ? -n[d] : n[d];
      for (int d = 0; d < dim; d++) turned[d] = m[(d + 1) % dim];
      worse(&worst, plic_volume(m, offset), volume);
      worse(&worst, plic_volume(turned, offset), volume);
      worse(&worst, plic_offset(turned, volume), back);
    }
    if (offset < 0) worse(&worst, plic_volume(n, -offset), 1 - volume);
  }
  ck_assert_double_eq(worst, 0);
}
END_TEST

/* slabs from both sides make up the cell, and none holds more than its width */
START_TEST(slabs_add_up)
{
  int            dim = _i;
  unsigned short state[3] = {2, 5, 8};
  double         worst = 0, over = 0;
  for (int i = 0; i < RANDOM; i++) {
    struct plane p;
    any_normal(dim, state, p.normal);
    p.offset = uniform(state, -0.5, 0.5);
    double width = i % 4 ? uniform(state, 0, 1) : pow(10, -uniform(state, 0, 20)),
           volume = plic_volume(p.normal, p.offset);
    for (int axis = 0; axis < dim; axis++) {
      double lower = plic_slab(&p, axis, false, width), upper = plic_slab(&p, axis, true, 1 - width);
      worse(&worst, lower + upper, volume);
      over = fmax(over, fmax(fmax(-lower, -upper), fmax(lower - width, upper - (1 - width))));
    }
    worse(&worst, plic_slab(&p, 0, true, 1), volume);
    worse(&worst, plic_slab(&p, 0, true, 0), 0);
  }
  ck_assert_double_lt(worst, 1e-15);
  ck_assert_double_le(over, 0);
}
END_TEST

/* the moments of liquid and void cancel */
START_TEST(centroids_balance)
{
  int            dim = _i;
  unsigned short state[3] = {7, 5, 3};
  double         worst = 0, furthest = 0;
  for (int i = 0; i < RANDOM; i++) {
    struct plane p;
    any_normal(dim, state, p.normal);
    p.offset = uniform(state, -0.49, 0.49);
    struct plane rest = {{-p.normal[0], -p.normal[1], -p.normal[2]}, -p.offset};
    double       volume = plic_volume(p.normal, p.offset), liquid[3], none[3];
    plic_centroid(&p, liquid);
    plic_centroid(&rest, none);
    for (int d = 0; d < 3; d++) {
      worse(&worst, volume * liquid[d], -(1 - volume) * none[d]);
      furthest = fmax(furthest, fabs(liquid[d]));
    }
  }
  ck_assert_double_lt(worst, 1e-15);
  ck_assert_double_lt(furthest, 0.5);
  struct plane flat = {{0, 1, 0}, -0.2}, empty = {{0, 1, 0}, -0.5}, full = {{0, 1, 0}, 0.5};
  double       c[3];
  plic_centroid(&flat, c);
  ck_assert_double_eq_tol(c[1], -0.35, 1e-15);
  plic_centroid(&empty, c);
  ck_assert_double_eq(c[1], 0);
  plic_centroid(&full, c);
  ck_assert_double_eq_tol(c[1], 0, 1e-16);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("plic");
  TCase *tcase = tcase_create("plic");
  tcase_add_loop_test(tcase, volumes_are_sums_over_corners, 2, 4);
  tcase_add_loop_test(tcase, volumes_and_centroids_match_sampled_columns, 2, 4);
  tcase_add_loop_test(tcase, offsets_invert_volumes, 2, 4);
  tcase_add_test(tcase, small_components_fade_out);
  tcase_add_loop_test(tcase, volume_grows_with_the_offset, 2, 4);
  tcase_add_loop_test(tcase, symmetric_to_the_last_bit, 2, 4);
  tcase_add_loop_test(tcase, slabs_add_up, 2, 4);
  tcase_add_loop_test(tcase, centroids_balance, 2, 4);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
