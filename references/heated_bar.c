/* Heat conduction along a bar that starts with T0 + A cos(pi s/L): both ends insulated, or a flux into its end s = 0,
 * or that end brought to a temperature at once and kept there. docs/references.md, "Heated bar". */
#include "references/reference.h"

struct bar {
  double conductivity, heat_capacity, density, length, area, end, start, amplitude, fixed, flux;
};

static const struct param params[] = {
    {"conductivity", PARAM_NUMBER, offsetof(struct bar, conductivity), "W/(m K)", 1e-12, 1e12, NULL, NULL,
     "conductivity"},
    {"heat_capacity", PARAM_NUMBER, offsetof(struct bar, heat_capacity), "J/(kg K)", 1e-12, 1e12, NULL, NULL,
     "heat capacity"},
    {"density", PARAM_NUMBER, offsetof(struct bar, density), "kg/m3", 1e-9, 1e9, NULL, NULL, "density"},
    {"length", PARAM_NUMBER, offsetof(struct bar, length), "m", 1e-9, 1e9, NULL, NULL, "length"},
    {"area", PARAM_NUMBER, offsetof(struct bar, area), "m2", 1e-12, 1e9, "1", NULL,
     "cross-section (height per metre of thickness), for heat"},
    {"end", PARAM_NUMBER, offsetof(struct bar, end), "m", -1e9, 1e9, "0", NULL, "x of the end s = 0"},
    {"start", PARAM_NUMBER, offsetof(struct bar, start), "K", 0, 1e9, NULL, NULL, "T0, mean temperature at the start"},
    {"amplitude", PARAM_NUMBER, offsetof(struct bar, amplitude), "K", -1e9, 1e9, "0", NULL, "A"},
    {"fixed", PARAM_NUMBER, offsetof(struct bar, fixed), "K", 0, 1e9, "0", NULL,
     "temperature of the end s = 0 from t = 0 on; 0: it is not fixed"},
    {"flux", PARAM_NUMBER, offsetof(struct bar, flux), "W/m2", -1e12, 1e12, "0", NULL,
     "heat into the end s = 0, where that is not fixed"},
    PARAM_END,
};

enum { TEMPERATURE, HEAT, HEAT_IN };

static double capacity(const struct bar *b) { return b->density * b->heat_capacity; }

/* modes whose decay exp(-k2 Fo) is below 1e-17 are left out; so are all above 2^16 */
static int modes(double Fo)
{
  const int most = 1 << 16;
  return Fo * most * most < 4 ? most : (int)(sqrt(4.0 / Fo)) + 2; /* (pi i)^2 Fo > 39 */
}

/* the end s = 0 is kept at `fixed`: T and its mean over the bar, z = s/L */
static double fixed_end(const struct bar *b, double z, double Fo, double *mean)
{
  double T = b->fixed;
  *mean = b->fixed;
  if (Fo <= 0) {
    *mean = b->start;
    return b->start + b->amplitude * cos(M_PI * z);
  }
  for (int i = modes(Fo); i >= 1; i--) {
    double k = (i - 0.5) * M_PI;
    double a = 2 * ((b->start - b->fixed) / k + b->amplitude * k / (k * k - M_PI * M_PI)) * exp(-k * k * Fo);
    T += a * sin(k * z);
    *mean += a / k;
  }
  return T;
}

/* both ends insulated but for the flux at s = 0 */
static double free_end(const struct bar *b, double z, double Fo, double *mean)
{
  double rise = b->flux * b->length / b->conductivity, profile = 0;
  *mean = b->start + rise * Fo;
  for (int i = Fo > 0 ? modes(Fo) : 0; i >= 1; i--) {
    double k = i * M_PI;
    profile -= 2 / (k * k) * cos(k * z) * exp(-k * k * Fo);
  }
  if (Fo > 0) profile += Fo + 0.5 * (1 - z) * (1 - z) - 1.0 / 6;
  return b->start + b->amplitude * cos(M_PI * z) * exp(-M_PI * M_PI * fmax(Fo, 0)) + rise * profile;
}

static double one(const struct bar *b, int quantity, double x, double t)
{
  double z = fmin(fmax((x - b->end) / b->length, 0), 1), mean, T;
  double Fo = b->conductivity / capacity(b) * t / (b->length * b->length);
  T = (b->fixed > 0 ? fixed_end : free_end)(b, z, Fo, &mean);
  switch (quantity) {
  case TEMPERATURE:
    return T;
  case HEAT:
    return capacity(b) * b->length * b->area * mean;
  default:
    return capacity(b) * b->length * b->area * (mean - b->start);
  }
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  for (int i = 0; i < n; i++) v[i] = one(prm, quantity, x[i][0], t);
  return OK;
}

/* Fourier number 1 */
static double time_scale(const void *prm)
{
  const struct bar *b = prm;
  return b->length * b->length * capacity(b) / b->conductivity;
}

/* K: the largest of what drives the heat */
static double drive(const struct bar *b)
{
  double step = b->fixed > 0 ? fabs(b->fixed - b->start) : fabs(b->flux) * b->length / b->conductivity;
  return fmax(fabs(b->amplitude), step);
}

static double scale(const void *prm, int quantity)
{
  const struct bar *b = prm;
  return quantity == TEMPERATURE ? drive(b) : capacity(b) * b->length * b->area * drive(b);
}

const struct reference reference_heated_bar = {
    .name = "heated_bar",
    .source = "separation of variables, heat",
    .params = params,
    .param_size = sizeof(struct bar),
    .quantities = "temperature|heat|heat_in",
    .value = value,
    .time_scale = time_scale,
    .scale = scale,
};
