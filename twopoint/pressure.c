/* Pressure of the water points from the divergence of the nodal volume flux. theory_twopoint 6, 7 */
#include "twopoint/twopoint.h"

#include "core/parallel.h"
#include "eos/eos.h"
#include "mpm/mpm.h"

#include <math.h>
#include <string.h>

/* calls the law for every batch of points [begin, end) */
#define FOR_BATCHES(p, n, begin, end)                                                                                  \
  for (long p = (begin), n = 0; p < (end) && (n = (end)-p < WATER_BATCH ? (end)-p : WATER_BATCH); p += n)

static void pressure_of_volume(const struct sim *sim, struct twopoint *w, long begin, long end)
{
  const struct fluid *fluid = &sim->scene->fluid;
  FOR_BATCHES(p, n, begin, end)
  {
    double rho[WATER_BATCH];
    for (int i = 0; i < n; i++) rho[i] = w->rho0 / w->J_w[p + i];
    fluid->eos->pressure(fluid->eos_params, (int)n, rho, NULL, w->P_w + p);
  }
}

static void volume_of_pressure(const struct sim *sim, struct twopoint *w, long begin, long end)
{
  const struct fluid *fluid = &sim->scene->fluid;
  FOR_BATCHES(p, n, begin, end)
  {
    double rho[WATER_BATCH];
    fluid->eos->density(fluid->eos_params, (int)n, w->P_w + p, NULL, rho);
    for (int i = 0; i < n; i++) {
      w->J_w[p + i] = w->rho0 / rho[i];
      w->volume_w[p + i] = w->mass_w[p + i] / (rho[i] * w->porosity_w[p + i]);
    }
  }
}

void twopoint_volume_of_pressure(const struct sim *sim, struct twopoint *w)
{
  PARALLEL_FOR
  for (long r = 0; r < w->points->n_runs; r++) volume_of_pressure(sim, w, w->points->start[r], w->points->start[r + 1]);
}

/* q = n v_f + (1 - n) v_s; its divergence is the adjoint of the forces n F and (1 - n) F */
static void find_flux(const struct sim *sim, struct twopoint *w)
{
  struct box all = grid_all(&sim->grid);
  int        dim = sim->grid.dim;
  FOR_BOX(&sim->grid, all, i)
  for (int d = 0; d < dim; d++) {
    double n = w->porosity_nc[i], solid = w->mpm ? w->mpm->vel_new_nc[i * dim + d] : 0;
    w->flux_nc[i * dim + d] = n * w->water_vel_new_nc[i * dim + d] + (1 - n) * solid;
  }
}

/* dlnJ = dt div q / n, n taken at the same place */
static void find_increment(struct twopoint *w, int dim, double dt, long begin, long end)
{
  for (long p = begin; p < end; p++) {
    double divergence = 0;
    for (int d = 0; d < dim; d++) divergence += w->gradq_w[(p * dim + d) * dim + d];
    w->dlnJ_w[p] = dt * divergence / w->porosity_w[p];
  }
}

/* in a skeleton; without one the increment comes with the points' velocity gradient */
enum status twopoint_strain_water(struct sim *sim, double dt)
{
  struct twopoint   *w = twopoint_of(sim);
  int                dim = sim->grid.dim;
  struct gather_args args = {.n = dim + 1, .x = w->x_w, .gradient_stride = dim * dim};
  for (int d = 0; d < dim; d++) {
    args.node[d] = w->flux_nc + d;
    args.stride[d] = dim;
    args.gradient[d] = w->gradq_w + d * dim;
  }
  args.node[dim] = w->skeleton_porosity_nc;
  args.value[dim] = w->porosity_w;
  find_flux(sim, w);
  FOR_RUNS_READING(w->points, run, group)
  {
    w->kernels->gather(&w->kernel_grid, &run, &args);
    find_increment(w, dim, dt, run.begin, run.end);
  }
  return OK;
}

/* exp(a), by its series where that is exact to round-off */
static double growth(double a) { return fabs(a) < 1e-4 ? 1 + a * (1 + a / 2 * (1 + a / 3)) : exp(a); }

/* J and P at the end of the step, and the volume that goes with them */
static void compress(const struct sim *sim, struct twopoint *w, long begin, long end)
{
  double largest = 1 + w->params->max_expansion;
  for (long p = begin; p < end; p++) {
    w->J_w[p] = fmin(largest, w->J_w[p] * growth(w->dlnJ_w[p]));
    w->volume_w[p] = w->mass_w[p] * w->J_w[p] / (w->rho0 * w->porosity_w[p]);
  }
  pressure_of_volume(sim, w, begin, end);
}

enum status twopoint_update_pressure(struct sim *sim, double dt)
{
  (void)dt;
  struct twopoint *w = twopoint_of(sim);
  PARALLEL_FOR
  for (long r = 0; r < w->points->n_runs; r++) compress(sim, w, w->points->start[r], w->points->start[r + 1]);
  return OK;
}

/* the same with the averaged increment; the slope down which points shift comes in the same pass */
enum status twopoint_average_and_update(struct sim *sim, double dt)
{
  (void)dt;
  struct twopoint   *w = twopoint_of(sim);
  struct gather_args args = {.n = 1, .x = w->x_w, .node = {w->average_nc, w->excess_nc}};
  args.value[0] = w->dlnJ_w;
  args.gradient[1] = w->slope_w;
  twopoint_finish_average(sim, w, &w->kernel_grid, w->water_volume_nc);
  if (w->params->shifting > 0 && twopoint_find_excess(sim, w)) args.n = 2;
  FOR_RUNS_READING(w->points, run, group)
  {
    w->kernels->gather(&w->kernel_grid, &run, &args);
    compress(sim, w, run.begin, run.end);
    if (args.n == 2) twopoint_shift_run(sim, w, run.begin, run.end);
  }
  return OK;
}

enum status twopoint_average_pressure(struct sim *sim, double dt)
{
  (void)dt;
  struct twopoint *w = twopoint_of(sim);
  if (sim->step % w->params->averaging_interval != 0) return OK;
  twopoint_average(sim, w, w->P_w, w->gradP_w, true);
  twopoint_volume_of_pressure(sim, w);
  return OK;
}

/* sound */
double twopoint_wave_limit(const struct sim *sim)
{
  const struct twopoint *w = twopoint_of(sim);
  return sim->scene->numerics.dt_factor * mpm_basis_step(sim->scene) * sim->grid.h / w->fast_wave;
}
