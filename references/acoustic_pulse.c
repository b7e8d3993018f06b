/* Sound: a bell of pressure that travels along +x, exactly and as the implicit scheme of weight theta carries it on a
 * uniform staggered grid. docs/references.md, "Sound pulse". */
#include "references/reference.h"

struct pulse {
  double density, bulk_modulus, amplitude, centre, width, mean_pressure; /* the pulse */
  double cell, step, theta, wavelength;                                  /* the scheme */
};

static const struct param params[] = {
    {"density", PARAM_NUMBER, offsetof(struct pulse, density), "kg/m3", 1e-9, 1e9, NULL, NULL, "density"},
    {"bulk_modulus", PARAM_NUMBER, offsetof(struct pulse, bulk_modulus), "Pa", 1e-9, 1e15, NULL, NULL,
     "density times the square of the sound speed"},
    {"amplitude", PARAM_NUMBER, offsetof(struct pulse, amplitude), "Pa", -1e12, 1e12, NULL, NULL, "highest pressure"},
    {"centre", PARAM_NUMBER, offsetof(struct pulse, centre), "m", -1e9, 1e9, NULL, NULL, "x of the bell at t = 0"},
    {"width", PARAM_NUMBER, offsetof(struct pulse, width), "m", 1e-9, 1e9, NULL, NULL, "w of exp(-((x - centre)/w)2)"},
    {"mean_pressure", PARAM_NUMBER, offsetof(struct pulse, mean_pressure), "Pa", -1e12, 1e12, "0", NULL,
     "pressure without the bell"},
    {"cell", PARAM_NUMBER, offsetof(struct pulse, cell), "m", 0, 1e9, "0", NULL,
     "width of the scheme's cells; 0: exact in space"},
    {"time_step", PARAM_NUMBER, offsetof(struct pulse, step), "s", 0, 1e9, "0", NULL,
     "step of the scheme; 0: exact in time"},
    {"theta", PARAM_NUMBER, offsetof(struct pulse, theta), "-", 0.5, 1, "1", NULL, "weight of the new time"},
    {"wavelength", PARAM_NUMBER, offsetof(struct pulse, wavelength), "m", 1e-9, 1e9, "1", NULL,
     "of the wave that amplification, phase and speed are about"},
    PARAM_END,
};

enum {
  P,
  VEL_X,
  PEAK,
  POSITION,
  P_SCHEME,
  VEL_X_SCHEME,
  PEAK_SCHEME,
  POSITION_SCHEME,
  AMPLIFICATION,
  PHASE,
  SPEED,
  SOUND_SPEED
};

/* m/s */
static double sound(const struct pulse *p) { return sqrt(p->bulk_modulus / p->density); }

/* 1/s: frequency of the wave of wave number k in the scheme's space, exact in time: (2 c/h) sin(k h/2) */
static double frequency(const struct pulse *p, double k)
{
  return sound(p) * (p->cell > 0 ? 2 / p->cell * sin(0.5 * k * p->cell) : k);
}

/* What the scheme makes of that wave in the time t: it multiplies it by amplitude exp(-i phase). Per step s = frequency
 * dt, lambda = (1 - i (1 - theta) s)/(1 + i theta s). */
struct fate {
  double amplitude, phase;
};

static struct fate fate(const struct pulse *p, double k, double t)
{
  double w = frequency(p, k), s = w * p->step, n, old = (1 - p->theta) * s, fresh = p->theta * s;
  if (p->step == 0) return (struct fate){1, w * t};
  n = t / p->step;
  return (struct fate){exp(0.5 * n * (log1p(old * old) - log1p(fresh * fresh))), n * (atan(old) + atan(fresh))};
}

/* m: a step of weight theta spreads the bell as a diffusion (theta - 1/2) c2 dt would */
static double width_at(const struct pulse *p, double t)
{
  return sqrt(p->width * p->width + 2 * (2 * p->theta - 1) * p->bulk_modulus / p->density * p->step * t);
}

/* over the amplitude, at x and t: the waves of the bell, each with its fate, by the trapezoidal rule up to the shortest
 * wave of the grid or where the spectrum exp(-(k w)2/4) is below 1e-16 */
static double bell(const struct pulse *p, double x, double t)
{
  double most = p->cell > 0 ? fmin(M_PI / p->cell, 12.2 / p->width) : 12.2 / p->width, sum = 0;
  double reach = fabs(x - p->centre) + sound(p) * t + 20 * p->width;
  int    n = (int)fmin(1e6, 64 + most * reach); /* waves dk apart repeat after 2 pi/dk > 6 reach */
  for (int i = n; i >= 0; i--) {
    double      k = most * i / n, end = i == 0 || i == n ? 0.5 : 1;
    struct fate f = fate(p, k, t);
    sum += end * exp(-0.25 * k * k * p->width * p->width) * f.amplitude * cos(k * (x - p->centre) - f.phase);
  }
  return sum * most / n * p->width / sqrt(M_PI);
}

/* x of the highest pressure: the best of places around where sound would be, then by the golden section */
static double summit(const struct pulse *p, double t)
{
  enum { PLACES = 64 };
  const double golden = 0.5 * (sqrt(5) - 1);
  double       w = width_at(p, t), ahead = p->centre + sound(p) * t, best = ahead, most = -INFINITY;
  for (int i = 0; i <= PLACES; i++) {
    double x = ahead + w * (2.0 * i / PLACES - 1.5), v = bell(p, x, t);
    if (v > most) best = x, most = v;
  }
  double low = best - 2 * w / PLACES, high = best + 2 * w / PLACES;
  for (int i = 0; i < 40; i++) {
    double a = high - golden * (high - low), b = low + golden * (high - low);
    if (bell(p, a, t) < bell(p, b, t))
      low = a;
    else
      high = b;
  }
  return 0.5 * (low + high);
}

static double exact(const struct pulse *p, double x, double t)
{
  double z = (x - p->centre - sound(p) * t) / p->width;
  return p->amplitude * exp(-z * z);
}

static double one(const struct pulse *p, int quantity, double x, double t)
{
  double k = 2 * M_PI / p->wavelength, c = sound(p), step = p->step > 0 ? p->step : 1;
  switch (quantity) {
  case P:
    return p->mean_pressure + exact(p, x, t);
  case VEL_X:
    return exact(p, x, t) / (p->density * c);
  case PEAK:
    return p->mean_pressure + p->amplitude;
  case POSITION:
    return p->centre + c * t;
  case P_SCHEME:
    return p->mean_pressure + p->amplitude * bell(p, x, t);
  case VEL_X_SCHEME:
    return p->amplitude * bell(p, x, t) / (p->density * c);
  case PEAK_SCHEME:
    return p->mean_pressure + p->amplitude * bell(p, summit(p, t), t);
  case POSITION_SCHEME:
    return summit(p, t);
  case AMPLIFICATION:
    return fate(p, k, step).amplitude;
  case PHASE:
    return fate(p, k, step).phase;
  case SPEED:
    return fate(p, k, step).phase / (k * step);
  default:
    return c;
  }
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  for (int i = 0; i < n; i++) v[i] = one(prm, quantity, x[i][0], fmax(t, 0));
  return OK;
}

/* the time in which sound travels one width */
static double time_scale(const void *prm)
{
  const struct pulse *p = prm;
  return p->width / sound(p);
}

static double scale(const void *prm, int quantity)
{
  const struct pulse *p = prm;
  double              a = p->amplitude != 0 ? fabs(p->amplitude) : 1;
  switch (quantity) {
  case P:
  case P_SCHEME:
  case PEAK:
  case PEAK_SCHEME:
    return a;
  case VEL_X:
  case VEL_X_SCHEME:
    return a / (p->density * sound(p));
  case SPEED:
  case SOUND_SPEED:
    return sound(p);
  default:
    return 1;
  }
}

const struct reference reference_acoustic_pulse = {
    .name = "acoustic_pulse",
    .source = "d'Alembert; Fourier analysis of the theta scheme",
    .params = params,
    .param_size = sizeof(struct pulse),
    .quantities = "P|vel_x|peak|position|P_scheme|vel_x_scheme|peak_scheme|position_scheme|amplification|phase|speed|"
                  "sound_speed",
    .value = value,
    .time_scale = time_scale,
    .scale = scale,
};
