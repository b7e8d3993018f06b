/* Small standing wave of an incompressible liquid between two smooth walls, released from rest, over a level floor.
 * docs/references.md, "Standing wave". */
#include "references/reference.h"

struct slosh {
  double depth, length, wall, floor, amplitude, gravity, density, viscosity;
  int    mode;
};

static const struct param params[] = {
    {"depth", PARAM_NUMBER, offsetof(struct slosh, depth), "m", 1e-9, 1e9, NULL, NULL, "depth at rest"},
    {"length", PARAM_NUMBER, offsetof(struct slosh, length), "m", 1e-9, 1e9, NULL, NULL, "distance of the walls"},
    {"wall", PARAM_NUMBER, offsetof(struct slosh, wall), "m", -1e9, 1e9, "0", NULL, "x of the left wall"},
    {"floor", PARAM_NUMBER, offsetof(struct slosh, floor), "m", -1e9, 1e9, "0", NULL, "y of the floor"},
    {"mode", PARAM_INTEGER, offsetof(struct slosh, mode), "-", 1, 1000, "1", NULL, "half waves between the walls"},
    {"amplitude", PARAM_NUMBER, offsetof(struct slosh, amplitude), "m", -1e9, 1e9, NULL, NULL,
     "elevation at the left wall at t = 0"},
    {"gravity", PARAM_NUMBER, offsetof(struct slosh, gravity), "m/s2", 1e-9, 1e9, "9.81", NULL, "gravity, downwards"},
    {"density", PARAM_NUMBER, offsetof(struct slosh, density), "kg/m3", 1e-9, 1e9, "1000", NULL, "density"},
    {"viscosity", PARAM_NUMBER, offsetof(struct slosh, viscosity), "Pa s", 0, 1e9, "0", NULL,
     "dynamic viscosity, small; walls and floor do not hold the liquid"},
    PARAM_END,
};

enum {
  ELEVATION,
  SURFACE,
  VEL_X,
  VEL_Y,
  P,
  PERIOD,
  FREQUENCY,
  ANGULAR_FREQUENCY,
  DAMPING,
  WALL_ELEVATION,
  KINETIC,
  POTENTIAL
};

/* 1/m */
static double wavenumber(const struct slosh *s) { return s->mode * M_PI / s->length; }

/* 1/s */
static double frequency(const struct slosh *s)
{
  double k = wavenumber(s);
  return sqrt(s->gravity * k * tanh(k * s->depth));
}

/* 1/s: amplitudes fade as exp(-2 nu k2 t) in every depth, Lamb 1932, section 348 */
static double damping(const struct slosh *s)
{
  double k = wavenumber(s);
  return 2 * s->viscosity / s->density * k * k;
}

/* the profile over z above the floor: cosh(k z)/cosh(k depth), or sinh(k z)/cosh(k depth), without overflow */
static double profile(const struct slosh *s, double z, double sign)
{
  double k = wavenumber(s), top = exp(k * (z - s->depth)), bottom = exp(-k * (z + s->depth));
  return (top + sign * bottom) / (1 + exp(-2 * k * s->depth));
}

/* J/m: all of it over the length, (1/4) rho g a2 L, at first as height */
static double energy(const struct slosh *s, double a) { return 0.25 * s->density * s->gravity * a * a * s->length; }

static double one(const struct slosh *s, int quantity, double x, double y, double t)
{
  double k = wavenumber(s), w = frequency(s), a = s->amplitude * exp(-damping(s) * t), z = y - s->floor;
  double high = a * cos(w * t), fast = s->gravity * k / w * a * sin(w * t), place = k * (x - s->wall);
  switch (quantity) {
  case ELEVATION:
    return high * cos(place);
  case SURFACE:
    return s->floor + s->depth + high * cos(place);
  case VEL_X:
    return fast * profile(s, z, 1) * sin(place);
  case VEL_Y:
    return -fast * profile(s, z, -1) * cos(place);
  case P:
    return s->density * s->gravity * (s->depth - z + high * profile(s, z, 1) * cos(place));
  case PERIOD:
    return 2 * M_PI / w;
  case FREQUENCY:
    return w / (2 * M_PI);
  case ANGULAR_FREQUENCY:
    return w;
  case DAMPING:
    return damping(s);
  case WALL_ELEVATION:
    return high;
  case KINETIC:
    return energy(s, a * sin(w * t));
  default:
    return energy(s, a * cos(w * t));
  }
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  for (int i = 0; i < n; i++) v[i] = one(prm, quantity, x[i][0], x[i][1], t);
  return OK;
}

/* one period */
static double time_scale(const void *prm) { return 2 * M_PI / frequency(prm); }

/* what belongs to the amplitude; numbers of the period by themselves */
static double scale(const void *prm, int quantity)
{
  const struct slosh *s = prm;
  double              a = s->amplitude != 0 ? fabs(s->amplitude) : 1;
  switch (quantity) {
  case ELEVATION:
  case SURFACE:
  case WALL_ELEVATION:
    return a;
  case VEL_X:
  case VEL_Y:
    return s->gravity * wavenumber(s) / frequency(s) * a;
  case P:
    return s->density * s->gravity * a;
  case KINETIC:
  case POTENTIAL:
    return energy(s, a);
  default:
    return 1;
  }
}

const struct reference reference_slosh = {
    .name = "slosh",
    .source = "linear theory of standing waves in finite depth",
    .params = params,
    .param_size = sizeof(struct slosh),
    .quantities = "elevation|surface|vel_x|vel_y|P|period|frequency|angular_frequency|damping|wall_elevation|kinetic|"
                  "potential",
    .value = value,
    .time_scale = time_scale,
    .scale = scale,
};
