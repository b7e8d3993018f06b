/* Cells take the momentum of their faces, and the flux carries mass. theory 4.6 */
#include "ice/advect.h"
#include "ice/each.h"

#include "core/parallel.h"

#include <math.h>

/* Share of a cell that the faces of axis d move: where an obstacle cuts it no less than they span, or a cell with
 * little room would be flung about. */
static double moved_share(const struct grid *g, const struct ice *ice, long c, int d)
{
  const double *open = ice->open_fc + d * g->size;
  return fmax(ice->open_cc[c], 0.5 * (open[c] + open[c + g->stride[d]]));
}

/* change of velocity at a face of a cell in this step: what a side prescribes changes, too, and moves liquid that moves
 */
static double change_at_face(const struct sim *sim, const struct ice *ice, int axis, long f, double dt)
{
  long q = axis * sim->grid.size + f;
  if (ice_face_active(ice->kind[q])) return ice->u_fc[q] - ice->u_old_fc[q];
  if (!ice->advects || ice->kind[q] != FACE_INLET) return 0;
  return ice_inlet_velocity(sim, axis, axis, f, sim->t + dt) - ice_inlet_velocity(sim, axis, axis, f, sim->t);
}

/* each face hands half of its impulse n rho V du to each of its cells: nothing is lost between them */
static void move_cells(struct sim *sim, struct ice *ice, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             half = 0.5 * grid_cell_volume(g);
  FOR_BOX(g, cells, c)
  {
    if (!(ice->wet_cc[c] > 0) || (ice->advects && ice_has_surface(g, ice, c))) continue;
    for (int d = 0; d < g->dim; d++) {
      double impulse = 0;
      for (int high = 0; high < 2; high++) {
        long   f = c + high * g->stride[d], q = d * g->size + f;
        double change = change_at_face(sim, ice, d, f, dt);
        if (change != 0)
          impulse += half * ice->open_fc[q] * ice->porosity_fc[q] * ice_face_density(g, ice, d, f) * change;
      }
      ice->vel_cc[c * g->dim + d] += impulse * ice->open_cc[c] / (ice->mass_cc[c] * moved_share(g, ice, c, d));
    }
  }
}

/* of several fluids: every half of a cell takes the change of its face. What the faces have gained the cells have. */
static void move_several(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX(g, cells, c)
  for (int d = 0; d < g->dim; d++) {
    long   q = d * g->size + c, up = q + g->stride[d];
    double lower = ice->lower_fc[q], upper = ice->mixture_cc[c] - lower;
    double below = ice_face_active(ice->kind[q]) ? ice->u_fc[q] - ice->u_old_fc[q] : 0,
           above = ice_face_active(ice->kind[up]) ? ice->u_fc[up] - ice->u_old_fc[up] : 0;
    ice->vel_cc[c * g->dim + d] += (lower * below + upper * above) / ice->mixture_cc[c];
  }
}

/* change of velocity along axis d of a cell with a pressure and a surface: each face counts as much as there is liquid
 * between it, or the surface, and the cell's centre */
static double pressed_change(const struct sim *sim, const struct ice *ice, long c, int d)
{
  const struct grid *g = &sim->grid;
  double             sum = 0, liquid = 0;
  for (int high = 0; high < 2; high++) {
    long   q = d * g->size + c + high * g->stride[d];
    double share = ice->kind[q] == FACE_SURFACE ? fmin(0.5, ice_level(ice, c) - 0.5) : 0.5;
    sum += share * ice->open_fc[q] * (ice->u_fc[q] - ice->u_old_fc[q]);
    liquid += share;
  }
  return sum / (liquid * moved_share(g, ice, c, d));
}

/* a cell without pressure hears only faces that have one, */
static bool face_change(const struct sim *sim, const struct ice *ice, long c, int d, double *change)
{
  const struct grid *g = &sim->grid;
  int                n = 0;
  *change = 0;
  for (int high = 0; high < 2; high++) {
    long q = d * g->size + c + high * g->stride[d];
    if (ice->kind[q] != FACE_SURFACE) continue;
    *change += ice->u_fc[q] - ice->u_old_fc[q];
    n++;
  }
  *change /= n > 0 ? n : 1;
  return n > 0;
}

/* else follows the cells beside it that have one, but only half: all of it would feed thin tongues, none slow waves */
static bool neighbour_change(const struct sim *sim, const struct ice *ice, long c, int d, double *change)
{
  static const double follows = 0.5;
  const struct grid  *g = &sim->grid;
  int                 n = 0;
  *change = 0;
  for (int e = 0; e < g->dim; e++)
    for (int side = -1; side <= 1 && e != d; side += 2) {
      long beside = c + side * g->stride[e];
      if (!(ice->wet_cc[beside] > 0)) continue;
      *change += pressed_change(sim, ice, beside, d);
      n++;
    }
  *change *= follows / (n > 0 ? n : 1);
  return n > 0;
}

/* else falls */
static double loose_change(const struct sim *sim, const struct ice *ice, long c, int d)
{
  long   low = d * sim->grid.size + c, high = low + sim->grid.stride[d];
  double change;
  if (ice->wet_cc[c] > 0) return pressed_change(sim, ice, c, d);
  if (face_change(sim, ice, c, d, &change) || neighbour_change(sim, ice, c, d, &change)) return change;
  double sum = ice->open_fc[low] * (ice->u_fc[low] - ice->u_old_fc[low]) +
               ice->open_fc[high] * (ice->u_fc[high] - ice->u_old_fc[high]);
  return 0.5 * sum / moved_share(&sim->grid, ice, c, d);
}

/* what falls lands: nothing without a pressure moves into a closed face */
static void land(struct sim *sim, struct ice *ice, long c)
{
  const struct grid *g = &sim->grid;
  for (int d = 0; d < g->dim; d++) {
    double              *vel = &ice->vel_cc[c * g->dim + d];
    const unsigned char *kind = ice->kind + d * g->size;
    if (kind[c] == FACE_CLOSED) *vel = fmax(0, *vel);
    if (kind[c + g->stride[d]] == FACE_CLOSED) *vel = fmin(0, *vel);
  }
}

/* cells full of liquid take impulses, others changes of velocity */
static void move_loose_cells(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX(g, cells, c)
  {
    bool wet = ice->wet_cc[c] > 0;
    if (!(ice->mass_cc[c] > 0) || (wet && !ice_has_surface(g, ice, c))) continue;
    for (int d = 0; d < g->dim; d++) ice->vel_cc[c * g->dim + d] += loose_change(sim, ice, c, d);
    if (!wet) land(sim, ice, c);
  }
}

/* mass through a face in this step, kg, upwards; a surface only rises or falls with its cell */
static double carried_mass(const struct sim *sim, const struct ice *ice, int axis, long f, double dt)
{
  long           q = axis * sim->grid.size + f;
  enum face_kind kind = ice->kind[q];
  if (kind != FACE_INNER && kind != FACE_PRESSURE && kind != FACE_INLET) return 0;
  return dt * ice_face_area(&sim->grid) * ice->carried_fc[q] * ice_face_density(&sim->grid, ice, axis, f);
}

static void carry_mass(struct sim *sim, struct ice *ice, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX(g, cells, c)
  for (int d = 0; d < g->dim; d++)
    ice->mass_cc[c] += carried_mass(sim, ice, d, c, dt) - carried_mass(sim, ice, d, c + g->stride[d], dt);
}

/* net mass through the sides of the grid */
static double leaving_mass(const struct sim *sim, const struct ice *ice, double dt)
{
  const struct grid *g = &sim->grid;
  double             out = 0;
  for (int side = 0; side < 2 * g->dim; side++) {
    int        axis = side / 2;
    struct box b = grid_side_faces(g, side);
    if (g->periodic[axis]) continue;
    FOR_BOX_SERIAL(g, b, f) out += (side % 2 ? 1 : -1) * carried_mass(sim, ice, axis, f, dt);
  }
  return out;
}

/* what the new face velocity has beyond the mean of its cells; without this memory P checkerboards as dt shrinks */
static void remember_faces(struct sim *sim, struct ice *ice, double dt)
{
  const struct grid *g = &sim->grid;
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    FOR_BOX(g, faces, f)
    {
      long   q = axis * g->size + f;
      double carried = dt * ice_face_forecast(sim, ice, axis, f);
      bool   own = ice->kind[q] == FACE_INNER && (!ice->several || advect_same(ice, f - g->stride[axis], f));
      ice->beyond_fc[q] = own ? ice->u_fc[q] - carried - ice_mean_velocity(sim, ice, axis, f) : 0;
    }
  }
}

/* drops smaller than this share of a cell do not limit the step: they are carried in parts of it */
static const double least_drop = 0.01;

/* fastest face velocity, and the defect as it was at the start of the step */
static enum status watch(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             fastest = 0, square = 0, most = 0, wet = 0;
  FOR_BOX_SERIAL(g, cells, c)
  {
    bool drops = ice->advects && ice->alpha_cc[c] > least_drop;
    if (!(ice->wet_cc[c] > 0) && !drops) continue;
    for (int d = 0; d < g->dim; d++)
      for (int high = 0; high < 2; high++) {
        long q = d * g->size + c + high * g->stride[d];
        fastest = isfinite(ice->u_fc[q]) ? fmax(fastest, fabs(ice->u_fc[q])) : INFINITY;
      }
    if (!(ice->wet_cc[c] > 0) || (!ice->advects && ice_has_surface(g, ice, c))) continue;
    square += ice->defect_cc[c] * ice->defect_cc[c];
    most = fmax(most, fabs(ice->defect_cc[c]));
    wet++;
  }
  ice->now.speed = fastest;
  ice->now.defect_rms = wet > 0 ? sqrt(square / wet) : 0;
  ice->now.defect_max = most;
  sim->defect_rms_max = fmax(sim->defect_rms_max, ice->now.defect_rms);
  sim->defect_max = fmax(sim->defect_max, most);
  if (fastest < INFINITY) return OK;
  return FAIL(ERR_DIVERGED, "ice: a fluid velocity is not finite at t = %g s; lower numerics.dt_factor", sim->t);
}

enum status ice_accelerate_cells(struct sim *sim, double dt)
{
  struct ice *ice = ice_of(sim);
  TRY(watch(sim, ice));
  if (ice->each_cc)
    each_move(sim, ice);
  else if (ice->several)
    move_several(sim, ice);
  else {
    move_cells(sim, ice, dt);
    move_loose_cells(sim, ice);
  }
  grid_fill_periodic(&sim->grid, sim->grid.dim, ice->vel_cc);
  remember_faces(sim, ice, dt);
  return OK;
}

enum status ice_update_cells(struct sim *sim, double dt)
{
  struct ice *ice = ice_of(sim);
  TRY(watch(sim, ice));
  move_cells(sim, ice, dt);
  carry_mass(sim, ice, dt);
  ice->now.mass_out += leaving_mass(sim, ice, dt);
  grid_fill_periodic(&sim->grid, 1, ice->mass_cc);
  grid_fill_periodic(&sim->grid, sim->grid.dim, ice->vel_cc);
  remember_faces(sim, ice, dt);
  return OK;
}
