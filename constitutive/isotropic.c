/* Wave speed and energy of laws whose elastic part is linear. */
#include "constitutive/isotropic.h"

#include "core/tensor.h"

/* The acoustic tensor of a Cauchy stress that turns with the material: longitudinal E_oed, shear mu + (s_N - s_m)/2. As
 * (s_1 - s_3)^2 <= 2 dev:dev, their sum is below E_oed + sqrt(dev:dev/2). One root and one quotient for all points. */
double isotropic_wave_speed(const void *prm, int n, const double *rb, const double *stress, const double *history)
{
  double largest = 0.0, lightest = INFINITY;
  (void)history;
  for (int p = 0; p < n; p++) {
    const double *s = &stress[6L * p];
    double        a = s[XX] - s[YY], b = s[YY] - s[ZZ], c = s[ZZ] - s[XX];
    double        dev = (a * a + b * b + c * c) / 3.0 + 2.0 * (s[XY] * s[XY] + s[YZ] * s[YZ] + s[XZ] * s[XZ]);
    largest = dev > largest ? dev : largest;
    lightest = rb[p] < lightest ? rb[p] : lightest;
  }
  return sqrt((isotropic_oedometer(prm) + sqrt(0.5 * largest)) / lightest);
}

/* s:s (1 + nu) - nu tr(s)^2 over 2 E */
void isotropic_energy(const void *prm, int n, const double *F, const double *stress, const double *history,
                      double *energy)
{
  const struct isotropic *e = prm;
  (void)F, (void)history;
  for (int p = 0; p < n; p++) {
    const double *s = &stress[6L * p];
    double        trace = s[XX] + s[YY] + s[ZZ];
    double        square =
        s[XX] * s[XX] + s[YY] * s[YY] + s[ZZ] * s[ZZ] + 2.0 * (s[XY] * s[XY] + s[YZ] * s[YZ] + s[XZ] * s[XZ]);
    energy[p] = ((1.0 + e->poisson) * square - e->poisson * trace * trace) / (2.0 * e->young);
  }
}
