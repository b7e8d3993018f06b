/* Elastic disk in plane strain that turns about its axis: the steady state, and how a disk that is set spinning without
 * stress breathes about it. Small strain; Coriolis and (omega R/c)^2 are neglected. docs/references.md, "Turning disk".
 */
#include "references/elastic.h"
#include "references/reference.h"

struct disk {
  double young, poisson, density, radius, spin, centre[3];
};

static const struct param params[] = {
    {"young", PARAM_NUMBER, offsetof(struct disk, young), "Pa", 1e-6, 1e15, NULL, NULL, "Young's modulus"},
    {"poisson", PARAM_NUMBER, offsetof(struct disk, poisson), "-", -0.99, 0.499, NULL, NULL, "Poisson's ratio"},
    {"density", PARAM_NUMBER, offsetof(struct disk, density), "kg/m3", 1e-9, 1e9, NULL, NULL, "density"},
    {"radius", PARAM_NUMBER, offsetof(struct disk, radius), "m", 1e-9, 1e9, NULL, NULL, "radius"},
    {"spin", PARAM_NUMBER, offsetof(struct disk, spin), "1/s", -1e6, 1e6, NULL, NULL, "angular velocity at the start"},
    {"centre", PARAM_VECTOR, offsetof(struct disk, centre), "m", -1e9, 1e9, NULL, NULL, "centre"},
    PARAM_END,
};

enum { RADIAL, RIM, DISTANCE, RIM_STATIC, STRESS_R_STATIC, STRESS_T_STATIC, KINETIC, ANGULAR_Z, FREQUENCY, ANGULAR };
enum { MODES = 60 };

static double modulus(const struct disk *d) { return elastic_oedometer(d->young, d->poisson); }

static double wave_speed(const struct disk *d) { return sqrt(modulus(d) / d->density); }

/* The rim carries no stress: x J0(x) - (1 - 2 nu)/(1 - nu) J1(x) = 0. */
static double rim_condition(const struct disk *d, double x)
{
  return x * j0(x) - (1.0 - 2.0 * d->poisson) / (1.0 - d->poisson) * j1(x);
}

/* m-th root, m = 0, 1, ...: one between two neighbouring extrema of J0, that is between zeros of J1 */
static double root(const struct disk *d, int m)
{
  double low = m == 0 ? 1e-6 : (m + 0.25) * M_PI, high = (m + 1.25) * M_PI, sign;
  for (int end = 0; end < 2; end++) { /* zeros of J1 by Newton from McMahon's estimate; J1' = J0 - J1/x */
    double *x = end ? &high : &low;
    for (int i = 0; i < 20 && *x > 1.0; i++) *x -= j1(*x) / (j0(*x) - j1(*x) / *x);
  }
  sign = rim_condition(d, low * (1 + 1e-9)) > 0 ? 1 : -1;
  while (high - low > 1e-14 * high) {
    double middle = 0.5 * (low + high);
    if (sign * rim_condition(d, middle) > 0)
      low = middle;
    else
      high = middle;
  }
  return 0.5 * (low + high);
}

/* m at distance r; rho omega^2/(8 E') (1 - nu') r ((3 + nu') R^2 - (1 + nu') r^2), primes: plane strain */
static double steady(const struct disk *d, double r)
{
  double E = d->young / (1 - d->poisson * d->poisson), nu = d->poisson / (1 - d->poisson), R = d->radius;
  return d->density * d->spin * d->spin * (1 - nu) / (8 * E) * r * ((3 + nu) * R * R - (1 + nu) * r * r);
}

/* Amplitude of mode J1(x r/R) in the steady displacement: rho omega^2/(M k^2) int r^2 J1 / int r J1^2 */
static double amplitude(const struct disk *d, double x)
{
  double R = d->radius, k = x / R, J1 = j1(x), slope = j0(x) - J1 / x;
  double moment = R * R * jn(2, x) / k, norm = 0.5 * R * R * (slope * slope + (1 - 1 / (x * x)) * J1 * J1);
  return d->density * d->spin * d->spin / (modulus(d) * k * k) * moment / norm;
}

/* frequencies and amplitudes of all modes, made once per call of value() */
struct breath {
  double x[MODES], a[MODES];
};

static void breathe(const struct disk *d, struct breath *b)
{
  for (int m = 0; m < MODES; m++) {
    b->x[m] = root(d, m);
    b->a[m] = amplitude(d, b->x[m]);
  }
}

/* m, radial displacement at distance r and time t of a disk that started without */
static double radial(const struct disk *d, const struct breath *b, double r, double t)
{
  double R = d->radius, u = 0.0;
  for (int m = 0; m < MODES; m++) u += b->a[m] * j1(b->x[m] * r / R) * (1.0 - cos(b->x[m] * wave_speed(d) / R * t));
  return u;
}

/* Pa; tangential with hoop true */
static double steady_stress(const struct disk *d, double r, bool hoop)
{
  double nu = d->poisson / (1 - d->poisson), R = d->radius;
  return d->density * d->spin * d->spin / 8 * ((3 + nu) * R * R - (hoop ? 1 + 3 * nu : 3 + nu) * r * r);
}

static double one(const struct disk *d, const struct breath *b, int quantity, const double x[3], double t)
{
  double R = d->radius, r = fmin(hypot(x[0] - d->centre[0], x[1] - d->centre[1]), R);
  double inertia = 0.5 * M_PI * d->density * R * R * R * R;
  switch (quantity) {
  case RADIAL:
    return radial(d, b, r, t);
  case RIM:
    return radial(d, b, R, t);
  case DISTANCE:
    return R + radial(d, b, R, t);
  case RIM_STATIC:
    return steady(d, R);
  case STRESS_R_STATIC:
    return steady_stress(d, r, false);
  case STRESS_T_STATIC:
    return steady_stress(d, r, true);
  case KINETIC:
    return 0.5 * inertia * d->spin * d->spin;
  case ANGULAR_Z:
    return inertia * d->spin;
  case FREQUENCY:
    return b->x[0] * wave_speed(d) / R / (2 * M_PI);
  default:
    return b->x[0] * wave_speed(d) / R;
  }
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  struct breath b;
  breathe(prm, &b);
  for (int i = 0; i < n; i++) v[i] = one(prm, &b, quantity, x[i], t);
  return OK;
}

/* one turn */
static double time_scale(const void *prm) { return 2.0 * M_PI / fabs(((const struct disk *)prm)->spin); }

static double scale(const void *prm, int quantity)
{
  const struct disk *d = prm;
  struct breath      b;
  if (quantity <= RIM_STATIC) return steady(d, d->radius);
  breathe(d, &b);
  return fabs(one(d, &b, quantity == STRESS_T_STATIC ? STRESS_R_STATIC : quantity, d->centre, 0.0));
}

const struct reference reference_rotating_disk = {
    .name = "rotating_disk",
    .source = "steady rotation and radial modes",
    .params = params,
    .param_size = sizeof(struct disk),
    .quantities = "displacement_r|rim|distance|rim_static|stress_r_static|stress_t_static|kinetic|angular_z|frequency|"
                  "angular_frequency",
    .value = value,
    .time_scale = time_scale,
    .scale = scale,
};
