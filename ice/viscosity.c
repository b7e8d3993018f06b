/* Viscous stress between cells, with the eddies that the grid does not show. theory 4.11 */
#include "ice/ice.h"

#include "core/parallel.h"

#include <math.h>

/* ---- rates of strain ---- */

/* the side that face f lies on, 2 axis or 2 axis + 1; -1: none */
static int side_of(const struct grid *g, int axis, long f)
{
  int place[3];
  grid_place(g, f, place);
  bool low = place[axis] == 0, high = place[axis] == g->n[axis];
  return g->periodic[axis] || !(low || high) ? -1 : 2 * axis + high;
}

/* d u_d/dx_axis at a face that is none between two cells with a pressure: towards a side that holds this component,
 * half a cell away. No other face passes stress: 0 */
static double rate_at_side(const struct sim *sim, const struct ice *ice, int axis, long f, int d)
{
  const struct grid *g = &sim->grid;
  int                side = side_of(g, axis, f), kind = side < 0 ? SIDE_OPEN : sim->scene->fluid_side[side].kind;
  bool               wall = kind == SIDE_SLIP || kind == SIDE_SYMMETRY;
  if (kind != SIDE_NO_SLIP && kind != SIDE_VELOCITY && !(wall && d == axis)) return 0;
  double given = kind == SIDE_VELOCITY ? ice_inlet_velocity(sim, axis, d, f, sim->t) : 0;
  double inside = ice->vel_cc[(side % 2 ? f - g->stride[axis] : f) * g->dim + d];
  return (side % 2 ? 2 : -2) * (given - inside) / g->h;
}

/* d u_d/dx_axis at a face, upwards */
static inline double rate(const struct sim *sim, const struct ice *ice, int axis, long f, int d)
{
  const struct grid *g = &sim->grid;
  if (ice->kind[axis * g->size + f] != FACE_INNER) return rate_at_side(sim, ice, axis, f, d);
  return (ice->vel_cc[f * g->dim + d] - ice->vel_cc[(f - g->stride[axis]) * g->dim + d]) / g->h;
}

/* the same in a cell: mean of its faces, without those to void or an open side, which know nothing */
static double rate_in_cell(const struct sim *sim, const struct ice *ice, int axis, long c, int d)
{
  const struct grid *g = &sim->grid;
  double             sum = 0;
  int                known = 0;
  for (int high = 0; high < 2; high++) {
    long           f = c + high * g->stride[axis];
    enum face_kind kind = ice->kind[axis * g->size + f];
    if (kind == FACE_SURFACE || kind == FACE_VOID || kind == FACE_PRESSURE) continue;
    sum += rate(sim, ice, axis, f, d);
    known++;
  }
  return known ? sum / known : 0;
}

/* ---- stress ---- */

/* Pa s: mean over the fluids of a cell by volume */
static double viscosity_at(const struct sim *sim, const struct ice *ice, long c)
{
  double mu = 0;
  if (!ice->several) return sim->scene->fluid.viscosity;
  for (int k = 0; k < ice->n_fluids; k++)
    mu += ice->alpha_cc[k * sim->grid.size + c] * scene_fluid(sim->scene, k)->viscosity;
  return mu;
}

/* of both sides of a face that the same shear passes */
static double harmonic(double a, double b) { return a + b > 0 ? 2 * a * b / (a + b) : 0; }

/* Component d of the force per area that the upper side of an axis' face exerts on the lower. Uniform viscosity and no
 * divergence: the transposed gradient sums up to nothing. */
static inline double stress_of_uniform(const struct sim *sim, const struct ice *ice, int axis, long f, int d)
{
  return sim->scene->fluid.viscosity * rate(sim, ice, axis, f, d);
}

/* the same, each fluid with its own */
static inline double stress_of_several(const struct sim *sim, const struct ice *ice, int axis, long f, int d)
{
  double shear = rate(sim, ice, axis, f, d);
  if (shear == 0) return 0;
  long   low = f - sim->grid.stride[axis];
  bool   l = ice->wet_cc[low] > 0, h = ice->wet_cc[f] > 0;
  double mu =
      l && h ? harmonic(viscosity_at(sim, ice, low), viscosity_at(sim, ice, f)) : viscosity_at(sim, ice, l ? low : f);
  return mu * shear;
}

/* d u_d/dx_t at a face across t: mean of its cells with a pressure */
static double rate_along(const struct sim *sim, const struct ice *ice, int axis, long f, int t, int d)
{
  double sum = 0, wet = 0;
  for (int high = 0; high < 2; high++) {
    long c = high ? f : f - sim->grid.stride[axis];
    if (!(ice->mu_cc[c] > 0)) continue;
    sum += rate_in_cell(sim, ice, t, c, d);
    wet++;
  }
  return wet > 0 ? sum / wet : 0;
}

/* mu (grad u + grad u^T - 2/3 div u) */
static double stress_of_eddies(const struct sim *sim, const struct ice *ice, int axis, long f, int d)
{
  const struct grid *g = &sim->grid;
  double             low = fmax(0, ice->mu_cc[f - g->stride[axis]]), high = fmax(0, ice->mu_cc[f]); /* or unknown: 0 */
  double             mu = low > 0 && high > 0 ? (ice->several ? harmonic(low, high) : 0.5 * (low + high)) : low + high;
  double             normal = rate(sim, ice, axis, f, d), div = normal;
  if (ice->kind[axis * g->size + f] != FACE_INNER && normal == 0) return 0;
  if (d != axis) return mu * (normal + rate_along(sim, ice, axis, f, d, axis));
  for (int t = 0; t < g->dim; t++)
    if (t != axis) div += rate_along(sim, ice, axis, f, t, t);
  return mu * (2 * normal - 2.0 / 3 * div);
}

/* impulse on the sides in dt */
static void push_sides(const struct sim *sim, struct ice *ice, double dt)
{
  const struct grid *g = &sim->grid;
  for (int side = 0; side < 2 * g->dim; side++) {
    int        axis = side / 2, high = side % 2;
    struct box faces = grid_side_faces(g, side);
    if (g->periodic[axis]) continue;
    FOR_BOX_SERIAL(g, faces, f)
    for (int d = 0; d < g->dim; d++) {
      double stress = ice->mu_cc ? stress_of_eddies(sim, ice, axis, f, d) : stress_of_uniform(sim, ice, axis, f, d);
      bool   wet = ice->wet_cc[high ? f - g->stride[axis] : f] > 0;
      if (wet)
        ice->now.shear[d] += (high ? -dt : dt) * ice->porosity_fc[axis * g->size + f] * ice_face_area(g) * stress;
    }
  }
}

/* ---- stages ---- */

/* share of a face that passes stress: beside cut cells no more than they hold, which would be flung about */
static inline double passing(const struct grid *g, const struct ice *ice, int axis, long f)
{
  double room = fmin(ice->open_cc[f], ice->open_cc[f - g->stride[axis]]);
  return ice->porosity_fc[axis * g->size + f] * (ice->obstacles ? fmin(ice->open_fc[axis * g->size + f], room) : 1);
}

/* change of velocity that the stress of now gives in dt */
static inline void push(struct sim *sim, struct ice *ice, double dt, double *change,
                        double (*stress)(const struct sim *, const struct ice *, int, long, int))
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  int                dim = g->dim;
  double             impulse = dt * ice_face_area(g);
  FOR_BOX(g, cells, c)
  for (int d = 0; d < dim; d++) {
    double gained = 0;
    for (int axis = 0; axis < dim && ice->wet_cc[c] > 0; axis++) {
      long up = c + g->stride[axis];
      gained += passing(g, ice, axis, up) * stress(sim, ice, axis, up, d) -
                passing(g, ice, axis, c) * stress(sim, ice, axis, c, d);
    }
    change[c * dim + d] = gained != 0 ? impulse * gained / ice_cell_mass(g, ice, c) : 0;
  }
}

static void find_change(struct sim *sim, struct ice *ice, double dt, double *change)
{
  push_sides(sim, ice, 0.5 * dt);
  if (ice->mu_cc)
    push(sim, ice, dt, change, stress_of_eddies);
  else if (ice->several)
    push(sim, ice, dt, change, stress_of_several);
  else
    push(sim, ice, dt, change, stress_of_uniform);
}

static void add_change(struct sim *sim, struct ice *ice, double share, const double *change)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX(g, cells, c)
  for (int d = 0; d < g->dim; d++) ice->vel_cc[c * g->dim + d] += share * change[c * g->dim + d];
  grid_fill_periodic(g, g->dim, ice->vel_cc);
}

/* mu + rho (C h)^2 |S|, |S|^2 = 2 S:S */
enum status ice_measure_eddies(struct sim *sim, double dt)
{
  (void)dt;
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             length = ice->params->smagorinsky * g->h, most = 0;
  FOR_BOX(g, cells, c)
  {
    double square = 0;
    for (int a = 0; a < g->dim && ice->wet_cc[c] > 0; a++)
      for (int b = 0; b < g->dim; b++) {
        double twice = rate_in_cell(sim, ice, a, c, b) + rate_in_cell(sim, ice, b, c, a);
        square += 0.5 * twice * twice;
      }
    double mu = viscosity_at(sim, ice, c) + ice->filling_cc[c] * length * length * sqrt(square);
    ice->mu_cc[c] = ice->wet_cc[c] > 0 ? mu : 0;
  }
  FOR_BOX_SERIAL(g, cells, c) most = fmax(most, ice->mu_cc[c] / ice->filling_cc[c]);
  ice->now.viscosity = most;
  grid_fill_periodic(g, 1, ice->mu_cc);
  return OK;
}

enum status ice_diffuse_momentum(struct sim *sim, double dt)
{
  struct ice *ice = ice_of(sim);
  find_change(sim, ice, dt, ice->viscous_cc);
  add_change(sim, ice, 1, ice->viscous_cc);
  return OK;
}

/* Heun: half of what the stress at the start gave is exchanged for half of what that at the end gives */
enum status ice_centre_diffusion(struct sim *sim, double dt)
{
  struct ice *ice = ice_of(sim);
  find_change(sim, ice, dt, ice->momentum_cc);
  add_change(sim, ice, -0.5, ice->viscous_cc);
  add_change(sim, ice, 0.5, ice->momentum_cc);
  return OK;
}

/* s: explicit diffusion in every direction */
double ice_viscous_dt(const struct sim *sim)
{
  double h = sim->grid.h, nu = ice_of(sim)->now.viscosity;
  for (int k = 0; k < sim->scene->n_fluids; k++) {
    const struct fluid *fluid = scene_fluid(sim->scene, k);
    nu = fmax(nu, (sim->scene->n_fluids > 1 ? 2 : 1) * fluid->viscosity / fluid->density); /* the mean is up to twice */
  }
  return nu > 0 ? sim->scene->numerics.dt_factor * h * h / (2 * sim->grid.dim * nu) : INFINITY;
}
