/* Volume fractions of the skeleton at nodes, cells and faces. theory 2.1 */
#include "coupling/stages.h"

#include "core/parallel.h"
#include "mpm/walls.h"

#include <float.h>
#include <math.h>
#include <string.h>

static void clear(const struct grid *g, double *field) { memset(field, 0, (size_t)g->size * sizeof *field); }

/* a held skeleton is measured in the first step only */
static bool known(const struct sim *sim) { return sim->step > 0 && !mpm_solid_moves(sim->scene); }

/* what points gave goes to owned nodes; ghosts show it: faces on a periodic axis look there */
static void fold(const struct sim *sim, double *field)
{
  const struct kernel_grid *kg = &mpm_of(sim)->kernel_grid;
  boundary_fold(kg, sim->scene->solid_side, 1, field);
  boundary_ghosts(kg, sim->scene->solid_side, 1, sim->t, field);
}

/* grains and skeleton volumes of the points, gathered at nodes */
static void gather_volumes(struct sim *sim, struct coupling *c)
{
  const struct mpm   *m = mpm_of(sim);
  struct scatter_args args = {
      .n = 2, .x = m->x_p, .value = {m->volume_solid_p, m->volume_p}, .node = {c->solid_nc, c->bulk_nc}};
  clear(&sim->grid, c->solid_nc);
  clear(&sim->grid, c->bulk_nc);
  FOR_RUNS(m->points, &sim->grid, run, group) m->kernels->scatter(&m->kernel_grid, &run, &args);
  fold(sim, c->solid_nc);
  fold(sim, c->bulk_nc);
}

/* whether an obstacle may be elsewhere than a step ago */
static bool rooms_change(const struct scene *scene)
{
  bool change = false;
  for (int i = 0; i < scene->n_obstacles; i++) {
    const struct obstacle *o = &scene->obstacles[i];
    change = change || o->from > 0 || (o->until > 0 && o->until < scene->time_end);
    for (int d = 0; d < scene->dim; d++) change = change || o->velocity[d].expression || o->velocity[d].constant != 0;
  }
  return change;
}

void coupling_find_rooms(const struct sim *sim, struct coupling *c, double t)
{
  const struct mpm *m = mpm_of(sim);
  if (m->walls && sim->scene->n_obstacles > 0) walls_find_rooms(sim, m, t, c->solid_nc, c->room_nc);
}

enum status coupling_gather_volumes(struct sim *sim, double dt)
{
  (void)dt;
  struct coupling *c = coupling_of(sim);
  if (known(sim)) return OK;
  if (rooms_change(sim->scene)) coupling_find_rooms(sim, c, sim->t);
  gather_volumes(sim, c);
  return OK;
}

/* several media: what drag laws need is averaged over the skeleton as 1/permeability and 1/diameter2 */
enum status coupling_gather_media(struct sim *sim, double dt)
{
  (void)dt;
  struct coupling  *c = coupling_of(sim);
  const struct mpm *m = mpm_of(sim);
  if (known(sim)) return OK;
  clear(&sim->grid, c->conductance_nc);
  clear(&sim->grid, c->fineness_nc);
  FOR_RUNS(m->points, &sim->grid, run, group)
  {
    const struct material *material = scene_material(sim->scene, group);
    double                 kappa = coupling_permeability(sim->scene, material), D = material->grain_diameter;
    struct scatter_args    args = {
           .n = 2, .x = m->x_p, .weight = m->volume_p, .node = {c->conductance_nc, c->fineness_nc}};
    args.factor[0] = kappa > 0 ? 1 / kappa : DBL_MIN;
    args.factor[1] = D > 0 ? 1 / (D * D) : DBL_MIN;
    m->kernels->scatter(&m->kernel_grid, &run, &args);
  }
  fold(sim, c->conductance_nc);
  fold(sim, c->fineness_nc);
  return OK;
}

/* mean of a nodal quantity over the nodes at `offset` */
static inline double node_mean(const double *q, long at, int n, const long *offset)
{
  double sum = 0;
  for (int i = 0; i < n; i++) sum += q[at + offset[i]];
  return sum / n;
}

/* below this a node holds nothing worth a division */
static const double least_filled = 1e-9;

static double filled_share(double skeleton, double fluid) { return fmax(least_filled, fmin(1, fmax(skeleton, fluid))); }

/* Grains and skeleton per *filled* room: where soil and water end together at a surface, half of the node's room is
 * void and belongs to neither. Over the whole room the pore water would weigh too much there (1 % of the load is lost
 * per cell of the column). The grains that functions carry past the surface are replaced by water inside, so that the
 * weight is whole; the medium has no gap there. On a periodic axis the last plane copies the first. */
static void node_fractions(struct sim *sim, struct coupling *c)
{
  const struct mpm  *m = mpm_of(sim);
  const struct grid *g = &sim->grid;
  struct box         nodes = grid_nodes(g);
  FOR_BOX(g, nodes, n)
  {
    double skeleton = c->bulk_nc[n] / c->room_nc[n];
    c->grains_share_nc[n] = c->solid_nc[n] / (c->room_nc[n] * filled_share(skeleton, c->fluid_fill_nc[n]));
    c->fill_nc[n] = skeleton / filled_share(skeleton, c->fluid_reach_nc[n]);
  }
  boundary_ghosts(&m->kernel_grid, sim->scene->solid_side, 1, sim->t, c->grains_share_nc);
  boundary_ghosts(&m->kernel_grid, sim->scene->solid_side, 1, sim->t, c->fill_nc);
}

/* what remains for the fluid even where points crowd together */
static const double least_porosity = 0.02;

static void cell_fractions(struct sim *sim, struct coupling *c)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  long               offset[8];
  int                n = grid_node_offsets(g, -1, offset);
  FOR_BOX(g, cells, i) c->porosity_cc[i] = fmax(least_porosity, 1 - node_mean(c->grains_share_nc, i, n, offset));
  grid_fill_periodic(g, 1, c->porosity_cc);
}

/* mean over nodes of the grains in the skeleton that fill_nc counts */
static inline double grains_of_fill(const struct coupling *c, long at, int n, const long *offset)
{
  double sum = 0;
  for (int i = 0; i < n; i++) {
    long node = at + offset[i];
    if (c->fill_nc[node] > 0) sum += c->fill_nc[node] * c->solid_nc[node] / c->bulk_nc[node];
  }
  return sum / n;
}

/* the medium's own porosity is grains over skeleton: a half-filled face has half the resistance, not that of a loose
 * soil */
static void face_fractions(struct sim *sim, struct coupling *c, int axis)
{
  const struct grid *g = &sim->grid;
  struct box         faces = grid_faces(g, axis);
  long               offset[8];
  int                n = grid_node_offsets(g, axis, offset);
  double            *porosity = c->porosity_fc + axis * g->size, *fill = c->fill_fc + axis * g->size,
         *medium = c->medium_porosity_fc + axis * g->size;
  FOR_BOX(g, faces, f)
  {
    double grains = node_mean(c->grains_share_nc, f, n, offset), bulk = node_mean(c->fill_nc, f, n, offset);
    porosity[f] = fmax(least_porosity, 1 - grains);
    fill[f] = bulk;
    medium[f] = bulk > 0 ? fmax(least_porosity, 1 - grains_of_fill(c, f, n, offset) / bulk) : 1;
  }
}

enum status coupling_fill_cells(struct sim *sim, double dt)
{
  (void)dt;
  struct coupling *c = coupling_of(sim);
  if (known(sim)) return OK;
  node_fractions(sim, c);
  cell_fractions(sim, c);
  for (int axis = 0; axis < sim->grid.dim; axis++) face_fractions(sim, c, axis);
  return OK;
}

enum status coupling_push_solid(struct sim *sim, double dt)
{
  struct coupling   *c = coupling_of(sim);
  struct mpm        *m = mpm_of(sim);
  const struct grid *g = &sim->grid;
  struct box         nodes = grid_nodes(g);
  int                dim = g->dim;
  FOR_BOX(g, nodes, n)
  for (int d = 0; d < dim; d++) m->force_nc[n * dim + d] += c->dmom_nc[n * dim + d] / dt;
  return OK;
}
