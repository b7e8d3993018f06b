/* Modified Cam-clay (Roscoe and Burland 1968) in effective stress. With pressure p, q = sqrt(3 J2), specific volume v:
 *   elastic   v = -kappa ln p,  K = v p/kappa,  G = 3 (1 - 2 nu)/(2 (1 + nu)) K
 *   ellipse   q^2/M^2 + p (p - pc) <= 0, associated;  hardening  v_plastic = -(lambda - kappa) ln pc
 * Lines in v over ln p are exact for steps of any size. Below the floor pressure K is that of the floor. theory 1.3.4
 */
#include "constitutive/clay.h"
#include "constitutive/deviator.h"
#include "constitutive/exponential.h"

struct cam_clay {
  double kappa, lambda, M, friction, poisson, void_ratio, preconsolidation, overconsolidation, floor;
};

#define AT(member) offsetof(struct cam_clay, member)
static const struct param params[] = {
    {"kappa", PARAM_NUMBER, AT(kappa), "-", 1e-5, 1, NULL, NULL, "slope of swelling lines in v over ln p"},
    {"lambda", PARAM_NUMBER, AT(lambda), "-", 1e-4, 10, NULL, NULL, "slope of the compression line in v over ln p"},
    {"M", PARAM_NUMBER, AT(M), "-", 0, 3, "0", NULL, "q/p of the critical state; 0: from friction_angle_deg"},
    {"friction_angle_deg", PARAM_NUMBER, AT(friction), "deg", 0, 60, "0", NULL,
     "friction angle of the critical state in triaxial compression, M = 6 sin/(3 - sin); 0: M is given"},
    {"poisson", PARAM_NUMBER, AT(poisson), "-", 0, 0.499, NULL, NULL, "Poisson's ratio of the skeleton"},
    {"void_ratio", PARAM_NUMBER, AT(void_ratio), "-", 0.01, 50, NULL, NULL,
     "pore over grain volume at the start: porosity/(1 - porosity)"},
    {"preconsolidation_pressure", PARAM_NUMBER, AT(preconsolidation), "Pa", 0, 1e12, "0", NULL,
     "isotropic pressure that the soil has borne before; raised to what the start asks for"},
    {"overconsolidation_ratio", PARAM_NUMBER, AT(overconsolidation), "-", 1, 1e6, "1", NULL,
     "length of the ellipse over that of the one through the stress at the start"},
    {"floor_pressure", PARAM_NUMBER, AT(floor), "Pa", 1e-6, 1e9, "1e3", NULL,
     "least pressure that stiffness is taken from; half the least length of the ellipse"},
    PARAM_END,
};

enum { PLASTIC_STRAIN, PRECONSOLIDATION, SPECIFIC_VOLUME, N_HISTORY };
static const char *const history_names[N_HISTORY] = {"plastic_strain", "preconsolidation_pressure", "specific_volume"};

static const char *check(const void *prm)
{
  const struct cam_clay *m = prm;
  if (m->lambda <= m->kappa) return "lambda must be above kappa; raise lambda or lower kappa";
  if (m->M == 0.0 && m->friction == 0.0) return "M and friction_angle_deg are both missing; give one of them";
  if (m->M > 0.0 && m->friction > 0.0) return "M and friction_angle_deg are both given; remove one of them";
  return NULL;
}

static double slope(const struct cam_clay *m)
{
  double sine = sin(m->friction * (M_PI / 180.0));
  return m->M > 0.0 ? m->M : 6.0 * sine / (3.0 - sine);
}

static struct clay read_clay(const void *prm)
{
  const struct cam_clay *m = prm;
  return (struct clay){.kappa = m->kappa,
                       .plastic = m->lambda - m->kappa,
                       .M = slope(m),
                       .shear = 1.5 * (1.0 - 2.0 * m->poisson) / (1.0 + m->poisson),
                       .floor = m->floor};
}

/* Elastic step of a group. */
struct elastic {
  VECTOR p0, p;      /* Pa, before and after */
  VECTOR change, v;  /* of the specific volume; its mean */
  VECTOR s[6], e[6]; /* deviators of the stress before and of the strain */
};

/* Pressures that stay above the floor by the exponential, others in the measure that goes on below. */
static void compress(const struct clay *c, struct elastic *t, VECTOR *secant)
{
  const double most = 1e100; /* floors: beyond, squares might overflow */
  VECTOR       y = -t->change / c->kappa, unused, growth, x0, x, p, measured;
  vector_exp(&y, &unused, &growth);
  t->p = t->p0 + t->p0 * growth;
  *secant = VECTOR_SELECT(y != 0.0, t->p0 * growth / y, t->p0);
  MASK measure = (MASK)(t->p0 < c->floor) | (MASK)(t->p < c->floor) | (MASK)(t->p > most * c->floor);
  if (!vector_any(&measure)) return;
  clay_measure(c, &t->p0, &x0);
  x = x0 + y;
  clay_pressure(c, &x, &p);
  clay_secant(c, &t->p0, &x0, &p, &x, &measured);
  t->p = VECTOR_SELECT(measure, p, t->p);
  *secant = VECTOR_SELECT(measure, measured, *secant);
}

/* Adds the elastic stress of the group's strain; answers it in parts. */
static void strain(const struct clay *c, const VECTOR *v, struct corotate_group *g, struct elastic *t)
{
  VECTOR volume = g->strain[XX] + g->strain[YY] + g->strain[ZZ], mean, unused, growth, secant;
  deviator_split(g->stress, &mean, t->s, &unused);
  deviator_split(g->strain, &unused, t->e, &secant);
  vector_exp(&volume, &unused, &growth);
  t->p0 = -mean;
  t->change = *v * growth;
  t->v = VECTOR_SELECT(volume != 0.0, t->change / volume, *v);
  compress(c, t, &secant);
  VECTOR twice_G = 2.0 * c->shear / c->kappa * t->v * secant;
  for (int k = 0; k < 6; k++) g->stress[k] += twice_G * t->e[k];
  for (int k = 0; k < 3; k++) g->stress[k] -= t->p - t->p0;
}

/* a:b of symmetric tensors */
static void contract(const VECTOR a[6], const VECTOR b[6], VECTOR *sum)
{
  *sum = (a[XX] * b[XX] + a[YY] * b[YY] + a[ZZ] * b[ZZ]) + 2.0 * (a[XY] * b[XY] + a[YZ] * b[YZ] + a[XZ] * b[XZ]);
}

/* Stress of the lanes outside. */
static void return_lanes(const struct clay *c, const struct elastic *t, const VECTOR *pc, const MASK *outside,
                         struct clay_state *end, VECTOR stress[6])
{
  struct clay_step step = {.p = t->p0, .pc = *pc, .change = t->change, .v = t->v};
  VECTOR           trial[6], square, size;
  contract(t->s, t->s, &step.ss);
  contract(t->s, t->e, &step.se);
  contract(t->e, t->e, &step.ee);
  clay_return(c, &step, outside, end);
  for (int k = 0; k < 6; k++) trial[k] = t->s[k] + 2.0 * end->shear * t->e[k];
  contract(trial, trial, &square);
  square *= 1.5;
  vector_sqrt(&square, &size);
  VECTOR scale = VECTOR_SELECT(size > 0.0, end->q / size, size);
  for (int k = 0; k < 6; k++) {
    VECTOR returned = scale * trial[k];
    if (k < 3) returned -= end->p;
    stress[k] = VECTOR_SELECT(*outside, returned, stress[k]);
  }
}

/* Returns what is outside of the ellipse by more than round-off. */
static void return_group(const struct clay *c, int m, const struct elastic *t, double *history, double *work,
                         VECTOR stress[6])
{
  const double      round_off = 1e-14;
  struct clay_state end;
  VECTOR            mean, dev[6], J2, pc, length, least = VECTOR_ALL(2.0 * c->floor);
  deviator_split(stress, &mean, dev, &J2);
  group_load(m, N_HISTORY, history, PRECONSOLIDATION, &pc);
  length = VECTOR_MAX(pc, least);
  VECTOR sheared = 3.0 * J2 / (c->M * c->M), pressed = -mean * (length + mean), size = VECTOR_ABS(pressed);
  MASK   outside = (MASK)(sheared - pressed > round_off * (sheared + size));
  if (!vector_any(&outside)) return;
  return_lanes(c, t, &pc, &outside, &end, stress);
  for (int i = 0; i < m; i++) {
    double *own = &history[N_HISTORY * i];
    if (!outside[i]) continue;
    own[PRECONSOLIDATION] = end.pc[i];
    own[PLASTIC_STRAIN] += end.plastic[i];
    if (work) work[i] = end.p[i] * end.compression[i] + end.q[i] * end.plastic[i];
  }
}

static int update(const void *prm, int n, double dt, const double *dF, const double *F, double *stress, double *history,
                  double *work)
{
  struct clay c = read_clay(prm);
  int         bad = 0;
  (void)dt, (void)F;
  if (work) memset(work, 0, (size_t)n * sizeof *work);
  for (int p = 0; p < n; p += LANES) {
    struct corotate_group g;
    struct elastic        t;
    VECTOR                v;
    int                   m = corotate_members(n, p);
    double               *own = &history[(long)N_HISTORY * p];
    bad += corotate_begin(m, &dF[9L * p], &stress[6L * p], &g);
    group_load(m, N_HISTORY, own, SPECIFIC_VOLUME, &v);
    strain(&c, &v, &g, &t);
    return_group(&c, m, &t, own, work ? &work[p] : NULL, g.stress);
    v += t.change;
    group_store(m, N_HISTORY, &v, own, SPECIFIC_VOLUME);
    corotate_end(m, &g, &stress[6L * p]);
  }
  return bad;
}

/* The ellipse through the start stress, longer by the overconsolidation ratio. Stresses beyond the critical state count
 * as on it. */
static void start(const void *prm, int n, const double *stress, double *history)
{
  const struct cam_clay *m = prm;
  struct clay            c = read_clay(prm);
  for (int i = 0; i < n; i++) {
    double  mean, q = sqrt(3.0) * deviator_size(&stress[6L * i], &mean), p = fmax(0.0, -mean);
    double  share = p > 0.0 ? fmin(1.0, q / (c.M * p)) : 0.0, through = p * (1.0 + share * share);
    double *own = &history[(long)N_HISTORY * i];
    own[PLASTIC_STRAIN] = 0.0;
    own[PRECONSOLIDATION] = fmax(2.0 * c.floor, fmax(m->preconsolidation, m->overconsolidation * through));
    own[SPECIFIC_VOLUME] = 1.0 + m->void_ratio;
  }
}

/* Pa, of p and v */
static double bulk(const struct clay *c, double p, double v) { return v * fmax(p, c->floor) / c->kappa; }

/* As linear elasticity with the present moduli, E_oed = K + 4/3 G. */
static double wave_speed(const void *prm, int n, const double *rb, const double *stress, const double *history)
{
  struct clay c = read_clay(prm);
  double      largest = 0.0, lightest = INFINITY;
  for (int i = 0; i < n; i++) {
    double mean, size = deviator_size(&stress[6L * i], &mean);
    double K = bulk(&c, -mean, history[(long)N_HISTORY * i + SPECIFIC_VOLUME]);
    largest = fmax(largest, K * (1.0 + 4.0 / 3.0 * c.shear) + size);
    lightest = fmin(lightest, rb[i]);
  }
  return sqrt(largest / lightest);
}

/* Integral of p over the elastic compression, and q^2/(6 G). */
static void energy(const void *prm, int n, const double *F, const double *stress, const double *history, double *energy)
{
  struct clay c = read_clay(prm);
  (void)F;
  for (int i = 0; i < n; i++) {
    double mean, size = deviator_size(&stress[6L * i], &mean), p = -mean;
    double v = history[(long)N_HISTORY * i + SPECIFIC_VOLUME], G = c.shear * bulk(&c, p, v);
    double volume = p > c.floor ? p - 0.5 * c.floor : 0.5 * p * p / c.floor;
    energy[i] = c.kappa / v * volume + 0.5 * size * size / G;
  }
}

static double yield(const void *prm, const double *stress, const double *history)
{
  struct clay c = read_clay(prm);
  double mean, q = sqrt(3.0) * deviator_size(stress, &mean), length = fmax(2.0 * c.floor, history[PRECONSOLIDATION]);
  return (q * q / (c.M * c.M) + mean * (mean + length)) / length;
}

/* of no stress: at the floor */
static double shear_modulus(const void *prm)
{
  struct clay c = read_clay(prm);
  return c.shear * bulk(&c, 0.0, 1.0 + ((const struct cam_clay *)prm)->void_ratio);
}

static double oedometer_modulus(const void *prm)
{
  return shear_modulus(prm) * (1.0 / read_clay(prm).shear + 4.0 / 3.0);
}

/* Jaky's 1 - sin(phi) of normally consolidated soil, or elastic */
static double lateral_ratio(const void *prm)
{
  const struct cam_clay *m = prm;
  double                 M = slope(m);
  return fmax(m->poisson / (1.0 - m->poisson), 1.0 - 3.0 * M / (6.0 + M));
}

const struct constitutive_model constitutive_cam_clay = {
    .name = "cam_clay",
    .source = "1.3.4",
    .params = params,
    .param_size = sizeof(struct cam_clay),
    .n_history = N_HISTORY,
    .history = history_names,
    .check = check,
    .update = update,
    .wave_speed = wave_speed,
    .energy = energy,
    .start = start,
    .yield = yield,
    .oedometer_modulus = oedometer_modulus,
    .shear_modulus = shear_modulus,
    .lateral_ratio = lateral_ratio,
};
