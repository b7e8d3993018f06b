/* One table per set of parameters: it validates the scene, fills the struct, documents and emits the schema. */
#ifndef CORE_PARAM_H
#define CORE_PARAM_H

#include "core/function.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

enum param_type {
  PARAM_NUMBER,   /* double */
  PARAM_INTEGER,  /* int */
  PARAM_FLAG,     /* bool */
  PARAM_CHOICE,   /* int: index into words */
  PARAM_TEXT,     /* char[NAME_LENGTH] */
  PARAM_VECTOR,   /* double[3]; the scene gives dim numbers; null means unbounded where INFINITY is in range */
  PARAM_FUNCTION, /* struct function: a number or an expression of x, y, z, t */
  PARAM_FUNCTION3 /* struct function[3] */
};

enum { NAME_LENGTH = 64 };

struct param {
  const char     *name; /* key in the scene */
  enum param_type type;
  size_t          offset;   /* in the struct that is filled */
  const char     *unit;     /* SI, "-" if none */
  double          min, max; /* inclusive range of numbers */
  const char     *fallback; /* default as it would stand in the scene; NULL: required */
  const char     *words;    /* PARAM_CHOICE: "slip|no_slip|..." */
  const char     *meaning;  /* one sentence */
};

#define PARAM_END                                                                                                      \
  {                                                                                                                    \
    .name = NULL                                                                                                       \
  }

#endif
