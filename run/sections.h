/* The shape of a scene file as tables: sections hold parameters, values of their own kind, sections and maps of named
 * sections. One walk reads, one releases; schema and reference page walk the same tables. */
#ifndef RUN_SECTIONS_H
#define RUN_SECTIONS_H

#include "run/params.h"

/* A value that no struct param describes, such as a shape. */
struct value_kind {
  const char *name; /* in documents */
  enum status (*read)(struct reader *reader, const cJSON *value, void *at);
  void (*destroy)(void *at); /* NULL: nothing to release */
  const char *schema;        /* JSON Schema, as text */
};

struct section;

enum entry_kind { ENTRY_VALUE, ENTRY_SECTION, ENTRY_MAP };

struct entry {
  const char              *name;
  enum entry_kind          kind;
  const struct value_kind *value;   /* ENTRY_VALUE */
  const struct section    *section; /* ENTRY_SECTION, ENTRY_MAP */
  size_t                   offset;  /* of the value, of the section's struct, or of the map's pointer */
  size_t                   count;   /* ENTRY_MAP: of the int that counts its elements */
  const char              *fallback,
      *fallback3;   /* as in struct param; the second for 3D where it differs. SECTION: NULL: optional */
  const char *only; /* "integral|mean": the choices it goes with; NULL: all */
  const char *unit, *meaning;
  bool        only_3d; /* there is no such key in 2D */
};

/* One of the laws, or kinds, that a section may name. */
struct row {
  const char         *name, *source;
  const struct param *params;
  size_t              size;
  const void         *law; /* NULL: a kind; its index is kept */
};

/* The key by which a section names a law or kind; the parameters of that stand beside it. */
struct choice {
  const char *key, *fallback, *meaning;
  bool (*row)(int i, struct row *row); /* false: past the last */
  size_t             law;              /* offset of the const pointer to the law, or of the int index of the kind */
  size_t             params;           /* offset of the void * to its parameters; of a kind: unused */
  const char        *document;         /* where the rows' sources are found; NULL: they have none */
  const char *const *given;            /* parameter, key of the parent, ..., NULL: taken from the parent section */
};

struct section {
  const char          *meaning;
  size_t               size; /* of a map's element; its first member is char name[NAME_LENGTH] */
  const struct param  *params;
  const struct entry  *entries; /* ends with a NULL name */
  const struct choice *choice;  /* NULL: none */
  bool                 bare;    /* not an object: the value of its only parameter */
  bool                 word;    /* "darcy" may stand for {"law": "darcy"} */
  bool                 links;   /* numbers may be "=key.path" */
  bool                 modules; /* holds a section for every module that has parameters */
};

/** Fills the struct at `base` from a member of `parent` and adds to `object` every default. */
enum status section_read(struct reader *reader, const struct section *section, const cJSON *parent, cJSON *object,
                         void *base) MUST_CHECK;
/** Releases what section_read made, also after an error. */
void section_destroy(const struct section *section, void *base);
/** Whether an override may be applied: its key is known, and what it goes through exists. */
enum status section_check_override(struct reader *reader, const struct section *section, const cJSON *object,
                                   const char *key) MUST_CHECK;
/** Row of a choice by its name; false: none. */
bool choice_find(const struct choice *choice, const char *name, int *index, struct row *row);

#endif
