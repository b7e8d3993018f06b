/* Overrides on the JSON of a scene: known keys only, through what exists. */
#include "run/overrides.h"

#include "core/scene.h"
#include "run/plan.h"

#include <stdio.h>
#include <string.h>

enum { ORIGIN = 256 };

static const struct param *find_param(const struct param *table, const char *name)
{
  for (const struct param *p = table; p && p->name; p++)
    if (strcmp(p->name, name) == 0) return p;
  return NULL;
}

static const struct entry *find_entry(const struct section *section, const char *name)
{
  for (const struct entry *e = section->entries; e && e->name; e++)
    if (strcmp(e->name, name) == 0) return e;
  return NULL;
}

/** Whether it is the word of a section's choice, or a parameter of any law that it may name. */
static bool belongs_to_choice(const struct choice *choice, const char *name)
{
  struct row row;
  if (choice && strcmp(choice->key, name) == 0) return true;
  for (int i = 0; choice && choice->row(i, &row); i++)
    if (find_param(row.params, name)) return true;
  return false;
}

static enum status fail_key(const struct reader *reader, const struct section *section, const char *name)
{
  struct names names = {0};
  struct row   row;
  names_add_table(&names, section->params);
  for (const struct entry *e = section->entries; e && e->name; e++) names_add(&names, e->name);
  for (int i = 0; section->choice && section->choice->row(i, &row); i++) names_add_table(&names, row.params);
  for (int i = 0; section->modules && all_modules[i]; i++)
    if (all_modules[i]->params) names_add(&names, all_modules[i]->name);
  return reader_unknown(reader, "key", name, &names);
}

static enum status fail_element(const struct reader *reader, const cJSON *map, const char *name)
{
  struct names names = {0};
  for (const cJSON *member = map ? map->child : NULL; member; member = member->next)
    if (!json_is_comment(member)) names_add(&names, member->string);
  return reader_unknown(reader, "name", name, &names);
}

/** rest: what follows the name of a map. Without the map nothing is known of its names, which may hold dots. */
static enum status check_in_map(struct reader *reader, const struct section *section, const cJSON *map,
                                const char *rest)
{
  char   name[JSON_PATH];
  size_t length = json_name_length(map, rest);
  if (!map || rest[length] == '\0') return OK; /* a whole element, new or not */
  snprintf(name, sizeof name, "%.*s", (int)length, rest);
  const cJSON *element = json_member(map, name);
  if (!element) return fail_element(reader, map, name);
  reader_enter(reader, name);
  return section->bare ? OK : section_check_override(reader, section, element, rest + length + 1);
}

static enum status check_in_module(struct reader *reader, const struct section *section, const char *name,
                                   const char *rest)
{
  for (int i = 0; section->modules && all_modules[i]; i++) {
    const struct section inner = {.params = all_modules[i]->params};
    if (!inner.params || strcmp(all_modules[i]->name, name) != 0) continue;
    if (*rest == '\0') return OK;
    reader_enter(reader, name);
    return section_check_override(reader, &inner, NULL, rest);
  }
  return fail_key(reader, section, name);
}

enum status section_check_override(struct reader *reader, const struct section *section, const cJSON *object,
                                   const char *key)
{
  char   name[JSON_PATH];
  size_t length = json_name_length(object, key);
  snprintf(name, sizeof name, "%.*s", (int)length, key);
  const struct entry *e = find_entry(section, name);
  const char         *rest = key[length] == '.' ? key + length + 1 : key + length;
  if (!e && (find_param(section->params, name) || belongs_to_choice(section->choice, name))) return OK;
  if (!e) return check_in_module(reader, section, name, rest);
  if (e->kind == ENTRY_VALUE || *rest == '\0') return OK;
  reader_enter(reader, name);
  if (e->kind == ENTRY_MAP) return check_in_map(reader, e->section, json_member(object, name), rest);
  return section_check_override(reader, e->section, json_member(object, name), rest);
}

enum status overrides_check(struct reader *reader, const struct section *section, const cJSON *set)
{
  size_t mark = strlen(reader->path);
  if (!cJSON_IsObject(set))
    return reader_fail(reader, "expected an object of \"key.path\": value, found %s; write {\"grid.h\": 0.04}",
                       json_type(set));
  for (const cJSON *member = set->child; member; member = member->next) {
    if (json_is_comment(member)) continue;
    TRY(section_check_override(reader, section, NULL, member->string));
    reader_leave(reader, mark);
  }
  return OK;
}

static enum status apply_one(const char *origin, const struct section *section, cJSON *json, const char *key,
                             const cJSON *value)
{
  static const char *const sets[] = {"variants", "quick", "paths"};
  struct reader            reader = {.file = origin, .root = json};
  size_t                   first = strcspn(key, ".");
  if (strlen(key) >= JSON_PATH)
    return FAIL(ERR_INPUT, "%s: a key path of %zu characters; shorten it", origin, strlen(key));
  for (int i = 0; i < 3; i++)
    if (strlen(sets[i]) == first && strncmp(key, sets[i], first) == 0)
      return FAIL(ERR_INPUT, "%s: %s: an override cannot change overrides; set the key itself", origin, key);
  TRY(section_check_override(&reader, section, json, key));
  return json_set(origin, json, key, value);
}

static enum status apply_set(const char *file, const char *where, const struct section *section, cJSON *json,
                             const cJSON *set)
{
  char origin[ORIGIN + JSON_PATH];
  snprintf(origin, sizeof origin, "%s: %s", file, where);
  if (!cJSON_IsObject(set))
    return FAIL(ERR_INPUT, "%s: expected an object of \"key.path\": value, found %s; write {\"grid.h\": 0.04}", origin,
                json_type(set));
  for (const cJSON *member = set->child; member; member = member->next)
    if (!json_is_comment(member)) TRY(apply_one(origin, section, json, member->string, member));
  return OK;
}

static enum status apply_variant(const char *file, const struct section *section, cJSON *json, const char *name)
{
  char          where[2 * NAME_LENGTH];
  const cJSON  *variants = json_member(json, "variants");
  const cJSON  *set = json_member(variants, name);
  struct reader reader = {.file = file, .path = "variants"};
  struct names  names = {0};
  for (const cJSON *v = variants ? variants->child : NULL; v; v = v->next)
    if (!json_is_comment(v)) names_add(&names, v->string);
  if (!set) return reader_unknown(&reader, "variant", name, &names);
  snprintf(where, sizeof where, "variants.%s", name);
  return apply_set(file, where, section, json, set);
}

/** "key.path=value" of --set. */
static enum status apply_word(const char *file, const struct section *section, cJSON *json, const char *word)
{
  char        key[JSON_PATH], origin[ORIGIN + JSON_PATH];
  const char *equals = strchr(word, '=');
  cJSON      *value = NULL;
  snprintf(origin, sizeof origin, "%s: --set", file);
  if (!equals || equals == word || equals - word >= JSON_PATH)
    return FAIL(ERR_INPUT, "%s: \"%.60s\" is not key.path=value; write --set grid.h=0.01", origin, word);
  snprintf(key, sizeof key, "%.*s", (int)(equals - word), word);
  snprintf(origin, sizeof origin, "%s: --set %s", file, key);
  TRY(json_from_word(origin, equals + 1, &value));
  snprintf(origin, sizeof origin, "%s: --set", file);
  enum status status = apply_one(origin, section, json, key, value);
  cJSON_Delete(value);
  return status;
}

/** Variants, quick and --set. */
static enum status apply_later(const char *file, const struct section *section, const struct overrides *o, cJSON *json)
{
  for (int i = 0; i < o->n_variants; i++) TRY(apply_variant(file, section, json, o->variants[i]));
  if (o->options->quick && json_member(json, "quick"))
    TRY(apply_set(file, "quick", section, json, json_member(json, "quick")));
  for (int i = 0; i < o->options->n_sets; i++) TRY(apply_word(file, section, json, o->options->sets[i]));
  return OK;
}

/** The path that the whole scene asks for: overrides may change it, so they are tried on a copy first. */
static enum status find_path(const char *file, const struct section *section, const struct overrides *o,
                             const cJSON *json, char path[NAME_LENGTH])
{
  cJSON *copy = cJSON_Duplicate(json, true);
  if (!copy) return FAIL(ERR_ENVIRONMENT, "%s: no memory for a copy of the scene", file);
  enum status  status = apply_later(file, section, o, copy);
  const cJSON *word = json_member(json_member(copy, "fluid"), "path");
  const char  *chosen = o->fluid ? o->fluid : cJSON_IsString(word) ? word->valuestring : "";
  if (status == OK && o->fluid && !cJSON_IsObject(json_member(copy, "fluid")))
    status = FAIL(ERR_INPUT, "%s: fluid: --fluid %s, but the scene has no fluid; leave --fluid out", file, o->fluid);
  snprintf(path, NAME_LENGTH, "%s", cJSON_IsObject(json_member(copy, "fluid")) ? chosen : "solid");
  cJSON_Delete(copy);
  return status;
}

enum status overrides_apply(const char *file, const struct section *section, const struct overrides *o, cJSON *json,
                            char path[NAME_LENGTH])
{
  char where[2 * NAME_LENGTH];
  TRY(find_path(file, section, o, json, path));
  const cJSON *set = json_member(json_member(json, "paths"), path);
  snprintf(where, sizeof where, "paths.%s", path);
  if (set) TRY(apply_set(file, where, section, json, set));
  TRY(apply_later(file, section, o, json));
  if (!o->fluid) return OK;
  cJSON *word = cJSON_CreateString(o->fluid);
  if (!word) return FAIL(ERR_ENVIRONMENT, "%s: no memory for a word", file);
  enum status status = json_set(file, json, "fluid.path", word);
  cJSON_Delete(word);
  return status;
}
