/* Pressure of the water points from the divergence of the nodal volume flux. theory_twopoint 6, 7 */
#include "twopoint/twopoint.h"

#include "core/parallel.h"
#include "eos/eos.h"
#include "mpm/mpm.h"

#include <math.h>
#include <string.h>

void twopoint_pressure_of_volume(const struct sim *sim, struct twopoint *w)
{
  const struct fluid *fluid = &sim->scene->fluid;
  PARALLEL_FOR
  for (long p = 0; p < w->points->n; p += WATER_BATCH) {
    int    n = w->points->n - p < WATER_BATCH ? (int)(w->points->n - p) : WATER_BATCH;
    double rho[WATER_BATCH];
    for (int i = 0; i < n; i++) rho[i] = w->rho0 / w->J_w[p + i];
    fluid->eos->pressure(fluid->eos_params, n, rho, NULL, w->P_w + p);
  }
}

void twopoint_volume_of_pressure(const struct sim *sim, struct twopoint *w)
{
  const struct fluid *fluid = &sim->scene->fluid;
  PARALLEL_FOR
  for (long p = 0; p < w->points->n; p += WATER_BATCH) {
    int    n = w->points->n - p < WATER_BATCH ? (int)(w->points->n - p) : WATER_BATCH;
    double rho[WATER_BATCH];
    fluid->eos->density(fluid->eos_params, n, w->P_w + p, NULL, rho);
    for (int i = 0; i < n; i++) w->J_w[p + i] = w->rho0 / rho[i];
  }
}

/* q = n v_f + (1 - n) v_s; its divergence is the adjoint of the forces n F and (1 - n) F */
static void find_flux(const struct sim *sim, struct twopoint *w)
{
  struct box all = grid_all(&sim->grid);
  int        dim = sim->grid.dim;
  memcpy(w->flux_nc, w->water_vel_new_nc, (size_t)(sim->grid.size * dim) * sizeof(double));
  if (!w->coupling) return;
  FOR_BOX(&sim->grid, all, i)
  for (int d = 0; d < dim; d++) {
    double solid = w->mpm ? w->mpm->vel_new_nc[i * dim + d] : 0;
    w->flux_nc[i * dim + d] = w->porosity_nc[i] * w->flux_nc[i * dim + d] + (1 - w->porosity_nc[i]) * solid;
  }
}

/* dlnJ = dt div q / n at every point, n taken at the same place */
static void find_increment(struct sim *sim, struct twopoint *w, double dt)
{
  int                dim = sim->grid.dim;
  struct gather_args args = {.n = dim, .x = w->x_w, .gradient_stride = dim * dim};
  for (int d = 0; d < dim; d++) {
    args.node[d] = w->flux_nc + d;
    args.stride[d] = dim;
    args.gradient[d] = w->gradq_w + d * dim;
  }
  if (w->coupling) {
    args.node[dim] = w->skeleton_porosity_nc;
    args.value[dim] = w->porosity_w;
    args.n++;
  }
  FOR_RUNS(w->points, &sim->grid, run, group) w->kernels->gather(&w->kernel_grid, &run, &args);
  PARALLEL_FOR
  for (long p = 0; p < w->points->n; p++) {
    double divergence = 0;
    for (int d = 0; d < dim; d++) divergence += w->gradq_w[(p * dim + d) * dim + d];
    w->dlnJ_w[p] = dt * divergence / w->porosity_w[p];
  }
}

enum status twopoint_update_pressure(struct sim *sim, double dt)
{
  struct twopoint *w = twopoint_of(sim);
  double           largest = 1 + w->params->max_expansion;
  int              m = w->params->averaging_interval;
  find_flux(sim, w);
  find_increment(sim, w, dt);
  if (w->params->average_increment) twopoint_average(sim, w, w->dlnJ_w, NULL);
  PARALLEL_FOR
  for (long p = 0; p < w->points->n; p++) w->J_w[p] = fmin(largest, w->J_w[p] * exp(w->dlnJ_w[p]));
  twopoint_pressure_of_volume(sim, w);
  if (m > 0 && sim->step % m == 0) {
    twopoint_average(sim, w, w->P_w, w->gradP_w);
    twopoint_volume_of_pressure(sim, w);
  }
  return OK;
}
