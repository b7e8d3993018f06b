/* Faces: distances, gradients of the old pressure, predicted velocities. theory 4.2 */
#include "ice/ice.h"

#include "core/parallel.h"
#include "coupling/coupling.h"
#include "eos/eos.h"
#include "mpm/absorb.h"
#include "mpm/mpm.h"
#include "mpm/rub.h"
#include "mpm/walls.h"

#include <math.h>
#include <string.h>

/* distance to the surface from a cell that is filled to the share `fill`: theory 4.1; a sliver would make the matrix
 * stiff */
static const double nearest_surface = 0.05, farthest_surface = 1.5;

double ice_face_area(const struct grid *g) { return grid_cell_volume(g) / g->h; }

double ice_face_density(const struct grid *g, const struct ice *ice, int axis, long high)
{
  long low = high - g->stride[axis];
  bool l = ice->wet_cc[low] > 0, h = ice->wet_cc[high] > 0;
  if (!(l && h)) return ice->filling_cc[l ? low : high];
  if (!ice->several) return 0.5 * (ice->filling_cc[low] + ice->filling_cc[high]);
  const double *lower = ice->lower_fc + axis * g->size;
  return ice->mixture_cc[low] - lower[low] + lower[high];
}

bool ice_has_surface(const struct grid *g, const struct ice *ice, long c)
{
  for (int d = 0; d < g->dim; d++)
    if (ice->kind[d * g->size + c] == FACE_SURFACE || ice->kind[d * g->size + c + g->stride[d]] == FACE_SURFACE)
      return true;
  return false;
}

double ice_face_distance(const struct sim *sim, const struct ice *ice, int axis, long face)
{
  const struct grid *g = &sim->grid;
  switch (ice->kind[axis * g->size + face]) {
  case FACE_SURFACE: {
    long low = face - g->stride[axis], c = ice->wet_cc[face] > 0 ? face : low;
    if (ice->advects) return fmin(1, fmax(nearest_surface, ice_level(ice, low) + ice_level(ice, face) - 0.5));
    double fill = ice->mass_cc[c] / (ice->rho_cc[c] * grid_cell_volume(g)) + 1 - ice->porosity_cc[c];
    double way = fill - 0.5 + (ice->rim ? ice->rim[axis * g->size + face] : 0);
    return fmin(farthest_surface, fmax(nearest_surface, way));
  }
  case FACE_PRESSURE:
    return 0.5;
  default:
    return 1;
  }
}

double ice_outside_pressure(const struct sim *sim, const struct ice *ice, int axis, long face, double t)
{
  const struct grid *g = &sim->grid;
  if (ice->kind[axis * g->size + face] != FACE_PRESSURE) return 0;
  int    place[3];
  double x[3];
  grid_place(g, face, place);
  grid_face(g, face, axis, x);
  const struct side_condition *side = &sim->scene->fluid_side[2 * axis + (place[axis] > 0)];
  return side->kind == SIDE_OPEN ? ice->ambient : function_value(&side->pressure, x, t);
}

/* a fluid with less than this share of a cell may be in any state: what is left where another one came */
static const double trace = 1e-6;

static long count_outside(const struct sim *sim, const struct ice *ice, int fluid, long c0, int n)
{
  const struct fluid *own = scene_fluid(sim->scene, fluid);
  const double       *share = ice->several ? ice->alpha_cc + fluid * sim->grid.size : NULL;
  long                lost = 0;
  for (long c = c0; c < c0 + n; c++)
    if (ice->wet_cc[c] > 0 && (!share || share[c] > trace))
      lost += own->eos->outside(own->eos_params, 1, &ice->P_cc[c], ice_temperature(ice, c));
  return lost;
}

static enum status check_fluid_range(const struct sim *sim, const struct ice *ice, int fluid)
{
  const struct eos *eos = scene_fluid(sim->scene, fluid)->eos;
  struct box        cells = grid_cells(&sim->grid);
  long              bad = 0;
  PARALLEL_FOR
  for (long r = 0; r < box_rows(&cells); r++) {
    long lost = count_outside(sim, ice, fluid, box_row(&sim->grid, &cells, r), box_length(&cells));
    if (lost > 0) {
#pragma omp atomic
      bad += lost;
    }
  }
  if (bad == 0) return OK;
  return FAIL(ERR_DIVERGED,
              "ice: %ld cells have a pressure outside the range of %s, %s, at t = %g s; give a larger one "
              "at the start and the sides, or lower numerics.dt_factor",
              bad, eos->name, eos->range, sim->t);
}

enum status ice_check_range(const struct sim *sim, const struct ice *ice)
{
  for (int k = 0; k < ice->n_fluids; k++) TRY(check_fluid_range(sim, ice, k));
  return OK;
}

/* what heat has done to the volume is no defect */
static double swell(const struct ice *ice, long c) { return ice->swell_cc ? ice->swell_cc[c] : 0; }

/* density from the carried pressure, row by row; how far mass and pressure disagree */
enum status ice_update_properties(struct sim *sim, double dt)
{
  (void)dt;
  struct ice         *ice = ice_of(sim);
  const struct grid  *g = &sim->grid;
  const struct fluid *fluid = &sim->scene->fluid;
  struct box          cells = grid_cells(g);
  double              V = grid_cell_volume(g);
  PARALLEL_FOR
  for (long r = 0; r < box_rows(&cells); r++) {
    long c0 = box_row(g, &cells, r);
    fluid->eos->density(fluid->eos_params, g->n[0], ice->P_cc + c0, ice_temperature(ice, c0), ice->rho_cc + c0);
    for (long c = c0; c < c0 + g->n[0]; c++)
      ice->defect_cc[c] =
          ice->wet_cc[c] > 0
              ? ice->mass_cc[c] / (ice->rho_cc[c] * ice->porosity_cc[c] * ice->open_cc[c] * V) - 1 - swell(ice, c)
              : 0;
  }
  grid_fill_periodic(g, 1, ice->P_cc);
  grid_fill_periodic(g, 1, ice->rho_cc);
  grid_fill_periodic(g, 1, ice->mass_cc);
  grid_fill_periodic(g, g->dim, ice->vel_cc);
  return ice_check_range(sim, ice);
}

/* mean of the liquid of both cells by mass, where one of them has no pressure */
static double mixed_velocity(const struct sim *sim, const struct ice *ice, int axis, long f)
{
  long   low = f - sim->grid.stride[axis];
  double mass = ice->mass_cc[low] + ice->mass_cc[f];
  int    dim = sim->grid.dim;
  if (!(mass > 0)) return 0;
  return (ice->mass_cc[low] * ice->vel_cc[low * dim + axis] + ice->mass_cc[f] * ice->vel_cc[f * dim + axis]) / mass;
}

/* of several fluids: mean of both cells by the mass of the halves that the face has of them */
double ice_mean_velocity_of(const struct grid *g, const struct ice *ice, int axis, long f)
{
  const double *lower = ice->lower_fc + axis * g->size;
  long          low = f - g->stride[axis];
  double        below = ice->wet_cc[low] > 0 ? ice->porosity_cc[low] * (ice->mixture_cc[low] - lower[low]) : 0,
         above = ice->wet_cc[f] > 0 ? ice->porosity_cc[f] * lower[f] : 0;
  return (below * ice->vel_cc[low * g->dim + axis] + above * ice->vel_cc[f * g->dim + axis]) / (below + above);
}

double ice_mean_velocity(const struct sim *sim, const struct ice *ice, int axis, long f)
{
  const struct grid *g = &sim->grid;
  long               low = f - g->stride[axis];
  double             momentum = 0, wet = ice->wet_cc[low] + ice->wet_cc[f];
  if (ice->several) return ice_mean_velocity_of(g, ice, axis, f);
  for (int high = 0; high < 2; high++) {
    long c = high ? f : low;
    if (ice->wet_cc[c] > 0) momentum += ice->porosity_cc[c] * ice->rho_cc[c] * ice->vel_cc[c * g->dim + axis];
  }
  return momentum / (wet * ice->porosity_fc[axis * g->size + f] * ice_face_density(g, ice, axis, f));
}

void ice_fill_faces(const struct sim *sim, double *field)
{
  for (int axis = 0; axis < sim->grid.dim; axis++) grid_fill_periodic(&sim->grid, 1, field + axis * sim->grid.size);
}

/* share of what a face had beyond the mean of its cells that it keeps: where liquid flows by, that is no longer its own
 */
static double memory_of(const struct sim *sim, const struct ice *ice, long f, double dt)
{
  static const double forgets = 10; /* e-foldings per cell of way */
  const struct grid  *g = &sim->grid;
  double              square = 0;
  if (!ice->advects) return ice->params->memory;
  for (int d = 0; d < g->dim; d++) square += ice->vel_cc[f * g->dim + d] * ice->vel_cc[f * g->dim + d];
  return ice->params->memory * exp(-forgets * dt * sqrt(square) / g->h);
}

static double pressure_gradient(const struct sim *sim, const struct ice *ice, int axis, long f, double t)
{
  double outside = ice_outside_pressure(sim, ice, axis, f, t);
  long   low = f - sim->grid.stride[axis];
  double high_P = ice->wet_cc[f] > 0 ? ice->P_cc[f] : outside, low_P = ice->wet_cc[low] > 0 ? ice->P_cc[low] : outside;
  return (high_P - low_P) / (ice_face_distance(sim, ice, axis, f) * sim->grid.h);
}

enum status ice_predict_faces(struct sim *sim, double dt)
{
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    long       base = axis * g->size;
    FOR_BOX(g, faces, f)
    {
      ice->gradP_fc[base + f] = ice->u_old_fc[base + f] = ice->s_old_fc[base + f] = 0;
      bool falls = ice->advects && ice->kind[base + f] == FACE_VOID;
      if (falls) ice->u_old_fc[base + f] = mixed_velocity(sim, ice, axis, f);
      if (!ice_face_active(ice->kind[base + f])) continue;
      ice->gradP_fc[base + f] = pressure_gradient(sim, ice, axis, f, sim->t + dt);
      bool mixed = ice->advects && ice->kind[base + f] == FACE_SURFACE;
      ice->u_old_fc[base + f] = mixed ? mixed_velocity(sim, ice, axis, f)
                                      : ice_mean_velocity(sim, ice, axis, f) +
                                            memory_of(sim, ice, f, dt) * ice->beyond_fc[base + f] +
                                            dt * ice_face_forecast(sim, ice, axis, f);
    }
  }
  ice_fill_faces(sim, ice->gradP_fc);
  ice_fill_faces(sim, ice->s_old_fc);
  return OK;
}

/* mean over the n faces at -offset around a node that feel a pressure; there are none: over those that are void */
static inline double faces_of_node(const unsigned char *kind, const double *q, long node, int n, const long *offset)
{
  double total = 0, falling = 0;
  int    active = 0, open = 0;
  for (int i = 0; i < n; i++) {
    long f = node - offset[i];
    bool feels = ice_face_active(kind[f]), falls = kind[f] == FACE_VOID;
    total += feels ? q[f] : 0;
    falling += falls ? q[f] : 0;
    active += feels;
    open += falls;
  }
  return active ? total / active : open ? falling / open : 0;
}

/* skeleton nodes with the old pressure gradient along one axis */
static void predict_nodes(struct sim *sim, struct ice *ice, int axis, double dt)
{
  const struct mpm      *m = mpm_of(sim);
  const struct coupling *c = coupling_of(sim);
  const struct grid     *g = &sim->grid;
  struct box             nodes = grid_nodes(g);
  const unsigned char   *kind = ice->kind + axis * g->size;
  const double          *gradP = ice->gradP_fc + axis * g->size;
  long                   offset[8];
  int                    dim = g->dim, around = grid_node_offsets(g, axis, offset);
  double                 gravity[3];
  sim_gravity(sim, sim->t + 0.5 * dt, gravity);
  FOR_BOX(g, nodes, n)
  {
    double *v = &ice->vel_star_nc[n * dim + axis],
           push = faces_of_node(kind, gradP, n, around, offset) * c->solid_nc[n];
    *v = 0;
    if (m->mass_nc[n] > m->mass_floor)
      *v = m->vel_nc[n * dim + axis] + dt * ((m->force_nc[n * dim + axis] - push) / m->mass_nc[n] + gravity[axis]);
  }
}

/* mass-weighted mean of the nodes at faces; room takes care of nodes on walls, which own half a volume */
static void skeleton_faces(struct sim *sim, struct ice *ice, int axis)
{
  const struct mpm      *m = mpm_of(sim);
  const struct coupling *c = coupling_of(sim);
  const struct grid     *g = &sim->grid;
  struct box             faces = grid_faces(g, axis);
  long                   offset[8];
  int                    dim = g->dim, corners = grid_node_offsets(g, axis, offset);
  FOR_BOX(g, faces, f)
  {
    double mass = 0, momentum = 0;
    for (int i = 0; i < corners; i++) {
      long   node = f + offset[i];
      double own = m->mass_nc[node] / c->room_nc[node];
      mass += own;
      momentum += own * ice->vel_star_nc[node * dim + axis];
    }
    ice->s_old_fc[axis * g->size + f] = mass > 0 ? momentum / mass : 0;
  }
}

enum status ice_predict_solid(struct sim *sim, double dt)
{
  struct ice *ice = ice_of(sim);
  struct mpm *m = mpm_of(sim);
  int         dim = sim->grid.dim;
  for (int axis = 0; axis < dim; axis++) predict_nodes(sim, ice, axis, dt);
  absorb_slow(sim, m, dt, ice->vel_star_nc);
  boundary_velocity(&sim->grid, m->sides, sim->t + dt, ice->vel_star_nc);
  rub_nodes(sim, m, dt, ice->vel_star_nc);
  TRY(walls_meet_predicted(sim, m, ice->vel_star_nc));
  boundary_ghosts(&m->kernel_grid, m->sides, dim, sim->t + dt, ice->vel_star_nc);
  for (int axis = 0; axis < dim; axis++) skeleton_faces(sim, ice, axis);
  ice_fill_faces(sim, ice->s_old_fc);
  return OK;
}

double ice_fastest_change(const struct sim *sim, const struct ice *ice, double t)
{
  const struct grid *g = &sim->grid;
  double             gravity[3], most = 0;
  sim_gravity(sim, t, gravity);
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    FOR_BOX_SERIAL(g, faces, f)
    {
      if (!ice_face_active(ice->kind[axis * g->size + f])) continue;
      double change = gravity[axis] - pressure_gradient(sim, ice, axis, f, t) / ice_face_density(g, ice, axis, f);
      most = fmax(most, fabs(change));
    }
  }
  return most;
}

/* s in which liquid that is pushed with a, m/s2, goes half a cell at its last speed; drag holds it by k times its
 * speed: a dt^2 = h/2 (1 + k dt) */
static double time_to_cross(double h, double a, double k)
{
  return k > 0 ? (0.5 * h * k + sqrt(0.25 * h * h * k * k + 2 * a * h)) / (2 * a) : sqrt(0.5 * h / a);
}

/* the fluid's and the faces' share of the time step: theory 4.7 */
double ice_dt_limit(const struct sim *sim)
{
  const struct ice *ice = ice_of(sim);
  double gravity[3], g2 = 0, h = sim->grid.h, limit = ice->now.speed > 0 ? 0.5 * h / ice->now.speed : INFINITY;
  sim_gravity(sim, sim->t, gravity);
  for (int d = 0; d < 3; d++) g2 += gravity[d] * gravity[d];
  if (ice->advects) limit = fmin(limit, time_to_cross(h, ice->now.change, ice->now.drag_rate));
  if (ice->params->shocks) limit = fmin(limit, sqrt(0.5 * h / ice_fastest_change(sim, ice, sim->t)));
  limit = fmin(limit, ice_sound_dt(sim));
  if (ice->several && g2 > 0) return fmin(limit, 0.25 * sqrt(h / sqrt(g2)));
  return ice->surface && g2 > 0 ? fmin(limit, 0.5 * sqrt(h / sqrt(g2))) : limit;
}

/* what the faces gave the skeleton, pressure and drag, goes back to its nodes as momentum: theory 4.6 */
static void push_nodes(struct sim *sim, struct ice *ice, int axis, double dt)
{
  const struct mpm      *m = mpm_of(sim);
  const struct coupling *c = coupling_of(sim);
  const struct grid     *g = &sim->grid;
  struct box             nodes = grid_nodes(g);
  const unsigned char   *kind = ice->kind + axis * g->size;
  const double          *gradP = ice->gradP_fc + axis * g->size, *s_new = ice->s_fc + axis * g->size,
               *s_old = ice->s_old_fc + axis * g->size;
  long offset[8];
  int  dim = g->dim, around = grid_node_offsets(g, axis, offset);
  FOR_BOX(g, nodes, n)
  {
    double pressure = -dt * faces_of_node(kind, gradP, n, around, offset) * c->solid_nc[n];
    double change = faces_of_node(kind, s_new, n, around, offset) - faces_of_node(kind, s_old, n, around, offset);
    c->dmom_nc[n * dim + axis] = m->mass_nc[n] > m->mass_floor ? pressure + m->mass_nc[n] * change : 0;
  }
}

enum status ice_push_solid(struct sim *sim, double dt)
{
  struct ice *ice = ice_of(sim);
  for (int axis = 0; axis < sim->grid.dim; axis++) push_nodes(sim, ice, axis, dt);
  return OK;
}
