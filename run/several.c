/* Many runs of one scene: paths, folders, summaries. */
#include "run/several.h"

#include "run/loop.h"
#include "run/plan.h"
#include "run/scene_read.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- which paths ---- */

static enum status add_path(struct several *s, const char *name, size_t length)
{
  if (length >= NAME_LENGTH || s->n == MAX_MODULES)
    return FAIL(ERR_INPUT, "--fluid: %.40s: too long, or too many paths; name each once", name);
  snprintf(s->path[s->n], NAME_LENGTH, "%.*s", (int)length, name);
  const struct module *module = module_find(s->path[s->n]);
  if (!module || !module->is_fluid_path)
    return FAIL(ERR_INPUT, "--fluid: \"%s\" is no fluid path; mpmice list names them", s->path[s->n]);
  s->n++;
  return OK;
}

/** Those of --fluid A,B,...; without it every one there is. */
static enum status choose_paths(const char *fluid, struct several *s)
{
  for (int i = 0; all_modules[i] && !fluid; i++)
    if (all_modules[i]->is_fluid_path) TRY(add_path(s, all_modules[i]->name, strlen(all_modules[i]->name)));
  for (const char *at = fluid; at && *at;) {
    size_t length = strcspn(at, ",");
    TRY(add_path(s, at, length));
    at += length + (at[length] == ',');
  }
  return s->n > 0 ? OK : FAIL(ERR_INPUT, "--fluid: no path is named; write --fluid ice,twopoint");
}

/** Whether a path can take the scene; if not, says why. */
static bool takes_scene(const struct run_options *options, const char *path)
{
  struct loaded_scene *loaded = NULL;
  struct run_options   one = *options;
  one.fluid = path;
  enum status status = scene_load(&one, &loaded);
  scene_unload(&loaded);
  if (status != OK) printf("%s: not possible: %s\n", path, status_message());
  return status == OK;
}

/** Without --fluid, paths that cannot take the scene are left out. */
static enum status drop_paths(const struct run_options *options, struct several *s)
{
  int n = 0;
  if (options->fluid) return OK;
  for (int i = 0; i < s->n; i++)
    if (takes_scene(options, s->path[i])) memmove(s->path[n++], s->path[i], NAME_LENGTH);
  s->n = n;
  return n > 0 ? OK : FAIL(ERR_INPUT, "%s: no fluid path can take it; see above", options->argument);
}

/** Name of the scene, and whether it has a fluid. */
static enum status look_at_scene(const struct run_options *options, struct several *s)
{
  struct loaded_scene *loaded = NULL;
  struct run_options   one = *options;
  one.fluid = NULL;
  TRY(scene_load(&one, &loaded));
  memcpy(s->scene, loaded->scene.name, sizeof s->scene);
  s->fluid = loaded->scene.fluid.present;
  scene_unload(&loaded);
  return OK;
}

enum status several_open(const struct run_options *options, const char *verb, struct several *s)
{
  TRY(look_at_scene(options, s));
  if (s->fluid) {
    TRY(choose_paths(options->fluid, s));
    TRY(drop_paths(options, s));
  } else {
    if (options->fluid) return FAIL(ERR_INPUT, "--fluid: %s has no fluid; leave it out", options->argument);
    snprintf(s->path[s->n++], NAME_LENGTH, "solid");
  }
  int n = options->out ? snprintf(s->folder, sizeof s->folder, "%s", options->out)
                       : snprintf(s->folder, sizeof s->folder, "out/%s-%s", s->scene, verb);
  return n > 0 && n < LONGEST_PATH ? OK : FAIL(ERR_INPUT, "--out: a name of %d characters; give a shorter one", n);
}

/* ---- one run ---- */

enum status several_run(const struct run_options *options, const struct several *s, const char *path, const char *name,
                        bool input, enum status *how, cJSON **summary)
{
  struct run_options one = *options;
  char               folder[LONGEST_PATH], file[LONGEST_PATH];
  TRY(files_path(s->folder, name, folder));
  TRY(files_path(folder, "summary.json", file));
  one.fluid = s->fluid ? path : NULL;
  one.out = folder;
  *summary = NULL;
  *how = run_scene(&one);
  if (*how == INTERRUPTED || *how == ERR_ENVIRONMENT || (*how == ERR_INPUT && !input)) return *how;
  return *how != ERR_INPUT && files_exists(file) ? json_load(file, summary) : OK;
}

double several_number(const cJSON *summary, const char *path)
{
  const cJSON *item = summary ? json_find(summary, path) : NULL;
  return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

enum status several_write(const struct several *s, const char *name, cJSON *root)
{
  char        file[LONGEST_PATH];
  char       *text = root ? cJSON_Print(root) : NULL;
  enum status status = files_path(s->folder, name, file);
  cJSON_Delete(root);
  if (status == OK && !text) status = FAIL(ERR_ENVIRONMENT, "%s: no memory to write it", file);
  if (status == OK) status = files_replace(file, text, strlen(text));
  free(text);
  return status;
}
