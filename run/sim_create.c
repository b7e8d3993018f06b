/* From a plan to a simulation that is ready for its first step. */
#include "core/memory.h"
#include "core/parallel.h"
#include "run/plan.h"

#include <math.h>
#include <string.h>

/* number of doubles of a field */
static size_t field_length(const struct sim *sim, const struct field *f)
{
  size_t n = (size_t)(field_components(f, sim->scene) * field_copies(f, sim->scene));
  switch (f->at) {
  case AT_NODE:
  case AT_CELL:
    return n * (size_t)sim->grid.size;
  case AT_FACE:
    return n * (size_t)(sim->grid.size * sim->grid.dim);
  case AT_SOLID:
    return n * (size_t)(sim->points[SET_SOLID] ? sim->points[SET_SOLID]->n : 0);
  case AT_WATER:
    return n * (size_t)(sim->points[SET_WATER] ? sim->points[SET_WATER]->n : 0);
  case AT_MARKER:
    return n * (size_t)sim->n_markers;
  }
  return 0;
}

static double **field_pointer(const struct field *f, void *state) { return (double **)((char *)state + f->offset); }

static enum status create_states(const struct plan *plan, struct sim *sim)
{
  TRY(NEW(&sim->states, plan->n_modules));
  for (int i = 0; i < plan->n_modules; i++) {
    const struct module *m = plan->modules[i];
    TRY(memory_new(1, m->state_size, &sim->states[i]));
    for (int f = 0; f < m->n_fields; f++)
      if (plan_uses(plan, m->fields[f].name))
        TRY(memory_new(field_length(sim, &m->fields[f]), sizeof(double), field_pointer(&m->fields[f], sim->states[i])));
  }
  return OK;
}

enum status sim_count_points(const struct scene *scene, const struct plan *plan, long n[N_COUNTS], int groups[N_SETS])
{
  for (int s = 0; s < N_COUNTS; s++) n[s] = 0;
  for (int s = 0; s < N_SETS; s++) groups[s] = 1;
  for (int i = 0; i < plan->n_modules; i++)
    if (plan->modules[i]->count) TRY(plan->modules[i]->count(scene, n, groups));
  return OK;
}

static enum status create_points(const struct scene *scene, const struct plan *plan, struct sim *sim)
{
  long n[N_COUNTS];
  int  groups[N_SETS];
  TRY(sim_count_points(scene, plan, n, groups));
  sim->n_markers = (int)n[COUNT_MARKERS];
  int most = scene->dim == 3 ? 9 : 6; /* components of a field: a matrix, a symmetric one */
  if (scene->n_history > most) most = scene->n_history;
  for (int s = 0; s < N_SETS; s++)
    if (n[s] > 0) TRY(points_create(&sim->grid, n[s], groups[s], most, &sim->points[s]));
  return OK;
}

static void create_grid(const struct scene *scene, struct grid *grid)
{
  bool periodic[3];
  for (int d = 0; d < 3; d++)
    periodic[d] = scene->solid_side[2 * d].kind == SIDE_PERIODIC || scene->fluid_side[2 * d].kind == SIDE_PERIODIC;
  grid_create(scene->dim, scene->min, scene->cells, scene->h, periodic, grid);
}

size_t sim_field_bytes(const struct scene *scene, const struct plan *plan)
{
  struct sim    sim = {.scene = scene};
  struct points sets[N_SETS] = {{0}};
  long          n[N_COUNTS];
  int           groups[N_SETS];
  size_t        bytes = 0;
  create_grid(scene, &sim.grid);
  if (sim_count_points(scene, plan, n, groups) != OK) return 0;
  sim.n_markers = (int)n[COUNT_MARKERS];
  for (int s = 0; s < N_SETS; s++) {
    sets[s].n = n[s];
    sim.points[s] = &sets[s];
  }
  for (int i = 0; i < plan->n_modules; i++)
    for (int f = 0; f < plan->modules[i]->n_fields; f++)
      if (plan_uses(plan, plan->modules[i]->fields[f].name))
        bytes += sizeof(double) * field_length(&sim, &plan->modules[i]->fields[f]);
  return bytes;
}

enum status sim_create(const struct scene *scene, const struct plan *plan, struct sim **out)
{
  struct sim *sim;
  TRY(NEW(&sim, 1));
  *out = sim;
  sim->scene = scene;
  sim->modules = plan->modules;
  sim->n_modules = plan->n_modules;
  create_grid(scene, &sim->grid);
  TRY(create_points(scene, plan, sim));
  TRY(create_states(plan, sim));
  for (int i = 0; i < plan->n_modules; i++)
    if (plan->modules[i]->create) TRY(plan->modules[i]->create(sim, sim->states[i]));
  sim_measure(sim, &sim->ledger_start);
  sim->ledger = sim->ledger_start;
  return OK;
}

static void destroy_states(struct sim *sim)
{
  for (int i = 0; i < sim->n_modules && sim->states[i]; i++) {
    const struct module *m = sim->modules[i];
    if (m->destroy) m->destroy(sim->states[i]);
    for (int f = 0; f < m->n_fields; f++) memory_free(field_pointer(&m->fields[f], sim->states[i]));
    memory_free(&sim->states[i]);
  }
}

void sim_destroy(struct sim **out)
{
  struct sim *sim = *out;
  if (!sim) return;
  if (sim->states) destroy_states(sim);
  memory_free(&sim->states);
  for (int s = 0; s < N_SETS; s++) points_destroy(&sim->points[s]);
  memory_free(out);
}

void sim_poison(struct sim *sim)
{
  for (int i = 0; i < sim->n_modules && FIELD_POISON; i++)
    for (int f = 0; f < sim->modules[i]->n_fields; f++) {
      const struct field *field = &sim->modules[i]->fields[f];
      double             *values = *field_pointer(field, sim->states[i]);
      if (field->kind != SCRATCH || !values) continue;
      for (size_t q = 0; q < field_length(sim, field); q++) values[q] = NAN;
    }
}

double sim_dt_limit(struct sim *sim, const struct plan *plan, const char **by)
{
  double natural = INFINITY;
  *by = "numerics.dt_max";
  for (int i = 0; i < plan->n_stages; i++) {
    if (!plan->stages[i]->dt_limit) continue;
    double own = plan->stages[i]->dt_limit(sim);
    if (own >= natural) continue;
    natural = own;
    *by = plan->stages[i]->name;
  }
  sim->dt_limit = natural / sim->scene->numerics.dt_factor;
  if (natural <= sim->scene->numerics.dt_max) return natural;
  *by = "numerics.dt_max";
  return sim->scene->numerics.dt_max;
}

void sim_measure(const struct sim *sim, struct ledger *ledger)
{
  *ledger = (struct ledger){{0}};
  for (int i = 0; i < sim->n_modules; i++)
    if (sim->modules[i]->measure) sim->modules[i]->measure(sim, ledger);
}
