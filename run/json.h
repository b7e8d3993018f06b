/* JSON texts and trees: loaded within limits, looked up and overridden by dotted path. */
#ifndef RUN_JSON_H
#define RUN_JSON_H

#include "core/status.h"

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>

/* limits of an input file: bytes, nested brackets, members of one object, characters of a key path */
enum { JSON_BYTES = 4 << 20, JSON_DEPTH = 32, JSON_MEMBERS = 4096, JSON_PATH = 512 };

/** Parses a file. ERR_INPUT names line and column, or the path of a duplicate key or a number that is not finite. */
enum status json_load(const char *file, cJSON **json) MUST_CHECK;
/** `text` as JSON if it is JSON, else as a string. */
enum status json_from_word(const char *origin, const char *text, cJSON **json) MUST_CHECK;
/** The member of that exact name; NULL: none. */
cJSON *json_member(const cJSON *object, const char *name);
/** Members whose name starts with // are comments; "$schema", for editors, and what has no name count too. */
bool json_is_comment(const cJSON *member);
/** What lies at a dotted path ("materials.sand.young", "grid.max.1"); NULL: nothing. Names may hold dots. */
cJSON *json_find(const cJSON *root, const char *path);
/** Puts a copy of `value` at a dotted path and makes the objects on the way. `origin` starts the message. */
enum status json_set(const char *origin, cJSON *root, const char *path, const cJSON *value) MUST_CHECK;
/** Adds `item` (taken over, NULL means no memory) to an object, or to an array when name is NULL. */
enum status json_add(cJSON *to, const char *name, cJSON *item) MUST_CHECK;
/** "a number", "a text", ... for messages. */
const char *json_type(const cJSON *item);
/** Characters of the first name of a dotted path in `object`: of the longest member that fits, else up to a dot. */
size_t json_name_length(const cJSON *object, const char *path);
/** The member that is the first name of a dotted path, or the element of that number; NULL: none. */
cJSON *json_step(const cJSON *at, const char *path, size_t length);

#endif
