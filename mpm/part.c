/* Points that have parted: those that swelled too far carry no stress until they are as dense as at the start. theory
 * 3.10 */
#include "constitutive/constitutive.h"
#include "core/parallel.h"
#include "core/tensor.h"
#include "mpm/stages.h"

#include <math.h>
#include <string.h>

/* F as 3 x 3 */
static void widen(int dim, const double *F, double wide[9])
{
  for (int q = 0; q < 9; q++) wide[q] = q / 3 < dim && q % 3 < dim ? F[q / 3 * dim + q % 3] : q % 4 == 0;
}

/* J: elastic energy that the point loses now */
static double stored(const struct sim *sim, const struct mpm *m, const struct material *material, long p,
                     const double F[9])
{
  double        energy = 0;
  const double *history = m->history_p ? m->history_p + sim->scene->n_history * p : NULL;
  material->model->energy(material->model_params, 1, F, m->stress_p + 6 * p, history, &energy);
  return energy * m->volume_p[p];
}

/* W: what the stress that the law has just returned takes up */
static double power(int dim, const double *stress, const double *L, double volume)
{
  double S[9], sum = 0;
  tensor_from_symmetric(stress, S);
  for (int d = 0; d < dim; d++)
    for (int e = 0; e < dim; e++) sum += S[3 * d + e] * L[d * dim + e];
  return sum * volume;
}

/* Keeps its volume and forgets its shape and its stress. lost: energy (J) and power (W) that go with them. */
static void part_point(const struct sim *sim, struct mpm *m, const struct material *material, long p, double lost[2])
{
  int    dim = sim->grid.dim;
  double F[9], *own = m->F_p + p * dim * dim, *stress = m->stress_p + 6 * p, J;
  widen(dim, own, F);
  J = tensor_determinant(F);
  if (m->parted_p[p] == 0 && J <= 1 + mpm_params(sim->scene)->max_expansion) return;
  if (m->parted_p[p] == 0) lost[0] += stored(sim, m, material, p, F);
  lost[1] += power(dim, stress, m->gradv_p + p * dim * dim, m->volume_p[p]);
  m->parted_p[p] = J > 1;
  memset(stress, 0, 6 * sizeof *stress);
  for (int q = 0; q < dim * dim; q++) own[q] = q % (dim + 1) == 0 ? pow(J, 1.0 / dim) : 0;
}

enum status mpm_part_points(struct sim *sim, double dt)
{
  (void)dt;
  struct mpm          *m = mpm_of(sim);
  const struct points *points = m->points;
  PARALLEL_FOR_DYNAMIC
  for (long r = 0; r < points->n_runs; r++) {
    const struct material *material = scene_material(sim->scene, (int)(r % points->n_groups));
    double                *lost = m->run_parted + 2 * r;
    lost[0] = lost[1] = 0;
    for (long p = points->start[r]; p < points->start[r + 1] && !material->model->held; p++)
      part_point(sim, m, material, p, lost);
  }
  for (long r = 0; r < points->n_runs; r++) {
    m->now.plastic += m->run_parted[2 * r];
    m->now.power -= m->run_parted[2 * r + 1];
  }
  return OK;
}
