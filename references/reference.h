/* Closed forms and exact solvers, used by tests and by metrics. Includes only core. */
#ifndef REFERENCES_REFERENCE_H
#define REFERENCES_REFERENCE_H

#include "core/param.h"

struct reference {
  const char         *name, *source; /* word in the scene; where the formula comes from */
  const struct param *params;        /* numbers; in a scene each may also be "=key.path", the value found there */
  size_t              param_size;
  const char         *quantities; /* "P|settlement|..." */
  /** Values [n] of a quantity (index into quantities) at x [n][3] m and time t s, SI. */
  enum status (*value)(const void *prm, int quantity, int n, const double (*x)[3], double t, double *value);
  /** s: the unit of scaled times (T_v = 1); NULL: 1 s. */
  double (*time_scale)(const void *prm);
  /** What errors of curves and fields of a quantity are divided by; NULL: 1. (Single numbers: by their own value.) */
  double (*scale)(const void *prm, int quantity);
};

extern const struct reference *const references[];
const struct reference              *reference_find(const char *name);
/** Index of a word in reference->quantities; -1: no such quantity. */
int reference_quantity(const struct reference *reference, const char *word);

#endif
