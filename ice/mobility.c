/* Drag is eliminated at the faces: with U = (fluid, skeleton), (I + dt B) U = U* - dt R grad dP, so that the pressure
 * matrix contains the drag and no time step limit comes from it. theory 4.3 */
#include "ice/ice.h"

#include "core/parallel.h"
#include "coupling/coupling.h"
#include "mpm/mpm.h"

#include <math.h>

/* tangential slip at a face: mean over its wet cells of fluid minus skeleton velocity */
static double tangential_slip2(const struct sim *sim, const struct ice *ice, int axis, long f)
{
  const struct grid *g = &sim->grid;
  int                dim = g->dim;
  double             sum = 0, wet = ice->wet_cc[f] + ice->wet_cc[f - g->stride[axis]];
  for (int t = 0; t < dim; t++) {
    if (t == axis) continue;
    double slip = 0;
    for (int high = 0; high < 2; high++) {
      long c = high ? f : f - g->stride[axis];
      if (!(ice->wet_cc[c] > 0)) continue;
      double s = 0.5 * (ice->s_old_fc[t * g->size + c] + ice->s_old_fc[t * g->size + c + g->stride[t]]);
      slip += (ice->vel_cc[c * dim + t] - s) / wet;
    }
    sum += slip * slip;
  }
  return sum;
}

/* permeability and diameter at a face: of the only medium, or averaged over the skeleton at its nodes */
static void medium_of_face(const struct coupling *c, long f, int n, const long *offset, double *permeability,
                           double *diameter)
{
  double bulk = 0, conductance = 0, fineness = 0;
  *permeability = c->permeability;
  *diameter = c->diameter;
  if (!c->several_media) return;
  for (int i = 0; i < n; i++) {
    bulk += c->bulk_nc[f + offset[i]];
    conductance += c->conductance_nc[f + offset[i]];
    fineness += c->fineness_nc[f + offset[i]];
  }
  *permeability = conductance > 0 ? bulk / conductance : 0;
  *diameter = fineness > 0 ? sqrt(bulk / fineness) : 0;
}

/* share of a fluid at a face, mean of its wet cells */
static double face_share(const struct grid *g, const struct ice *ice, int fluid, int axis, long f)
{
  const double *alpha = ice->alpha_cc + fluid * g->size;
  long          low = f - g->stride[axis];
  bool          l = ice->wet_cc[low] > 0, h = ice->wet_cc[f] > 0;
  return l && h ? 0.5 * (alpha[low] + alpha[f]) : l || h ? alpha[l ? low : f] : 0;
}

/* drag of several fluids by their volumes: each its own, or with one velocity the sum; drag_fc holds that of the first
 */
static void mix_drag(const struct sim *sim, struct ice *ice, int axis, long f0, int n, const double *slip,
                     const double *permeability, const double *diameter)
{
  const struct coupling *c = coupling_of(sim);
  const struct grid     *g = &sim->grid;
  long                   base = axis * g->size + f0;
  double                 own[DRAG_BATCH];
  for (int i = 0; i < n; i++) ice->drag_fc[base + i] *= face_share(g, ice, 0, axis, f0 + i);
  double *sum = ice->drag_fc + base;
  for (int k = 1; k < ice->n_fluids; k++) {
    coupling_drag(sim->scene, scene_fluid(sim->scene, k), n, c->porosity_fc + base, c->fill_fc + base,
                  c->medium_porosity_fc + base, slip, permeability, diameter, own);
    if (ice->each_cc) sum = ice->drag_fc + k * g->dim * g->size + base;
    for (int i = 0; i < n; i++) sum[i] = (ice->each_cc ? 0 : sum[i]) + face_share(g, ice, k, axis, f0 + i) * own[i];
  }
}

/* a stretch of n <= DRAG_BATCH faces of one row */
static void resist_stretch(const struct sim *sim, struct ice *ice, int axis, long f0, int n)
{
  const struct coupling *c = coupling_of(sim);
  long                   base = axis * sim->grid.size + f0;
  long                   offset[8];
  int                    corners = grid_node_offsets(&sim->grid, axis, offset);
  double                 slip[DRAG_BATCH], permeability[DRAG_BATCH], diameter[DRAG_BATCH];
  for (int i = 0; i < n; i++) {
    double normal = ice->u_old_fc[base + i] - ice->s_old_fc[base + i];
    bool   counts = c->fill_fc[base + i] > 0 && ice_face_active(ice->kind[base + i]);
    slip[i] = counts ? sqrt(normal * normal + tangential_slip2(sim, ice, axis, f0 + i)) : 0;
    medium_of_face(c, f0 + i, corners, offset, &permeability[i], &diameter[i]);
  }
  coupling_drag(sim->scene, &sim->scene->fluid, n, c->porosity_fc + base, c->fill_fc + base,
                c->medium_porosity_fc + base, slip, permeability, diameter, ice->drag_fc + base);
  if (ice->several) mix_drag(sim, ice, axis, f0, n, slip, permeability, diameter);
}

/* 1/s, the least of all faces that answer to pressure */
static double least_drag_rate(const struct sim *sim, const struct ice *ice)
{
  const struct grid *g = &sim->grid;
  double             least = INFINITY;
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    FOR_BOX_SERIAL(g, faces, f)
    {
      long q = axis * g->size + f;
      if (!ice_face_active(ice->kind[q])) continue;
      least = fmin(least, ice->drag_fc[q] / (ice->porosity_fc[q] * ice_face_density(g, ice, axis, f)));
    }
  }
  return least < INFINITY ? least : 0;
}

enum status ice_resist_faces(struct sim *sim, double dt)
{
  (void)dt;
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    int        length = box_length(&faces);
    PARALLEL_FOR
    for (long r = 0; r < box_rows(&faces); r++)
      for (int i = 0; i < length; i += DRAG_BATCH)
        resist_stretch(sim, ice, axis, box_row(g, &faces, r) + i, length - i < DRAG_BATCH ? length - i : DRAG_BATCH);
  }
  if (ice->advects) ice->now.drag_rate = least_drag_rate(sim, ice);
  return OK;
}

/* what happens at one face between fluid and skeleton */
struct face {
  double n, rho, rho_s; /* porosity, densities; rho_s 0: no skeleton that moves */
  double u, s, K;       /* predicted velocities, drag */
};

/* closed form for two phases; a = dt K/(n rho), b = dt K/(phi rho_s). Replies: d(u, s) = -dt reply grad dP */
static void eliminate(const struct face *f, double dt, double *u, double *s, double *u_reply, double *s_reply)
{
  double phi = 1 - f->n, a = dt * f->K / (f->n * f->rho),
         b = f->rho_s > 0 && phi > 0 ? dt * f->K / (phi * f->rho_s) : 0;
  double light = f->rho_s > 0 ? 1 / f->rho_s : 0, D = 1 + a + b;
  *u = ((1 + b) * f->u + a * f->s) / D;
  *s = (b * f->u + (1 + a) * f->s) / D;
  *u_reply = ((1 + b) / f->rho + a * light) / D;
  *s_reply = (b / f->rho + (1 + a) * light) / D;
}

/* density of the grains at a face; 0: there are none */
static double grain_density(const struct mpm *m, const struct coupling *c, long f, int n, const long *offset)
{
  double mass = 0, volume = 0;
  for (int i = 0; i < n; i++) {
    mass += m->mass_nc[f + offset[i]];
    volume += c->solid_nc[f + offset[i]];
  }
  return volume > 0 ? mass / volume : 0;
}

double ice_grain_density(const struct sim *sim, int axis, long f)
{
  long offset[8];
  int  corners = grid_node_offsets(&sim->grid, axis, offset);
  return grain_density(mpm_of(sim), coupling_of(sim), f, corners, offset);
}

static void eliminate_axis(struct sim *sim, struct ice *ice, int axis, double dt)
{
  const struct grid     *g = &sim->grid;
  const struct mpm      *m = mpm_of(sim);
  const struct coupling *c = coupling_of(sim);
  struct box             faces = grid_faces(g, axis);
  long                   base = axis * g->size, offset[8];
  int                    corners = grid_node_offsets(g, axis, offset);
  double                 gravity[3];
  sim_gravity(sim, sim->t + 0.5 * dt, gravity);
  FOR_BOX(g, faces, i)
  {
    long q = base + i;
    ice->s_fc[q] = ice->s_old_fc[q];
    ice->u_fc[q] = ice->u_reply_fc[q] = ice->s_reply_fc[q] = 0;
    bool falls = ice->advects && ice->kind[q] == FACE_VOID;
    if (!ice_face_active(ice->kind[q]) && !falls) continue;
    struct face f = {.n = ice->porosity_fc[q], .rho = ice_face_density(g, ice, axis, i), .s = ice->s_old_fc[q]};
    f.u = ice->u_old_fc[q] - dt * (ice->gradP_fc[q] / f.rho - gravity[axis]);
    if (ice->skeleton) f.K = ice->drag_fc[q];
    if (ice->moves) f.rho_s = grain_density(m, c, i, corners, offset);
    eliminate(&f, dt, &ice->u_fc[q], &ice->s_fc[q], &ice->u_reply_fc[q], &ice->s_reply_fc[q]);
    if (falls) ice->u_reply_fc[q] = ice->s_reply_fc[q] = 0;
  }
}

enum status ice_eliminate_drag(struct sim *sim, double dt)
{
  struct ice *ice = ice_of(sim);
  for (int axis = 0; axis < sim->grid.dim; axis++) eliminate_axis(sim, ice, axis, dt);
  return OK;
}
