/* What every body has at the nodes, and all bodies together. theory 3.4 */
#include "core/memory.h"
#include "core/parallel.h"
#include "mpm/contact.h"
#include "mpm/create.h"
#include "mpm/stages.h"

static struct body_nodes fields_of(struct mpm *m)
{
  return (struct body_nodes){m->mass_nc, m->mom_nc, m->force_nc, m->vel_nc, m->vel_new_nc};
}

static enum status own_arrays(const struct grid *g, struct body_nodes *b)
{
  TRY(NEW(&b->mass_nc, g->size));
  TRY(NEW(&b->mom_nc, g->size * g->dim));
  TRY(NEW(&b->force_nc, g->size * g->dim));
  TRY(NEW(&b->vel_nc, g->size * g->dim));
  return NEW(&b->vel_new_nc, g->size * g->dim);
}

enum status mpm_create_bodies(struct sim *sim, struct mpm *m)
{
  m->n_bodies = sim->scene->n_bodies;
  TRY(NEW(&m->bodies, m->n_bodies));
  m->bodies[0] = fields_of(m);
  if (m->n_bodies == 1 || !m->moves) return OK;
  m->bodies[0].mass_nc = NULL; /* so that a failure here frees nothing that is not a body's own */
  for (int b = 0; b < m->n_bodies; b++) TRY(own_arrays(&sim->grid, &m->bodies[b]));
  return contact_create(sim, m);
}

void mpm_destroy_bodies(struct mpm *m)
{
  for (int b = 0; b < m->n_bodies && m->bodies && m->n_bodies > 1; b++) {
    struct body_nodes *own = &m->bodies[b];
    if (!own->mass_nc) break;
    memory_free(&own->mass_nc);
    memory_free(&own->mom_nc);
    memory_free(&own->force_nc);
    memory_free(&own->vel_nc);
    memory_free(&own->vel_new_nc);
  }
  memory_free(&m->bodies);
  contact_destroy(m);
}

enum status mpm_join_bodies(struct sim *sim, double dt)
{
  (void)dt;
  struct mpm       *m = mpm_of(sim);
  struct body_nodes all = fields_of(m);
  long              size = sim->grid.size, n = size * sim->grid.dim;
  PARALLEL_FOR
  for (long c = 0; c < size; c++) {
    all.mass_nc[c] = 0;
    for (int b = 0; b < m->n_bodies; b++) all.mass_nc[c] += m->bodies[b].mass_nc[c];
  }
  PARALLEL_FOR
  for (long c = 0; c < n; c++) {
    all.mom_nc[c] = all.force_nc[c] = 0;
    for (int b = 0; b < m->n_bodies; b++) {
      all.mom_nc[c] += m->bodies[b].mom_nc[c];
      all.force_nc[c] += m->bodies[b].force_nc[c];
    }
  }
  mpm_velocities(sim, m, &all, sim->t, all.vel_nc);
  return OK;
}

enum status mpm_join_velocities(struct sim *sim, double dt)
{
  (void)dt;
  struct mpm *m = mpm_of(sim);
  int         dim = sim->grid.dim;
  PARALLEL_FOR
  for (long c = 0; c < sim->grid.size; c++)
    for (int d = 0; d < dim; d++) {
      double momentum = 0;
      for (int b = 0; b < m->n_bodies; b++) momentum += m->bodies[b].mass_nc[c] * m->bodies[b].vel_new_nc[c * dim + d];
      m->vel_new_nc[c * dim + d] = m->mass_nc[c] > m->mass_floor ? momentum / m->mass_nc[c] : 0;
    }
  return OK;
}
