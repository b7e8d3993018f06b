/* Contact of bodies: at a node that two bodies share, those that touch push each other apart, with Coulomb friction.
 * theory 3.4; velocity fields per body after Bardenhagen et al. 2001 */
#include "mpm/contact.h"

#include "core/memory.h"
#include "core/parallel.h"
#include "mpm/stages.h"

#include <math.h>
#include <string.h>

/* Two bodies at a node they share. */
struct meeting {
  long   node;
  int    body[2];
  double normal[3]; /* out of the first, into the second */
  double reach[2];  /* m along the normal from the node: how far the first extends, where the second begins */
};

enum { APART = -1, BEYOND = -2 };

struct contact_state {
  struct meeting *meetings; /* [capacity], those of a node stand together */
  long            n, capacity;
  int            *first;       /* [size] a node's first meeting; APART, or BEYOND behind a side */
  double        **gradient_nc; /* [bodies][size][dim] m2: volume gradient */
};

enum status contact_create(struct sim *sim, struct mpm *m)
{
  struct contact_state *c;
  TRY(NEW(&m->contact, 1));
  c = m->contact;
  c->capacity = sim->grid.size;
  TRY(NEW(&c->meetings, c->capacity));
  TRY(NEW(&c->first, sim->grid.size));
  TRY(NEW(&c->gradient_nc, m->n_bodies));
  for (int b = 0; b < m->n_bodies; b++) TRY(NEW(&c->gradient_nc[b], sim->grid.size * sim->grid.dim));
  return OK;
}

void contact_destroy(struct mpm *m)
{
  struct contact_state *c = m->contact;
  if (!c) return;
  for (int b = 0; b < m->n_bodies && c->gradient_nc; b++) memory_free(&c->gradient_nc[b]);
  memory_free(&c->gradient_nc);
  memory_free(&c->first);
  memory_free(&c->meetings);
  memory_free(&m->contact);
}

/* ---- where bodies meet ---- */

static enum status add_meetings(const struct mpm *m, struct contact_state *c, long node)
{
  for (int a = 0; a < m->n_bodies; a++) {
    if (!(m->bodies[a].mass_nc[node] > m->mass_floor)) continue;
    for (int b = a + 1; b < m->n_bodies; b++) {
      if (!(m->bodies[b].mass_nc[node] > m->mass_floor)) continue;
      if (c->n == c->capacity)
        return FAIL(ERR_DIVERGED, "contact: bodies meet %ld times, more often than there are nodes; use fewer bodies",
                    c->n);
      if (c->first[node] < 0) c->first[node] = (int)c->n;
      c->meetings[c->n++] = (struct meeting){.node = node, .body = {a, b}, .reach = {-INFINITY, INFINITY}};
    }
  }
  return OK;
}

static enum status find_meetings(const struct sim *sim, const struct mpm *m, struct contact_state *c)
{
  struct box nodes = boundary_nodes(&sim->grid, m->sides);
  c->n = 0;
  for (long i = 0; i < sim->grid.size; i++) c->first[i] = BEYOND;
  FOR_BOX_SERIAL(&sim->grid, nodes, node)
  {
    c->first[node] = APART;
    TRY(add_meetings(m, c, node));
  }
  return OK;
}

/* ---- normals ---- */

/* nodes of a point at which bodies meet, ghosts among them, with their weights' gradients; returns how many */
static int shared_nodes(const struct sim *sim, const struct mpm *m, long p, long *node, double (*gradient)[3])
{
  long   all[MAX_SUPPORT];
  double w[MAX_SUPPORT], slope[MAX_SUPPORT][3];
  int    n = 0;
  m->kernels->weights(&m->kernel_grid, m->x_p + p * sim->grid.dim, all, w, slope);
  for (int q = 0; q < m->kernels->n_support; q++) {
    if (m->contact->first[all[q]] == APART || w[q] == 0) continue;
    node[n] = all[q];
    memcpy(gradient[n++], slope[q], sizeof slope[q]);
  }
  return n;
}

/* Whether a block's points can reach a shared node. */
static bool block_meets(const struct sim *sim, const struct mpm *m, const struct kernel_run *run)
{
  struct box reach = grid_all(&sim->grid);
  for (int d = 0; d < sim->grid.dim; d++) {
    int low = run->corner[d] - BLOCK_MARGIN - 1, high = run->corner[d] + m->points->block_edge + BLOCK_MARGIN + 2;
    reach.lo[d] = low > reach.lo[d] ? low : reach.lo[d];
    reach.hi[d] = high + 1 < reach.hi[d] ? high + 1 : reach.hi[d];
  }
  FOR_BOX_SERIAL(&sim->grid, reach, node)
  if (m->contact->first[node] >= 0) return true;
  return false;
}

/* a wall is a plane of symmetry: ghosts go to their images, and nothing is left across the wall on it */
static void mirror_gradient(const struct sim *sim, const struct mpm *m, double *gradient_nc)
{
  struct side_condition symmetric[SIDES];
  for (int side = 0; side < SIDES; side++) {
    symmetric[side] = sim->scene->solid_side[side];
    bool wall = symmetric[side].kind != SIDE_OPEN && symmetric[side].kind != SIDE_PERIODIC;
    if (wall) symmetric[side].kind = SIDE_SLIP;
  }
  boundary_fold(&m->kernel_grid, symmetric, sim->grid.dim, gradient_nc);
  boundary_velocity(&sim->grid, symmetric, 0, gradient_nc);
}

/* gradient, over the nodes, of the volume that every body has at shared nodes: it points into the body */
static void volume_gradients(struct sim *sim, struct mpm *m)
{
  int dim = sim->grid.dim;
  for (int b = 0; b < m->n_bodies; b++)
    memset(m->contact->gradient_nc[b], 0, (size_t)(sim->grid.size * dim) * sizeof(double));
  FOR_RUNS(m->points, &sim->grid, run, group)
  {
    double *gradient_nc = m->contact->gradient_nc[sim->scene->solids[group].body];
    if (!block_meets(sim, m, &run)) continue;
    for (long p = run.begin; p < run.end; p++) {
      long   node[MAX_SUPPORT];
      double slope[MAX_SUPPORT][3];
      int    n = shared_nodes(sim, m, p, node, slope);
      for (int q = 0; q < n; q++)
        for (int d = 0; d < dim; d++) gradient_nc[node[q] * dim + d] -= m->volume_p[p] * slope[q][d];
    }
  }
  for (int b = 0; b < m->n_bodies; b++) mirror_gradient(sim, m, m->contact->gradient_nc[b]);
}

/* Below this share of what a flat surface through the node has (3/(4 h) for quadratic splines), in 1/h, gradients are
 * noise of the lattice, and so would be their direction */
static const double least_gradient = 0.1;

static double square(int dim, const double *v) { return v[0] * v[0] + v[1] * v[1] + (dim == 3 ? v[2] * v[2] : 0); }

/* Out of the first body: both gradients, weighted with their squares, or their plain difference, which the edge of a
 * body tilts. Zero where they are noise: no overlap is found along it. */
static void set_normal(const struct sim *sim, const struct contact_state *c, struct meeting *k)
{
  int           dim = sim->grid.dim;
  bool          weighted = sim->scene->contact.normal == NORMAL_WEIGHTED;
  const double *first = c->gradient_nc[k->body[0]] + k->node * dim,
               *second = c->gradient_nc[k->body[1]] + k->node * dim;
  double own = weighted ? square(dim, first) : 1, other = weighted ? square(dim, second) : 1;
  double difference[3] = {0}, least = 2 * least_gradient * pow(sim->grid.h, dim - 1);
  for (int d = 0; d < dim; d++) {
    difference[d] = second[d] - first[d];
    k->normal[d] = other * second[d] - own * first[d];
  }
  double length = square(dim, difference) > least * least ? sqrt(square(dim, k->normal)) : INFINITY;
  for (int d = 0; d < dim; d++) k->normal[d] = length > 0 ? k->normal[d] / length : 0;
}

/* ---- reach ---- */

/* half width of a point along n: that of the ellipse its cell of the lattice has become */
static double half_width(const struct sim *sim, const struct mpm *m, long p, const double n[3])
{
  int    dim = sim->grid.dim;
  double width2 = 0;
  for (int e = 0; e < dim; e++) {
    double along = 0;
    for (int d = 0; d < dim; d++) along += n[d] * m->F_p[(p * dim + d) * dim + e];
    along *= 0.5 * sim->grid.h / sim->scene->numerics.points_per_axis[e];
    width2 += along * along;
  }
  return sqrt(width2);
}

/* h: points farther than this from a node, across the normal, say nothing of the gap there; curved bodies would meet
 * too early */
static const double reach_width = 0.8;

static void extend_reach(const struct sim *sim, const struct mpm *m, long p, int body, struct meeting *k)
{
  double x[3], along = 0, distance2 = 0, half, width = reach_width * sim->grid.h;
  if (k->body[0] != body && k->body[1] != body) return;
  grid_node(&sim->grid, k->node, x);
  for (int d = 0; d < sim->grid.dim; d++) {
    double r = m->x_p[p * sim->grid.dim + d] - x[d];
    along += k->normal[d] * r;
    distance2 += r * r;
  }
  if (distance2 - along * along > width * width) return;
  half = half_width(sim, m, p, k->normal);
  if (k->body[0] == body)
    k->reach[0] = fmax(k->reach[0], along + half);
  else
    k->reach[1] = fmin(k->reach[1], along - half);
}

/* how far both bodies extend along the normals: the points that reach the node decide */
static void find_reach(struct sim *sim, struct mpm *m)
{
  struct contact_state *c = m->contact;
  FOR_RUNS(m->points, &sim->grid, run, group)
  {
    if (!block_meets(sim, m, &run)) continue;
    for (long p = run.begin; p < run.end; p++) {
      long   node[MAX_SUPPORT];
      double slope[MAX_SUPPORT][3];
      int    n = shared_nodes(sim, m, p, node, slope);
      for (int q = 0; q < n; q++)
        for (long k = c->first[node[q]]; k >= 0 && k < c->n && c->meetings[k].node == node[q]; k++)
          extend_reach(sim, m, p, sim->scene->solids[group].body, &c->meetings[k]);
    }
  }
}

/* ---- impulses ---- */

/* Share of the largest stable stiffness m/dt_limit^2 that overlapping bodies push each other apart with. They
 * give way by about 20 h p/(rho c^2) under a pressure p. */
static const double stiffness = 0.2;

/* kg */
static double reduced_mass(const struct mpm *m, const struct meeting *k)
{
  double first = m->bodies[k->body[0]].mass_nc[k->node], second = m->bodies[k->body[1]].mass_nc[k->node];
  return first * second / (first + second);
}

/* J, energy of the spring between two bodies at a node */
static double stored(const struct sim *sim, const struct mpm *m, const struct meeting *k)
{
  double overlap = k->reach[0] - k->reach[1], rate = overlap / sim->dt_limit;
  bool   spring = sim->scene->contact.detection == DETECT_REACH && overlap > 0;
  return spring ? 0.5 * stiffness * reduced_mass(m, k) * rate * rate : 0;
}

/* Change of the approach speed by the normal impulse of a step, m/s. A spring gives back what it took; taking away the
 * whole approach at once, as `approach` does, loses the kinetic energy of a layer of about h at every hit. */
static double normal_change(const struct sim *sim, const struct meeting *k, double approach)
{
  if (sim->scene->contact.detection == DETECT_APPROACH) return approach;
  return stiffness * (k->reach[0] - k->reach[1]) * sim->dt / (sim->dt_limit * sim->dt_limit);
}

/* velocity of the first body relative to the second; without its part along the normal, which is returned */
static double slip_velocity(int dim, const struct meeting *k, const double *first, const double *second, double slip[3])
{
  double approach = 0;
  for (int d = 0; d < dim; d++) {
    slip[d] = first[k->node * dim + d] - second[k->node * dim + d];
    approach += slip[d] * k->normal[d];
  }
  for (int d = 0; d < dim; d++) slip[d] -= approach * k->normal[d];
  return approach;
}

/* Momentum along the normal goes from the first body to the second, and along the surface what stops sliding, but at
 * most friction times that. Returns the work lost to friction, J: the impulse times the mean slip of the step. */
static double exchange(const struct sim *sim, const struct mpm *m, const struct meeting *k)
{
  int                     dim = sim->grid.dim;
  const struct body_nodes first = m->bodies[k->body[0]], second = m->bodies[k->body[1]];
  double                  before[3], slip[3], work = 0, reduced = reduced_mass(m, k);
  double                  approach = slip_velocity(dim, k, first.vel_new_nc, second.vel_new_nc, slip);
  double                  pressed = normal_change(sim, k, approach);
  if (!(pressed > 0)) return 0;
  double slide = sqrt(square(dim, slip)), limit = sim->scene->contact.friction * pressed;
  double share = slide > limit ? limit / slide : 1;
  slip_velocity(dim, k, first.vel_nc, second.vel_nc, before);
  for (int d = 0; d < dim; d++) {
    double impulse = reduced * (pressed * k->normal[d] + share * slip[d]);
    work += 0.5 * reduced * share * slip[d] * (before[d] + (1 - share) * slip[d]);
    first.vel_new_nc[k->node * dim + d] -= impulse / first.mass_nc[k->node];
    second.vel_new_nc[k->node * dim + d] += impulse / second.mass_nc[k->node];
  }
  return work;
}

static void exchange_all(const struct sim *sim, struct mpm *m)
{
  const struct contact_state *c = m->contact;
  for (long k = 0; k < c->n; k++) {
    double work = exchange(sim, m, &c->meetings[k]);
    m->now.friction += work;
    if (m->heat_source_nc) m->heat_source_nc[c->meetings[k].node] += work;
    m->now.contact += stored(sim, m, &c->meetings[k]);
  }
}

enum status mpm_resolve_contact(struct sim *sim, double dt)
{
  struct mpm                  *m = mpm_of(sim);
  const struct side_condition *sides = m->sides;
  m->now.contact = 0;
  TRY(find_meetings(sim, m, m->contact));
  if (m->contact->n == 0) return OK;
  volume_gradients(sim, m);
  for (long k = 0; k < m->contact->n; k++) set_normal(sim, m->contact, &m->contact->meetings[k]);
  if (sim->scene->contact.detection == DETECT_REACH) find_reach(sim, m);
  exchange_all(sim, m);
  for (int b = 0; b < m->n_bodies; b++) {
    boundary_velocity(&sim->grid, sides, sim->t + dt, m->bodies[b].vel_new_nc);
    boundary_ghosts(&m->kernel_grid, sides, sim->grid.dim, sim->t + dt, m->bodies[b].vel_new_nc);
  }
  return OK;
}
