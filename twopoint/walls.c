/* Water meets obstacles as a solid does, without friction. theory_twopoint 13, theory 3.11 */
#include "twopoint/twopoint.h"

#include "core/memory.h"
#include "core/parallel.h"
#include "coupling/coupling.h"
#include "mpm/walls.h"

#include <string.h>

bool twopoint_walled(const struct scene *scene)
{
  bool any = false;
  for (int i = 0; i < scene->n_obstacles; i++) any = any || scene->obstacles[i].until > 0;
  return any;
}

struct shape twopoint_region(const struct scene *scene, struct shape *parts)
{
  int n = 1;
  parts[0] = scene->fluid.region;
  for (int i = 0; i < scene->n_obstacles; i++)
    if (scene->obstacles[i].until > 0 && scene->obstacles[i].from <= 0) parts[n++] = scene->obstacles[i].shape;
  return (struct shape){.kind = SHAPE_DIFFERENCE, .dim = scene->dim, .n = n, .parts = parts};
}

/* arrays change places when points are sorted */
static struct mpm *shade_of(struct twopoint *w)
{
  struct mpm *m = w->shade;
  m->x_p = w->x_w;
  m->vel_p = w->vel_w;
  m->mass_p = w->mass_w;
  m->volume_p = w->volume_w;
  m->skin_p = w->skin_w;
  m->bodies[0] =
      (struct body_nodes){.mass_nc = w->water_mass_nc, .vel_nc = w->water_vel_nc, .vel_new_nc = w->water_vel_new_nc};
  m->mass_floor = w->mass_floor;
  memcpy(m->now.wall, w->now.wall, sizeof m->now.wall);
  return m;
}

static void take_account(struct twopoint *w) { memcpy(w->now.wall, w->shade->now.wall, sizeof w->now.wall); }

static bool any_moves(const struct scene *scene)
{
  for (int i = 0; i < scene->n_obstacles; i++) {
    const struct obstacle *o = &scene->obstacles[i];
    bool                   comes = o->from > 0 || o->until < scene->time_end;
    for (int d = 0; d < scene->dim; d++) comes = comes || o->velocity[d].expression || o->velocity[d].constant != 0;
    if (comes) return true;
  }
  return false;
}

enum status twopoint_create_walls(struct sim *sim, struct twopoint *w)
{
  if (!twopoint_walled(sim->scene)) return OK;
  TRY(NEW(&w->shade, 1));
  struct mpm *m = w->shade;
  m->kernel_grid = w->kernel_grid;
  m->kernels = w->kernels;
  m->points = w->points;
  m->n_bodies = 1;
  memcpy(m->sides, w->sides, sizeof m->sides);
  TRY(NEW(&m->bodies, 1));
  TRY(walls_create_liquid(sim, shade_of(w)));
  walls_find_rooms(sim, m, 0, w->water_star_nc, w->water_room_nc);
  return OK;
}

void twopoint_destroy_walls(struct twopoint *w)
{
  if (!w->shade) return;
  walls_destroy(w->shade);
  memory_free(&w->shade->bodies);
  memory_free(&w->shade);
}

enum status twopoint_meet_walls(struct sim *sim, double dt)
{
  struct twopoint *w = twopoint_of(sim);
  TRY(walls_meet(sim, shade_of(w), dt));
  take_account(w);
  if (any_moves(sim->scene)) walls_find_rooms(sim, w->shade, sim->t + dt, w->water_star_nc, w->water_room_nc);
  return OK;
}

enum status twopoint_expel_points(struct sim *sim, double dt)
{
  struct twopoint *w = twopoint_of(sim);
  walls_expel(sim, shade_of(w), dt);
  take_account(w);
  return OK;
}

double twopoint_walls_dt(const struct sim *sim) { return walls_dt(sim, twopoint_of(sim)->shade->walls); }
