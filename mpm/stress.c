/* Stress of the points from their velocity gradient, in batches of one material. theory 3.1, "Skeleton models" */
#include "mpm/stages.h"

#include "constitutive/constitutive.h"
#include "core/parallel.h"
#include "core/tensor.h"

#include <string.h>

enum { BATCH = 64 };

/* a dim x dim matrix as 3 x 3, one on the rest of the diagonal (plane strain) */
static inline void widen(int dim, const double *a, double b[9])
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) b[3 * i + j] = i < dim && j < dim ? a[i * dim + j] : i == j;
}

/* dF = I + dt grad v; F <- dF F; volume <- det dF volume */
static void strain_batch(struct mpm *m, int dim, double dt, long p0, int n, double (*dF)[9], double (*F)[9])
{
  for (int i = 0; i < n; i++) {
    double *own = m->F_p + (p0 + i) * dim * dim, step[9];
    for (int q = 0; q < dim * dim; q++) step[q] = dt * m->gradv_p[(p0 + i) * dim * dim + q] + (q % (dim + 1) == 0);
    widen(dim, step, dF[i]);
    widen(dim, own, F[i]);
    tensor_product(dF[i], F[i], F[i]);
    for (int q = 0; q < dim * dim; q++) own[q] = F[i][q / dim * 3 + q % dim];
    m->volume_p[p0 + i] *= tensor_determinant(dF[i]);
  }
}

/* largest wave speed and speed of the batch into fastest[2] */
static void speeds(const struct mpm *m, const struct material *material, int dim, long p0, int n, double fastest[2])
{
  double rb[BATCH];
  for (int i = 0; i < n; i++) {
    double v2 = 0;
    for (int d = 0; d < dim; d++) v2 += m->vel_p[(p0 + i) * dim + d] * m->vel_p[(p0 + i) * dim + d];
    rb[i] = m->mass_p[p0 + i] / m->volume_p[p0 + i];
    fastest[1] = fmax(fastest[1], sqrt(v2));
  }
  fastest[0] = fmax(fastest[0], material->model->wave_speed(material->model_params, n, rb, m->stress_p + p0 * 6, NULL));
}

static int update_batch(struct mpm *m, const struct material *material, int dim, double dt, long p0, int n,
                        double fastest[2])
{
  double dF[BATCH][9], F[BATCH][9];
  strain_batch(m, dim, dt, p0, n, dF, F);
  int bad = material->model->update(material->model_params, n, dt, dF[0], F[0], m->stress_p + p0 * 6, NULL, NULL);
  speeds(m, material, dim, p0, n, fastest);
  return bad;
}

static void reduce_speeds(struct mpm *m)
{
  m->now.wave_speed = m->now.speed = 0;
  for (long r = 0; r < m->points->n_runs; r++) {
    m->now.wave_speed = fmax(m->now.wave_speed, m->run_speed[2 * r]);
    m->now.speed = fmax(m->now.speed, m->run_speed[2 * r + 1]);
  }
}

enum status mpm_update_stress(struct sim *sim, double dt)
{
  struct mpm    *m = mpm_of(sim);
  struct points *points = m->points;
  long           bad = 0;
  PARALLEL_FOR_DYNAMIC
  for (long r = 0; r < points->n_runs; r++) {
    const struct material *material = &sim->scene->materials[r % points->n_groups];
    double                *fastest = m->run_speed + 2 * r;
    fastest[0] = fastest[1] = 0;
    if (material->model->held) continue;
    for (long p = points->start[r]; p < points->start[r + 1]; p += BATCH) {
      long left = points->start[r + 1] - p;
      int  failed = update_batch(m, material, sim->grid.dim, dt, p, left < BATCH ? (int)left : BATCH, fastest);
#pragma omp atomic
      bad += failed;
    }
  }
  if (bad)
    return FAIL(ERR_DIVERGED, "mpm: %ld points could not be strained at t = %g s; lower numerics.dt_factor", bad,
                sim->t);
  reduce_speeds(m);
  if (!(m->now.speed < INFINITY))
    return FAIL(ERR_DIVERGED, "mpm: a solid point's velocity is not finite at t = %g s; lower numerics.dt_factor",
                sim->t);
  return OK;
}

double mpm_basis_step(const struct scene *scene)
{
  int most = 1;
  if (scene->numerics.basis != BASIS_GIMP) return 1;
  for (int d = 0; d < scene->dim; d++)
    if (scene->numerics.points_per_axis[d] > most) most = scene->numerics.points_per_axis[d];
  return 1 / sqrt(most); /* a point is h/most wide, 2 l */
}

/* elastic wave over a cell; and half a cell of motion */
double mpm_stress_dt(const struct sim *sim)
{
  const struct mpm *m = mpm_of(sim);
  double h = sim->grid.h, wave = sim->scene->numerics.dt_factor * mpm_basis_step(sim->scene) * h / m->now.wave_speed;
  return fmin(wave, m->now.speed > 0 ? 0.5 * h / m->now.speed : INFINITY);
}

enum status mpm_first_speeds(struct sim *sim, struct mpm *m)
{
  struct points *points = m->points;
  for (long r = 0; r < points->n_runs; r++) {
    const struct material *material = &sim->scene->materials[r % points->n_groups];
    if (material->model->held) continue;
    for (long p = points->start[r]; p < points->start[r + 1]; p += BATCH) {
      long left = points->start[r + 1] - p;
      speeds(m, material, sim->grid.dim, p, left < BATCH ? (int)left : BATCH, m->run_speed + 2 * r);
    }
  }
  reduce_speeds(m);
  return OK;
}
