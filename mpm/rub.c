/* Coulomb friction on sides of the grid in a fluid. The side holds the normal component, as at a smooth side: soil does
 * not leave it without water taking its place, and the pressure equation must know where the solid cannot go. The
 * effective stress of the points around a node on the side presses it. theory 3.12 */
#include "mpm/rub.h"

#include "constitutive/constitutive.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "mpm/stages.h"

#include <math.h>
#include <string.h>

struct rub_state {
  double *pressed_nc;   /* [dim][size] N, >= 0: force that presses a node onto the sides across an axis */
  double *sum_nc[3];    /* [dim][size] of V, V sigma'_nn, V times the distance from the side, m3, N m, m4 */
  double  depth[SIDES]; /* m: what of its room a node on a side has along the normal, so that room/depth is area */
};

static bool rubs(const struct scene *scene, int side) { return scene->fluid.present && scene->solid_side[side].rubs; }

bool rub_present(const struct scene *scene)
{
  for (int side = 0; side < 2 * scene->dim; side++)
    if (rubs(scene, side)) return true;
  return false;
}

static double depth_of_room(const struct sim *sim, const struct mpm *m, int side)
{
  struct kernel_grid closed = m->kernel_grid, open = closed;
  struct box         nodes = grid_nodes(&sim->grid);
  int                place[3] = {nodes.lo[0], nodes.lo[1], nodes.lo[2]};
  if (side % 2) place[side / 2] = nodes.hi[side / 2] - 1;
  long node = grid_at(&sim->grid, place[0], place[1], place[2]);
  open.g.periodic[side / 2] = true;
  return sim->grid.h * boundary_room(&closed, sim->scene->numerics.basis, node) /
         boundary_room(&open, sim->scene->numerics.basis, node);
}

enum status rub_create(const struct sim *sim, struct mpm *m)
{
  if (!rub_present(sim->scene)) return OK;
  TRY(NEW(&m->rub, 1));
  for (int side = 0; side < 2 * sim->grid.dim; side++) m->rub->depth[side] = depth_of_room(sim, m, side);
  for (int q = 0; q < 3; q++) TRY(NEW(&m->rub->sum_nc[q], sim->grid.size * sim->grid.dim));
  return NEW(&m->rub->pressed_nc, sim->grid.size * sim->grid.dim);
}

void rub_destroy(struct mpm *m)
{
  for (int q = 0; m->rub && q < 3; q++) memory_free(&m->rub->sum_nc[q]);
  if (m->rub) memory_free(&m->rub->pressed_nc);
  memory_free(&m->rub);
}

/* ---- what presses ---- */

/* nodes on a side */
static struct box plane_of(const struct grid *g, int side)
{
  struct box nodes = grid_nodes(g);
  nodes.lo[side / 2] = side % 2 ? g->n[side / 2] : 0;
  nodes.hi[side / 2] = nodes.lo[side / 2] + 1;
  return nodes;
}

/* whether points of a block may reach the nodes of a side */
static bool near_side(const struct sim *sim, const struct mpm *m, int side, const struct kernel_run *run)
{
  int reach = BLOCK_MARGIN + 2, d = side / 2, edge = m->points->block_edge; /* cells: support, and what moved since */
  return side % 2 ? run->corner[d] + edge + reach >= sim->grid.n[d] : run->corner[d] - reach <= 0;
}

/* one point in the sums of the nodes on a side and one layer inside */
static void press_by_point(const struct sim *sim, const struct mpm *m, int side, long p)
{
  const struct grid *g = &sim->grid;
  int                d = side / 2, place[3];
  long               node[MAX_SUPPORT];
  double             w[MAX_SUPPORT], V = m->volume_p[p], x = m->x_p[p * g->dim + d] - g->min[d];
  double             away = side % 2 ? g->n[d] * g->h - x : x;
  const double       value[] = {V, V * m->stress_p[p * SYMMETRIC + d], V * away};
  m->kernels->weights(&m->kernel_grid, m->x_p + p * g->dim, node, w, NULL);
  for (int k = 0; k < m->kernels->n_support; k++) {
    grid_place(g, node[k], place);
    int inside = side % 2 ? g->n[d] - place[d] : place[d];
    for (int q = 0; q < 3 && (inside == 0 || inside == 1); q++)
      m->rub->sum_nc[q][d * g->size + node[k]] += w[k] * value[q];
  }
}

static void press_side(const struct sim *sim, const struct mpm *m, int side)
{
  FOR_RUNS(m->points, &sim->grid, run, group)
  if (near_side(sim, m, side, &run) && !scene_material(sim->scene, group)->model->held)
    for (long p = run.begin; p < run.end; p++) press_by_point(sim, m, side, p);
}

/* N: the stress at the side, from the means at the node and at the one inside, times area; what is not sure to press
 * does not */
static double press_of_node(const struct sim *sim, const struct mpm *m, int side, long n)
{
  const struct grid *g = &sim->grid;
  long               inner = n + (side % 2 ? -1 : 1) * g->stride[side / 2], base = side / 2 * g->size;
  const double *V = m->rub->sum_nc[0] + base, *force = m->rub->sum_nc[1] + base, *moment = m->rub->sum_nc[2] + base;
  double        least = 1e-6 * grid_cell_volume(g);
  if (!(V[n] > least)) return 0;
  double stress = force[n] / V[n];
  if (V[inner] > least) {
    double y = moment[n] / V[n], apart = moment[inner] / V[inner] - y, rise = stress - force[inner] / V[inner];
    if (apart > 0) stress += fmax(stress, fmin(-stress, rise * y / apart)); /* at most doubled, at least gone */
  }
  return fmax(0, -stress) * V[n] / m->rub->depth[side];
}

enum status mpm_press_sides(struct sim *sim, double dt)
{
  (void)dt;
  struct mpm        *m = mpm_of(sim);
  const struct grid *g = &sim->grid;
  for (int q = 0; q < 3; q++) memset(m->rub->sum_nc[q], 0, (size_t)(g->size * g->dim) * sizeof(double));
  for (int side = 0; side < 2 * g->dim; side++)
    if (rubs(sim->scene, side)) press_side(sim, m, side);
  for (int q = 0; q < 3; q++)
    for (int d = 0; d < g->dim; d++) boundary_fold(&m->kernel_grid, m->sides, 1, m->rub->sum_nc[q] + d * g->size);
  for (int side = 0; side < 2 * g->dim; side++) {
    struct box nodes = plane_of(g, side);
    if (rubs(sim->scene, side))
      FOR_BOX_SERIAL(g, nodes, n) m->rub->pressed_nc[side / 2 * g->size + n] = press_of_node(sim, m, side, n);
  }
  return OK;
}

/* ---- what rubs ---- */

/* velocity of a node over its side along the side, m/s; returns its length */
static double slip_of(const struct sim *sim, int side, long n, const double *vel, double slip[3])
{
  double x[3], speed[3], square = 0;
  grid_node(&sim->grid, n, x);
  boundary_speed(&sim->scene->solid_side[side], x, sim->t + 0.5 * sim->dt, speed);
  for (int d = 0; d < sim->grid.dim; d++) {
    slip[d] = d == side / 2 ? 0 : vel[n * sim->grid.dim + d] - speed[d];
    square += slip[d] * slip[d];
  }
  return sqrt(square);
}

/* impulse N s on node n of a side, which changes the velocity vel of its mass: friction stops it, at most with its
 * share of the force; of several bodies each bears the force by its mass */
static void rub_node(const struct sim *sim, const struct mpm *m, int side, long n, double dt, double mass, double *vel,
                     double impulse[3])
{
  double slip[3], speed = slip_of(sim, side, n, vel, slip);
  memset(impulse, 0, 3 * sizeof *impulse);
  if (!(speed > 0) || !(mass > m->mass_floor)) return;
  double force = m->rub->pressed_nc[side / 2 * sim->grid.size + n] * (mass / m->mass_nc[n]);
  double most = dt * sim->scene->solid_side[side].friction * force;
  double share = fmin(1, most / (mass * speed));
  for (int d = 0; d < sim->grid.dim; d++) {
    impulse[d] = -mass * share * slip[d];
    vel[n * sim->grid.dim + d] -= share * slip[d];
  }
}

void rub_nodes(const struct sim *sim, const struct mpm *m, double dt, double *vel_nc)
{
  for (int side = 0; m->rub && side < 2 * sim->grid.dim; side++) {
    struct box nodes = plane_of(&sim->grid, side);
    double     impulse[3];
    if (rubs(sim->scene, side))
      FOR_BOX_SERIAL(&sim->grid, nodes, n) rub_node(sim, m, side, n, dt, m->mass_nc[n], vel_nc, impulse);
  }
}

/* The step's friction, and its account: work on the mean of the slips at both ends of the step (3.11). */
static void rub_side(const struct sim *sim, struct mpm *m, const struct body_nodes *body, int side, double dt)
{
  struct wall_numbers *wall = &m->now.wall[side];
  struct box           nodes = plane_of(&sim->grid, side);
  double               speed[3];
  FOR_BOX_SERIAL(&sim->grid, nodes, n)
  {
    double x[3], impulse[3], before[3], after[3];
    slip_of(sim, side, n, body->vel_nc, before);
    rub_node(sim, m, side, n, dt, body->mass_nc[n], body->vel_new_nc, impulse);
    slip_of(sim, side, n, body->vel_new_nc, after);
    grid_node(&sim->grid, n, x);
    boundary_speed(&sim->scene->solid_side[side], x, sim->t + 0.5 * dt, speed);
    for (int d = 0; d < sim->grid.dim; d++) {
      wall->impulse[d] += impulse[d];
      wall->force[d] += impulse[d] / dt;
      m->now.friction -= impulse[d] * 0.5 * (before[d] + after[d]);
      m->now.work_walls += impulse[d] * speed[d];
    }
  }
}

enum status mpm_rub_sides(struct sim *sim, double dt)
{
  struct mpm *m = mpm_of(sim);
  for (int side = 0; side < 2 * sim->grid.dim; side++) {
    if (!rubs(sim->scene, side)) continue;
    for (int d = 0; d < sim->grid.dim; d++)
      if (d != side / 2) m->now.wall[side].force[d] = 0; /* the normal one is mpm.watch_sides' */
    for (int b = 0; b < m->n_bodies; b++) rub_side(sim, m, &m->bodies[b], side, dt);
  }
  for (int b = 0; b < m->n_bodies; b++)
    boundary_ghosts(&m->kernel_grid, m->sides, sim->grid.dim, sim->t + dt, m->bodies[b].vel_new_nc);
  return OK;
}
