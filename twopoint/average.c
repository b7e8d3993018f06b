/* Averages over volume, point -> node -> point. theory_twopoint 7 */
#include "twopoint/twopoint.h"

#include "core/parallel.h"
#include "mpm/mpm.h"

/* periodic axes still need their images; walls are in the basis */
static void fold(struct twopoint *w, double *field) { boundary_fold(&w->average_grid, w->sides, 1, field); }

void twopoint_finish_average(struct sim *sim, struct twopoint *w, const struct kernel_grid *kg, const double *weight)
{
  struct box all = grid_all(&sim->grid);
  double     least = 1e-12 * grid_cell_volume(&sim->grid);
  FOR_BOX(&sim->grid, all, i) w->average_nc[i] = weight[i] > least ? w->average_nc[i] / weight[i] : 0;
  boundary_ghosts(kg, w->sides, 1, sim->t, w->average_nc);
}

/* no more than a share of the room of these nodes is filled: the surface passes by. 7 */
enum status twopoint_find_surface(struct sim *sim, double dt)
{
  (void)dt;
  struct twopoint *w = twopoint_of(sim);
  struct box       all = grid_all(&sim->grid);
  FOR_BOX(&sim->grid, all, i)
  w->surface_nc[i] = w->water_room_nc[i] > 0 && w->water_volume_nc[i] < w->params->surface_fill * w->water_room_nc[i];
  return OK;
}

static void empty_surface(struct sim *sim, struct twopoint *w)
{
  struct box all = grid_all(&sim->grid);
  FOR_BOX(&sim->grid, all, i)
  if (w->surface_nc[i] > 0) w->average_nc[i] = 0;
}

void twopoint_average(struct sim *sim, struct twopoint *w, double *q, double *gradient, bool pressure)
{
  struct scatter_args to_nodes = {.n = 2,
                                  .x = w->x_w,
                                  .weight = w->volume_w,
                                  .value = {NULL, q},
                                  .gradient = {NULL, gradient},
                                  .node = {w->weight_nc, w->average_nc}};
  struct gather_args  to_points = {.n = 1, .x = w->x_w, .node = {w->average_nc}, .value = {q}, .gradient = {gradient}};
  twopoint_clear(sim, 1, w->weight_nc);
  twopoint_clear(sim, 1, w->average_nc);
  FOR_RUNS(w->points, &sim->grid, run, group) w->kernels->scatter(&w->average_grid, &run, &to_nodes);
  fold(w, w->weight_nc);
  fold(w, w->average_nc);
  twopoint_finish_average(sim, w, &w->average_grid, w->weight_nc);
  if (pressure && w->surface_nc) empty_surface(sim, w);
  FOR_RUNS_READING(w->points, run, group) w->kernels->gather(&w->average_grid, &run, &to_points);
}
