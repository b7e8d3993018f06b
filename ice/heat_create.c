/* Heat at the start of a run, its memory, its account. theory 4.12 */
#include "core/memory.h"
#include "core/parallel.h"
#include "eos/eos.h"
#include "ice/heat.h"
#include "mpm/mpm.h"

double ice_heat_capacity(const struct sim *sim)
{
  const struct fluid *fluid = &sim->scene->fluid;
  return fluid->eos->heat_capacity(fluid->eos_params);
}

static enum status start_temperatures(struct sim *sim, struct ice *ice)
{
  struct box cells = grid_cells(&sim->grid);
  FOR_BOX_SERIAL(&sim->grid, cells, c)
  {
    double x[3];
    grid_centre(&sim->grid, c, x);
    ice->T_cc[c] = function_value(&sim->scene->fluid.temperature, x, 0);
    if (!(ice->T_cc[c] > 0))
      return FAIL(ERR_INPUT, "fluid.temperature: %g at (%g, %g, %g) is not above 0; give it in K", ice->T_cc[c], x[0],
                  x[1], x[2]);
  }
  grid_fill_periodic(&sim->grid, 1, ice->T_cc);
  return OK;
}

static enum status create_phase(const struct grid *g, struct heat_phase *p)
{
  double **arrays[] = {&p->capacity, &p->conductivity, &p->outside, &p->source, &p->share, &p->diagonal,
                       &p->change,   &p->rest,         &p->search,  &p->image,  &p->eased};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) TRY(NEW(arrays[i], g->size));
  return NEW(&p->conductance, g->size * g->dim);
}

static void destroy_phase(struct heat_phase *p)
{
  double **arrays[] = {&p->capacity, &p->conductivity, &p->outside, &p->source, &p->share, &p->diagonal,
                       &p->change,   &p->rest,         &p->search,  &p->image,  &p->eased, &p->conductance};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) memory_free(arrays[i]);
}

enum status ice_heat_create(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct heat       *heat = &ice->heat;
  struct box         cells = grid_cells(g);
  TRY(start_temperatures(sim, ice));
  if (!ice->swell_cc) return OK; /* nothing conducts */
  heat->n_phases = heat_has_grains(sim->scene) ? 2 : 1;
  heat->held = !mpm_solid_moves(sim->scene);
  TRY(NEW(&heat->row_sum, box_rows(&cells)));
  for (int k = 0; k < heat->n_phases; k++) TRY(create_phase(g, &heat->phase[k]));
  heat->phase[0].T = ice->T_cc;
  heat->phase[1].T = ice->T_solid_cc;
  if (heat->n_phases == 1) return OK;
  TRY(NEW(&heat->exchange, g->size));
  return NEW(&heat->centre, g->size * g->dim);
}

void ice_heat_destroy(struct heat *heat)
{
  for (int k = 0; k < heat->n_phases; k++) destroy_phase(&heat->phase[k]);
  memory_free(&heat->row_sum);
  memory_free(&heat->exchange);
  memory_free(&heat->centre);
}

void ice_heat_measure(const struct sim *sim, struct ledger *l)
{
  const struct ice *ice = ice_of(sim);
  struct box        cells = grid_cells(&sim->grid);
  double            warmth = 0;
  FOR_BOX_SERIAL(&sim->grid, cells, c) warmth += ice->mass_cc[c] * ice->T_cc[c];
  l->v[LEDGER_heat_fluid] += ice_heat_capacity(sim) * warmth;
  l->v[LEDGER_heat_fluid_out] += ice->now.heat_out;
  l->v[LEDGER_heat_sides] += ice->now.heat_sides;
}
