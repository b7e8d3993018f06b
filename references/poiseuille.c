/* Liquid between two walls that hold it, along x, driven by a body force or a pressure drop: from rest to the parabola.
 * docs/references.md, "Channel". */
#include "references/reference.h"

struct channel {
  double height, base, density, viscosity, force, drop, length, inlet, outlet_pressure;
};

static const struct param params[] = {
    {"height", PARAM_NUMBER, offsetof(struct channel, height), "m", 1e-9, 1e9, NULL, NULL, "distance of the walls"},
    {"base", PARAM_NUMBER, offsetof(struct channel, base), "m", -1e9, 1e9, "0", NULL, "y of the lower wall"},
    {"density", PARAM_NUMBER, offsetof(struct channel, density), "kg/m3", 1e-9, 1e9, NULL, NULL, "density"},
    {"viscosity", PARAM_NUMBER, offsetof(struct channel, viscosity), "Pa s", 1e-12, 1e9, NULL, NULL,
     "dynamic viscosity"},
    {"force", PARAM_NUMBER, offsetof(struct channel, force), "N/m3", -1e12, 1e12, "0", NULL,
     "body force along x from t = 0, density times gravity"},
    {"pressure_drop", PARAM_NUMBER, offsetof(struct channel, drop), "Pa", -1e12, 1e12, "0", NULL,
     "pressure at the inlet less that at the outlet, from t = 0"},
    {"length", PARAM_NUMBER, offsetof(struct channel, length), "m", 1e-9, 1e9, "1", NULL, "from inlet to outlet"},
    {"inlet", PARAM_NUMBER, offsetof(struct channel, inlet), "m", -1e9, 1e9, "0", NULL, "x of the inlet"},
    {"outlet_pressure", PARAM_NUMBER, offsetof(struct channel, outlet_pressure), "Pa", -1e12, 1e12, "0", NULL,
     "pressure at the outlet"},
    PARAM_END,
};

enum { VEL_X, P, FLUX, VEL_MAX, VEL_MEAN, WALL_STRESS, VEL_X_STEADY };

/* N/m3: what drives the liquid */
static double drive(const struct channel *c) { return c->force + c->drop / c->length; }

/* m/s: steady velocity in the middle */
static double largest(const struct channel *c) { return drive(c) * c->height * c->height / (8 * c->viscosity); }

/* diffusion time: t nu/H^2 */
static double fourier(const struct channel *c, double t)
{
  return c->viscosity / c->density * t / (c->height * c->height);
}

/* odd modes whose decay exp(-m2 pi2 Fo) is above 1e-17; 2^16 of them at most */
static int modes(double Fo)
{
  const int most = 1 << 16;
  return Fo * most * most < 4 ? most : (int)sqrt(4 / Fo) + 2;
}

/* what is still missing at time Fo > 0, over the steady velocity in the middle: of the velocity at z = y/H, of the mean
 * velocity, and of the slope du/dz at the wall */
struct rest {
  double velocity, mean, slope;
};

static struct rest missing(double z, double Fo)
{
  struct rest rest = {0, 0, 0};
  for (int m = 2 * modes(Fo) - 1; m > 0; m -= 2) {
    double k = m * M_PI, a = 32 / (k * k * k) * exp(-k * k * Fo);
    rest.velocity += a * sin(k * z);
    rest.mean += 2 * a / k;
    rest.slope += a * k;
  }
  return rest;
}

static double one(const struct channel *c, int quantity, double x, double y, double t)
{
  double      z = fmin(fmax((y - c->base) / c->height, 0), 1), U = largest(c), Fo = fourier(c, t);
  double      parabola = 4 * z * (1 - z);
  struct rest rest = {parabola, 2.0 / 3, 4};
  if (Fo > 0 && quantity != P && quantity != VEL_X_STEADY) rest = missing(quantity == VEL_MAX ? 0.5 : z, Fo);
  switch (quantity) {
  case VEL_X:
    return U * (parabola - rest.velocity);
  case P:
    return c->outlet_pressure + c->drop * (1 - (x - c->inlet) / c->length);
  case FLUX:
    return U * c->height * (2.0 / 3 - rest.mean);
  case VEL_MAX:
    return Fo > 0 ? U * (1 - rest.velocity) : 0;
  case VEL_MEAN:
    return U * (2.0 / 3 - rest.mean);
  case WALL_STRESS:
    return c->viscosity * U / c->height * (4 - rest.slope);
  default:
    return U * parabola;
  }
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  for (int i = 0; i < n; i++) v[i] = one(prm, quantity, x[i][0], x[i][1], t);
  return OK;
}

/* Fo = 1 */
static double time_scale(const void *prm) { return 1 / fourier(prm, 1); }

/* steady velocity in the middle; what else belongs to it */
static double scale(const void *prm, int quantity)
{
  const struct channel *c = prm;
  double                U = fabs(largest(c));
  if (quantity == P) return c->drop != 0 ? fabs(c->drop) : 1;
  if (U == 0) return 1;
  return quantity == FLUX ? U * c->height : quantity == WALL_STRESS ? 0.5 * fabs(drive(c)) * c->height : U;
}

const struct reference reference_poiseuille = {
    .name = "poiseuille",
    .source = "parabola less the decaying modes of the start",
    .params = params,
    .param_size = sizeof(struct channel),
    .quantities = "vel_x|P|flux|vel_max|vel_mean|wall_stress|vel_x_steady",
    .value = value,
    .time_scale = time_scale,
    .scale = scale,
};
