/* What obstacles leave open, and how bodies that move, come and go change it. theory 4.14 */
#include "ice/obstacles.h"

#include "core/memory.h"
#include "core/parallel.h"
#include "mpm/at_rest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* a cell with less room than this share lends it to a neighbour */
static const double least_open = 0.05;
/* a face with less is closed */
static const double least_face = 1e-6;

/* ---- which there are ---- */

static bool is_zero(const struct function *f) { return !f->expression && f->constant == 0; }

static bool stands(const struct obstacle *o) { return o->until > 0; }

static bool changes(const struct scene *scene, const struct obstacle *o)
{
  bool still = is_zero(&o->velocity[0]) && is_zero(&o->velocity[1]) && is_zero(&o->velocity[2]);
  return stands(o) && (!still || o->from > 0 || o->until < scene->time_end);
}

bool obstacles_present(const struct scene *scene)
{
  bool any = false;
  for (int i = 0; i < scene->n_obstacles; i++) any = any || stands(&scene->obstacles[i]);
  return any;
}

bool obstacles_change(const struct scene *scene)
{
  bool any = false;
  for (int i = 0; i < scene->n_obstacles; i++) any = any || changes(scene, &scene->obstacles[i]);
  return any;
}

/* the bodies that are there now, or were a step ago */
static struct places gather_places(const struct sim *sim, const struct body_place *body)
{
  struct places p = {0};
  for (int i = 0; i < sim->scene->n_obstacles; i++) {
    if (!(body[i].present > 0)) continue;
    p.shape[p.n] = &sim->scene->obstacles[i].shape;
    memcpy(p.moved[p.n++], body[i].moved, sizeof p.moved[0]);
  }
  return p;
}

/* whether one came or went in the last step */
static bool is_event(const struct sim *sim, const struct ice *ice)
{
  bool event = false;
  for (int i = 0; i < sim->scene->n_obstacles; i++)
    event = event || ice->now.obstacle[i].present != ice->now.before[i].present;
  return event;
}

/* ---- what they leave open ---- */

static void measure_cells(const struct sim *sim, struct obstacles *o)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX(g, cells, c)
  {
    double x[3];
    grid_centre(g, c, x);
    o->raw[c] = share_left(g, &o->places, NULL, x, o->up, o->slice + c * SHARE_PARTS);
  }
  grid_fill_periodic(g, 1, o->raw);
}

static void measure_faces(const struct sim *sim, struct obstacles *o)
{
  const struct grid *g = &sim->grid;
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    double    *open = o->face + axis * g->size;
    FOR_BOX(g, faces, f)
    {
      double x[3];
      grid_face(g, f, axis, x);
      open[f] = 1 - share_inside(g, &o->places, x, axis);
      if (open[f] < least_face) open[f] = 0;
    }
  }
}

/* Little room is lent; so is for a step what a body uncovers at once: there is no liquid yet that could follow it. */
static void find_lenders(const struct sim *sim, struct obstacles *o, bool event)
{
  struct box cells = grid_cells(&sim->grid);
  FOR_BOX(&sim->grid, cells, c)
  o->lends[c] = o->raw[c] < least_open || (!event && o->raw[c] > o->past[c] && o->past[c] < 0.5 * least_open);
}

/* The cell inside the grid with enough room behind the widest face; else, as a body swallows a cell, the one with most
 * room around. */
static long find_master(const struct grid *g, const struct obstacles *o, long c)
{
  double widest = 0, most = 0;
  long   best = -1, other = -1;
  int    place[3], layers = g->dim == 3 ? 1 : 0;
  grid_place(g, c, place);
  for (int k = -layers; k <= layers; k++)
    for (int j = -1; j <= 1; j++)
      for (int i = -1; i <= 1; i++) {
        int  way[3] = {i, j, k}, steps = abs(i) + abs(j) + abs(k), axis = i ? 0 : j ? 1 : 2;
        long n = c + i * g->stride[0] + j * g->stride[1] + k * g->stride[2];
        bool inside = steps > 0;
        for (int d = 0; d < g->dim; d++) inside = inside && place[d] + way[d] >= 0 && place[d] + way[d] < g->n[d];
        if (!inside || o->lends[n]) continue;
        double face = steps == 1 ? o->face[axis * g->size + (way[axis] > 0 ? n : c)] : 0;
        if (face > widest) widest = face, best = n;
        if (o->raw[n] > most) most = o->raw[n], other = n;
      }
  return best >= 0 ? best : other;
}

/* rooms at the end of the step: small cells lend theirs and are closed */
static void lend_rooms(const struct sim *sim, struct obstacles *o)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  FOR_BOX_SERIAL(g, cells, c)
  {
    o->master[c] = o->lends[c] ? find_master(g, o, c) : -1;
    o->next[c] = o->lends[c] ? 0 : o->raw[c];
  }
  FOR_BOX_SERIAL(g, cells, c)
  {
    if (o->master[c] >= 0) o->next[o->master[c]] += o->raw[c];
    if (o->lends[c])
      for (int d = 0; d < g->dim; d++) o->face[d * g->size + c] = o->face[d * g->size + c + g->stride[d]] = 0;
  }
  grid_fill_periodic(g, 1, o->next);
  ice_fill_faces(sim, o->face);
}

static void measure(const struct sim *sim, struct obstacles *o, bool event)
{
  memcpy(o->past, o->raw, (size_t)sim->grid.size * sizeof *o->raw);
  measure_cells(sim, o);
  measure_faces(sim, o);
  find_lenders(sim, o, event);
  lend_rooms(sim, o);
}

/* ---- creation ---- */

static enum status allocate(struct sim *sim, struct obstacles *o)
{
  long n = sim->grid.size;
  TRY(NEW(&o->raw, n));
  TRY(NEW(&o->open, n));
  TRY(NEW(&o->next, n));
  TRY(NEW(&o->face, n * sim->grid.dim));
  TRY(NEW(&o->slice, n * SHARE_PARTS));
  TRY(NEW(&o->past, n));
  TRY(NEW(&o->lends, n));
  TRY(NEW(&o->master, n));
  for (long c = 0; c < n; c++) o->raw[c] = o->open[c] = o->next[c] = 1; /* ghosts */
  for (long f = 0; f < n * sim->grid.dim; f++) o->face[f] = 1;
  return OK;
}

static void find_up(const struct sim *sim, struct obstacles *o)
{
  double up[3], g;
  at_rest_up(sim->scene, up, &g);
  for (int d = 1; d < sim->grid.dim; d++)
    if (fabs(up[d]) > fabs(up[o->up])) o->up = d;
  o->sign = up[o->up] > 0 ? 1 : up[o->up] < 0 ? -1 : 0;
}

enum status obstacles_create(struct sim *sim, struct ice *ice)
{
  const struct scene *scene = sim->scene;
  if (!obstacles_present(scene)) return OK;
  if (!ice->advects && !ice->params->shocks)
    return FAIL(ERR_INPUT,
                "obstacles: liquid flows around them only with numerics.ice.advection or numerics.ice.shocks "
                "true; set one, or remove them");
  TRY(NEW(&ice->obstacles, 1));
  struct obstacles *o = ice->obstacles;
  TRY(allocate(sim, o));
  find_up(sim, o);
  for (int i = 0; i < scene->n_obstacles; i++)
    ice->now.obstacle[i].present = stands(&scene->obstacles[i]) && scene->obstacles[i].from <= 0;
  memcpy(ice->now.before, ice->now.obstacle, sizeof ice->now.before);
  o->places = gather_places(sim, ice->now.obstacle);
  measure(sim, o, true);
  memcpy(o->open, o->next, (size_t)sim->grid.size * sizeof *o->open);
  ice->open_cc = o->open;
  ice->open_fc = o->face;
  return OK;
}

void obstacles_destroy(struct ice *ice)
{
  struct obstacles *o = ice->obstacles;
  if (!o) return;
  memory_free(&o->raw);
  memory_free(&o->open);
  memory_free(&o->next);
  memory_free(&o->face);
  memory_free(&o->slice);
  memory_free(&o->past);
  memory_free(&o->lends);
  memory_free(&o->master);
  memory_free(&ice->obstacles);
}

/* ---- the surface in a cut cell ---- */

double ice_level(const struct ice *ice, long c)
{
  const struct obstacles *o = ice->obstacles;
  double                  alpha = ice->alpha_cc[c], below = 0;
  if (!o || o->sign == 0 || o->raw[c] >= 1 || o->raw[c] <= 0 || alpha <= 0 || alpha >= 1) return alpha;
  int    top = -1, at = -1;
  double level = 0, wanted = alpha * o->raw[c];
  for (int k = 0; k < SHARE_PARTS; k++) {
    double part = o->slice[c * SHARE_PARTS + (o->sign > 0 ? k : SHARE_PARTS - 1 - k)];
    if (part > 0) top = k;
    if (at < 0 && part > 0 && below + part >= wanted) {
      at = k;
      level = k + (wanted - below) / part;
    }
    below += part;
  }
  return at < 0 ? alpha : level / (top + 1);
}

/* ---- motion ---- */

/* liquid from one cell to another: mass, momentum, heat */
static void hand_over(const struct sim *sim, struct ice *ice, long from, long to, double mass)
{
  int    dim = sim->grid.dim;
  double before = ice->mass_cc[to], after = before + mass;
  if (!(mass > 0)) return;
  for (int d = 0; d < dim; d++)
    ice->vel_cc[to * dim + d] = (before * ice->vel_cc[to * dim + d] + mass * ice->vel_cc[from * dim + d]) / after;
  if (ice->T_cc) ice->T_cc[to] = (before * ice->T_cc[to] + mass * ice->T_cc[from]) / after;
  ice->mass_cc[to] = after;
  ice->mass_cc[from] -= mass;
}

/* cells take back the rooms that they lent, with their share of the liquid, at the pressure of their height */
static void take_back(const struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct obstacles  *o = ice->obstacles;
  struct box         cells = grid_cells(g);
  double             gravity[3];
  sim_gravity(sim, sim->t, gravity);
  FOR_BOX_SERIAL(g, cells, c)
  {
    long   k = o->master[c];
    double x[3], y[3];
    if (k < 0 || !(o->raw[c] > 0)) continue;
    hand_over(sim, ice, k, c, ice->mass_cc[k] * o->raw[c] / o->open[k]);
    o->open[k] -= o->raw[c];
    o->open[c] = o->raw[c];
    grid_centre(g, c, x);
    grid_centre(g, k, y);
    ice->P_cc[c] = ice->P_cc[k];
    for (int d = 0; d < g->dim; d++) ice->P_cc[c] += sim->scene->fluid.density * gravity[d] * (x[d] - y[d]);
  }
}

/* cells that have too little room now lend it */
static enum status lend_liquid(const struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct obstacles  *o = ice->obstacles;
  struct box         cells = grid_cells(g);
  FOR_BOX_SERIAL(g, cells, c)
  {
    long k = o->master[c];
    if (!o->lends[c] || !(o->open[c] > 0)) continue;
    if (k < 0 && ice->mass_cc[c] > 0)
      return FAIL(ERR_DIVERGED, "ice: an obstacle shuts in liquid at t = %g s; make it slower or leave a way out",
                  sim->t);
    if (k >= 0) {
      hand_over(sim, ice, c, k, ice->mass_cc[c]);
      o->open[k] += o->open[c];
    }
    o->open[c] = ice->mass_cc[c] = ice->P_cc[c] = 0;
  }
  return OK;
}

/* where they will be at the end of the step */
static void move(const struct sim *sim, struct ice *ice, double dt)
{
  static const double origin[3] = {0, 0, 0};
  memcpy(ice->now.before, ice->now.obstacle, sizeof ice->now.before);
  for (int i = 0; i < sim->scene->n_obstacles; i++) {
    const struct obstacle *body = &sim->scene->obstacles[i];
    double                 t = sim->t + 0.5 * dt;
    ice->now.obstacle[i].present = stands(body) && body->from <= t && t <= body->until;
    for (int d = 0; d < sim->grid.dim; d++)
      ice->now.obstacle[i].moved[d] += dt * function_value(&body->velocity[d], origin, t);
  }
}

/* after a resume they are elsewhere than at the start */
static void catch_up(const struct sim *sim, struct ice *ice)
{
  struct obstacles *o = ice->obstacles;
  struct places     p = gather_places(sim, ice->now.obstacle);
  if (memcmp(&p, &o->places, sizeof p) == 0) return;
  o->places = gather_places(sim, ice->now.before);
  measure(sim, o, true);
  o->places = p;
  measure(sim, o, is_event(sim, ice));
}

enum status ice_move_obstacles(struct sim *sim, double dt)
{
  struct ice       *ice = ice_of(sim);
  struct obstacles *o = ice->obstacles;
  size_t            bytes = (size_t)sim->grid.size * sizeof *o->open;
  catch_up(sim, ice);
  memcpy(o->open, o->next, bytes);
  take_back(sim, ice);
  move(sim, ice, dt);
  bool event = is_event(sim, ice);
  o->places = gather_places(sim, ice->now.obstacle);
  measure(sim, o, event);
  TRY(lend_liquid(sim, ice));
  if (event) memcpy(o->open, o->next, bytes); /* what comes or goes does not push */
  grid_fill_periodic(&sim->grid, 1, o->open);
  return OK;
}

double ice_wall_rate(const struct ice *ice, long c, double dt)
{
  return ice->obstacles ? (ice->obstacles->next[c] - ice->obstacles->open[c]) / dt : 0;
}

/* a body moves half a cell */
double ice_obstacles_dt(const struct sim *sim)
{
  static const double origin[3] = {0, 0, 0};
  double              limit = INFINITY;
  for (int i = 0; i < sim->scene->n_obstacles; i++) {
    double square = 0;
    for (int d = 0; d < sim->grid.dim; d++)
      square += pow(function_value(&sim->scene->obstacles[i].velocity[d], origin, sim->t), 2);
    if (square > 0) limit = fmin(limit, 0.5 * sim->grid.h / sqrt(square));
  }
  return limit;
}
