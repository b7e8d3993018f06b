/* Where points, loaded surfaces and tracers are at the start. */
#include "mpm/create.h"

#include "constitutive/constitutive.h"
#include "core/memory.h"
#include "core/tensor.h"
#include "mpm/at_rest.h"

#include <string.h>

double mpm_point_volume(const struct scene *scene)
{
  double v = 1;
  for (int d = 0; d < scene->dim; d++) v *= scene->h / scene->numerics.points_per_axis[d];
  return v;
}

/* place number i of the lattice; false past its end */
static bool lattice_place(const struct scene *scene, long i, double x[3])
{
  x[2] = 0;
  for (int d = 0; d < scene->dim; d++) {
    int  ppa = scene->numerics.points_per_axis[d];
    long n = (long)scene->cells[d] * ppa;
    x[d] = scene->min[d] + ((double)(i % n) + 0.5) * scene->h / ppa;
    i /= n;
  }
  return i == 0;
}

long mpm_fill_shape(const struct scene *scene, const struct shape *shape, double (*x)[3])
{
  long   n = 0;
  double place[3];
  for (long i = 0; lattice_place(scene, i, place); i++)
    if (shape_contains(shape, place)) {
      if (x) memcpy(x[n], place, sizeof place);
      n++;
    }
  return n;
}

long mpm_place_points(const struct scene *scene, double (*x)[3], int *body)
{
  long n = 0;
  for (int s = 0; s < scene->n_solids; s++) {
    long added = mpm_fill_shape(scene, &scene->solids[s].shape, x ? x + n : NULL);
    for (long q = n; body && q < n + added; q++) body[q] = s;
    n += added;
  }
  return n;
}

static void place_point(const struct scene *scene, struct mpm *m, long p, const double x[3], const struct solid *solid)
{
  const struct material *material = &scene->materials[solid->material];
  int                    dim = scene->dim;
  double                 volume = mpm_point_volume(scene);
  if (m->volume_p) m->volume_p[p] = volume;
  if (m->volume_solid_p) m->volume_solid_p[p] = (1 - material->porosity) * volume;
  if (m->mass_p) m->mass_p[p] = material->density * (1 - material->porosity) * volume;
  for (int d = 0; d < dim; d++) {
    m->x_p[p * dim + d] = x[d];
    if (m->vel_p) m->vel_p[p * dim + d] = function_value(&solid->velocity[d], x, 0);
    if (m->F_p) m->F_p[(p * dim + d) * dim + d] = 1;
  }
  m->points->group[p] = (unsigned char)(solid - scene->solids);
}

/* affine matrix of the starting velocity by central differences, so that a spinning body starts with its whole spin */
static void start_affine(const struct sim *sim, struct mpm *m, long p, const double x[3], const struct solid *solid)
{
  int    dim = sim->grid.dim;
  double e = 1e-3 * sim->grid.h;
  for (int d = 0; d < dim; d++)
    for (int f = 0; f < dim; f++) {
      double up[3] = {x[0], x[1], x[2]}, low[3] = {x[0], x[1], x[2]};
      up[f] += e;
      low[f] -= e;
      m->affine_p[(p * dim + d) * dim + f] =
          (function_value(&solid->velocity[d], up, 0) - function_value(&solid->velocity[d], low, 0)) / (2 * e);
    }
}

enum status mpm_create_points(struct sim *sim, struct mpm *m)
{
  const struct scene *scene = sim->scene;
  double(*x)[3];
  int *body;
  long n = m->points->n;
  TRY(NEW(&x, n));
  TRY(NEW(&body, n));
  mpm_place_points(scene, x, body);
  for (long p = 0; p < n; p++) {
    place_point(scene, m, p, x[p], &scene->solids[body[p]]);
    if (m->affine_p) start_affine(sim, m, p, x[p], &scene->solids[body[p]]);
  }
  memory_free(&x);
  memory_free(&body);
  return OK;
}

/* stress of a law that knows only F, stretched by s along up: what a column without lateral strain has */
static double stretched(const struct material *material, const double up[3], double s, double F[9], double stress[6])
{
  static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  double              S[9], along = 0;
  for (int q = 0; q < 9; q++) F[q] = identity[q] + (s - 1) * up[q / 3] * up[q % 3];
  material->model->update(material->model_params, 1, 0, identity, F, stress, NULL, NULL);
  tensor_from_symmetric(stress, S);
  for (int q = 0; q < 9; q++) along += S[q] * up[q / 3] * up[q % 3];
  return along;
}

/* the stretch that carries `effective`, by halving */
static void start_stretch(struct mpm *m, const struct material *material, const double up[3], int dim, long p,
                          double effective)
{
  double low = 1e-3, high = 1, F[9];
  for (int i = 0; i < 100; i++) {
    double middle = 0.5 * (low + high);
    *(stretched(material, up, middle, F, m->stress_p + 6 * p) < effective ? &low : &high) = middle;
  }
  for (int q = 0; q < dim * dim; q++) m->F_p[p * dim * dim + q] = F[q / dim * 3 + q % dim];
}

static double lateral_ratio(const struct material *material)
{
  if (material->lateral_ratio >= 0) return material->lateral_ratio;
  return material->model->held ? 1 : material->model->lateral_ratio(material->model_params);
}

/* geostatic stress of the points: vertical from the weight above, lateral by the material's ratio */
enum status mpm_start_stress(struct sim *sim, struct mpm *m)
{
  const struct scene *scene = sim->scene;
  double              up[3], g;
  at_rest_up(scene, up, &g);
  if (scene->start != START_AT_REST || g == 0 || !m->stress_p) return OK;
  for (long p = 0; p < m->points->n; p++) {
    const struct material *material = scene_material(scene, m->points->group[p]);
    struct rest            rest;
    double                 x[3] = {0}, stress[9];
    for (int d = 0; d < scene->dim; d++) x[d] = m->x_p[p * scene->dim + d];
    TRY(at_rest_column(scene, x, &rest));
    if (material->model->total) {
      start_stretch(m, material, up, scene->dim, p, fmin(0, rest.effective));
      continue;
    }
    double lateral = lateral_ratio(material);
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++)
        stress[3 * i + j] = rest.effective * (lateral * (i == j) + (1 - lateral) * up[i] * up[j]);
    tensor_to_symmetric(stress, m->stress_p + 6 * p);
  }
  return OK;
}

/* ends of a patch along an axis, clipped to the grid; equal where the patch has no width */
static double patch_extent(const struct scene *scene, const struct shape *patch, int d, double *low)
{
  double top = scene->min[d] + scene->cells[d] * scene->h;
  *low = fmax(patch->min[d], scene->min[d]);
  return fmin(patch->max[d], top) - *low;
}

enum { MARKERS_PER_CELL = 4, ARC_MARKERS = 1024 };

/* a flat patch: markers at the middle of equal pieces, MARKERS_PER_CELL per cell and axis */
static long place_patch(const struct scene *scene, const struct load *load, long first, struct mpm *m)
{
  int    dim = scene->dim, pieces[3] = {1, 1, 1};
  double low[3] = {0}, extent[3] = {0}, area = 1;
  long   n = 1;
  for (int d = 0; d < dim; d++) {
    extent[d] = patch_extent(scene, &load->patch, d, &low[d]);
    if (extent[d] > 1e-9 * scene->h) {
      pieces[d] = (int)ceil(extent[d] / scene->h * MARKERS_PER_CELL - 1e-9);
      area *= extent[d] / pieces[d];
    }
    n *= pieces[d];
  }
  for (long i = 0; i < n && m; i++) {
    long left = i;
    for (int d = 0; d < dim; d++) {
      m->x_m[(first + i) * dim + d] = low[d] + (double)(left % pieces[d] + 0.5) * extent[d] / pieces[d];
      left /= pieces[d];
      m->marker_normal[first + i][d] = extent[d] > 1e-9 * scene->h ? 0 : 1;
    }
    m->marker_area[first + i] = area;
  }
  return n;
}

/* the part of a circle inside the grid, cut into ARC_MARKERS equal pieces of the whole circle */
static long place_arc(const struct scene *scene, const struct load *load, long first, struct mpm *m)
{
  const double pi = acos(-1.0);
  long         n = 0;
  for (int i = 0; i < ARC_MARKERS; i++) {
    double angle = 2 * pi * (i + 0.5) / ARC_MARKERS, x[2];
    bool   inside = true;
    for (int d = 0; d < 2; d++) {
      x[d] = load->patch.centre[d] + load->patch.radius * (d ? sin(angle) : cos(angle));
      inside = inside && x[d] >= scene->min[d] && x[d] <= scene->min[d] + scene->cells[d] * scene->h;
    }
    if (!inside) continue;
    for (int d = 0; d < 2 && m; d++) {
      m->x_m[(first + n) * 2 + d] = x[d];
      m->marker_normal[first + n][d] = d ? sin(angle) : cos(angle);
    }
    if (m) m->marker_area[first + n] = 2 * pi * load->patch.radius / ARC_MARKERS;
    n++;
  }
  return n;
}

static long place_load(const struct scene *scene, const struct load *load, long first, struct mpm *m)
{
  return load->patch.kind == SHAPE_BALL ? place_arc(scene, load, first, m) : place_patch(scene, load, first, m);
}

long mpm_count_markers(const struct scene *scene)
{
  long n = scene->n_tracers;
  for (int i = 0; i < scene->n_loads; i++) n += place_load(scene, &scene->loads[i], 0, NULL);
  return n;
}

/* body whose solid is nearest to a marker at x [dim] */
static int nearest_body(const struct scene *scene, const double *x)
{
  double place[3] = {0}, least = INFINITY;
  int    body = 0;
  for (int d = 0; d < scene->dim; d++) place[d] = x[d];
  for (int s = 0; s < scene->n_solids; s++) {
    double distance = shape_distance(&scene->solids[s].shape, place);
    if (distance < least) body = scene->solids[s].body;
    least = fmin(least, distance);
  }
  return body;
}

enum status mpm_create_markers(struct sim *sim, struct mpm *m)
{
  const struct scene *scene = sim->scene;
  int                 dim = scene->dim;
  long                n = 0;
  m->n_markers = sim->n_markers;
  TRY(NEW(&m->marker_end, scene->n_loads + scene->n_tracers));
  TRY(NEW(&m->marker_area, m->n_markers));
  TRY(NEW(&m->marker_normal, m->n_markers));
  TRY(NEW(&m->marker_body, m->n_markers));
  if (!m->x_m) return OK;
  for (int i = 0; i < scene->n_loads; i++) {
    n += place_load(scene, &scene->loads[i], n, m);
    m->marker_end[i] = n;
  }
  for (int i = 0; i < scene->n_tracers; i++) {
    memcpy(m->x_m + n * dim, scene->tracers[i].x, (size_t)dim * sizeof(double));
    m->marker_end[scene->n_loads + i] = ++n;
  }
  memcpy(m->x0_m, m->x_m, (size_t)(n * dim) * sizeof(double));
  for (long i = 0; i < n; i++) m->marker_body[i] = nearest_body(scene, m->x_m + i * dim);
  return OK;
}

void mpm_marker_range(const struct sim *sim, const char *name, long *first, long *end)
{
  const struct scene *scene = sim->scene;
  const struct mpm   *m = mpm_of(sim);
  *first = *end = 0;
  for (int i = 0; m && i < scene->n_loads + scene->n_tracers; i++) {
    const char *own = i < scene->n_loads ? scene->loads[i].name : scene->tracers[i - scene->n_loads].name;
    if (strcmp(own, name)) continue;
    *first = i ? m->marker_end[i - 1] : 0;
    *end = m->marker_end[i];
  }
}
