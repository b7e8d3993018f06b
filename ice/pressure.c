/* The volume equation: (n kappa/dt) dP - div(theta2 lambda grad dP) = - div(theta F* + (1 - theta) F_old) + defect of
 * clear cells, lambda = dt (n u_reply + phi s_reply). Everything is multiplied by the volume of a cell. theory 4.4 */
#include "ice/ice.h"

#include "core/parallel.h"
#include "coupling/coupling.h"
#include "eos/eos.h"

#include <math.h>

/* below this solid fraction a cell counts as clear fluid, where the defect goes back into the pressure */
static const double clear_grains = 1e-6;
/* largest share of a pore volume that one step may make good */
static const double largest_correction = 0.1;

/* volume that a step may lose, over a cell's, however little flows: 1e-13 of stiff water (2 GPa) is 2e-4 Pa */
static const double least_volume_error = 1e-13;

double ice_inlet_velocity(const struct sim *sim, int axis, int component, long f, double t)
{
  int    place[3];
  double x[3];
  grid_place(&sim->grid, f, place);
  grid_face(&sim->grid, f, axis, x);
  return function_value(&sim->scene->fluid_side[2 * axis + (place[axis] > 0)].velocity[component], x, t);
}

/* entries of the matrix between cells, and the predicted flux in place of the old one where theta < 1 needs both */
static void face_entries(struct sim *sim, struct ice *ice, int axis, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         faces = grid_faces(g, axis);
  double             theta = sim->scene->numerics.theta, scale = theta * theta * dt * ice_face_area(g) / g->h;
  long               base = axis * g->size;
  if (g->periodic[axis] && g->n[axis] == 1) scale = 0; /* both cells of the face are one */
  FOR_BOX(g, faces, i)
  {
    long   q = base + i;
    double n = ice->porosity_fc[q], open = ice->open_fc[q], predicted = 0;
    ice->coupling_fc[q] = 0;
    if (ice->kind[q] == FACE_INLET)
      predicted = open * n * ice_inlet_velocity(sim, axis, axis, i, sim->t + dt);
    else if (ice_face_active(ice->kind[q])) {
      predicted = open * (n * ice->u_fc[q] + (1 - n) * ice->s_fc[q]);
      ice->coupling_fc[q] = -scale * open * (n * ice->u_reply_fc[q] + (1 - n) * ice->s_reply_fc[q]) /
                            ice_face_distance(sim, ice, axis, i);
    }
    ice->flux_fc[q] = theta * predicted + (1 - theta) * ice->flux_fc[q];
  }
}

/* whether a cell's defect goes back into the pressure: clear ones, and with a surface that moves all that hold still */
static bool is_clear(const struct ice *ice, long c)
{
  return 1 - ice->porosity_cc[c] < clear_grains || (ice->advects && !ice->moves);
}

/* volume per time that makes the defect of a cell good in this step, m3/s */
static double defect_source(const struct sim *sim, const struct ice *ice, long c, double dt)
{
  if (!ice->advects && ice_has_surface(&sim->grid, ice, c)) return 0;
  double D = fmin(largest_correction, fmax(-largest_correction, ice->defect_cc[c]));
  return ice->params->defect_share * D * ice->porosity_cc[c] * ice->open_cc[c] * grid_cell_volume(&sim->grid) / dt;
}

/* volume per time that heat makes of the liquid of a cell, m3/s; where there is a surface it rises instead */
static double thermal_source(const struct sim *sim, const struct ice *ice, long c, double dt)
{
  if (!ice->swell_cc || ice_has_surface(&sim->grid, ice, c)) return 0;
  return ice->swell_cc[c] * ice->porosity_cc[c] * ice->open_cc[c] * grid_cell_volume(&sim->grid) / dt;
}

/* storage of a cell with a pressure, m3/s/Pa: what the diagonal has beside its couplings */
static double storage_of(const struct sim *sim, const struct ice *ice, long c, double dt)
{
  const struct fluid *fluid = &sim->scene->fluid;
  double              kappa;
  if (ice->sound_cc)
    kappa = 1 / (ice->filling_cc[c] * ice->sound_cc[c] * ice->sound_cc[c]);
  else if (ice->several)
    kappa = ice->kappa_cc[c];
  else
    fluid->eos->compressibility(fluid->eos_params, 1, &ice->P_cc[c], ice_temperature(ice, c), &kappa);
  return ice->porosity_cc[c] * ice->open_cc[c] * kappa * grid_cell_volume(&sim->grid) / dt;
}

/* diagonal and right-hand side; cells without a pressure are identity rows */
static void cell_entries(struct sim *sim, struct ice *ice, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             V = grid_cell_volume(g), area = ice_face_area(g);
  FOR_BOX(g, cells, c)
  {
    ice->rhs_cc[c] = 0;
    ice->diagonal_cc[c] = 1;
    if (!(ice->wet_cc[c] > 0)) continue;
    double in = 0, sum = 0;
    for (int d = 0; d < g->dim; d++) {
      long low = d * g->size + c, high = low + g->stride[d];
      in += area * (ice->flux_fc[low] - ice->flux_fc[high]);
      sum -= ice->coupling_fc[low] + ice->coupling_fc[high];
    }
    ice->diagonal_cc[c] = storage_of(sim, ice, c, dt) + sum;
    if (ice->diagonal_cc[c] == 0) ice->diagonal_cc[c] = 1; /* incompressible, shut in by obstacles */
    ice->rhs_cc[c] = in + thermal_source(sim, ice, c, dt) - ice_wall_rate(ice, c, dt) * V +
                     (is_clear(ice, c) ? defect_source(sim, ice, c, dt) : 0);
  }
}

/* the solver must not see couplings to cells without a pressure: they stay in the diagonal only */
static void cut_couplings(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    FOR_BOX(g, faces, f)
    if (ice->kind[axis * g->size + f] != FACE_INNER) ice->coupling_fc[axis * g->size + f] = 0;
  }
}

static double largest(const struct grid *g, const double *q)
{
  struct box cells = grid_cells(g);
  double     most = 0;
  FOR_BOX_SERIAL(g, cells, c) most = fabs(q[c]) > most ? fabs(q[c]) : most;
  return most;
}

static enum status solve(struct sim *sim, struct ice *ice, double *rhs, double *x, double tolerance, double *residual)
{
  struct linear_report report;
  TRY(linear_solve(ice->linear, tolerance, rhs, x, &report));
  sim->solver.solves++;
  sim->solver.iterations += report.iterations;
  sim->solver.smg += report.smg;
  sim->solver.fallbacks += report.fell_back;
  *residual = report.residual;
  if (report.residual < INFINITY) return OK;
  return FAIL(ERR_SOLVER, "pressure: the solution is not finite at t = %g s; lower numerics.dt_factor", sim->t);
}

/* storage of the closed liquid below this share of the diagonal is lost in it to round-off */
static const double lost = 1e-10;

/* The pressure of a closed liquid rises as a whole by its storage alone. In long steps the solver cannot see that: */
struct whole {
  double storage, in; /* m3/s/Pa, m3/s */
  bool   apart;       /* the mean is found from the sums, the solver takes the matrix as singular */
};

static struct whole sum_up(const struct sim *sim, const struct ice *ice, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  struct whole       w = {0};
  double             diagonal = 0;
  if (!ice->closed || ice->singular) return w;
  FOR_BOX_SERIAL(g, cells, c)
  {
    if (!(ice->wet_cc[c] > 0)) continue;
    w.storage += storage_of(sim, ice, c, dt);
    w.in += ice->rhs_cc[c];
    diagonal += ice->diagonal_cc[c];
  }
  w.apart = w.storage < lost * diagonal;
  return w;
}

static void add_mean(const struct sim *sim, struct ice *ice, const struct whole *w, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             in = w->in;
  FOR_BOX_SERIAL(g, cells, c) in -= ice->wet_cc[c] > 0 ? storage_of(sim, ice, c, dt) * ice->dP_cc[c] : 0;
  FOR_BOX(g, cells, c) ice->dP_cc[c] += ice->wet_cc[c] > 0 ? in / w->storage : 0;
}

enum status ice_solve_pressure(struct sim *sim, double dt)
{
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  for (int axis = 0; axis < g->dim; axis++) face_entries(sim, ice, axis, dt);
  cell_entries(sim, ice, dt);
  cut_couplings(sim, ice);
  double       residual, smallest = least_volume_error * grid_cell_volume(g) / dt;
  double       tolerance = fmax(smallest, sim->scene->numerics.pressure_tolerance * largest(g, ice->rhs_cc));
  struct whole whole = sum_up(sim, ice, dt);
  linear_set_matrix(ice->linear, ice->diagonal_cc, ice->coupling_fc, ice->singular || whole.apart, ice->wet_cc);
  TRY(solve(sim, ice, ice->rhs_cc, ice->dP_cc, tolerance, &residual));
  if (whole.apart) add_mean(sim, ice, &whole, dt);
  sim->solver.residual_max = fmax(sim->solver.residual_max, residual * dt / grid_cell_volume(g));
  grid_fill_periodic(g, 1, ice->dP_cc);
  return OK;
}

/* gradient of a cell potential at a face, zero beyond surfaces and pressure sides, 1/m */
double ice_face_gradient(const struct sim *sim, const struct ice *ice, const double *q, int axis, long f)
{
  long   low = f - sim->grid.stride[axis];
  double high_q = ice->wet_cc[f] > 0 ? q[f] : 0, low_q = ice->wet_cc[low] > 0 ? q[low] : 0;
  return (high_q - low_q) / (ice_face_distance(sim, ice, axis, f) * sim->grid.h);
}

/* a surface that passes, or a cell that fills, is no change of the flow */
static bool has_trend(enum face_kind kind) { return kind == FACE_INNER || kind == FACE_PRESSURE || kind == FACE_INLET; }

static void correct_axis(struct sim *sim, struct ice *ice, int axis, double dt)
{
  const struct grid *g = &sim->grid;
  struct box         faces = grid_faces(g, axis);
  double             theta = sim->scene->numerics.theta;
  FOR_BOX(g, faces, i)
  {
    long   q = axis * g->size + i;
    double n = ice->porosity_fc[q], open = ice->open_fc[q], water = 0;
    if (ice_face_active(ice->kind[q])) {
      double push = theta * dt * ice_face_gradient(sim, ice, ice->dP_cc, axis, i);
      ice->u_fc[q] -= ice->u_reply_fc[q] * push;
      ice->s_fc[q] -= ice->s_reply_fc[q] * push;
      water = open * n * ice->u_fc[q];
    } else if (ice->kind[q] == FACE_VOID)
      water = open * n * ice->u_fc[q];
    else if (ice->kind[q] == FACE_INLET)
      water = open * n * ice_inlet_velocity(sim, axis, axis, i, sim->t + dt);
    ice->flux_fc[q] = ice->kind[q] == FACE_INLET      ? water
                      : ice_face_active(ice->kind[q]) ? water + open * (1 - n) * ice->s_fc[q]
                                                      : 0;
    if (ice->trend_fc) ice->trend_fc[q] = has_trend(ice->kind[q]) ? water - ice->water_fc[q] : 0;
    ice->carried_fc[q] = theta * water + (1 - theta) * ice->water_fc[q];
    ice->water_fc[q] = water;
  }
}

enum status ice_correct_faces(struct sim *sim, double dt)
{
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  for (int axis = 0; axis < g->dim; axis++) correct_axis(sim, ice, axis, dt);
  ice_fill_faces(sim, ice->s_fc);
  if (ice->several)
    ice_advance_pressures(sim, ice);
  else
    FOR_BOX(g, cells, c) ice->P_cc[c] += ice->wet_cc[c] > 0 ? ice->dP_cc[c] : 0;
  return OK;
}

/* The defect of cells with a skeleton moves water only: the same matrix with the defect as its only source gives a
 * potential whose gradient is added to the flux that carries mass. Pressure and velocities do not know of it.
 * theory 4.5 */
enum status ice_move_defect(struct sim *sim, double dt)
{
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             theta = sim->scene->numerics.theta, V = grid_cell_volume(g), residual;
  FOR_BOX(g, cells, c) ice->rhs_cc[c] = ice->wet_cc[c] > 0 && !is_clear(ice, c) ? defect_source(sim, ice, c, dt) : 0;
  TRY(solve(sim, ice, ice->rhs_cc, ice->shift_cc, ice->params->defect_tolerance * V / dt, &residual));
  grid_fill_periodic(g, 1, ice->shift_cc);
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    FOR_BOX(g, faces, i)
    {
      long q = axis * g->size + i;
      if (!ice_face_active(ice->kind[q])) continue;
      double n = ice->porosity_fc[q], reply = n * ice->u_reply_fc[q] + (1 - n) * ice->s_reply_fc[q];
      reply *= ice->open_fc[q];
      ice->carried_fc[q] -= theta * theta * dt * reply * ice_face_gradient(sim, ice, ice->shift_cc, axis, i);
    }
  }
  return OK;
}
