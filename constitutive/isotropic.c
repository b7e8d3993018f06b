/* Wave speed and energy of laws whose elastic part is linear. */
#include "constitutive/isotropic.h"

#include "constitutive/vector.h"

/* dev:dev and density of LANES points from p on, against the largest and the least so far */
static inline void extremes(const double *rb, const double *stress, int p, VECTOR *most, VECTOR *least)
{
  VECTOR s[6], density;
  for (int k = 0; k < 6; k++) vector_gather(stress + 6L * p, 6, k, &s[k]);
  memcpy(&density, rb + p, sizeof density);
  VECTOR a = s[XX] - s[YY], b = s[YY] - s[ZZ], c = s[ZZ] - s[XX];
  VECTOR dev = (a * a + b * b + c * c) * (1.0 / 3.0) + 2.0 * (s[XY] * s[XY] + s[YZ] * s[YZ] + s[XZ] * s[XZ]);
  *most = VECTOR_MAX(dev, *most);
  *least = VECTOR_MIN(density, *least);
}

/* The acoustic tensor of a Cauchy stress that turns with the material: longitudinal E_oed, shear mu + (s_N - s_m)/2. As
 * (s_1 - s_3)^2 <= 2 dev:dev, their sum is below E_oed + sqrt(dev:dev/2). One root and one quotient for all points. */
double isotropic_wave_speed(const void *prm, int n, const double *rb, const double *stress, const double *history)
{
  VECTOR most = VECTOR_ALL(0.0), least = VECTOR_ALL(INFINITY);
  double own_rb[LANES], own_stress[6 * LANES], largest = 0.0, lightest = INFINITY;
  (void)history;
  if (n < LANES) { /* the first again and again */
    for (int i = 0; i < LANES; i++) {
      own_rb[i] = rb[i < n ? i : 0];
      memcpy(own_stress + 6 * i, stress + 6 * (i < n ? i : 0), 6 * sizeof *stress);
    }
    n = LANES, rb = own_rb, stress = own_stress;
  }
  for (int p = 0; p < n; p += LANES) extremes(rb, stress, p + LANES <= n ? p : n - LANES, &most, &least);
  for (int i = 0; i < LANES; i++) {
    largest = most[i] > largest ? most[i] : largest;
    lightest = least[i] < lightest ? least[i] : lightest;
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
