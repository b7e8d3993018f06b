/* Where the water is at the start, its masses and pressures, and which scenes this path refuses. theory_twopoint 10 */
#include "twopoint/twopoint.h"

#include "constitutive/constitutive.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "coupling/coupling.h"
#include "eos/eos.h"
#include "mpm/at_rest.h"
#include "mpm/mpm.h"

#include <math.h>
#include <string.h>

static const char *const side_names[] = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

static bool is_zero(const struct function *f) { return !f->expression && f->constant == 0; }

static enum status check_side(const struct side_condition *side, int i)
{
  if (side->kind == SIDE_PRESSURE && !is_zero(&side->pressure))
    return FAIL(ERR_INPUT,
                "boundary.fluid.%s.pressure: the twopoint path knows only the pressure 0 of a free surface; use 0, or "
                "the path ice",
                side_names[i]);
  if (side->kind == SIDE_VELOCITY && !is_zero(&side->velocity[i / 2]))
    return FAIL(
        ERR_INPUT,
        "boundary.fluid.%s.velocity: the twopoint path lets no water through a side; make the component along the "
        "side's normal 0, or use the path ice",
        side_names[i]);
  return OK;
}

enum status twopoint_check(const struct scene *scene)
{
  if (!isfinite(scene->fluid.bulk_modulus))
    return FAIL(
        ERR_INPUT,
        "fluid.bulk_modulus: the twopoint path needs a finite fluid.bulk_modulus; give one in Pa, or use the path ice");
  for (int i = 0; i < 2 * scene->dim; i++) TRY(check_side(&scene->fluid_side[i], i));
  return OK;
}

double twopoint_fast_wave(double n, double E_oed, double rho_s, double rho, double K)
{
  double rb = (1 - n) * rho_s, a = isinf(rho_s) ? 0 : (E_oed + (1 - n) * (1 - n) * K / n) / rb, d = K / rho;
  double bb = isinf(rho_s) ? 0 : (1 - n) * (1 - n) * K * K / (rb * n * rho);
  return sqrt(0.5 * (a + d) + sqrt(0.25 * (a - d) * (a - d) + bb));
}

/* of the free water and of every medium that it may meet */
static double fastest_wave(const struct scene *scene)
{
  const struct fluid *f = &scene->fluid;
  double              c = sqrt(f->bulk_modulus / f->density);
  for (int s = 0; s < scene->n_solids; s++) {
    const struct material *m = &scene->materials[scene->solids[s].material];
    if (m->model->held || !(m->porosity > 0)) continue;
    double modulus = m->model->oedometer_modulus(m->model_params);
    c = fmax(c, twopoint_fast_wave(m->porosity, modulus, m->density, f->density, f->bulk_modulus));
  }
  return c;
}

static bool grains_held(const struct scene *scene)
{
  for (int s = 0; s < scene->n_solids; s++)
    if (scene->materials[scene->solids[s].material].model->held) return true;
  return false;
}

/* which components walls prescribe: those that boundary_velocity writes */
static void mark_bound(const struct sim *sim, const struct side_condition *sides, double *shelf, unsigned char *bound)
{
  long n = sim->grid.size * sim->grid.dim;
  for (long i = 0; i < n; i++) shelf[i] = INFINITY;
  boundary_velocity(&sim->grid, sides, 0, shelf);
  for (long i = 0; i < n; i++) bound[i] = shelf[i] < INFINITY;
}

static enum status create_grids(struct sim *sim, struct twopoint *w)
{
  const struct scene *scene = sim->scene;
  struct box          all = grid_all(&sim->grid);
  long                n = sim->grid.size * sim->grid.dim;
  memcpy(w->sides, scene->fluid_side, sizeof w->sides);
  for (int i = 0; i < SIDES; i++)
    if (w->sides[i].kind == SIDE_PRESSURE) w->sides[i].kind = SIDE_OPEN;
  kernel_grid_create(&sim->grid, &scene->numerics, w->sides, &w->kernel_grid);
  w->average_grid = w->kernel_grid;
  for (int i = 0; i < 2 * sim->grid.dim; i++)
    w->average_grid.modified[i] = w->sides[i].kind != SIDE_OPEN && !sim->grid.periodic[i / 2];
  FOR_BOX_SERIAL(&sim->grid, all, i) w->water_room_nc[i] = boundary_room(&w->kernel_grid, scene->numerics.basis, i);
  TRY(NEW(&w->water_bound, n));
  TRY(NEW(&w->solid_bound, n));
  mark_bound(sim, w->sides, w->water_star_nc, w->water_bound);
  mark_bound(sim, scene->solid_side, w->water_star_nc, w->solid_bound);
  TRY(NEW(&w->run_change, w->points->n_runs));
  return NEW(&w->run_speed, w->points->n_runs);
}

/* affine matrix of the starting velocity by central differences: a spinning body starts with its whole spin */
static void start_affine(const struct sim *sim, struct twopoint *w, long p, const double x[3])
{
  int    dim = sim->grid.dim;
  double e = 1e-3 * sim->grid.h;
  for (int d = 0; d < dim; d++)
    for (int f = 0; f < dim; f++) {
      const struct function *vel = &sim->scene->fluid.velocity[d];
      double                 up[3] = {x[0], x[1], x[2]}, low[3] = {x[0], x[1], x[2]};
      up[f] += e;
      low[f] -= e;
      w->affine_w[(p * dim + d) * dim + f] = (function_value(vel, up, 0) - function_value(vel, low, 0)) / (2 * e);
    }
}

/* pressure at the start, and its gradient where it is known */
static enum status start_pressure(const struct sim *sim, struct twopoint *w, long p, const double x[3])
{
  const struct scene *scene = sim->scene;
  struct rest         rest;
  double              g[3], rho;
  sim_gravity(sim, 0, g);
  w->P_w[p] = function_value(&scene->fluid.pressure, x, 0);
  if (scene->start != START_AT_REST || g[0] * g[0] + g[1] * g[1] + g[2] * g[2] == 0) return OK;
  TRY(at_rest_column(scene, x, &rest));
  w->P_w[p] = rest.pressure;
  scene->fluid.eos->density(scene->fluid.eos_params, 1, &rest.pressure, NULL, &rho);
  for (int d = 0; d < sim->grid.dim && w->gradP_w; d++) w->gradP_w[p * sim->grid.dim + d] = rho * g[d];
  return OK;
}

/* in [-1, 1), the same for the same seed, point and axis: the mixer of splitmix64 */
static double noise(int seed, long p, int axis)
{
  unsigned long long z = ((unsigned long long)seed << 40) + 3 * (unsigned long long)p + (unsigned long long)axis;
  z = (z + 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return (double)(z >> 11) * 0x1p-52 - 1;
}

/* less than half a spacing: not across the ends of the grid */
static void displace(const struct scene *scene, double jitter, long p, double x[3])
{
  for (int d = 0; d < scene->dim; d++)
    x[d] += jitter * scene->h / scene->numerics.points_per_axis[d] * noise(scene->seed, p, d);
}

static enum status place_points(struct sim *sim, struct twopoint *w)
{
  const struct scene *scene = sim->scene;
  double(*x)[3];
  struct shape parts[1 + MAX_OBSTACLES], region = twopoint_region(scene, parts);
  int          dim = sim->grid.dim;
  TRY(NEW(&x, w->points->n));
  mpm_fill_shape(scene, &region, x);
  for (long p = 0; p < w->points->n; p++) {
    displace(scene, w->params->jitter, p, x[p]);
    for (int d = 0; d < dim; d++) {
      w->x_w[p * dim + d] = x[p][d];
      w->vel_w[p * dim + d] = function_value(&scene->fluid.velocity[d], x[p], 0);
    }
    if (w->affine_w) start_affine(sim, w, p, x[p]);
    w->volume_w[p] = mpm_point_volume(scene);
    w->porosity_w[p] = 1;
    TRY(start_pressure(sim, w, p, x[p]));
  }
  memory_free(&x);
  return OK;
}

/* a point fills its piece of the lattice: its mass follows from the porosity that it sees and the density there */
static void weigh_points(struct sim *sim, struct twopoint *w)
{
  const double zero = 0;
  sim->scene->fluid.eos->density(sim->scene->fluid.eos_params, 1, &zero, NULL, &w->rho0);
  if (w->coupling) twopoint_start_porosity(sim, w);
  twopoint_volume_of_pressure(sim, w); /* J */
  w->mass_floor = INFINITY;
  for (long p = 0; p < w->points->n; p++) {
    w->mass_w[p] = w->rho0 * w->porosity_w[p] * mpm_point_volume(sim->scene) / w->J_w[p];
    w->mass_floor = fmin(w->mass_floor, 1e-9 * w->mass_w[p]);
  }
  twopoint_volume_of_pressure(sim, w);
  twopoint_gather_volumes(sim, w, NULL);
}

enum status twopoint_create(struct sim *sim, void *state)
{
  struct twopoint    *w = state;
  const struct scene *scene = sim->scene;
  w->params = scene_module_params(scene, &module_twopoint);
  w->kernels = kernels_find(sim->grid.dim, scene->numerics.basis);
  w->points = sim->points[SET_WATER];
  w->coupling = coupling_of(sim);
  w->mpm = mpm_solid_moves(scene) ? mpm_of(sim) : NULL;
  w->grains_held = grains_held(scene);
  w->fast_wave = fastest_wave(scene);
  TRY(create_grids(sim, w));
  TRY(place_points(sim, w));
  TRY(twopoint_sort_now(sim, w));
  TRY(twopoint_create_walls(sim, w));
  weigh_points(sim, w);
  return twopoint_find_speed(sim, w);
}

void twopoint_destroy(void *state)
{
  struct twopoint *w = state;
  memory_free(&w->water_bound);
  memory_free(&w->solid_bound);
  memory_free(&w->run_speed);
  twopoint_destroy_walls(w);
  memory_free(&w->run_change);
}
