/* JSON through cJSON, which keeps duplicate keys, knows no limits and tells errors as a pointer: that is mended here.
 */
#include "run/json.h"

#include "core/memory.h"
#include "run/files.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/** "line 3, column 7" of a place in a text. */
static void describe_place(const char *text, const char *at, char *place, size_t size)
{
  int         line = 1;
  const char *start = text;
  for (const char *c = text; c < at; c++)
    if (*c == '\n') {
      line++;
      start = c + 1;
    }
  snprintf(place, size, "line %d, column %d", line, (int)(at - start) + 1);
}

/** First bracket that is nested too deeply; NULL: none. cJSON itself would recurse a thousand times. */
static const char *too_deep(const char *text)
{
  int  depth = 0;
  bool quoted = false;
  for (const char *c = text; *c; c++) {
    if (quoted && *c == '\\' && c[1])
      c++;
    else if (*c == '"')
      quoted = !quoted;
    else if (!quoted && (*c == '{' || *c == '[') && ++depth > JSON_DEPTH)
      return c;
    else if (!quoted && (*c == '}' || *c == ']'))
      depth--;
  }
  return NULL;
}

static bool is_repeated(const cJSON *object, const cJSON *member)
{
  if (json_is_comment(member)) return false;
  for (const cJSON *other = object->child; other != member; other = other->next)
    if (strcmp(other->string, member->string) == 0) return true;
  return false;
}

/** What cJSON lets pass: duplicate keys, numbers beyond a double. path: where item stands. */
static enum status check_tree(const char *origin, const cJSON *item, char path[JSON_PATH])
{
  size_t length = strlen(path);
  int    n = 0;
  if (cJSON_IsNumber(item) && !isfinite(item->valuedouble))
    return FAIL(ERR_INPUT, "%s: %s: the number is not finite; write one that a double can hold", origin, path);
  for (const cJSON *child = item->child; child; child = child->next, n++) {
    if (child->string)
      snprintf(path + length, JSON_PATH - length, "%s%s", length ? "." : "", child->string);
    else
      snprintf(path + length, JSON_PATH - length, "%s%d", length ? "." : "", n);
    if (cJSON_IsObject(item) && n >= JSON_MEMBERS)
      return FAIL(ERR_INPUT, "%s: %s: more than %d members in one object; split it", origin, path, JSON_MEMBERS);
    if (child->string && is_repeated(item, child))
      return FAIL(ERR_INPUT, "%s: %s: the key stands twice; remove one of the two", origin, path);
    TRY(check_tree(origin, child, path));
    path[length] = '\0';
  }
  return OK;
}

static enum status fail_parse(const char *file, const char *text, const char *at)
{
  char place[64];
  describe_place(text, at, place, sizeof place);
  if (*at == '\0')
    return FAIL(ERR_INPUT, "%s: %s: the file ends inside the JSON; it is cut off or a bracket is missing", file, place);
  return FAIL(ERR_INPUT, "%s: %s: no valid JSON from \"%.*s\" on; mend the text there", file, place,
              (int)strcspn(at, "\r\n") < 20 ? (int)strcspn(at, "\r\n") : 20, at);
}

static enum status parse_text(const char *file, const char *text, size_t n, cJSON **json)
{
  char        place[64], path[JSON_PATH] = "";
  const char *end = text, *deep = too_deep(text);
  if (strlen(text) != n) {
    describe_place(text, text + strlen(text), place, sizeof place);
    return FAIL(ERR_INPUT, "%s: %s: a zero byte; the file is not a text", file, place);
  }
  if (deep) {
    describe_place(text, deep, place, sizeof place);
    return FAIL(ERR_INPUT, "%s: %s: brackets nested more than %d deep; simplify", file, place, JSON_DEPTH);
  }
  *json = cJSON_ParseWithLengthOpts(text, n + 1, &end, true);
  if (!*json) return fail_parse(file, text, end);
  enum status status = check_tree(file, *json, path);
  if (status == OK) return OK;
  cJSON_Delete(*json);
  *json = NULL;
  return status;
}

enum status json_load(const char *file, cJSON **json)
{
  char  *text = NULL;
  size_t n = 0;
  *json = NULL;
  TRY(files_read(file, JSON_BYTES, &text, &n));
  enum status status = parse_text(file, text, n, json);
  memory_free(&text);
  return status;
}

enum status json_from_word(const char *origin, const char *text, cJSON **json)
{
  char path[JSON_PATH] = "";
  *json = too_deep(text) ? NULL : cJSON_ParseWithOpts(text, NULL, true);
  if (!*json) *json = cJSON_CreateString(text);
  if (!*json) return FAIL(ERR_ENVIRONMENT, "%s: no memory for a value", origin);
  enum status status = check_tree(origin, *json, path);
  if (status == OK) return OK;
  cJSON_Delete(*json);
  *json = NULL;
  return status;
}

cJSON *json_member(const cJSON *object, const char *name)
{
  return cJSON_IsObject(object) ? cJSON_GetObjectItemCaseSensitive(object, name) : NULL;
}

bool json_is_comment(const cJSON *member)
{
  return !member->string || strncmp(member->string, "//", 2) == 0 || strcmp(member->string, "$schema") == 0;
}

size_t json_name_length(const cJSON *object, const char *path)
{
  size_t longest = 0;
  for (const cJSON *member = cJSON_IsObject(object) ? object->child : NULL; member; member = member->next) {
    size_t length = strlen(member->string);
    bool   fits = strncmp(member->string, path, length) == 0 && (path[length] == '.' || path[length] == '\0');
    if (fits && length > longest) longest = length;
  }
  return longest > 0 ? longest : strcspn(path, ".");
}

cJSON *json_step(const cJSON *at, const char *path, size_t length)
{
  char name[JSON_PATH];
  if (length >= sizeof name) return NULL;
  memcpy(name, path, length);
  name[length] = '\0';
  if (!cJSON_IsArray(at)) return json_member(at, name);
  if (length == 0 || length > 6 || strspn(name, "0123456789") != length) return NULL;
  return cJSON_GetArrayItem(at, atoi(name));
}

cJSON *json_find(const cJSON *root, const char *path)
{
  const cJSON *at = root;
  while (at) {
    size_t length = json_name_length(at, path);
    cJSON *child = json_step(at, path, length);
    if (path[length] == '\0') return child;
    path += length + 1;
    at = child;
  }
  return NULL;
}

enum status json_add(cJSON *to, const char *name, cJSON *item)
{
  bool added = item && (name ? cJSON_AddItemToObject(to, name, item) : cJSON_AddItemToArray(to, item));
  return added ? OK : FAIL(ERR_ENVIRONMENT, "no memory for the value of %s", name ? name : "an array");
}

/** Puts a copy of value at the name path[0..length) of an object, or at that element of an array. */
static enum status put(const char *origin, cJSON *at, const char *path, size_t length, const cJSON *value)
{
  char   name[JSON_PATH];
  cJSON *old = json_step(at, path, length);
  snprintf(name, sizeof name, "%.*s", (int)length, path);
  if (!old && cJSON_IsArray(at))
    return FAIL(ERR_INPUT, "%s: the list has %d elements, none is \"%s\"; give a number from 0 on", origin,
                cJSON_GetArraySize(at), name);
  if (!old) return json_add(at, name, cJSON_Duplicate(value, true));
  cJSON *copy = cJSON_Duplicate(value, true);
  if (!copy) return FAIL(ERR_ENVIRONMENT, "%s: no memory for the value", origin);
  if (cJSON_IsArray(at))
    return cJSON_ReplaceItemViaPointer(at, old, copy) ? OK : FAIL(ERR_ENVIRONMENT, "%s: no memory", origin);
  return cJSON_ReplaceItemInObjectCaseSensitive(at, name, copy) ? OK : FAIL(ERR_ENVIRONMENT, "%s: no memory", origin);
}

enum status json_set(const char *origin, cJSON *root, const char *path, const cJSON *value)
{
  cJSON *at = root;
  if (strlen(path) >= JSON_PATH)
    return FAIL(ERR_INPUT, "%s: a key path of more than %d characters; shorten it", origin, JSON_PATH - 1);
  for (;;) {
    size_t length = json_name_length(at, path);
    if (length == 0)
      return FAIL(ERR_INPUT, "%s: an empty name in the key path; write it as grid.h or numerics.basis", origin);
    if (!cJSON_IsObject(at) && !cJSON_IsArray(at))
      return FAIL(ERR_INPUT, "%s: \"%s\" is looked for in %s, which has no members; shorten the path", origin, path,
                  json_type(at));
    if (path[length] == '\0') return put(origin, at, path, length, value);
    cJSON *child = json_step(at, path, length);
    if (!child) {
      cJSON *object = cJSON_CreateObject();
      if (!object) return FAIL(ERR_ENVIRONMENT, "%s: no memory for an object", origin);
      enum status status = put(origin, at, path, length, object);
      cJSON_Delete(object);
      if (status != OK) return status;
      child = json_step(at, path, length);
    }
    at = child;
    path += length + 1;
  }
}

const char *json_type(const cJSON *item)
{
  if (cJSON_IsNumber(item)) return "a number";
  if (cJSON_IsString(item)) return "a text";
  if (cJSON_IsBool(item)) return "true or false";
  if (cJSON_IsArray(item)) return "a list";
  if (cJSON_IsObject(item)) return "an object";
  return "null";
}
