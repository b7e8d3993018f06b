/* Ergun (Forchheimer): K = n^2 mu/kappa + rho n^(3/2) B/sqrt(A kappa) |U_s - U_f|, kappa of Kozeny-Carman. With it the
 * second term is rho B (1 - n)/D |U_s - U_f|. This is what Ergun gives for the superficial velocity n (U_f - U_s); F(3)
 * lacks a factor n. */
#include "coupling/drag.h"

struct ergun {
  double A, B;
};

static const struct param params[] = {
    {"A", PARAM_NUMBER, offsetof(struct ergun, A), "-", 1, 1e4, "150", NULL, "constant of the viscous term"},
    {"B", PARAM_NUMBER, offsetof(struct ergun, B), "-", 0, 1e3, "1.75", NULL, "constant of the inertial term"},
    PARAM_END,
};

static void coefficient(const void *prm, int n, const struct drag_medium *m, double *K)
{
  const struct ergun *e = prm;
  for (int i = 0; i < n; i++) {
    double D = m->diameter[i], porosity = drag_porosity(m, i), phi = 1.0 - porosity;
    double viscous = e->A * m->viscosity * phi * phi / (D * D * porosity);
    double inertial = e->B * m->density * phi * m->slip[i] / D;
    K[i] = D > 0.0 ? viscous + inertial : 0.0;
  }
}

const struct drag_law drag_ergun = {
    .name = "ergun",
    .source = "1, Drag",
    .params = params,
    .param_size = sizeof(struct ergun),
    .needs_diameter = true,
    .coefficient = coefficient,
};
