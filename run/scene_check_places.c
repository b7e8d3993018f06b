/* Whether what a scene places lies where it must: solids, fluid, loads, tracers, gauges. */
#include "run/scene_check.h"
#include "run/scene_tables.h"

#include <stdio.h>
#include <string.h>

struct bounds {
  double low[3], high[3];
};

static void unbounded(struct bounds *b)
{
  for (int d = 0; d < 3; d++) {
    b->low[d] = -INFINITY;
    b->high[d] = INFINITY;
  }
}

static void bounds_of_polygon(const struct shape *s, struct bounds *b)
{
  for (int d = 0; d < 2; d++) {
    b->low[d] = INFINITY;
    b->high[d] = -INFINITY;
    for (int i = 0; i < s->n; i++) {
      b->low[d] = fmin(b->low[d], s->vertices[i][d]);
      b->high[d] = fmax(b->high[d], s->vertices[i][d]);
    }
  }
}

/** A box around a shape; infinite where the shape is unbounded. */
static void bounds_of(const struct shape *s, struct bounds *b)
{
  unbounded(b);
  if (s->kind == SHAPE_POLYGON) bounds_of_polygon(s, b);
  for (int d = 0; d < s->dim && (s->kind == SHAPE_BOX || s->kind == SHAPE_BALL); d++) {
    b->low[d] = s->kind == SHAPE_BOX ? s->min[d] : s->centre[d] - s->radius;
    b->high[d] = s->kind == SHAPE_BOX ? s->max[d] : s->centre[d] + s->radius;
  }
  if (s->kind == SHAPE_UNION || s->kind == SHAPE_DIFFERENCE || s->kind == SHAPE_INTERSECTION)
    bounds_of(&s->parts[0], b);
  for (int i = 1; i < s->n && (s->kind == SHAPE_UNION || s->kind == SHAPE_INTERSECTION); i++) {
    struct bounds part;
    bounds_of(&s->parts[i], &part);
    for (int d = 0; d < 3; d++) {
      bool wider = s->kind == SHAPE_UNION;
      b->low[d] = wider ? fmin(b->low[d], part.low[d]) : fmax(b->low[d], part.low[d]);
      b->high[d] = wider ? fmax(b->high[d], part.high[d]) : fmin(b->high[d], part.high[d]);
    }
  }
}

/** Place i of the lattice of points; false past its end. */
static bool lattice_place(const struct scene *scene, long i, double x[3])
{
  x[2] = 0;
  for (int d = 0; d < scene->dim; d++) {
    int  per_cell = scene->numerics.points_per_axis[d];
    long n = (long)scene->cells[d] * per_cell;
    x[d] = scene->min[d] + ((double)(i % n) + 0.5) * scene->h / per_cell;
    i /= n;
  }
  return i == 0;
}

long scene_count_points(const struct scene *scene, const struct shape *shape)
{
  double x[3];
  long   n = 0;
  for (long i = 0; lattice_place(scene, i, x); i++) n += shape_contains(shape, x);
  return n;
}

static bool holds_a_point(const struct scene *scene, const struct shape *shape)
{
  double x[3];
  for (long i = 0; lattice_place(scene, i, x); i++)
    if (shape_contains(shape, x)) return true;
  return false;
}

static struct reader *at(struct reader *reader, const char *map, const char *name, const char *key)
{
  snprintf(reader->path, sizeof reader->path, "%s.%s.%s", map, name, key);
  return reader;
}

static bool outside(const struct scene *scene, int d, double x)
{
  double slack = 1e-9 * scene->h;
  return isfinite(x) && (x < scene->min[d] - slack || x > scene->max[d] + slack);
}

/** No finite edge of the shape lies outside the grid. */
static enum status check_inside(struct reader *reader, const struct scene *scene, const struct shape *shape,
                                const char *what)
{
  struct bounds b;
  bounds_of(shape, &b);
  for (int d = 0; d < scene->dim; d++) {
    bool low = outside(scene, d, b.low[d]);
    if (low || outside(scene, d, b.high[d]))
      return reader_fail(reader,
                         "%s reaches %c = %.10g, outside the grid, which spans [%.10g, %.10g]; enlarge the grid, or "
                         "shrink it or use null there",
                         what, "xyz"[d], low ? b.low[d] : b.high[d], scene->min[d], scene->max[d]);
  }
  return OK;
}

static enum status check_overlap(struct reader *reader, const struct scene *scene)
{
  double x[3];
  for (long i = 0; lattice_place(scene, i, x); i++) {
    int owner = -1;
    for (int s = 0; s < scene->n_solids; s++) {
      if (!shape_contains(&scene->solids[s].shape, x)) continue;
      if (owner >= 0)
        return reader_fail(at(reader, "solids", scene->solids[s].name, "shape"),
                           "it overlaps solids.%s at (%.6g, %.6g, %.6g); take one from the other with \"difference\"",
                           scene->solids[owner].name, x[0], x[1], x[2]);
      owner = s;
    }
  }
  return OK;
}

static enum status check_solids(struct reader *reader, const struct scene *scene)
{
  for (int s = 0; s < scene->n_solids; s++) {
    const struct solid *solid = &scene->solids[s];
    at(reader, "solids", solid->name, "shape");
    TRY(check_inside(reader, scene, &solid->shape, "the solid"));
    if (!holds_a_point(scene, &solid->shape))
      return reader_fail(reader,
                         "no point of the lattice lies in it (spacing h over points per axis, h = %.6g); enlarge the "
                         "shape or refine grid.h",
                         scene->h);
  }
  return scene->n_solids > 1 ? check_overlap(reader, scene) : OK;
}

static enum status check_fluid(struct reader *reader, const struct scene *scene)
{
  snprintf(reader->path, sizeof reader->path, "fluid.region");
  if (!scene->fluid.present || holds_a_point(scene, &scene->fluid.region)) return OK;
  return reader_fail(reader, "no place of the grid lies in it; enlarge the region or refine grid.h");
}

/* ---- loads ---- */

/** The axis along which a box has no width; -1: none, or several. */
static int flat_axis(const struct scene *scene, const struct shape *box)
{
  int axis = -1;
  for (int d = 0; d < scene->dim; d++) {
    if (box->max[d] - box->min[d] > 1e-9 * scene->h) continue;
    if (axis >= 0) return -1;
    axis = d;
  }
  return axis;
}

static enum status check_patch(struct reader *reader, const struct scene *scene, const struct load *load)
{
  const struct shape *s = &load->patch;
  if (s->kind == SHAPE_BOX && flat_axis(scene, s) < 0)
    return reader_fail(reader,
                       "a load acts on a surface; give a box whose min and max are equal along exactly one axis");
  if (s->kind == SHAPE_BALL && scene->dim == 3)
    return reader_fail(reader, "in 3D a load acts on flat boxes only; use a box of zero width");
  if (s->kind != SHAPE_BOX && s->kind != SHAPE_BALL)
    return reader_fail(reader, "a load acts on a flat box or in 2D on a circle; use one of them");
  return s->kind == SHAPE_BOX ? check_inside(reader, scene, s, "the load") : OK;
}

enum { SAMPLES = 16 };

/** Sample i of SAMPLES^3 on a patch clipped to the grid, or of SAMPLES^3 on a circle. */
static void patch_sample(const struct scene *scene, const struct shape *s, int i, double x[3])
{
  double angle = 2 * acos(-1.0) * i / (SAMPLES * SAMPLES * SAMPLES);
  if (s->kind == SHAPE_BALL) {
    x[0] = s->centre[0] + s->radius * cos(angle);
    x[1] = s->centre[1] + s->radius * sin(angle);
    return;
  }
  for (int d = 0; d < scene->dim; d++, i /= SAMPLES) {
    double low = fmax(s->min[d], scene->min[d]), high = fmin(s->max[d], scene->max[d]);
    x[d] = low + (high - low) * (i % SAMPLES + 0.5) / SAMPLES;
  }
}

/** Whether the patch comes within a cell of some solid. */
static bool touches_solid(const struct scene *scene, const struct shape *patch)
{
  for (int i = 0; i < SAMPLES * SAMPLES * SAMPLES; i++) {
    double x[3] = {0};
    patch_sample(scene, patch, i, x);
    for (int s = 0; s < scene->n_solids; s++)
      if (shape_distance(&scene->solids[s].shape, x) <= scene->h) return true;
  }
  return false;
}

static enum status check_loads(struct reader *reader, const struct scene *scene)
{
  for (int i = 0; i < scene->n_loads; i++) {
    at(reader, "loads", scene->loads[i].name, "on");
    TRY(check_patch(reader, scene, &scene->loads[i]));
    if (!touches_solid(scene, &scene->loads[i].patch))
      return reader_fail(reader, "no solid lies within a cell of it; move it onto the surface of a solid");
  }
  return OK;
}

/* ---- obstacles ---- */

/** A solid may lean on an obstacle that is there at the start, not reach into it. */
static enum status check_inroad(struct reader *reader, const struct scene *scene, const struct obstacle *o)
{
  double x[3];
  for (long i = 0; o->from <= 0 && lattice_place(scene, i, x); i++) {
    if (!(shape_distance(&o->shape, x) < -1e-9 * scene->h)) continue;
    for (int s = 0; s < scene->n_solids; s++)
      if (shape_contains(&scene->solids[s].shape, x))
        return reader_fail(
            reader, "solids.%s reaches into it at (%.6g, %.6g, %.6g); take one from the other with \"difference\"",
            scene->solids[s].name, x[0], x[1], x[2]);
  }
  return OK;
}

static enum status check_obstacle(struct reader *reader, const struct scene *scene, const struct obstacle *o)
{
  for (int side = 0; side < SIDES; side++)
    if (strcmp(o->name, side_names[side]) == 0)
      return reader_fail(reader, "a side of the grid has this name; rename the obstacle");
  for (int d = 0; d < scene->dim; d++)
    if (function_varies_in_space(&o->velocity[d]))
      return reader_fail(reader, "its velocity varies in space and it is rigid; use t only");
  if (o->until < o->from)
    return reader_fail(reader, "\"until\" %.10g lies before \"from\" %.10g; exchange them", o->until, o->from);
  return check_inroad(reader, scene, o);
}

static enum status check_obstacles(struct reader *reader, const struct scene *scene)
{
  snprintf(reader->path, sizeof reader->path, "obstacles");
  if (scene->n_obstacles > MAX_OBSTACLES)
    return reader_fail(reader, "%d are more than %d; join some with \"union\"", scene->n_obstacles, MAX_OBSTACLES);
  for (int i = 0; i < scene->n_obstacles; i++) {
    snprintf(reader->path, sizeof reader->path, "obstacles.%s", scene->obstacles[i].name);
    TRY(check_obstacle(reader, scene, &scene->obstacles[i]));
  }
  return OK;
}

/* ---- tracers and gauges ---- */

/** A null coordinate becomes the middle of the grid. */
static enum status place(struct reader *reader, const struct scene *scene, double x[3])
{
  for (int d = 0; d < scene->dim; d++) {
    if (!isfinite(x[d])) x[d] = 0.5 * (scene->min[d] + scene->max[d]);
    if (outside(scene, d, x[d]))
      return reader_fail(
          reader, "%c = %.10g lies outside the grid, which spans [%.10g, %.10g]; move it inside or enlarge the grid",
          "xyz"[d], x[d], scene -> min[d], scene -> max[d]);
  }
  return OK;
}

static enum status check_tracers(struct reader *reader, struct scene *scene)
{
  for (int i = 0; i < scene->n_tracers; i++) {
    struct tracer *t = &scene->tracers[i];
    snprintf(reader->path, sizeof reader->path, "tracers.%s", t->name);
    for (int l = 0; l < scene->n_loads; l++)
      if (strcmp(scene->loads[l].name, t->name) == 0)
        return reader_fail(reader, "a load has this name too; rename one of them");
    if (scene->n_solids == 0)
      return reader_fail(reader, "a tracer moves with a solid and there is none; use a gauge of kind point");
    TRY(place(reader, scene, t->x));
  }
  return OK;
}

/** The obstacle or side whose force a gauge shows. */
static enum status check_wall(struct reader *reader, const struct scene *scene, const struct gauge *g)
{
  struct names names = {0};
  for (int i = 0; i < scene->n_obstacles; i++) names_add(&names, scene->obstacles[i].name);
  for (int side = 0; side < 2 * scene->dim; side++) {
    int kind = scene->solid_side[side].kind;
    if (kind != SIDE_OPEN && kind != SIDE_PERIODIC && kind != SIDE_ABSORBING) names_add(&names, side_names[side]);
  }
  for (int i = 0; i < names.n; i++)
    if (strcmp(names.name[i], g->on) == 0) return OK;
  return reader_unknown(at(reader, "gauges", g->name, "on"), "obstacle or side", g->on, &names);
}

/** The load or tracer that a gauge rides on. */
static enum status check_rider(struct reader *reader, const struct scene *scene, const struct gauge *g)
{
  struct names names = {0};
  bool         of_load = g->kind == GAUGE_LOAD;
  for (int i = 0; i < (of_load ? scene->n_loads : scene->n_tracers); i++) {
    const char *name = of_load ? scene->loads[i].name : scene->tracers[i].name;
    if (strcmp(name, g->on) == 0) return OK;
    names_add(&names, name);
  }
  return reader_unknown(at(reader, "gauges", g->name, "on"), of_load ? "load" : "tracer", g->on, &names);
}

/** The gauge that is taken off another one. */
static enum status check_minus(struct reader *reader, const struct scene *scene, const struct gauge *g)
{
  struct names names = {0};
  for (int i = 0; i < scene->n_gauges; i++) {
    const struct gauge *other = &scene->gauges[i];
    if (gauge_is_line(other) || *other->minus || strcmp(other->name, g->name) == 0) continue;
    if (strcmp(other->name, g->minus) == 0) return OK;
    names_add(&names, other->name);
  }
  return reader_unknown(at(reader, "gauges", g->name, "minus"), "gauge (one that nothing is taken off)", g->minus,
                        &names);
}

static enum status check_gauges(struct reader *reader, struct scene *scene)
{
  for (int i = 0; i < scene->n_gauges; i++) {
    struct gauge *g = &scene->gauges[i];
    if (g->kind == GAUGE_LOAD || g->kind == GAUGE_TRACER) TRY(check_rider(reader, scene, g));
    if (g->kind == GAUGE_WALL) TRY(check_wall(reader, scene, g));
    if (*g->minus) TRY(check_minus(reader, scene, g));
    if (g->kind == GAUGE_POINT || g->kind == GAUGE_LEVEL || gauge_is_line(g))
      TRY(place(at(reader, "gauges", g->name, gauge_is_line(g) ? "from" : "at"), scene, g->x));
    if (gauge_is_line(g)) TRY(place(at(reader, "gauges", g->name, "to"), scene, g->to));
    if ((g->kind == GAUGE_INTEGRAL || g->kind == GAUGE_MEAN || g->kind == GAUGE_EXTENT) &&
        !holds_a_point(scene, &g->region))
      return reader_fail(at(reader, "gauges", g->name, "region"), "no place of the grid lies in it; enlarge it");
  }
  return OK;
}

enum status scene_check_places(struct reader *reader, struct scene *scene)
{
  TRY(check_solids(reader, scene));
  TRY(check_fluid(reader, scene));
  TRY(check_loads(reader, scene));
  TRY(check_obstacles(reader, scene));
  TRY(check_tracers(reader, scene));
  return check_gauges(reader, scene);
}
