/* The walk over the tables of sections.h that reads a scene. */
#include "run/sections.h"

#include "core/memory.h"
#include "core/scene.h"
#include "run/plan.h"

#include <stdio.h>
#include <string.h>

bool choice_find(const struct choice *choice, const char *name, int *index, struct row *row)
{
  for (int i = 0; choice->row(i, row); i++)
    if (strcmp(row->name, name) == 0) {
      *index = i;
      return true;
    }
  return false;
}

static enum status fail_choice(const struct reader *reader, const struct choice *choice, const char *word)
{
  struct names names = {0};
  struct row   row;
  for (int i = 0; choice->row(i, &row); i++) names_add(&names, row.name);
  return reader_unknown(reader, choice->key, word, &names);
}

/** The law that an object names; its default is added. */
static enum status read_choice(struct reader *reader, const struct choice *choice, cJSON *object, int *index,
                               struct row *row)
{
  const cJSON *word = json_member(object, choice->key);
  size_t       mark = reader_enter(reader, choice->key);
  if (!word && choice->fallback) {
    TRY(json_add(object, choice->key, cJSON_CreateString(choice->fallback)));
    word = json_member(object, choice->key);
  }
  if (!word) return reader_fail(reader, "is missing; give the %s", choice->meaning);
  if (!cJSON_IsString(word))
    return reader_fail(reader, "expected a word, found %s; give the %s", json_type(word), choice->meaning);
  if (!choice_find(choice, word->valuestring, index, row)) return fail_choice(reader, choice, word->valuestring);
  reader_leave(reader, mark);
  return OK;
}

/** Whether an entry goes with the dimension and the chosen kind. */
static bool applies(const struct entry *entry, const struct row *row, int dim)
{
  struct names names = {0};
  char         buffer[256];
  if (entry->only_3d && dim == 2) return false;
  if (!entry->only) return true;
  names_add_words(&names, entry->only, buffer, sizeof buffer);
  for (int i = 0; i < names.n; i++)
    if (row->name && strcmp(names.name[i], row->name) == 0) return true;
  return false;
}

/** Key of the parent from which a law's parameter is taken; NULL: none. */
static const char *given_by(const struct choice *choice, const char *param)
{
  for (int i = 0; choice && choice->given && choice->given[i]; i += 2)
    if (strcmp(choice->given[i], param) == 0) return choice->given[i + 1];
  return NULL;
}

static void collect_names(const struct reader *reader, const struct section *section, const struct row *row,
                          struct names *names)
{
  if (section->choice) names_add(names, section->choice->key);
  names_add_table(names, section->params);
  for (const struct entry *e = section->entries; e && e->name; e++)
    if (applies(e, row, reader->dim)) names_add(names, e->name);
  for (const struct param *p = row->params; p && p->name; p++)
    if (!given_by(section->choice, p->name)) names_add(names, p->name);
  for (int i = 0; section->modules && all_modules[i]; i++)
    if (all_modules[i]->params) names_add(names, all_modules[i]->name);
}

static bool is_among(const struct names *names, const char *name)
{
  for (int i = 0; i < names->n; i++)
    if (strcmp(names->name[i], name) == 0) return true;
  return false;
}

static enum status check_keys(struct reader *reader, const struct section *section, const struct row *row,
                              const cJSON *object)
{
  struct names names = {0};
  collect_names(reader, section, row, &names);
  for (const cJSON *member = object->child; member; member = member->next) {
    const char *owner = given_by(section->choice, member->string);
    if (json_is_comment(member) || is_among(&names, member->string)) continue;
    size_t mark = reader_enter(reader, member->string);
    if (owner) return reader_fail(reader, "is taken from \"%s\" one level up; set that and remove this", owner);
    reader_leave(reader, mark);
    return reader_unknown(reader, "key", member->string, &names);
  }
  return OK;
}

/** The default of an entry; NULL: it is required, or optional as a whole. */
static const char *entry_default(const struct entry *e, int dim)
{
  return dim == 3 && e->fallback3 ? e->fallback3 : e->fallback;
}

static enum status complete_entries(struct reader *reader, const struct section *section, const struct row *row,
                                    cJSON *object)
{
  for (const struct entry *e = section->entries; e && e->name; e++) {
    const char *fallback = entry_default(e, reader->dim);
    cJSON      *value = NULL;
    if (!fallback || !applies(e, row, reader->dim) || json_member(object, e->name)) continue;
    TRY(json_from_word(fallback, fallback, &value));
    TRY(json_add(object, e->name, value));
  }
  return OK;
}

static enum status check_name(const struct reader *reader, const char *name)
{
  static const char allowed[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-+";
  if (strlen(name) >= NAME_LENGTH)
    return reader_fail(reader, "the name has more than %d characters; shorten it", NAME_LENGTH - 1);
  if (*name == '\0' || strspn(name, allowed) != strlen(name))
    return reader_fail(reader, "a name may hold letters, digits and _ . - + only; rename it");
  return OK;
}

static int count_members(const cJSON *object)
{
  int n = 0;
  for (const cJSON *member = object->child; member; member = member->next) n += !json_is_comment(member);
  return n;
}

static enum status read_element(struct reader *reader, const struct section *section, const cJSON *map, cJSON *member,
                                char *base)
{
  TRY(check_name(reader, member->string));
  memcpy(base, member->string, strlen(member->string) + 1);
  if (section->bare) return params_read_value(reader, section->params, member, base);
  return section_read(reader, section, map, member, base);
}

/** A map of named elements into a new array; a null removes the element. */
static enum status read_map(struct reader *reader, const struct entry *e, cJSON *map, char *base)
{
  char *elements = NULL;
  if (!cJSON_IsObject(map))
    return reader_fail(reader, "expected an object of named entries, found %s; it holds the %s", json_type(map),
                       e->meaning);
  for (cJSON *member = map->child, *next; member; member = next) {
    next = member->next;
    if (cJSON_IsNull(member)) cJSON_Delete(cJSON_DetachItemViaPointer(map, member));
  }
  TRY(memory_new((size_t)count_members(map), e->section->size, &elements));
  memcpy(base + e->offset, &elements, sizeof elements);
  for (cJSON *member = map->child; member; member = member->next) {
    if (json_is_comment(member)) continue;
    int   *n = (int *)(base + e->count);
    size_t mark = reader_enter(reader, member->string);
    (*n)++;
    TRY(read_element(reader, e->section, map, member, elements + (size_t)(*n - 1) * e->section->size));
    reader_leave(reader, mark);
  }
  return OK;
}

/** "darcy" becomes {"law": "darcy"}. */
static enum status expand_word(const struct section *section, cJSON *object, const char *name, cJSON **value)
{
  cJSON *expanded = cJSON_CreateObject();
  if (!expanded) return FAIL(ERR_ENVIRONMENT, "no memory for an object");
  TRY(json_add(expanded, section->choice->key, cJSON_CreateString((*value)->valuestring)));
  if (!cJSON_ReplaceItemInObjectCaseSensitive(object, name, expanded))
    return FAIL(ERR_ENVIRONMENT, "no memory for an object");
  *value = expanded;
  return OK;
}

static enum status read_entry(struct reader *reader, const struct entry *e, cJSON *object, cJSON *value, char *base)
{
  if (e->kind == ENTRY_VALUE) return e->value->read(reader, value, base + e->offset);
  if (e->kind == ENTRY_MAP) return read_map(reader, e, value, base);
  if (e->section->word && cJSON_IsString(value)) TRY(expand_word(e->section, object, e->name, &value));
  return section_read(reader, e->section, object, value, base + e->offset);
}

static enum status read_entries(struct reader *reader, const struct section *section, const struct row *row,
                                cJSON *object, char *base)
{
  for (const struct entry *e = section->entries; e && e->name; e++) {
    cJSON *value = json_member(object, e->name);
    bool   optional = e->kind == ENTRY_SECTION && !e->fallback;
    if (!applies(e, row, reader->dim) || (optional && (!value || cJSON_IsNull(value)))) continue;
    size_t mark = reader_enter(reader, e->name);
    if (!value) return reader_fail(reader, "is missing; give the %s", e->meaning);
    TRY(read_entry(reader, e, object, value, base));
    reader_leave(reader, mark);
  }
  return OK;
}

/** Parameters of the chosen law: defaults, then what the object or, for a given one, its parent says. */
static enum status read_law(struct reader *reader, const struct section *section, const struct row *row,
                            const cJSON *parent, cJSON *object, void *params)
{
  for (const struct param *p = row->params; p && p->name; p++) {
    const char *owner = given_by(section->choice, p->name);
    if (!owner) {
      const struct param one[] = {*p, PARAM_END};
      TRY(params_complete(reader, one, object));
      TRY(params_read(reader, one, object, params));
    } else if (json_member(parent, owner)) {
      TRY(params_read_value(reader, p, json_member(parent, owner), params));
    }
  }
  return OK;
}

/** Where the parameters of the chosen law go: memory of its own, or for a kind the section's struct. */
static enum status place_law(const struct choice *choice, const struct row *row, int index, char *base, void **params)
{
  *params = base;
  if (!row->law) {
    *(int *)(base + choice->law) = index;
    return OK;
  }
  memcpy(base + choice->law, &row->law, sizeof row->law);
  TRY(memory_new(1, row->size, params));
  memcpy(base + choice->params, params, sizeof *params);
  return OK;
}

static enum status read_module(struct reader *reader, const struct module *module, cJSON *numerics, void **params)
{
  const struct section section = {.params = module->params};
  cJSON               *object = json_member(numerics, module->name);
  if (!object) {
    TRY(json_add(numerics, module->name, cJSON_CreateObject()));
    object = json_member(numerics, module->name);
  }
  size_t mark = reader_enter(reader, module->name);
  TRY(memory_new(1, module->params_size, params));
  TRY(section_read(reader, &section, numerics, object, *params));
  reader_leave(reader, mark);
  return OK;
}

enum status section_read(struct reader *reader, const struct section *section, const cJSON *parent, cJSON *object,
                         void *base)
{
  struct row row = {0};
  int        index = 0;
  void      *params = base;
  bool       links = reader->links;
  if (!cJSON_IsObject(object))
    return reader_fail(reader, "expected an object {...}, found %s; it holds the %s", json_type(object),
                       section->meaning);
  if (section->choice) TRY(read_choice(reader, section->choice, object, &index, &row));
  TRY(check_keys(reader, section, &row, object));
  TRY(params_complete(reader, section->params, object));
  TRY(complete_entries(reader, section, &row, object));
  reader->links = links || section->links;
  TRY(params_read(reader, section->params, object, base));
  if (section->choice) TRY(place_law(section->choice, &row, index, base, &params));
  TRY(read_law(reader, section, &row, parent, object, params));
  TRY(read_entries(reader, section, &row, object, base));
  for (int i = 0; section->modules && all_modules[i]; i++)
    if (all_modules[i]->params) TRY(read_module(reader, all_modules[i], object, &reader->scene->module_params[i]));
  reader->links = links;
  return OK;
}

static void destroy_law(const struct choice *choice, char *base)
{
  struct row  row;
  const void *law = NULL;
  memcpy(&law, base + choice->law, sizeof law);
  for (int i = 0; choice->row(i, &row); i++) {
    if (!row.law || row.law != law) continue;
    void *params = NULL;
    memcpy(&params, base + choice->params, sizeof params);
    if (params) params_destroy(row.params, params);
    memory_free(base + choice->params);
  }
}

static void destroy_map(const struct entry *e, char *base)
{
  char *elements = NULL;
  int   n = *(int *)(base + e->count);
  memcpy(&elements, base + e->offset, sizeof elements);
  for (int i = 0; i < n; i++) section_destroy(e->section, elements + (size_t)i * e->section->size);
  memory_free(base + e->offset);
  *(int *)(base + e->count) = 0;
}

void section_destroy(const struct section *section, void *base)
{
  char *at = base;
  params_destroy(section->params, base);
  if (section->choice) {
    struct row first;
    if (section->choice->row(0, &first) && first.law) destroy_law(section->choice, base);
  }
  for (const struct entry *e = section->entries; e && e->name; e++) {
    if (e->kind == ENTRY_VALUE && e->value->destroy) e->value->destroy(at + e->offset);
    if (e->kind == ENTRY_SECTION) section_destroy(e->section, at + e->offset);
    if (e->kind == ENTRY_MAP) destroy_map(e, at);
  }
}
