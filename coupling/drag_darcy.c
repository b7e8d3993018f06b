/* Darcy: K = n^2 mu / kappa, kappa as the scene gives it. */
#include "coupling/drag.h"

static const struct param params[] = {PARAM_END};

static void coefficient(const void *prm, int n, const struct drag_medium *m, double *K)
{
  (void)prm;
  for (int i = 0; i < n; i++) {
    double kappa = m->permeability[i], porosity = m->porosity[i];
    K[i] = kappa > 0.0 ? porosity * porosity * m->viscosity / kappa : 0.0;
  }
}

const struct drag_law drag_darcy = {
    .name = "darcy",
    .source = "1, Drag",
    .params = params,
    .needs_permeability = true,
    .coefficient = coefficient,
};
