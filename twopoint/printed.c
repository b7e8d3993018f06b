/* The forms of the two-point paper as they are printed, for comparison: porosity T(21), volumes T(39), averages of the
 * accumulated Jacobian T(40)-(44), pressure T(37), averaged for the force only T(49)-(50). theory_twopoint 14 */
#include "twopoint/twopoint.h"

#include "core/parallel.h"
#include "coupling/coupling.h"
#include "mpm/mpm.h"

#include <math.h>
#include <string.h>

/* n_i = sum w m_s n_s / sum w m_s, one where no soil is; of soils of one density the grains' volume weighs as mass */
enum status twopoint_find_porosity_printed(struct sim *sim, double dt)
{
  struct twopoint    *w = twopoint_of(sim);
  const struct mpm   *m = mpm_of(sim);
  struct box          all = grid_all(&sim->grid);
  double              least = 1e-12 * grid_cell_volume(&sim->grid);
  struct scatter_args args = {.n = 1,
                              .x = m->x_p,
                              .weight = m->volume_solid_p,
                              .value = {w->medium_porosity_p},
                              .node = {w->skeleton_porosity_nc}};
  PARALLEL_FOR
  for (long p = 0; p < m->points->n; p++) w->medium_porosity_p[p] = 1 - m->volume_solid_p[p] / m->volume_p[p];
  twopoint_clear(sim, 1, w->skeleton_porosity_nc);
  FOR_RUNS(m->points, &sim->grid, run, group) m->kernels->scatter(&m->kernel_grid, &run, &args);
  boundary_fold(&m->kernel_grid, sim->scene->solid_side, 1, w->skeleton_porosity_nc);
  FOR_BOX(&sim->grid, all, i)
  {
    double grains = w->coupling->solid_nc[i];
    w->skeleton_porosity_nc[i] = grains > least ? w->skeleton_porosity_nc[i] / grains : 1;
  }
  boundary_ghosts(&w->kernel_grid, w->sides, 1, sim->t, w->skeleton_porosity_nc);
  memcpy(w->porosity_nc, w->skeleton_porosity_nc, (size_t)sim->grid.size * sizeof(double));
  return twopoint_find_fill(sim, dt);
}

/* porosity, and increment of ln J of the solid, where the water is; T(38), (48) */
enum status twopoint_strain_solid_printed(struct sim *sim, double dt)
{
  struct twopoint   *w = twopoint_of(sim);
  int                dim = sim->grid.dim;
  struct gather_args args = {.n = 1, .x = w->x_w, .gradient_stride = dim * dim};
  args.node[0] = w->skeleton_porosity_nc;
  args.value[0] = w->porosity_w;
  for (int d = 0; d < dim && w->mpm; d++) {
    args.node[args.n] = w->mpm->vel_new_nc + d;
    args.stride[args.n] = dim;
    args.gradient[args.n++] = w->gradq_w + d * dim;
  }
  FOR_RUNS_READING(w->points, run, group)
  {
    w->kernels->gather(&w->kernel_grid, &run, &args);
    for (long p = run.begin; p < run.end && w->mpm; p++) {
      double divergence = 0;
      for (int d = 0; d < dim; d++) divergence += w->gradq_w[(p * dim + d) * dim + d];
      w->solid_dlnJ_w[p] = dt * divergence;
    }
  }
  return OK;
}

/* J-bar <- average of (J-bar exp d ln J); what it grew by goes into P, with the solid's; V with the raw increment */
enum status twopoint_update_pressure_printed(struct sim *sim, double dt)
{
  (void)dt;
  struct twopoint *w = twopoint_of(sim);
  double           K = sim->scene->fluid.bulk_modulus, largest = 1 + w->params->max_expansion;
  for (long p = 0; p < w->points->n; p++) {
    w->volume_w[p] *= exp(w->dlnJ_w[p]);
    w->averaged_w[p] = fmin(largest, w->J_w[p] * exp(w->dlnJ_w[p]));
  }
  if (w->params->average_increment) twopoint_average(sim, w, w->averaged_w, NULL, false);
  for (long p = 0; p < w->points->n; p++) {
    double n = w->porosity_w[p], solid = w->solid_dlnJ_w ? w->solid_dlnJ_w[p] : 0;
    w->P_w[p] -= K / n * ((1 - n) * solid + n * log(w->averaged_w[p] / w->J_w[p]));
    w->J_w[p] = w->averaged_w[p];
  }
  return OK;
}

/* what acts on the nodes: averaged at intervals, the state knows nothing of it */
enum status twopoint_average_push_printed(struct sim *sim, double dt)
{
  (void)dt;
  struct twopoint *w = twopoint_of(sim);
  int              m = w->params->averaging_interval;
  memcpy(w->averaged_w, w->P_w, (size_t)w->points->n * sizeof(double));
  if (m > 0 && sim->step % m == 0) twopoint_average(sim, w, w->averaged_w, NULL, true);
  return OK;
}
