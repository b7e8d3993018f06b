/* Whether the parts of a scene fit together: grid, sides, materials, fluid, metrics. */
#include "run/scene_check.h"

#include "constitutive/constitutive.h"
#include "coupling/drag.h"
#include "references/reference.h"
#include "run/scene_tables.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/** Places the reader at a path for messages about it. */
__attribute__((format(printf, 2, 3))) static struct reader *at(struct reader *reader, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  vsnprintf(reader->path, sizeof reader->path, format, args);
  va_end(args);
  return reader;
}

/* ---- grid ---- */

static enum status check_axis(struct reader *reader, struct scene *scene, int d)
{
  double lowest = scene->min[d], h = scene->h;
  scene->one_cell[d] = isinf(scene->max[d]);
  if (scene->one_cell[d]) scene->max[d] = lowest + h;
  double n = (scene->max[d] - lowest) / h, whole = fmax(1, floor(n + 0.5));
  if (scene->max[d] <= lowest)
    return reader_fail(at(reader, "grid.max.%d", d), "%.10g does not lie above grid.min, %.10g; enlarge it",
                       scene->max[d], lowest);
  if (n > 1e9) return reader_fail(at(reader, "grid.h"), "%.10g makes %.3g cells along %c; enlarge it", h, n, "xyz"[d]);
  if (fabs(n - whole) > 1e-6 * whole)
    return reader_fail(at(reader, "grid.max.%d", d),
                       "%.10g makes %.6g cells of h = %.10g along %c, not a whole number; the nearest is %.10g",
                       scene->max[d], n, h, "xyz"[d], lowest + whole * h);
  scene->cells[d] = (int)whole;
  scene->max[d] = lowest + whole * h;
  return OK;
}

static enum status check_grid(struct reader *reader, struct scene *scene)
{
  double cells = 1;
  scene->cells[2] = 1;
  for (int d = 0; d < scene->dim; d++) {
    TRY(check_axis(reader, scene, d));
    cells *= scene->cells[d];
  }
  if (cells > 2e9) return reader_fail(at(reader, "grid.h"), "%.10g makes %.3g cells; enlarge it", scene->h, cells);
  return OK;
}

/* ---- sides ---- */

static enum status check_periodic(struct reader *reader, const struct scene *scene, const char *whose,
                                  const struct side_condition *sides)
{
  for (int d = 0; d < scene->dim; d++) {
    bool low = sides[2 * d].kind == SIDE_PERIODIC, high = sides[2 * d + 1].kind == SIDE_PERIODIC;
    if (low != high)
      return reader_fail(at(reader, "boundary.%s.%s", whose, side_names[2 * d + low]),
                         "the opposite side is periodic and this one is not; make both or none periodic");
  }
  return OK;
}

static enum status check_sides(struct reader *reader, struct scene *scene)
{
  TRY(check_periodic(reader, scene, "solid", scene->solid_side));
  TRY(check_periodic(reader, scene, "fluid", scene->fluid_side));
  for (int side = 0; side < SIDES; side++) {
    bool fluid = scene->fluid_side[side].kind != SIDE_SLIP;
    bool solid_turns = scene->solid_side[side].kind == SIDE_PERIODIC,
         fluid_turns = scene->fluid_side[side].kind == SIDE_PERIODIC;
    if (fluid && !scene->fluid.present)
      return reader_fail(at(reader, "boundary.fluid.%s", side_names[side]),
                         "the scene has no fluid; remove it or add a \"fluid\"");
    scene->solid_side[side].shear_only = scene->fluid.present;
    if (scene->fluid_side[side].kind == SIDE_ABSORBING)
      return reader_fail(at(reader, "boundary.fluid.%s", side_names[side]),
                         "only the solid has absorbing sides; use \"open\" or \"slip\"");
    if (scene->n_solids > 0 && scene->fluid.present && solid_turns != fluid_turns)
      return reader_fail(at(reader, "boundary.%s.%s", solid_turns ? "fluid" : "solid", side_names[side]),
                         "solid and fluid share the grid; make this side periodic for both or for none");
  }
  return OK;
}

/* ---- materials and fluid ---- */

static enum status check_material(struct reader *reader, const struct scene *scene, const struct material *m)
{
  const struct drag_law *drag = scene->fluid.drag;
  const char            *fault = m->model->check ? m->model->check(m->model_params) : NULL;
  at(reader, "materials.%s", m->name);
  if (fault) return reader_fail(reader, "%s", fault);
  if (!scene->fluid.present || m->porosity == 0) return OK;
  if (drag->needs_permeability && m->permeability == 0)
    return reader_fail(reader, "drag law %s needs \"permeability\"%s; give it in m/s%s", drag->name,
                       m->grain_diameter > 0 ? "" : ", and \"grain_diameter\" is missing too",
                       m->grain_diameter > 0 ? " or choose fluid.drag kozeny_carman" : "");
  if (drag->needs_diameter && m->grain_diameter == 0)
    return reader_fail(reader, "drag law %s needs \"grain_diameter\"%s; give it in m%s", drag->name,
                       m->permeability > 0 ? "" : ", and \"permeability\" is missing too",
                       m->permeability > 0 ? " or choose fluid.drag darcy" : "");
  if (scene->fluid.viscosity == 0)
    return reader_fail(at(reader, "fluid.viscosity"),
                       "0 in a scene with a porous material leaves no drag; give it in Pa s, 1e-3 for water");
  return OK;
}

static enum status check_fluids(struct reader *reader, const struct scene *scene)
{
  if (scene->n_others >= MAX_FLUIDS)
    return reader_fail(at(reader, "fluids"), "%d fluids are more than %d; leave some out", scene->n_fluids, MAX_FLUIDS);
  for (int i = 0; i < scene->n_others; i++) {
    at(reader, "fluids.%s", scene->others[i].name);
    if (!scene->fluid.present) return reader_fail(reader, "the scene has no \"fluid\", which comes first; add one");
    if (strcmp(scene->others[i].name, "fluid") == 0)
      return reader_fail(reader, "the first fluid is called so already; rename it");
    if (!scene->fluid.path->several_fluids)
      return reader_fail(reader, "path %s moves one fluid; leave \"fluids\" out or take another path",
                         scene->fluid.path->name);
  }
  return OK;
}

static enum status check_materials(struct reader *reader, struct scene *scene)
{
  if (scene->n_materials > 255)
    return reader_fail(at(reader, "materials"), "%d are more than 255; merge some", scene->n_materials);
  for (int i = 0; i < scene->n_materials; i++) {
    TRY(check_material(reader, scene, &scene->materials[i]));
    if (scene->materials[i].model->n_history > scene->n_history)
      scene->n_history = scene->materials[i].model->n_history;
  }
  return OK;
}

/* ---- metrics ---- */

static const struct reference_use *find_reference(const struct scene *scene, const char *word, size_t length)
{
  for (int i = 0; i < scene->n_references; i++)
    if (strlen(scene->references[i].name) == length && strncmp(scene->references[i].name, word, length) == 0)
      return &scene->references[i];
  return NULL;
}

static enum status fail_reference(struct reader *reader, const struct scene *scene, const char *word)
{
  struct names names = {0};
  for (int i = 0; i < scene->n_references; i++) names_add(&names, scene->references[i].name);
  return reader_unknown(reader, "reference", word, &names);
}

/** The reference "name.quantity" of a metric; NULL where it has none. */
static enum status check_reference(struct reader *reader, const struct scene *scene, const struct metric *m,
                                   const struct reference_use **use)
{
  struct names names = {0};
  char         buffer[512];
  const char  *dot = strrchr(m->reference, '.');
  *use = NULL;
  if (*m->reference == '\0') return OK;
  at(reader, "metrics.%s.reference", m->name);
  if (!dot) return reader_fail(reader, "\"%s\" names no quantity; write \"name.quantity\"", m->reference);
  *use = find_reference(scene, m->reference, (size_t)(dot - m->reference));
  if (!*use) return fail_reference(reader, scene, m->reference);
  if (reference_quantity((*use)->reference, dot + 1) >= 0) return OK;
  names_add_words(&names, (*use)->reference->quantities, buffer, sizeof buffer);
  return reader_unknown(reader, "quantity", dot + 1, &names);
}

static bool has_line(const struct scene *scene, const char *name)
{
  for (int i = 0; i < scene->n_gauges; i++)
    if (strcmp(scene->gauges[i].name, name) == 0) return gauge_is_line(&scene->gauges[i]);
  return false;
}

/** A gauge, or "line.3" for a sample of a line. */
static bool has_gauge(const struct scene *scene, const char *name)
{
  for (int i = 0; i < scene->n_gauges; i++) {
    const struct gauge *g = &scene->gauges[i];
    size_t              length = strlen(g->name);
    if (strcmp(g->name, name) == 0) return !gauge_is_line(g);
    if (gauge_is_line(g) && strncmp(g->name, name, length) == 0 && name[length] == '.') return true;
  }
  return false;
}

static bool is_of_gauge(int measure) { return measure >= MEASURE_FREQUENCY && measure <= MEASURE_PROFILE; }
static bool is_of_field(int measure) { return measure >= MEASURE_MISFIT; }

/** What a measure needs beside its source. */
static enum status check_measure(struct reader *reader, const struct metric *m)
{
  const double *t, *v;
  at(reader, "metrics.%s", m->name);
  if (m->measure == MEASURE_FIT && function_rows(&m->expected, &t, &v) == 0)
    return reader_fail(reader, "a fit goes to the rows of a table; write \"expected\": {\"table\": \"front.csv\"}");
  if (m->measure == MEASURE_PROFILE && m->profile.n == 0)
    return reader_fail(reader, "a profile goes to the rows of a table; write \"profile\": \"surface.csv\"");
  return OK;
}

static enum status check_metric_source(struct reader *reader, const struct scene *scene, const struct metric *m)
{
  struct names names = {0};
  bool         of_gauge = is_of_gauge(m->measure), of_field = is_of_field(m->measure);
  at(reader, "metrics.%s", m->name);
  if ((*m->field != '\0') == (*m->gauge != '\0'))
    return reader_fail(reader, "it needs one of \"field\" and \"gauge\"; give exactly one");
  if (*m->field && of_gauge)
    return reader_fail(
        reader,
        "frequency, decay, drift, change, gain, reach, peaks, rise, excess, fit and profile belong to a gauge, "
        "not to the field %s; give \"gauge\"",
        m->field);
  if (*m->gauge && of_field)
    return reader_fail(
        reader,
        "misfit, thickness, roughness, scatter, l1 and crests belong to a field, not to the gauge %s; give \"field\"",
        m->gauge);
  if (*m->over && !*m->gauge)
    return reader_fail(reader, "\"over\" divides gauges, %s is a field; use \"scale\"", m->field);
  for (int i = 0; i < scene->n_gauges; i++) names_add(&names, scene->gauges[i].name);
  if (*m->over && !has_gauge(scene, m->over))
    return reader_unknown(at(reader, "metrics.%s.over", m->name), "gauge", m->over, &names);
  bool found = m->measure == MEASURE_PROFILE ? has_line(scene, m->gauge) : has_gauge(scene, m->gauge);
  if (*m->field || found) return OK;
  return reader_unknown(at(reader, "metrics.%s.gauge", m->name),
                        m->measure == MEASURE_PROFILE ? "gauge of a line" : "gauge (a line is \"name.0\")", m->gauge,
                        &names);
}

static enum status check_times(struct reader *reader, const struct metric *m, const struct reference_use *use)
{
  if (m->scaled_time && (!use || !use->reference->time_scale))
    return reader_fail(at(reader, "metrics.%s.time", m->name),
                       "\"scaled\" needs a reference that has a unit of time; use \"seconds\"");
  if (m->from > m->to)
    return reader_fail(at(reader, "metrics.%s.from", m->name), "%.10g lies after \"to\", %.10g; exchange them", m->from,
                       m->to);
  return OK;
}

static enum status check_metrics(struct reader *reader, const struct scene *scene)
{
  for (int i = 0; i < scene->n_metrics; i++) {
    const struct reference_use *use = NULL;
    TRY(check_metric_source(reader, scene, &scene->metrics[i]));
    TRY(check_measure(reader, &scene->metrics[i]));
    TRY(check_reference(reader, scene, &scene->metrics[i], &use));
    TRY(check_times(reader, &scene->metrics[i], use));
  }
  return OK;
}

enum status scene_check(struct reader *reader, struct scene *scene)
{
  TRY(check_grid(reader, scene));
  TRY(check_sides(reader, scene));
  if (scene->n_solids == 0 && !scene->fluid.present)
    return reader_fail(at(reader, "solids"), "the scene holds neither a solid nor a fluid; add one");
  TRY(check_fluids(reader, scene));
  TRY(check_materials(reader, scene));
  TRY(scene_check_heat(reader, scene));
  TRY(scene_check_motion(reader, scene));
  TRY(check_metrics(reader, scene));
  at(reader, "%s", "");
  TRY(scene_check_places(reader, scene));
  return scene_check_words(reader, scene);
}
