/* What several fluids carry through a face: the first as its planes say, the others what is left of the flux.
 * theory 4.15 */
#include "ice/advect.h"

#include "core/parallel.h"

#include <math.h>

/* share of fluid k among the fluids beside the first, at the start of the step */
static double share_of_rest(const struct grid *g, const struct ice *ice, int k, long c)
{
  double all = 0;
  if (ice->n_fluids == 2) return 1;
  for (int j = 1; j < ice->n_fluids; j++) all += ice->alpha_cc[j * g->size + c];
  return all > 0 ? ice->alpha_cc[k * g->size + c] / all : 0;
}

double ice_mass_of_rest(const struct grid *g, const struct ice *ice, int k, long from, double volume)
{
  long own = k * g->size + from;
  return fmin(volume * share_of_rest(g, ice, k, from) * ice->rho_cc[own], fmax(0, ice->mass_cc[own]));
}

static void pass_masses(struct sim *sim, struct ice *ice, int axis, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         faces = grid_faces(g, axis);
  long               base = axis * g->size, st = g->stride[axis], copy = g->size * g->dim;
  double             V = grid_cell_volume(g), r = dt / g->h;
  FOR_BOX(g, faces, f)
  {
    long   q = base + f, from = ice->carried_fc[q] > 0 ? f - st : f;
    double sign = ice->carried_fc[q] > 0 ? 1 : -1, liquid = fabs(ice->liquid_fc[q]);
    double rest = fmax(0, fmin(r * fabs(ice->carried_fc[q]), ice->pore_cc[from]) - liquid);
    ice->passed_fc[q] = sign * fmin(liquid * V * ice->rho_cc[from], fmax(0, ice->mass_cc[from]));
    for (int k = 1; k < ice->n_fluids; k++)
      ice->passed_fc[k * copy + q] = rest > 0 ? sign * ice_mass_of_rest(g, ice, k, from, rest * V) : 0;
  }
}

/* momentum that goes with the masses through a face, kg m/s */
static void pass_momentum(const struct sim *sim, const struct ice *ice, int axis, long f, double dt, double *through)
{
  const struct grid *g = &sim->grid;
  long               q = axis * g->size + f, from = ice->carried_fc[q] > 0 ? f - g->stride[axis] : f;
  double             V = grid_cell_volume(g), mass = 0;
  for (int k = 0; k < ice->n_fluids; k++) mass += ice->passed_fc[k * g->dim * g->size + q];
  bool   given = ice->kind[q] == FACE_INLET, smooth = mass != 0 && advect_is_smooth(g, ice, axis, f);
  double number = smooth ? dt * fabs(ice->carried_fc[q]) / (g->h * ice->pore_cc[from]) : 0;
  double coming =
      smooth ? (0.5 - sim->scene->numerics.theta) * dt * V / g->h * ice->trend_fc[q] * ice->mixture_cc[from] : 0;
  for (int d = 0; d < g->dim; d++) {
    through[d] = 0;
    if (mass == 0) continue;
    if (given)
      through[d] = mass * ice_inlet_velocity(sim, axis, d, f, sim->t);
    else if (smooth)
      through[d] = (mass + coming) * advect_leaving_velocity(sim, ice, axis, from, mass > 0, d, number);
    else
      through[d] = mass * ice->vel_cc[from * g->dim + d];
  }
}

/* masses and velocities after a sweep */
static void gather(struct sim *sim, struct ice *ice, int axis)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  int                dim = g->dim;
  long               copy = dim * g->size, base = axis * g->size, st = g->stride[axis];
  FOR_BOX(g, cells, c)
  {
    double before = ice_cell_mass(g, ice, c);
    for (int k = 0; k < ice->n_fluids; k++)
      ice->mass_cc[k * g->size + c] += ice->passed_fc[k * copy + base + c] - ice->passed_fc[k * copy + base + c + st];
    double after = ice_cell_mass(g, ice, c);
    for (int d = 0; d < dim; d++) {
      double gained = ice->through_cc[c * dim + d] - ice->through_cc[(c + st) * dim + d];
      ice->vel_cc[c * dim + d] = (before * ice->vel_cc[c * dim + d] + gained) / after;
    }
  }
  for (int k = 0; k < ice->n_fluids; k++) grid_fill_periodic(g, 1, ice->mass_cc + k * g->size);
  grid_fill_periodic(g, dim, ice->vel_cc);
}

void ice_pass_fluids(struct sim *sim, struct ice *ice, int axis, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         faces = grid_faces(g, axis);
  ice_find_only(sim, ice);
  pass_masses(sim, ice, axis, dt);
  FOR_BOX(g, faces, f) pass_momentum(sim, ice, axis, f, dt, ice->through_cc + f * g->dim);
  gather(sim, ice, axis);
}
