/* `mpmice check` and `mpmice explain`: what would run. */
#include "core/memory.h"
#include "run/json.h"
#include "run/plan.h"
#include "run/scene_check.h"
#include "run/scene_find.h"
#include "run/scene_read.h"
#include "run/verbs.h"

#include "constitutive/constitutive.h"
#include "coupling/drag.h"
#include "eos/eos.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* bytes of fields up to which a scene is set up to learn its time step */
static const double small_enough = 1e9;

static void print_scene(const struct scene *s)
{
  printf("%s: %s\n  grid   ", s->name, *s->title ? s->title : "no title");
  for (int d = 0; d < s->dim; d++) printf("%s%d", d ? " x " : "", s->cells[d]);
  printf(" cells of %g m, to %g s\n", s->h, s->time_end);
  for (int i = 0; i < s->n_solids; i++) {
    const struct material *m = &s->materials[s->solids[i].material];
    printf("  solid  %s: %ld points of %s (%s), porosity %g\n", s->solids[i].name,
           scene_count_points(s, &s->solids[i].shape), m->name, m->model->name, m->porosity);
  }
  if (s->fluid.present)
    printf("  fluid  density %g kg/m3, bulk modulus %g Pa, viscosity %g Pa s, %s, drag %s\n", s->fluid.density,
           s->fluid.bulk_modulus, s->fluid.viscosity, s->fluid.eos->name, s->fluid.drag->name);
}

/** Time step and number of steps, from a simulation that is set up and thrown away. */
static enum status print_steps(const struct scene *scene, const struct plan *plan)
{
  struct sim *sim = NULL;
  const char *by = "";
  enum status status = sim_create(scene, plan, &sim);
  if (status == OK) {
    double dt = sim_dt_limit(sim, plan, &by);
    printf(", dt %.3g s (%s), about %.0f steps\n", dt, by, ceil(scene->time_end / dt));
  }
  sim_destroy(&sim);
  return status;
}

static enum status print_path(const struct loaded_scene *loaded)
{
  struct plan plan;
  long        n[N_COUNTS];
  int         groups[N_SETS];
  TRY(plan_build(&loaded->scene, &plan));
  TRY(sim_count_points(&loaded->scene, &plan, n, groups));
  double bytes = (double)sim_field_bytes(&loaded->scene, &plan);
  printf("  %-9s %d stages, %ld solid points, %ld water points, %.1f MB of fields", loaded->path, plan.n_stages,
         n[SET_SOLID], n[SET_WATER], bytes / 1e6);
  if (bytes <= small_enough) return print_steps(&loaded->scene, &plan);
  printf("; too large to look for its time step\n");
  return OK;
}

/** One path; what is wrong with a path that the scene does not ask for is printed, not returned. */
static enum status check_path(const struct run_options *options, const char *path, bool own)
{
  struct loaded_scene *loaded = NULL;
  struct run_options   o = *options;
  o.fluid = path;
  enum status status = scene_load(&o, &loaded);
  if (status == OK) status = print_path(loaded);
  scene_unload(&loaded);
  if (status != ERR_INPUT || own) return status;
  printf("  %-9s not possible: %s\n", path, status_message());
  return OK;
}

static enum status check_variant(const struct run_options *options, const char *scene, const char *variant, bool quick)
{
  char                 argument[LONGEST_PATH + NAME_LENGTH];
  struct loaded_scene *loaded = NULL;
  struct run_options   o = *options;
  snprintf(argument, sizeof argument, "%s%s%s", scene, *variant ? "+" : "", variant);
  o.argument = argument;
  o.quick = quick;
  TRY(scene_load(&o, &loaded));
  scene_unload(&loaded);
  return OK;
}

/** Every variant alone, with and without quick. */
static enum status check_variants(const struct run_options *options, const char *file)
{
  cJSON       *json = NULL;
  enum status  status = json_load(file, &json);
  int          n = 0;
  const cJSON *variants = json_member(json, "variants");
  if (status == OK) status = check_variant(options, file, "", true);
  for (const cJSON *v = variants ? variants->child : NULL; v && status == OK; v = v->next) {
    if (json_is_comment(v)) continue;
    status = check_variant(options, file, v->string, false);
    if (status == OK) status = check_variant(options, file, v->string, true);
    n++;
  }
  if (status == OK) printf("  %d variants and quick are valid\n", n);
  cJSON_Delete(json);
  return status;
}

enum status verb_check(const struct run_options *options)
{
  struct loaded_scene *loaded;
  char                 file[LONGEST_PATH], path[NAME_LENGTH];
  TRY(scene_load(options, &loaded));
  print_scene(&loaded->scene);
  bool present = loaded->scene.fluid.present;
  memcpy(file, loaded->file, sizeof file);
  memcpy(path, loaded->path, sizeof path);
  scene_unload(&loaded);
  if (!present || options->fluid) TRY(check_path(options, options->fluid, true));
  for (int i = 0; all_modules[i] && present && !options->fluid; i++)
    if (all_modules[i]->is_fluid_path)
      TRY(check_path(options, all_modules[i]->name, strcmp(path, all_modules[i]->name) == 0));
  return check_variants(options, file);
}

enum status verb_explain(const struct run_options *options)
{
  struct loaded_scene *loaded;
  struct plan          plan;
  TRY(scene_load(options, &loaded));
  enum status status = plan_build(&loaded->scene, &plan);
  if (status == OK) plan_explain(&plan, stdout);
  scene_unload(&loaded);
  return status;
}
