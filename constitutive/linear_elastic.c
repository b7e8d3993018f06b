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

const struct constitutive_model constitutive_linear_elastic = {
    .name = "linear_elastic",
    .source = "1, Skeleton models",
    .params = params,
    .param_size = sizeof(struct isotropic),
    .update = update,
    .wave_speed = isotropic_wave_speed,
    .energy = isotropic_energy,
    .oedometer_modulus = isotropic_oedometer,
    .shear_modulus = isotropic_shear_modulus,
    .lateral_ratio = isotropic_lateral,
};
