/* Newton's method for the volume of several fluids, inside a bracket. theory 4.15 */
#include "ice/equilibrium.h"

#include "eos/eos.h"

#include <math.h>

/* volume over the wanted one, and compressibility of all fluids together, 1/Pa */
static double filled(const struct scene *scene, const double *m, const double *T, double volume, double P,
                     double *kappa)
{
  double sum = 0, soft = 0;
  for (int k = 0; k < scene->n_fluids; k++) {
    const struct fluid *fluid = scene_fluid(scene, k);
    double              rho, own;
    if (!(m[k] > 0)) continue;
    fluid->eos->density(fluid->eos_params, 1, &P, T, &rho);
    fluid->eos->compressibility(fluid->eos_params, 1, &P, T, &own);
    sum += m[k] / rho;
    soft += m[k] / rho * own;
  }
  *kappa = sum > 0 ? soft / sum : 0;
  return sum / volume;
}

/* Next guess. Newton's method for 1/volume, which of a gas is a straight line over P; from above a gas may be led below
 * zero, a quarter is far enough. Outside the bracket its middle is taken, or a step towards the side without an end. */
static double next(double P, double ratio, double kappa, double low, double high)
{
  double guess = kappa > 0 ? P + (ratio - 1) / kappa : P;
  if (guess < 0.25 * P && P > 0 && low < 0.25 * P) guess = 0.25 * P;
  if (guess > low && guess < high) return guess;
  if (isinf(high)) return P + 2 * fabs(P) + 1;
  if (isinf(low)) return P - 2 * fabs(P) - 1;
  return 0.5 * (low + high);
}

int ice_equilibrium(const struct scene *scene, const double *m, const double *T, double volume, double *P)
{
  static const double round_off = 4e-16;
  double              low = -INFINITY, high = INFINITY;
  int                 steps = 0;
  for (; steps < MOST_EQUILIBRIUM_STEPS; steps++) {
    double kappa, ratio = filled(scene, m, T, volume, *P, &kappa);
    if (fabs(ratio - 1) <= round_off) break;
    *(ratio > 1 ? &low : &high) = *P;
    double guess = next(*P, ratio, kappa, low, high);
    if (fabs(guess - *P) <= round_off * fabs(*P) || guess == low || guess == high) break;
    *P = guess;
  }
  return steps;
}
