/* Undrained clay in total stress: linear elasticity in rate form and the shear strength k of von Mises,
 * sqrt(J2) <= k, associated, with hardening or softening in the plastic shear strain g = sqrt(3) plastic_strain:
 *   k = shear_strength [1/S + (1 - 1/S) exp(-3 g/softening_strain)] + hardening_modulus g,   S = sensitivity
 * k is the shear stress at failure in simple shear and plane strain. theory 1.3.3 */
#include "constitutive/deviator.h"
#include "constitutive/exponential.h"

struct von_mises {
  struct isotropic elastic;
  double           strength, hardening, sensitivity, softening;
};

static const struct param params[] = {
    ISOTROPIC_PARAMS(struct isotropic, 0.0),
    {"shear_strength", PARAM_NUMBER, offsetof(struct von_mises, strength), "Pa", 1e-6, 1e15, NULL, NULL,
     "shear stress at failure in simple shear: undrained strength"},
    {"hardening_modulus", PARAM_NUMBER, offsetof(struct von_mises, hardening), "Pa", 0, 1e15, "0", NULL,
     "growth of the strength per plastic shear strain"},
    {"sensitivity", PARAM_NUMBER, offsetof(struct von_mises, sensitivity), "-", 1, 1e4, "1", NULL,
     "strength over remoulded strength"},
    {"softening_strain", PARAM_NUMBER, offsetof(struct von_mises, softening), "-", 1e-6, 1e6, "10", NULL,
     "plastic shear strain that takes 95 % of the way to the remoulded strength"},
    PARAM_END,
};

enum { PLASTIC_STRAIN, N_HISTORY };
static const char *const history_names[N_HISTORY] = {"plastic_strain"};

/* k of a plastic shear strain */
static double strength(const struct von_mises *v, double shear)
{
  double share = 1.0 - 1.0 / v->sensitivity;
  return v->strength * (1.0 + share * expm1(-3.0 * shear / v->softening)) + v->hardening * shear;
}

/* Plastic shear strain x of a step that ends on the surface: root of excess = trial - G x - k(shear + x) in the lanes
 * of the mask. It is concave, and positive at 0 where the trial is outside: from the right, Newton's steps stay on the
 * right. */
static void soften(const struct von_mises *v, const MASK *beyond, const VECTOR *trial, const VECTOR *shear,
                   VECTOR *step)
{
  enum { STEPS = 60 };
  double G = isotropic_shear(&v->elastic), rate = 3.0 / v->softening, soft = v->strength * (1.0 - 1.0 / v->sensitivity);
  VECTOR x = (*trial - (v->strength - soft) - v->hardening * *shear) / (G + v->hardening), power, unused, lost;
  power = -rate * *shear;
  vector_exp(&power, &unused, &lost);
  *step = VECTOR_ALL(0.0);
  MASK open = *beyond & (MASK)(*trial > v->strength + soft * lost + v->hardening * *shear);
  for (int i = 0; i < STEPS && vector_any(&open); i++) {
    VECTOR total = *shear + x;
    power = -rate * total;
    vector_exp(&power, &unused, &lost);
    VECTOR excess = *trial - G * x - (v->strength + soft * lost + v->hardening * total);
    VECTOR change = excess / (soft * rate * (1.0 + lost) - v->hardening - G);
    x -= change;
    *step = VECTOR_SELECT(open, VECTOR_MAX(x, VECTOR_ALL(0.0)), *step);
    open &= (MASK)(change > 1e-15 * x);
  }
}

/* the same where softening may be absent: a formula; 0 for lanes that stay elastic */
static void plastic_steps(const struct von_mises *v, const MASK *beyond, const VECTOR *trial, const VECTOR *shear,
                          VECTOR *step)
{
  double G = isotropic_shear(&v->elastic);
  if (v->sensitivity > 1.0) {
    soften(v, beyond, trial, shear, step);
    return;
  }
  *step = (*trial - v->strength - v->hardening * *shear) / (G + v->hardening);
  *step = VECTOR_SELECT(*beyond, *step, VECTOR_ALL(0.0));
}

/* Scales the deviators that are beyond the surface. */
static void radial_return(const struct von_mises *v, int m, double *history, double *work, VECTOR stress[6])
{
  double G = isotropic_shear(&v->elastic);
  VECTOR mean, dev[6], J2, plastic, trial, step, lost;
  deviator_split(stress, &mean, dev, &J2);
  group_load(m, N_HISTORY, history, PLASTIC_STRAIN, &plastic);
  VECTOR shear = shear_of_plastic * plastic;
  VECTOR least = v->strength / v->sensitivity + v->hardening * shear;
  MASK   beyond = (MASK)(J2 > least * least);
  if (!vector_any(&beyond)) return;
  vector_sqrt(&J2, &trial);
  plastic_steps(v, &beyond, &trial, &shear, &step);
  VECTOR scale = 1.0 - G * step / VECTOR_SELECT(beyond, trial, VECTOR_ALL(1.0));
  for (int k = 0; k < 3; k++) stress[k] = VECTOR_SELECT(step > 0.0, mean + scale * dev[k], stress[k]);
  for (int k = 3; k < 6; k++) stress[k] *= scale;
  plastic += step / shear_of_plastic;
  lost = step * (trial - G * step);
  group_store(m, N_HISTORY, &plastic, history, PLASTIC_STRAIN);
  if (work) group_store(m, 1, &lost, work, 0);
}

static int update(const void *prm, int n, double dt, const double *dF, const double *F, double *stress, double *history,
                  double *work)
{
  double lambda = isotropic_lambda(prm), twice_mu = 2.0 * isotropic_shear(prm);
  int    bad = 0;
  (void)dt, (void)F;
  if (work) memset(work, 0, (size_t)n * sizeof *work);
  for (int p = 0; p < n; p += LANES) {
    struct corotate_group g;
    int                   m = corotate_members(n, p);
    bad += corotate_begin(m, &dF[9L * p], &stress[6L * p], &g);
    group_strain(lambda, twice_mu, &g);
    radial_return(prm, m, &history[(long)N_HISTORY * p], work ? &work[p] : NULL, g.stress);
    corotate_end(m, &g, &stress[6L * p]);
  }
  return bad;
}

static double yield(const void *prm, const double *stress, const double *history)
{
  double mean;
  return deviator_size(stress, &mean) - strength(prm, shear_of_plastic * history[PLASTIC_STRAIN]);
}

/* Equal all around: inside the surface however deep. */
static double lateral_ratio(const void *prm)
{
  (void)prm;
  return 1.0;
}

const struct constitutive_model constitutive_von_mises = {
    .name = "von_mises",
    .source = "1.3.3",
    .params = params,
    .param_size = sizeof(struct von_mises),
    .n_history = N_HISTORY,
    .history = history_names,
    .update = update,
    .wave_speed = isotropic_wave_speed,
    .energy = isotropic_energy,
    .yield = yield,
    .oedometer_modulus = isotropic_oedometer,
    .shear_modulus = isotropic_shear_modulus,
    .lateral_ratio = lateral_ratio,
};
