/* The start at rest: the column above a place, against gravity, is weighed. theory 2.5 */
#include "mpm/at_rest.h"

#include "constitutive/constitutive.h"
#include "eos/eos.h"

#include <math.h>
#include <string.h>

void at_rest_up(const struct scene *scene, double up[3], double *g)
{
  const double origin[3] = {0, 0, 0};
  *g = 0;
  for (int d = 0; d < 3; d++) {
    up[d] = d < scene->dim ? -function_value(&scene->gravity[d], origin, 0) : 0;
    *g += up[d] * up[d];
  }
  *g = sqrt(*g);
  for (int d = 0; d < 3 && *g > 0; d++) up[d] /= *g;
}

/* the place s m up from x; on a periodic axis the column goes on at the other end */
static void along(const struct scene *scene, const double x[3], const double up[3], double s, double y[3])
{
  for (int d = 0; d < 3; d++) y[d] = x[d] + s * up[d];
  for (int d = 0; d < scene->dim; d++) {
    double width = scene->cells[d] * scene->h;
    if (scene->solid_side[2 * d].kind == SIDE_PERIODIC || scene->fluid_side[2 * d].kind == SIDE_PERIODIC)
      y[d] -= width * floor((y[d] - scene->min[d]) / width);
  }
}

static bool in_grid(const struct scene *scene, const double x[3])
{
  for (int d = 0; d < scene->dim; d++)
    if (x[d] < scene->min[d] || x[d] > scene->min[d] + scene->cells[d] * scene->h) return false;
  return true;
}

static const struct material *material_at(const struct scene *scene, const double x[3])
{
  for (int s = 0; s < scene->n_solids; s++)
    if (shape_contains(&scene->solids[s].shape, x)) return &scene->materials[scene->solids[s].material];
  return NULL;
}

/* where the fluid ends between a wet place (s = low) and a dry one (s = high) */
static double find_surface(const struct scene *scene, const double x[3], const double up[3], double low, double high)
{
  for (int i = 0; i < 60; i++) {
    double middle = 0.5 * (low + high), y[3];
    along(scene, x, up, middle, y);
    if (shape_contains(&scene->fluid.region, y))
      low = middle;
    else
      high = middle;
  }
  return 0.5 * (low + high);
}

/* height of fluid above x: the fluid is one connected body along the column; 0: x is dry */
static double head_above(const struct scene *scene, const double x[3], const double up[3], double step)
{
  double y[3], s = 0;
  if (!scene->fluid.present || !shape_contains(&scene->fluid.region, x)) return 0;
  for (;; s += step) {
    along(scene, x, up, s + step, y);
    if (!in_grid(scene, y)) break;
    if (!shape_contains(&scene->fluid.region, y)) return find_surface(scene, x, up, s, s + step);
  }
  double low = s, high = s + step; /* the grid ends in between */
  for (int i = 0; i < 60; i++) {
    double middle = 0.5 * (low + high);
    along(scene, x, up, middle, y);
    *(in_grid(scene, y) ? &low : &high) = middle;
  }
  return low;
}

/* dP/ds = rho(P) g downwards from zero; RK4, for any law */
static double hydrostatic(const struct scene *scene, double head, double g)
{
  enum { STEPS = 4 };
  double P = 0, ds = head / STEPS;
  for (int i = 0; i < STEPS && head > 0; i++) {
    double k[4], rho;
    for (int q = 0; q < 4; q++) {
      double at = P + (q == 0 ? 0 : q == 3 ? ds * k[2] : 0.5 * ds * k[q - 1]);
      scene->fluid.eos->density(scene->fluid.eos_params, 1, &at, NULL, &rho);
      k[q] = rho * g;
    }
    P += ds * (k[0] + 2 * k[1] + 2 * k[2] + k[3]) / 6;
  }
  return P;
}

/* buoyant weight of the skeleton above x, where the fluid stands `head` high: pieces of `step`, x in the middle of the
 * first */
static double skeleton_weight(const struct scene *scene, const double x[3], const double up[3], double g, double head,
                              double step)
{
  double weight = 0, y[3], below = hydrostatic(scene, head, g);
  for (double s = 0;; s += step) {
    double top = s + 0.5 * step, above = hydrostatic(scene, fmax(0, head - top), g);
    along(scene, x, up, s, y);
    if (!in_grid(scene, y)) return weight;
    const struct material *m = material_at(scene, y);
    if (m) weight += (1 - m->porosity) * (m->density * g * (s == 0 ? 0.5 * step : step) - (below - above));
    below = above;
  }
}

enum status at_rest_column(const struct scene *scene, const double x[3], struct rest *rest)
{
  double up[3], g, step = scene->h / scene->numerics.points_per_axis[scene->dim == 3 ? 2 : 1];
  at_rest_up(scene, up, &g);
  *rest = (struct rest){0};
  if (g == 0) return OK;
  for (int d = 0; d < scene->dim; d++)
    if (fabs(up[d]) > 0.5) step = scene->h / scene->numerics.points_per_axis[d];
  double head = head_above(scene, x, up, step);
  rest->pressure = hydrostatic(scene, head, g);
  rest->effective = material_at(scene, x) ? -skeleton_weight(scene, x, up, g, head, step) : 0;
  if (!isfinite(rest->pressure) || !isfinite(rest->effective))
    return FAIL(ERR_INPUT, "start: the column above (%g, %g, %g) has no finite weight; check gravity and densities",
                x[0], x[1], x[2]);
  return OK;
}
