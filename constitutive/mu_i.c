/* Dense granular flow, mu(I) of Jop, Forterre and Pouliquen 2006 in the elastic-viscoplastic form of Dunatunga and
 * Kamrin 2015: linear elasticity in rate form; the shear stress size t = sqrt(J2) and the pressure p obey
 *   t/p <= mu_s,  or  t/p = mu_s + (mu_2 - mu_s)/(I_0/I + 1)  with  I = g' d sqrt(rho/p)
 * with the rate g' of plastic shear strain. Plastic flow keeps the volume. Grains that part have no stress; the volume
 * strain beyond contact is kept, and stress builds up again where it is gone. theory 1.3.5 */
#include "constitutive/cone.h"
#include "constitutive/deviator.h"

struct mu_i {
  struct isotropic elastic;
  double           mu_s, mu_2, I_0, diameter, density;
};

/* The last two are the material's own. */
static const struct param params[] = {
    ISOTROPIC_PARAMS(struct isotropic, 0.0),
    {"mu_s", PARAM_NUMBER, offsetof(struct mu_i, mu_s), "-", 1e-6, 10, NULL, NULL,
     "friction coefficient of slow flow: tangent of the angle of repose"},
    {"mu_2", PARAM_NUMBER, offsetof(struct mu_i, mu_2), "-", 1e-6, 10, NULL, NULL,
     "friction coefficient of very fast flow, at least mu_s"},
    {"I_0", PARAM_NUMBER, offsetof(struct mu_i, I_0), "-", 1e-6, 1e6, "0.279", NULL,
     "inertial number half way between them"},
    {"grain_diameter", PARAM_NUMBER, offsetof(struct mu_i, diameter), "m", 1e-9, 100, NULL, NULL,
     "diameter of a grain"},
    {"density", PARAM_NUMBER, offsetof(struct mu_i, density), "kg/m3", 1e-6, 1e6, NULL, NULL, "density of the grains"},
    PARAM_END,
};

enum { PLASTIC_STRAIN, OPENING, N_HISTORY };
static const char *const history_names[N_HISTORY] = {"plastic_strain", "opening"};

static const char *check(const void *prm)
{
  const struct mu_i *m = prm;
  return m->mu_2 < m->mu_s ? "mu_2 is less than mu_s; give at least mu_s" : NULL;
}

/* What a group's stress is returned with. */
struct flow {
  VECTOR pressure, trial, size; /* Pa: p, t before and after the return */
  VECTOR opening;
};

/* The root below mu_2 p of (trial - t) (mu_2 p - t) = a (t - mu_s p), a = G dt sqrt(p) I_0/(d sqrt(rho)), as mu(I)
 * gives g' = (I_0/d) sqrt(p/rho) (t - mu_s p)/(mu_2 p - t). */
static void flow_size(const struct mu_i *m, double dt, struct flow *f)
{
  VECTOR root, least = m->mu_s * f->pressure, most = m->mu_2 * f->pressure;
  vector_sqrt(&f->pressure, &root);
  VECTOR a = isotropic_shear(&m->elastic) * dt * m->I_0 / (m->diameter * sqrt(m->density)) * root;
  VECTOR difference = (f->trial - most) * (f->trial - most) + a * (2.0 * (f->trial - least + (most - least)) + a);
  vector_sqrt(&difference, &root);
  VECTOR size = 2.0 * (most * f->trial + least * a) / (most + f->trial + a + root);
  f->size = VECTOR_SELECT(f->trial > least, size, f->trial);
}

/* Brings the stress of a group to contact and friction. */
static void flow_return(const struct mu_i *m, double dt, int members, double *history, double *work, VECTOR stress[6])
{
  double      bulk = isotropic_bulk(&m->elastic), G = isotropic_shear(&m->elastic);
  struct flow f;
  VECTOR      mean, dev[6], J2;
  deviator_split(stress, &mean, dev, &J2);
  group_load(members, N_HISTORY, history, OPENING, &f.opening);
  MASK sheared = (MASK)(J2 > m->mu_s * m->mu_s * mean * mean);
  MASK parted = (MASK)((mean > 0.0) | (f.opening > 0.0));
  MASK touched = sheared | parted;
  if (!vector_any(&touched)) return;
  VECTOR moved = mean + bulk * f.opening;
  f.pressure = VECTOR_MAX(-moved, VECTOR_ALL(0.0));
  f.opening = VECTOR_MAX(moved / bulk, VECTOR_ALL(0.0));
  vector_sqrt(&J2, &f.trial);
  flow_size(m, dt, &f);
  VECTOR scale = VECTOR_SELECT(f.trial > 0.0, f.size / f.trial, f.trial), slip = (f.trial - f.size) / G, plastic;
  for (int k = 0; k < 6; k++)
    stress[k] = VECTOR_SELECT(touched, scale * dev[k] - (k < 3 ? f.pressure : VECTOR_ALL(0.0)), stress[k]);
  group_load(members, N_HISTORY, history, PLASTIC_STRAIN, &plastic);
  plastic += slip / shear_of_plastic;
  slip *= f.size;
  group_store(members, N_HISTORY, &plastic, history, PLASTIC_STRAIN);
  group_store(members, N_HISTORY, &f.opening, history, OPENING);
  if (work) group_store(members, 1, &slip, work, 0);
}

static int update(const void *prm, int n, double dt, const double *dF, const double *F, double *stress, double *history,
                  double *work)
{
  double lambda = isotropic_lambda(prm), twice_mu = 2.0 * isotropic_shear(prm);
  int    bad = 0;
  (void)F;
  if (work) memset(work, 0, (size_t)n * sizeof *work);
  for (int p = 0; p < n; p += LANES) {
    struct corotate_group g;
    int                   m = corotate_members(n, p);
    bad += corotate_begin(m, &dF[9L * p], &stress[6L * p], &g);
    group_strain(lambda, twice_mu, &g);
    flow_return(prm, dt, m, &history[(long)N_HISTORY * p], work ? &work[p] : NULL, g.stress);
    corotate_end(m, &g, &stress[6L * p]);
  }
  return bad;
}

/* The elastic speed; where points flow, friction that grows with pressure adds at most (K mu_2)^2/(4 G) to the modulus
 * (cone.h). */
static double wave_speed(const void *prm, int n, const double *rb, const double *stress, const double *history)
{
  const struct mu_i *m = prm;
  double             elastic = isotropic_wave_speed(prm, n, rb, stress, history), lightest = INFINITY, mean;
  bool               flows = false;
  for (int p = 0; p < n; p++) {
    flows |= deviator_size(&stress[6L * p], &mean) > CONE_NEAR * m->mu_s * -mean;
    lightest = fmin(lightest, rb[p]);
  }
  return sqrt(elastic * elastic + flows * cone_stiffening(&m->elastic, m->mu_2, 0.0) / lightest);
}

/* No rate of strain bears more. */
static double yield(const void *prm, const double *stress, const double *history)
{
  double mean, size = deviator_size(stress, &mean);
  (void)history;
  return size + ((const struct mu_i *)prm)->mu_2 * mean;
}

static double lateral_ratio(const void *prm) { return cone_lateral(prm, ((const struct mu_i *)prm)->mu_s); }

const struct constitutive_model constitutive_mu_i = {
    .name = "mu_i",
    .source = "1.3.5",
    .params = params,
    .param_size = sizeof(struct mu_i),
    .n_history = N_HISTORY,
    .history = history_names,
    .viscous = true,
    .check = check,
    .update = update,
    .wave_speed = wave_speed,
    .energy = isotropic_energy,
    .yield = yield,
    .oedometer_modulus = isotropic_oedometer,
    .shear_modulus = isotropic_shear_modulus,
    .lateral_ratio = lateral_ratio,
};
