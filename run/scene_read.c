/* From a SCENE argument to a checked struct scene, and back to a file with every default. */
#include "run/scene_read.h"

#include "core/memory.h"
#include "run/plan.h"
#include "run/scene_check.h"
#include "run/scene_find.h"
#include "run/scene_tables.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/** Dimension of the grid: everything else is read with it. */
static enum status find_dimension(struct reader *reader)
{
  const cJSON *min = json_find(reader->root, "grid.min");
  int          n = cJSON_IsArray(min) ? cJSON_GetArraySize(min) : 0;
  snprintf(reader->path, sizeof reader->path, "grid.min");
  if (!cJSON_IsObject(reader->root)) snprintf(reader->path, sizeof reader->path, "%s", "");
  if (!cJSON_IsObject(reader->root))
    return reader_fail(reader, "the file holds %s, not an object; write {\"grid\": ...}", json_type(reader->root));
  if (!min) return reader_fail(reader, "is missing; give the lower corner of the grid in m, such as [0, 0]");
  if (n != 2 && n != 3)
    return reader_fail(reader, "expected a list of two or three numbers, found %s of %d; write [0, 0]", json_type(min),
                       n);
  reader->dim = n;
  reader->path[0] = '\0';
  return OK;
}

/** One body without contact; with it, a body for every solid or for all that are part of the same. */
static void scene_number_bodies(struct scene *scene)
{
  scene->n_bodies = 1;
  if (!scene->contact.present) return;
  scene->n_bodies = 0;
  for (int s = 0; s < scene->n_solids; s++) {
    struct solid *own = &scene->solids[s];
    own->body = -1;
    for (int other = 0; other < s && own->part_of[0]; other++)
      if (strcmp(scene->solids[other].part_of, own->part_of) == 0) own->body = scene->solids[other].body;
    if (own->body < 0) own->body = scene->n_bodies++;
  }
}

static enum status read_scene(struct reader *reader, struct loaded_scene *loaded)
{
  static const char *const sets[] = {"variants", "quick", "paths"};
  struct scene            *scene = &loaded->scene;
  const cJSON             *fluid;
  reader->root = loaded->json;
  TRY(find_dimension(reader));
  scene->dim = reader->dim;
  TRY(section_read(reader, &scene_section, loaded->json, loaded->json, scene));
  fluid = json_member(loaded->json, "fluid");
  scene->fluid.present = cJSON_IsObject(fluid);
  scene->n_fluids = scene->n_others + scene->fluid.present;
  scene->contact.present = cJSON_IsObject(json_member(loaded->json, "contact"));
  scene_number_bodies(scene);
  TRY(scene_check(reader, scene));
  for (int i = 0; i < 3; i++) cJSON_DeleteItemFromObjectCaseSensitive(loaded->json, sets[i]);
  return OK;
}

/** The key of expected.json. */
static void name_variant(const struct scene_place *place, bool quick, char *variant, size_t size)
{
  size_t n = 0;
  for (int i = 0; i < place->n_variants; i++)
    n += (size_t)snprintf(variant + n, n < size ? size - n : 0, "%s%s", i ? "+" : "", place->variants[i]);
  if (quick) n += (size_t)snprintf(variant + n, n < size ? size - n : 0, "%squick", n ? "+" : "");
  if (n == 0) snprintf(variant, size, "base");
}

static void take_text(const cJSON *object, const char *name, char *text, size_t size)
{
  const cJSON *value = json_member(object, name);
  if (cJSON_IsString(value)) snprintf(text, size, "%s", value->valuestring);
}

/** A scene.used.json goes under the name of the scene it was made from; any other scene notes its own. */
static enum status settle_origin(struct loaded_scene *loaded)
{
  cJSON *origin = json_member(loaded->json, "origin");
  char   full[PATH_MAX];
  if (!origin->child) {
    TRY(json_add(origin, "scene", cJSON_CreateString(loaded->scene.name)));
    TRY(json_add(origin, "file", cJSON_CreateString(realpath(loaded->file, full) ? full : loaded->file)));
    return json_add(origin, "variant", cJSON_CreateString(loaded->variant));
  }
  take_text(origin, "scene", loaded->scene.name, sizeof loaded->scene.name);
  take_text(origin, "file", loaded->file, sizeof loaded->file);
  take_text(origin, "variant", loaded->variant, sizeof loaded->variant);
  return OK;
}

static enum status load(const struct run_options *options, struct loaded_scene *loaded)
{
  struct scene_place place;
  struct overrides   overrides = {.fluid = options->fluid, .options = options};
  struct reader      reader = {.file = loaded->file, .scene = &loaded->scene};
  TRY(scene_find(options->argument, &place));
  memcpy(loaded->file, place.file, sizeof loaded->file);
  memcpy(loaded->scene.name, place.name, sizeof loaded->scene.name);
  memcpy(overrides.variants, place.variants, sizeof overrides.variants);
  overrides.n_variants = place.n_variants;
  name_variant(&place, options->quick, loaded->variant, sizeof loaded->variant);
  TRY(json_load(loaded->file, &loaded->json));
  TRY(overrides_apply(loaded->file, &scene_section, &overrides, loaded->json, loaded->path));
  TRY(read_scene(&reader, loaded));
  TRY(settle_origin(loaded));
  return scene_find_expected(loaded);
}

enum status scene_load(const struct run_options *options, struct loaded_scene **loaded)
{
  *loaded = NULL;
  TRY(NEW(loaded, 1));
  enum status status = load(options, *loaded);
  if (status != OK) scene_unload(loaded);
  return status;
}

void scene_unload(struct loaded_scene **loaded)
{
  if (!*loaded) return;
  section_destroy(&scene_section, &(*loaded)->scene);
  for (int i = 0; all_modules[i]; i++) {
    void **params = &(*loaded)->scene.module_params[i];
    if (*params) params_destroy(all_modules[i]->params, *params);
    memory_free(params);
  }
  cJSON_Delete((*loaded)->json);
  cJSON_Delete((*loaded)->expected);
  memory_free(loaded);
}

enum status scene_write_used(const struct loaded_scene *loaded, const char *file)
{
  char *text = cJSON_Print(loaded->json);
  if (!text) return FAIL(ERR_ENVIRONMENT, "%s: no memory for the text of the scene", file);
  enum status status = files_replace(file, text, strlen(text));
  free(text);
  return status;
}

enum status scene_out_directory(const struct loaded_scene *loaded, const struct run_options *options, char *directory,
                                size_t size)
{
  int n = options->out ? snprintf(directory, size, "%s", options->out)
                       : snprintf(directory, size, "out/%s-%s", loaded->scene.name, loaded->path);
  if (n <= 0) return FAIL(ERR_INPUT, "--out: the name of the folder is empty; give one");
  if ((size_t)n >= size) return FAIL(ERR_INPUT, "--out: %.40s... has %d characters; shorten it", directory, n);
  return OK;
}

enum status scene_refuse_used_directory(const struct run_options *options, const char *directory)
{
  static const char *const marks[] = {"summary.json", "checkpoint.h5"};
  for (int i = 0; i < 2 && !options->force; i++) {
    char path[LONGEST_PATH];
    TRY(files_path(directory, marks[i], path));
    if (files_exists(path))
      return FAIL(ERR_INPUT,
                  "%s: the folder holds a run already (%s); choose another with --out, or overwrite it with --force",
                  directory, marks[i]);
  }
  return OK;
}
