/* The fluid at any speed goes back to its cells: what its faces swept over takes mass, momentum and energy along, axis
 * by axis. theory 4.13 */
#include "ice/shock.h"

#include "core/parallel.h"

#include <math.h>

/* share of its energy that a fluid of a cell keeps for certain: where slopes would take more, they are none */
static const double least_energy = 0.1;
/* share of a cell's room that a fluid must fill to have slopes there, which cannot empty it then; and that the cells
 * beside must hold of it */
static const double full = 0.999, least_share = 1e-6;
/* largest share of a cell that leaves it through a face in one sweep */
static const double courant = 0.5;
/* smallest volume, over its own, that a cell may be squeezed to in one step */
static const double least_room = 0.1;

double shock_carried_weight(const struct sim *sim, const struct ice *ice, int axis, long f, double dt)
{
  long q = axis * sim->grid.size + f;
  if (ice->carried_fc[q] == 0) return 0;
  return dt * ice_face_area(&sim->grid) * ice->carried_fc[q] * ice_face_density(&sim->grid, ice, axis, f);
}

/* ---- what passes a face ---- */

/* a face that moves over a volume, and the cell that this volume belonged to */
struct sweep {
  int    axis;
  long   face, from;
  double swept;   /* over the volume of a cell, upwards */
  bool   outside; /* from would lie behind a side: the cell inside stands for it */
  double side;    /* 1/2 or -1/2 along the axis, where slopes count; else 0 */
};

static struct sweep sweep_of(const struct sim *sim, const struct ice *ice, int axis, long f, double swept, bool flat)
{
  long         low = f - sim->grid.stride[axis], from = swept > 0 ? low : f;
  struct sweep s = {axis, f, from, swept, !(ice->wet_cc[from] > 0), swept > 0 ? 0.5 : -0.5};
  if (s.outside) s.from = from == low ? f : low;
  if (s.outside || flat) s.side = 0;
  return s;
}

static inline bool holds(const struct ice *ice, long own) { return ice->part_cc[own] > least_share; }

/* limited change across a cell of a number of a fluid; q, own: of that fluid */
static double slope(const struct sim *sim, const struct ice *ice, int axis, long c, long own, const double *q)
{
  long   step = sim->grid.stride[axis];
  double below = shock_jump(sim, ice, axis, c, 1, q), above = shock_jump(sim, ice, axis, c + step, 1, q);
  if (!(ice->part_cc[own + c] > full * ice->room_cc[c]) || !holds(ice, own + c - step) || !holds(ice, own + c + step))
    return 0;
  return shock_limited(below, above);
}

static double slope_of_velocity(const struct sim *sim, const struct ice *ice, int axis, long c, int d)
{
  return shock_limited(shock_jump_velocity(sim, ice, axis, c, d),
                       shock_jump_velocity(sim, ice, axis, c + sim->grid.stride[axis], d));
}

/* volume of fluid k that goes with it, over the volume of a cell: of the first what its plane cuts off, of the others
 * by their shares of the rest */
static double swept_of(const struct sim *sim, const struct ice *ice, const struct sweep *s, int k)
{
  long size = sim->grid.size;
  if (ice->n_fluids == 1) return s->swept;
  double first = ice->liquid_fc[s->axis * size + s->face], rest = ice->room_cc[s->from] - ice->part_cc[s->from];
  if (k == 0) return first;
  return rest > 0 ? (s->swept - first) * (ice->part_cc[k * size + s->from] / rest) : 0;
}

/* masses of all fluids, by the limited change of their density over the volume that leaves; returns their sum, kg */
static double pass_masses(const struct sim *sim, struct ice *ice, const struct sweep *s)
{
  const struct grid *g = &sim->grid;
  double             left = 1 - fabs(s->swept) / ice->room_cc[s->from], V = grid_cell_volume(g), sum = 0;
  for (int k = 0; k < ice->n_fluids; k++) {
    long   own = k * g->size;
    long   at = (k * g->dim + s->axis) * g->size + s->face;
    double rho = ice->dense_cc[own + s->from];
    if (s->side != 0) rho += s->side * left * slope(sim, ice, s->axis, s->from, own, ice->dense_cc + own);
    ice->volume_fc[at] = swept_of(sim, ice, s, k);
    ice->mass_fc[at] = ice->volume_fc[at] * V * rho;
    sum += ice->mass_fc[at];
  }
  return sum;
}

/* momentum and energies, by limited changes over the mass that leaves */
static void pass_rest(const struct sim *sim, struct ice *ice, const struct sweep *s, double mass)
{
  const struct grid *g = &sim->grid;
  int                dim = g->dim;
  long               q = s->axis * g->size + s->face;
  double             left = 1 - fabs(mass) / ice_cell_mass(g, ice, s->from), moving = 0;
  for (int d = 0; d < dim; d++) {
    double v = ice->vel_cc[s->from * dim + d];
    if (s->side != 0) v += s->side * left * slope_of_velocity(sim, ice, s->axis, s->from, d);
    if (s->outside && ice->kind[q] == FACE_INLET) v = ice_inlet_velocity(sim, s->axis, d, s->face, sim->t);
    ice->momentum_fc[q * dim + d] = mass * v;
    moving += 0.5 * v * v;
  }
  if (!ice->T_cc) return;
  ice->energy_fc[q] = mass * moving;
  for (int k = 0; k < ice->n_fluids; k++) {
    long   own = k * g->size, of_k = k * dim * g->size + q;
    double e = ice->inner_cc[own + s->from];
    if (s->side != 0) e += s->side * left * slope(sim, ice, s->axis, s->from, own, ice->inner_cc + own);
    ice->heat_fc[of_k] = ice->mass_fc[of_k] * e;
    ice->energy_fc[q] += ice->heat_fc[of_k];
  }
}

static void pass_nothing(const struct grid *g, struct ice *ice, long q)
{
  for (int k = 0; k < ice->n_fluids; k++) {
    ice->volume_fc[k * g->dim * g->size + q] = ice->mass_fc[k * g->dim * g->size + q] = 0;
    if (ice->T_cc) ice->heat_fc[k * g->dim * g->size + q] = 0;
  }
  for (int d = 0; d < g->dim; d++) ice->momentum_fc[q * g->dim + d] = 0;
  if (ice->T_cc) ice->energy_fc[q] = 0;
}

static void pass_face(const struct sim *sim, struct ice *ice, int axis, long f, double swept, bool flat)
{
  if (swept == 0) {
    pass_nothing(&sim->grid, ice, axis * sim->grid.size + f);
    return;
  }
  struct sweep s = sweep_of(sim, ice, axis, f, swept, flat);
  pass_rest(sim, ice, &s, pass_masses(sim, ice, &s));
}

/* what leaves a cell through the two faces of an axis */
static double leaves(const double *q, long low, long high) { return fmax(0, q[high]) - fmin(0, q[low]); }

/* whether a cell would be left with hardly any internal energy, of all fluids or of one that has slopes */
static bool is_drained(const struct sim *sim, const struct ice *ice, int axis, long c)
{
  const struct grid *g = &sim->grid;
  int                dim = g->dim;
  long               low = axis * g->size + c, high = low + g->stride[axis], faces = dim * g->size;
  double             m = ice_cell_mass(g, ice, c), left = m, moving = 0, inner = 0;
  for (int k = 0; k < ice->n_fluids; k++) {
    long   own = k * g->size + c;
    double gone = leaves(ice->mass_fc + k * faces, low, high),
           e = ice->T_cc ? ice->mass_cc[own] * ice->inner_cc[own] : 0;
    left -= gone;
    inner += e;
    if (!holds(ice, own)) continue;
    if (!(ice->mass_cc[own] > gone)) return true;
    if (ice->T_cc && !(e - leaves(ice->heat_fc + k * faces, low, high) >
                       least_energy * (ice->mass_cc[own] - gone) * ice->inner_cc[own]))
      return true;
  }
  if (!(left > 0)) return true;
  if (!ice->T_cc) return false;
  for (int d = 0; d < dim; d++) {
    double p = m * ice->vel_cc[c * dim + d];
    if (ice->carried_fc[high] > 0) p -= ice->momentum_fc[high * dim + d];
    if (ice->carried_fc[low] < 0) p += ice->momentum_fc[low * dim + d];
    moving += 0.5 * p * p;
  }
  return !(ice->energy_cc[c] - leaves(ice->energy_fc, low, high) - moving / left > least_energy * inner * left / m);
}

/* what passes the faces of an axis; cells that slopes would drain have none */
static void pass(struct sim *sim, struct ice *ice, int axis, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         faces = grid_faces(g, axis), cells = grid_cells(g);
  const double      *carried = ice->carried_fc + axis * g->size;
  FOR_BOX(g, faces, f) pass_face(sim, ice, axis, f, dt / g->h * carried[f], false);
  FOR_BOX(g, cells, c) ice->flat_cc[c] = ice->wet_cc[c] > 0 && is_drained(sim, ice, axis, c);
  grid_fill_periodic(g, 1, ice->flat_cc);
  FOR_BOX(g, faces, f)
  {
    long from = carried[f] > 0 ? f - g->stride[axis] : f;
    if (carried[f] != 0 && ice->flat_cc[from] > 0) pass_face(sim, ice, axis, f, dt / g->h * carried[f], true);
  }
}

/* ---- cells ---- */

/* Internal energies are what total energy has beyond that of motion: what motion has lost warms all fluids by their
 * mass. One fluid has it all, to the same bits however often this is asked. */
static void warm_cell(const struct grid *g, struct ice *ice, long c)
{
  double m = ice_cell_mass(g, ice, c), left = ice->energy_cc[c];
  for (int d = 0; d < g->dim; d++) left -= 0.5 * m * ice->vel_cc[c * g->dim + d] * ice->vel_cc[c * g->dim + d];
  if (ice->n_fluids == 1) {
    ice->inner_cc[c] = left / m;
    return;
  }
  for (int k = 0; k < ice->n_fluids; k++) left -= ice->mass_cc[k * g->size + c] * ice->inner_cc[k * g->size + c];
  for (int k = 0; k < ice->n_fluids; k++) ice->inner_cc[k * g->size + c] += left / m;
}

/* densities and energies per mass of the present cells */
static void describe(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             V = grid_cell_volume(g);
  FOR_BOX(g, cells, c)
  {
    if (!(ice->wet_cc[c] > 0)) continue;
    if (ice->T_cc) warm_cell(g, ice, c);
    for (int k = 0; k < ice->n_fluids; k++) {
      long own = k * g->size + c;
      ice->dense_cc[own] = ice->part_cc[own] > 0 ? ice->mass_cc[own] / (ice->part_cc[own] * V) : 0;
    }
  }
  for (int k = 0; k < ice->n_fluids; k++) {
    grid_fill_periodic(g, 1, ice->mass_cc + k * g->size);
    grid_fill_periodic(g, 1, ice->part_cc + k * g->size);
    grid_fill_periodic(g, 1, ice->dense_cc + k * g->size);
    if (ice->T_cc) grid_fill_periodic(g, 1, ice->inner_cc + k * g->size);
  }
  grid_fill_periodic(g, 1, ice->room_cc);
  grid_fill_periodic(g, g->dim, ice->vel_cc);
}

/* one fluid of a cell after a sweep through its faces */
static void gather_fluid(const struct grid *g, struct ice *ice, int k, long c, long low, long high)
{
  long          own = k * g->size + c, faces = k * g->dim * g->size;
  const double *mass = ice->mass_fc + faces, *volume = ice->volume_fc + faces;
  double        come = mass[low] - mass[high], more = ice->mass_cc[own] + come;
  ice->part_cc[own] += volume[low] - volume[high];
  if (ice->T_cc && more > 0) {
    const double *heat = ice->heat_fc + faces;
    ice->inner_cc[own] += (heat[low] - heat[high] - come * ice->inner_cc[own]) / more;
  }
  ice->mass_cc[own] = more;
}

/* kg through a face, all fluids, beyond what weight was counted on already */
static double fallen(const struct sim *sim, const struct ice *ice, int axis, long f, double dt)
{
  const struct grid *g = &sim->grid;
  double             sum = 0;
  for (int k = 0; k < ice->n_fluids; k++) sum += ice->mass_fc[(k * g->dim + axis) * g->size + f];
  return sum - shock_carried_weight(sim, ice, axis, f, dt);
}

/* cells after what has passed the faces of an axis; sums in an order that does not know left from right */
static void gather(struct sim *sim, struct ice *ice, int axis, double dt, double weight)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  int                dim = g->dim;
  FOR_BOX(g, cells, c)
  {
    if (!(ice->wet_cc[c] > 0)) continue;
    long   low = axis * g->size + c, high = low + g->stride[axis];
    double come = 0, m = ice_cell_mass(g, ice, c);
    for (int k = 0; k < ice->n_fluids; k++)
      come += ice->mass_fc[k * dim * g->size + low] - ice->mass_fc[k * dim * g->size + high];
    for (int d = 0; d < dim; d++) {
      double *v = &ice->vel_cc[c * dim + d];
      *v += (ice->momentum_fc[low * dim + d] - ice->momentum_fc[high * dim + d] - come * *v) / (m + come);
    }
    for (int k = 0; k < ice->n_fluids; k++) gather_fluid(g, ice, k, c, low, high);
    ice->room_cc[c] -= dt / g->h * (ice->carried_fc[high] - ice->carried_fc[low]);
    if (ice->T_cc)
      ice->energy_cc[c] +=
          ice->energy_fc[low] - ice->energy_fc[high] +
          0.5 * weight * (fallen(sim, ice, axis, c, dt) + fallen(sim, ice, axis, c + g->stride[axis], dt));
  }
}

/* net mass of fluid k through the sides of the grid that this axis has, kg */
static double mass_out(const struct sim *sim, const struct ice *ice, int k, int axis)
{
  const struct grid *g = &sim->grid;
  double             out = 0;
  for (int high = 0; high < 2 && !g->periodic[axis]; high++) {
    struct box side = grid_side_faces(g, 2 * axis + high);
    FOR_BOX_SERIAL(g, side, f) out += (high ? 1 : -1) * ice->mass_fc[(k * g->dim + axis) * g->size + f];
  }
  return out;
}

/* ---- the step ---- */

/* room of the cells and of their fluids when their faces have moved, over the cells' volume; the parts in which the
 * step is carried, so that no face sweeps over more than its share of a cell */
static enum status move_faces(struct sim *sim, struct ice *ice, double dt, int *parts)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             most = 0, least = INFINITY;
  FOR_BOX_SERIAL(g, cells, c)
  {
    double swells = 0, swept = 0;
    for (int d = 0; d < g->dim; d++) {
      long low = d * g->size + c, high = low + g->stride[d];
      swells += dt / g->h * (ice->carried_fc[high] - ice->carried_fc[low]);
      swept = fmax(swept, dt / g->h * fmax(-ice->carried_fc[low], ice->carried_fc[high]));
    }
    ice->room_cc[c] = 1 + swells;
    for (int k = 0; k < ice->n_fluids; k++)
      ice->part_cc[k * g->size + c] = shock_share(g, ice, k, c) + shock_yield(g, ice, k, c) * swells;
    least = fmin(least, 1 + swells);
    most = fmax(most, swept / fmin(1 + swells, 1));
  }
  *parts = most > courant ? (int)ceil(most / courant) : 1;
  if (least > least_room) return OK;
  return FAIL(ERR_DIVERGED,
              "ice: a cell is squeezed to %g of its volume in one step at t = %g s, %g is allowed; give "
              "numerics.ice.acoustic_courant, or lower numerics.dt_factor",
              least, sim->t, least_room);
}

static void sweep_axis(struct sim *sim, struct ice *ice, int axis, double dt, double weight)
{
  describe(sim, ice);
  if (ice->n_fluids > 1) shock_cut(sim, ice, axis, dt);
  pass(sim, ice, axis, dt);
  for (int k = 0; k < ice->n_fluids; k++)
    *(k == 0 ? &ice->now.mass_out : &ice->now.others_out) += mass_out(sim, ice, k, axis);
  gather(sim, ice, axis, dt, weight);
}

enum status ice_carry_shock(struct sim *sim, double dt)
{
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  double             gravity[3];
  int                parts;
  sim_gravity(sim, sim->t + 0.5 * dt, gravity);
  TRY(move_faces(sim, ice, dt, &parts));
  for (int part = 0; part < parts; part++)
    for (int i = 0; i < g->dim; i++) {
      int axis = plic_axis(g, sim->step + part, i);
      sweep_axis(sim, ice, axis, dt / parts, gravity[axis] * g->h);
    }
  describe(sim, ice);
  return shock_settle(sim, ice);
}
