/* The solid meets rigid walls: its surface may not move into them, and slides along them with Coulomb friction.
 * theory 3.11 */
#include "mpm/stages.h"
#include "mpm/walls.h"

#include "constitutive/constitutive.h"
#include "core/parallel.h"

#include <math.h>
#include <string.h>

/* corrections of all pressures in a step */
enum { SWEEPS = 5 };

/* One wall and one body. */
struct sweep {
  int           dim, wall, body;
  const double *vel_old_nc; /* [size][dim] m/s, of the body at the start of the step */
  double       *vel_nc;     /* at its end, changed */
  double        moves[3];   /* m/s, the wall */
  double        moved[3];   /* m/s, in the step before */
  double        friction;   /* Coulomb coefficient */
  double        impulse[3]; /* N s on the solid, added to */
  double        lost;       /* J to friction, added to */
};

/* every touch, every pressure of a wall and a body */
#define FOR_TOUCHES(s, w, i)                                                                                           \
  for (long i = (s)->of[(w)->body].touch[(w)->wall]; i < (s)->of[(w)->body].touch[(w)->wall + 1]; i++)
#define FOR_PRESSURES(s, w, k)                                                                                         \
  for (long k = (s)->of[(w)->body].pressure[(w)->wall]; k < (s)->of[(w)->body].pressure[(w)->wall + 1]; k++)

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* area times velocity of the body's surface into the wall, beyond what closes the gap, and along it */
static void weigh_velocities(struct walls_state *s, const struct sweep *w)
{
  FOR_PRESSURES(s, w, k)
  {
    s->pressures[k].excess = 0;
    memset(s->pressures[k].slide, 0, sizeof s->pressures[k].slide);
  }
  FOR_TOUCHES(s, w, i)
  {
    const struct touch *t = &s->touches[i];
    double              u[3] = {0}, out;
    for (int d = 0; d < w->dim; d++) u[d] = w->vel_nc[t->node * w->dim + d] - w->moves[d];
    out = dot(u, t->normal);
    for (int k = 0; k < 1 << w->dim; k++) {
      struct pressure *p = &s->pressures[t->pressure[k]];
      p->excess -= t->share[k] * t->area * (out + t->closing);
      for (int d = 0; d < 3; d++) p->slide[d] += t->share[k] * t->area * (u[d] - out * t->normal[d]);
    }
  }
}

/* presses only; friction stops what slides, at most with its share of the pressure */
static void correct_pressure(struct pressure *p, double friction)
{
  double normal, along[3], length, limit;
  p->change = 0;
  memset(p->change_along, 0, sizeof p->change_along);
  if (!(p->ease > 0)) return;
  normal = fmax(0, p->normal + p->excess / p->ease);
  for (int d = 0; d < 3; d++) along[d] = p->along[d] - p->slide[d] / p->ease;
  length = sqrt(dot(along, along));
  limit = normal > 0 ? friction * normal : 0;
  for (int d = 0; d < 3; d++) {
    if (length > limit) along[d] *= limit / length;
    p->change_along[d] = along[d] - p->along[d];
    p->along[d] = along[d];
  }
  p->change = normal - p->normal;
  p->normal = normal;
}

/* impulse per area that the pressures around a touch give it: along the normal, and along the surface */
static double gather(const struct walls_state *s, const struct touch *t, int dim, bool change, double rub[3])
{
  double press = 0, out;
  rub[0] = rub[1] = rub[2] = 0;
  for (int k = 0; k < 1 << dim; k++) {
    const struct pressure *p = &s->pressures[t->pressure[k]];
    press += t->share[k] * (change ? p->change : p->normal);
    for (int d = 0; d < dim; d++) rub[d] += t->share[k] * (change ? p->change_along[d] : p->along[d]);
  }
  out = dot(rub, t->normal);
  for (int d = 0; d < dim; d++) rub[d] -= out * t->normal[d];
  return press;
}

/* the changes of the pressures act on the nodes */
static void push_nodes(const struct walls_state *s, const struct sweep *w)
{
  FOR_TOUCHES(s, w, i)
  {
    const struct touch *t = &s->touches[i];
    double              rub[3], press = gather(s, t, w->dim, true, rub);
    for (int d = 0; d < w->dim; d++)
      w->vel_nc[t->node * w->dim + d] += t->ease[d] * t->area * (press * t->normal[d] + rub[d]);
  }
}

/* What all sweeps together gave the body. Friction works on the mean of the slips at both ends of the step: with the
 * slip after the other forces, what sticks would seem to lose (dt f)^2/2m in every step. */
static void sum_up(const struct walls_state *s, struct sweep *w)
{
  FOR_TOUCHES(s, w, i)
  {
    const struct touch *t = &s->touches[i];
    double              rub[3], press = gather(s, t, w->dim, false, rub);
    for (int d = 0; d < w->dim; d++) {
      long at = t->node * w->dim + d;
      if (t->ease[d] == 0) continue;
      w->impulse[d] += t->area * (press * t->normal[d] + rub[d]);
      w->lost -= t->area * rub[d] * 0.5 * (w->vel_old_nc[at] - w->moved[d] + w->vel_nc[at] - w->moves[d]);
    }
  }
}

/* pressures and velocities of one body are corrected in turns */
static void sweep_all(struct walls_state *s, struct sweep *sweeps)
{
  for (int n = 0; n < SWEEPS; n++)
    for (int i = 0; i < s->n_walls; i++) {
      weigh_velocities(s, &sweeps[i]);
      FOR_PRESSURES(s, &sweeps[i], k) correct_pressure(&s->pressures[k], sweeps[i].friction);
      push_nodes(s, &sweeps[i]);
    }
}

/* vel_nc: where a body's velocities at the end of the step stand */
static void prepare(const struct sim *sim, const struct mpm *m, int body, double *vel_nc, struct sweep *sweeps)
{
  for (int i = 0; i < m->walls->n_walls; i++) {
    const struct wall *wall = &m->walls->wall[i];
    sweeps[i] = (struct sweep){.dim = sim->grid.dim, .wall = i, .body = body, .friction = wall->body.friction};
    sweeps[i].vel_old_nc = m->bodies[body].vel_nc;
    sweeps[i].vel_nc = vel_nc;
    memcpy(sweeps[i].moved, m->now.wall[wall->account].velocity, sizeof sweeps[i].moved);
    wall_velocity(&wall->body, sim->t + 0.5 * sim->dt, sweeps[i].moves);
  }
}

void walls_meet_again(const struct sim *sim, struct mpm *m, int body)
{
  struct sweep sweeps[MAX_WALLS];
  prepare(sim, m, body, m->bodies[body].vel_new_nc, sweeps);
  sweep_all(m->walls, sweeps);
}

enum status walls_meet_predicted(struct sim *sim, struct mpm *m, double *vel_nc)
{
  struct sweep sweeps[MAX_WALLS];
  if (!m->walls || m->n_bodies > 1) return OK;
  TRY(touches_find(sim, m));
  prepare(sim, m, 0, vel_nc, sweeps);
  sweep_all(m->walls, sweeps);
  return OK;
}

/* what walls did to a body goes to their accounts */
static void book(struct mpm *m, const struct sweep *w, double dt)
{
  struct wall_numbers *wall = &m->now.wall[m->walls->wall[w->wall].account];
  for (int d = 0; d < 3; d++) {
    wall->force[d] += w->impulse[d] / dt;
    wall->impulse[d] += w->impulse[d];
    m->now.work_walls += w->impulse[d] * 0.5 * (w->moved[d] + w->moves[d]);
  }
  m->now.friction += w->lost;
}

static void move_wall(const struct sim *sim, struct mpm *m, int i)
{
  const struct wall   *wall = &m->walls->wall[i];
  struct wall_numbers *now = &m->now.wall[wall->account];
  wall_velocity(&wall->body, sim->t + 0.5 * sim->dt, now->velocity);
  for (int d = 0; d < 3; d++) now->displacement[d] += sim->dt * now->velocity[d];
}

/* Points go where their nodes' velocities lead, which vanish into the wall on the mean over its surface only: what
 * crept in by a hair is put back on the surface and stopped there as a grain is, with Coulomb friction. A grain that
 * lies alone needs that, as it has no surface that its nodes know well. Returns how deep it was, m. */
static double expel_point(const struct mpm *m, long p, struct sweep *w)
{
  double x[3] = {0}, normal[3], u[3] = {0}, after[3], out, along = 0, *x_p = m->x_p + p * w->dim;
  for (int d = 0; d < w->dim; d++) x[d] = x_p[d];
  double distance = wall_distance(m, w->wall, x, normal), mass = m->mass_p[p];
  if (distance >= 0) return 0;
  for (int d = 0; d < w->dim; d++) {
    x_p[d] -= distance * normal[d];
    u[d] = m->vel_p[p * w->dim + d] - w->moves[d];
  }
  out = dot(u, normal);
  if (out >= 0) return -distance;
  for (int d = 0; d < 3; d++) along += (u[d] - out * normal[d]) * (u[d] - out * normal[d]);
  double keeps = along > 0 ? fmax(0, 1 + w->friction * out / sqrt(along)) : 0;
  for (int d = 0; d < w->dim; d++) {
    after[d] = keeps * (u[d] - out * normal[d]);
    w->impulse[d] += mass * (after[d] - u[d]);
    w->lost += 0.5 * mass * ((u[d] - out * normal[d]) * (u[d] - out * normal[d]) - after[d] * after[d]);
    m->vel_p[p * w->dim + d] = after[d] + w->moves[d];
  }
  return -distance;
}

/* one after the other, as their impulses are summed; few blocks reach a wall */
static void expel_from(const struct sim *sim, struct mpm *m, struct sweep *w, double *depth)
{
  const struct points *points = m->points;
  for (long r = 0; r < points->n_runs; r++) {
    struct kernel_run run = {.begin = points->start[r], .end = points->start[r + 1]};
    points_block_corner(points, r / points->n_groups, run.corner);
    bool held = !m->walls->liquid && scene_material(sim->scene, (int)(r % points->n_groups))->model->held;
    if (held || run.begin == run.end || wall_distance_of_block(sim, m, w->wall, &run) > 0) continue;
    for (long p = run.begin; p < run.end; p++) *depth = fmax(*depth, expel_point(m, p, w));
  }
}

void walls_expel(const struct sim *sim, struct mpm *m, double dt)
{
  struct walls_state *s = m->walls;
  for (int i = 0; i < s->n_walls; i++) {
    struct wall_numbers *now = &m->now.wall[s->wall[i].account];
    struct sweep         w = {.dim = sim->grid.dim, .wall = i, .friction = s->wall[i].body.friction};
    if (!wall_present(&s->wall[i].body, sim->t + 0.5 * dt)) continue;
    memcpy(w.moves, now->velocity, sizeof w.moves);
    memcpy(w.moved, now->velocity, sizeof w.moved);
    expel_from(sim, m, &w, &now->depth);
    book(m, &w, dt);
  }
}

enum status mpm_expel_points(struct sim *sim, double dt)
{
  walls_expel(sim, mpm_of(sim), dt);
  return OK;
}

enum status walls_meet(struct sim *sim, struct mpm *m, double dt)
{
  struct walls_state *s = m->walls;
  TRY(touches_find(sim, m));
  for (int i = 0; i < s->n_walls; i++) memset(m->now.wall[s->wall[i].account].force, 0, 3 * sizeof(double));
  for (int b = 0; b < m->n_bodies; b++) {
    struct sweep sweeps[MAX_WALLS];
    prepare(sim, m, b, m->bodies[b].vel_new_nc, sweeps);
    sweep_all(s, sweeps);
    for (int i = 0; i < s->n_walls; i++) {
      sum_up(s, &sweeps[i]);
      book(m, &sweeps[i], dt);
    }
    boundary_ghosts(&m->kernel_grid, m->sides, sim->grid.dim, sim->t + dt, m->bodies[b].vel_new_nc);
  }
  for (int i = 0; i < s->n_walls; i++) move_wall(sim, m, i);
  return OK;
}

enum status mpm_meet_walls(struct sim *sim, double dt) { return walls_meet(sim, mpm_of(sim), dt); }
