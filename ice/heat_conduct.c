/* Heat is conducted in the fluid and in a held skeleton's grains and goes over between them, all implicit, so that a
 * step may be as long as the flow allows. What goes through a face or from phase to phase is taken from one and given
 * to the other: heat is kept to round-off whatever the solver leaves. theory 4.12 */
#include "core/parallel.h"
#include "eos/eos.h"
#include "ice/heat.h"

#include <math.h>
#include <string.h>

/* largest change of a temperature in a step that accuracy wants, over the span of all */
static const double largest_change = 0.02;

/* ---- what there is ---- */

static void weigh_fluid(const struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct heat_phase *p = &ice->heat.phase[0];
  struct box         cells = grid_cells(g);
  double             c_v = ice_heat_capacity(sim), k = sim->scene->fluid.conductivity;
  FOR_BOX(g, cells, c)
  {
    bool wet = ice->wet_cc[c] > 0;
    p->capacity[c] = wet ? ice->mass_cc[c] * c_v : 1;
    p->conductivity[c] = wet ? ice->porosity_cc[c] * k : 0;
    p->share[c] = wet ? ice->porosity_cc[c] : 0;
  }
}

/* two half cells in series */
static void find_conductances(const struct sim *sim, const struct ice *ice, struct heat_phase *p, bool fluid)
{
  const struct grid *g = &sim->grid;
  double             scale = 2 * ice_face_area(g) / g->h;
  grid_fill_periodic(g, 1, p->conductivity);
  for (int axis = 0; axis < g->dim; axis++) {
    struct box faces = grid_faces(g, axis);
    FOR_BOX(g, faces, f)
    {
      double a = p->conductivity[f - g->stride[axis]], b = p->conductivity[f];
      bool   open = !fluid || ice->kind[axis * g->size + f] == FACE_INNER;
      double part = fluid ? ice->open_fc[axis * g->size + f] : 1; /* what obstacles leave */
      p->conductance[axis * g->size + f] = open && a > 0 && b > 0 ? part * scale * a * b / (a + b) : 0;
    }
    grid_fill_periodic(g, 1, p->conductance + axis * g->size);
  }
}

/* ---- the step ---- */

/* W into every cell of a phase, into rest, the cells having the temperatures T + change */
static void find_power(const struct grid *g, struct heat *heat, int phase)
{
  struct heat_phase       *p = &heat->phase[phase];
  const struct heat_phase *other = heat->n_phases == 2 ? &heat->phase[1 - phase] : NULL;
  struct box               cells = grid_cells(g);
  FOR_BOX(g, cells, c)
  {
    double own = p->T[c] + p->change[c], sum = p->source[c] - p->outside[c] * own;
    for (int d = 0; d < g->dim; d++)
      for (int high = 0; high < 2; high++) {
        long face = c + high * g->stride[d], next = high ? face : c - g->stride[d];
        sum += p->conductance[d * g->size + face] * (p->T[next] + p->change[next] - own);
      }
    if (other) sum += heat->exchange[c] * (other->T[c] + other->change[c] - own);
    p->rest[c] = sum;
  }
}

/* power becomes change; returns the largest, K */
static double warm_phase(const struct grid *g, struct heat_phase *p, double dt)
{
  struct box cells = grid_cells(g);
  double     most = 0;
  FOR_BOX(g, cells, c) p->change[c] = dt * p->rest[c] / p->capacity[c];
  FOR_BOX_SERIAL(g, cells, c) most = fmax(most, fabs(p->change[c]));
  return most;
}

static double span_of(const struct sim *sim, const struct heat *heat, double t)
{
  double span[2] = {INFINITY, -INFINITY};
  heat_sides_span(sim, t, span);
  for (int k = 0; k < heat->n_phases; k++) {
    const struct heat_phase *p = &heat->phase[k];
    struct box               cells = grid_cells(&sim->grid);
    FOR_BOX_SERIAL(&sim->grid, cells, c)
    {
      span[0] = fmin(span[0], p->T[c]);
      span[1] = fmax(span[1], p->T[c]);
    }
  }
  return span[1] - span[0];
}

static void warm_grains(const struct sim *sim, struct ice *ice, double dt)
{
  const struct grid *g = &sim->grid;
  struct heat_phase *p = &ice->heat.phase[1];
  struct box         cells = grid_cells(g);
  grid_fill_periodic(g, 1, p->change);
  heat_grains_scatter(sim, ice, p->change, dt);
  FOR_BOX(g, cells, c) p->T[c] += p->change[c];
}

/* the fluid warms, and swells by what its density loses: the next volume equation must know */
static void warm_fluid(const struct sim *sim, struct ice *ice)
{
  const struct fluid *fluid = &sim->scene->fluid;
  const struct grid  *g = &sim->grid;
  struct box          cells = grid_cells(g);
  FOR_BOX(g, cells, c)
  {
    double before, after;
    ice->warming_cc[c] = ice->heat.phase[0].change[c];
    fluid->eos->density(fluid->eos_params, 1, &ice->P_cc[c], &ice->T_cc[c], &before);
    ice->T_cc[c] += ice->warming_cc[c];
    fluid->eos->density(fluid->eos_params, 1, &ice->P_cc[c], &ice->T_cc[c], &after);
    ice->swell_cc[c] = ice->wet_cc[c] > 0 ? before / after - 1 : 0;
  }
  grid_fill_periodic(g, 1, ice->T_cc);
  grid_fill_periodic(g, 1, ice->warming_cc);
  grid_fill_periodic(g, 1, ice->swell_cc);
}

/* heat that came in through each side */
static void watch_sides(const struct sim *sim, struct ice *ice, double dt, double t)
{
  for (int side = 0; side < 2 * sim->grid.dim; side++) {
    double power = 0;
    for (int k = 0; k < ice->heat.n_phases; k++) power += heat_sides_power(sim, &ice->heat.phase[k], side, t);
    ice->now.heat_side[side] = power;
    ice->now.heat_sides += dt * power;
  }
}

static void set_up(const struct sim *sim, struct ice *ice, double dt)
{
  struct heat *heat = &ice->heat;
  weigh_fluid(sim, ice);
  if (heat->n_phases == 2) heat_grains_gather(sim, ice);
  for (int k = 0; k < heat->n_phases; k++) {
    find_conductances(sim, ice, &heat->phase[k], k == 0);
    heat_sides_set(sim, &heat->phase[k], sim->t + dt);
    grid_fill_periodic(&sim->grid, 1, heat->phase[k].T);
    memset(heat->phase[k].change, 0, (size_t)sim->grid.size * sizeof(double));
  }
}

enum status ice_conduct_heat(struct sim *sim, double dt)
{
  struct ice  *ice = ice_of(sim);
  struct heat *heat = &ice->heat;
  double       most = 0, span;
  set_up(sim, ice, dt);
  span = span_of(sim, heat, sim->t + dt);
  for (int k = 0; k < heat->n_phases; k++) find_power(&sim->grid, heat, k);
  TRY(heat_solve(&sim->grid, heat, dt));
  for (int k = 0; k < heat->n_phases; k++) grid_fill_periodic(&sim->grid, 1, heat->phase[k].change);
  for (int k = 0; k < heat->n_phases; k++) find_power(&sim->grid, heat, k);
  watch_sides(sim, ice, dt, sim->t + dt);
  for (int k = 0; k < heat->n_phases; k++) most = fmax(most, warm_phase(&sim->grid, &heat->phase[k], dt));
  ice->now.heat_step = most > 1e-12 * span ? largest_change * span * dt / most : INFINITY;
  if (heat->n_phases == 2) warm_grains(sim, ice, dt);
  warm_fluid(sim, ice);
  return OK;
}

/* s: what an explicit scheme could do, or as long as temperatures change little */
double ice_heat_dt(const struct sim *sim)
{
  const struct scene *scene = sim->scene;
  double              c = ice_heat_capacity(sim), fastest = scene->fluid.conductivity / (scene->fluid.density * c);
  for (int s = 0; s < scene->n_solids && ice_of(sim)->heat.held && ice_of(sim)->heat.n_phases == 2; s++) {
    const struct material *m = scene_material(scene, s);
    fastest = fmax(fastest, m->conductivity / (m->density * m->heat_capacity));
  }
  double explicit_step = fastest > 0 ? scene->h * scene->h / (2 * scene->dim * fastest) : INFINITY;
  return scene->numerics.dt_factor * fmax(explicit_step, ice_of(sim)->now.heat_step);
}
