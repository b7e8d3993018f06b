/* Kozeny-Carman: Darcy with kappa = D^2 n^3 / (A (1 - n)^2). T and F use A = 150, M 180. */
#include "coupling/drag.h"

struct kozeny_carman {
  double A;
};

static const struct param params[] = {
    {"A", PARAM_NUMBER, offsetof(struct kozeny_carman, A), "-", 1, 1e4, "150", NULL,
     "constant of the permeability D^2 n^3 / (A (1 - n)^2)"},
    PARAM_END,
};

static void coefficient(const void *prm, int n, const struct drag_medium *m, double *K)
{
  const struct kozeny_carman *k = prm;
  for (int i = 0; i < n; i++) {
    double D = m->diameter[i], porosity = drag_porosity(m, i), phi = 1.0 - porosity;
    K[i] = D > 0.0 ? k->A * m->viscosity * phi * phi / (D * D * porosity) : 0.0;
  }
}

const struct drag_law drag_kozeny_carman = {
    .name = "kozeny_carman",
    .source = "1, Drag",
    .params = params,
    .param_size = sizeof(struct kozeny_carman),
    .needs_diameter = true,
    .coefficient = coefficient,
};
