/* Faces of the fluid at any speed: velocity and pressure from limited slopes on both sides, with as much of a Riemann
 * problem's solution as the flow is fast. theory 4.13 */
#include "ice/shock.h"

#include "core/parallel.h"

#include <math.h>

/* growth of the wave speed with a jump of velocity: half of gamma + 1 of a gas of two atoms */
static const double stiffening = 1.2;
/* jumps of velocity resist fully from this Mach number, or jump of pressure over rho c^2, on */
static const double fast = 0.5;
/* share of what its pressure can fall by that expansion takes off a face at once */
static const double most_slack = 0.98;

/* velocity of a wall, 0, or of a side at the middle of a face */
static double side_velocity(const struct sim *sim, const struct ice *ice, int axis, long f, int d)
{
  bool inlet = ice->kind[axis * sim->grid.size + f] == FACE_INLET;
  return inlet ? ice_inlet_velocity(sim, axis, d, f, sim->t) : 0;
}

double shock_jump_velocity(const struct sim *sim, const struct ice *ice, int axis, long f, int d)
{
  const struct grid *g = &sim->grid;
  long               low = f - g->stride[axis];
  enum face_kind     kind = ice->kind[axis * g->size + f];
  if (kind == FACE_INNER) return ice->vel_cc[f * g->dim + d] - ice->vel_cc[low * g->dim + d];
  if (d != axis || kind == FACE_PRESSURE) return 0;
  double given = side_velocity(sim, ice, axis, f, d);
  return ice->wet_cc[f] > 0 ? 2 * (ice->vel_cc[f * g->dim + d] - given) : 2 * (given - ice->vel_cc[low * g->dim + d]);
}

/* one side of a face: the cell, and half of its limited changes along the axis */
struct half {
  double rho, c, u, P;
  double du, dP; /* dP beyond the weight of the fluid */
  double slack;  /* Pa: what the pressure can fall by until the fluid is all but gone */
};

/* change of pressure across a face beyond what the weight of both halves makes, Pa */
static double jump_pressure(const struct sim *sim, const struct ice *ice, int axis, long f, double weight)
{
  double jump = shock_jump(sim, ice, axis, f, 1, ice->P_cc);
  return ice->kind[axis * sim->grid.size + f] == FACE_INNER ? jump - weight * ice_face_density(&sim->grid, ice, axis, f)
                                                            : 0;
}

static struct half half_of(const struct sim *sim, const struct ice *ice, int axis, long c, double weight)
{
  long        high = c + sim->grid.stride[axis];
  struct half h = {ice->filling_cc[c], ice->sound_cc[c], ice->vel_cc[c * sim->grid.dim + axis], ice->P_cc[c], 0, 0,
                   ice->slack_cc[c]};
  h.du = 0.5 *
         shock_limited(shock_jump_velocity(sim, ice, axis, c, axis), shock_jump_velocity(sim, ice, axis, high, axis));
  h.dP = 0.5 * shock_limited(jump_pressure(sim, ice, axis, c, weight), jump_pressure(sim, ice, axis, high, weight));
  return h;
}

/* what a face starts the step with; push: the pressure difference that accelerates it, beyond weight, Pa */
struct start {
  double u, P, push;
};

/* between two cells, whose pressures reach the face with the weight of half a cell: waves of the impedances Z, as far
 * as slopes leave jumps; courant: dt/h */
static struct start between(const struct half *l, const struct half *r, double du, double weight, double courant)
{
  double       faster = fmax(l->c, r->c) * courant, share = fmin(1, 1 / faster), closing = stiffening * fmax(0, -du);
  double       Zl = l->rho * (l->c + closing), Zr = r->rho * (r->c + closing), Z = Zl + Zr;
  double       softer = fmin(l->rho * l->c * l->c, r->rho * r->c * r->c);
  double       Pl = l->P + 0.5 * weight * l->rho, Pr = r->P - 0.5 * weight * r->rho, dP = Pr - Pl;
  double       mach = fmax(fmax(fabs(l->u) / l->c, fabs(r->u) / r->c), fabs(dP) / softer);
  double       slopes = fmin(1, fmax(0, 2 - 2 * faster)), left_u = du - (l->du + r->du), left_P = dP - (l->dP + r->dP);
  double       pull = share * fmin(1, mach / fast) * (Zl * Zr / Z) * left_u;
  double       slack = most_slack * (Zr * (l->slack + l->dP) + Zl * (r->slack - r->dP)) / Z;
  struct start s;
  s.u = (Zl * (l->u + l->du) + Zr * (r->u - r->du)) / Z - share * left_P / Z;
  s.P = (Zr * (Pl + l->dP) + Zl * (Pr - r->dP)) / Z - fmin(pull, slack);
  s.push = slopes * (l->dP + r->dP) + (1 - slopes) * dP;
  return s;
}

/* at a wall or a side with a velocity: the fluid that comes towards it is stopped; out: the cell's side of the face, -1
 * the lower */
static struct start against(const struct half *h, double given, double out, double weight, double courant)
{
  double       share = fmin(1, 1 / (h->c * courant)), coming = out * (h->u - given + out * h->du);
  double       Z = h->rho * (h->c + stiffening * fmax(0, 2 * coming));
  struct start s = {given, 0, 0};
  s.P = h->P + out * 0.5 * weight * h->rho + share * fmin(1, fabs(h->u - given) / (h->c * fast)) * Z * coming;
  return s;
}

static struct start start_face(const struct sim *sim, const struct ice *ice, int axis, long f, double weight, double dt)
{
  const struct grid *g = &sim->grid;
  long               low = f - g->stride[axis], q = axis * g->size + f, c = ice->wet_cc[f] > 0 ? f : low;
  enum face_kind     kind = ice->kind[q];
  if (kind == FACE_INNER) {
    struct half l = half_of(sim, ice, axis, low, weight), r = half_of(sim, ice, axis, f, weight);
    return between(&l, &r, shock_jump_velocity(sim, ice, axis, f, axis), weight, dt / g->h);
  }
  if (!(ice->wet_cc[c] > 0)) return (struct start){0, 0, 0};
  struct half h = half_of(sim, ice, axis, c, weight);
  double      out = c == low ? 1 : -1;
  if (kind != FACE_PRESSURE) return against(&h, side_velocity(sim, ice, axis, f, axis), out, weight, dt / g->h);
  double P = ice_outside_pressure(sim, ice, axis, f, sim->t);
  return (struct start){h.u, P, out * 2 * (P - h.P) - weight * h.rho};
}

enum status ice_predict_shock(struct sim *sim, double dt)
{
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  double             gravity[3];
  sim_gravity(sim, sim->t + 0.5 * dt, gravity);
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    double     weight = gravity[axis] * g->h;
    FOR_BOX(g, faces, f)
    {
      long         q = axis * g->size + f;
      struct start s = start_face(sim, ice, axis, f, weight, dt);
      bool         active = ice_face_active(ice->kind[q]);
      double       rho = active ? ice_face_density(g, ice, axis, f) : 0;
      ice->s_old_fc[q] = 0;
      ice->u_old_fc[q] = ice->flux_fc[q] = ice->water_fc[q] = s.u;
      ice->gradP_fc[q] = active ? s.push / g->h + rho * gravity[axis] : 0;
      ice->press_fc[q] = s.P;
    }
  }
  ice_fill_faces(sim, ice->gradP_fc);
  return OK;
}

double ice_sound_dt(const struct sim *sim)
{
  const struct ice  *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  double             fastest = 0;
  if (!(ice->params->acoustic_courant > 0)) return INFINITY;
  FOR_BOX_SERIAL(g, cells, c)
  for (int d = 0; d < g->dim && ice->wet_cc[c] > 0; d++)
    fastest = fmax(fastest, fabs(ice->vel_cc[c * g->dim + d]) + shock_sound(sim, ice, c));
  return fastest > 0 ? ice->params->acoustic_courant * g->h / fastest : INFINITY;
}

/* besides, no cell changes its volume by more than half at the rate of the last step. theory 4.13 */
double ice_shock_dt(const struct sim *sim)
{
  const struct ice *ice = ice_of(sim);
  double            limit = ice_dt_limit(sim);
  return ice->now.squeeze > 0 ? fmin(limit, 0.5 / ice->now.squeeze) : limit;
}
