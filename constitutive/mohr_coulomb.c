/* Mohr and Coulomb's law: linear elastic below a strength that grows with pressure, exact return to it, dilation, a
 * cut-off in tension, softening with the plastic shear strain. theory 1.3.1 */
#include "constitutive/coulomb.h"
#include "constitutive/isotropic.h"
#include "constitutive/principal.h"

enum { CONSTANT, ROWE };
enum { FLOW_MOHR_COULOMB, FLOW_MENETREY_WILLAM };

struct mohr_coulomb {
  double young, poisson;                        /* Pa, - */
  double friction, cohesion, dilation, tension; /* deg, Pa, deg, Pa; of the intact soil */
  double residual_friction, residual_cohesion;  /* deg, Pa */
  double residual_dilation;                     /* deg */
  double softening_start, softening_end;        /* plastic shear strain */
  double roundness, eccentricity;               /* of Menetrey and Willam's potential */
  int    dilatancy, flow;
};

#define SQRT3 1.73205080756887729353 /* plastic shear strain over plastic_strain */
#define SQRT2 1.41421356237309504880
#define AT(member) offsetof(struct mohr_coulomb, member)
static const struct param params[] = {
    ISOTROPIC_PARAMS(struct mohr_coulomb, 0.0),
    {"friction_angle_deg", PARAM_NUMBER, AT(friction), "deg", 0, 60, NULL, NULL, "friction angle, at its peak"},
    {"cohesion", PARAM_NUMBER, AT(cohesion), "Pa", 0, 1e12, "0", NULL, "cohesion, at its peak"},
    {"dilation_angle_deg", PARAM_NUMBER, AT(dilation), "deg", 0, INFINITY, "null", NULL,
     "dilation angle, at most the friction angle; null: 0. With dilatancy rowe the largest one; null: no bound"},
    {"tension_strength", PARAM_NUMBER, AT(tension), "Pa", 0, INFINITY, "infinite", NULL,
     "largest tensile stress (Rankine); \"infinite\": what cohesion and friction bear"},
    {"residual_friction_angle_deg", PARAM_NUMBER, AT(residual_friction), "deg", 0, INFINITY, "null", NULL,
     "friction angle after softening, at most the peak; null: the peak"},
    {"residual_cohesion", PARAM_NUMBER, AT(residual_cohesion), "Pa", 0, INFINITY, "null", NULL,
     "cohesion after softening, at most the peak; null: the peak"},
    {"residual_dilation_angle_deg", PARAM_NUMBER, AT(residual_dilation), "deg", 0, INFINITY, "null", NULL,
     "dilation angle after softening, at most the first; null: the first"},
    {"softening_start", PARAM_NUMBER, AT(softening_start), "-", 0, 1e6, "0", NULL,
     "plastic shear strain where softening starts"},
    {"softening_end", PARAM_NUMBER, AT(softening_end), "-", 0, INFINITY, "infinite", NULL,
     "plastic shear strain where it ends; \"infinite\": there is none"},
    {"dilatancy", PARAM_CHOICE, AT(dilatancy), "-", 0, 0, "constant", "constant|rowe",
     "dilation angle as given, or from the present and the residual friction angle (Rowe)"},
    {"flow", PARAM_CHOICE, AT(flow), "-", 0, 0, "mohr_coulomb", "mohr_coulomb|menetrey_willam",
     "plastic potential: planes, or Menetrey and Willam's smooth one"},
    {"flow_roundness", PARAM_NUMBER, AT(roundness), "-", 0.51, INFINITY, "null", NULL,
     "e of menetrey_willam, at most 1; null: (3 - sin phi)/(3 + sin phi)"},
    {"flow_eccentricity", PARAM_NUMBER, AT(eccentricity), "-", 0, 10, "0.1", NULL,
     "eps of menetrey_willam: rounds the tip of the potential of a cohesive soil"},
    PARAM_END};

static const char *check(const void *prm)
{
  const struct mohr_coulomb *m = prm;
  if (!isinf(m->dilation) && m->dilation > m->friction)
    return "dilation_angle_deg is above friction_angle_deg: yielding would make energy; choose at most the friction "
           "angle";
  if (!isinf(m->residual_friction) && m->residual_friction > m->friction)
    return "residual_friction_angle_deg is above friction_angle_deg; choose less, the soil softens only";
  if (!isinf(m->residual_cohesion) && m->residual_cohesion > m->cohesion)
    return "residual_cohesion is above cohesion; choose less, the soil softens only";
  if (!isinf(m->residual_dilation) && m->residual_dilation > (isinf(m->dilation) ? 0.0 : m->dilation))
    return "residual_dilation_angle_deg is above dilation_angle_deg; choose less, the soil softens only";
  if (m->softening_end < m->softening_start + 1e-6)
    return "softening_end is not above softening_start; choose at least 1e-6 more";
  if (!isinf(m->roundness) && m->roundness > 1.0) return "flow_roundness is above 1; choose 0.51 to 1";
  return NULL;
}

/* The parameters as the update wants them: Pa, radians; `loss` is peak less residual. */
struct soil {
  struct coulomb_elastic elastic;
  struct coulomb_flow    flow;
  double                 phi, cohesion, psi, phi_loss, cohesion_loss, psi_loss;
  double                 start, slope; /* of softening: the share that is lost is slope (plastic_strain - start) */
  double                 tension, sin_phi, cos_phi, sin_residual, cos_gain, sin_most; /* sin_most: of psi */
  bool                   softens, rowe;
};

static double radians(double degrees) { return degrees * (M_PI / 180.0); }

static void read_flow(const struct mohr_coulomb *m, struct soil *soil)
{
  double sine = soil->sin_phi, round = isinf(m->roundness) ? (3.0 - sine) / (3.0 + sine) : fmin(m->roundness, 1.0);
  soil->flow.roundness = m->flow == FLOW_MENETREY_WILLAM ? round : 0.0;
  soil->flow.meridian = (3.0 - sine) / (6.0 * soil->cos_phi);
  soil->flow.blunt = m->eccentricity * m->cohesion;
}

static void read_soil(const void *prm, struct soil *soil)
{
  const struct mohr_coulomb *m = prm;
  double                     residual = radians(fmin(m->residual_friction, m->friction));
  bool                       same = m->residual_friction >= m->friction;
  soil->elastic.lambda = isotropic_lambda(prm);
  soil->elastic.shear = isotropic_shear(prm);
  soil->elastic.bulk = soil->elastic.lambda + 2.0 / 3.0 * soil->elastic.shear;
  soil->phi = radians(m->friction);
  soil->cohesion = m->cohesion;
  soil->psi = isinf(m->dilation) ? 0.0 : radians(fmin(m->dilation, m->friction));
  soil->phi_loss = soil->phi - residual;
  soil->cohesion_loss = fmax(0.0, m->cohesion - m->residual_cohesion);
  soil->psi_loss = fmax(0.0, soil->psi - radians(m->residual_dilation));
  soil->start = m->softening_start / SQRT3;
  soil->softens = m->softening_end < INFINITY;
  soil->slope = soil->softens ? SQRT3 / (m->softening_end - m->softening_start) : 0.0;
  soil->tension = m->tension;
  soil->rowe = m->dilatancy == ROWE;
  soil->sin_phi = sin(soil->phi);
  soil->cos_phi = cos(soil->phi);
  soil->sin_residual = same ? soil->sin_phi : sin(residual);
  soil->cos_gain = same ? 0.0 : cos(residual) - soil->cos_phi;
  soil->sin_most = soil->rowe ? sin(radians(fmin(m->dilation, m->friction))) : sin(soil->psi);
  read_flow(m, soil);
}

/* Taylor's series, to 2e-17 up to 60 degrees */
static void sine(const VECTOR *angle, VECTOR *sine)
{
  static const double under[] = {16 * 17, 14 * 15, 12 * 13, 10 * 11, 8 * 9, 6 * 7, 4 * 5, 2 * 3};
  VECTOR              square = *angle * *angle, sum = VECTOR_ALL(1.0);
  for (int i = 0; i < 8; i++) sum = 1.0 - square * sum * (1.0 / under[i]);
  *sine = *angle * sum;
}

/* The share of the losses that a plastic strain has brought. */
static void lost_at(const struct soil *soil, const VECTOR *strain, VECTOR *lost)
{
  VECTOR share = (*strain - soil->start) * soil->slope;
  share = VECTOR_MAX(share, VECTOR_ALL(0.0));
  *lost = VECTOR_MIN(share, VECTOR_ALL(1.0));
}

/* sin(psi) of a share lost, at most sin(phi) */
static void dilatancy_at(const struct soil *soil, const VECTOR *lost, struct coulomb_strength *s)
{
  VECTOR psi = soil->psi - *lost * soil->psi_loss;
  if (soil->rowe) { /* M(100) */
    s->sin_psi = (s->sin_phi - soil->sin_residual) / (1.0 - s->sin_phi * soil->sin_residual);
    s->sin_psi = VECTOR_MIN(s->sin_psi, VECTOR_ALL(soil->sin_most));
    s->sin_psi = VECTOR_MAX(s->sin_psi, VECTOR_ALL(0.0));
  } else if (soil->psi_loss > 0.0) {
    sine(&psi, &s->sin_psi);
  } else {
    s->sin_psi = VECTOR_ALL(soil->sin_most);
  }
  s->sin_psi = VECTOR_MIN(s->sin_psi, s->sin_phi);
}

/* What a plastic strain has left. */
static void strength_at(const struct soil *soil, const VECTOR *strain, struct coulomb_strength *s)
{
  VECTOR lost, phi, square, cosine;
  lost_at(soil, strain, &lost);
  phi = soil->phi - lost * soil->phi_loss;
  sine(&phi, &s->sin_phi);
  square = 1.0 - s->sin_phi * s->sin_phi;
  vector_sqrt(&square, &cosine);
  s->cohesive = 2.0 * (soil->cohesion - lost * soil->cohesion_loss) * cosine;
  s->tip = VECTOR_SELECT(s->sin_phi > 0.0, 0.5 * s->cohesive / s->sin_phi, VECTOR_ALL(INFINITY));
  s->tension = VECTOR_MIN(s->tip, VECTOR_ALL(soil->tension));
  dilatancy_at(soil, &lost, s);
}

/* Bounds of what a plastic strain has left, at less cost: sine and cosine are above their chords. No tension. */
static void least_strength_at(const struct soil *soil, const VECTOR *strain, struct coulomb_strength *s)
{
  VECTOR lost;
  lost_at(soil, strain, &lost);
  s->sin_phi = soil->sin_phi - lost * (soil->sin_phi - soil->sin_residual);
  s->cohesive = 2.0 * (soil->cohesion - lost * soil->cohesion_loss) * (soil->cos_phi + lost * soil->cos_gain);
  s->tension = VECTOR_ALL(0.0);
}

/* Lanes that may be outside: the others are below the smooth cone that touches Mohr and Coulomb's planes from inside,
 * sqrt(J2) sqrt(1 + sin^2(phi)/3) + p sin(phi) = c cos(phi), and have no principal stress above the cut-off. */
static void suspect(const struct soil *soil, const struct coulomb_strength *s, const VECTOR S[6], MASK *outside)
{
  double widest = 1.0 + soil->sin_phi * soil->sin_phi / 3.0;
  VECTOR mean = (S[XX] + S[YY] + S[ZZ]) * (1.0 / 3.0), a = S[XX] - S[YY], b = S[YY] - S[ZZ], c = S[ZZ] - S[XX];
  VECTOR J2 = (a * a + b * b + c * c) * (1.0 / 6.0) + (S[XY] * S[XY] + S[YZ] * S[YZ] + S[XZ] * S[XZ]);
  VECTOR bears = 0.5 * s->cohesive - mean * s->sin_phi, room = s->tension - mean;
  *outside = (MASK)(J2 * widest > bears * bears) | (MASK)(bears < 0.0) | (MASK)(4.0 / 3.0 * J2 > room * room) |
             (MASK)(room < 0.0);
}

/* One return of a group: Pa, and sqrt(2/3 e:e) of the deviator e of its plastic strain. */
struct step {
  VECTOR trial[3], value[3], slip;
};

static void step_end(const struct soil *soil, const struct coulomb_strength *s, struct step *step)
{
  coulomb_return(&soil->elastic, s, &soil->flow, step->trial, step->value);
  VECTOR a = step->trial[0] - step->value[0], b = step->trial[1] - step->value[1], c = step->trial[2] - step->value[2];
  VECTOR square = (a - b) * (a - b) + (b - c) * (b - c) + (c - a) * (c - a);
  vector_sqrt(&square, &step->slip);
  step->slip *= SQRT2 / 6.0 / soil->elastic.shear;
}

/* Finds the plastic strain at the end, x = start + slip(x), above `start` and below what takes the whole deviator. A
 * lane that is done keeps x and the step made with it: its stress is on the surface of that x exactly. */
static void soften(const struct soil *soil, const struct coulomb_strength *now, const MASK *yields, VECTOR *strain,
                   struct step *step)
{
  enum { STEPS = 80 };
  VECTOR        start = *strain;
  MASK          open = *yields;
  struct step   next = *step;
  struct search search = {.low = start, .last = start};
  step_end(soil, now, step);
  search.high = start + (step->trial[2] - step->trial[0]) / soil->elastic.shear;
  search.last_gap = -step->slip;
  search.at = start + step->slip;
  for (int i = 0; i < STEPS && vector_any(&open); i++) {
    struct coulomb_strength s;
    strength_at(soil, &search.at, &s);
    step_end(soil, &s, &next);
    for (int k = 0; k < 3; k++) step->value[k] = VECTOR_SELECT(open, next.value[k], step->value[k]);
    *strain = VECTOR_SELECT(open, search.at, *strain);
    VECTOR gap = search.at - start - next.slip;
    open &= (MASK)(VECTOR_ABS(gap) > 1e-13 * search.at);
    search_next(&search, &gap);
  }
}

/* Plastic work: stress times plastic strain, mean and deviator. */
static void plastic_work(const struct coulomb_elastic *e, const struct step *step, VECTOR *work)
{
  const VECTOR *s = step->value, *t = step->trial;
  VECTOR        mean = (s[0] + s[1] + s[2]) / 3.0, lost = (t[0] + t[1] + t[2]) / 3.0 - mean;
  *work = mean * lost / e->bulk;
  for (int k = 0; k < 3; k++) *work += s[k] * (t[k] - s[k] - lost) * (0.5 / e->shear);
}

/* Returns the lanes of a group that are outside. strain: its plastic strain (in/out); lost: plastic work, J/m3 */
static void return_group(const struct soil *soil, const struct coulomb_strength *now, MASK *outside, VECTOR stress[6],
                         VECTOR *strain, VECTOR *lost)
{
  struct principal p;
  struct step      step;
  VECTOR           returned[6];
  principal_split(stress, &p);
  memcpy(step.trial, p.value, sizeof step.trial);
  *outside &= (MASK)(COULOMB_YIELD(now, step.trial) > 0.0) | (MASK)(step.trial[2] > now->tension);
  *lost = VECTOR_ALL(0.0);
  if (!vector_any(outside)) return;
  if (soil->softens) {
    soften(soil, now, outside, strain, &step);
  } else {
    step_end(soil, now, &step);
    *strain += step.slip;
  }
  principal_join(&p, step.value, returned);
  for (int k = 0; k < 6; k++) stress[k] = VECTOR_SELECT(*outside, returned[k], stress[k]);
  plastic_work(&soil->elastic, &step, lost);
}

/* A group after its elastic step. intact: strength before softening; history, work: of its first point */
static void yield_group(const struct soil *soil, const struct coulomb_strength *intact, int m, VECTOR stress[6],
                        double *history, double *work)
{
  const struct coulomb_strength *now = intact;
  struct coulomb_strength        left;
  VECTOR                         strain = VECTOR_ALL(0.0), lost;
  MASK                           outside;
  if (soil->softens) {
    for (int i = 0; i < m; i++) strain[i] = history[i];
    least_strength_at(soil, &strain, &left);
    now = &left;
  }
  suspect(soil, now, stress, &outside);
  if (!vector_any(&outside)) return;
  for (int i = 0; i < m; i++) strain[i] = history[i];
  if (soil->softens) strength_at(soil, &strain, &left);
  return_group(soil, now, &outside, stress, &strain, &lost);
  for (int i = 0; i < m; i++) {
    if (!outside[i]) continue;
    history[i] = strain[i];
    if (work) work[i] = lost[i];
  }
}

static int update(const void *prm, int n, double dt, const double *dF, const double *F, double *stress, double *history,
                  double *work)
{
  struct soil             soil;
  struct coulomb_strength intact;
  VECTOR                  none = VECTOR_ALL(0.0);
  int                     bad = 0;
  (void)dt, (void)F;
  read_soil(prm, &soil);
  strength_at(&soil, &none, &intact);
  if (work) memset(work, 0, (size_t)n * sizeof *work);
  for (int p = 0; p < n; p += LANES) {
    struct corotate_group g;
    int                   m = corotate_members(n, p);
    bad += corotate_begin(m, &dF[9L * p], &stress[6L * p], &g);
    VECTOR volume = soil.elastic.lambda * (g.strain[XX] + g.strain[YY] + g.strain[ZZ]);
    for (int k = 0; k < 3; k++) g.stress[k] += volume;
    for (int k = 0; k < 6; k++) g.stress[k] += 2.0 * soil.elastic.shear * g.strain[k];
    yield_group(&soil, &intact, m, g.stress, &history[p], work ? &work[p] : NULL);
    corotate_end(m, &g, &stress[6L * p]);
  }
  return bad;
}

static double yield(const void *prm, const double *stress, const double *history)
{
  struct soil             soil;
  struct coulomb_strength now;
  struct principal        p;
  VECTOR                  strain = VECTOR_ALL(history[0]), group[6];
  read_soil(prm, &soil);
  strength_at(&soil, &strain, &now);
  for (int k = 0; k < 6; k++) group[k] = VECTOR_ALL(stress[k]);
  principal_split(group, &p);
  VECTOR sheared = COULOMB_YIELD(&now, p.value), opened = p.value[2] - now.tension;
  return fmax(sheared[0], opened[0]);
}

/* Elastic, unless that is outside: then Rankine's active pressure. */
static double lateral_ratio(const void *prm)
{
  const struct mohr_coulomb *m = prm;
  double                     sine = sin(radians(m->friction));
  return fmax(isotropic_lateral(prm), (1.0 - sine) / (1.0 + sine));
}

/* How far the acoustic tensor's largest eigenvalue exceeds E_oed where the flow is not associated, Pa: -u_N v_N/h, with
 * N.D.b = u, N.D.a = v and h = a.D.b of slip on a plane or on the edge of triaxial compression, for the worst N. Each
 * product is (u_0 - u_1 x)(v_0 - v_1 x), x up to 1. */
static double excess(const struct coulomb_elastic *e, double phi, double psi)
{
  double both = e->lambda + e->shear, x = fmin(1.0, 0.5 * both * (phi + psi) / e->shear), most = 0.0;
  most = -4.0 * (both * psi - e->shear * x) * (both * phi - e->shear * x) /
         (4.0 * e->lambda * phi * psi + 4.0 * e->shear * (1.0 + phi * psi));
  double u_0 = 2.0 * e->lambda * psi + e->shear * (1.0 + psi), u_1 = e->shear * (3.0 - psi);
  double v_0 = 2.0 * e->lambda * phi + e->shear * (1.0 + phi), v_1 = e->shear * (3.0 - phi);
  x = fmin(1.0, 0.5 * (u_0 / u_1 + v_0 / v_1));
  return fmax(most, -(u_0 - u_1 * x) * (v_0 - v_1 * x) /
                        (4.0 * e->lambda * phi * psi +
                         e->shear * ((1.0 + phi) * (1.0 + psi) + 2.0 * (1.0 - phi) * (1.0 - psi))));
}

/* Points that have yielded may do so again. */
static double wave_speed(const void *prm, int n, const double *rb, const double *stress, const double *history)
{
  const struct mohr_coulomb *m = prm;
  double                     elastic = isotropic_wave_speed(prm, n, rb, stress, history);
  struct coulomb_elastic     e = {.lambda = isotropic_lambda(prm), .shear = isotropic_shear(prm)};
  bool                       yielded = false;
  for (int p = 0; p < n; p++) yielded |= history[p] > 0.0;
  if (!yielded) return elastic;
  double psi = isinf(m->dilation) || m->dilatancy == ROWE ? 0.0 : fmin(m->dilation, m->residual_dilation);
  return elastic * sqrt(1.0 + excess(&e, sin(radians(m->friction)), sin(radians(psi))) / isotropic_oedometer(prm));
}

static const char *const history_names[] = {"plastic_strain"};

const struct constitutive_model constitutive_mohr_coulomb = {
    .name = "mohr_coulomb",
    .source = "1.3.1",
    .params = params,
    .param_size = sizeof(struct mohr_coulomb),
    .check = check,
    .n_history = 1,
    .history = history_names,
    .update = update,
    .wave_speed = wave_speed,
    .energy = isotropic_energy,
    .yield = yield,
    .oedometer_modulus = isotropic_oedometer,
    .shear_modulus = isotropic_shear_modulus,
    .lateral_ratio = lateral_ratio,
};
