/* Hencky elasticity and Drucker and Prager's cone, F(15)-(19), non-associated. Of the Kirchhoff stress tau = J stress:
 *   tau = lambda tr(e) I + 2 mu e,   sqrt(J2) + eta mean <= xi c J
 * with the elastic strain e in principal axes, which the return keeps. Volume that is gained at the tip is kept as
 * `opening`: it must close before pressure builds up again (Klar et al. 2016, Tampubolon et al. 2017). theory 1.3.2 */
#include "constitutive/cone.h"
#include "constitutive/deviator.h"
#include "constitutive/hencky.h"

enum { CONE_PLANE_STRAIN, CONE_COMPRESSION, CONE_EXTENSION, CONE_PLANE_FLOW };

struct drucker_prager {
  struct isotropic elastic;
  double           friction, cohesion, dilation; /* deg, Pa, deg */
  int              cone;
};

#define AT(member) offsetof(struct drucker_prager, member)
static const struct param params[] = {
    ISOTROPIC_PARAMS(struct isotropic, 0.0),
    {"friction_angle_deg", PARAM_NUMBER, AT(friction), "deg", 0, 60, NULL, NULL, "friction angle of Mohr and Coulomb"},
    {"cohesion", PARAM_NUMBER, AT(cohesion), "Pa", 0, 1e12, "0", NULL, "cohesion of Mohr and Coulomb"},
    {"dilation_angle_deg", PARAM_NUMBER, AT(dilation), "deg", 0, 60, "0", NULL,
     "dilation angle, at most the friction angle"},
    {"cone", PARAM_CHOICE, AT(cone), "-", 0, 0, "plane_strain", "plane_strain|compression|extension|plane_flow",
     "where it has Mohr and Coulomb's strength: in plane strain with associated flow, in triaxial compression (outer "
     "edges) or extension (inner edges), in plane strain with the given dilation"},
    PARAM_END,
};

/* history: opening, the volume strain beyond the tip; swelling, J - 1 */
enum { PLASTIC_STRAIN, OPENING, SWELLING, N_HISTORY };
static const char *const history_names[N_HISTORY] = {"plastic_strain", "opening", "swelling"};

static const char *check(const void *prm)
{
  const struct drucker_prager *d = prm;
  if (d->dilation > d->friction) return "dilation_angle_deg is above friction_angle_deg; give at most that";
  if (d->friction == 0.0 && d->cohesion == 0.0)
    return "friction_angle_deg and cohesion are both 0, which leaves no strength; give one of them";
  return NULL;
}

/* The parameters as the update wants them. */
struct cone {
  double lambda, mu, bulk; /* Pa */
  double eta, flow;        /* slopes of the cone and of the potential */
  double strength;         /* Pa, xi c */
  double tip;              /* Pa, mean stress at the tip, may be infinite */
  double hardness;         /* Pa, mu + bulk eta flow */
};

/* xi and eta = xi tan(angle) of the cone that is matched at Mohr and Coulomb's edges, or as F(18)-(19) in plane strain
 */
static double slope(int cone, double angle, double *xi)
{
  double side = cone == CONE_COMPRESSION ? -1.0 : 1.0,
         edge = 6.0 * cos(angle) / (sqrt(3.0) * (3.0 + side * sin(angle)));
  bool edges = cone == CONE_COMPRESSION || cone == CONE_EXTENSION;
  *xi = edges ? edge : 3.0 / sqrt(9.0 + 12.0 * tan(angle) * tan(angle));
  return *xi * tan(angle);
}

/* The same in plane strain where plastic strain along z vanishes by a potential of slope `flow`: there the deviator is
 * s_z = -2/3 flow sqrt(J2). */
static double slope_of_flow(double angle, double flow, double *xi)
{
  *xi = cos(angle) / (sqrt(1.0 - flow * flow / 3.0) + sin(angle) * flow / 3.0);
  return *xi * tan(angle);
}

static void read_cone(const void *prm, struct cone *c)
{
  const struct drucker_prager *d = prm;
  double                       xi, unused, angle = d->friction * (M_PI / 180.0);
  c->lambda = isotropic_lambda(prm);
  c->mu = isotropic_shear(prm);
  c->bulk = isotropic_bulk(prm);
  c->flow = slope(d->cone, d->dilation * (M_PI / 180.0), &unused);
  c->eta = d->cone == CONE_PLANE_FLOW ? slope_of_flow(angle, c->flow, &xi) : slope(d->cone, angle, &xi);
  c->strength = xi * d->cohesion;
  c->tip = c->eta > 0.0 ? c->strength / c->eta : INFINITY;
  c->hardness = c->mu + c->bulk * c->eta * c->flow;
}

/* A group at the end of a step: Kirchhoff stress, history, J, plastic work */
struct trial {
  VECTOR stress[6], mean, dev[6], size; /* Pa; size sqrt(J2) */
  VECTOR J, swelling, plastic, opening; /* - */
  VECTOR work;                          /* J/m3 of present volume */
};

/* The mean stress of a gap that was opened is between 0 and the tip's: below, the gap closes first. */
static void close_gap(const struct cone *c, struct trial *t)
{
  VECTOR zero = VECTOR_ALL(0.0), needed = VECTOR_MAX(-t->mean, zero) / c->bulk, left = t->opening - needed;
  VECTOR rest = VECTOR_MAX(t->mean, zero), pressed = t->mean + c->bulk * t->opening;
  t->mean = VECTOR_SELECT(left >= 0.0, rest, pressed);
  t->opening = VECTOR_MAX(left, zero);
}

/* To the tip: what there was of a deviator is plastic, and the volume opens. */
static void return_to_tip(const struct cone *c, struct trial *t, MASK *there)
{
  VECTOR zero = VECTOR_ALL(0.0), tip = c->tip * t->J, beyond = t->mean - tip, opened = beyond / c->bulk;
  *there = (MASK)(beyond > c->bulk * c->flow / c->mu * t->size);
  t->opening += VECTOR_SELECT(*there, opened, zero);
  t->plastic += VECTOR_SELECT(*there, t->size / (c->mu * shear_of_plastic), zero);
  t->work = VECTOR_SELECT(*there, c->tip * opened, zero);
  t->mean = VECTOR_SELECT(*there, tip, t->mean);
}

/* To the cone; `size` becomes that of the returned stress. */
static void return_to_cone(const struct cone *c, const MASK *at_tip, struct trial *t)
{
  VECTOR zero = VECTOR_ALL(0.0), slip = (t->size + c->eta * t->mean - c->strength * t->J) / c->hardness, on_cone;
  MASK   yields = (MASK)(slip > 0.0) & ~*at_tip;
  slip = VECTOR_SELECT(yields, slip, zero);
  t->mean -= c->bulk * c->flow * slip;
  on_cone = VECTOR_MAX(c->strength * t->J - c->eta * t->mean, zero);
  t->size = VECTOR_SELECT(yields, on_cone, t->size);
  t->size = VECTOR_SELECT(*at_tip, zero, t->size);
  t->plastic += slip / shear_of_plastic;
  t->work += slip * (t->size + c->flow * t->mean) / t->J;
}

/* The trial stress, where it is outside, to the surface. */
static void return_stress(const struct cone *c, struct trial *t)
{
  VECTOR J2, bears, trial, scale, returned;
  MASK   outside, at_tip;
  deviator_split(t->stress, &t->mean, t->dev, &J2);
  t->work = VECTOR_ALL(0.0);
  bears = c->strength * t->J - c->eta * t->mean;
  outside = (MASK)(J2 > bears * bears) | (MASK)(bears < 0.0) | (MASK)(t->opening > 0.0);
  if (!vector_any(&outside)) return;
  vector_sqrt(&J2, &trial);
  t->size = trial;
  close_gap(c, t);
  return_to_tip(c, t, &at_tip);
  return_to_cone(c, &at_tip, t);
  scale = VECTOR_SELECT(trial > 0.0, t->size / trial, trial);
  for (int k = 0; k < 6; k++) {
    returned = scale * t->dev[k];
    if (k < 3) returned += t->mean;
    t->stress[k] = VECTOR_SELECT(outside, returned, t->stress[k]);
  }
}

/* Kirchhoff stress of the elastic strain that a group has after its step */
static int strain(const struct cone *c, int m, const double *dF, const double *stress, const double *history,
                  struct trial *t, MASK *refused)
{
  VECTOR e[6], J, growth, mean;
  group_load(m, N_HISTORY, history, PLASTIC_STRAIN, &t->plastic);
  group_load(m, N_HISTORY, history, OPENING, &t->opening);
  group_load(m, N_HISTORY, history, SWELLING, &t->swelling);
  for (int k = 0; k < 6; k++) group_load(m, 6, stress, k, &e[k]);
  J = 1.0 + t->swelling;
  mean = (e[XX] + e[YY] + e[ZZ]) / 3.0;
  for (int k = 0; k < 6; k++) e[k] *= J / (2.0 * c->mu);
  for (int k = 0; k < 3; k++) e[k] += J * mean * (1.0 / (3.0 * c->bulk) - 1.0 / (2.0 * c->mu));
  int bad = hencky_step(m, dF, e, &growth, refused);
  t->swelling += growth + t->swelling * growth;
  t->J = 1.0 + t->swelling;
  mean = c->lambda * (e[XX] + e[YY] + e[ZZ]);
  for (int k = 0; k < 6; k++) t->stress[k] = 2.0 * c->mu * e[k];
  for (int k = 0; k < 3; k++) t->stress[k] += mean;
  return bad;
}

static void store(int m, const MASK *refused, struct trial *t, double *stress, double *history, double *work)
{
  for (int k = 0; k < 6; k++) t->stress[k] /= t->J;
  for (int i = 0; i < m; i++) {
    if ((*refused)[i]) continue;
    for (int k = 0; k < 6; k++) stress[6 * i + k] = t->stress[k][i];
    history[N_HISTORY * i + PLASTIC_STRAIN] = t->plastic[i];
    history[N_HISTORY * i + OPENING] = t->opening[i];
    history[N_HISTORY * i + SWELLING] = t->swelling[i];
    if (work) work[i] = t->work[i];
  }
}

static int update(const void *prm, int n, double dt, const double *dF, const double *F, double *stress, double *history,
                  double *work)
{
  struct cone c;
  int         bad = 0;
  (void)dt, (void)F;
  read_cone(prm, &c);
  if (work) memset(work, 0, (size_t)n * sizeof *work);
  for (int p = 0; p < n; p += LANES) {
    struct trial t;
    MASK         refused;
    int          m = corotate_members(n, p);
    double      *own = &history[(long)N_HISTORY * p];
    bad += strain(&c, m, &dF[9L * p], &stress[6L * p], own, &t, &refused);
    return_stress(&c, &t);
    store(m, &refused, &t, &stress[6L * p], own, work ? &work[p] : NULL);
  }
  return bad;
}

/* The acoustic tensor of Hencky's solid: E_oed/J - mean + D sqrt(2/3) along a principal axis at most, D = |deviator| of
 * the Cauchy stress; E_oed grows with the stretch by (x/2) coth(x/2) < 1 + x^2/12, x < sqrt(2) D J/mu, in oblique
 * directions; and what the cone may add. */
static double wave_speed(const void *prm, int n, const double *rb, const double *stress, const double *history)
{
  const struct isotropic *e = prm;
  struct cone             c;
  double                  largest = 0.0, lightest = INFINITY;
  read_cone(prm, &c);
  double elastic = isotropic_oedometer(e), more = cone_stiffening(e, c.eta, c.flow);
  for (int p = 0; p < n; p++) {
    double mean, size = deviator_size(&stress[6L * p], &mean), J = 1.0 + history[(long)N_HISTORY * p + SWELLING];
    double near = size > CONE_NEAR * (c.strength - c.eta * mean) ? more : 0.0, stretch = J * size / c.mu;
    double modulus = (elastic * (1.0 + stretch * stretch / 3.0) + near) / J;
    largest = fmax(largest, modulus + fmax(0.0, -mean) + size * sqrt(4.0 / 3.0));
    lightest = fmin(lightest, rb[p]);
  }
  return sqrt(largest / lightest);
}

/* Hencky's energy over J: that of linear elasticity with tau = J stress */
static void energy(const void *prm, int n, const double *F, const double *stress, const double *history, double *energy)
{
  isotropic_energy(prm, n, F, stress, history, energy);
  for (int p = 0; p < n; p++) energy[p] *= 1.0 + history[(long)N_HISTORY * p + SWELLING];
}

static double yield(const void *prm, const double *stress, const double *history)
{
  struct cone c;
  double      mean, size = deviator_size(stress, &mean);
  (void)history;
  read_cone(prm, &c);
  return size + c.eta * mean - c.strength;
}

static double lateral_ratio(const void *prm)
{
  struct cone c;
  read_cone(prm, &c);
  return cone_lateral(prm, c.eta);
}

const struct constitutive_model constitutive_drucker_prager = {
    .name = "drucker_prager",
    .source = "1.3.2",
    .params = params,
    .param_size = sizeof(struct drucker_prager),
    .n_history = N_HISTORY,
    .history = history_names,
    .check = check,
    .update = update,
    .wave_speed = wave_speed,
    .energy = energy,
    .yield = yield,
    .oedometer_modulus = isotropic_oedometer,
    .shear_modulus = isotropic_shear_modulus,
    .lateral_ratio = lateral_ratio,
};
