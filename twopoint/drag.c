/* Drag coefficient of every node, for the slip at the end of the step. theory_twopoint 5 */
#include "twopoint/twopoint.h"

#include "core/parallel.h"
#include "coupling/coupling.h"
#include "mpm/mpm.h"

#include <math.h>
#include <string.h>

static const double least_porosity = 0.02; /* of a medium, as on every path */

/* what a law must know of a stretch of nodes */
struct stretch {
  double porosity[WATER_BATCH], fill[WATER_BATCH], medium[WATER_BATCH], slip[WATER_BATCH], permeability[WATER_BATCH],
      diameter[WATER_BATCH];
  double volume[WATER_BATCH];  /* m3, of the space that meets water */
  double inverse[WATER_BATCH]; /* 1/kg: 1/m_s + 1/m_f */
};

static double star_slip(const struct twopoint *w, int dim, long node)
{
  double square = 0;
  for (int d = 0; d < dim; d++) {
    double slip = (w->mpm ? w->solid_star_nc[node * dim + d] : 0) - w->water_star_nc[node * dim + d];
    square += slip * slip;
  }
  return sqrt(square);
}

static void medium_at(const struct coupling *c, long node, double *permeability, double *diameter)
{
  double bulk = c->bulk_nc[node];
  *permeability = c->permeability;
  *diameter = c->diameter;
  if (!c->several_media) return;
  *permeability = c->conductance_nc[node] > 0 ? bulk / c->conductance_nc[node] : 0;
  *diameter = c->fineness_nc[node] > 0 ? sqrt(bulk / c->fineness_nc[node]) : 0;
}

/* entry i of the stretch. Where water fills only part of the skeleton only that part resists: V_f/V_s at most one */
static void describe_node(const struct sim *sim, const struct twopoint *w, long node, int i, struct stretch *s)
{
  const struct coupling *c = w->coupling;
  double                 bulk = c->bulk_nc[node], mass = w->water_mass_nc[node];
  bool                   meets = bulk > 0 && mass > w->mass_floor && twopoint_shares(w, node);
  bool                   moves = w->mpm && w->mpm->mass_nc[node] > w->mpm->mass_floor;
  s->porosity[i] = w->porosity_nc[node];
  s->fill[i] = meets ? bulk / c->room_nc[node] : 0;
  s->medium[i] = meets ? fmax(least_porosity, 1 - c->solid_nc[node] / bulk) : 1;
  s->slip[i] = meets ? star_slip(w, sim->grid.dim, node) : 0;
  s->volume[i] = meets ? c->room_nc[node] * fmin(1, w->water_volume_nc[node] / bulk) : 0;
  s->inverse[i] = (moves ? 1 / w->mpm->mass_nc[node] : 0) + (meets ? 1 / mass : 0);
  medium_at(c, node, &s->permeability[i], &s->diameter[i]);
}

/* D(x) = D0 + (D1 - D0) x/r, slip x at the end of the step from r without drag: x + dt s D(x) x = r, s = 1/m_s + 1/m_f.
 * Exact where K is linear in the slip (Darcy, Kozeny-Carman, Ergun), a chord for others */
static double implicit_coefficient(double D0, double D1, double r, double s, double dt)
{
  if (!(r > 0)) return D0;
  double slope = (D1 - D0) / r, linear = 1 + dt * s * D0;
  double x = 2 * r / (linear + sqrt(linear * linear + 4 * dt * s * slope * r));
  return D0 + slope * x;
}

static void resist_stretch(const struct sim *sim, struct twopoint *w, long first, int n, double dt)
{
  struct stretch s;
  double         still[WATER_BATCH] = {0}, K0[WATER_BATCH], K1[WATER_BATCH];
  for (int i = 0; i < n; i++) describe_node(sim, w, first + i, i, &s);
  coupling_drag(sim->scene, &sim->scene->fluid, n, s.porosity, s.fill, s.medium, still, s.permeability, s.diameter, K0);
  coupling_drag(sim->scene, &sim->scene->fluid, n, s.porosity, s.fill, s.medium, s.slip, s.permeability, s.diameter,
                K1);
  for (int i = 0; i < n; i++)
    w->drag_nc[first + i] =
        s.volume[i] > 0 ? implicit_coefficient(s.volume[i] * K0[i], s.volume[i] * K1[i], s.slip[i], s.inverse[i], dt)
                        : 0;
}

enum status twopoint_resist_nodes(struct sim *sim, double dt)
{
  struct twopoint   *w = twopoint_of(sim);
  const struct grid *g = &sim->grid;
  struct box         nodes = grid_nodes(g);
  int                length = box_length(&nodes);
  twopoint_clear(sim, 1, w->drag_nc);
  PARALLEL_FOR
  for (long r = 0; r < box_rows(&nodes); r++)
    for (int i = 0; i < length; i += WATER_BATCH)
      resist_stretch(sim, w, box_row(g, &nodes, r) + i, length - i < WATER_BATCH ? length - i : WATER_BATCH, dt);
  return OK;
}
