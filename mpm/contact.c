/* Contact of bodies: at a node that two bodies share, those that touch and approach exchange momentum, with Coulomb
 * friction. theory 3.4, after Bardenhagen et al. 2001 */
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

struct contact_state {
  struct meeting *meetings; /* [capacity], those of a node stand together */
  long            n, capacity;
  int            *first;       /* [size] a node's first meeting; -1: none */
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
  struct box nodes = boundary_nodes(&sim->grid, sim->scene->solid_side);
  c->n = 0;
  for (long i = 0; i < sim->grid.size; i++) c->first[i] = -1;
  FOR_BOX_SERIAL(&sim->grid, nodes, node) TRY(add_meetings(m, c, node));
  return OK;
}

/* ---- normals ---- */

/* nodes of a point at which its body meets another, with their weights' gradients; returns how many */
static int shared_nodes(const struct sim *sim, const struct mpm *m, long p, long *node, double (*gradient)[3])
{
  long   all[MAX_SUPPORT];
  double w[MAX_SUPPORT], slope[MAX_SUPPORT][3];
  int    n = 0;
  m->kernels->weights(&m->kernel_grid, m->x_p + p * sim->grid.dim, all, w, slope);
  for (int q = 0; q < m->kernels->n_support; q++) {
    if (m->contact->first[all[q]] < 0 || w[q] == 0) continue;
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

/* gradient of every body's volume at shared nodes: it points into the body */
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
        for (int d = 0; d < dim; d++) gradient_nc[node[q] * dim + d] += m->volume_p[p] * slope[q][d];
    }
  }
  for (int b = 0; b < m->n_bodies; b++)
    boundary_fold(&m->kernel_grid, sim->scene->solid_side, dim, m->contact->gradient_nc[b]);
}

/* Out of the first body: the difference of both gradients, or the larger one, which a body that barely reaches the node
 * does not disturb. */
static void set_normal(const struct sim *sim, const struct contact_state *c, struct meeting *k)
{
  int           dim = sim->grid.dim;
  const double *first = c->gradient_nc[k->body[0]] + k->node * dim,
               *second = c->gradient_nc[k->body[1]] + k->node * dim;
  double own = 0, other = 0, length = 0;
  for (int d = 0; d < dim; d++) {
    own += first[d] * first[d];
    other += second[d] * second[d];
  }
  for (int d = 0; d < dim; d++) {
    double difference = second[d] - first[d], larger = own > other ? -first[d] : second[d];
    k->normal[d] = sim->scene->contact.normal == NORMAL_DIFFERENCE ? difference : larger;
    length += k->normal[d] * k->normal[d];
  }
  for (int d = 0; d < dim; d++) k->normal[d] = length > 0 ? k->normal[d] / sqrt(length) : 0;
}

/* ---- reach ---- */

/* half width of a point along n: that of the ellipse its cell of the lattice has become */
static double half_width(const struct sim *sim, const struct mpm *m, long p, const double n[3])
{
  int    dim = sim->grid.dim;
  double square = 0;
  for (int e = 0; e < dim; e++) {
    double along = 0;
    for (int d = 0; d < dim; d++) along += n[d] * m->F_p[(p * dim + d) * dim + e];
    along *= 0.5 * sim->grid.h / sim->scene->numerics.points_per_axis[e];
    square += along * along;
  }
  return sqrt(square);
}

static void extend_reach(const struct sim *sim, const struct mpm *m, long p, int body, struct meeting *k)
{
  double x[3], along = 0, half;
  if (k->body[0] != body && k->body[1] != body) return;
  grid_node(&sim->grid, k->node, x);
  for (int d = 0; d < sim->grid.dim; d++) along += k->normal[d] * (m->x_p[p * sim->grid.dim + d] - x[d]);
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
        for (long k = c->first[node[q]]; k < c->n && c->meetings[k].node == node[q]; k++)
          extend_reach(sim, m, p, sim->scene->solids[group].body, &c->meetings[k]);
    }
  }
}

/* ---- impulses ---- */

/* Momentum that stops the approach goes from the first body to the second, and along the surface at most friction times
 * that. Returns the work lost to friction, J. */
static double exchange(const struct sim *sim, const struct mpm *m, const struct meeting *k)
{
  int     dim = sim->grid.dim;
  double *v[2], mass[2], u[3] = {0}, approach = 0, slide2 = 0;
  for (int side = 0; side < 2; side++) {
    mass[side] = m->bodies[k->body[side]].mass_nc[k->node];
    v[side] = m->bodies[k->body[side]].vel_new_nc + k->node * dim;
  }
  for (int d = 0; d < dim; d++) {
    u[d] = v[0][d] - v[1][d];
    approach += u[d] * k->normal[d];
  }
  if (!(approach > 0)) return 0;
  for (int d = 0; d < dim; d++) slide2 += (u[d] - approach * k->normal[d]) * (u[d] - approach * k->normal[d]);
  double slide = sqrt(slide2), limit = sim->scene->contact.friction * approach;
  double share = slide > limit ? limit / slide : 1, reduced = mass[0] * mass[1] / (mass[0] + mass[1]);
  for (int d = 0; d < dim; d++) {
    double impulse = reduced * (approach * k->normal[d] + share * (u[d] - approach * k->normal[d]));
    v[0][d] -= impulse / mass[0];
    v[1][d] += impulse / mass[1];
  }
  return reduced * share * slide2 * (1 - 0.5 * share);
}

enum { SWEEPS = 10 }; /* where more than two bodies meet */

static void exchange_all(const struct sim *sim, struct mpm *m)
{
  const struct contact_state *c = m->contact;
  bool                        always = sim->scene->contact.detection == DETECT_APPROACH;
  for (long begin = 0, end; begin < c->n; begin = end) {
    for (end = begin + 1; end < c->n && c->meetings[end].node == c->meetings[begin].node;) end++;
    for (int sweep = 0; sweep < (end - begin > 1 ? SWEEPS : 1); sweep++)
      for (long k = begin; k < end; k++)
        if (always || c->meetings[k].reach[0] >= c->meetings[k].reach[1])
          m->now.friction += exchange(sim, m, &c->meetings[k]);
  }
}

enum status mpm_resolve_contact(struct sim *sim, double dt)
{
  struct mpm                  *m = mpm_of(sim);
  const struct side_condition *sides = sim->scene->solid_side;
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
