/* First axial mode of an elastic bar that is fixed at one end, free at the other and held by rollers: started with the
 * velocity v0 sin(pi s/2L). Linear. docs/references.md, "Vibrating bar". */
#include "references/reference.h"

struct bar {
  double young, density, length, height, velocity, fixed_end;
};

static const struct param params[] = {
    {"young", PARAM_NUMBER, offsetof(struct bar, young), "Pa", 1e-6, 1e15, NULL, NULL,
     "axial modulus: Young's modulus where Poisson's ratio is 0"},
    {"density", PARAM_NUMBER, offsetof(struct bar, density), "kg/m3", 1e-9, 1e9, NULL, NULL, "density of the bar"},
    {"length", PARAM_NUMBER, offsetof(struct bar, length), "m", 1e-9, 1e9, NULL, NULL, "length"},
    {"height", PARAM_NUMBER, offsetof(struct bar, height), "m", 1e-12, 1e9, "1", NULL,
     "cross-section per metre of thickness, for energies"},
    {"velocity", PARAM_NUMBER, offsetof(struct bar, velocity), "m/s", -1e6, 1e6, NULL, NULL,
     "velocity of the free end at the start"},
    {"fixed_end", PARAM_NUMBER, offsetof(struct bar, fixed_end), "m", -1e9, 1e9, "0", NULL, "x of the fixed end"},
    PARAM_END,
};

enum { DISPLACEMENT_X, VEL_X, STRESS_XX, KINETIC, ELASTIC, ENERGY, FREQUENCY, ANGULAR_FREQUENCY };

static double wave_number(const struct bar *b) { return 0.5 * M_PI / b->length; }

static double angular(const struct bar *b) { return wave_number(b) * sqrt(b->young / b->density); }

static double total_energy(const struct bar *b)
{
  return 0.25 * b->density * b->length * b->height * b->velocity * b->velocity;
}

static double one(const struct bar *b, int quantity, double x, double t)
{
  double k = wave_number(b), w = angular(b), s = x - b->fixed_end, c = cos(w * t);
  switch (quantity) {
  case DISPLACEMENT_X:
    return b->velocity / w * sin(w * t) * sin(k * s);
  case VEL_X:
    return b->velocity * c * sin(k * s);
  case STRESS_XX:
    return b->young * k * b->velocity / w * sin(w * t) * cos(k * s);
  case KINETIC:
    return total_energy(b) * c * c;
  case ELASTIC:
    return total_energy(b) * (1.0 - c * c);
  case ENERGY:
    return total_energy(b);
  case FREQUENCY:
    return 0.5 * w / M_PI;
  default:
    return w;
  }
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  for (int i = 0; i < n; i++) v[i] = one(prm, quantity, x[i][0], t);
  return OK;
}

/* one period */
static double time_scale(const void *prm) { return 2.0 * M_PI / angular(prm); }

static double scale(const void *prm, int quantity)
{
  const struct bar *b = prm;
  switch (quantity) {
  case DISPLACEMENT_X:
    return fabs(b->velocity) / angular(b);
  case VEL_X:
    return fabs(b->velocity);
  case STRESS_XX:
    return fabs(b->velocity) * sqrt(b->young * b->density);
  case FREQUENCY:
  case ANGULAR_FREQUENCY:
    return one(b, quantity, 0.0, 0.0);
  default:
    return total_energy(b);
  }
}

const struct reference reference_bar_vibration = {
    .name = "bar_vibration",
    .source = "separation of variables",
    .params = params,
    .param_size = sizeof(struct bar),
    .quantities = "displacement_x|vel_x|stress_xx|kinetic|elastic|energy|frequency|angular_frequency",
    .value = value,
    .time_scale = time_scale,
    .scale = scale,
};
