/* Grains in cells: a cell's grains have one temperature, the mean of its points over their heat capacities. Points take
 * what their cell has gained, so heat goes over exactly. theory 4.12 */
#include "core/parallel.h"
#include "ice/heat.h"
#include "mpm/heat.h"

#include <math.h>
#include <string.h>

/* decay rate of a wave two cells long, 1/s over diffusivity/h2: what cells do not see of held points fades so */
static const double unseen_rate = 9.869604401089358; /* pi2 */

bool heat_has_grains(const struct scene *scene) { return fluid_has_energy(&scene->fluid) && heat_solved(scene); }

/* cell of a point; on the upper end of the grid the last one */
static long cell_of(const struct grid *g, const double *x)
{
  int cell[3] = {0};
  for (int d = 0; d < g->dim; d++) {
    int c = (int)floor((x[d] - g->min[d]) / g->h);
    cell[d] = c < 0 ? 0 : c < g->n[d] ? c : g->n[d] - 1;
  }
  return grid_at(g, cell[0], cell[1], cell[2]);
}

static void clear(const struct grid *g, const struct heat *heat)
{
  const struct heat_phase *p = &heat->phase[1];
  size_t                   n = (size_t)g->size * sizeof(double);
  memset(p->T, 0, n);
  memset(p->capacity, 0, n);
  memset(p->conductivity, 0, n);
  memset(p->share, 0, n);
  memset(heat->exchange, 0, n);
  memset(heat->centre, 0, n * (size_t)g->dim);
}

/* sums over the points of a cell become means; a flux through a side: grains have their share where the pores are full,
 * and all of the medium's where they are dry */
static void average(const struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct heat       *heat = &ice->heat;
  struct heat_phase *p = &heat->phase[1];
  struct box         cells = grid_cells(g);
  double             V = grid_cell_volume(g), H = sim->scene->fluid.heat_exchange;
  FOR_BOX(g, cells, c)
  {
    double medium = p->share[c], wet = ice->wet_cc[c] > 0 ? fmin(1, ice->alpha_cc[c]) : 0, own = p->capacity[c];
    p->T[c] = own > 0 ? p->T[c] / own : ice->T_cc[c];
    p->capacity[c] = own > 0 ? own : 1;
    p->conductivity[c] = heat->held ? p->conductivity[c] / V : 0;
    p->share[c] = heat->held ? medium / V - fmin(wet * ice->porosity_cc[c], medium / V) : 0;
    heat->exchange[c] = own > 0 ? wet * H * medium : 0;
    for (int d = 0; d < g->dim && own > 0; d++) heat->centre[c * g->dim + d] /= own;
  }
}

void heat_grains_gather(const struct sim *sim, struct ice *ice)
{
  const struct mpm  *m = mpm_of(sim);
  const struct grid *g = &sim->grid;
  struct heat_phase *p = &ice->heat.phase[1];
  clear(g, &ice->heat);
  for (long i = 0; i < m->points->n; i++) {
    const struct material *material = scene_material(sim->scene, m->points->group[i]);
    const double          *x = m->x_p + i * g->dim;
    long                   c = cell_of(g, x);
    double                 own = m->mass_p[i] * material->heat_capacity;
    p->capacity[c] += own;
    p->T[c] += own * m->temperature_p[i];
    p->conductivity[c] += m->volume_solid_p[i] * material->conductivity;
    p->share[c] += m->volume_p[i];
    for (int d = 0; d < g->dim; d++) ice->heat.centre[c * g->dim + d] += own * x[d];
  }
  average(sim, ice);
}

/* K/m along an axis, of the grains' temperature with its change, from the neighbours that hold grains */
static double slope(const struct grid *g, const struct heat_phase *p, const double *change, long c, int axis)
{
  double difference = 0;
  int    n = 0;
  for (int high = 0; high < 2; high++) {
    long face = c + high * g->stride[axis], low = face - g->stride[axis];
    if (!(p->conductance[axis * g->size + face] > 0)) continue;
    difference += p->T[face] + change[face] - p->T[low] - change[low];
    n++;
  }
  return n > 0 ? difference / (n * g->h) : 0;
}

void heat_grains_scatter(const struct sim *sim, const struct ice *ice, const double *change, double dt)
{
  const struct mpm        *m = mpm_of(sim);
  const struct grid       *g = &sim->grid;
  const struct heat_phase *p = &ice->heat.phase[1];
  PARALLEL_FOR
  for (long i = 0; i < m->points->n; i++) {
    const struct material *own = scene_material(sim->scene, m->points->group[i]);
    const double          *x = m->x_p + i * g->dim;
    long                   c = cell_of(g, x);
    double                 seen = p->T[c], rate = unseen_rate * own->conductivity / (own->density * own->heat_capacity);
    double                 share = ice->heat.held ? -expm1(-rate * dt / (g->h * g->h)) : 0;
    for (int d = 0; d < g->dim && share > 0; d++)
      seen += (x[d] - ice->heat.centre[c * g->dim + d]) * slope(g, p, change, c, d);
    m->temperature_p[i] += change[c] - share * (m->temperature_p[i] - seen);
  }
}
