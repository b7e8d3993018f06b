/* A value that may depend on place and time: a number, an expression of x, y, z, t such as "1e4*min(1, t/0.001)", or a
 * table over time. */
#ifndef CORE_FUNCTION_H
#define CORE_FUNCTION_H

#include "core/status.h"

#include <stdbool.h>

struct expression;

struct function {
  double             constant;   /* used when expression is NULL */
  struct expression *expression; /* owned; of a table too */
};

/** Parses: + - * / ^ ( ), unary -, x y z t pi, min max abs sqrt exp log sin cos tan tanh floor step(a) = a >= 0,
 * numbers. ERR_INPUT names the column and what was expected. */
enum status function_parse(const char *text, struct function *f) MUST_CHECK;
/** A table: values v [n] at increasing times t [n] s, n >= 1. Linear between rows, before the first and after the last
 * row the value that stands there. Both arrays are copied. */
enum status function_table(int n, const double *t, const double *v, struct function *f) MUST_CHECK;
void        function_destroy(struct function *f);
/** Value at x [3] m and t s. */
double function_value(const struct function *f, const double x[3], double t);
/** Whether x, y or z occur in it. */
bool function_varies_in_space(const struct function *f);
/** Rows of a table, their times t [n] s and values v [n]; 0: it is none. */
int function_rows(const struct function *f, const double **t, const double **v);
/** The text it was parsed from; NULL for a constant or a table. */
const char *function_text(const struct function *f);

#endif
