/* Soil under its own weight below still water, at rest: pressure, effective stress and settlement for finite strain
 * (three skeleton laws), for small strain, and for a column that is given in its final shape.
 * docs/references.md, "Submerged soil". */
#include "references/elastic.h"
#include "references/reference.h"

enum law { LOG_RATE, NEO_HOOKEAN, ENGINEERING_STRAIN, SMALL_STRAIN, PLACED };
enum liquid { LINEAR, LOGARITHMIC };

struct submerged {
  int    law, liquid;
  double young, poisson, porosity, solid_density, density, bulk_modulus, gravity, height, water, base;
};

static const struct param params[] = {
    {"law", PARAM_CHOICE, offsetof(struct submerged, law), "-", 0, 0, "log_rate",
     "log_rate|neo_hookean|engineering_strain|small_strain|placed",
     "skeleton; small_strain: unchanged shape, incompressible water; placed: the given shape is the loaded one"},
    {"liquid", PARAM_CHOICE, offsetof(struct submerged, liquid), "-", 0, 0, "linear", "linear|logarithmic",
     "P = K (rho/rho0 - 1) or P = K ln(rho/rho0)"},
    {"young", PARAM_NUMBER, offsetof(struct submerged, young), "Pa", 1e-6, 1e15, NULL, NULL, "Young's modulus"},
    {"poisson", PARAM_NUMBER, offsetof(struct submerged, poisson), "-", -0.99, 0.499, NULL, NULL, "Poisson's ratio"},
    {"porosity", PARAM_NUMBER, offsetof(struct submerged, porosity), "-", 1e-3, 0.999, NULL, NULL,
     "porosity of the given shape"},
    {"solid_density", PARAM_NUMBER, offsetof(struct submerged, solid_density), "kg/m3", 1e-3, 1e5, NULL, NULL,
     "density of the grains"},
    {"density", PARAM_NUMBER, offsetof(struct submerged, density), "kg/m3", 1e-3, 1e5, "1000", NULL,
     "density of the liquid at P = 0"},
    {"bulk_modulus", PARAM_NUMBER, offsetof(struct submerged, bulk_modulus), "Pa", 1, INFINITY, NULL, NULL,
     "bulk modulus of the liquid; infinite: incompressible"},
    {"gravity", PARAM_NUMBER, offsetof(struct submerged, gravity), "m/s2", 1e-6, 1e6, "9.81", NULL, "gravity"},
    {"height", PARAM_NUMBER, offsetof(struct submerged, height), "m", 1e-9, 1e9, NULL, NULL, "height of the soil"},
    {"water", PARAM_NUMBER, offsetof(struct submerged, water), "m", 1e-9, 1e9, NULL, NULL,
     "depth of the water at the base; at least the height"},
    {"base", PARAM_NUMBER, offsetof(struct submerged, base), "m", -1e9, 1e9, "0", NULL, "y of the base"},
    PARAM_END,
};

enum { P, STRESS_YY, DISPLACEMENT_Y, SETTLEMENT, SURFACE, BASE_PRESSURE, BASE_STRESS };

/* Pa at depth d m below the surface: dP/dd = rho(P) g integrated */
static double pressure(const struct submerged *c, double d)
{
  double K = c->bulk_modulus, hydrostatic = c->density * c->gravity * fmax(d, 0.0);
  if (isinf(K) || c->law == SMALL_STRAIN) return hydrostatic;
  return c->liquid == LINEAR ? K * expm1(hydrostatic / K) : -K * log1p(-hydrostatic / K);
}

static double density(const struct submerged *c, double p)
{
  if (isinf(c->bulk_modulus) || c->law == SMALL_STRAIN) return c->density;
  return c->density * (c->liquid == LINEAR ? 1.0 + p / c->bulk_modulus : exp(p / c->bulk_modulus));
}

/* J of uniaxial neo-Hookean compression: lambda ln J/J + G (J - 1/J) = stress, by Newton */
static double neo_hookean_stretch(double M, double G, double stress)
{
  double lambda = M - 2.0 * G, J = exp(stress / M);
  for (int i = 0; i < 50; i++) {
    double residual = lambda * log(J) / J + G * (J - 1.0 / J) - stress;
    double slope = lambda * (1.0 - log(J)) / (J * J) + G * (1.0 + 1.0 / (J * J));
    J -= residual / slope;
    if (fabs(residual) < 1e-14 * M) break;
  }
  return J;
}

/* dy/dY under an effective vertical stress, Pa, tension positive */
static double stretch(const struct submerged *c, double stress)
{
  double M = elastic_oedometer(c->young, c->poisson), G = elastic_shear(c->young, c->poisson);
  switch (c->law) {
  case LOG_RATE:
    return exp(stress / M);
  case NEO_HOOKEAN:
    return neo_hookean_stretch(M, G, stress);
  case ENGINEERING_STRAIN:
    return 1.0 + stress / M;
  default:
    return 1.0;
  }
}

/* Pa/m of the given shape: d stress/dY = (1 - n0)(rho_s - rho) g, whatever the law */
static double weight(const struct submerged *c, double p)
{
  return (1.0 - c->porosity) * (c->solid_density - density(c, p)) * c->gravity;
}

enum { STEPS = 200 };

/* heights above the base and effective stresses at STEPS + 1 equidistant places of the given shape */
struct profile {
  double surface; /* m above the base */
  double y[STEPS + 1], stress[STEPS + 1];
};

/* rates of (y, stress) at that place */
static void slope(const struct submerged *c, double surface, const double at[2], double rate[2])
{
  rate[0] = stretch(c, at[1]);
  rate[1] = weight(c, pressure(c, surface - at[0]));
}

static void runge_kutta(const struct submerged *c, double surface, double h, double at[2])
{
  static const double part[4] = {0.0, 0.5, 0.5, 1.0}, share[4] = {1 / 6., 1 / 3., 1 / 3., 1 / 6.};
  double              rate[2] = {0, 0}, sum[2] = {0, 0};
  for (int stage = 0; stage < 4; stage++) {
    double there[2] = {at[0] + part[stage] * h * rate[0], at[1] + part[stage] * h * rate[1]};
    slope(c, surface, there, rate);
    for (int i = 0; i < 2; i++) sum[i] += share[stage] * rate[i];
  }
  for (int i = 0; i < 2; i++) at[i] += h * sum[i];
}

/* From the base upwards; returns the effective stress that is left at the top of the soil: 0 for the right surface. At
 * the base total stress carries all the weight. */
static double climb(const struct submerged *c, struct profile *profile)
{
  double grains = (1.0 - c->porosity) * c->solid_density * c->height;
  double liquid = c->density * (c->water - (1.0 - c->porosity) * c->height);
  double at[2] = {0.0, pressure(c, profile->surface) - (grains + liquid) * c->gravity};
  for (int i = 0; i <= STEPS; i++) {
    profile->y[i] = at[0], profile->stress[i] = at[1];
    runge_kutta(c, profile->surface, c->height / STEPS, at);
  }
  return profile->stress[STEPS];
}

/* the surface by the secant rule; the mass of the liquid is that of the given shape at P = 0 */
static enum status settle(const struct submerged *c, struct profile *profile)
{
  double before = profile->surface = c->water, error_before = climb(c, profile);
  profile->surface = c->water * (1.0 - 1e-4);
  for (int i = 0; i < 50; i++) {
    double error = climb(c, profile), here = profile->surface;
    if (fabs(here - before) < 1e-13 * c->water || error == error_before) return OK;
    profile->surface = here - error * (here - before) / (error - error_before);
    before = here, error_before = error;
  }
  return FAIL(ERR_SOLVER, "submerged_column: no equilibrium found for young %g Pa and bulk_modulus %g Pa; stiffen them",
              c->young, c->bulk_modulus);
}

/* the shape is the given one: stress = -(1 - n)(rho_s g depth - (P - P at the top of the soil)) */
static void place(const struct submerged *c, struct profile *profile)
{
  double top = pressure(c, c->water - c->height);
  profile->surface = c->water;
  for (int i = 0; i <= STEPS; i++) {
    double y = c->height * i / STEPS, depth = c->height - y;
    profile->y[i] = y;
    profile->stress[i] =
        -(1.0 - c->porosity) * (c->solid_density * c->gravity * depth - (pressure(c, c->water - y) - top));
  }
}

static enum status solve(const struct submerged *c, struct profile *profile)
{
  if (c->water < c->height)
    return FAIL(ERR_INPUT, "submerged_column: water %g m is below the top of the soil, %g m; raise it", c->water,
                c->height);
  if (c->law == SMALL_STRAIN || c->law == PLACED) {
    place(c, profile);
    return OK;
  }
  return settle(c, profile);
}

/* cubic Hermite interpolation on [0, 1]; slopes per interval */
static double hermite(double s, double a, double da, double b, double db)
{
  return a + s * (da + s * (3 * (b - a) - 2 * da - db + s * (2 * (a - b) + da + db)));
}

/* Pa at y m above the base; 0 above the soil */
static double stress_at(const struct submerged *c, const struct profile *p, double y)
{
  int    low = 0, high = STEPS;
  double rate[2][2], gap;
  if (y >= p->y[STEPS]) return 0.0;
  while (high - low > 1) {
    int middle = (low + high) / 2;
    if (p->y[middle] <= y)
      low = middle;
    else
      high = middle;
  }
  gap = p->y[high] - p->y[low];
  for (int k = 0; k < 2; k++) {
    int i = k ? high : low;
    slope(c, p->surface, (double[2]){p->y[i], p->stress[i]}, rate[k]);
  }
  return hermite((fmax(y, 0.0) - p->y[low]) / gap, p->stress[low], rate[0][1] / rate[0][0] * gap, p->stress[high],
                 rate[1][1] / rate[1][0] * gap);
}

/* m, of what stood Y m above the base */
static double displacement_at(const struct submerged *c, const struct profile *p, double Y)
{
  double s = fmin(fmax(Y / c->height, 0.0), 1.0) * STEPS, M = elastic_oedometer(c->young, c->poisson);
  int    i = (int)fmin(s, STEPS - 1);
  double h = c->height / STEPS, place = h * s;
  if (c->law == SMALL_STRAIN) return -weight(c, 0.0) * (c->height - 0.5 * place) * place / M;
  return hermite(s - i, p->y[i], h * stretch(c, p->stress[i]), p->y[i + 1], h * stretch(c, p->stress[i + 1])) - place;
}

static double one(const struct submerged *c, const struct profile *p, int quantity, double y)
{
  switch (quantity) {
  case P:
    return pressure(c, p->surface - y);
  case STRESS_YY:
    return stress_at(c, p, y);
  case DISPLACEMENT_Y:
    return displacement_at(c, p, y);
  case SETTLEMENT:
    return -displacement_at(c, p, c->height);
  case SURFACE:
    return c->base + p->surface;
  case BASE_PRESSURE:
    return pressure(c, p->surface);
  default:
    return p->stress[0];
  }
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  const struct submerged *c = prm;
  struct profile          profile;
  (void)t;
  TRY(solve(c, &profile));
  for (int i = 0; i < n; i++) v[i] = one(c, &profile, quantity, x[i][1] - c->base);
  return OK;
}

/* pressures: rho g times the depth of the water; stresses: buoyant weight of the soil */
static double scale(const void *prm, int quantity)
{
  const struct submerged *c = prm;
  double                  buoyant = weight(c, 0.0) * c->height, M = elastic_oedometer(c->young, c->poisson);
  switch (quantity) {
  case STRESS_YY:
  case BASE_STRESS:
    return fabs(buoyant);
  case DISPLACEMENT_Y:
  case SETTLEMENT:
    return 0.5 * fabs(buoyant) * c->height / M;
  case SURFACE:
    return c->water;
  default:
    return c->density * c->gravity * c->water;
  }
}

const struct reference reference_submerged_column = {
    .name = "submerged_column",
    .source = "equilibrium in the coordinate of the given shape",
    .params = params,
    .param_size = sizeof(struct submerged),
    .quantities = "P|stress_yy|displacement_y|settlement|surface|base_pressure|base_stress",
    .value = value,
    .scale = scale,
};
