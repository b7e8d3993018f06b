/* Absorbing sides: dashpots take the waves, and what held the body at rest goes on holding it. theory 3.9, after Lysmer
 * and Kuhlemeyer 1969 */
#include "mpm/absorb.h"

#include "constitutive/constitutive.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "mpm/stages.h"

#include <math.h>
#include <string.h>

/* Nodes of absorbing sides. */
struct absorb_state {
  long           n;
  long          *node; /* [n] */
  double        *rate; /* [n][dim] 1/s: how fast the dashpots stop that component */
  unsigned char *held; /* [n][dim] 1: a wall prescribes it, the side does nothing */
  double        *work; /* [n] J of the step, scratch */
};

bool absorb_present(const struct scene *scene)
{
  for (int side = 0; side < 2 * scene->dim; side++)
    if (scene->solid_side[side].kind == SIDE_ABSORBING) return true;
  return false;
}

/* ---- dashpots ---- */

/* Speeds of waves around the nodes, weighted with mass: fields [size] of mass, mass times c_p, mass times c_s */
struct speeds {
  double *mass, *c_p, *c_s;
};

static double bulk_density(const struct material *m) { return (1 - m->porosity) * m->density; }

static double pressure_wave(const struct material *m)
{
  return sqrt(m->model->oedometer_modulus(m->model_params) / bulk_density(m));
}

static double shear_wave(const struct material *m)
{
  return sqrt(m->model->shear_modulus(m->model_params) / bulk_density(m));
}

static void gather_speeds(const struct sim *sim, const struct mpm *m, const struct speeds *s)
{
  FOR_RUNS(m->points, &sim->grid, run, group)
  {
    const struct material *material = scene_material(sim->scene, group);
    if (material->model->held) continue;
    struct scatter_args args = {.n = 3,
                                .factor = {1, pressure_wave(material), shear_wave(material)},
                                .x = m->x_p,
                                .weight = m->mass_p,
                                .node = {s->mass, s->c_p, s->c_s}};
    m->kernels->scatter(&m->kernel_grid, &run, &args);
  }
}

/* where no material is at the start: the fastest of the scene, what may come later */
static void fastest(const struct scene *scene, double c[2])
{
  c[0] = c[1] = 0;
  for (int s = 0; s < scene->n_solids; s++) {
    const struct material *m = scene_material(scene, s);
    if (m->model->held) continue;
    c[0] = fmax(c[0], pressure_wave(m));
    c[1] = fmax(c[1], shear_wave(m));
  }
}

/* Traction -rho c v on the area A of a node of mass rho A L: its velocity decays with c/L, whatever part of the area is
 * filled. L, m: how far the room of a node on a side reaches inwards. */
static double reach(const struct sim *sim, const struct mpm *m, int side, long node)
{
  long inwards = (side % 2 ? -2 : 2) * sim->grid.stride[side / 2];
  int  basis = sim->scene->numerics.basis;
  return sim->grid.h * boundary_room(&m->kernel_grid, basis, node) /
         boundary_room(&m->kernel_grid, basis, node + inwards);
}

static void set_rates(const struct sim *sim, const struct mpm *m, const struct speeds *s)
{
  struct absorb_state *a = m->absorb;
  const struct grid   *g = &sim->grid;
  double               most[2];
  fastest(sim->scene, most);
  for (long i = 0; i < a->n; i++) {
    int    place[3];
    long   node = a->node[i];
    bool   empty = !(s->mass[node] > 0);
    double c_p = empty ? most[0] : s->c_p[node] / s->mass[node], c_s = empty ? most[1] : s->c_s[node] / s->mass[node];
    grid_place(g, node, place);
    for (int side = 0; side < 2 * g->dim; side++) {
      int axis = side / 2;
      if (sim->scene->solid_side[side].kind != SIDE_ABSORBING || place[axis] != (side % 2 ? g->n[axis] : 0)) continue;
      for (int d = 0; d < g->dim; d++) a->rate[i * g->dim + d] += (d == axis ? c_p : c_s) / reach(sim, m, side, node);
    }
  }
}

static bool on_absorbing_side(const struct sim *sim, long node)
{
  int place[3];
  grid_place(&sim->grid, node, place);
  for (int side = 0; side < 2 * sim->grid.dim; side++)
    if (sim->scene->solid_side[side].kind == SIDE_ABSORBING &&
        place[side / 2] == (side % 2 ? sim->grid.n[side / 2] : 0))
      return true;
  return false;
}

/* components that boundary_velocity writes. shelf [size][dim]: scratch */
static void mark_held(const struct sim *sim, struct absorb_state *a, double *shelf)
{
  int dim = sim->grid.dim;
  for (long i = 0; i < sim->grid.size * dim; i++) shelf[i] = INFINITY;
  boundary_velocity(&sim->grid, mpm_of(sim)->sides, 0, shelf);
  for (long i = 0; i < a->n; i++)
    for (int d = 0; d < dim; d++) a->held[i * dim + d] = shelf[a->node[i] * dim + d] < INFINITY;
}

static enum status find_nodes(const struct sim *sim, struct absorb_state *a)
{
  struct box nodes = grid_nodes(&sim->grid);
  FOR_BOX_SERIAL(&sim->grid, nodes, c) a->n += on_absorbing_side(sim, c);
  TRY(NEW(&a->node, a->n));
  TRY(NEW(&a->rate, a->n * sim->grid.dim));
  TRY(NEW(&a->held, a->n * sim->grid.dim));
  TRY(NEW(&a->work, a->n));
  a->n = 0;
  FOR_BOX_SERIAL(&sim->grid, nodes, c)
  if (on_absorbing_side(sim, c)) a->node[a->n++] = c;
  return OK;
}

enum status absorb_create(struct sim *sim, struct mpm *m)
{
  const struct grid *g = &sim->grid;
  double            *shelf;
  if (!absorb_present(sim->scene) || !m->moves) return OK;
  TRY(NEW(&m->absorb, 1));
  TRY(find_nodes(sim, m->absorb));
  TRY(NEW(&shelf, 3 * g->size));
  struct speeds s = {shelf, shelf + g->size, shelf + 2 * g->size};
  gather_speeds(sim, m, &s);
  for (int q = 0; q < 3; q++) boundary_fold(&m->kernel_grid, m->sides, 1, shelf + q * g->size);
  set_rates(sim, m, &s);
  mark_held(sim, m->absorb, shelf);
  memory_free(&shelf);
  return OK;
}

void absorb_destroy(struct mpm *m)
{
  if (!m->absorb) return;
  memory_free(&m->absorb->node);
  memory_free(&m->absorb->rate);
  memory_free(&m->absorb->held);
  memory_free(&m->absorb->work);
  memory_free(&m->absorb);
}

/* ---- what held the body at rest ---- */

void absorb_hold(struct sim *sim, struct mpm *m)
{
  int    dim = sim->grid.dim;
  double gravity[3];
  if (!m->absorb) return;
  sim_gravity(sim, 0, gravity);
  for (long i = 0; i < m->absorb->n; i++) {
    long node = m->absorb->node[i];
    for (int d = 0; d < dim; d++) {
      double held = 0;
      for (int b = 0; b < m->n_bodies; b++)
        if (m->bodies[b].mass_nc[node] > m->mass_floor)
          held -= m->bodies[b].force_nc[node * dim + d] + m->bodies[b].mass_nc[node] * gravity[d];
      m->reaction_nc[node * dim + d] = held;
    }
  }
}

/* bodies that meet there share it by their masses */
static double share(const struct mpm *m, int body, long node)
{
  double all = 0;
  for (int b = 0; b < m->n_bodies; b++) all += m->bodies[b].mass_nc[node];
  return all > m->mass_floor ? m->bodies[body].mass_nc[node] / all : 0;
}

enum status mpm_hold_sides(struct sim *sim, double dt)
{
  (void)dt;
  struct mpm *m = mpm_of(sim);
  int         dim = sim->grid.dim;
  for (long i = 0; i < m->absorb->n; i++)
    for (int b = 0; b < m->n_bodies; b++) {
      long   node = m->absorb->node[i];
      double part = share(m, b, node);
      for (int d = 0; d < dim; d++) m->bodies[b].force_nc[node * dim + d] += part * m->reaction_nc[node * dim + d];
    }
  return OK;
}

/* ---- a step ---- */

void absorb_slow(const struct sim *sim, const struct mpm *m, double dt, double *vel_nc)
{
  int dim = sim->grid.dim;
  if (!m->absorb) return;
  for (long i = 0; i < m->absorb->n; i++)
    for (int d = 0; d < dim; d++) {
      long   at = m->absorb->node[i] * dim + d;
      double k = 0.5 * dt * m->absorb->rate[i * dim + d];
      vel_nc[at] = (vel_nc[at] - k * m->vel_nc[at]) / (1 + k);
    }
}

/* f <- f - m k (v + v_new)/2, k the rate, v_new = [v (1 - dt k/2) + dt (f/m + g)]/(1 + dt k/2): stable for any dt. With
 * v_new alone in the dashpot the node would seem heavier by dt rho c A/2, which reflects. Returns the work that leaves
 * by the side: what the dashpot takes and what is done against the reaction. */
static double absorb_node(const struct sim *sim, const struct mpm *m, int body, const double gravity[3], double dt,
                          long i)
{
  const struct body_nodes *own = &m->bodies[body];
  int                      dim = sim->grid.dim;
  long                     node = m->absorb->node[i];
  double                   mass = own->mass_nc[node], part = share(m, body, node), work = 0;
  for (int d = 0; d < dim && mass > m->mass_floor; d++) {
    if (m->absorb->held[i * dim + d]) continue;
    double *force = own->force_nc + node * dim + d, k = m->absorb->rate[i * dim + d];
    double  mean = (own->vel_nc[node * dim + d] + 0.5 * dt * (*force / mass + gravity[d])) / (1 + 0.5 * dt * k);
    *force -= mass * k * mean;
    work += dt * mean * (mass * k * mean - part * m->reaction_nc[node * dim + d]);
  }
  return work;
}

enum status mpm_absorb_waves(struct sim *sim, double dt)
{
  struct mpm *m = mpm_of(sim);
  double      gravity[3];
  sim_gravity(sim, sim->t + 0.5 * dt, gravity);
  PARALLEL_FOR
  for (long i = 0; i < m->absorb->n; i++) {
    m->absorb->work[i] = 0;
    for (int b = 0; b < m->n_bodies; b++) m->absorb->work[i] += absorb_node(sim, m, b, gravity, dt, i);
  }
  for (long i = 0; i < m->absorb->n; i++) m->now.absorbed += m->absorb->work[i];
  return OK;
}
