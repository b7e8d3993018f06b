/* Stress of the points from their velocity gradient, in batches of one material. theory 3.1, "Skeleton models" */
#include "mpm/stages.h"

#include "constitutive/constitutive.h"
#include "core/parallel.h"
#include "core/tensor.h"

#include <string.h>

enum { MAX_HISTORY = 16 };

/* Points [first, first + n) of one material, n <= POINT_BATCH. */
struct batch {
  const struct scene    *scene;
  const struct material *material;
  long                   first;
  int                    n;
};

/* dF = I + dt grad v as 3 x 3, nothing happens across the plane in 2D; volume <- det dF volume. gradv [n][dim][dim] */
static void strain_batch(int dim, double dt, int n, const double *restrict gradv, double (*restrict dF)[9],
                         double *restrict volume)
{
  for (int i = 0; i < n && dim == 2; i++) {
    const double *L = gradv + i * 4;
    double        xx = 1 + dt * L[0], xy = dt * L[1], yx = dt * L[2], yy = 1 + dt * L[3], *own = dF[i];
    own[0] = xx, own[1] = xy, own[3] = yx, own[4] = yy;
    own[2] = own[5] = own[6] = own[7] = 0, own[8] = 1;
    volume[i] *= xx * yy - xy * yx;
  }
  for (int i = 0; i < n && dim == 3; i++) {
    for (int q = 0; q < 9; q++) dF[i][q] = dt * gradv[i * 9 + q] + (q % 4 == 0);
    volume[i] *= tensor_determinant(dF[i]);
  }
}

/* F of the points of a total law as 3 x 3; own [n][dim][dim] */
static void widen_batch(int dim, int n, const double *own, double (*F)[9])
{
  for (int i = 0; i < n; i++)
    for (int q = 0; q < 9; q++)
      F[i][q] = q / 3 < dim && q % 3 < dim ? own[(i * dim + q / 3) * dim + q % 3] : q % 4 == 0;
}

/* history of a batch of a law: scene arrays hold the most that a law wants, [n][scene->n_history] */
static void copy_history(int n, int from_width, const double *from, int to_width, double *to)
{
  int least = from_width < to_width ? from_width : to_width;
  for (int i = 0; i < n; i++) memcpy(to + (long)i * to_width, from + (long)i * from_width, (size_t)least * sizeof *to);
}

/* history of the batch as its law wants it: the array of the scene, or a copy in `own` where that is wider; NULL: none
 */
static double *law_history(const struct mpm *m, const struct batch *b, double *own)
{
  int     width = b->material->model->n_history, all_width = b->scene->n_history;
  double *all = m->history_p ? m->history_p + b->first * all_width : NULL;
  if (width == 0 || width == all_width) return width == 0 ? NULL : all;
  copy_history(b->n, all_width, all, width, own);
  return own;
}

static void store_history(struct mpm *m, const struct batch *b, const double *history)
{
  int     width = b->material->model->n_history, all_width = b->scene->n_history;
  double *all = m->history_p ? m->history_p + b->first * all_width : NULL;
  if (history && history != all) copy_history(b->n, width, history, all_width, all);
}

/* stress : grad v, W/m3 */
static inline double stress_power(int dim, const double *s, const double *L)
{
  if (dim == 2) return s[XX] * L[0] + s[YY] * L[3] + s[XY] * (L[1] + L[2]);
  return s[XX] * L[0] + s[YY] * L[4] + s[ZZ] * L[8] + s[XY] * (L[1] + L[3]) + s[YZ] * (L[5] + L[7]) +
         s[XZ] * (L[2] + L[6]);
}

/* largest speeds of a batch; history of its law, NULL: none */
static void survey_speeds(const struct mpm *m, const struct batch *b, const double *history, double *seen)
{
  const struct constitutive_model *model = b->material->model;
  int                              dim = b->scene->dim;
  const double                    *vel = m->vel_p + b->first * dim;
  double                           rb[POINT_BATCH], most = 0;
  for (int i = 0; i < b->n; i++) {
    double v2 = dim == 2 ? vel[2 * i] * vel[2 * i] + vel[2 * i + 1] * vel[2 * i + 1]
                         : vel[3 * i] * vel[3 * i] + vel[3 * i + 1] * vel[3 * i + 1] + vel[3 * i + 2] * vel[3 * i + 2];
    most = v2 > most ? v2 : most;
  }
  for (int i = 0; i < b->n; i++) rb[i] = m->mass_p[b->first + i] / m->volume_p[b->first + i];
  double wave = model->wave_speed(b->material->model_params, b->n, rb, m->stress_p + b->first * 6, history);
  seen[SEEN_SPEED] = fmax(seen[SEEN_SPEED], sqrt(most));
  seen[SEEN_WAVE] = fmax(seen[SEEN_WAVE], wave);
}

static void update_batch(struct mpm *m, const struct batch *b, double dt, const double *gradv, double *seen)
{
  const struct constitutive_model *model = b->material->model;
  int                              dim = b->scene->dim;
  double  dF[POINT_BATCH][9], F[POINT_BATCH][9], own[POINT_BATCH * MAX_HISTORY], work[POINT_BATCH], power = 0;
  double *volume = m->volume_p + b->first, *stress = m->stress_p + b->first * 6, *history = law_history(m, b, own);
  strain_batch(dim, dt, b->n, gradv, dF, volume);
  if (model->total) widen_batch(dim, b->n, m->F_p + b->first * dim * dim, F);
  seen[SEEN_BAD] +=
      model->update(b->material->model_params, b->n, dt, dF[0], F[0], stress, history, history ? work : NULL);
  store_history(m, b, history);
  for (int i = 0; i < b->n && history; i++) seen[SEEN_PLASTIC] += work[i] * volume[i];
  if (history && m->heat_p) memcpy(m->heat_p + b->first, work, (size_t)b->n * sizeof *work);
  for (int i = 0; i < b->n; i++) power += volume[i] * stress_power(dim, stress + 6 * i, gradv + i * dim * dim);
  seen[SEEN_POWER] += power;
  survey_speeds(m, b, history, seen);
}

/* what the runs have seen, into the state; the step's stage fails where points could not be strained */
static enum status reduce_seen(const struct sim *sim, struct mpm *m)
{
  double bad = 0;
  m->now.wave_speed = m->now.speed = m->now.power = 0;
  for (long r = 0; r < m->points->n_runs; r++) {
    const double *seen = m->run_seen + N_SEEN * r;
    m->now.wave_speed = fmax(m->now.wave_speed, seen[SEEN_WAVE]);
    m->now.speed = fmax(m->now.speed, seen[SEEN_SPEED]);
    m->now.plastic += seen[SEEN_PLASTIC];
    m->now.power += seen[SEEN_POWER];
    bad += seen[SEEN_BAD];
  }
  if (bad > 0)
    return FAIL(ERR_DIVERGED, "mpm: %.0f points could not be strained at t = %g s; lower numerics.dt_factor", bad,
                sim->t);
  if (!(m->now.speed < INFINITY))
    return FAIL(ERR_DIVERGED, "mpm: a solid point's velocity is not finite at t = %g s; lower numerics.dt_factor",
                sim->t);
  return OK;
}

/* the batch of a run that starts at point p; it is empty where nothing is strained */
static struct batch batch_of(const struct sim *sim, const struct points *points, long r, long p)
{
  const struct material *material = scene_material(sim->scene, (int)(r % points->n_groups));
  long                   left = material->model->held ? 0 : points->start[r + 1] - p;
  return (struct batch){sim->scene, material, p, left < POINT_BATCH ? (int)left : POINT_BATCH};
}

/* F <- (I + dt grad v) F of laws that know nothing else, and where contact asks for it */
enum status mpm_deform_points(struct sim *sim, double dt)
{
  struct mpm    *m = mpm_of(sim);
  struct points *points = m->points;
  int            dim = sim->grid.dim;
  PARALLEL_FOR_DYNAMIC
  for (long r = 0; r < points->n_runs; r++) {
    long end = batch_of(sim, points, r, points->start[r]).n > 0 ? points->start[r + 1] : points->start[r];
    for (long p = points->start[r]; p < end; p++) {
      double *F = m->F_p + p * dim * dim, old[9];
      memcpy(old, F, (size_t)(dim * dim) * sizeof *F);
      for (int q = 0; q < dim * dim; q++)
        for (int k = 0; k < dim; k++) F[q] += dt * m->gradv_p[(p * dim + q / dim) * dim + k] * old[k * dim + q % dim];
    }
  }
  return OK;
}

static void clear_seen(struct mpm *m)
{
  memset(m->run_seen, 0, (size_t)(N_SEEN * m->points->n_runs) * sizeof *m->run_seen);
}

enum status mpm_update_stress(struct sim *sim, double dt)
{
  struct mpm    *m = mpm_of(sim);
  struct points *points = m->points;
  int            n = sim->grid.dim * sim->grid.dim;
  clear_seen(m);
  PARALLEL_FOR_DYNAMIC
  for (long r = 0; r < points->n_runs; r++)
    for (struct batch b = batch_of(sim, points, r, points->start[r]); b.n > 0;
         b = batch_of(sim, points, r, b.first + b.n))
      update_batch(m, &b, dt, m->gradv_p + b.first * n, m->run_seen + N_SEEN * r);
  return reduce_seen(sim, m);
}

/* a run whose points are strained as soon as they have moved */
struct strain_job {
  struct mpm  *m;
  struct batch batch;
  double       dt, *seen;
};

static void strain_now(void *context, long p, int n, const double *gradv)
{
  struct strain_job *job = context;
  job->batch.first = p;
  job->batch.n = n;
  update_batch(job->m, &job->batch, job->dt, gradv, job->seen);
}

enum status mpm_move_and_strain(struct sim *sim, double dt)
{
  struct mpm *m = mpm_of(sim);
  clear_seen(m);
  FOR_RUNS_READING(m->points, run, group)
  {
    struct g2p_args   args = mpm_motion(sim, m, dt, group);
    struct strain_job job = {m, batch_of(sim, m->points, run.index, run.begin), dt, m->run_seen + N_SEEN * run.index};
    args.strain = strain_now;
    args.context = &job;
    if (job.batch.n > 0) m->kernels->g2p(&m->kernel_grid, &run, &args);
  }
  return reduce_seen(sim, m);
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
  clear_seen(m);
  for (long r = 0; r < points->n_runs; r++)
    for (struct batch b = batch_of(sim, points, r, points->start[r]); b.n > 0;
         b = batch_of(sim, points, r, b.first + b.n)) {
      const struct constitutive_model *model = b.material->model;
      double                           own[POINT_BATCH * MAX_HISTORY], *history = law_history(m, &b, own);
      if (model->start) model->start(b.material->model_params, b.n, m->stress_p + b.first * 6, history);
      store_history(m, &b, history);
      survey_speeds(m, &b, history, m->run_seen + N_SEEN * r);
    }
  return reduce_seen(sim, m);
}
