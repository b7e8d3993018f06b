/* Rigid walls: which there are, where they are and how they move. theory 3.11 */
#include "mpm/walls.h"

#include "core/memory.h"
#include "mpm/stages.h"

#include <string.h>

static const char *const side_words[SIDES] = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

/* in a fluid a side that rubs holds the solid: mpm/rub.c */
static bool is_wall(const struct scene *scene, int side)
{
  return scene->solid_side[side].rubs && !scene->fluid.present;
}

bool walls_present(const struct scene *scene)
{
  bool present = scene->n_obstacles > 0;
  for (int side = 0; side < 2 * scene->dim; side++) present = present || is_wall(scene, side);
  return present;
}

/* everything beyond a side */
static struct obstacle beyond(const struct scene *scene, int side)
{
  const struct side_condition *s = &scene->solid_side[side];
  struct obstacle              body = {.friction = s->friction, .until = INFINITY};
  int                          d = side / 2;
  body.shape = (struct shape){.kind = SHAPE_HALF_SPACE, .dim = scene->dim};
  body.shape.normal[d] = side % 2 ? -1 : 1;
  body.shape.centre[d] = side % 2 ? scene->max[d] : scene->min[d];
  for (int e = 0; e < 3 && s->kind == SIDE_VELOCITY; e++) body.velocity[e] = s->velocity[e];
  return body;
}

enum status walls_create(struct sim *sim, struct mpm *m)
{
  const struct scene *scene = sim->scene;
  if (!walls_present(scene)) return OK;
  TRY(NEW(&m->walls, 1));
  struct walls_state *s = m->walls;
  for (int side = 0; side < 2 * scene->dim; side++)
    if (is_wall(scene, side)) s->wall[s->n_walls++] = (struct wall){beyond(scene, side), side};
  for (int i = 0; i < scene->n_obstacles; i++) s->wall[s->n_walls++] = (struct wall){scene->obstacles[i], SIDES + i};
  TRY(touches_create(sim, m, s));
  touches_lay_down(sim, m);
  return OK;
}

enum status walls_create_liquid(struct sim *sim, struct mpm *m)
{
  const struct scene *scene = sim->scene;
  TRY(NEW(&m->walls, 1));
  m->walls->liquid = true;
  for (int i = 0; i < scene->n_obstacles; i++) {
    struct wall *wall = &m->walls->wall[m->walls->n_walls++];
    *wall = (struct wall){scene->obstacles[i], SIDES + i};
    wall->body.friction = 0;
  }
  TRY(touches_create(sim, m, m->walls));
  touches_lay_down(sim, m);
  return OK;
}

void walls_destroy(struct mpm *m)
{
  if (m->walls) touches_destroy(m->walls);
  memory_free(&m->walls);
}

bool wall_present(const struct obstacle *body, double t)
{
  return body->from <= fmax(t, 0) && fmax(t, 0) <= body->until;
}

void wall_velocity(const struct obstacle *body, double t, double vel[3])
{
  const double origin[3] = {0, 0, 0};
  for (int d = 0; d < 3; d++) vel[d] = t < 0 ? 0 : function_value(&body->velocity[d], origin, t);
}

double wall_distance(const struct mpm *m, int i, const double x[3], double normal[3])
{
  const struct wall *wall = &m->walls->wall[i];
  double             at[3];
  for (int d = 0; d < 3; d++) at[d] = x[d] - m->now.wall[wall->account].displacement[d];
  if (normal) shape_normal(&wall->body.shape, at, normal);
  return shape_distance(&wall->body.shape, at);
}

double wall_distance_of_block(const struct sim *sim, const struct mpm *m, int i, const struct kernel_run *run)
{
  const struct grid *g = &sim->grid;
  double             centre[3] = {0}, edge = m->points->block_edge;
  double             step = 0.5; /* cells that a point moves at most until the next sort */
  for (int d = 0; d < g->dim; d++) centre[d] = g->min[d] + (run->corner[d] + 0.5 * edge) * g->h;
  return wall_distance(m, i, centre, NULL) - (0.5 * edge + BLOCK_MARGIN + step) * g->h * sqrt(g->dim);
}

double mpm_obstacle_distance(const struct sim *sim, const double x[3], double t, double normal[3])
{
  const struct mpm *m = mpm_of(sim);
  double            least = INFINITY;
  for (int i = 0; m && m->walls && i < m->walls->n_walls; i++) {
    const struct wall *wall = &m->walls->wall[i];
    double own = wall->account >= SIDES && wall_present(&wall->body, t) ? wall_distance(m, i, x, NULL) : INFINITY;
    if (own >= least) continue;
    least = own;
    if (normal) wall_distance(m, i, x, normal);
  }
  return least;
}

bool mpm_wall_find(const struct sim *sim, const char *name, int *wall)
{
  for (*wall = 0; *wall < 2 * sim->grid.dim; (*wall)++)
    if (strcmp(side_words[*wall], name) == 0) return true;
  for (int i = 0; i < sim->scene->n_obstacles; i++)
    if (strcmp(sim->scene->obstacles[i].name, name) == 0) {
      *wall = SIDES + i;
      return true;
    }
  return false;
}

double mpm_walls_dt(const struct sim *sim) { return walls_dt(sim, mpm_of(sim)->walls); }

double walls_dt(const struct sim *sim, const struct walls_state *s)
{
  double limit = INFINITY;
  for (int i = 0; i < s->n_walls; i++) {
    double vel[3], square = 0;
    wall_velocity(&s->wall[i].body, sim->t, vel);
    for (int d = 0; d < 3; d++) square += vel[d] * vel[d];
    if (square > 0) limit = fmin(limit, 0.5 * sim->grid.h / sqrt(square));
  }
  return limit;
}
