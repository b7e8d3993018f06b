/* Sides of the grid as rigid walls: the impulse that they give the solid, and Coulomb friction along them. theory 3.2
 */
#include "mpm/sides.h"

#include "core/memory.h"
#include "core/parallel.h"
#include "mpm/stages.h"

#include <math.h>
#include <string.h>

/* Sums of every body before they were folded: what fell on the ghosts of watched sides. */
struct sides_state {
  bool               side[SIDES];
  struct body_nodes *ghosts; /* [bodies] mass_nc, mom_nc, force_nc */
};

void sides_of_solid(const struct scene *scene, struct side_condition sides[SIDES])
{
  for (int side = 0; side < SIDES; side++) {
    sides[side] = scene->solid_side[side];
    if (sides[side].rubs && !scene->fluid.present) sides[side].kind = SIDE_OPEN;
  }
}

static bool watched(const struct scene *scene, int side)
{
  static const char *const     names[SIDES] = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};
  const struct side_condition *s = &scene->solid_side[side];
  bool                         seen = s->kind == SIDE_VELOCITY;
  if (s->kind == SIDE_OPEN || s->kind == SIDE_PERIODIC || s->kind == SIDE_ABSORBING) return false;
  if (s->rubs && !scene->fluid.present) return false;
  for (int i = 0; i < scene->n_gauges; i++)
    seen = seen || (scene->gauges[i].kind == GAUGE_WALL && strcmp(scene->gauges[i].on, names[side]) == 0);
  return seen;
}

bool sides_watched(const struct scene *scene)
{
  for (int side = 0; side < 2 * scene->dim; side++)
    if (watched(scene, side)) return true;
  return false;
}

enum status sides_create(struct sim *sim, struct mpm *m)
{
  long size = sim->grid.size, n = size * sim->grid.dim;
  if (!sides_watched(sim->scene)) return OK;
  TRY(NEW(&m->watched, 1));
  for (int side = 0; side < 2 * sim->grid.dim; side++) m->watched->side[side] = watched(sim->scene, side);
  TRY(NEW(&m->watched->ghosts, m->n_bodies));
  for (int b = 0; b < m->n_bodies; b++) {
    TRY(NEW(&m->watched->ghosts[b].mass_nc, size));
    TRY(NEW(&m->watched->ghosts[b].mom_nc, n));
    TRY(NEW(&m->watched->ghosts[b].force_nc, n));
  }
  return OK;
}

void sides_destroy(struct mpm *m)
{
  for (int b = 0; m->watched && m->watched->ghosts && b < m->n_bodies; b++) {
    memory_free(&m->watched->ghosts[b].mass_nc);
    memory_free(&m->watched->ghosts[b].mom_nc);
    memory_free(&m->watched->ghosts[b].force_nc);
  }
  if (m->watched) memory_free(&m->watched->ghosts);
  memory_free(&m->watched);
}

/* ---- ghosts ---- */

/* a plane of nodes beyond a side (out = 1) or on it (0): all entries of the other axes */
static struct box side_plane(const struct grid *g, int side, int out)
{
  struct box b = grid_all(g);
  int        d = side / 2;
  b.lo[d] = side % 2 ? g->n[d] + out : -out;
  b.hi[d] = b.lo[d] + 1;
  return b;
}

/* sums of a step before they are folded; loads come on top of forces */
static void keep(const struct grid *g, const struct body_nodes *sums, enum fold what, const struct body_nodes *ghosts)
{
  size_t size = (size_t)g->size, n = size * (size_t)g->dim;
  for (size_t i = 0; i < n && what == FOLD_LOADS; i++) ghosts->force_nc[i] += sums->force_nc[i];
  if (what != FOLD_STEP) return;
  memcpy(ghosts->mass_nc, sums->mass_nc, size * sizeof(double));
  memcpy(ghosts->mom_nc, sums->mom_nc, n * sizeof(double));
  memcpy(ghosts->force_nc, sums->force_nc, n * sizeof(double));
}

static bool holds(const struct side_condition *s, int axis, int d)
{
  if (s->kind == SIDE_OPEN || s->kind == SIDE_PERIODIC || s->kind == SIDE_ABSORBING) return false;
  return d == axis || s->kind == SIDE_NO_SLIP || (s->kind == SIDE_VELOCITY && !s->rubs);
}

/* on a side that moves with w the ghosts' momentum p becomes p - 2 w m, so that folding leaves 2 w m - p */
static void shift_momenta(const struct grid *g, const struct side_condition *s, int side, double t,
                          const struct body_nodes *own)
{
  struct box ghosts = side_plane(g, side, 1);
  if (s->kind != SIDE_VELOCITY) return;
  FOR_BOX_SERIAL(g, ghosts, c)
  {
    double x[3], w[3];
    grid_node(g, c, x);
    boundary_speed(s, x, t, w);
    for (int d = 0; d < g->dim; d++)
      if (holds(s, side / 2, d)) own->mom_nc[c * g->dim + d] -= 2 * w[d] * own->mass_nc[c];
  }
}

static void fold_side(const struct mpm *m, int side, const struct body_nodes *sums)
{
  int dim = m->kernel_grid.g.dim;
  if (sums->mass_nc) boundary_fold_side(&m->kernel_grid, m->sides, side, 1, sums->mass_nc);
  if (sums->mom_nc) boundary_fold_side(&m->kernel_grid, m->sides, side, dim, sums->mom_nc);
  if (sums->force_nc) boundary_fold_side(&m->kernel_grid, m->sides, side, dim, sums->force_nc);
}

void sides_fold(const struct sim *sim, struct mpm *m, int body, enum fold what, double t)
{
  const struct grid *g = &sim->grid;
  struct body_nodes  sums = m->bodies[body];
  if (m->watched) keep(g, &sums, what, &m->watched->ghosts[body]);
  if (what == FOLD_LOADS) sums.mass_nc = sums.mom_nc = NULL;
  if (what == FOLD_REMAP) sums.force_nc = NULL;
  for (int side = 0; side < 2 * g->dim; side++) {
    if (sums.mom_nc && m->sides[side].kind == SIDE_VELOCITY) shift_momenta(g, &m->sides[side], side, t, &sums);
    fold_side(m, side, &sums);
  }
}

/* ---- impulses ---- */

/* One component of a side's account, and a place on the side. */
struct account {
  const struct body_nodes *own, *ghosts;
  int                      side, d;
  double                   gravity, blend; /* m/s2; share of nodal velocities in the points' update */
  double                   before, after;  /* m/s, of the side at both ends of the step */
};

/* Whether another side holds the component too: on it (beyond = 0), only the last of all sides has its way; or beyond
 * it, where the ghost's ghost has the sign of the node again and nobody holds it. */
static bool held_elsewhere(const struct grid *g, const struct mpm *m, long node, const struct account *a, int beyond)
{
  int place[3];
  grid_place(g, node, place);
  for (int other = 0; other < 2 * g->dim; other++) {
    int e = other / 2, there = other % 2 ? g->n[e] + beyond : -beyond;
    if (e == a->side / 2 || place[e] != there || !holds(&m->sides[other], e, a->d)) continue;
    if (beyond || other > a->side) return true;
  }
  return false;
}

static void set_speeds(const struct sim *sim, const struct mpm *m, long node, struct account *a)
{
  double x[3], before[3], after[3];
  grid_node(&sim->grid, node, x);
  boundary_speed(&m->sides[a->side], x, sim->t, before);
  boundary_speed(&m->sides[a->side], x, sim->t + sim->dt, after);
  a->before = before[a->d];
  a->after = after[a->d];
}

/* m0 dw - dt (f0 + m0 g) + blend (m0 w - p0) */
static double node_impulse(const struct sim *sim, const struct account *a, long c)
{
  double mass = a->own->mass_nc[c], force = a->own->force_nc[c * sim->grid.dim + a->d] + mass * a->gravity;
  double taken = mass * a->before - a->own->mom_nc[c * sim->grid.dim + a->d];
  return mass * (a->after - a->before) - sim->dt * force + a->blend * taken;
}

/* 2 [m1 (dw - dV) - dt f1 + blend (m1 w - p1 + m1 (w - V))], V of the image */
static double ghost_impulse(const struct sim *sim, const struct account *a, long ghost, long image)
{
  long   at = ghost * sim->grid.dim + a->d, inside = image * sim->grid.dim + a->d;
  double mass = a->ghosts->mass_nc[ghost], V = a->own->vel_nc[inside], dV = a->own->vel_new_nc[inside] - V;
  double taken = mass * a->before - a->ghosts->mom_nc[at] + mass * (a->before - V);
  return 2 * (mass * (a->after - a->before - dV) - sim->dt * a->ghosts->force_nc[at] + a->blend * taken);
}

/* What a side gave a body along an axis that it holds, N s: what the momentum of the points changes by beyond forces
 * and weight. Adds its work. */
static double watch_component(const struct sim *sim, struct mpm *m, struct account *a)
{
  const struct grid *g = &sim->grid;
  struct box         plane = side_plane(g, a->side, 0), nodes = boundary_nodes(g, m->sides);
  long               out = (a->side % 2 ? 1 : -1) * g->stride[a->side / 2];
  double             total = 0;
  FOR_BOX_SERIAL(g, plane, c)
  {
    int    place[3];
    double impulse = 0;
    bool   inside = true;
    grid_place(g, c, place);
    for (int d = 0; d < g->dim; d++)
      inside = inside && (d == a->side / 2 || (place[d] >= nodes.lo[d] && place[d] < nodes.hi[d]));
    set_speeds(sim, m, c, a);
    if (inside && !held_elsewhere(g, m, c, a, 0)) impulse += node_impulse(sim, a, c);
    if (a->ghosts->mass_nc[c + out] > 0 && !m->kernel_grid.modified[a->side] && !held_elsewhere(g, m, c + out, a, 1))
      impulse += ghost_impulse(sim, a, c + out, c - out);
    total += impulse;
    m->now.work_walls += impulse * 0.5 * (a->before + a->after);
  }
  return total;
}

enum status mpm_watch_sides(struct sim *sim, double dt)
{
  struct mpm *m = mpm_of(sim);
  double      gravity[3];
  sim_gravity(sim, sim->t + 0.5 * dt, gravity);
  for (int side = 0; side < 2 * sim->grid.dim; side++)
    for (int d = 0; d < sim->grid.dim && m->watched->side[side]; d++) {
      double total = 0;
      for (int b = 0; b < m->n_bodies && holds(&m->sides[side], side / 2, d); b++) {
        struct account a = {.own = &m->bodies[b], .ghosts = &m->watched->ghosts[b], .side = side, .d = d};
        a.gravity = gravity[d];
        a.blend = mpm_blend(sim, dt);
        total += watch_component(sim, m, &a);
      }
      m->now.wall[side].force[d] = total / dt;
      m->now.wall[side].impulse[d] += total;
    }
  return OK;
}
