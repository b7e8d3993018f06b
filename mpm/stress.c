/* Stress of the points from their velocity gradient, in batches of one material. theory 3.1, "Skeleton models" */
#include "mpm/stages.h"

#include "constitutive/constitutive.h"
#include "core/parallel.h"
#include "core/tensor.h"

#include <string.h>

enum { BATCH = 64, MAX_HISTORY = 16 };

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

/* history of a batch of a law: scene arrays hold the most that a law wants, [n][scene->n_history] */
static void copy_history(int n, int from_width, const double *from, int to_width, double *to)
{
  int least = from_width < to_width ? from_width : to_width;
  for (int i = 0; i < n; i++) memcpy(to + (long)i * to_width, from + (long)i * from_width, (size_t)least * sizeof *to);
}

/* what a run of points adds to the state: largest wave speed and speed (m/s), plastic work of the step (J) */
static void survey(const struct mpm *m, const struct material *material, int dim, long p0, int n, const double *history,
                   double seen[RUN_SPEEDS])
{
  double rb[BATCH];
  for (int i = 0; i < n; i++) {
    double v2 = 0;
    for (int d = 0; d < dim; d++) v2 += m->vel_p[(p0 + i) * dim + d] * m->vel_p[(p0 + i) * dim + d];
    rb[i] = m->mass_p[p0 + i] / m->volume_p[p0 + i];
    seen[1] = fmax(seen[1], sqrt(v2));
  }
  seen[0] = fmax(seen[0], material->model->wave_speed(material->model_params, n, rb, m->stress_p + p0 * 6, history));
}

static int update_batch(struct mpm *m, const struct scene *scene, const struct material *material, double dt, long p0,
                        int n, double seen[RUN_SPEEDS])
{
  const struct constitutive_model *model = material->model;
  double                           dF[BATCH][9], F[BATCH][9], work[BATCH], own[BATCH * MAX_HISTORY], *history = NULL;
  double                          *all = m->history_p ? m->history_p + p0 * scene->n_history : NULL;
  strain_batch(m, scene->dim, dt, p0, n, dF, F);
  if (model->n_history > 0) history = model->n_history == scene->n_history ? all : own;
  if (history == own) copy_history(n, scene->n_history, all, model->n_history, own);
  int bad = model->update(material->model_params, n, dt, dF[0], F[0], m->stress_p + p0 * 6, history,
                          model->n_history > 0 ? work : NULL);
  if (history == own) copy_history(n, model->n_history, own, scene->n_history, all);
  for (int i = 0; i < n && history; i++) seen[2] += work[i] * m->volume_p[p0 + i];
  if (history && m->heat_p) memcpy(m->heat_p + p0, work, (size_t)n * sizeof *work);
  survey(m, material, scene->dim, p0, n, history, seen);
  return bad;
}

static void reduce_speeds(struct mpm *m)
{
  m->now.wave_speed = m->now.speed = 0;
  for (long r = 0; r < m->points->n_runs; r++) {
    const double *seen = m->run_speed + RUN_SPEEDS * r;
    m->now.wave_speed = fmax(m->now.wave_speed, seen[0]);
    m->now.speed = fmax(m->now.speed, seen[1]);
    m->now.plastic += seen[2];
  }
}

enum status mpm_update_stress(struct sim *sim, double dt)
{
  struct mpm    *m = mpm_of(sim);
  struct points *points = m->points;
  long           bad = 0;
  PARALLEL_FOR_DYNAMIC
  for (long r = 0; r < points->n_runs; r++) {
    const struct material *material = scene_material(sim->scene, (int)(r % points->n_groups));
    double                *seen = m->run_speed + RUN_SPEEDS * r;
    memset(seen, 0, RUN_SPEEDS * sizeof *seen);
    if (material->model->held) continue;
    for (long p = points->start[r]; p < points->start[r + 1]; p += BATCH) {
      long left = points->start[r + 1] - p;
      int  failed = update_batch(m, sim->scene, material, dt, p, left < BATCH ? (int)left : BATCH, seen);
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
    const struct material *material = scene_material(sim->scene, (int)(r % points->n_groups));
    if (material->model->held) continue;
    for (long p = points->start[r]; p < points->start[r + 1]; p += BATCH) {
      long   left = points->start[r + 1] - p;
      int    n = left < BATCH ? (int)left : BATCH, width = material->model->n_history;
      double own[BATCH * MAX_HISTORY], *all = m->history_p ? m->history_p + p * sim->scene->n_history : NULL;
      if (material->model->start) material->model->start(material->model_params, n, m->stress_p + p * 6, own);
      if (material->model->start) copy_history(n, width, own, sim->scene->n_history, all);
      if (width > 0) copy_history(n, sim->scene->n_history, all, width, own);
      survey(m, material, sim->grid.dim, p, n, width > 0 ? own : NULL, m->run_speed + RUN_SPEEDS * r);
    }
  }
  reduce_speeds(m);
  return OK;
}
