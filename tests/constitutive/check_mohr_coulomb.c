/* Mohr and Coulomb's law along paths with known ends: failure in compression, extension, plane strain and simple shear,
 * tip and cut-off, dilation, softening; steps of any size; turned frames. */
#include "tests/battery/battery.h"
#include "tests/constitutive/element.h"

static const double degree = M_PI / 180.0, shear = 1e7 / 2.6; /* Pa: young 1e7, poisson 0.3 */

struct setting {
  const char *name;
  double      value; /* of a choice: the number of its word */
};

/* a soil of young 1e7, poisson 0.3 and the settings, up to one without a name */
static struct parameters soil(const struct setting *settings)
{
  const struct constitutive_model *law = constitutive_find("mohr_coulomb");
  struct parameters                prm = {0};
  for (const struct param *p = law->params; p->name; p++) {
    double value = strcmp(p->name, "young") == 0 ? 1e7 : strcmp(p->name, "poisson") == 0 ? 0.3 : NAN;
    for (const struct setting *s = settings; s->name; s++)
      if (strcmp(s->name, p->name) == 0) value = s->value;
    parameters_put(law->name, p, isnan(value) ? parameters_default(p) : value, &prm);
  }
  return prm;
}

/* the arguments are pairs {"name", value} */
#define SOIL(...) soil((const struct setting[]){__VA_ARGS__, {NULL, 0.0}})
#define FRICTION(degrees)                                                                                              \
  {                                                                                                                    \
    "friction_angle_deg", degrees                                                                                      \
  }
#define COHESION(pascal)                                                                                               \
  {                                                                                                                    \
    "cohesion", pascal                                                                                                 \
  }
#define DILATION(degrees)                                                                                              \
  {                                                                                                                    \
    "dilation_angle_deg", degrees                                                                                      \
  }
#define TENSION(pascal)                                                                                                \
  {                                                                                                                    \
    "tension_strength", pascal                                                                                         \
  }

static double largest(const double s[6])
{
  double size = 0.0;
  for (int k = 0; k < 6; k++) size = fmax(size, fabs(s[k]));
  return size;
}

/* s_1 = Kp s_3 + 2 c sqrt(Kp) in compression and its inverse in extension, at lateral 100 kPa after 2 % of strain */
START_TEST(triaxial)
{
  const double cohesion[2] = {0.0, 5e3}, compression[2] = {300000.0, 317320.50807568877};
  const double extension[2] = {100000.0 / 3.0, 27559.830641437074};
  for (int c = 0; c < 2; c++)
    for (int psi = 0; psi <= 10; psi += 10)
      for (int flow = 0; flow < 2; flow++) {
        struct parameters prm = SOIL(FRICTION(30), COHESION(cohesion[c]), DILATION(psi), {"flow", flow});
        struct element    down = element_start("mohr_coulomb", &prm, -1e5, -1e5, -1e5), up = down;
        for (int i = 0; i < 100; i++) {
          element_triaxial(&down, -5e-4, -1e5);
          element_triaxial(&up, 5e-4, -1e5);
        }
        ck_assert_double_eq_tol(-down.stress[YY] / compression[c], 1.0, 1e-6);
        ck_assert_double_eq_tol(-up.stress[YY] / extension[c], 1.0, 1e-6);
      }
}
END_TEST

/* Plane strain: the same ends, the stress out of the plane between. */
START_TEST(biaxial)
{
  struct parameters prm = SOIL(FRICTION(30), COHESION(5e3));
  struct element    e = element_start("mohr_coulomb", &prm, -1e5, -1e5, -1e5);
  for (int i = 0; i < 100; i++) element_biaxial(&e, -5e-4, -1e5);
  ck_assert_double_eq_tol(-e.stress[YY] / 317320.50807568877, 1.0, 1e-6);
  ck_assert(e.stress[ZZ] < -1e5 && e.stress[ZZ] > e.stress[YY]);
}
END_TEST

/* one step of simple shear that keeps the vertical stress */
static void shear_step(struct element *e, double angle, double vertical)
{
  double low = -angle, high = angle;
  for (int i = 0; i < 60; i++) {
    struct element tried = *e;
    double         middle = 0.5 * (low + high);
    const double   dF[9] = {1, angle, 0, 0, 1 + middle, 0, 0, 0, 1};
    element_step(i < 59 ? &tried : e, dF);
    *(tried.stress[YY] < vertical ? &low : &high) = middle;
  }
}

/* Davis: where the axes of stress and of strain rate agree and nothing is strained sideways, tau = s_n sin(phi)
 * cos(psi)/(1 - sin(phi) sin(psi)). Stress turns with the body, so the skeleton must be stiff against it. */
START_TEST(simple_shear)
{
  for (int psi = 0; psi <= 20; psi += 10) {
    struct parameters prm = SOIL({"young", 1e12}, FRICTION(30), DILATION(psi));
    struct element    e = element_start("mohr_coulomb", &prm, -4e4, -1e5, -4e4);
    double            sine = 0.5, dilation = psi * degree;
    for (int i = 0; i < 400; i++) shear_step(&e, 1e-8, -1e5);
    ck_assert_double_eq_tol(e.stress[YY], -1e5, 1e-3);
    ck_assert_double_eq_tol(e.stress[XY] / (1e5 * sine * cos(dilation) / (1.0 - sine * sin(dilation))), 1.0, 1e-6);
  }
}
END_TEST

/* pulled on all sides, and on one side under lateral stress: to the tip and no farther */
START_TEST(tip)
{
  for (int c = 0; c < 2; c++) {
    double            cohesion = c * 5e3, end = cohesion * sqrt(3.0);
    struct parameters prm = SOIL(FRICTION(30), COHESION(cohesion), DILATION(10));
    struct element    all = element_start("mohr_coulomb", &prm, -1e3, -1e3, -1e3), one = all;
    for (int i = 0; i < 100; i++) element_stretch(&all, 1e-3, 1e-3, 1e-3);
    for (int i = 0; i < 100; i++) element_stretch(&one, 1e-3, 2e-3, 1e-3);
    for (int k = 0; k < 6; k++) {
      ck_assert_double_eq_tol(all.stress[k], k < 3 ? end : 0.0, 1e-9);
      ck_assert_double_eq_tol(one.stress[k], k < 3 ? end : 0.0, 1e-9);
    }
  }
}
END_TEST

/* One side pulled, the others held: up to the cut-off like an elastic body, then straining at that stress until the
 * others reach it too. */
START_TEST(cut_off)
{
  double            tension = 2e3, oedometer = 1e7 * 0.7 / (1.3 * 0.4), lateral = 0.3 / 0.7;
  struct parameters prm = SOIL(FRICTION(30), COHESION(5e3), TENSION(tension));
  struct element    e = element_start("mohr_coulomb", &prm, 0, 0, 0);
  element_stretch(&e, 0.0, 0.9 * tension / oedometer, 0.0);
  ck_assert_double_eq_tol(e.stress[YY], 0.9 * tension, 1e-9 * tension);
  for (int i = 0; i < 100; i++) element_stretch(&e, 0.0, 1e-4, 0.0);
  ck_assert_double_eq_tol(e.stress[YY], tension, 1e-12 * tension);
  ck_assert_double_eq_tol(e.stress[XX], lateral * tension, 1e-9 * tension);
  ck_assert_double_eq_tol(e.work, tension * 1e-4, 1e-9 * tension * 1e-4);
  for (int i = 0; i < 100; i++) element_stretch(&e, 1e-4, 0.0, 1e-4);
  for (int k = 0; k < 3; k++) ck_assert_double_eq_tol(e.stress[k], tension, 1e-12 * tension);
}
END_TEST

/* At failure all strain is plastic: volume over shear strain follows from psi alone. */
static void assert_dilation(struct parameters *prm, double sine, double tolerance)
{
  struct element plane = element_start("mohr_coulomb", prm, -1e5, -1e5, -1e5), axial = plane, before;
  for (int i = 0; i < 200; i++) element_biaxial(&plane, -5e-4, -1e5);
  before = plane;
  element_biaxial(&plane, -1e-3, -1e5);
  double gamma = sqrt(3.0) * (plane.history[0] - before.history[0]);
  double volume = plane.strain[0] - before.strain[0] - 1e-3, slip = plane.strain[0] - before.strain[0] + 1e-3;
  ck_assert_double_eq_tol(volume / slip, sine, tolerance);
  ck_assert_double_eq_tol(volume / gamma, sine / sqrt(1.0 + sine * sine / 3.0), tolerance);
  for (int i = 0; i < 200; i++) element_triaxial(&axial, -5e-4, -1e5);
  before = axial;
  element_triaxial(&axial, -1e-3, -1e5);
  gamma = sqrt(3.0) * (axial.history[0] - before.history[0]);
  volume = 2.0 * (axial.strain[0] - before.strain[0]) - 1e-3;
  ck_assert_double_eq_tol(volume / gamma, 2.0 * sqrt(3.0) * sine / (3.0 - sine), tolerance);
}

START_TEST(dilation)
{
  for (int psi = 0; psi <= 30; psi += 10) {
    struct parameters prm = SOIL(FRICTION(30), COHESION(2e3), DILATION(psi));
    assert_dilation(&prm, sin(psi * degree), 1e-6);
  }
}
END_TEST

/* sin(psi) = (sin 40 - sin 10)/(1 - sin 40 sin 10), 31.88 degrees; the bound of 20 degrees; softened, none is left */
START_TEST(rowe)
{
  struct parameters prm = SOIL(FRICTION(40), {"residual_friction_angle_deg", 10}, {"dilatancy", 1});
  assert_dilation(&prm, 0.52808353, 1e-6);
  prm = SOIL(FRICTION(40), {"residual_friction_angle_deg", 10}, {"dilatancy", 1}, DILATION(20));
  assert_dilation(&prm, sin(20 * degree), 1e-6);
  prm = SOIL(FRICTION(40), {"residual_friction_angle_deg", 10}, {"dilatancy", 1}, {"softening_end", 0.02});
  assert_dilation(&prm, 0.0, 1e-6);
}
END_TEST

/* Pure shear by logarithmic strains e, -e under the mean pressure p: tau = p sin(phi) + c cos(phi) at the plastic shear
 * strain 2 e - tau/G. That is one equation, solved here by halving. */
static double softened(double strain, double p, double fresh, double left, double start, double end)
{
  double low = 0.0, high = 2.0 * shear * strain;
  for (int i = 0; i < 200; i++) {
    double tau = 0.5 * (low + high), gamma = 2.0 * strain - tau / shear;
    double share = fmax(0.0, fmin(1.0, (gamma - start) / (end - start)));
    double phi = (fresh + share * (left - fresh)) * degree, bears = p * sin(phi) + (1.0 - share) * 3e3 * cos(phi);
    *(tau < bears ? &low : &high) = tau;
  }
  return low;
}

START_TEST(softening)
{
  struct parameters prm = SOIL(FRICTION(40), COHESION(3e3), {"residual_cohesion", 0},
                               {"residual_friction_angle_deg", 15}, {"softening_start", 0.02}, {"softening_end", 0.2});
  const double      strains[6] = {0.005, 0.02, 0.05, 0.09, 0.12, 0.2};
  for (int n = 0; n < 6; n++)
    for (int steps = 1; steps <= 100; steps *= 10) {
      struct element e = element_start("mohr_coulomb", &prm, -1e5, -1e5, -1e5);
      for (int i = 0; i < steps; i++) element_stretch(&e, strains[n] / steps, -strains[n] / steps, 0.0);
      double tau = softened(strains[n], 1e5, 40, 15, 0.02, 0.2);
      ck_assert_double_eq_tol(0.5 * (e.stress[XX] - e.stress[YY]), tau, 1e-9 * tau);
      ck_assert_double_eq_tol(sqrt(3.0) * e.history[0], 2.0 * strains[n] - tau / shear, 1e-9);
    }
}
END_TEST

/* Softening so steep that the first slip takes it all: down to the residual strength at once. */
START_TEST(brittle)
{
  struct parameters prm = SOIL(FRICTION(40), {"residual_friction_angle_deg", 15}, {"softening_end", 1e-5});
  struct element    e = element_start("mohr_coulomb", &prm, -1e5, -1e5, -1e5);
  for (int i = 0; i < 100; i++) element_stretch(&e, 3e-4, -3e-4, 0.0);
  ck_assert_double_eq_tol(0.5 * (e.stress[XX] - e.stress[YY]), 1e5 * sin(15 * degree), 1e-9 * 1e5);
}
END_TEST

/* One, ten and a hundred steps of a straight path end alike; with the smooth potential where its gradient does not
 * turn: not in plane strain. */
START_TEST(steps)
{
  const double paths[6][3] = {{0.01, -0.02, 0.01}, {-0.01, 0.02, -0.01}, {0.02, 0.01, 0.02},
                              {0, -0.02, 0},       {0, 0.02, 0},         {0.01, -0.01, 0}};
  for (int flow = 0; flow < 2; flow++)
    for (int cut = 0; cut < 2; cut++)
      for (int n = 0; n < (flow ? 5 : 6); n++) {
        struct parameters prm =
            SOIL(FRICTION(30), COHESION(flow ? 0 : 5e3), DILATION(10), TENSION(cut ? 1e3 : INFINITY), {"flow", flow});
        struct element end[3];
        for (int size = 0, count = 1; size < 3; size++, count *= 10) {
          end[size] = element_start("mohr_coulomb", &prm, -1e4, -1e4, -1e4);
          for (int i = 0; i < count; i++)
            element_stretch(&end[size], paths[n][0] / count, paths[n][1] / count, paths[n][2] / count);
          double scale = fmax(largest(end[0].stress), 1e3);
          for (int k = 0; k < 3; k++)
            ck_assert_msg(fabs(end[size].stress[k] - end[0].stress[k]) <= 1e-6 * scale,
                          "flow %d, cut-off %d, path %d: %d steps give %.9g, one gives %.9g", flow, cut, n, count,
                          end[size].stress[k], end[0].stress[k]);
        }
      }
}
END_TEST

/* Q s Q^T */
static void turned(const double Q[9], const double s[6], double result[6])
{
  double S[9], Qt[9];
  tensor_from_symmetric(s, S);
  tensor_transpose(Q, Qt);
  tensor_product(Q, S, S);
  tensor_product(S, Qt, S);
  tensor_to_symmetric(S, result);
}

/* A third and a fifth of a turn about two axes: any stress and strain of the turned frame end in the turned stress. */
START_TEST(frames)
{
  const double z[9] = {-0.5, -sqrt(0.75), 0, sqrt(0.75), -0.5, 0, 0, 0, 1}, c = cos(0.4 * M_PI), n = sin(0.4 * M_PI);
  const double x[9] = {1, 0, 0, 0, c, -n, 0, n, c};
  const struct parameters soils[3] = {
      SOIL(FRICTION(30), COHESION(5e3), TENSION(1e3)), SOIL(FRICTION(30), COHESION(5e3), DILATION(10), {"flow", 1}),
      SOIL(FRICTION(45), COHESION(1e3), {"residual_friction_angle_deg", 10}, {"softening_end", 0.1}, {"dilatancy", 1})};
  double   Q[9], Qt[9];
  uint64_t seed = 3;
  tensor_product(x, z, Q);
  tensor_transpose(Q, Qt);
  for (int n = 0; n < 3000; n++) {
    struct element e = element_start("mohr_coulomb", &soils[n % 3], -3e4, -3e4, -3e4), seen;
    double         dF[9], dF_seen[9], expected[6];
    for (int k = 0; k < 6; k++) e.stress[k] += 2e4 * battery_random(&seed);
    for (int k = 0; k < 9; k++) dF[k] = (k % 4 == 0) + 0.005 * battery_random(&seed);
    tensor_product(Q, dF, dF_seen);
    tensor_product(dF_seen, Qt, dF_seen);
    seen = e;
    turned(Q, e.stress, seen.stress);
    element_step(&e, dF);
    element_step(&seen, dF_seen);
    turned(Q, e.stress, expected);
    for (int k = 0; k < 6; k++)
      ck_assert_double_eq_tol(seen.stress[k], expected[k], 1e-12 * (largest(expected) + 0.005 * 1e7));
    ck_assert_double_eq_tol(seen.history[0], e.history[0], 1e-12);
  }
}
END_TEST

/* below its strength the same bits as linear elasticity; the yield function says how far below */
START_TEST(elastic)
{
  struct parameters prm = SOIL(FRICTION(30), COHESION(1e6)), *plain = &prm; /* its first two are young, poisson */
  struct element    e = element_start("mohr_coulomb", &prm, -1e5, -1e5, -1e5), same = e;
  uint64_t          seed = 4;
  same.law = constitutive_find("linear_elastic");
  same.prm = plain;
  for (int i = 0; i < 100; i++) {
    double dF[9];
    for (int k = 0; k < 9; k++) dF[k] = (k % 4 == 0) + 1e-3 * battery_random(&seed);
    element_step(&e, dF);
    element_step(&same, dF);
    ck_assert(memcmp(e.stress, same.stress, sizeof e.stress) == 0);
    ck_assert(e.history[0] == 0.0 && e.work == 0.0);
  }
  const double stress[6] = {-1e5, -3e5, -2e5, 0, 0, 0};
  ck_assert_double_eq_tol(e.law->yield(&prm, stress, e.history), 2e5 - 2e5 - 2e6 * cos(30 * degree), 1e-9 * 1e6);
}
END_TEST

START_TEST(refused)
{
  const struct constitutive_model *law = constitutive_find("mohr_coulomb");
  const struct parameters          good = SOIL(FRICTION(30), COHESION(1e3), DILATION(30)),
                          bad[] = {
                              SOIL(FRICTION(30), DILATION(31)),
                              SOIL(FRICTION(30), {"residual_friction_angle_deg", 31}),
                              SOIL(FRICTION(30), COHESION(1e3), {"residual_cohesion", 2e3}),
                              SOIL(FRICTION(30), DILATION(10), {"residual_dilation_angle_deg", 11}),
                              SOIL(FRICTION(30), {"softening_start", 0.1}, {"softening_end", 0.1}),
                              SOIL(FRICTION(30), {"flow", 1}, {"flow_roundness", 1.5}),
                          };
  ck_assert_ptr_null(law->check(&good));
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) ck_assert_ptr_nonnull(law->check(&bad[i]));
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("constitutive/mohr_coulomb");
  TCase *tests = tcase_create("paths");
  tcase_add_test(tests, triaxial);
  tcase_add_test(tests, biaxial);
  tcase_add_test(tests, simple_shear);
  tcase_add_test(tests, tip);
  tcase_add_test(tests, cut_off);
  tcase_add_test(tests, dilation);
  tcase_add_test(tests, rowe);
  tcase_add_test(tests, softening);
  tcase_add_test(tests, brittle);
  tcase_add_test(tests, steps);
  tcase_add_test(tests, frames);
  tcase_add_test(tests, elastic);
  tcase_add_test(tests, refused);
  suite_add_tcase(suite, tests);
  return element_run(suite);
}
