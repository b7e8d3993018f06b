/* Compressible neo-Hookean solid: stress = lambda ln(J)/J I + mu/J (F F^T - I); energy per reference volume
 * mu/2 (tr F^T F - 3) - mu ln J + lambda/2 (ln J)^2. The stress follows from F alone: a pre-stress must be in F. */
#include "constitutive/isotropic.h"
#include "core/tensor.h"

/* With lambda < 0 the energy is not convex in J: such a body would collapse. */
static const struct param params[] = {ISOTROPIC_PARAMS(struct isotropic, 0.0), PARAM_END};

/* Differences from I keep the digits of small strains. */
struct deformation {
  double b[6]; /* F F^T - I */
  double J, log_J;
};

static inline void measure(const double F[9], struct deformation *d)
{
  double a = F[0] - 1.0, e = F[4] - 1.0, r = F[8] - 1.0, volume;
  d->b[XX] = 2.0 * a + (a * a + F[1] * F[1] + F[2] * F[2]);
  d->b[YY] = 2.0 * e + (F[3] * F[3] + e * e + F[5] * F[5]);
  d->b[ZZ] = 2.0 * r + (F[6] * F[6] + F[7] * F[7] + r * r);
  d->b[XY] = F[1] + F[3] + (a * F[3] + F[1] * e + F[2] * F[5]);
  d->b[YZ] = F[5] + F[7] + (F[3] * F[6] + e * F[7] + F[5] * r);
  d->b[XZ] = F[2] + F[6] + (a * F[6] + F[1] * F[7] + F[2] * r);
  volume = (a + e + r) + (a * e + e * r + a * r) + a * e * r;
  volume -= F[1] * F[3] * F[8] + F[5] * F[7] * F[0] + F[2] * F[6] * F[4];
  volume += F[1] * F[5] * F[6] + F[2] * F[3] * F[7];
  d->J = 1.0 + volume;
  d->log_J = volume > -1.0 ? log1p(volume) : NAN;
}

static int update(const void *prm, int n, double dt, const double *dF, const double *F, double *stress, double *history,
                  double *work)
{
  double lambda = isotropic_lambda(prm), mu = isotropic_shear(prm);
  int    bad = 0;
  (void)dt, (void)dF, (void)history;
  if (work) memset(work, 0, (size_t)n * sizeof *work);
  for (int p = 0; p < n; p++) {
    struct deformation d;
    measure(&F[9L * p], &d);
    if (!(d.J > 0.0) || isinf(d.J)) {
      bad++;
      continue;
    }
    double pressure = lambda * d.log_J / d.J, shear = mu / d.J;
    for (int k = 0; k < 6; k++) stress[6L * p + k] = shear * d.b[k] + (k < 3 ? pressure : 0.0);
  }
  return bad;
}

/* ln of the smallest J that a smallest principal stress s allows: b_3 <= J^(2/3), so s <= (lambda ln J + mu (J^(2/3) -
 * 1))/J, which grows with J below 1. With y = ln J the root of a convex, growing function: Newton from y = 0. */
static double smallest_log_J(double lambda, double mu, double s)
{
  enum { STEPS = 50 };
  double y = 0.0;
  if (s >= 0.0) return 0.0;
  for (int i = 0; i < STEPS; i++) {
    double two_thirds = mu * exp(2.0 / 3.0 * y), pull = s * exp(y);
    double change = (lambda * y + two_thirds - mu - pull) / (lambda + 2.0 / 3.0 * two_thirds - pull);
    y -= change;
    if (!(change > 1e-12)) break;
  }
  return y;
}

/* The acoustic tensor's largest eigenvalue, (lambda + 2 mu - 2 lambda ln J)/J + s_1, falls with J; the stress bounds J.
 */
static double wave_speed(const void *prm, int n, const double *rb, const double *stress, const double *history)
{
  double lambda = isotropic_lambda(prm), mu = isotropic_shear(prm), highest = -INFINITY, lowest = INFINITY,
         lightest = INFINITY;
  (void)history;
  for (int p = 0; p < n; p++) {
    const double *s = &stress[6L * p];
    double        a = s[XX] - s[YY], b = s[YY] - s[ZZ], c = s[ZZ] - s[XX], mean = (s[XX] + s[YY] + s[ZZ]) / 3.0;
    double        dev = (a * a + b * b + c * c) / 3.0 + 2.0 * (s[XY] * s[XY] + s[YZ] * s[YZ] + s[XZ] * s[XZ]);
    double        spread = sqrt(2.0 / 3.0 * dev); /* no principal stress is farther from the mean */
    highest = fmax(highest, mean + spread);
    lowest = fmin(lowest, mean - spread);
    lightest = fmin(lightest, rb[p]);
  }
  double log_J = smallest_log_J(lambda, mu, lowest);
  return sqrt(fmax(0.0, (lambda + 2.0 * mu - 2.0 * lambda * log_J) * exp(-log_J) + highest) / lightest);
}

static void energy(const void *prm, int n, const double *F, const double *stress, const double *history, double *energy)
{
  double lambda = isotropic_lambda(prm), mu = isotropic_shear(prm);
  (void)stress, (void)history;
  for (int p = 0; p < n; p++) {
    struct deformation d;
    measure(&F[9L * p], &d);
    double trace = d.b[XX] + d.b[YY] + d.b[ZZ];
    energy[p] = (mu * (0.5 * trace - d.log_J) + 0.5 * lambda * d.log_J * d.log_J) / d.J;
  }
}

const struct constitutive_model constitutive_neo_hookean = {
    .name = "neo_hookean",
    .source = "1, Skeleton models",
    .params = params,
    .param_size = sizeof(struct isotropic),
    .total = true,
    .update = update,
    .wave_speed = wave_speed,
    .energy = energy,
    .oedometer_modulus = isotropic_oedometer,
    .shear_modulus = isotropic_shear_modulus,
    .lateral_ratio = isotropic_lateral,
};
