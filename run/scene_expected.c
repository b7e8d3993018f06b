/* The limits of a case: expected.json, {variant: {path: {metric: {value, limit, unit, reference}}}}. */
#include "run/scene_read.h"

#include "run/params.h"

#include <stdio.h>
#include <string.h>

/** Whether the word [0..length) is one of "a+b+c". */
static bool holds_word(const char *variants, const char *word, size_t length)
{
  for (const char *at = variants; *at; at += strcspn(at, "+"), at += *at == '+')
    if (strcspn(at, "+") == length && strncmp(at, word, length) == 0) return true;
  return false;
}

/** Whether "a+b" and "b+a" name the same variants. */
static bool same_variants(const char *a, const char *b)
{
  if (strlen(a) != strlen(b)) return false;
  for (const char *at = a; *at; at += strcspn(at, "+"), at += *at == '+')
    if (!holds_word(b, at, strcspn(at, "+"))) return false;
  return true;
}

static const cJSON *find_variant(const cJSON *all, const char *variant)
{
  for (const cJSON *v = cJSON_IsObject(all) ? all->child : NULL; v; v = v->next)
    if (same_variants(v->string, variant)) return v;
  return NULL;
}

static enum status check_number(struct reader *reader, const cJSON *entry, const char *name)
{
  const cJSON *value = json_member(entry, name);
  if (!value || cJSON_IsNumber(value)) return OK;
  size_t      mark = reader_enter(reader, name);
  enum status status = reader_fail(reader, "expected a number, found %s; write it without quotes", json_type(value));
  reader_leave(reader, mark);
  return status;
}

static enum status check_entry(struct reader *reader, const cJSON *entry)
{
  struct names names = {0};
  names_add(&names, "value");
  names_add(&names, "limit");
  names_add(&names, "unit");
  names_add(&names, "reference");
  if (!cJSON_IsObject(entry))
    return reader_fail(reader, "expected an object, found %s; write {\"limit\": 0.01}", json_type(entry));
  for (const cJSON *member = entry->child; member; member = member->next) {
    bool known = json_is_comment(member);
    for (int i = 0; i < names.n; i++) known = known || strcmp(names.name[i], member->string) == 0;
    if (!known) return reader_unknown(reader, "key", member->string, &names);
  }
  TRY(check_number(reader, entry, "value"));
  return check_number(reader, entry, "limit");
}

/** A limit on a metric that does not exist would never be judged. */
static enum status check_metrics(struct reader *reader, const struct scene *scene, const cJSON *path)
{
  struct names names = {0};
  if (!cJSON_IsObject(path))
    return reader_fail(reader, "expected an object of metrics, found %s; write {\"name\": {\"limit\": 0.01}}",
                       json_type(path));
  for (int i = 0; i < scene->n_metrics; i++) names_add(&names, scene->metrics[i].name);
  for (const cJSON *entry = path->child; entry; entry = entry->next) {
    bool known = false;
    if (json_is_comment(entry)) continue;
    for (int i = 0; i < scene->n_metrics; i++) known = known || strcmp(scene->metrics[i].name, entry->string) == 0;
    if (!known) return reader_unknown(reader, "metric", entry->string, &names);
    size_t mark = reader_enter(reader, entry->string);
    TRY(check_entry(reader, entry));
    reader_leave(reader, mark);
  }
  return OK;
}

static enum status take(struct loaded_scene *loaded, const char *file, const cJSON *all)
{
  struct reader reader = {.file = file};
  const cJSON  *variant = find_variant(all, loaded->variant), *path = json_member(variant, loaded->path);
  if (!path) return OK;
  reader_enter(&reader, variant->string);
  reader_enter(&reader, loaded->path);
  TRY(check_metrics(&reader, &loaded->scene, path));
  loaded->expected = cJSON_Duplicate(path, true);
  return loaded->expected ? OK : FAIL(ERR_ENVIRONMENT, "%s: no memory for a copy; close other programs", file);
}

enum status scene_find_expected(struct loaded_scene *loaded)
{
  char   file[LONGEST_PATH + 16];
  cJSON *all = NULL;
  snprintf(file, sizeof file, "%s", loaded->file);
  char *slash = strrchr(file, '/');
  snprintf(slash ? slash + 1 : file, 16, "expected.json");
  if (!files_exists(file)) return OK;
  TRY(json_load(file, &all));
  enum status status = take(loaded, file, all);
  cJSON_Delete(all);
  return status;
}

static void copy_text(const cJSON *object, const char *name, char *text, size_t size)
{
  const cJSON *value = json_member(object, name);
  snprintf(text, size, "%s", cJSON_IsString(value) ? value->valuestring : "");
}

void scene_expected(const struct loaded_scene *loaded, const char *metric, struct expectation *expectation)
{
  const cJSON *entry = json_member(loaded->expected, metric);
  const cJSON *value = json_member(entry, "value"), *limit = json_member(entry, "limit");
  *expectation = (struct expectation){.has_value = cJSON_IsNumber(value), .has_limit = cJSON_IsNumber(limit)};
  if (expectation->has_value) expectation->value = value->valuedouble;
  if (expectation->has_limit) expectation->limit = limit->valuedouble;
  copy_text(entry, "unit", expectation->unit, sizeof expectation->unit);
  copy_text(entry, "reference", expectation->reference, sizeof expectation->reference);
}
