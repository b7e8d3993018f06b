/* Back to the water points: velocity, affine matrix, position, and what follows from the velocity gradient: the
 * increment of volume where there is no skeleton, and the shear stress. theory_twopoint 3, 4, 6 */
#include "twopoint/twopoint.h"

#include "core/parallel.h"
#include "mpm/mpm.h"

#include <math.h>
#include <string.h>

/* m/s; not a number: INFINITY */
static double fastest(const struct twopoint *w, int dim, long begin, long end)
{
  double largest = 0;
  for (long p = begin; p < end; p++) {
    double square = 0;
    for (int d = 0; d < dim; d++) square += w->vel_w[p * dim + d] * w->vel_w[p * dim + d];
    largest = square <= largest ? largest : isfinite(square) ? square : INFINITY;
  }
  return sqrt(largest);
}

/* largest |J - 1| of points: to first order that of their density */
static double change(const struct twopoint *w, long begin, long end)
{
  double largest = 0;
  for (long p = begin; p < end; p++) largest = fmax(largest, fabs(w->J_w[p] - 1));
  return largest;
}

static enum status join_speeds(const struct sim *sim, struct twopoint *w)
{
  w->now.speed = 0;
  for (long r = 0; r < w->points->n_runs; r++) {
    w->now.speed = fmax(w->now.speed, w->run_speed[r]);
    w->now.density_change = fmax(w->now.density_change, w->run_change[r]);
  }
  if (w->now.speed < INFINITY) return OK;
  return FAIL(ERR_DIVERGED,
              "twopoint: water points have no finite velocity at t = %g s; lower numerics.dt_factor or raise "
              "fluid.bulk_modulus",
              sim->t);
}

enum status twopoint_find_speed(struct sim *sim, struct twopoint *w)
{
  for (long r = 0; r < w->points->n_runs; r++)
    w->run_speed[r] = fastest(w, sim->grid.dim, w->points->start[r], w->points->start[r + 1]);
  return join_speeds(sim, w);
}

struct strain {
  struct twopoint *w;
  int              dim;
  bool             strains; /* the increment of volume is that of the water's own velocity */
  double           dt, viscosity;
};

/* 2 mu (D - tr D/3): xx yy zz xy yz xz */
static void shear_stress(int dim, double mu, const double *gradv, double divergence, double stress[6])
{
  double mean = 2.0 / 3 * mu * divergence;
  for (int d = 0; d < 3; d++) stress[d] = (d < dim ? 2 * mu * gradv[d * dim + d] : 0) - mean;
  stress[3] = mu * (gradv[1] + gradv[dim]);
  stress[4] = dim == 3 ? mu * (gradv[5] + gradv[7]) : 0;
  stress[5] = dim == 3 ? mu * (gradv[2] + gradv[6]) : 0;
}

static void strain_points(void *context, long first, int n, const double *gradv)
{
  const struct strain *s = context;
  struct twopoint     *w = s->w;
  int                  dim = s->dim;
  for (int i = 0; i < n; i++, gradv += dim * dim) {
    double divergence = gradv[0] + gradv[dim + 1] + (dim == 3 ? gradv[8] : 0);
    if (s->strains) w->dlnJ_w[first + i] = s->dt * divergence;
    if (w->shear_w) shear_stress(dim, s->viscosity, gradv, divergence, w->shear_w + 6 * (first + i));
  }
}

enum status twopoint_nodes_to_points(struct sim *sim, double dt)
{
  struct twopoint      *w = twopoint_of(sim);
  bool                  strains = !w->coupling || w->params->as_printed;
  struct strain         strain = {w, sim->grid.dim, strains, dt, sim->scene->fluid.viscosity};
  const struct g2p_args args = {.dt = dt,
                                .beta = mpm_blend(sim, dt),
                                .vel_old_nc = w->water_vel_nc,
                                .vel_nc = w->water_vel_new_nc,
                                .x = w->x_w,
                                .vel = w->vel_w,
                                .affine = w->affine_w,
                                .strain = strains || w->shear_w ? strain_points : NULL,
                                .context = &strain};
  memset(w->run_speed, 0, (size_t)w->points->n_runs * sizeof *w->run_speed);
  FOR_RUNS_READING(w->points, run, group)
  {
    w->kernels->g2p(&w->kernel_grid, &run, &args);
    w->run_speed[run.index] = fastest(w, sim->grid.dim, run.begin, run.end);
    w->run_change[run.index] = change(w, run.begin, run.end);
  }
  points_wrap(&sim->grid, w->points->n, w->x_w);
  return join_speeds(sim, w);
}

double twopoint_speed_limit(const struct sim *sim)
{
  const struct twopoint *w = twopoint_of(sim);
  return w->now.speed > 0 ? 0.5 * sim->grid.h / w->now.speed : INFINITY;
}

/* explicit diffusion along every axis */
double twopoint_shear_limit(const struct sim *sim)
{
  const struct fluid *f = &sim->scene->fluid;
  double              h = sim->grid.h, diffusion = h * h * f->density / (2 * sim->grid.dim * f->viscosity);
  return fmin(twopoint_speed_limit(sim), sim->scene->numerics.dt_factor * diffusion);
}
