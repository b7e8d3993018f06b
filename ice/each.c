/* Several fluids with velocities of their own: at faces they exchange momentum with one another and with the skeleton
 * without a limit of the step. theory 4.17 */
#include "ice/each.h"

#include "core/parallel.h"
#include "coupling/coupling.h"
#include "mpm/mpm.h"

#include <math.h>

/* a fluid with less than this share of both cells of a face does not limit the step */
static const double least_share = 0.01;

double each_lower(const struct grid *g, const struct ice *ice, int k, int axis, long c)
{
  double share = ice->alpha_cc[c], lower = ice->cut_fc[axis * g->size + c];
  if (k == 0) return share > 1e-12 ? lower / share : 0.5;
  return 1 - share > 1e-12 ? (0.5 - lower) / (1 - share) : 0.5;
}

/* a fluid with less than this share of a face is bound to the one that has most of it, by so much of the mass there */
static const double trace = 1e-8, bound = 1e6;
/* a surface that faces along an axis by more than this is passed by neither fluid */
static const double across = 0.25;

/* what the two halves of cells at a face have of a fluid */
struct content {
  double mass, volume, velocity; /* kg per pore volume; share of it; m/s */
};

static struct content content_of(const struct grid *g, const struct ice *ice, int k, int axis, long f)
{
  struct content all = {0, 0, 0};
  long           low = f - g->stride[axis];
  bool           l = ice->wet_cc[low] > 0, h = ice->wet_cc[f] > 0;
  double         momentum = 0, weight = 0, V = grid_cell_volume(g);
  for (int high = 0; high < 2; high++) {
    long   c = high ? f : low, own = k * g->size + c;
    double lower = each_lower(g, ice, k, axis, c), share = l && h ? (high ? lower : 1 - lower) : 1;
    if (!(high ? h : l)) continue;
    double mass = share * ice->mass_cc[own] / V;
    momentum += mass * ice->each_cc[own * g->dim + axis];
    weight += mass;
    all.mass += mass / ice->porosity_cc[c];
    all.volume += share * ice->alpha_cc[own];
  }
  all.velocity = weight > 0 ? momentum / weight : ice_mean_velocity_of(g, ice, axis, f);
  return all;
}

/* ---- predictor ---- */

/* viscosity moves the mean of the fluids of a cell: all go with it */
void each_follow_mean(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX(g, cells, c)
  for (int d = 0; d < g->dim; d++) {
    double momentum = 0, mass = ice_cell_mass(g, ice, c);
    for (int k = 0; k < ice->n_fluids; k++)
      momentum += ice->mass_cc[k * g->size + c] * ice->each_cc[(k * g->size + c) * g->dim + d];
    double change = ice->vel_cc[c * g->dim + d] - momentum / mass;
    for (int k = 0; k < ice->n_fluids; k++) ice->each_cc[(k * g->size + c) * g->dim + d] += change;
  }
  for (int k = 0; k < ice->n_fluids; k++) grid_fill_periodic(g, g->dim, ice->each_cc + k * g->size * g->dim);
}

/* what u_old of the face has beyond the mean of its cells, memory and forecast, all fluids have */
enum status ice_predict_each(struct sim *sim, double dt)
{
  (void)dt;
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  long               copy = g->dim * g->size;
  each_follow_mean(sim, ice);
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    FOR_BOX(g, faces, f)
    {
      long   q = axis * g->size + f;
      bool   active = ice_face_active(ice->kind[q]);
      double more = active ? ice->u_old_fc[q] - ice_mean_velocity_of(g, ice, axis, f) : 0;
      for (int k = 0; k < ice->n_fluids; k++)
        ice->each_old_fc[k * copy + q] = active ? content_of(g, ice, k, axis, f).velocity + more : 0;
    }
  }
  return OK;
}

/* ---- elimination ---- */

enum { MOST_PHASES = MAX_FLUIDS + 1 };

/* Momenta of the phases of a face. The matrix is own masses in the diagonal and K between each two; its diagonal is
 * never formed, so that nothing cancels however large K is. */
struct system {
  int    n;
  double own[MOST_PHASES], K[MOST_PHASES][MOST_PHASES], u[MOST_PHASES], r[MOST_PHASES];
};

/* the diagonal of phase i among the phases before it */
static double diagonal(const struct system *s, int i)
{
  double sum = s->own[i];
  for (int j = 0; j < i; j++) sum += s->K[i][j];
  return sum;
}

/* Elimination from the last phase on: it hands its mass and its right-hand sides to the others by its K */
static void solve(struct system *s)
{
  for (int i = s->n - 1; i > 0; i--) {
    double d = diagonal(s, i);
    for (int j = 0; j < i; j++) {
      double share = s->K[i][j] / d;
      for (int k = 0; k < i; k++) s->K[j][k] += share * s->K[i][k];
      s->own[j] += share * s->own[i];
      s->u[j] += share * s->u[i];
      s->r[j] += share * s->r[i];
    }
  }
  for (int i = 0; i < s->n; i++) {
    for (int j = 0; j < i; j++) {
      s->u[i] += s->K[i][j] * s->u[j];
      s->r[i] += s->K[i][j] * s->r[j];
    }
    double d = diagonal(s, i);
    s->u[i] /= d;
    s->r[i] /= d;
  }
}

/* two phases exchange K per volume and velocity */
static void join(struct system *s, int i, int j, double K) { s->K[i][j] = s->K[j][i] = K; }

/* a face: contents of its fluids, porosity, grains, gravity along its axis */
struct meeting {
  struct content fluid[MAX_FLUIDS];
  double         rho, n, rho_s, gravity;
};

/* Fluids that lie in layers, in one cell or in two, are pushed together, by the weight of both: each of them is in
 * balance in its own layer. Where they are mixed each feels the pressure by its own volume. */
static double push_of(const struct ice *ice, const struct meeting *m, int k, long low, long high)
{
  bool pure = ice_only_fluid(ice, low) >= 0 && ice_only_fluid(ice, high) >= 0;
  bool layered = pure || ice_is_cut(ice, low) || ice_is_cut(ice, high);
  return layered || m->fluid[k].volume < trace ? 1 / m->rho : m->fluid[k].volume / m->fluid[k].mass;
}

/* How far the surface of a cell faces along an axis, 0 to 1: what its two halves have of the first fluid differs by */
static double facing(const struct grid *g, const struct ice *ice, int axis, long c)
{
  double share = ice->alpha_cc[c];
  if (!ice_is_cut(ice, c)) return 0;
  return fabs(2 * ice->cut_fc[axis * g->size + c] - share) / fmin(share, 1 - share);
}

/* Whether a surface lies across the way of a face: neither fluid passes it, so they go as fast. Along it they slip. */
static bool is_shut(const struct grid *g, const struct ice *ice, int axis, long f)
{
  long low = f - g->stride[axis];
  int  below = ice_only_fluid(ice, low), above = ice_only_fluid(ice, f);
  if (below >= 0 && above >= 0) return below != above;
  return fmax(facing(g, ice, axis, low), facing(g, ice, axis, f)) > across;
}

static void fill_system(const struct sim *sim, const struct ice *ice, const struct meeting *m, int axis, long f,
                        double dt, struct system *s)
{
  const struct grid *g = &sim->grid;
  long               q = axis * g->size + f, copy = g->dim * g->size;
  int                solid = ice->n_fluids;
  double             phi = 1 - m->n, own = phi > 0 ? phi * m->rho_s : 0, X = sim->scene->fluid.exchange;
  bool               moves = own > 0;
  int                most = 0;
  bool               shut = is_shut(g, ice, axis, f);
  for (int k = 1; k < solid; k++) most = m->fluid[k].volume > m->fluid[most].volume ? k : most;
  *s = (struct system){.n = solid + moves};
  if (moves) {
    s->own[solid] = own;
    s->u[solid] = own * ice->s_old_fc[q];
    s->r[solid] = phi;
  }
  for (int k = 0; k < solid; k++) {
    double mass = m->n * m->fluid[k].mass, push = push_of(ice, m, k, f - g->stride[axis], f);
    double K = ice->skeleton ? dt * ice->drag_fc[k * copy + q] : 0;
    bool   is_trace = m->fluid[k].volume < trace;
    s->own[k] = mass;
    s->u[k] = mass * (ice->each_old_fc[k * copy + q] + dt * (m->gravity - ice->gradP_fc[q] * push));
    s->r[k] = mass * push;
    if (is_trace) join(s, k, most, bound * m->n * m->rho);
    for (int j = 0; j < k && !is_trace; j++)
      if (m->fluid[j].volume >= trace) join(s, j, k, shut ? bound * m->n * m->rho : dt * m->n * X);
    if (is_trace) continue;
    if (moves)
      join(s, k, solid, K);
    else {
      s->own[k] += K;
      s->u[k] += K * ice->s_old_fc[q];
    }
  }
}

static void eliminate_face(const struct sim *sim, struct ice *ice, const struct meeting *m, int axis, long f, double dt)
{
  long          q = axis * sim->grid.size + f, copy = sim->grid.dim * sim->grid.size;
  struct system s;
  fill_system(sim, ice, m, axis, f, dt, &s);
  solve(&s);
  for (int k = 0; k < ice->n_fluids; k++) {
    ice->each_fc[k * copy + q] = s.u[k];
    ice->each_reply_fc[k * copy + q] = s.r[k];
    ice->u_fc[q] += m->fluid[k].volume * s.u[k];
    ice->u_reply_fc[q] += m->fluid[k].volume * s.r[k];
  }
  if (s.n == ice->n_fluids) return;
  ice->s_fc[q] = s.u[ice->n_fluids];
  ice->s_reply_fc[q] = s.r[ice->n_fluids];
}

static void eliminate_axis(struct sim *sim, struct ice *ice, int axis, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         faces = grid_faces(g, axis);
  double             gravity[3];
  sim_gravity(sim, sim->t + 0.5 * dt, gravity);
  FOR_BOX(g, faces, f)
  {
    long           q = axis * g->size + f;
    struct meeting m = {.n = ice->porosity_fc[q], .gravity = gravity[axis]};
    ice->s_fc[q] = ice->s_old_fc[q];
    ice->u_fc[q] = ice->u_reply_fc[q] = ice->s_reply_fc[q] = 0;
    for (int k = 0; k < ice->n_fluids; k++)
      ice->each_fc[k * g->dim * g->size + q] = ice->each_reply_fc[k * g->dim * g->size + q] = 0;
    if (!ice_face_active(ice->kind[q])) continue;
    for (int k = 0; k < ice->n_fluids; k++) {
      m.fluid[k] = content_of(g, ice, k, axis, f);
      m.rho += m.fluid[k].mass;
    }
    if (ice->moves) m.rho_s = ice_grain_density(sim, axis, f);
    eliminate_face(sim, ice, &m, axis, f, dt);
  }
}

enum status ice_eliminate_each(struct sim *sim, double dt)
{
  struct ice *ice = ice_of(sim);
  for (int axis = 0; axis < sim->grid.dim; axis++) eliminate_axis(sim, ice, axis, dt);
  return OK;
}

/* ---- after the pressure ---- */

enum status ice_correct_each(struct sim *sim, double dt)
{
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  long               copy = g->dim * g->size;
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    FOR_BOX(g, faces, f)
    {
      long q = axis * g->size + f;
      bool holds = fmax(ice->alpha_cc[f], ice->alpha_cc[f - g->stride[axis]]) > 0;
      ice->first_fc[q] = ice->carried_fc[q];
      if (!ice_face_active(ice->kind[q])) continue;
      double push = sim->scene->numerics.theta * dt * ice_face_gradient(sim, ice, ice->dP_cc, axis, f);
      for (int k = 0; k < ice->n_fluids; k++) ice->each_fc[k * copy + q] -= ice->each_reply_fc[k * copy + q] * push;
      if (holds) ice->first_fc[q] = ice->open_fc[q] * ice->porosity_fc[q] * ice->each_fc[q];
    }
  }
  return OK;
}

static double fastest(const struct sim *sim, const struct ice *ice, int axis, long f)
{
  const struct grid *g = &sim->grid;
  double             most = 0;
  for (int k = 0; k < ice->n_fluids; k++) {
    const double *alpha = ice->alpha_cc + k * g->size;
    double        u = ice->each_fc[(k * g->dim + axis) * g->size + f];
    if (fmax(alpha[f], alpha[f - g->stride[axis]]) > least_share) most = fmax(most, fabs(u));
  }
  return most;
}

void each_move(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  int                dim = g->dim;
  long               copy = dim * g->size;
  FOR_BOX(g, cells, c)
  for (int d = 0; d < dim; d++) {
    long   q = d * g->size + c, up = q + g->stride[d];
    double momentum = 0;
    for (int k = 0; k < ice->n_fluids; k++) {
      double lower = each_lower(g, ice, k, d, c), *vel = &ice->each_cc[(k * g->size + c) * dim + d];
      *vel += lower * (ice->each_fc[k * copy + q] - ice->each_old_fc[k * copy + q]) +
              (1 - lower) * (ice->each_fc[k * copy + up] - ice->each_old_fc[k * copy + up]);
      momentum += ice->mass_cc[k * g->size + c] * *vel;
    }
    ice->vel_cc[c * dim + d] = momentum / ice_cell_mass(g, ice, c);
  }
  for (int d = 0; d < dim; d++)
    FOR_BOX_SERIAL(g, cells, c) ice->now.speed = fmax(ice->now.speed, fastest(sim, ice, d, c));
}
