/* What the water holds: mass, momentum, energies. theory_twopoint 11 */
#include "twopoint/twopoint.h"

#include "eos/eos.h"

/* momentum, angular momentum (affine part counted) and kinetic energy of point p */
static void measure_motion(const struct sim *sim, const struct twopoint *w, long p, struct ledger *l)
{
  int           dim = sim->grid.dim;
  double        mass = w->mass_w[p], D = w->kernels->moment * sim->grid.h * sim->grid.h, square = 0;
  const double *v = w->vel_w + p * dim, *x = w->x_w + p * dim;
  for (int d = 0; d < dim; d++) {
    l->v[LEDGER_momentum_x + d] += mass * v[d];
    square += v[d] * v[d];
  }
  l->v[LEDGER_angular_z] += mass * (x[0] * v[1] - x[1] * v[0]);
  if (w->affine_w) {
    const double *C = w->affine_w + p * dim * dim;
    l->v[LEDGER_angular_z] += mass * D * (C[dim] - C[1]);
    for (int q = 0; q < dim * dim; q++) square += D * C[q] * C[q];
  }
  l->v[LEDGER_kinetic_fluid] += 0.5 * mass * square;
}

/* energy of compression to second order in P: P^2 kappa/2 per volume of water */
static double compression(const struct sim *sim, const struct twopoint *w, long p)
{
  const struct fluid *f = &sim->scene->fluid;
  double              kappa, P = w->P_w[p];
  f->eos->compressibility(f->eos_params, 1, &P, NULL, &kappa);
  return 0.5 * P * P * kappa * w->mass_w[p] * w->J_w[p] / w->rho0;
}

void twopoint_measure_point(const struct sim *sim, const struct twopoint *w, long p, struct ledger *l)
{
  double gravity[3];
  sim_gravity(sim, sim->t, gravity);
  l->v[LEDGER_mass_fluid] += w->mass_w[p];
  for (int d = 0; d < sim->grid.dim; d++)
    l->v[LEDGER_potential] -= w->mass_w[p] * gravity[d] * w->x_w[p * sim->grid.dim + d];
  l->v[LEDGER_compression] += compression(sim, w, p);
  measure_motion(sim, w, p, l);
}

void twopoint_measure(const struct sim *sim, struct ledger *l)
{
  const struct twopoint *w = twopoint_of(sim);
  for (long p = 0; p < w->points->n; p++) twopoint_measure_point(sim, w, p, l);
  l->v[LEDGER_mass_fluid_out] += w->now.mass_out;
  l->v[LEDGER_energy_out] += w->now.energy_out;
  for (int d = 0; d < 3; d++) l->v[LEDGER_momentum_out_x + d] += w->now.momentum_out[d];
}
