/* Beetstra, van der Hoef and Kuipers 2007, as M(25)-(28): K = 18 phi (1 - phi) mu/D^2 F(phi, Re). */
#include "coupling/drag.h"

static const struct param params[] = {PARAM_END};

/* F(phi, 0): M(28) */
static double creeping(double phi)
{
  double n = 1.0 - phi;
  return 10.0 * phi / (n * n) + n * n * (1.0 + 1.5 * sqrt(phi));
}

/* F(phi, Re) - F(phi, 0): M(27) with numerator and denominator multiplied by powers of Re, so that Re = 0 gives 0 */
static double inertia(double phi, double Re)
{
  double n = 1.0 - phi, log_Re = log(Re);
  double power = exp(0.5 * (1.0 + 4.0 * phi) * log_Re);
  double numerator = Re * (1.0 / n + 3.0 * phi * n) + 8.4 * exp(0.657 * log_Re);
  return 0.413 / (24.0 * n * n) * numerator * power / (power + exp(3.0 * 2.302585092994046 * phi));
}

static void coefficient(const void *prm, int n, const struct drag_medium *m, double *K)
{
  (void)prm;
  for (int i = 0; i < n; i++) {
    double D = m->diameter[i], porosity = drag_porosity(m, i), phi = 1.0 - porosity;
    K[i] = 0.0;
    if (D <= 0.0 || phi <= 0.0) continue;
    double Re = porosity * m->density * D * m->slip[i] / m->viscosity;
    K[i] = 18.0 * phi * porosity * m->viscosity / (D * D) * (creeping(phi) + inertia(phi, Re));
  }
}

const struct drag_law drag_beetstra = {
    .name = "beetstra",
    .source = "1, Drag",
    .params = params,
    .needs_diameter = true,
    .coefficient = coefficient,
};
