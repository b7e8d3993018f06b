/* A liquid that goes where it is told: the scene's velocity at faces carries its mass, nothing else happens.
 * theory 4.16 */
#include "ice/ice.h"

#include "core/parallel.h"

#include <math.h>

/* mean of the velocity over a face: three Gauss points along each axis across it */
static double mean_over_face(const struct sim *sim, int axis, long f)
{
  static const double place[3] = {-0.3872983346207417, 0, 0.3872983346207417},
                      weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  const struct grid *g = &sim->grid;
  int                t = (axis + 1) % g->dim, u = 3 - axis - t;
  double             centre[3], x[3], sum = 0;
  grid_face(g, f, axis, centre);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < (g->dim == 3 ? 3 : 1); j++) {
      for (int d = 0; d < 3; d++) x[d] = centre[d];
      x[t] += place[i] * g->h;
      if (g->dim == 3) x[u] += place[j] * g->h;
      sum += weight[i] * (g->dim == 3 ? weight[j] : 1) * function_value(&sim->scene->fluid.velocity[axis], x, 0);
    }
  return sum;
}

void ice_create_prescribed(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    FOR_BOX_SERIAL(g, faces, f)
    {
      double *u = &ice->water_fc[axis * g->size + f];
      if (ice->kind[axis * g->size + f] == FACE_CLOSED) continue;
      *u = mean_over_face(sim, axis, f);
      ice->now.speed = fmax(ice->now.speed, fabs(*u));
    }
  }
}

/* how far cells are filled beyond their room, or emptied below nothing */
static void watch(struct sim *sim, struct ice *ice)
{
  struct box cells = grid_cells(&sim->grid);
  double     most = 0;
  FOR_BOX_SERIAL(&sim->grid, cells, c) most = fmax(most, fmax(ice->alpha_cc[c] - 1, -ice->alpha_cc[c]));
  ice->now.defect_max = most;
  sim->defect_max = fmax(sim->defect_max, most);
}

static void gather_mass(struct sim *sim, struct ice *ice, int axis)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  const double      *liquid = ice->liquid_fc + axis * g->size, V = grid_cell_volume(g);
  FOR_BOX(g, cells, c) ice->mass_cc[c] -= V * ice->rho_cc[c] * (liquid[c + g->stride[axis]] - liquid[c]);
  grid_fill_periodic(g, 1, ice->mass_cc);
}

enum status ice_carry_prescribed(struct sim *sim, double dt)
{
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  const double       origin[3] = {0, 0, 0};
  double             strength = function_value(&sim->scene->fluid.strength, origin, sim->t + 0.5 * dt);
  if (!(fabs(strength) <= 1))
    return FAIL(ERR_INPUT, "fluid.strength: %g at t = %g s; keep it between -1 and 1 and make fluid.velocity larger",
                strength, sim->t + 0.5 * dt);
  watch(sim, ice);
  ice_open_rooms(sim, ice);
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    FOR_BOX(g, faces, f) ice->carried_fc[axis * g->size + f] = strength * ice->water_fc[axis * g->size + f];
  }
  ice_fill_faces(sim, ice->carried_fc);
  plic_begin(&ice->plic, ice->alpha_cc);
  for (int i = 0; i < g->dim; i++) {
    int  axis = plic_axis(g, sim->step, i);
    long base = axis * g->size;
    plic_sweep(&ice->plic, axis, dt, ice->carried_fc + base, ice->alpha_cc, ice->liquid_fc + base);
    gather_mass(sim, ice, axis);
  }
  return OK;
}

/* half a cell in a step */
double ice_prescribed_dt(const struct sim *sim)
{
  double speed = ice_of(sim)->now.speed;
  return speed > 0 ? 0.5 * sim->grid.h / speed : INFINITY;
}
