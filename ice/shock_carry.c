/* The fluid at any speed goes back to its cells: what its faces swept over takes mass, momentum and energy along, axis
 * by axis. theory 4.13 */
#include "ice/shock.h"

#include "core/parallel.h"
#include "eos/eos.h"
#include "ice/plic.h"

#include <math.h>

/* share of its energy that a cell keeps for certain: where slopes would take more, they are none */
static const double least_energy = 0.1;
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

/* what passes a face: kg, J; momentum is mass times velocity */
struct passage {
  double mass, velocity[3], energy;
};

/* limited change across a cell of a scalar */
static double slope(const struct sim *sim, const struct ice *ice, int axis, long c, const double *q)
{
  return shock_limited(shock_jump(sim, ice, axis, c, 1, q),
                       shock_jump(sim, ice, axis, c + sim->grid.stride[axis], 1, q));
}

static double slope_of_velocity(const struct sim *sim, const struct ice *ice, int axis, long c, int d)
{
  return shock_limited(shock_jump_velocity(sim, ice, axis, c, d),
                       shock_jump_velocity(sim, ice, axis, c + sim->grid.stride[axis], d));
}

/* Through a face, from the cell that it sweeps over: density by its limited change over the volume that leaves,
 * velocity and energy by theirs over the mass that leaves. */
static struct passage passage_of(const struct sim *sim, const struct ice *ice, int axis, long f, double swept,
                                 bool flat)
{
  const struct grid *g = &sim->grid;
  long               low = f - g->stride[axis], q = axis * g->size + f, from = swept > 0 ? low : f;
  bool               outside = !(ice->wet_cc[from] > 0);
  if (outside) from = from == low ? f : low;
  double         side = outside || flat ? 0 : swept > 0 ? 0.5 : -0.5, V = grid_cell_volume(g);
  double         left = 1 - fabs(swept) / ice->room_cc[from], e = ice->T_cc ? ice->inner_cc[from] : 0;
  struct passage p = {0};
  double         rho = ice->dense_cc[from];
  if (side != 0) rho += side * left * slope(sim, ice, axis, from, ice->dense_cc);
  p.mass = swept * V * rho;
  left = 1 - fabs(p.mass) / ice->mass_cc[from];
  for (int d = 0; d < g->dim; d++) {
    p.velocity[d] = ice->vel_cc[from * g->dim + d];
    if (side != 0) p.velocity[d] += side * left * slope_of_velocity(sim, ice, axis, from, d);
    if (outside && ice->kind[q] == FACE_INLET) p.velocity[d] = ice_inlet_velocity(sim, axis, d, f, sim->t);
  }
  if (side != 0 && ice->T_cc) e += side * left * slope(sim, ice, axis, from, ice->inner_cc);
  for (int d = 0; d < g->dim; d++) e += 0.5 * p.velocity[d] * p.velocity[d];
  p.energy = p.mass * e;
  return p;
}

static void keep(struct ice *ice, int dim, long q, const struct passage *p)
{
  ice->mass_fc[q] = p->mass;
  for (int d = 0; d < dim; d++) ice->momentum_fc[q * dim + d] = p->mass * p->velocity[d];
  if (ice->T_cc) ice->energy_fc[q] = p->energy;
}

/* whether a cell would be left without mass, or with hardly any energy but that of its motion */
static bool is_drained(const struct sim *sim, const struct ice *ice, int axis, long c)
{
  const struct grid *g = &sim->grid;
  int                dim = g->dim;
  double             m = ice->mass_cc[c], momentum[3] = {0}, E = ice->T_cc ? ice->energy_cc[c] : 0, moving = 0;
  for (int d = 0; d < dim; d++) momentum[d] = m * ice->vel_cc[c * dim + d];
  for (int high = 0; high < 2; high++) {
    long   q = axis * g->size + c + high * g->stride[axis];
    double sign = high ? 1 : -1;
    if (!(sign * ice->mass_fc[q] > 0)) continue;
    m -= sign * ice->mass_fc[q];
    for (int d = 0; d < dim; d++) momentum[d] -= sign * ice->momentum_fc[q * dim + d];
    if (ice->T_cc) E -= sign * ice->energy_fc[q];
  }
  for (int d = 0; d < dim; d++) moving += 0.5 * momentum[d] * momentum[d];
  return !(m > 0) || (ice->T_cc && !(E - moving / m > least_energy * m * ice->inner_cc[c]));
}

/* what passes the faces of an axis; cells that slopes would drain have none */
static void pass(struct sim *sim, struct ice *ice, int axis, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         faces = grid_faces(g, axis), cells = grid_cells(g);
  FOR_BOX(g, faces, f)
  {
    long           q = axis * g->size + f;
    double         swept = dt / g->h * ice->carried_fc[q];
    struct passage p = {0};
    if (swept != 0) p = passage_of(sim, ice, axis, f, swept, false);
    keep(ice, g->dim, q, &p);
  }
  FOR_BOX(g, cells, c) ice->flat_cc[c] = is_drained(sim, ice, axis, c);
  grid_fill_periodic(g, 1, ice->flat_cc);
  FOR_BOX(g, faces, f)
  {
    long   q = axis * g->size + f;
    double swept = dt / g->h * ice->carried_fc[q];
    if (swept == 0 || !(ice->flat_cc[swept > 0 ? f - g->stride[axis] : f] > 0)) continue;
    struct passage p = passage_of(sim, ice, axis, f, swept, true);
    keep(ice, g->dim, q, &p);
  }
}

/* densities and energies per mass of the present cells: of m in its room, and without the energy of its motion */
static void describe(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             V = grid_cell_volume(g);
  FOR_BOX(g, cells, c)
  {
    if (!(ice->wet_cc[c] > 0)) continue;
    double m = ice->mass_cc[c], moving = 0;
    for (int d = 0; d < g->dim; d++) moving += 0.5 * ice->vel_cc[c * g->dim + d] * ice->vel_cc[c * g->dim + d];
    ice->dense_cc[c] = m / (ice->room_cc[c] * V);
    if (ice->T_cc) ice->inner_cc[c] = ice->energy_cc[c] / m - moving;
  }
  grid_fill_periodic(g, 1, ice->mass_cc);
  grid_fill_periodic(g, 1, ice->room_cc);
  grid_fill_periodic(g, 1, ice->dense_cc);
  grid_fill_periodic(g, g->dim, ice->vel_cc);
  if (ice->T_cc) grid_fill_periodic(g, 1, ice->inner_cc);
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
    long   low = axis * g->size + c, high = low + g->stride[axis], f = c + g->stride[axis];
    double come = ice->mass_fc[low] - ice->mass_fc[high], more = ice->mass_cc[c] + come;
    for (int d = 0; d < dim; d++) {
      double *v = &ice->vel_cc[c * dim + d];
      *v += (ice->momentum_fc[low * dim + d] - ice->momentum_fc[high * dim + d] - come * *v) / more;
    }
    ice->mass_cc[c] = more;
    ice->room_cc[c] -= dt / g->h * (ice->carried_fc[high] - ice->carried_fc[low]);
    if (!ice->T_cc) continue;
    double fell = ice->mass_fc[low] - shock_carried_weight(sim, ice, axis, c, dt) +
                  (ice->mass_fc[high] - shock_carried_weight(sim, ice, axis, f, dt));
    ice->energy_cc[c] += ice->energy_fc[low] - ice->energy_fc[high] + 0.5 * weight * fell;
  }
}

/* net mass through the sides of the grid that this axis has, kg */
static double mass_out(const struct sim *sim, const struct ice *ice, int axis)
{
  const struct grid *g = &sim->grid;
  double             out = 0;
  for (int high = 0; high < 2 && !g->periodic[axis]; high++) {
    struct box side = grid_cells(g);
    side.lo[axis] = high ? g->n[axis] : 0;
    side.hi[axis] = side.lo[axis] + 1;
    FOR_BOX_SERIAL(g, side, f) out += (high ? 1 : -1) * ice->mass_fc[axis * g->size + f];
  }
  return out;
}

/* room of the cells when their faces have moved, over their volume; the parts in which the step is carried, so that no
 * face sweeps over more than its share of a cell */
static enum status move_faces(struct sim *sim, struct ice *ice, double dt, int *parts)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             most = 0, least = INFINITY;
  FOR_BOX_SERIAL(g, cells, c)
  {
    double room = 1, swept = 0;
    for (int d = 0; d < g->dim; d++) {
      long low = d * g->size + c, high = low + g->stride[d];
      room += dt / g->h * (ice->carried_fc[high] - ice->carried_fc[low]);
      swept = fmax(swept, dt / g->h * fmax(-ice->carried_fc[low], ice->carried_fc[high]));
    }
    ice->room_cc[c] = room;
    least = fmin(least, room);
    most = fmax(most, swept / fmin(room, 1));
  }
  *parts = most > courant ? (int)ceil(most / courant) : 1;
  if (least > least_room) return OK;
  return FAIL(ERR_DIVERGED,
              "ice: a cell is squeezed to %g of its volume in one step at t = %g s, %g is allowed; give "
              "numerics.ice.acoustic_courant, or lower numerics.dt_factor",
              least, sim->t, least_room);
}

/* temperatures from the energies, densities and pressures with them */
static void settle(struct sim *sim, struct ice *ice)
{
  const struct fluid *fluid = &sim->scene->fluid;
  const struct grid  *g = &sim->grid;
  struct box          cells = grid_cells(g);
  describe(sim, ice);
  FOR_BOX(g, cells, c)
  if (ice->T_cc && ice->wet_cc[c] > 0) {
    double rho = ice->mass_cc[c] / grid_cell_volume(g);
    fluid->eos->temperature(fluid->eos_params, 1, &rho, &ice->inner_cc[c], &ice->T_cc[c]);
  }
  shock_settle(sim, ice);
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
      describe(sim, ice);
      pass(sim, ice, axis, dt / parts);
      ice->now.mass_out += mass_out(sim, ice, axis);
      gather(sim, ice, axis, dt / parts, gravity[axis] * g->h);
    }
  settle(sim, ice);
  return OK;
}
