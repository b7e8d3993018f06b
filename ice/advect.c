/* The liquid carries its mass and momentum, axis by axis. theory 4.10 */
#include "ice/advect.h"
#include "ice/each.h"
#include "ice/heat.h"

#include "core/parallel.h"

#include <math.h>
#include <string.h>

/* largest share of a cell that leaves it through a face in one sweep */
static const double courant = 0.5;

bool advect_is_smooth(const struct grid *g, const struct ice *ice, int axis, long f)
{
  long low = f - g->stride[axis];
  if (ice->several) return ice->kind[axis * g->size + f] == FACE_INNER && advect_same(ice, low, f);
  return ice->kind[axis * g->size + f] == FACE_INNER && ice->alpha_cc[f] > advect_full &&
         ice->alpha_cc[low] > advect_full && !ice_has_surface(g, ice, f) && !ice_has_surface(g, ice, low);
}

double advect_courant(const struct grid *g, const struct ice *ice, int axis, long f, long from)
{
  double V = grid_cell_volume(g), liquid = ice->liquid_fc[axis * g->size + f] * V;
  return fabs(liquid) / (ice->pore_cc[from] * V);
}

double advect_density(const struct grid *g, const struct ice *ice, int axis, long f)
{
  bool   up = ice->liquid_fc[axis * g->size + f] > 0;
  long   from = up ? f - g->stride[axis] : f;
  double rho = ice->rho_cc[from];
  if (!ice->T_cc || !advect_is_smooth(g, ice, axis, f)) return rho;
  double part = (up ? 0.5 : -0.5) * (1 - advect_courant(g, ice, axis, f, from));
  double coming = ice->swell_cc ? -0.5 * rho * ice->swell_cc[from] : 0;
  return rho + part * advect_slope(g, ice, axis, from, 1, ice->rho_cc) + coming;
}

/* Change of velocity component d from a cell's centre to that of its neighbour along an axis. A wall mirrors: what it
 * holds changes sign there, the rest stays. NaN where nothing is known. */
static double change_towards(const struct sim *sim, const struct ice *ice, int axis, long from, bool up, int d)
{
  const struct grid *g = &sim->grid;
  long               beyond = up ? from + g->stride[axis] : from - g->stride[axis], face = up ? beyond : from;
  double             own = ice->vel_cc[from * g->dim + d];
  if (ice->open_cc[from] < 1) return NAN; /* cut by an obstacle */
  if (advect_same(ice, from, beyond) && ice->kind[axis * g->size + face] == FACE_INNER)
    return ice->vel_cc[beyond * g->dim + d] - own;
  if (ice->kind[axis * g->size + face] != FACE_CLOSED) return NAN;
  return d == axis || sim->scene->fluid_side[2 * axis + up].kind == SIDE_NO_SLIP ? -2 * own : 0;
}

double advect_leaving_velocity(const struct sim *sim, const struct ice *ice, int axis, long from, bool up, int d,
                               double number)
{
  long   q = from * sim->grid.dim + d;
  double below = -change_towards(sim, ice, axis, from, false, d), above = change_towards(sim, ice, axis, from, true, d);
  double slope = isfinite(below + above) ? advect_limited(below, above) : 0;
  return ice->vel_cc[q] + (up ? 0.5 : -0.5) * (1 - number) * slope - 0.5 * ice->vel_start_cc[q];
}

/* the same where a side of given pressure lets liquid in or out: without a gradient there, so as it is inside */
static double open_velocity(const struct sim *sim, const struct ice *ice, int axis, long f, int d)
{
  const struct grid *g = &sim->grid;
  int                place[3];
  grid_place(g, f, place);
  long   inside = place[axis] == 0 ? f : f - g->stride[axis], q = inside * g->dim + d;
  double half = ice->alpha_cc[inside] > advect_full && !ice_has_surface(g, ice, inside) ? 0.5 : 0;
  return ice->vel_cc[q] - half * ice->vel_start_cc[q];
}

/* momentum component d through a face in dt, kg m/s: where fluxes are of second order, the mean of those at both ends
 * of the step */
static double carried_momentum(const struct sim *sim, const struct ice *ice, int axis, long f, int d, double dt)
{
  const struct grid *g = &sim->grid;
  long               q = axis * g->size + f, low = f - g->stride[axis];
  double             V = grid_cell_volume(g), liquid = ice->liquid_fc[q] * V;
  long               from = liquid > 0 ? low : f;
  if (liquid == 0) return 0; /* nobody knows what lies behind a wall */
  double mean = liquid + (0.5 - sim->scene->numerics.theta) * dt * V / g->h * ice->trend_fc[q];
  if (ice->kind[q] == FACE_INLET)
    return mean * ice->rho_cc[from] * ice_inlet_velocity(sim, axis, d, f, sim->t + 0.5 * sim->dt);
  if (ice->kind[q] == FACE_PRESSURE) return mean * ice->rho_cc[from] * open_velocity(sim, ice, axis, f, d);
  if (!advect_is_smooth(g, ice, axis, f)) return liquid * ice->rho_cc[from] * ice->vel_cc[from * g->dim + d];
  double number = advect_courant(g, ice, axis, f, from);
  return mean * advect_density(g, ice, axis, f) * advect_leaving_velocity(sim, ice, axis, from, liquid > 0, d, number);
}

double advect_mass(const struct ice *ice, const struct grid *g, int axis, long f)
{
  double liquid = ice->liquid_fc[axis * g->size + f];
  return liquid != 0 ? liquid * grid_cell_volume(g) * advect_density(g, ice, axis, f) : 0;
}

static void gather_momentum(struct sim *sim, struct ice *ice, int axis, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX(g, cells, c)
  for (int d = 0; d < g->dim; d++)
    ice->momentum_cc[c * g->dim + d] = ice->mass_cc[c] * ice->vel_cc[c * g->dim + d] +
                                       carried_momentum(sim, ice, axis, c, d, dt) -
                                       carried_momentum(sim, ice, axis, c + g->stride[axis], d, dt);
}

/* masses and velocities after a sweep */
static void gather_mass(struct sim *sim, struct ice *ice, int axis)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             V = grid_cell_volume(g);
  FOR_BOX(g, cells, c)
  {
    double *m = &ice->mass_cc[c];
    *m += advect_mass(ice, g, axis, c) - advect_mass(ice, g, axis, c + g->stride[axis]);
    bool holds = *m > advect_least_mass * ice->rho_cc[c] * ice->pore_cc[c] * V;
    for (int d = 0; d < g->dim; d++) ice->vel_cc[c * g->dim + d] = holds ? ice->momentum_cc[c * g->dim + d] / *m : 0;
  }
  grid_fill_periodic(g, 1, ice->mass_cc);
  grid_fill_periodic(g, g->dim, ice->vel_cc);
}

/* kg of fluid k after a sweep */
static double mass_through(const struct ice *ice, const struct grid *g, int k, int axis, long f)
{
  return ice->several ? ice->passed_fc[(k * g->dim + axis) * g->size + f] : advect_mass(ice, g, axis, f);
}

/* net mass of fluid k through the sides of the grid that this axis has, kg */
static double mass_out(const struct sim *sim, const struct ice *ice, int k, int axis)
{
  const struct grid *g = &sim->grid;
  double             out = 0;
  for (int high = 0; high < 2 && !g->periodic[axis]; high++) {
    struct box side = grid_side_faces(g, 2 * axis + high);
    FOR_BOX_SERIAL(g, side, f) out += (high ? 1 : -1) * mass_through(ice, g, k, axis, f);
  }
  return out;
}

/* parts that a step is carried in, so that no face empties more than its share of a cell */
static int parts_of_step(const struct sim *sim, const struct ice *ice, double dt)
{
  const struct grid *g = &sim->grid;
  double             most = 0;
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    FOR_BOX_SERIAL(g, faces, f)
    {
      long   q = axis * g->size + f, from = ice->carried_fc[q] > 0 ? f - g->stride[axis] : f;
      double room = ice->porosity_cc[from] * ice->open_cc[from], share = dt * fabs(ice->carried_fc[q]) / (g->h * room);
      if (room > 0) most = fmax(most, share);
    }
  }
  return most > courant ? (int)ceil(most / courant) : 1;
}

/* behind a side lies what its cell holds, and enough of it */
static void copy_fluid(const struct grid *g, struct ice *ice, int k, long inside, long beyond)
{
  long from = k * g->size + inside, to = k * g->size + beyond;
  ice->rho_cc[to] = ice->rho_cc[from];
  ice->alpha_cc[to] = ice->alpha_cc[from];
  if (ice->several) ice->mass_cc[to] = ice->alpha_cc[from] * ice->rho_cc[from] * grid_cell_volume(g);
}

void ice_open_rooms(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  memset(ice->pore_cc, 0, (size_t)g->size * sizeof *ice->pore_cc);
  FOR_BOX(g, cells, c) ice->pore_cc[c] = ice->porosity_cc[c] * ice->open_cc[c];
  grid_fill_periodic(g, 1, ice->pore_cc);
  for (int side = 0; side < 2 * g->dim; side++) {
    int        axis = side / 2, high = side % 2;
    struct box faces = grid_side_faces(g, side);
    if (g->periodic[axis]) continue;
    FOR_BOX_SERIAL(g, faces, f)
    {
      long           inside = high ? f - g->stride[axis] : f, beyond = high ? f : f - g->stride[axis];
      enum face_kind kind = ice->kind[axis * g->size + f];
      if (kind == FACE_CLOSED) continue;
      ice->pore_cc[beyond] = 1;
      for (int k = 0; k < ice->n_fluids; k++) copy_fluid(g, ice, k, inside, beyond);
      if (!ice->several) ice->alpha_cc[beyond] = kind == FACE_INLET || kind == FACE_PRESSURE;
      for (int d = 0; d < g->dim; d++) ice->vel_cc[beyond * g->dim + d] = ice->vel_cc[inside * g->dim + d];
      if (ice->T_cc) ice_heat_beyond(sim, ice, side, f);
    }
  }
}

/* Liquid without a surface fills its room: what a cell has too much or too little is a defect, no surface with a plane
 */
static void fill_up(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX(g, cells, c)
  if (ice->alpha_cc[c] > advect_full) ice->alpha_cc[c] = 1;
}

/* vel_start becomes what the step has changed so far */
static void find_changes(struct sim *sim, struct ice *ice)
{
  long n = sim->grid.size * sim->grid.dim;
  PARALLEL_FOR
  for (long q = 0; q < n; q++) ice->vel_start_cc[q] = ice->vel_cc[q] - ice->vel_start_cc[q];
}

enum status ice_advect(struct sim *sim, double dt)
{
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  int                parts = parts_of_step(sim, ice, dt);
  ice_open_rooms(sim, ice);
  find_changes(sim, ice);
  ice_begin_forecast(sim, ice);
  if (!ice->surface && !ice->several) fill_up(sim, ice);
  if (ice->each_cc) each_follow_mean(sim, ice);
  for (int part = 0; part < parts; part++) {
    plic_begin(&ice->plic, ice->alpha_cc);
    for (int i = 0; i < g->dim; i++) {
      int  axis = plic_axis(g, sim->step + part, i);
      long base = axis * g->size;
      plic_sweep(&ice->plic, axis, dt / parts, (ice->each_cc ? ice->first_fc : ice->carried_fc) + base, ice->alpha_cc,
                 ice->liquid_fc + base);
      grid_fill_periodic(g, 1, ice->alpha_cc); /* both faces of a seam see the same */
      if (ice->each_cc) {
        each_pass(sim, ice, axis, dt / parts);
      } else if (ice->several) {
        ice_pass_fluids(sim, ice, axis, dt / parts);
      } else {
        gather_momentum(sim, ice, axis, dt / parts);
        if (ice->T_cc) ice_heat_gather(sim, ice, axis);
        gather_mass(sim, ice, axis);
        if (ice->T_cc) ice_heat_settle(sim, ice);
      }
      for (int k = 0; k < ice->n_fluids; k++)
        *(k == 0 ? &ice->now.mass_out : &ice->now.others_out) += mass_out(sim, ice, k, axis);
    }
  }
  ice_end_forecast(sim, ice, dt);
  ice->now.change = ice_fastest_change(sim, ice, sim->t + dt);
  return OK;
}
