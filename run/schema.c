/* JSON Schema of a scene, built from its tables. */
#include "run/schema.h"

#include "core/scene.h"
#include "run/plan.h"
#include "run/scene_tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* keys that a scene may hold anywhere: comments, and the schema that an editor uses */
static const char comments[] = "^(//|[$]schema$)";

/* Collects whether memory ran out: then the whole schema is given up. */
struct builder {
  bool failed, links;
};

/** Adds item to an object, or to an array when name is NULL; returns it. */
static cJSON *add(struct builder *b, cJSON *to, const char *name, cJSON *item)
{
  bool added = to && item && (name ? cJSON_AddItemToObject(to, name, item) : cJSON_AddItemToArray(to, item));
  if (!added) b->failed = true;
  return added ? item : NULL;
}

static void add_text(struct builder *b, cJSON *to, const char *name, const char *text)
{
  add(b, to, name, cJSON_CreateString(text));
}
static void add_number(struct builder *b, cJSON *to, const char *name, double x)
{
  add(b, to, name, cJSON_CreateNumber(x));
}

/** {"type": "number", "minimum": ..., "maximum": ...} */
static void describe_number(struct builder *b, cJSON *to, const struct param *p, const char *type)
{
  add_text(b, to, "type", type);
  if (isfinite(p->min)) add_number(b, to, "minimum", p->min);
  if (isfinite(p->max)) add_number(b, to, "maximum", p->max);
}

/** A number, or one of the words that may stand for it. */
static void describe_number_or_word(struct builder *b, cJSON *to, const struct param *p)
{
  bool infinite = isinf(p->max), null = infinite && p->fallback && strcmp(p->fallback, "null") == 0;
  if (!infinite && !b->links) {
    describe_number(b, to, p, "number");
    return;
  }
  cJSON *any = add(b, to, "anyOf", cJSON_CreateArray());
  describe_number(b, add(b, any, NULL, cJSON_CreateObject()), p, "number");
  if (infinite) add_text(b, add(b, any, NULL, cJSON_CreateObject()), "const", "infinite");
  if (null) add_text(b, add(b, any, NULL, cJSON_CreateObject()), "type", "null");
  if (b->links) add_text(b, add(b, any, NULL, cJSON_CreateObject()), "pattern", "^=");
}

static void describe_vector(struct builder *b, cJSON *to, const struct param *p)
{
  add_text(b, to, "type", "array");
  add_number(b, to, "minItems", 2);
  add_number(b, to, "maxItems", 3);
  cJSON *items = add(b, to, "items", cJSON_CreateObject());
  cJSON *types = add(b, items, "type", cJSON_CreateArray());
  add(b, types, NULL, cJSON_CreateString("number"));
  if (isinf(p->max)) add(b, types, NULL, cJSON_CreateString("null"));
}

static void describe_words(struct builder *b, cJSON *to, const char *words)
{
  struct names names = {0};
  char         buffer[512];
  names_add_words(&names, words, buffer, sizeof buffer);
  cJSON *list = add(b, to, "enum", cJSON_CreateArray());
  for (int i = 0; i < names.n; i++) add(b, list, NULL, cJSON_CreateString(names.name[i]));
}

static void describe_value(struct builder *b, cJSON *to, const struct param *p)
{
  switch (p->type) {
  case PARAM_NUMBER:
    describe_number_or_word(b, to, p);
    break;
  case PARAM_INTEGER:
    describe_number(b, to, p, "integer");
    break;
  case PARAM_FLAG:
    add_text(b, to, "type", "boolean");
    break;
  case PARAM_CHOICE:
    describe_words(b, to, p->words);
    break;
  case PARAM_TEXT:
    add_text(b, to, "type", "string");
    break;
  case PARAM_VECTOR:
    describe_vector(b, to, p);
    break;
  case PARAM_FUNCTION:
    add_text(b, to, "$ref", "#/$defs/function");
    break;
  case PARAM_FUNCTION3:
    add_text(b, to, "$ref", "#/$defs/function3");
    break;
  }
}

static void add_default(struct builder *b, cJSON *to, const char *fallback)
{
  cJSON *value = NULL;
  if (!fallback) return;
  if (json_from_word("default", fallback, &value) != OK)
    b->failed = true;
  else
    add(b, to, "default", value);
}

static void describe_meaning(struct builder *b, cJSON *to, const char *meaning, const char *unit)
{
  char text[400];
  bool has_unit = unit && *unit && strcmp(unit, "-") != 0;
  snprintf(text, sizeof text, "%s%s%s%s", meaning, has_unit ? " (" : "", has_unit ? unit : "", has_unit ? ")" : "");
  add_text(b, to, "description", text);
}

/** The parameters of a table as properties; those without default are required. skip: taken from the parent. */
static void describe_table(struct builder *b, cJSON *properties, cJSON *required, const struct param *table,
                           const char *const *skip)
{
  for (const struct param *p = table; p && p->name; p++) {
    bool given = false;
    for (int i = 0; skip && skip[i]; i += 2) given = given || strcmp(skip[i], p->name) == 0;
    if (given) continue;
    cJSON *to = add(b, properties, p->name, cJSON_CreateObject());
    describe_value(b, to, p);
    describe_meaning(b, to, p->meaning, p->unit);
    bool per_axis = p->type == PARAM_VECTOR || p->type == PARAM_FUNCTION3;
    if (!per_axis) add_default(b, to, p->fallback);
    if (!p->fallback) add(b, required, NULL, cJSON_CreateString(p->name));
  }
}

static cJSON *describe_section(struct builder *b, const struct section *section);

static cJSON *describe_entry(struct builder *b, const struct entry *e)
{
  if (e->kind == ENTRY_VALUE) {
    cJSON *value = cJSON_Parse(e->value->schema);
    if (value) describe_meaning(b, value, e->meaning, e->unit);
    return value;
  }
  cJSON *inner = e->section->bare ? cJSON_CreateObject() : describe_section(b, e->section);
  if (e->section->bare) describe_value(b, inner, e->section->params);
  if (e->kind == ENTRY_SECTION && !e->section->word) return inner;
  cJSON *outer = cJSON_CreateObject();
  if (e->kind == ENTRY_MAP) {
    add_text(b, outer, "type", "object");
    add(b, add(b, outer, "patternProperties", cJSON_CreateObject()), comments, cJSON_CreateObject());
    add(b, outer, "additionalProperties", inner);
  } else {
    cJSON *any = add(b, outer, "anyOf", cJSON_CreateArray());
    add(b, any, NULL, inner);
    add_text(b, add(b, any, NULL, cJSON_CreateObject()), "type", "string");
  }
  describe_meaning(b, outer, e->meaning, e->unit);
  return outer;
}

/** Whether an entry goes with a row: with every one, or with those it lists. */
static bool goes_with(const struct entry *e, const struct row *row)
{
  struct names names = {0};
  char         buffer[256];
  if (!row) return !e->only;
  if (!e->only) return false;
  names_add_words(&names, e->only, buffer, sizeof buffer);
  for (int i = 0; i < names.n; i++)
    if (strcmp(names.name[i], row->name) == 0) return true;
  return false;
}

static void describe_entries(struct builder *b, cJSON *properties, cJSON *required, const struct section *section,
                             const struct row *row)
{
  for (const struct entry *e = section->entries; e && e->name; e++) {
    if (!goes_with(e, row)) continue;
    add(b, properties, e->name, describe_entry(b, e));
    if (e->kind == ENTRY_VALUE && !e->fallback) add(b, required, NULL, cJSON_CreateString(e->name));
  }
}

/** if the word is this row's, then its parameters; a default row also where the word is left out. */
static void describe_row(struct builder *b, cJSON *all, const struct section *section, const struct row *row)
{
  const struct choice *choice = section->choice;
  cJSON               *rule = add(b, all, NULL, cJSON_CreateObject());
  cJSON               *condition = add(b, rule, "if", cJSON_CreateObject());
  cJSON *word = add(b, add(b, condition, "properties", cJSON_CreateObject()), choice->key, cJSON_CreateObject());
  add_text(b, word, "const", row->name);
  if (!choice->fallback || strcmp(choice->fallback, row->name) != 0)
    add_text(b, add(b, condition, "required", cJSON_CreateArray()), NULL, choice->key);
  cJSON *then = add(b, rule, "then", cJSON_CreateObject());
  cJSON *properties = add(b, then, "properties", cJSON_CreateObject());
  cJSON *required = add(b, then, "required", cJSON_CreateArray());
  describe_table(b, properties, required, row->params, choice->given);
  describe_entries(b, properties, required, section, row);
}

static void describe_choice(struct builder *b, cJSON *to, cJSON *properties, cJSON *required,
                            const struct section *section)
{
  const struct choice *choice = section->choice;
  struct row           row;
  cJSON               *word = add(b, properties, choice->key, cJSON_CreateObject());
  cJSON               *words = add(b, word, "enum", cJSON_CreateArray());
  cJSON               *all = add(b, to, "allOf", cJSON_CreateArray());
  describe_meaning(b, word, choice->meaning, NULL);
  add_default(b, word, choice->fallback);
  if (!choice->fallback) add(b, required, NULL, cJSON_CreateString(choice->key));
  for (int i = 0; choice->row(i, &row); i++) {
    add(b, words, NULL, cJSON_CreateString(row.name));
    describe_row(b, all, section, &row);
  }
}

static void describe_modules(struct builder *b, cJSON *properties)
{
  for (int i = 0; all_modules[i]; i++) {
    const struct section section = {.params = all_modules[i]->params, .meaning = "choices of the module"};
    if (section.params) add(b, properties, all_modules[i]->name, describe_section(b, &section));
  }
}

static cJSON *describe_section(struct builder *b, const struct section *section)
{
  cJSON *to = cJSON_CreateObject();
  bool   links = b->links;
  b->links = links || section->links;
  add_text(b, to, "type", "object");
  describe_meaning(b, to, section->meaning, NULL);
  cJSON *properties = add(b, to, "properties", cJSON_CreateObject());
  cJSON *required = add(b, to, "required", cJSON_CreateArray());
  describe_table(b, properties, required, section->params, NULL);
  describe_entries(b, properties, required, section, NULL);
  if (section->modules) describe_modules(b, properties);
  if (section->choice) describe_choice(b, to, properties, required, section);
  add(b, add(b, to, "patternProperties", cJSON_CreateObject()), comments, cJSON_CreateObject());
  add(b, to, "unevaluatedProperties", cJSON_CreateFalse());
  b->links = links;
  return to;
}

/** What one key of a shape holds. */
static cJSON *describe_shape_word(struct builder *b, const struct shape_word *w)
{
  const struct section section = {.meaning = w->meaning, .params = w->params};
  if (w->params) return describe_section(b, &section);
  if (w->kind == SHAPE_POLYGON)
    return cJSON_Parse("{\"type\": \"array\", \"minItems\": 3, \"items\": {\"type\": \"array\", \"minItems\": 2, "
                       "\"maxItems\": 2, \"items\": {\"type\": \"number\"}}}");
  return cJSON_Parse("{\"type\": \"array\", \"minItems\": 1, \"items\": {\"$ref\": \"#/$defs/shape\"}}");
}

static void define_shape(struct builder *b, cJSON *defs)
{
  cJSON *any = add(b, add(b, defs, "shape", cJSON_CreateObject()), "oneOf", cJSON_CreateArray());
  add_text(b, add(b, any, NULL, cJSON_CreateObject()), "const", "everywhere");
  for (const struct shape_word *w = shape_words; w->name; w++) {
    cJSON *one = add(b, any, NULL, cJSON_CreateObject());
    add_text(b, one, "type", "object");
    add(b, add(b, one, "properties", cJSON_CreateObject()), w->name, describe_shape_word(b, w));
    add(b, add(b, one, "required", cJSON_CreateArray()), NULL, cJSON_CreateString(w->name));
    add(b, add(b, one, "patternProperties", cJSON_CreateObject()), comments, cJSON_CreateObject());
    add(b, one, "additionalProperties", cJSON_CreateFalse());
  }
}

/** side_solid, side_fluid: words, or an object of `properties` of which `least` to `most` are given. */
static void define_side(struct builder *b, cJSON *defs, const char *name, const char *properties, int least, int most)
{
  cJSON *any = add(b, add(b, defs, name, cJSON_CreateObject()), "oneOf", cJSON_CreateArray());
  cJSON *word = add(b, any, NULL, cJSON_CreateObject());
  bool   solid = strcmp(name, "side_solid") == 0;
  describe_words(b, word,
                 solid ? "slip|no_slip|symmetry|open|periodic|absorbing" : "slip|no_slip|symmetry|open|periodic");
  cJSON *one = add(b, any, NULL, cJSON_CreateObject());
  add_text(b, one, "type", "object");
  add(b, one, "properties", cJSON_Parse(properties));
  add_number(b, one, "minProperties", least);
  add_number(b, one, "maxProperties", most);
  add(b, one, "additionalProperties", cJSON_CreateFalse());
}

static void define_all(struct builder *b, cJSON *defs)
{
  add(b, defs, "function",
      cJSON_Parse(
          "{\"anyOf\": [{\"type\": [\"number\", \"string\"]}, {\"type\": \"object\", \"required\": [\"table\"], "
          "\"properties\": {\"table\": {\"type\": \"string\"}, \"column\": {\"type\": \"string\"}, \"scale\": "
          "{\"type\": \"number\"}}, \"patternProperties\": {\"^(//|[$]schema$)\": {}}, \"additionalProperties\": "
          "false}], \"description\": \"number, expression of x, y, z, t, or table over time\"}"));
  add(b, defs, "function3",
      cJSON_Parse(
          "{\"type\": \"array\", \"minItems\": 2, \"maxItems\": 3, \"items\": {\"$ref\": \"#/$defs/function\"}}"));
  define_shape(b, defs);
  define_side(b, defs, "side_solid",
              "{\"velocity\": {\"$ref\": \"#/$defs/function3\"}, \"friction\": {\"type\": \"number\", \"minimum\": 0}}",
              1, 2);
  define_side(b, defs, "side_fluid",
              "{\"velocity\": {\"$ref\": \"#/$defs/function3\"}, \"pressure\": {\"$ref\": \"#/$defs/function\"}}", 1,
              1);
}

enum status schema_print(FILE *out)
{
  struct builder b = {0};
  cJSON         *schema = describe_section(&b, &scene_section);
  add_text(&b, schema, "$schema", "https://json-schema.org/draft/2020-12/schema");
  add_text(&b, schema, "title", "mpmice scene");
  define_all(&b, add(&b, schema, "$defs", cJSON_CreateObject()));
  char *text = cJSON_Print(schema);
  if (text && !b.failed) fprintf(out, "%s\n", text);
  bool failed = !text || b.failed;
  free(text);
  cJSON_Delete(schema);
  return failed ? FAIL(ERR_ENVIRONMENT, "schema: no memory; close other programs") : OK;
}
