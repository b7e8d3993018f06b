/* Where a body touches walls: points near a wall tell their nodes of it, and of the body's surface that faces it.
 * theory 3.11 */
#include "mpm/walls.h"

#include "constitutive/constitutive.h"
#include "core/memory.h"
#include "core/parallel.h"

#include <math.h>
#include <string.h>

/* What the points near a wall tell a node: sums of weights times normal, of weights, of weights times the node's
 * distance from the wall, and the part of the body's surface that faces it. The normal stands first: at a mirror it is
 * odd along the mirror's axis, the rest is even. */
enum { NORMAL_X, WEIGHT = 3, DISTANCE, AREA, TOLD };

struct touch_list {
  struct side_condition mirrors[SIDES]; /* the sides as mirrors of the geometry */
  double (*told)[TOLD];                 /* [size] zero between uses */
  double *overlap;                      /* [size] m: the most by which a point reaches into the wall; -INFINITY */
  int    *place;                        /* [size] of a node's pressure in the list; -1: it has none */
  long    n_touches, n_pressures, touch_room, pressure_room;
};

/* half width of a point along a normal, m: that of the ellipse in its cell of the lattice, swollen in proportion */
static double half_width(const struct sim *sim, const struct mpm *m, long p, const double normal[3])
{
  double square = 0, swelling = m->volume_p[p] / mpm_point_volume(sim->scene);
  for (int d = 0; d < sim->grid.dim; d++) {
    double half = 0.5 * sim->grid.h / sim->scene->numerics.points_per_axis[d] * normal[d];
    square += half * half;
  }
  return sqrt(square) * (sim->grid.dim == 2 ? sqrt(swelling) : cbrt(swelling));
}

static void place_of(const struct mpm *m, long p, double x[3])
{
  int dim = m->kernel_grid.g.dim;
  for (int d = 0; d < 3; d++) x[d] = d < dim ? m->x_p[p * dim + d] : 0;
}

void touches_lay_down(const struct sim *sim, struct mpm *m)
{
  for (int wall = 0; wall < m->walls->n_walls; wall++) {
    if (!wall_present(&m->walls->wall[wall].body, 0)) continue;
    for (long p = 0; p < m->points->n; p++) {
      double x[3], normal[3];
      place_of(m, p, x);
      double distance = wall_distance(m, wall, x, normal), half = half_width(sim, m, p, normal);
      if (distance < 2 * half) m->skin_p[p] = fmax(m->skin_p[p], distance - half);
    }
  }
}

/* room at first; a list that is full gets twice as much */
enum { ROOM = 1024 };

enum status touches_create(const struct sim *sim, const struct mpm *m, struct walls_state *s)
{
  long size = sim->grid.size;
  TRY(NEW(&s->list, 1));
  TRY(NEW(&s->list->told, size));
  TRY(NEW(&s->list->overlap, size));
  TRY(NEW(&s->list->place, size));
  for (long c = 0; c < size; c++) {
    s->list->overlap[c] = -INFINITY;
    s->list->place[c] = -1;
  }
  for (int side = 0; side < SIDES; side++) {
    int kind = m->sides[side].kind;
    s->list->mirrors[side].kind = kind == SIDE_OPEN || kind == SIDE_PERIODIC ? kind : SIDE_SLIP;
  }
  TRY(NEW(&s->of, m->n_bodies));
  s->list->touch_room = s->list->pressure_room = ROOM;
  TRY(NEW(&s->touches, ROOM));
  return NEW(&s->pressures, ROOM);
}

void touches_destroy(struct walls_state *s)
{
  if (s->list) {
    memory_free(&s->list->told);
    memory_free(&s->list->overlap);
    memory_free(&s->list->place);
  }
  memory_free(&s->list);
  memory_free(&s->of);
  memory_free(&s->touches);
  memory_free(&s->pressures);
}

/* ---- what the points tell ---- */

/* m: how far from a plane of this normal a node can be that a point on the plane reaches */
static double reach(const struct sim *sim, const struct mpm *m, const double normal[3])
{
  static const double support[] = {
      [BASIS_LINEAR] = 1, [BASIS_GIMP] = 1.5, [BASIS_QUADRATIC] = 1.5, [BASIS_CUBIC] = 2}; /* h; GIMP: at most */
  return support[m->kernels->basis] * sim->grid.h * (fabs(normal[0]) + fabs(normal[1]) + fabs(normal[2]));
}

/* m: the same for any normal, or more */
static double farthest_reach(const struct sim *sim, const struct mpm *m)
{
  static const double diagonal[3] = {1, 1, 1};
  return reach(sim, m, diagonal);
}

/* All points that reach a node within `reach` of the wall must speak, else the body would seem to end there. */
static void tell_nodes(const struct sim *sim, const struct mpm *m, int wall, long p)
{
  struct touch_list *list = m->walls->list;
  int                dim = sim->grid.dim;
  long               node[MAX_SUPPORT];
  double             w[MAX_SUPPORT], slope[MAX_SUPPORT][3], x[3], y[3], normal[3];
  place_of(m, p, x);
  double distance = wall_distance(m, wall, x, NULL);
  if (distance >= 2 * farthest_reach(sim, m)) return;
  wall_distance(m, wall, x, normal);
  if (distance >= 2 * reach(sim, m, normal)) return;
  double overlap = half_width(sim, m, p, normal) + m->skin_p[p] - distance;
  m->kernels->weights(&m->kernel_grid, x, node, w, slope);
  for (int q = 0; q < m->kernels->n_support; q++) {
    double *told = list->told[node[q]], away = distance;
    if (!(w[q] > 0)) continue;
    grid_node(&sim->grid, node[q], y);
    for (int d = 0; d < dim; d++) {
      away += normal[d] * (y[d] - x[d]);
      told[NORMAL_X + d] += w[q] * normal[d];
      told[AREA] -= m->volume_p[p] * normal[d] * slope[q][d];
    }
    told[WEIGHT] += w[q];
    told[DISTANCE] += w[q] * away;
    list->overlap[node[q]] = fmax(list->overlap[node[q]], overlap);
  }
}

/* on a periodic axis the deepest overlap of all images counts for a node */
static void join_overlaps(const struct grid *g, double *overlap)
{
  struct box all = grid_all(g);
  for (int d = 0; d < g->dim; d++) {
    if (!g->periodic[d]) continue;
    FOR_BOX_SERIAL(g, all, c)
    {
      int place[3];
      grid_place(g, c, place);
      long image = c + ((place[d] + g->n[d]) % g->n[d] - place[d]) * g->stride[d];
      overlap[image] = fmax(overlap[image], overlap[c]);
    }
  }
}

static void ask_points(struct sim *sim, struct mpm *m, int body, int wall)
{
  struct touch_list *list = m->walls->list;
  FOR_RUNS(m->points, &sim->grid, run, group)
  {
    bool other =
        !m->walls->liquid && (sim->scene->solids[group].body != body || scene_material(sim->scene, group)->model->held);
    if (other) continue;
    if (wall_distance_of_block(sim, m, wall, &run) >= 2 * farthest_reach(sim, m)) continue;
    for (long p = run.begin; p < run.end; p++) tell_nodes(sim, m, wall, p);
  }
  boundary_fold(&m->kernel_grid, list->mirrors, TOLD, (double *)list->told);
  join_overlaps(&sim->grid, list->overlap);
}

static void forget(struct touch_list *list, long size)
{
  for (long c = 0; c < size; c++) {
    if (list->told[c][WEIGHT] == 0 && list->overlap[c] == -INFINITY) continue;
    memset(list->told[c], 0, sizeof list->told[c]);
    list->overlap[c] = -INFINITY;
  }
}

/* ---- pressures ---- */

/* doubles a full list; list: address of its pointer */
static enum status more_room(size_t size, long used, long *room, void *list)
{
  char *old, *larger;
  if (used < *room) return OK;
  memcpy(&old, list, sizeof old);
  TRY(memory_new((size_t)(2 * *room), size, &larger));
  memcpy(larger, old, (size_t)*room * size);
  memory_free(&old);
  memcpy(list, &larger, sizeof larger);
  *room *= 2;
  return OK;
}

/* the pressure around a node of the grid; it is new when a first touch asks for it */
static enum status find_pressure(struct walls_state *s, long node, int *place)
{
  struct touch_list *list = s->list;
  if (list->place[node] < 0) {
    TRY(more_room(sizeof *s->pressures, list->n_pressures, &list->pressure_room, &s->pressures));
    s->pressures[list->n_pressures] = (struct pressure){.node = node};
    list->place[node] = (int)list->n_pressures++;
  }
  *place = list->place[node];
  return OK;
}

/* a place along an axis, beyond the last nodes its image inside: sides are mirrors */
static int inner_place(const struct grid *g, int axis, int place)
{
  int n = g->n[axis];
  if (g->periodic[axis]) return (place % n + n) % n;
  return place < 0 ? -place : place > n ? 2 * n - place : place;
}

/* The pressures at x, on the wall's surface: multi-linear between the nodes of the grid, so that all nodes along a
 * normal feel the same. */
static enum status share_pressures(const struct sim *sim, struct walls_state *s, const double x[3], struct touch *t)
{
  const struct grid *g = &sim->grid;
  int                low[3] = {0};
  double             part[3] = {0};
  for (int d = 0; d < g->dim; d++) {
    double position = fmin(fmax((x[d] - g->min[d]) / g->h, -GHOST), g->n[d] + GHOST - 1);
    low[d] = (int)floor(position);
    part[d] = position - low[d];
  }
  for (int corner = 0; corner < 1 << g->dim; corner++) {
    int place[3] = {0};
    t->share[corner] = 1;
    for (int d = 0; d < g->dim; d++) {
      int up = corner >> d & 1;
      place[d] = inner_place(g, d, low[d] + up);
      t->share[corner] *= up ? part[d] : 1 - part[d];
    }
    TRY(find_pressure(s, grid_at(g, place[0], place[1], place[2]), &t->pressure[corner]));
  }
  return OK;
}

/* ---- touches ---- */

/* adds a node if the body has surface there that faces the wall and is near it */
static enum status add_touch(const struct sim *sim, const struct mpm *m, const double *mass_nc, long node)
{
  struct touch_list *list = m->walls->list;
  const double      *told = list->told[node];
  double             length = 0, gap = -list->overlap[node], distance, x[3];
  struct touch       t = {.node = node, .area = told[AREA], .closing = fmax(0, gap) / sim->dt};
  for (int d = 0; d < 3; d++) length += told[NORMAL_X + d] * told[NORMAL_X + d];
  if (!(told[AREA] > 0) || !(mass_nc[node] > m->mass_floor) || length == 0) return OK;
  distance = told[DISTANCE] / told[WEIGHT];
  for (int d = 0; d < 3; d++) t.normal[d] = told[NORMAL_X + d] / sqrt(length);
  if (distance > reach(sim, m, t.normal) || gap > sim->grid.h) return OK;
  grid_node(&sim->grid, node, x);
  for (int d = 0; d < sim->grid.dim; d++) {
    x[d] -= distance * t.normal[d];
    t.ease[d] = boundary_holds(&sim->grid, m->sides, node, d) ? 0 : 1 / mass_nc[node];
  }
  TRY(share_pressures(sim, m->walls, x, &t));
  TRY(more_room(sizeof t, list->n_touches, &list->touch_room, &m->walls->touches));
  m->walls->touches[list->n_touches++] = t;
  return OK;
}

static void set_ease(struct walls_state *s, long first)
{
  for (long i = first; i < s->list->n_touches; i++) {
    const struct touch *t = &s->touches[i];
    double              ease = 0;
    for (int d = 0; d < 3; d++) ease += t->normal[d] * t->normal[d] * t->ease[d];
    for (int k = 0; k < 8; k++) s->pressures[t->pressure[k]].ease += t->share[k] * t->area * t->area * ease;
  }
}

static enum status touch_wall(struct sim *sim, struct mpm *m, int body, int wall)
{
  struct walls_state *s = m->walls;
  struct touch_list  *list = s->list;
  struct box          nodes = boundary_nodes(&sim->grid, m->sides);
  long                first = list->n_touches, first_pressure = list->n_pressures;
  if (!wall_present(&s->wall[wall].body, sim->t + 0.5 * sim->dt)) return OK;
  ask_points(sim, m, body, wall);
  FOR_BOX_SERIAL(&sim->grid, nodes, c)
  if (list->told[c][WEIGHT] > 0) TRY(add_touch(sim, m, m->bodies[body].mass_nc, c));
  forget(list, sim->grid.size);
  for (long k = first_pressure; k < list->n_pressures; k++) list->place[s->pressures[k].node] = -1;
  set_ease(s, first);
  return OK;
}

enum status touches_find(struct sim *sim, struct mpm *m)
{
  struct walls_state *s = m->walls;
  s->list->n_touches = s->list->n_pressures = 0;
  for (int body = 0; body < m->n_bodies; body++)
    for (int i = 0; i <= s->n_walls; i++) {
      s->of[body].touch[i] = s->list->n_touches;
      s->of[body].pressure[i] = s->list->n_pressures;
      if (i < s->n_walls) TRY(touch_wall(sim, m, body, i));
    }
  return OK;
}
