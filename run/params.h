/* One `struct param` table against one JSON object: default, read, check, release. And the reader's place in the file.
 */
#ifndef RUN_PARAMS_H
#define RUN_PARAMS_H

#include "core/param.h"
#include "run/json.h"

struct scene;

/* Where the reader stands. */
struct reader {
  const char   *file;            /* starts every message */
  char          path[JSON_PATH]; /* dotted path of the value at hand */
  int           dim;             /* of the grid: numbers in a vector */
  bool          links;           /* numbers may be "=key.path" */
  const cJSON  *root;            /* where links are looked up */
  struct scene *scene;           /* being filled */
};

/** One name deeper; returns what reader_leave needs. */
size_t reader_enter(struct reader *reader, const char *name);
void   reader_leave(struct reader *reader, size_t mark);
/** ERR_INPUT "file: path: message"; the message ends with a remedy. */
enum status reader_fail(const struct reader *reader, const char *format, ...) __attribute__((format(printf, 2, 3)));
/** The same from the message of the last FAIL. */
enum status reader_wrap(const struct reader *reader);

/** Adds every missing parameter that has a default. */
enum status params_complete(struct reader *reader, const struct param *table, cJSON *object) MUST_CHECK;
/** Fills the struct at `base` from a completed object. */
enum status params_read(struct reader *reader, const struct param *table, const cJSON *object, void *base) MUST_CHECK;
/** One value; reader->path is already its own. */
enum status params_read_value(struct reader *reader, const struct param *p, const cJSON *value, void *base) MUST_CHECK;
/** Releases the expressions. */
void params_destroy(const struct param *table, void *base);
/** A default as JSON: a word, or for a vector a single number that stands for every axis. */
enum status params_default(const char *fallback, enum param_type type, int dim, cJSON **json) MUST_CHECK;

/** Expression of x, y, z, t or number. */
enum status params_read_function(struct reader *reader, const cJSON *value, struct function *f) MUST_CHECK;
/** "0 <= value <= 1 Pa", "" without limits: the range of a number for messages and documents. */
void params_range(const struct param *p, char *text, size_t size);

/* Collects names, to say which is nearest to a wrong one and which there are. */
struct names {
  int         n;
  const char *name[256]; /* more are left out of the message */
};

void names_add(struct names *names, const char *name);
void names_add_table(struct names *names, const struct param *table);
/** Adds the words of "a|b|c"; `buffer` holds them. */
void names_add_words(struct names *names, const char *words, char *buffer, size_t size);
/** ERR_INPUT: unknown `what` "wrong"; nearest; all. */
enum status reader_unknown(const struct reader *reader, const char *what, const char *wrong, const struct names *names);

#endif
