/* Two fluids at rest or in motion that meet at a plane: the exact solution of the Riemann problem of (stiffened) gases
 * P = (gamma - 1) rho e - gamma p_inf, another one on each side. A density of 0: an empty half space, where only the
 * pressure is. docs/references.md, "Shock tube". */
#include "references/reference.h"

struct side {
  double density, velocity, pressure, gamma, stiffness;
};

struct riemann {
  struct side left, right;
  double      position;
};

static const struct param params[] = {
    {"left_density", PARAM_NUMBER, offsetof(struct riemann, left.density), "kg/m3", 0, 1e9, NULL, NULL,
     "density of the left fluid; 0: empty"},
    {"left_velocity", PARAM_NUMBER, offsetof(struct riemann, left.velocity), "m/s", -1e9, 1e9, "0", NULL,
     "its velocity along x"},
    {"left_pressure", PARAM_NUMBER, offsetof(struct riemann, left.pressure), "Pa", -1e15, 1e15, NULL, NULL,
     "its pressure"},
    {"left_gamma", PARAM_NUMBER, offsetof(struct riemann, left.gamma), "-", 1.0001, 1e3, "1.4", NULL,
     "its bulk modulus at constant entropy over that at constant temperature"},
    {"left_stiffness", PARAM_NUMBER, offsetof(struct riemann, left.stiffness), "Pa", 0, 1e15, "0", NULL,
     "its p_inf; 0: ideal gas"},
    {"right_density", PARAM_NUMBER, offsetof(struct riemann, right.density), "kg/m3", 0, 1e9, NULL, NULL,
     "density of the right fluid; 0: empty"},
    {"right_velocity", PARAM_NUMBER, offsetof(struct riemann, right.velocity), "m/s", -1e9, 1e9, "0", NULL,
     "its velocity along x"},
    {"right_pressure", PARAM_NUMBER, offsetof(struct riemann, right.pressure), "Pa", -1e15, 1e15, NULL, NULL,
     "its pressure"},
    {"right_gamma", PARAM_NUMBER, offsetof(struct riemann, right.gamma), "-", 1.0001, 1e3, "1.4", NULL,
     "its bulk modulus at constant entropy over that at constant temperature"},
    {"right_stiffness", PARAM_NUMBER, offsetof(struct riemann, right.stiffness), "Pa", 0, 1e15, "0", NULL,
     "its p_inf; 0: ideal gas"},
    {"position", PARAM_NUMBER, offsetof(struct riemann, position), "m", -1e9, 1e9, "0.5", NULL, "x where they meet"},
    PARAM_END,
};

enum {
  P,
  VEL_X,
  DENSITY,
  ENERGY,
  IS_LEFT,
  P_STAR,
  VEL_STAR,
  DENSITY_LEFT_STAR,
  DENSITY_RIGHT_STAR,
  LEFT_HEAD,
  LEFT_TAIL,
  CONTACT,
  RIGHT_TAIL,
  RIGHT_HEAD
};

/* what lies between the two waves: the pressure, and the velocities of the two fluids, which differ if they part */
struct star {
  double pressure, left, right;
};

/* Pa above the pressure at which the fluid vanishes */
static double excess(const struct side *s, double pressure) { return pressure + s->stiffness; }

static double sound(const struct side *s) { return sqrt(s->gamma * excess(s, s->pressure) / s->density); }

/* m/s: what a fluid behind a wave that changes its pressure to p is faster in the direction of the wave, a shock or a
 * rarefaction; 0 for nothing */
static double push(const struct side *s, double p)
{
  double g = s->gamma, from = excess(s, s->pressure), to = excess(s, p);
  if (s->density == 0) return 0;
  if (p > s->pressure) return (p - s->pressure) * sqrt(2 / (s->density * ((g + 1) * to + (g - 1) * from)));
  return 2 * sound(s) / (g - 1) * expm1((g - 1) / (2 * g) * log(to / from));
}

/* kg/m3 behind that wave */
static double density_behind(const struct side *s, double p)
{
  double g = s->gamma, ratio = excess(s, p) / excess(s, s->pressure), q = (g - 1) / (g + 1);
  if (s->density == 0) return 0;
  return s->density * (p > s->pressure ? (ratio + q) / (q * ratio + 1) : pow(ratio, 1 / g));
}

/* m/s at which two fluids with the common pressure p would part; grows with p */
static double parting(const struct riemann *r, double p)
{
  return push(&r->left, p) + push(&r->right, p) + r->right.velocity - r->left.velocity;
}

/* the pressure at which they stay together, between base and base + high: by decades first, then by halves */
static double pressure_between(const struct riemann *r, double base, double high)
{
  double low = 1e-300 * high;
  for (int i = 0; i < 200 && high - low > 1e-16 * high; i++) {
    double middle = high > 4 * low ? sqrt(low) * sqrt(high) : 0.5 * (low + high);
    if (parting(r, base + middle) < 0)
      low = middle;
    else
      high = middle;
  }
  return base + 0.5 * (low + high);
}

/* An empty side keeps its pressure. Two fluids part where even the lowest pressure does not hold them together. */
static struct star solve(const struct riemann *r)
{
  const struct side *L = &r->left, *R = &r->right;
  double base = 0 - fmin(L->stiffness, R->stiffness), high = fmax(L->pressure, R->pressure) - base, p = base;
  if (L->density == 0 || R->density == 0)
    p = L->density == 0 ? L->pressure : R->pressure;
  else if (parting(r, base) < 0) {
    while (parting(r, base + high) < 0) high *= 2;
    p = pressure_between(r, base, high);
  }
  struct star star = {p, L->velocity - push(L, p), R->velocity + push(R, p)};
  if (L->density == 0) star.left = star.right;
  if (R->density == 0) star.right = star.left;
  return star;
}

/* a fluid must bear its pressure, and that of an empty side */
static enum status check_side(const struct side *s, const struct side *other, const char *name)
{
  if (s->density == 0) return OK;
  if (excess(s, s->pressure) <= 0)
    return FAIL(ERR_INPUT, "riemann: %s_pressure is %g; a fluid of stiffness %g needs more than %g", name, s->pressure,
                s->stiffness, -s->stiffness);
  if (other->density == 0 && excess(s, other->pressure) < 0)
    return FAIL(ERR_INPUT, "riemann: the empty side's pressure is %g; the %s fluid needs at least %g", other->pressure,
                name, -s->stiffness);
  return OK;
}

static enum status check(const struct riemann *r)
{
  if (r->left.density == 0 && r->right.density == 0)
    return FAIL(ERR_INPUT, "riemann: left_density and right_density are both 0; fill a side");
  TRY(check_side(&r->left, &r->right, "left"));
  return check_side(&r->right, &r->left, "right");
}

/* speeds in its own direction, m/s, of the two ends of a side's wave: equal for a shock. outward: the side's velocity
 * in that direction */
static void wave(const struct side *s, double outward, double p, double *head, double *tail)
{
  double g = s->gamma, from = excess(s, s->pressure), to = excess(s, p);
  *head = *tail = outward;
  if (s->density == 0) return;
  if (p > s->pressure)
    *head = *tail = outward + sound(s) * sqrt(((g + 1) * to / from + g - 1) / (2 * g));
  else {
    *head = outward + sound(s);
    *tail = outward + push(s, p) + sound(s) * pow(to / from, (g - 1) / (2 * g));
  }
}

struct state {
  double density, outward, pressure; /* velocity in the direction of the wave */
};

/* inside a side's rarefaction, at speed xi in its direction */
static struct state fan(const struct side *s, double outward, double xi)
{
  double g = s->gamma, c = ((g - 1) * (xi - outward) + 2 * sound(s)) / (g + 1), ratio = c / sound(s);
  double left = excess(s, s->pressure) * pow(ratio, 2 * g / (g - 1));
  return (struct state){s->density * pow(ratio, 2 / (g - 1)), xi - c, left - s->stiffness};
}

/* where one side's fluid is, at speed xi in the direction of its wave */
static struct state sample(const struct side *s, double outward, double p, double xi)
{
  double head, tail;
  wave(s, outward, p, &head, &tail);
  if (xi >= head) return (struct state){s->density, outward, s->pressure};
  if (xi > tail) return fan(s, outward, xi);
  return (struct state){density_behind(s, p), outward + push(s, p), p};
}

static double number(const struct state *state, const struct side *s, double direction, int quantity)
{
  double stored = (state->pressure + s->gamma * s->stiffness) / (s->gamma - 1);
  switch (quantity) {
  case P:
    return state->pressure;
  case VEL_X:
    return direction * state->outward;
  case DENSITY:
    return state->density;
  case ENERGY:
    return state->density > 0 ? stored / state->density : 0;
  default:
    return direction < 0;
  }
}

/* a field at x; what lies between two fluids that part is empty, and its velocity goes over from one to the other */
static double field(const struct riemann *r, const struct star *star, int quantity, double x, double t)
{
  double             xi = t > 0 ? (x - r->position) / t : 0;
  bool               left = t > 0 ? xi < star->left : x < r->position;
  double             direction = left ? -1 : 1;
  const struct side *s = left ? &r->left : &r->right;
  struct state       state = {s->density, direction * s->velocity, s->pressure};
  if (t > 0 && xi >= star->left && xi < star->right)
    state = (struct state){0, direction * xi, star->pressure};
  else if (t > 0 && s->density == 0)
    state = (struct state){0, direction * star->left, star->pressure};
  else if (t > 0)
    state = sample(s, direction * s->velocity, star->pressure, direction * xi);
  return number(&state, s, direction, quantity);
}

/* m, the places of waves and contact at time t; those of an empty side are where the fluid ends */
static double place(const struct riemann *r, const struct star *star, int quantity, double t)
{
  const struct side *s = quantity < CONTACT ? &r->left : &r->right;
  double             direction = quantity < CONTACT ? -1 : 1, head, tail;
  if (quantity == CONTACT) return r->position + star->left * t;
  wave(s, direction * (s->density > 0 ? s->velocity : star->left), star->pressure, &head, &tail);
  return r->position + direction * (quantity == LEFT_HEAD || quantity == RIGHT_HEAD ? head : tail) * t;
}

static double one(const struct riemann *r, const struct star *star, int quantity, double x, double t)
{
  switch (quantity) {
  case P_STAR:
    return star->pressure;
  case VEL_STAR:
    return star->left;
  case DENSITY_LEFT_STAR:
    return density_behind(&r->left, star->pressure);
  case DENSITY_RIGHT_STAR:
    return density_behind(&r->right, star->pressure);
  default:
    return quantity >= LEFT_HEAD ? place(r, star, quantity, fmax(t, 0)) : field(r, star, quantity, x, t);
  }
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  TRY(check(prm));
  struct star star = solve(prm);
  for (int i = 0; i < n; i++) v[i] = one(prm, &star, quantity, x[i][0], t);
  return OK;
}

/* the larger of the two sides; velocities by the sound speed at constant temperature, energies by its square */
static double scale(const void *prm, int quantity)
{
  const struct riemann *r = prm;
  double                largest = 0;
  for (int i = 0; i < 2; i++) {
    const struct side *s = i ? &r->right : &r->left;
    double             square = s->density > 0 ? excess(s, s->pressure) / s->density : 0;
    double             of_side = quantity == P         ? fabs(s->pressure)
                                 : quantity == VEL_X   ? sqrt(square)
                                 : quantity == DENSITY ? s->density
                                 : quantity == ENERGY  ? square
                                                       : 1;
    largest = fmax(largest, of_side);
  }
  return largest > 0 ? largest : 1;
}

const struct reference reference_riemann = {
    .name = "riemann",
    .source = "shocks, rarefactions and vacuum of two stiffened gases",
    .params = params,
    .param_size = sizeof(struct riemann),
    .quantities = "P|vel_x|density|internal_energy|is_left|P_star|vel_star|density_left_star|density_right_star|"
                  "left_head|left_tail|contact|right_tail|right_head",
    .value = value,
    .scale = scale,
};
