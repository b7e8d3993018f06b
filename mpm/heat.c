/* Heat of the solid. Temperature lives on the points and moves with them; nodes conduct. Points take what changed at
 * the nodes, so that nothing is smeared where nothing flows, and what the nodes do not see of them fades as the
 * shortest wave that nodes carry would. theory 3.8 */
#include "mpm/heat.h"

#include "constitutive/constitutive.h"
#include "core/memory.h"
#include "core/parallel.h"

#include <math.h>
#include <string.h>

/* m2/s; porosity thins conductivity and capacity alike */
static double diffusivity(const struct material *m) { return m->conductivity / (m->density * m->heat_capacity); }

bool heat_solved(const struct scene *scene)
{
  for (int s = 0; s < scene->n_solids; s++)
    if (scene_material(scene, s)->heat_capacity > 0) return true;
  return false;
}

bool heat_flows(const struct scene *scene)
{
  bool conducts = false;
  for (int s = 0; s < scene->n_solids; s++) conducts = conducts || scene_material(scene, s)->conductivity > 0;
  if (fluid_has_energy(&scene->fluid) && !mpm_solid_moves(scene)) return false;
  return heat_solved(scene) && (conducts || (mpm_solid_moves(scene) && scene->n_bodies > 1));
}

enum status mpm_create_heat(struct sim *sim, struct mpm *m)
{
  int dim = sim->grid.dim;
  m->heat_grid = m->kernel_grid;
  memset(m->heat_grid.modified, 0, sizeof m->heat_grid.modified);
  TRY(NEW(&m->run_heat, m->points->n_runs));
  for (long p = 0; p < m->points->n && m->temperature_p; p++) {
    const struct solid *solid = &sim->scene->solids[m->points->group[p]];
    double              x[3] = {0};
    memcpy(x, m->x_p + p * dim, (size_t)dim * sizeof *x);
    m->temperature_p[p] = function_value(&solid->temperature, x, 0);
    if (!(m->temperature_p[p] > 0))
      return FAIL(ERR_INPUT, "solids.%s.temperature: %g at (%g, %g, %g) is not above 0; give it in K", solid->name,
                  m->temperature_p[p], x[0], x[1], x[2]);
  }
  return OK;
}

static void clear(const struct sim *sim, double *field) { memset(field, 0, (size_t)sim->grid.size * sizeof *field); }

/* With hats a point on a node gives the next one no weight but feels it in its gradient: an empty node takes the
 * temperature of the one before it. */
static void fill_empty(const struct sim *sim, const struct mpm *m)
{
  const struct grid *g = &sim->grid;
  struct box         nodes = boundary_nodes(g, sim->scene->solid_side);
  FOR_BOX_SERIAL(g, nodes, c)
  for (int d = 0; d < g->dim && !(m->capacity_nc[c] > 0); d++)
    if (m->capacity_nc[c - g->stride[d]] > 0) {
      m->temperature_nc[c] = m->temperature_nc[c - g->stride[d]];
      break;
    }
}

enum status mpm_heat_to_nodes(struct sim *sim, double dt)
{
  struct mpm        *m = mpm_of(sim);
  const struct grid *g = &sim->grid;
  struct box         all = grid_all(g);
  clear(sim, m->capacity_nc);
  clear(sim, m->temperature_nc);
  FOR_RUNS(m->points, g, run, group)
  {
    double              c = scene_material(sim->scene, group)->heat_capacity;
    struct scatter_args args = {.n = 2,
                                .factor = {c, c},
                                .x = m->x_p,
                                .weight = m->mass_p,
                                .value = {NULL, m->temperature_p},
                                .node = {m->capacity_nc, m->temperature_nc}};
    m->kernels->scatter(&m->heat_grid, &run, &args);
  }
  heat_lift(sim, m, sim->t + dt);
  heat_reflect(sim, m, sim->t + dt, m->capacity_nc, m->temperature_nc);
  boundary_fold(&m->heat_grid, sim->scene->solid_side, 1, m->capacity_nc);
  boundary_fold(&m->heat_grid, sim->scene->solid_side, 1, m->temperature_nc);
  FOR_BOX(g, all, c) m->temperature_nc[c] = m->capacity_nc[c] > 0 ? m->temperature_nc[c] / m->capacity_nc[c] : 0;
  if (m->kernels->basis == BASIS_LINEAR) fill_empty(sim, m);
  heat_bound(sim, m, sim->t + dt, false, m->temperature_nc);
  return OK;
}

/* decay rate of a wave two cells long, 1/s over diffusivity/h2: what nodes do not see fades so */
static const double unseen_rate = 9.869604401089358; /* pi2 */

/* Points [begin, end) of one material: unseen_p comes as the nodes' temperature, heat_flow_p as its gradient. */
static void split_heat(struct mpm *m, const struct kernel_run *run, int dim, double alpha, double dt, double h)
{
  double share = -expm1(-unseen_rate * alpha * dt / (h * h));
  for (long p = run->begin; p < run->end; p++) m->unseen_p[p] = share * (m->temperature_p[p] - m->unseen_p[p]);
  for (long q = run->begin * dim; q < run->end * dim; q++) m->heat_flow_p[q] *= -alpha * dt;
}

/* heat_nc = sum m c [w unseen - dt alpha grad w . grad T] */
enum status mpm_conduct_heat(struct sim *sim, double dt)
{
  struct mpm        *m = mpm_of(sim);
  struct gather_args gather = {
      .n = 1, .x = m->x_p, .node = {m->temperature_nc}, .value = {m->unseen_p}, .gradient = {m->heat_flow_p}};
  clear(sim, m->heat_nc);
  m->heat_given = 0;
  FOR_RUNS(m->points, &sim->grid, run, group)
  {
    const struct material *material = scene_material(sim->scene, group);
    struct scatter_args    scatter = {.n = 1,
                                      .factor = {material->heat_capacity},
                                      .x = m->x_p,
                                      .weight = m->mass_p,
                                      .value = {m->unseen_p},
                                      .flux = {m->heat_flow_p},
                                      .node = {m->heat_nc}};
    m->kernels->gather(&m->heat_grid, &run, &gather);
    split_heat(m, &run, sim->grid.dim, diffusivity(material), dt, sim->grid.h);
    m->kernels->scatter(&m->heat_grid, &run, &scatter);
  }
  return OK;
}

enum status mpm_clear_heat_source(struct sim *sim, double dt)
{
  (void)dt;
  clear(sim, mpm_of(sim)->heat_source_nc);
  return OK;
}

static void take_sources(const struct sim *sim, struct mpm *m)
{
  struct box nodes = boundary_nodes(&sim->grid, sim->scene->solid_side);
  FOR_BOX_SERIAL(&sim->grid, nodes, c)
  {
    m->heat_nc[c] += m->heat_source_nc[c];
    m->heat_given += m->heat_source_nc[c];
  }
}

enum status mpm_warm_nodes(struct sim *sim, double dt)
{
  struct mpm        *m = mpm_of(sim);
  const struct grid *g = &sim->grid;
  struct box         all = grid_all(g);
  heat_reflect(sim, m, sim->t + dt, NULL, m->heat_nc);
  boundary_fold(&m->heat_grid, sim->scene->solid_side, 1, m->heat_nc);
  if (m->heat_source_nc) take_sources(sim, m);
  FOR_BOX(g, all, c) m->warming_nc[c] = m->capacity_nc[c] > 0 ? m->heat_nc[c] / m->capacity_nc[c] : 0;
  heat_bound(sim, m, sim->t + dt, true, m->warming_nc);
  return OK;
}

/* a run's points take the change of the nodes and lose what went there; returns the heat they gained, J */
static double warm_points(struct mpm *m, long begin, long end, double heat_capacity)
{
  double heat = 0;
  for (long p = begin; p < end; p++) {
    double change = m->warming_p[p] - m->unseen_p[p];
    m->temperature_p[p] += change;
    heat += m->mass_p[p] * heat_capacity * change;
  }
  return heat;
}

/* What points gained beyond fluxes and sources came through sides of given temperature. */
enum status mpm_heat_to_points(struct sim *sim, double dt)
{
  (void)dt;
  struct mpm          *m = mpm_of(sim);
  const struct points *points = m->points;
  struct gather_args   gather = {.n = 1, .x = m->x_p, .node = {m->warming_nc}, .value = {m->warming_p}};
  double               gained = 0;
  FOR_RUNS(points, &sim->grid, run, group) m->kernels->gather(&m->heat_grid, &run, &gather);
  PARALLEL_FOR_DYNAMIC
  for (long r = 0; r < points->n_runs; r++)
    m->run_heat[r] = warm_points(m, points->start[r], points->start[r + 1],
                                 scene_material(sim->scene, (int)(r % points->n_groups))->heat_capacity);
  for (long r = 0; r < points->n_runs; r++) gained += m->run_heat[r];
  if (heat_has_side(sim->scene, HEAT_TEMPERATURE)) m->now.heat_sides += gained - m->heat_given;
  return OK;
}

/* plastic work of the step, heat_p per present volume */
enum status mpm_heat_by_work(struct sim *sim, double dt)
{
  (void)dt;
  struct mpm          *m = mpm_of(sim);
  const struct points *points = m->points;
  PARALLEL_FOR
  for (long r = 0; r < points->n_runs; r++) {
    const struct material *own = scene_material(sim->scene, (int)(r % points->n_groups));
    if (own->model->n_history == 0) continue;
    for (long p = points->start[r]; p < points->start[r + 1]; p++)
      m->temperature_p[p] += own->work_to_heat * m->heat_p[p] * m->volume_p[p] / (m->mass_p[p] * own->heat_capacity);
  }
  return OK;
}

/* The step of explicit conduction, dt <= 2 h2/(s alpha), s the largest eigenvalue, over diffusivity/h2, of the map from
 * points to nodes and back: the largest found over regular, displaced and random points in 1 to 3 dimensions, rounded
 * up. A hat's gradient does not fade towards its end, so with hats light points under a heavy body's gradient count. */
double mpm_heat_dt(const struct sim *sim)
{
  static const double s[] = {[BASIS_LINEAR] = 4, [BASIS_GIMP] = 2, [BASIS_QUADRATIC] = 1.25, [BASIS_CUBIC] = 0.9};
  const struct scene *scene = sim->scene;
  enum basis          basis = mpm_of(sim)->kernels->basis;
  double              largest = 0, conductivity = 0, capacity = INFINITY;
  for (int i = 0; i < scene->n_solids; i++) {
    const struct material *m = scene_material(scene, i);
    largest = fmax(largest, diffusivity(m));
    conductivity = fmax(conductivity, (1 - m->porosity) * m->conductivity);
    capacity = fmin(capacity, (1 - m->porosity) * m->density * m->heat_capacity);
  }
  if (basis == BASIS_LINEAR) largest = scene->dim * conductivity / capacity;
  return scene->numerics.dt_factor * 2 * scene->h * scene->h / (s[basis] * largest);
}
