/* A run that starts where another one ended. */
#include "run/start_from.h"

#include "run/json.h"
#include "run/plan.h"

#include <stdio.h>
#include <string.h>

/* Whether two scenes have the same value, or none, under a key. */
static bool same(const cJSON *a, const cJSON *b, const char *key)
{
  const cJSON *x = json_member(a, key), *y = json_member(b, key);
  return (!x && !y) || cJSON_Compare(x, y, true);
}

/* Loads may differ in what they do, not in number, name and place: their markers come with the points. */
static bool same_loads(const cJSON *a, const cJSON *b)
{
  const cJSON *x = json_member(a, "loads"), *y = json_member(b, "loads");
  if (cJSON_GetArraySize(x) != cJSON_GetArraySize(y)) return false;
  for (x = x->child, y = y->child; x && y; x = x->next, y = y->next)
    if (strcmp(x->string, y->string) != 0 || !same(x, y, "on")) return false;
  return true;
}

/* What the points and the fields of cells are numbered by must be the same. */
static enum status check_scene(const char *folder, const cJSON *here, const cJSON *there)
{
  static const char *const keys[] = {"grid", "solids", "tracers"};
  for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
    if (!same(here, there, keys[i]))
      return FAIL(ERR_INPUT, "start_from: %s: that run has other %s; make them the same", folder, keys[i]);
  if (same_loads(here, there)) return OK;
  return FAIL(ERR_INPUT, "start_from: %s: that run has other loads or other places of them; make them the same",
              folder);
}

static enum status check_folder(const char *folder, const cJSON *here)
{
  char   path[LONGEST_PATH];
  cJSON *there = NULL;
  TRY(files_path(folder, "scene.used.json", path));
  if (!files_exists(path)) return FAIL(ERR_INPUT, "start_from: %s: no run is in this folder; correct it", folder);
  TRY(json_load(path, &there));
  enum status status = check_scene(folder, here, there);
  cJSON_Delete(there);
  return status;
}

enum status start_from(const struct loaded_scene *loaded, struct sim *sim, int n_items,
                       const struct checkpoint_item *items)
{
  const char *folder = loaded->scene.start_from;
  char        why[512];
  if (!*folder) return OK;
  TRY(check_folder(folder, loaded->json));
  enum status status = checkpoint_start(folder, sim, n_items, items);
  snprintf(why, sizeof why, "%s", status_message());
  if (status != OK) return FAIL(status, "start_from: the end of that run does not fit this scene: %s", why);
  sim_measure(sim, &sim->ledger_start);
  sim->ledger = sim->ledger_start;
  return OK;
}
