/* Several fluids with velocities of their own: what each carries. theory 4.17 */
#include "ice/advect.h"
#include "ice/each.h"

#include "core/parallel.h"

#include <math.h>

/* of what a full cell holds: a fluid with less goes with the others */
static const double least_mass = 1e-14;

/* kg of the first fluid, then of the others what the volume flux of all leaves */
static void pass_masses(struct sim *sim, struct ice *ice, int axis, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         faces = grid_faces(g, axis);
  long               base = axis * g->size, st = g->stride[axis], copy = g->size * g->dim;
  double             V = grid_cell_volume(g), r = dt / g->h;
  FOR_BOX(g, faces, f)
  {
    long   q = base + f;
    double liquid = ice->liquid_fc[q], rest = r * ice->carried_fc[q] - liquid;
    long   from = liquid > 0 ? f - st : f, behind = rest > 0 ? f - st : f;
    double first = fmin(fabs(liquid) * V * ice->rho_cc[from], fmax(0, ice->mass_cc[from]));
    double left = fmin(fabs(rest), ice->pore_cc[behind]) * V;
    ice->passed_fc[q] = copysign(first, liquid);
    for (int k = 1; k < ice->n_fluids; k++)
      ice->passed_fc[k * copy + q] = left > 0 ? copysign(ice_mass_of_rest(g, ice, k, behind, left), rest) : 0;
  }
}

/* momentum of fluid k through a face, kg m/s */
static void pass_momentum(const struct sim *sim, struct ice *ice, int k, int axis, long f, double dt)
{
  const struct grid *g = &sim->grid;
  long               q = axis * g->size + f;
  double             mass = ice->passed_fc[k * g->dim * g->size + q];
  long               from = mass > 0 ? f - g->stride[axis] : f, own = k * g->size;
  double            *through = ice->each_through_cc + (own + f) * g->dim;
  bool               given = ice->kind[q] == FACE_INLET;
  bool               smooth = mass != 0 && ice_only_fluid(ice, from) == k && advect_is_smooth(g, ice, axis, f);
  double             number = smooth ? dt * fabs(ice->carried_fc[q]) / (g->h * ice->pore_cc[from]) : 0;
  for (int d = 0; d < g->dim; d++) {
    double u = ice->each_cc[(own + from) * g->dim + d];
    if (given) u = ice_inlet_velocity(sim, axis, d, f, sim->t);
    if (smooth) u = advect_leaving_velocity(sim, ice, axis, from, mass > 0, d, number);
    through[d] = mass != 0 ? mass * u : 0;
  }
}

static void gather_fluid(const struct grid *g, struct ice *ice, int k, int axis, long c)
{
  long          copy = g->dim * g->size, own = k * g->size + c, q = k * copy + axis * g->size + c, st = g->stride[axis];
  double        before = ice->mass_cc[own], least = least_mass * ice->rho_cc[own] * grid_cell_volume(g);
  const double *through = ice->each_through_cc;
  ice->mass_cc[own] += ice->passed_fc[q] - ice->passed_fc[q + st];
  for (int d = 0; d < g->dim; d++) {
    double *vel = &ice->each_cc[own * g->dim + d],
           gained = through[own * g->dim + d] - through[(own + st) * g->dim + d];
    *vel = ice->mass_cc[own] > least ? (before * *vel + gained) / ice->mass_cc[own] : NAN;
  }
}

/* the mean of the fluids of a cell; those that are hardly there go with it */
static void find_mean(const struct grid *g, struct ice *ice, long c)
{
  for (int d = 0; d < g->dim; d++) {
    double momentum = 0, mass = 0;
    for (int k = 0; k < ice->n_fluids; k++) {
      double vel = ice->each_cc[(k * g->size + c) * g->dim + d];
      if (isnan(vel)) continue;
      momentum += ice->mass_cc[k * g->size + c] * vel;
      mass += ice->mass_cc[k * g->size + c];
    }
    ice->vel_cc[c * g->dim + d] = momentum / mass;
    for (int k = 0; k < ice->n_fluids; k++) {
      double *vel = &ice->each_cc[(k * g->size + c) * g->dim + d];
      if (isnan(*vel)) *vel = momentum / mass;
    }
  }
}

void each_pass(struct sim *sim, struct ice *ice, int axis, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         faces = grid_faces(g, axis), cells = grid_cells(g);
  ice_find_only(sim, ice);
  pass_masses(sim, ice, axis, dt);
  FOR_BOX(g, faces, f)
  for (int k = 0; k < ice->n_fluids; k++) pass_momentum(sim, ice, k, axis, f, dt);
  FOR_BOX(g, cells, c)
  {
    for (int k = 0; k < ice->n_fluids; k++) gather_fluid(g, ice, k, axis, c);
    find_mean(g, ice, c);
  }
  for (int k = 0; k < ice->n_fluids; k++) {
    grid_fill_periodic(g, 1, ice->mass_cc + k * g->size);
    grid_fill_periodic(g, g->dim, ice->each_cc + k * g->size * g->dim);
  }
  grid_fill_periodic(g, g->dim, ice->vel_cc);
}
