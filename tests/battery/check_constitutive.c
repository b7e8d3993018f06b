/* Every registered skeleton law: rest, objectivity, energy on closed cycles, wave speed, bad input, arrays. */
#include "constitutive/constitutive.h"
#include "core/tensor.h"
#include "tests/battery/battery.h"

#include <float.h>

enum { MAX_HISTORY = 64 };

/* one material point of a law */
struct point {
  const struct constitutive_model *law;
  struct parameters                prm;
  double                           modulus; /* Pa: what stresses are compared with */
  double                           F[9], stress[6], history[MAX_HISTORY];
  double                           lost; /* plastic work so far, J per volume at the start */
};

static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static void point_create(const struct constitutive_model *law, int set, struct point *p)
{
  memset(p, 0, sizeof *p);
  p->law = law;
  parameters_fill(law->name, law->params, set, &p->prm);
  ck_assert_int_le(law->n_history, MAX_HISTORY);
  p->modulus = law->held ? 1.0 : law->oedometer_modulus(&p->prm);
  memcpy(p->F, identity, sizeof identity);
  if (law->start) law->start(&p->prm, 1, p->stress, p->history);
}

/* one step: F <- dF F */
static void point_step(struct point *p, const double dF[9])
{
  double work;
  tensor_product(dF, p->F, p->F);
  int bad = p->law->update(&p->prm, 1, 1e-3, dF, p->F, p->stress, p->history, &work);
  p->lost += work * tensor_determinant(p->F);
  ck_assert_msg(bad == 0, "%s refuses an ordinary step", p->law->name);
}

/* Away from the yield surface: some have their tip at zero stress. `size`: pressure over modulus */
static void point_compress(struct point *p, double size)
{
  if (!p->law->yield) return;
  for (int k = 0; k < 3; k++) p->stress[k] = -size * p->modulus;
  if (p->law->start) p->law->start(&p->prm, 1, p->stress, p->history);
}

/* until a viscous law has come to rest */
static void point_relax(struct point *p)
{
  for (int step = 0; step < 1000 && p->law->viscous; step++) point_step(p, identity);
}

static double point_energy(const struct point *p)
{
  double energy;
  p->law->energy(&p->prm, 1, p->F, p->stress, p->history, &energy);
  return energy;
}

/* Calls `test` for a fresh point of every law and set. */
static void for_every_law(void (*test)(struct point *))
{
  for (const struct constitutive_model *const *law = constitutive_models; *law; law++)
    for (int set = 0; set < parameters_sets((*law)->name); set++) {
      struct point p;
      point_create(*law, set, &p);
      test(&p);
    }
}

/* I + a random matrix with entries up to `size` */
static void random_step(uint64_t *seed, double size, double dF[9])
{
  for (int k = 0; k < 9; k++) dF[k] = identity[k] + size * battery_random(seed);
}

/* rotation by an angle about an axis (Rodrigues) */
static void rotation(const double axis[3], double angle, double Q[9])
{
  double       n = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  double       x = axis[0] / n, y = axis[1] / n, z = axis[2] / n, c = cos(angle), s = sin(angle);
  const double q[9] = {c + x * x * (1 - c),     x * y * (1 - c) - z * s, x * z * (1 - c) + y * s,
                       x * y * (1 - c) + z * s, c + y * y * (1 - c),     y * z * (1 - c) - x * s,
                       x * z * (1 - c) - y * s, y * z * (1 - c) + x * s, c + z * z * (1 - c)};
  memcpy(Q, q, sizeof q);
}

/* Q s Q^T */
static void turned(const double Q[9], const double s[6], double result[6])
{
  double S[9], Qt[9], T[9];
  tensor_from_symmetric(s, S);
  tensor_transpose(Q, Qt);
  tensor_product(Q, S, T);
  tensor_product(T, Qt, T);
  tensor_to_symmetric(T, result);
}

static void assert_stress(const struct point *p, const double expected[6], double tolerance, const char *what)
{
  for (int k = 0; k < 6; k++)
    ck_assert_msg(fabs(p->stress[k] - expected[k]) <= tolerance, "%s, %s: stress[%d] is %.17g instead of %.17g",
                  p->law->name, what, k, p->stress[k], expected[k]);
}

static void rests(struct point *p)
{
  const double zero[6] = {0};
  for (int step = 0; step < 100; step++) point_step(p, identity);
  assert_stress(p, zero, 0.0, "at rest");
  ck_assert_msg(point_energy(p) == 0.0, "%s stores energy at rest", p->law->name);
}

/* small enough for every law to stay elastic at most a little, and then to stay where it is */
static void stays_when_nothing_moves(struct point *p)
{
  uint64_t seed = 1;
  double   dF[9], before[6];
  random_step(&seed, 1e-3, dF);
  point_step(p, dF);
  point_relax(p);
  memcpy(before, p->stress, sizeof before);
  for (int step = 0; step < 100; step++) point_step(p, identity);
  assert_stress(p, before, 1e-14 * p->modulus, "held deformation");
}

/* pre-stressed, then turned about a skew axis by steps of different size; the round-off of each dF is a strain of 1e-16
 * that a law rightly answers */
static void keeps_principal_stresses(struct point *p)
{
  const double axis[3] = {1, -2, 0.5}, angles[4] = {1e-3, 0.1, 1.0, 2.5};
  uint64_t     seed = 2;
  double       dF[9], Q[9], all[9], start[6], expected[6];
  for (int step = 0; step < 20; step++) {
    random_step(&seed, 2e-3, dF);
    point_step(p, dF);
  }
  point_relax(p);
  memcpy(start, p->stress, sizeof start);
  memcpy(all, identity, sizeof all);
  double size = 0.0;
  for (int k = 0; k < 6; k++) size = fmax(size, fabs(start[k]));
  for (int step = 0; step < 1000; step++) {
    rotation(axis, angles[step / 250], Q);
    point_step(p, Q);
    tensor_product(Q, all, all);
    turned(all, start, expected);
    assert_stress(p, expected, 1e-12 * size + DBL_EPSILON * p->modulus * (1 + step), "turned body");
  }
}

/* The same path seen by a turning observer: dF* = Q1 dF Q0^T gives Q1 stress Q1^T. */
static void is_objective(struct point *p)
{
  const double axis[3] = {-0.3, 1, 2};
  struct point seen = *p;
  uint64_t     seed = 3;
  double       Q0[9], Q1[9], Q0t[9], dF[9], dF_seen[9], expected[6];
  rotation(axis, 0.0, Q0);
  for (int step = 1; step <= 40; step++) {
    random_step(&seed, 4e-3, dF);
    rotation(axis, 0.2 * step, Q1);
    tensor_transpose(Q0, Q0t);
    tensor_product(Q1, dF, dF_seen);
    tensor_product(dF_seen, Q0t, dF_seen);
    point_step(p, dF);
    point_step(&seen, dF_seen);
    turned(Q1, p->stress, expected);
    assert_stress(&seen, expected, 1e-13 * p->modulus, "turning observer");
    memcpy(Q0, Q1, sizeof Q0);
  }
}

/* P = J stress F^-T */
static void nominal_stress(const struct point *p, double P[9])
{
  const double *F = p->F;
  double        S[9], cofactor[9]; /* J F^-T */
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++) {
      int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
      cofactor[3 * r + c] = F[3 * r1 + c1] * F[3 * r2 + c2] - F[3 * r1 + c2] * F[3 * r2 + c1];
    }
  tensor_from_symmetric(p->stress, S);
  tensor_product(S, cofactor, P);
}

/* dF that leads from p->F to F */
static void step_to(const struct point *p, const double F[9], double dF[9])
{
  double J = tensor_determinant(p->F), inverse[9];
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++) {
      int r1 = (c + 1) % 3, r2 = (c + 2) % 3, c1 = (r + 1) % 3, c2 = (r + 2) % 3;
      inverse[3 * r + c] = (p->F[3 * r1 + c1] * p->F[3 * r2 + c2] - p->F[3 * r1 + c2] * p->F[3 * r2 + c1]) / J;
    }
  tensor_product(F, inverse, dF);
}

/* Largest gap between work done and energy stored and lost, over the largest energy, on the closed cycle
 * F = I + size (A sin s + B (1 - cos s)) with |A| = |B| = 1; work by the trapezoidal rule. */
static double cycle_gap(struct point *p, double size)
{
  enum { STEPS = 4000 };
  uint64_t seed = 4;
  double   A[9], B[9], a = 0, b = 0, work = 0, gap = 0, largest = 0, P0[9], P1[9], F0[9], F[9], dF[9];
  for (int k = 0; k < 9; k++) {
    A[k] = battery_random(&seed), B[k] = battery_random(&seed);
    a += A[k] * A[k], b += B[k] * B[k];
  }
  nominal_stress(p, P0);
  for (int step = 1; step <= STEPS; step++) {
    double s = 2.0 * M_PI * step / STEPS;
    memcpy(F0, p->F, sizeof F0);
    for (int k = 0; k < 9; k++) F[k] = identity[k] + size * (A[k] / sqrt(a) * sin(s) + B[k] / sqrt(b) * (1 - cos(s)));
    step_to(p, F, dF);
    point_step(p, dF);
    nominal_stress(p, P1);
    for (int k = 0; k < 9; k++) work += 0.5 * (P0[k] + P1[k]) * (p->F[k] - F0[k]);
    double kept = tensor_determinant(p->F) * point_energy(p) + p->lost;
    gap = fmax(gap, fabs(work - kept));
    largest = fmax(largest, kept);
    memcpy(P0, P1, sizeof P0);
  }
  return largest > 0.0 ? gap / largest : gap;
}

/* Exact for a law with a potential; a rate law without one is consistent to first order in the strain. */
static void conserves_energy(struct point *p)
{
  const double sizes[2] = {1e-2, 1e-3};
  for (int i = 0; i < 2; i++) {
    struct point fresh = *p;
    double       gap = cycle_gap(&fresh, sizes[i]);
    printf("%s: energy gap %.2e on a cycle of strain %g\n", p->law->name, gap, sizes[i]);
    ck_assert_msg(gap <= 2.0 * sizes[i], "%s: work and energy differ by %g on a cycle of strain %g", p->law->name, gap,
                  sizes[i]);
  }
}

/* acoustic tensor of a direction: Q_ij = traction i on planes N per shear j along N, by central differences, Pa */
static void acoustic_tensor(const struct point *p, const double N[3], double Q[3][3])
{
  double e = 1e-6;
  for (int j = 0; j < 3; j++) {
    double traction[2][3];
    for (int side = 0; side < 2; side++) {
      struct point moved = *p;
      double       dF[9], P[9];
      memcpy(dF, identity, sizeof dF);
      for (int k = 0; k < 3; k++) dF[3 * j + k] += (side ? e : -e) * N[k];
      point_step(&moved, dF);
      memcpy(moved.F, dF, sizeof dF); /* nominal with respect to the present state */
      nominal_stress(&moved, P);
      for (int i = 0; i < 3; i++) traction[side][i] = P[3 * i] * N[0] + P[3 * i + 1] * N[1] + P[3 * i + 2] * N[2];
    }
    for (int i = 0; i < 3; i++) Q[i][j] = (traction[1][i] - traction[0][i]) / (2.0 * e);
  }
}

/* largest eigenvalue of a 3 x 3 matrix with real ones, by the power method on Q + shift */
static double largest_eigenvalue(double Q[3][3], double shift)
{
  double v[3] = {0.5, 0.6, 0.7}, value = 0.0;
  for (int step = 0; step < 2000; step++) {
    double w[3], norm = 0.0;
    for (int i = 0; i < 3; i++) w[i] = Q[i][0] * v[0] + Q[i][1] * v[1] + Q[i][2] * v[2] + shift * v[i];
    for (int i = 0; i < 3; i++) norm += w[i] * w[i];
    value = sqrt(norm);
    for (int i = 0; i < 3; i++) v[i] = w[i] / value;
  }
  return value - shift;
}

static double numerical_modulus(const struct point *p)
{
  enum { DIRECTIONS = 60 };
  uint64_t seed = 5;
  double   largest = 0.0, Q[3][3];
  for (int d = 0; d < DIRECTIONS; d++) {
    double N[3], norm = 0.0;
    for (int k = 0; k < 3; k++) N[k] = d < 3 ? d == k : battery_random(&seed);
    for (int k = 0; k < 3; k++) norm += N[k] * N[k];
    for (int k = 0; k < 3; k++) N[k] /= sqrt(norm);
    acoustic_tensor(p, N, Q);
    largest = fmax(largest, largest_eigenvalue(Q, p->modulus));
  }
  return largest;
}

/* The speed bounds the numerical tangent in strained states, and is sharp at the start. */
static void bounds_wave_speed(struct point *p)
{
  const double rb = 1800.0, strains[4] = {0.0, 1e-3, 0.1, 0.6};
  if (p->law->held) {
    ck_assert_double_eq(p->law->wave_speed(&p->prm, 1, &rb, p->stress, p->history), 0.0);
    return;
  }
  point_compress(p, 1e-3);
  for (int s = 0; s < 4; s++) {
    struct point strained = *p;
    uint64_t     seed = 6;
    double       dF[9];
    random_step(&seed, strains[s] / 20.0, dF);
    for (int step = 0; step < 20; step++) point_step(&strained, dF);
    double c = p->law->wave_speed(&p->prm, 1, &rb, strained.stress, strained.history);
    double exact = sqrt(numerical_modulus(&strained) / rb);
    ck_assert_msg(c >= exact * (1.0 - 1e-6), "%s at strain %g: speed %g is below %g", p->law->name, strains[s], c,
                  exact);
    if (s == 0) ck_assert_msg(c <= exact * (1.0 + 1e-6), "%s at rest: speed %g is above %g", p->law->name, c, exact);
  }
}

/* of n points that start with that stress */
static void start_history(const struct point *p, int n, const double *stress, double *history)
{
  memset(history, 0, (size_t)n * (size_t)p->law->n_history * sizeof *history);
  if (p->law->start) p->law->start(&p->prm, n, stress, history);
}

static void bounds_the_fastest_point(struct point *p)
{
  double stress[18] = {0}, history[3 * MAX_HISTORY] = {0}, rb[3] = {2000.0, 500.0, 1000.0};
  start_history(p, 3, stress, history);
  double all = p->law->wave_speed(&p->prm, 3, rb, stress, history);
  double one = p->law->wave_speed(&p->prm, 1, &rb[1], stress, history);
  ck_assert_msg(all == one, "%s: three points have speed %g, the fastest alone %g", p->law->name, all, one);
}

/* Oedometer and simple shear, and the stress so small that stiffness and area are those of the start. */
static void has_its_initial_moduli(struct point *p)
{
  double dF[9], e = 1e-9;
  if (p->law->held) return;
  point_compress(p, 1e-7);
  struct point sheared = *p;
  double       before = p->stress[YY], shear = p->law->shear_modulus(&p->prm);
  memcpy(dF, identity, sizeof dF);
  dF[4] -= e;
  point_step(p, dF);
  ck_assert_msg(fabs((p->stress[YY] - before) / (-e * p->modulus) - 1.0) <= 1e-6, "%s: oedometer modulus %g, not %g",
                p->law->name, (before - p->stress[YY]) / e, p->modulus);
  if (!p->law->yield) ck_assert_double_eq_tol(p->stress[XX] / p->stress[YY], p->law->lateral_ratio(&p->prm), 1e-6);
  memcpy(dF, identity, sizeof dF);
  dF[1] = e;
  point_step(&sheared, dF);
  ck_assert_msg(fabs(sheared.stress[XY] / (e * shear) - 1.0) <= 1e-6, "%s: shear modulus %g, not %g", p->law->name,
                sheared.stress[XY] / e, shear);
}

/* The geostatic start lies inside the yield surface, at any depth. */
static void rests_inside(struct point *p)
{
  double history[MAX_HISTORY] = {0}, ratio = p->law->lateral_ratio(&p->prm);
  for (double vertical = 1e-8 * p->modulus; vertical < 0.1 * p->modulus && p->law->yield; vertical *= 10.0) {
    double stress[6] = {-ratio * vertical, -vertical, -ratio * vertical, 0.0, 0.0, 0.0};
    if (p->law->start) p->law->start(&p->prm, 1, stress, history);
    double yield = p->law->yield(&p->prm, stress, history);
    ck_assert_msg(yield <= 1e-14 * vertical, "%s: yield function %g under a vertical stress of %g Pa", p->law->name,
                  yield, vertical);
  }
}

/* Steps no law can follow, among good ones: counted, no NaN, neighbours as without them. */
static void survives_bad_input(struct point *p)
{
  enum { N = 20 };
  static const double bad_steps[4][9] = {{NAN, 0, 0, 0, 1, 0, 0, 0, 1},
                                         {1, 0, 0, 0, 0, 0, 0, 0, 1},
                                         {-1, 0, 0, 0, 1, 0, 0, 0, 1},
                                         {INFINITY, 0, 0, 0, 1, 0, 0, 0, 1}};
  double              dF[N * 9], stress[N * 6] = {0}, clean[N * 6] = {0}, history[N * MAX_HISTORY] = {0};
  uint64_t            seed = 7;
  int                 n_bad = 0;
  for (int i = 0; i < N; i++) random_step(&seed, 1e-3, &dF[9 * i]);
  start_history(p, N, clean, history);
  p->law->update(&p->prm, N, 1e-3, dF, dF, clean, history, NULL);
  start_history(p, N, stress, history);
  for (int i = 2; i < N; i += 5) memcpy(&dF[9 * i], bad_steps[n_bad++], sizeof bad_steps[0]);
  int refused = p->law->update(&p->prm, N, 1e-3, dF, dF, stress, history, NULL);
  ck_assert_msg(refused == (p->law->held ? 0 : n_bad), "%s: %d points refused, %d were bad", p->law->name, refused,
                n_bad);
  for (int i = 0; i < N; i++)
    for (int k = 0; k < 6; k++) {
      ck_assert_msg(isfinite(stress[6 * i + k]), "%s: stress of point %d is not finite", p->law->name, i);
      if (i % 5 != 2)
        ck_assert_msg(stress[6 * i + k] == clean[6 * i + k], "%s: a bad point disturbs others", p->law->name);
    }
}

/* small, large and very large steps: the same bits alone and in company */
static void array_equals_point(struct point *p)
{
  enum { N = 61 };
  const double sizes[4] = {1e-5, 1e-3, 0.05, 0.2};
  double       dF[N * 9], F[N * 9], start[N * 6], all[N * 6], work[N];
  double       history[N * MAX_HISTORY] = {0}, energy[N];
  uint64_t     seed = 8;
  int          n_history = p->law->n_history;
  for (int i = 0; i < N; i++) {
    random_step(&seed, sizes[i % 4], &dF[9 * i]);
    random_step(&seed, 0.1, &F[9 * i]);
    tensor_product(&dF[9 * i], &F[9 * i], &F[9 * i]);
    for (int k = 0; k < 6; k++) start[6 * i + k] = all[6 * i + k] = 1e-3 * p->modulus * battery_random(&seed);
  }
  start_history(p, N, all, history);
  int bad = p->law->update(&p->prm, N, 1e-3, dF, F, all, history, work);
  p->law->energy(&p->prm, N, F, all, history, energy);
  ck_assert_int_eq(bad, 0);
  for (int i = 0; i < N; i++) {
    double own[MAX_HISTORY] = {0}, own_work, own_energy, *s = &start[6 * i];
    start_history(p, 1, s, own);
    p->law->update(&p->prm, 1, 1e-3, &dF[9 * i], &F[9 * i], s, own, &own_work);
    p->law->energy(&p->prm, 1, &F[9 * i], s, own, &own_energy);
    ck_assert_msg(memcmp(s, &all[6 * i], 6 * sizeof *s) == 0, "%s: stress of point %d depends on its company",
                  p->law->name, i);
    ck_assert_msg(memcmp(own, &history[n_history * i], (size_t)n_history * sizeof *own) == 0,
                  "%s: history of point %d depends on its company", p->law->name, i);
    ck_assert_msg(own_work == work[i] && own_energy == energy[i],
                  "%s: work or energy of point %d depends on its company", p->law->name, i);
  }
}

/* Points in company, as a run holds them. */
enum { COMPANY = 64, STRIDE = 10, COMPANIES = 1000000 / (COMPANY * STRIDE) };
struct company {
  double dF[COMPANY][9], stress[COMPANY][6], history[COMPANY * MAX_HISTORY], work[COMPANY], size[COMPANY];
};

static double largest_stress(const double s[6])
{
  double largest = 0.0;
  for (int k = 0; k < 6; k++) largest = fmax(largest, fabs(s[k]));
  return largest;
}

/* Any stress, more often in compression; sizes from 1e-6 to 1e-2 of the modulus. The law brings it inside. */
static void company_start(const struct point *p, uint64_t *seed, struct company *c)
{
  for (int i = 0; i < COMPANY; i++) {
    double size = p->modulus * pow(10.0, -4.0 + 2.0 * battery_random(seed));
    for (int k = 0; k < 6; k++) c->stress[i][k] = size * (battery_random(seed) - (k < 3 ? 0.7 : 0.0));
    memcpy(c->dF[i], identity, sizeof identity);
  }
  start_history(p, COMPANY, c->stress[0], c->history);
}

/* strains from 1e-7 to 0.1 */
static void company_stride(uint64_t *seed, struct company *c)
{
  for (int i = 0; i < COMPANY; i++) {
    c->size[i] = pow(10.0, -4.0 + 3.0 * battery_random(seed));
    random_step(seed, c->size[i], c->dF[i]);
  }
}

/* Round-off is that of the stress before the return, which the strain made. Returns the worst yield over the stress.
 * Each assertion costs a message to the suite's runner: only those that fail are made. */
static double assert_inside(const struct point *p, const struct company *c)
{
  double worst = -INFINITY;
  for (int i = 0; i < COMPANY; i++) {
    double yield = p->law->yield(&p->prm, c->stress[i], &c->history[i * p->law->n_history]);
    double stress = largest_stress(c->stress[i]), trial = stress + 4.0 * c->size[i] * p->modulus;
    if (!(yield <= 1e-8 * stress + 4.0 * DBL_EPSILON * trial))
      ck_abort_msg("%s: yield function %g at a stress of %g Pa, step of strain %g", p->law->name, yield, stress,
                   c->size[i]);
    if (!(c->work[i] >= -16.0 * DBL_EPSILON * trial * (c->size[i] + stress / p->modulus)))
      ck_abort_msg("%s: plastic work %g J/m3 at a stress of %g Pa, step of strain %g", p->law->name, c->work[i], stress,
                   c->size[i]);
    if (stress > 1e-9 * trial) worst = fmax(worst, yield / stress);
  }
  return worst;
}

/* A million steps of any size from any state: none fails, all end inside and lose work. */
static void stays_inside(struct point *p)
{
  uint64_t       seed = 9;
  double         worst = -INFINITY;
  struct company c;
  if (!p->law->yield) return;
  for (int i = 0; i < COMPANIES; i++) {
    company_start(p, &seed, &c);
    p->law->update(&p->prm, COMPANY, 1e-3, c.dF[0], c.dF[0], c.stress[0], c.history, NULL);
    for (int step = 0; step < STRIDE; step++) {
      company_stride(&seed, &c);
      int bad = p->law->update(&p->prm, COMPANY, 1e-3, c.dF[0], c.dF[0], c.stress[0], c.history, c.work);
      ck_assert_msg(bad == 0, "%s: %d points of a random walk fail", p->law->name, bad);
      worst = fmax(worst, assert_inside(p, &c));
    }
  }
  printf("%s: yield function at most %.1e of the stress in 1e6 random steps\n", p->law->name, worst);
}

START_TEST(rest) { for_every_law(rests); }
END_TEST
START_TEST(held_deformation) { for_every_law(stays_when_nothing_moves); }
END_TEST
START_TEST(turned_body) { for_every_law(keeps_principal_stresses); }
END_TEST
START_TEST(turning_observer) { for_every_law(is_objective); }
END_TEST
START_TEST(closed_cycle) { for_every_law(conserves_energy); }
END_TEST
START_TEST(wave_speed) { for_every_law(bounds_wave_speed); }
END_TEST
START_TEST(fastest_point) { for_every_law(bounds_the_fastest_point); }
END_TEST
START_TEST(initial_moduli) { for_every_law(has_its_initial_moduli); }
END_TEST
START_TEST(bad_input) { for_every_law(survives_bad_input); }
END_TEST
START_TEST(arrays) { for_every_law(array_equals_point); }
END_TEST

START_TEST(geostatic) { for_every_law(rests_inside); }
END_TEST
START_TEST(random_walks) { for_every_law(stays_inside); }
END_TEST

START_TEST(found_by_name)
{
  for (const struct constitutive_model *const *law = constitutive_models; *law; law++)
    ck_assert_ptr_eq(constitutive_find((*law)->name), *law);
  ck_assert_ptr_null(constitutive_find("no such law"));
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("battery/constitutive");
  TCase *tests = tcase_create("every law");
  tcase_add_test(tests, rest);
  tcase_add_test(tests, held_deformation);
  tcase_add_test(tests, turned_body);
  tcase_add_test(tests, turning_observer);
  tcase_add_test(tests, closed_cycle);
  tcase_add_test(tests, wave_speed);
  tcase_add_test(tests, fastest_point);
  tcase_add_test(tests, initial_moduli);
  tcase_add_test(tests, bad_input);
  tcase_add_test(tests, arrays);
  tcase_add_test(tests, geostatic);
  tcase_add_test(tests, random_walks);
  tcase_add_test(tests, found_by_name);
  suite_add_tcase(suite, tests);
  return battery_run(suite);
}
