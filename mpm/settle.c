/* The start at rest where columns do not stand by themselves (slopes, rough sides, bodies on bodies): the solid's own
 * stages are run over and over with the points put back to their places, until the nodes are in balance. Stress alone
 * changes, by the law's own update, and F of laws that know nothing else. Motion is taken out whenever kinetic energy
 * has a peak (kinetic damping, Cundall 1976). theory 2.5 */
#include "mpm/settle.h"

#include "constitutive/constitutive.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "eos/eos.h"
#include "mpm/absorb.h"
#include "mpm/at_rest.h"
#include "mpm/sides.h"
#include "mpm/stages.h"

#include <math.h>
#include <string.h>

/* an array of the state and its values at the start */
struct kept {
  double *now, *start;
  long    n; /* doubles */
};

enum { VEL, AFFINE, PLACE, DISPLACEMENT, VOLUME, MARKERS, DEFORMATION, HISTORY_OF_LAW, N_KEPT };

struct settle {
  struct sim  *sim;
  struct mpm  *m;
  struct scene scene; /* the scene as it stands still */
  struct kept  kept[N_KEPT];
  double      *lift_p;   /* [points] N along up: weight that the fluid at rest carries; NULL: dry */
  double     **lift_nc;  /* [bodies][size] the same at the nodes */
  double       up[3], g; /* m/s2 */
  double       kinetic;  /* J, of the nodes after the last step */
};

/* ---- what the solve leaves as it was ---- */

static enum status keep(double *now, long n, struct kept *k)
{
  if (!now || n == 0) return OK;
  *k = (struct kept){.now = now, .n = n};
  TRY(NEW(&k->start, n));
  memcpy(k->start, now, (size_t)n * sizeof *now);
  return OK;
}

static enum status keep_all(struct settle *s)
{
  struct mpm *m = s->m;
  long        n = m->points->n, dim = s->sim->grid.dim;
  TRY(keep(m->vel_p, n * dim, &s->kept[VEL]));
  TRY(keep(m->affine_p, n * dim * dim, &s->kept[AFFINE]));
  TRY(keep(m->x_p, n * dim, &s->kept[PLACE]));
  TRY(keep(m->displacement_p, n * dim, &s->kept[DISPLACEMENT]));
  TRY(keep(m->volume_p, n, &s->kept[VOLUME]));
  TRY(keep(m->x_m, m->n_markers * dim, &s->kept[MARKERS]));
  TRY(keep(m->F_p, n * dim * dim, &s->kept[DEFORMATION]));
  return keep(m->history_p, n * s->scene.n_history, &s->kept[HISTORY_OF_LAW]);
}

static void bring_back(const struct kept *k)
{
  if (k->now) memcpy(k->now, k->start, (size_t)k->n * sizeof *k->now);
}

/* F and history of the points whose law has its stress apart from them: no strain is kept, nothing softens or hardens
 */
static void bring_back_strain(const struct settle *s, const struct kept *k)
{
  long width = k->n / s->m->points->n;
  for (long p = 0; p < s->m->points->n && k->now; p++) {
    if (scene_material(&s->scene, s->m->points->group[p])->model->total) continue;
    memcpy(k->now + p * width, k->start + p * width, (size_t)width * sizeof *k->now);
  }
}

static void stop_points(const struct settle *s)
{
  for (int i = VEL; i <= AFFINE; i++)
    if (s->kept[i].now) memset(s->kept[i].now, 0, (size_t)s->kept[i].n * sizeof(double));
}

/* ---- the scene at rest, and the weight that it carries ---- */

/* a body on absorbing sides creeps for ever with what is out of balance, over rho c A */
static const double absorbing_tolerance = 1e-6;

/* Gravity as at t = 0, whatever it does later; walls that stand still. An absorbing side is rough where it lies across
 * gravity and smooth along it: what it gives then, it goes on giving (3.9). */
static void stand_still(const struct sim *sim, const double up[3], struct scene *scene)
{
  double gravity[3];
  sim_gravity(sim, 0, gravity);
  *scene = *sim->scene;
  for (int d = 0; d < 3; d++) {
    scene->gravity[d] = (struct function){.constant = gravity[d]};
    for (int side = 0; side < SIDES; side++) scene->solid_side[side].velocity[d] = (struct function){0};
  }
  scene->contact.detection = DETECT_APPROACH; /* places that are held make no overlap */
  if (absorb_present(scene)) scene->numerics.rest_tolerance = fmin(scene->numerics.rest_tolerance, absorbing_tolerance);
  for (int side = 0; side < SIDES; side++)
    if (scene->solid_side[side].kind == SIDE_ABSORBING)
      scene->solid_side[side].kind = fabs(up[side / 2]) > 0.5 ? SIDE_NO_SLIP : SIDE_SLIP;
  if (scene->numerics.transfer == TRANSFER_PIC) scene->numerics.transfer = TRANSFER_FLIP; /* PIC lets nothing swing */
}

/* N: buoyancy of a point in the fluid at rest */
static enum status point_lift(const struct settle *s, long p, double *lift)
{
  struct rest rest;
  double      x[3] = {0}, rho;
  for (int d = 0; d < s->scene.dim; d++) x[d] = s->m->x_p[p * s->scene.dim + d];
  *lift = 0;
  if (!shape_contains(&s->scene.fluid.region, x)) return OK;
  TRY(at_rest_column(&s->scene, x, &rest));
  s->scene.fluid.eos->density(s->scene.fluid.eos_params, 1, &rest.pressure, NULL, &rho);
  *lift = s->m->volume_solid_p[p] * rho * s->g;
  return OK;
}

static enum status gather_lift(struct settle *s)
{
  struct mpm *m = s->m;
  if (!s->scene.fluid.present) return OK;
  TRY(NEW(&s->lift_p, m->points->n));
  TRY(NEW(&s->lift_nc, m->n_bodies));
  for (int b = 0; b < m->n_bodies; b++) TRY(NEW(&s->lift_nc[b], s->sim->grid.size));
  for (long p = 0; p < m->points->n; p++) TRY(point_lift(s, p, &s->lift_p[p]));
  FOR_RUNS(m->points, &s->sim->grid, run, group)
  {
    struct scatter_args args = {
        .n = 1, .x = m->x_p, .value = {s->lift_p}, .node = {s->lift_nc[s->scene.solids[group].body]}};
    if (!scene_material(&s->scene, group)->model->held) m->kernels->scatter(&m->kernel_grid, &run, &args);
  }
  return OK;
}

/* the fluid's share of the weight, before ghosts are folded */
static void add_lift(const struct settle *s)
{
  int dim = s->sim->grid.dim;
  for (int b = 0; b < s->m->n_bodies && s->lift_nc; b++)
    for (long c = 0; c < s->sim->grid.size; c++)
      for (int d = 0; d < dim; d++) s->m->bodies[b].force_nc[c * dim + d] += s->lift_nc[b][c] * s->up[d];
}

/* ---- balance ---- */

/* J of the nodes, with their new velocities */
static double kinetic_energy(const struct settle *s)
{
  const struct grid *g = &s->sim->grid;
  struct box         nodes = grid_nodes(g);
  double             twice = 0;
  for (int b = 0; b < s->m->n_bodies; b++) FOR_BOX_SERIAL(g, nodes, c)
  for (int d = 0; d < g->dim; d++)
    twice += s->m->bodies[b].mass_nc[c] * s->m->bodies[b].vel_new_nc[c * g->dim + d] *
             s->m->bodies[b].vel_new_nc[c * g->dim + d];
  return 0.5 * twice;
}

/* rms acceleration of points that a step dt has brought from rest to their velocity, over that of their weight */
static double imbalance(const struct settle *s)
{
  const struct mpm *m = s->m;
  int               dim = s->sim->grid.dim;
  double            found = 0, whole = 0;
  for (long p = 0; p < m->points->n; p++) {
    double weight = m->mass_p[p] * s->g - (s->lift_p ? s->lift_p[p] : 0), square = 0;
    if (scene_material(&s->scene, m->points->group[p])->model->held) continue;
    for (int d = 0; d < dim; d++) square += m->vel_p[p * dim + d] * m->vel_p[p * dim + d];
    found += m->mass_p[p] * square / (s->sim->dt * s->sim->dt);
    whole += weight * weight / m->mass_p[p];
  }
  return whole > 0 ? sqrt(found / whole) : 0;
}

/* what takes part: the mechanics of the solid, without loads */
static bool takes_part(const struct stage *stage)
{
  static enum status (*const parts[])(struct sim *, double) = {
      mpm_points_to_nodes, mpm_fold_nodes,    mpm_join_bodies,     mpm_advance_nodes,
      mpm_resolve_contact, mpm_meet_walls,    mpm_join_velocities, mpm_nodes_to_points,
      mpm_move_and_strain, mpm_deform_points, mpm_update_stress};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
    if (stage->run == parts[i]) return true;
  return false;
}

static enum status run_stages(struct settle *s, enum slot from, enum slot to)
{
  for (int i = 0; i < module_mpm.n_stages; i++) {
    const struct stage *stage = &module_mpm.stages[i];
    if (stage->slot < from || stage->slot > to || !takes_part(stage)) continue;
    if (!stage->needed || stage->needed(s->sim->scene)) TRY(stage->run(s->sim, s->sim->dt));
  }
  return OK;
}

/* s. Points on their lattice: those at the edge of a body reach a node of the linear basis with 1/(2 n) of their mass,
 * n points per axis, and it answers with (grad w)^2/w = 2 n/h2, n times that of the splines. In a run the points pass
 * by.
 */
static double step_length(const struct settle *s)
{
  const struct numerics *n = &s->scene.numerics;
  int                    most = 1;
  for (int d = 0; d < s->scene.dim && n->basis == BASIS_LINEAR; d++)
    if (n->points_per_axis[d] > most) most = n->points_per_axis[d];
  return mpm_stress_dt(s->sim) / sqrt(most);
}

/* velocities that the nodes would have after a step; gates that open at t = 0 are still there */
static enum status advance(struct settle *s)
{
  struct sim *sim = s->sim;
  sim->dt = step_length(s);
  sim->dt_limit = sim->dt / s->scene.numerics.dt_factor;
  sim->t = -2 * sim->dt;
  TRY(run_stages(s, SLOT_points_to_nodes, SLOT_points_to_nodes));
  add_lift(s);
  TRY(run_stages(s, SLOT_fold, SLOT_nodes));
  s->kinetic = kinetic_energy(s);
  return OK;
}

/* points take velocities and stresses, and stay */
static enum status respond(struct settle *s)
{
  TRY(run_stages(s, SLOT_nodes_to_points, SLOT_stress));
  for (int i = PLACE; i <= MARKERS; i++) bring_back(&s->kept[i]);
  for (int i = DEFORMATION; i <= HISTORY_OF_LAW; i++) bring_back_strain(s, &s->kept[i]);
  return OK;
}

/* s without a peak after which nothing is held: five periods of a bar as long as the grid, of the softest soil */
static double patience(const struct settle *s)
{
  double slowest = INFINITY, length = 0;
  for (int i = 0; i < s->scene.n_solids; i++) {
    const struct material *m = scene_material(&s->scene, i);
    if (m->model->held) continue;
    slowest = fmin(slowest, m->model->oedometer_modulus(m->model_params) / (m->density * (1 - m->porosity)));
  }
  for (int d = 0; d < s->scene.dim; d++) length = fmax(length, s->scene.cells[d] * s->scene.h);
  return 20 * length / sqrt(slowest);
}

/* the balance of the stresses as they are, from rest */
static enum status judge(struct settle *s)
{
  struct mpm_rest *rest = &s->m->rest;
  stop_points(s);
  TRY(advance(s));
  TRY(mpm_nodes_to_points(s->sim, s->sim->dt)); /* not strained */
  rest->unbalanced = imbalance(s);
  rest->settled = rest->unbalanced <= s->scene.numerics.rest_tolerance;
  stop_points(s);
  for (int i = PLACE; i <= MARKERS; i++) bring_back(&s->kept[i]);
  return OK;
}

static enum status relax(struct settle *s)
{
  struct mpm_rest *rest = &s->m->rest;
  double           waited = 0, last = 0;
  for (rest->steps = 0; rest->steps < s->scene.numerics.rest_steps && waited < patience(s); rest->steps++) {
    TRY(respond(s));
    TRY(advance(s));
    waited += s->sim->dt;
    if (s->kinetic < last) { /* past a peak */
      TRY(judge(s));
      if (rest->settled) return OK;
      waited = 0;
    }
    last = s->kinetic;
  }
  return judge(s);
}

static enum status solve(struct settle *s)
{
  struct mpm_rest *rest = &s->m->rest;
  TRY(keep_all(s));
  TRY(gather_lift(s));
  s->sim->scene = &s->scene;
  sides_of_solid(&s->scene, s->m->sides);
  TRY(judge(s));
  rest->computed = true;
  rest->column = rest->unbalanced;
  return rest->settled || s->scene.numerics.rest_steps == 0 ? OK : relax(s);
}

static void destroy(struct settle *s)
{
  for (int i = 0; i < N_KEPT; i++) memory_free(&s->kept[i].start);
  for (int b = 0; b < s->m->n_bodies && s->lift_nc; b++) memory_free(&s->lift_nc[b]);
  memory_free(&s->lift_nc);
  memory_free(&s->lift_p);
}

enum status mpm_settle(struct sim *sim, struct mpm *m)
{
  const struct scene *scene = sim->scene;
  struct settle       s = {.sim = sim, .m = m};
  const double        dt = sim->dt, dt_limit = sim->dt_limit, t = sim->t;
  at_rest_up(scene, s.up, &s.g);
  if (scene->start != START_AT_REST || scene->start_from[0] || s.g == 0 || !m->moves) return OK;
  stand_still(sim, s.up, &s.scene);
  enum status status = solve(&s);
  sim->scene = scene;
  sides_of_solid(scene, m->sides);
  absorb_hold(sim, m);
  sim->dt = dt;
  sim->dt_limit = dt_limit;
  sim->t = t;
  for (int i = VEL; i <= AFFINE; i++) bring_back(&s.kept[i]);
  m->now = (struct mpm_numbers){0}; /* nothing was done yet, and nothing lost */
  destroy(&s);
  return status;
}
