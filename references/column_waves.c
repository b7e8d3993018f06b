/* Waves and consolidation of a saturated column under a sudden or ramped load, with the inertia of both phases, drag
 * and compressible water. docs/references.md, "Waves in a saturated column". */
#include "references/column_waves.h"

#include "references/elastic.h"

static const struct param params[] = {
    {"young", PARAM_NUMBER, offsetof(struct column_waves, young), "Pa", 1e-6, 1e15, NULL, NULL, "Young's modulus"},
    {"poisson", PARAM_NUMBER, offsetof(struct column_waves, poisson), "-", -0.99, 0.499, NULL, NULL, "Poisson's ratio"},
    {"solid_density", PARAM_NUMBER, offsetof(struct column_waves, solid_density), "kg/m3", 1e-3, 1e5, NULL, NULL,
     "density of the grains"},
    {"bulk_modulus", PARAM_NUMBER, offsetof(struct column_waves, bulk_modulus), "Pa", 1, 1e15, NULL, NULL,
     "bulk modulus of the liquid"},
    CONDUCTIVITY_PARAMS(struct column_waves, pores),
    {"height", PARAM_NUMBER, offsetof(struct column_waves, height), "m", 1e-9, 1e9, NULL, NULL, "height of the column"},
    {"load", PARAM_NUMBER, offsetof(struct column_waves, load), "Pa", -1e12, 1e12, NULL, NULL,
     "pressure of the load on the skeleton"},
    {"ramp", PARAM_NUMBER, offsetof(struct column_waves, ramp), "s", 0, 1e9, "0", NULL,
     "time in which the load grows linearly; 0: at once"},
    {"base", PARAM_NUMBER, offsetof(struct column_waves, base), "m", -1e9, 1e9, "0", NULL, "y of the base"},
    {"water", PARAM_NUMBER, offsetof(struct column_waves, water), "m", 0, 1e9, "0", NULL,
     "height of clear liquid above the column"},
    {"terms", PARAM_INTEGER, offsetof(struct column_waves, terms), "-", 1, 100000, "500", NULL,
     "modes that are summed"},
    PARAM_END,
};

enum { P, STRESS_YY, DISPLACEMENT_Y, SETTLEMENT, FREQUENCY, ANGULAR, DECAY };
enum { BATCH = 64 };

void column_matrices_make(const struct column_waves *c, struct column_matrices *m)
{
  double n = c->pores.porosity, s = 1.0 - n, K = c->bulk_modulus, trace, root;
  m->M = elastic_oedometer(c->young, c->poisson);
  m->r[0] = s * c->solid_density;
  m->r[1] = n * c->pores.density;
  m->drag = n * n * c->pores.density * c->pores.gravity / conductivity(&c->pores);
  m->s11 = m->M + s * s * K / n;
  m->s12 = s * K;
  m->s22 = n * K;
  trace = m->s11 / m->r[0] + m->s22 / m->r[1];
  root = sqrt(trace * trace - 4.0 * m->M * m->s22 / (m->r[0] * m->r[1]));
  m->speed = sqrt(0.5 * (trace + root));
}

static enum status no_mode(void)
{
  return FAIL(ERR_INPUT, "column_waves: frequency and decay are known without clear liquid above only; set water to 0");
}

static double pick(const struct column_state *s, int quantity)
{
  switch (quantity) {
  case P:
    return s->pressure;
  case STRESS_YY:
    return s->stress;
  case DISPLACEMENT_Y:
    return s->displacement;
  default:
    return -s->displacement;
  }
}

static void states(const struct column_waves *c, int quantity, int n, const double (*x)[3], double t, double *v)
{
  double              z[BATCH];
  struct column_state s[BATCH] = {0};
  double              top = quantity == P ? c->height + c->water : c->height;
  for (int i = 0; i < n; i++) z[i] = quantity == SETTLEMENT ? c->height : fmin(fmax(x[i][1] - c->base, 0.0), top);
  if (t > 0.0) (c->water > 0.0 ? column_transform_states : column_modes_states)(c, n, z, t, s);
  for (int i = 0; i < n; i++) v[i] = pick(&s[i], quantity);
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  const struct column_waves *c = prm;
  double                     angular, decay;
  if (conductivity(&c->pores) <= 0.0)
    return FAIL(ERR_INPUT, "column_waves: permeability and grain_diameter are both 0; give one");
  if (quantity < FREQUENCY) {
    for (int i = 0; i < n; i += BATCH) states(c, quantity, n - i < BATCH ? n - i : BATCH, x + i, t, v + i);
    return OK;
  }
  if (c->water > 0.0) return no_mode();
  column_modes_fast_pole(c, &angular, &decay);
  for (int i = 0; i < n; i++) v[i] = quantity == DECAY ? decay : quantity == ANGULAR ? angular : angular / (2.0 * M_PI);
  return OK;
}

/* T_v = 1, as for terzaghi: without storage */
static double time_scale(const void *prm)
{
  const struct column_waves *c = prm;
  double                     M = elastic_oedometer(c->young, c->poisson);
  return c->height * c->height * c->pores.density * c->pores.gravity / (conductivity(&c->pores) * M);
}

static double scale(const void *prm, int quantity)
{
  const struct column_waves *c = prm;
  if (quantity == DISPLACEMENT_Y || quantity == SETTLEMENT)
    return fabs(c->load) * c->height / elastic_oedometer(c->young, c->poisson);
  return quantity < FREQUENCY ? fabs(c->load) : 1.0;
}

const struct reference reference_column_waves = {
    .name = "column_waves",
    .source = "linear two-velocity theory",
    .params = params,
    .param_size = sizeof(struct column_waves),
    .quantities = "P|stress_yy|displacement_y|settlement|frequency|angular_frequency|decay",
    .value = value,
    .time_scale = time_scale,
    .scale = scale,
};
