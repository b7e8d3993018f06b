/* A running simulation: time, grid and the states of the planned modules. */
#ifndef CORE_SIM_H
#define CORE_SIM_H

#include "core/grid.h"
#include "core/ledger.h"
#include "core/module.h"
#include "core/points.h"
#include "core/scene.h"

struct solver_report {
  long solves, iterations, smg, fallbacks; /* smg, fallbacks: solves that PFMG, SMG did not manage */
  long equilibria, equilibrium_steps; /* pressures of cells found from the volumes of several fluids, and their steps */
  double residual_max;                /* volume that the pressure solve left in a step, over a cell's volume */
};

struct sim {
  const struct scene         *scene;
  struct grid                 grid;
  double                      t, dt;    /* s: start of the step and its length */
  double                      dt_limit; /* s: what the stages allow at factor one; blends per step refer to it */
  long                        step;
  struct points              *points[N_SETS]; /* NULL: no such set */
  int                         n_markers;
  int                         n_modules;
  const struct module *const *modules; /* planned ones */
  void                      **states;
  struct ledger               ledger_start, ledger;
  struct solver_report        solver;
  double                      defect_rms_max, defect_max; /* over all steps */
};

/** State of a module; NULL if it is not planned. */
static inline void *sim_state(const struct sim *sim, const struct module *module)
{
  for (int i = 0; i < sim->n_modules; i++)
    if (sim->modules[i] == module) return sim->states[i];
  return NULL;
}

/** m/s2 at time t. */
static inline void sim_gravity(const struct sim *sim, double t, double g[3])
{
  const double origin[3] = {0, 0, 0};
  for (int d = 0; d < 3; d++) g[d] = function_value(&sim->scene->gravity[d], origin, t);
}

#endif
