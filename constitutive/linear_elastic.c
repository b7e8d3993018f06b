/* Linear elasticity in rate form: the co-rotated stress grows by lambda tr(e) I + 2 mu e with the logarithmic strain e
 * of the step. In one dimension: stress = E_oed ln J. */
#include "constitutive/corotate.h"
#include "constitutive/isotropic.h"

static const struct param params[] = {ISOTROPIC_PARAMS(struct isotropic, -0.99), PARAM_END};

static int update(const void *prm, int n, double dt, const double *dF, const double *F, double *stress, double *history,
                  double *work)
{
  double lambda = isotropic_lambda(prm), twice_mu = 2.0 * isotropic_shear(prm);
  int    bad = 0;
  (void)dt, (void)F, (void)history;
  if (work) memset(work, 0, (size_t)n * sizeof *work);
  for (int p = 0; p < n; p += LANES) {
    struct corotate_group g;
    int                   m = corotate_members(n, p);
    bad += corotate_begin(m, &dF[9L * p], &stress[6L * p], &g);
    VECTOR volume = lambda * (g.strain[XX] + g.strain[YY] + g.strain[ZZ]);
    for (int k = 0; k < 3; k++) g.stress[k] += volume;
    for (int k = 0; k < 6; k++) g.stress[k] += twice_mu * g.strain[k];
    corotate_end(m, &g, &stress[6L * p]);
  }
  return bad;
}

/* The acoustic tensor of a Cauchy stress that turns with the material: longitudinal E_oed, shear mu + (s_N - s_m)/2. As
 * (s_1 - s_3)^2 <= 2 dev:dev, their sum is below E_oed + sqrt(dev:dev/2). One root and one quotient for all points. */
static double wave_speed(const void *prm, int n, const double *rb, const double *stress, const double *history)
{
  double largest = 0.0, lightest = INFINITY;
  (void)history;
  for (int p = 0; p < n; p++) {
    const double *s = &stress[6L * p];
    double        a = s[XX] - s[YY], b = s[YY] - s[ZZ], c = s[ZZ] - s[XX];
    double        dev = (a * a + b * b + c * c) / 3.0 + 2.0 * (s[XY] * s[XY] + s[YZ] * s[YZ] + s[XZ] * s[XZ]);
    largest = dev > largest ? dev : largest;
    lightest = rb[p] < lightest ? rb[p] : lightest;
  }
  return sqrt((isotropic_oedometer(prm) + sqrt(0.5 * largest)) / lightest);
}

/* s:s (1 + nu) - nu tr(s)^2 over 2 E */
static void energy(const void *prm, int n, const double *F, const double *stress, const double *history, double *energy)
{
  const struct isotropic *e = prm;
  (void)F, (void)history;
  for (int p = 0; p < n; p++) {
    const double *s = &stress[6L * p];
    double        trace = s[XX] + s[YY] + s[ZZ];
    double        square =
        s[XX] * s[XX] + s[YY] * s[YY] + s[ZZ] * s[ZZ] + 2.0 * (s[XY] * s[XY] + s[YZ] * s[YZ] + s[XZ] * s[XZ]);
    energy[p] = ((1.0 + e->poisson) * square - e->poisson * trace * trace) / (2.0 * e->young);
  }
}

const struct constitutive_model constitutive_linear_elastic = {
    .name = "linear_elastic",
    .source = "1, Skeleton models",
    .params = params,
    .param_size = sizeof(struct isotropic),
    .update = update,
    .wave_speed = wave_speed,
    .energy = energy,
    .oedometer_modulus = isotropic_oedometer,
    .lateral_ratio = isotropic_lateral,
};
