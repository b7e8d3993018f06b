/* Compressible neo-Hookean solid: stress = lambda ln(J)/J I + mu/J (F F^T - I); energy per reference volume
 * mu/2 (tr F^T F - 3) - mu ln J + lambda/2 (ln J)^2. The stress follows from F alone: a pre-stress must be in F. */
#include "constitutive/isotropic.h"
#include "core/tensor.h"

static const struct param params[] = {ISOTROPIC_PARAMS(struct isotropic), PARAM_END};

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

/* Pa: bound of the acoustic tensor's eigenvalues: longitudinal lambda' + 2 mu' or shear mu', plus the largest stress */
static inline double tangent(double lambda, double mu, const struct deformation *d)
{
  double        l = lambda / d->J, m = (mu - lambda * d->log_J) / d->J;
  const double *b = d->b;
  double        size =
      sqrt(b[XX] * b[XX] + b[YY] * b[YY] + b[ZZ] * b[ZZ] + 2.0 * (b[XY] * b[XY] + b[YZ] * b[YZ] + b[XZ] * b[XZ]));
  return fmax(l + 2.0 * m, m) + (lambda * d->log_J + mu * size) / d->J;
}

/* history: Pa, tangent modulus, which the wave speed needs and the stress alone does not tell */
static int update(const void *prm, int n, double dt, const double *dF, const double *F, double *stress, double *history,
                  double *work)
{
  double lambda = isotropic_lambda(prm), mu = isotropic_shear(prm);
  int    bad = 0;
  (void)dt, (void)dF;
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
    history[p] = tangent(lambda, mu, &d);
  }
  return bad;
}

static double wave_speed(const void *prm, int n, const double *rb, const double *stress, const double *history)
{
  double rest = isotropic_oedometer(prm), largest = 0.0;
  (void)stress;
  for (int p = 0; p < n; p++) largest = fmax(largest, (history[p] > 0.0 ? history[p] : rest) / rb[p]);
  return sqrt(largest);
}

static void energy(const void *prm, int n, const double *F, const double *stress, double *energy)
{
  double lambda = isotropic_lambda(prm), mu = isotropic_shear(prm);
  (void)stress;
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
    .n_history = 1,
    .update = update,
    .wave_speed = wave_speed,
    .energy = energy,
    .oedometer_modulus = isotropic_oedometer,
    .lateral_ratio = isotropic_lateral,
};
