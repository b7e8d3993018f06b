/* Where the liquid is at the start, its pressure, and what every face is. theory 4.1 */
#include "ice/heat.h"
#include "ice/obstacles.h"
#include "ice/shock.h"

#include "core/memory.h"
#include "core/parallel.h"
#include "coupling/coupling.h"
#include "eos/eos.h"
#include "mpm/at_rest.h"
#include "mpm/mpm.h"

#include <math.h>

/* in a cell, with the temperature that it starts with */
static double density_at(const struct sim *sim, const struct ice *ice, long c, double P)
{
  double rho;
  sim->scene->fluid.eos->density(sim->scene->fluid.eos_params, 1, &P, ice_temperature(ice, c), &rho);
  return rho;
}

/* share of what obstacles leave open of a cell that lies in the fluid's region */
static double share_of_room(const struct sim *sim, const struct ice *ice, const double x[3])
{
  struct places region = places_of(&sim->scene->fluid.region);
  double        slice[SHARE_PARTS];
  if (!ice->obstacles) return share_inside(&sim->grid, &region, x, -1);
  return share_left(&sim->grid, &ice->obstacles->places, &region, x, 0, slice);
}

static enum status fill_cells(struct sim *sim, struct ice *ice)
{
  struct box cells = grid_cells(&sim->grid);
  int        dim = sim->grid.dim;
  FOR_BOX_SERIAL(&sim->grid, cells, c)
  {
    double x[3];
    grid_centre(&sim->grid, c, x);
    double share = share_of_room(sim, ice, x);
    if (!(ice->open_cc[c] > 0) || share <= (ice->advects ? 0 : 0.5)) continue;
    if (ice->advects) ice->alpha_cc[c] = share;
    ice->wet_cc[c] = (ice->advects ? ice_level(ice, c) : share) > 0.5;
    ice->P_cc[c] = function_value(&sim->scene->fluid.pressure, x, 0);
    ice->mass_cc[c] = share; /* becomes a mass when the pressure is known */
    for (int d = 0; d < dim; d++) ice->vel_cc[c * dim + d] = function_value(&sim->scene->fluid.velocity[d], x, 0);
  }
  grid_fill_periodic(&sim->grid, 1, ice->wet_cc);
  return OK;
}

static enum face_kind side_kind(const struct side_condition *side)
{
  return side->kind == SIDE_PRESSURE || side->kind == SIDE_OPEN ? FACE_PRESSURE
         : side->kind == SIDE_VELOCITY                          ? FACE_INLET
                                                                : FACE_CLOSED;
}

static enum face_kind classify(const struct sim *sim, const struct ice *ice, int axis, long f)
{
  const struct grid *g = &sim->grid;
  int                place[3], wet = (ice->wet_cc[f] > 0) + (ice->wet_cc[f - g->stride[axis]] > 0);
  grid_place(g, f, place);
  bool low = place[axis] == 0, high = place[axis] == g->n[axis];
  if (!(ice->open_fc[axis * g->size + f] > 0)) return FACE_CLOSED;
  if ((low || high) && !g->periodic[axis]) {
    enum face_kind kind = side_kind(&sim->scene->fluid_side[2 * axis + high]);
    enum face_kind dry = ice->advects && kind == FACE_PRESSURE ? FACE_VOID : FACE_CLOSED;
    return wet || (ice->advects && kind == FACE_INLET) ? kind : dry;
  }
  return wet == 2 ? FACE_INNER : wet == 1 ? FACE_SURFACE : FACE_VOID;
}

void ice_classify_faces(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  bool               fixed = false;
  ice->surface = false;
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    for (int d = 0; d < g->dim; d++) { /* the nodes of a seam, and slopes across it, look there too */
      faces.lo[d] -= g->periodic[d];
      faces.hi[d] += g->periodic[d];
    }
    FOR_BOX_SERIAL(g, faces, f)
    {
      enum face_kind kind = classify(sim, ice, axis, f);
      ice->kind[axis * g->size + f] = (unsigned char)kind;
      ice->surface = ice->surface || kind == FACE_SURFACE;
      fixed = fixed || kind == FACE_SURFACE || kind == FACE_PRESSURE;
    }
  }
  ice->closed = !fixed;
  ice->singular = !fixed;
  for (int k = 0; k < sim->scene->n_fluids; k++)
    ice->singular = ice->singular && isinf(scene_fluid(sim->scene, k)->bulk_modulus);
}

/* pressure of a cell whose upper neighbour (against gravity) has `above`, with the face density of the scheme: exactly
 * in balance. The density depends on the pressure a little, hence the iteration */
static double pressure_below(const struct sim *sim, const struct ice *ice, long c, long up, double weight)
{
  double above = ice->P_cc[up], rho = density_at(sim, ice, up, above), P = above + weight * rho;
  for (int i = 0; i < 20; i++) P = above + weight * 0.5 * (rho + density_at(sim, ice, c, P));
  return P;
}

/* first pressure below a surface or a side with a given pressure */
static double pressure_under(const struct sim *sim, const struct ice *ice, long c, double outside, double weight)
{
  double P = outside + weight * density_at(sim, ice, c, outside);
  for (int i = 0; i < 20; i++) P = outside + weight * density_at(sim, ice, c, P);
  return P;
}

int ice_gravity_axis(const struct sim *sim, double *g)
{
  double up[3];
  at_rest_up(sim->scene, up, g);
  for (int d = 0; d<sim->grid.dim && * g> 0; d++)
    if (fabs(up[d]) > 1 - 1e-14) return 2 * d + (up[d] < 0);
  return -1;
}

static enum status weighed_pressure(const struct sim *sim, struct ice *ice, long c)
{
  struct rest rest;
  double      x[3];
  grid_centre(&sim->grid, c, x);
  TRY(at_rest_column(sim->scene, x, &rest));
  ice->P_cc[c] = rest.pressure;
  return OK;
}

static enum status rest_pressure_of(const struct sim *sim, struct ice *ice, long c, int code, double g)
{
  const struct grid *grid = &sim->grid;
  int                axis = code / 2;
  long               up = code % 2 ? -grid->stride[axis] : grid->stride[axis], f = code % 2 ? c : c + up;
  enum face_kind     kind = ice->kind[axis * grid->size + f];
  if (kind == FACE_INNER) {
    ice->P_cc[c] = pressure_below(sim, ice, c, c + up, g * grid->h);
    return OK;
  }
  if (kind == FACE_SURFACE || kind == FACE_PRESSURE) {
    double outside = ice_outside_pressure(sim, ice, axis, f, 0);
    ice->P_cc[c] = pressure_under(sim, ice, c, outside, g * grid->h * ice_face_distance(sim, ice, axis, f));
    return OK;
  }
  ice->P_cc[c] = NAN;
  return ice->obstacles ? OK : weighed_pressure(sim, ice, c);
}

/* One round over cells below obstacles, which know their pressure from a neighbour beside or below them; true: some new
 * one does. */
static bool spread_round(const struct sim *sim, struct ice *ice, int code, double g)
{
  const struct grid *grid = &sim->grid;
  struct box         cells = grid_cells(grid);
  bool               found = false;
  FOR_BOX_SERIAL(grid, cells, c)
  for (int side = 0; side < 2 * grid->dim && ice->wet_cc[c] > 0 && isnan(ice->P_cc[c]); side++) {
    int    axis = side / 2;
    long   n = side % 2 ? c + grid->stride[axis] : c - grid->stride[axis], f = side % 2 ? n : c;
    double weight = axis != code / 2 ? 0 : (side % 2 != code % 2 ? 1 : -1) * g * grid->h;
    if (ice->kind[axis * grid->size + f] != FACE_INNER || isnan(ice->P_cc[n])) continue;
    ice->P_cc[c] = pressure_below(sim, ice, c, n, weight);
    found = true;
  }
  return found;
}

/* what no neighbour tells the column above does */
static enum status spread_pressures(const struct sim *sim, struct ice *ice, int code, double g)
{
  struct box cells = grid_cells(&sim->grid);
  while (spread_round(sim, ice, code, g)) continue;
  FOR_BOX_SERIAL(&sim->grid, cells, c)
  if (ice->wet_cc[c] > 0 && isnan(ice->P_cc[c])) TRY(weighed_pressure(sim, ice, c));
  return OK;
}

/* from the top down, plane by plane */
static enum status rest_pressures(struct sim *sim, struct ice *ice)
{
  const struct grid *grid = &sim->grid;
  double             g;
  int                code = ice_gravity_axis(sim, &g), axis = code < 0 ? 0 : code / 2, n = grid->n[axis];
  if (sim->scene->start != START_AT_REST || g == 0) return OK;
  for (int k = 0; k < n; k++) {
    struct box plane = grid_cells(grid);
    plane.lo[axis] = code % 2 == 1 ? k : n - 1 - k;
    plane.hi[axis] = plane.lo[axis] + 1;
    FOR_BOX_SERIAL(grid, plane, c)
    {
      if (ice->wet_cc[c] > 0 && code >= 0) TRY(rest_pressure_of(sim, ice, c, code, g));
      if (ice->wet_cc[c] > 0 && code < 0) TRY(weighed_pressure(sim, ice, c));
    }
  }
  return ice->obstacles && code >= 0 ? spread_pressures(sim, ice, code, g) : OK;
}

/* shares become masses; densities serve the surface distances until the first step computes them */
static void weigh_cells(struct sim *sim, struct ice *ice, bool with_pressure)
{
  struct box cells = grid_cells(&sim->grid);
  double     V = grid_cell_volume(&sim->grid);
  FOR_BOX_SERIAL(&sim->grid, cells, c)
  if (ice->mass_cc[c] > 0) {
    double rho = density_at(sim, ice, c, with_pressure ? ice->P_cc[c] : 0), old = ice->rho_cc[c];
    ice->mass_cc[c] *= with_pressure ? rho / old : rho * V * ice->porosity_cc[c] * ice->open_cc[c];
    ice->rho_cc[c] = rho;
  }
}

/* velocity and masses of several fluids, whose shares and pressure are known */
static void weigh_several(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             V = grid_cell_volume(g);
  FOR_BOX_SERIAL(g, cells, c)
  {
    double x[3], mass = 0, momentum[3] = {0, 0, 0};
    grid_centre(g, c, x);
    for (int k = 0; k < ice->n_fluids; k++) {
      const struct fluid *fluid = scene_fluid(sim->scene, k);
      double              rho;
      fluid->eos->density(fluid->eos_params, 1, &ice->P_cc[c], NULL, &rho);
      double m = ice->mass_cc[k * g->size + c] = ice->alpha_cc[k * g->size + c] * rho * V * ice->porosity_cc[c];
      mass += m;
      for (int d = 0; d < g->dim && m > 0; d++) momentum[d] += m * function_value(&fluid->velocity[d], x, 0);
    }
    for (int d = 0; d < g->dim; d++) ice->vel_cc[c * g->dim + d] = momentum[d] / mass;
    for (int k = 0; k < ice->n_fluids && ice->each_cc; k++)
      for (int d = 0; d < g->dim; d++)
        ice->each_cc[(k * g->size + c) * g->dim + d] = function_value(&scene_fluid(sim->scene, k)->velocity[d], x, 0);
  }
}

/* fluxes of the starting velocity: theta < 1 needs the old ones in its first step */
static void start_fluxes(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  int                dim = g->dim;
  grid_fill_periodic(g, dim, ice->vel_cc);
  for (int axis = 0; axis < dim; axis++) {
    struct box faces = grid_faces(g, axis);
    FOR_BOX_SERIAL(g, faces, f)
    {
      long   q = axis * g->size + f, low = f - g->stride[axis];
      double wet = ice->wet_cc[f] + ice->wet_cc[low];
      bool   given = ice->kind[q] == FACE_INLET;
      if (!ice_face_active(ice->kind[q]) && !given) continue;
      double u =
          given
              ? ice_inlet_velocity(sim, axis, axis, f, 0)
              : (ice->wet_cc[f] * ice->vel_cc[f * dim + axis] + ice->wet_cc[low] * ice->vel_cc[low * dim + axis]) / wet;
      ice->water_fc[q] = ice->flux_fc[q] = ice->porosity_fc[q] * ice->open_fc[q] * u;
      ice->now.speed = fmax(ice->now.speed, fabs(u));
    }
  }
}

/* Distance to an oblique or curved surface: what its true place on the way to the next centre has beyond the fill of
 * the cell less a half, in h. Flat ones that lie along the cells need nothing. */
static enum status measure_rim(struct sim *sim, struct ice *ice)
{
  static const double small = 1e-6, farthest = 1.5;
  const struct grid  *g = &sim->grid;
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    FOR_BOX_SERIAL(g, faces, f)
    {
      double x[3];
      bool   upper = ice->wet_cc[f] > 0;
      long   c = upper ? f : f - g->stride[axis];
      if (ice->kind[axis * g->size + f] != FACE_SURFACE) continue;
      grid_centre(g, c, x);
      struct places region = places_of(&sim->scene->fluid.region);
      double        way = share_way_out(g, &region, x, axis, upper ? -1 : 1, farthest);
      double        beyond = way - (ice->mass_cc[c] - 0.5);
      if (fabs(beyond) < small) continue;
      if (!ice->rim) TRY(NEW(&ice->rim, g->size * g->dim));
      ice->rim[axis * g->size + f] = beyond;
    }
  }
  return OK;
}

/* share of every node's room that is wet; a surface that moves: all of it */
static void mark_extent(struct sim *sim)
{
  const struct ice      *ice = ice_of(sim);
  const struct coupling *c = coupling_of(sim);
  const struct grid     *g = &sim->grid;
  struct box             nodes = grid_nodes(g);
  long                   offset[8];
  int                    around = grid_node_offsets(g, -1, offset);
  FOR_BOX(g, nodes, n)
  {
    int    place[3], cells = 0;
    double wet = 0;
    for (int i = 0; i < around; i++) {
      bool inside = true;
      grid_place(g, n - offset[i], place);
      for (int d = 0; d < g->dim; d++) inside = inside && (g->periodic[d] || (place[d] >= 0 && place[d] < g->n[d]));
      cells += inside;
      if (inside) wet += ice->wet_cc[n - offset[i]];
    }
    c->fluid_fill_nc[n] = ice->advects ? 1 : wet / cells;
  }
}

/* the same by the sums that gather the skeleton: a lattice of points in the wet cells */
static void mark_reach(struct sim *sim)
{
  const struct ice      *ice = ice_of(sim);
  const struct mpm      *m = mpm_of(sim);
  const struct coupling *c = coupling_of(sim);
  const struct grid     *g = &sim->grid;
  const int             *along = sim->scene->numerics.points_per_axis;
  struct box             cells = grid_cells(g), nodes = grid_nodes(g);
  double                 volume = mpm_point_volume(sim->scene);
  int                    points = along[0] * along[1] * (g->dim == 3 ? along[2] : 1);
  FOR_BOX_SERIAL(g, cells, i)
  for (int p = 0; p < points && ice->wet_cc[i] > 0; p++) {
    long   node[MAX_SUPPORT];
    double w[MAX_SUPPORT], x[3];
    int    left = p;
    grid_centre(g, i, x);
    for (int d = 0; d < g->dim; left /= along[d++]) x[d] += g->h * ((left % along[d] + 0.5) / along[d] - 0.5);
    m->kernels->weights(&m->kernel_grid, x, node, w, NULL);
    for (int q = 0; q < m->kernels->n_support; q++) c->fluid_reach_nc[node[q]] += w[q] * volume;
  }
  boundary_fold(&m->kernel_grid, sim->scene->solid_side, 1, c->fluid_reach_nc);
  FOR_BOX_SERIAL(g, nodes, n) c->fluid_reach_nc[n] = ice->advects ? 1 : c->fluid_reach_nc[n] / c->room_nc[n];
}

static enum status start_one(struct sim *sim, struct ice *ice)
{
  if (!ice->advects) TRY(measure_rim(sim, ice));
  weigh_cells(sim, ice, false);
  TRY(rest_pressures(sim, ice));
  weigh_cells(sim, ice, true);
  return OK;
}

static enum status start_several(struct sim *sim, struct ice *ice)
{
  TRY(ice_rest_several(sim, ice));
  weigh_several(sim, ice);
  return ice_mix_fluids(sim, 0);
}

enum status ice_create(struct sim *sim, void *state)
{
  struct ice      *ice = state;
  struct coupling *c = coupling_of(sim);
  long             faces = sim->grid.size * sim->grid.dim;
  ice->params = scene_module_params(sim->scene, &module_ice);
  ice->advects = ice->params->advection && !ice->params->shocks;
  ice->skeleton = c != NULL;
  ice->moves = c && mpm_solid_moves(sim->scene);
  TRY(NEW(&ice->kind, faces));
  TRY(NEW(&ice->one, faces));
  if (ice->advects && sim->scene->n_fluids == 1) TRY(NEW(&ice->fill, sim->grid.size));
  if (ice->advects) TRY(plic_create(&sim->grid, ice->pore_cc, &ice->plic));
  for (long f = 0; f < faces; f++) ice->one[f] = 1;
  ice->n_fluids = sim->scene->n_fluids;
  ice->several = ice->n_fluids > 1 && !ice->params->shocks;
  if (ice->several) TRY(NEW(&ice->only, sim->grid.size));
  ice->filling_cc = ice->n_fluids > 1 ? ice->mixture_cc : ice->rho_cc;
  ice->porosity_cc = c ? c->porosity_cc : ice->one;
  ice->porosity_fc = c ? c->porosity_fc : ice->one;
  ice->open_cc = ice->open_fc = ice->one;
  TRY(obstacles_create(sim, ice));
  if (ice->T_cc) TRY(ice_heat_create(sim, ice));
  TRY(ice->n_fluids > 1 ? ice_fill_several(sim, ice) : fill_cells(sim, ice));
  if (c) mark_extent(sim);
  if (c) mark_reach(sim);
  if (c) TRY(coupling_fill_cells(sim, 0));
  ice_classify_faces(sim, ice);
  if (ice->n_fluids == 1) TRY(start_one(sim, ice));
  if (ice->several) TRY(start_several(sim, ice));
  if (ice->params->shocks) TRY(shock_create(sim, ice));
  if (sim->scene->fluid.prescribed) {
    ice_create_prescribed(sim, ice);
    return OK;
  }
  start_fluxes(sim, ice);
  if (ice->advects && ice->skeleton) TRY(ice_resist_faces(sim, 0)); /* the first step's limit counts on drag */
  if (ice->forecast_cc) ice_start_forecast(sim, ice);
  if (ice->advects) ice->now.change = ice_fastest_change(sim, ice, 0);
  if (ice->fill) ice_open_rooms(sim, ice);
  static const enum linear_method method[] = {
      [SOLVER_AUTO] = LINEAR_AUTO, [SOLVER_HYPRE] = LINEAR_HYPRE, [SOLVER_DIRECT] = LINEAR_DIRECT};
  return linear_create(&sim->grid, method[sim->scene->numerics.pressure_solver], &ice->linear);
}
