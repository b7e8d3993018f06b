/* A value that may depend on place and time: a number, or an expression of x, y, z, t such as "1e4*min(1, t/0.001)". */
#ifndef CORE_FUNCTION_H
#define CORE_FUNCTION_H

#include "core/status.h"

struct expression;

struct function {
  double             constant;   /* used when expression is NULL */
  struct expression *expression; /* owned */
};

/** Parses: + - * / ^ ( ), unary -, x y z t pi, min max abs sqrt exp log sin cos tan tanh floor step(a) = a >= 0,
 * numbers. ERR_INPUT names the column and what was expected. */
enum status function_parse(const char *text, struct function *f) MUST_CHECK;
void        function_destroy(struct function *f);
/** Value at x [3] m and t s. */
double function_value(const struct function *f, const double x[3], double t);
/** The text it was parsed from; NULL for a constant. */
const char *function_text(const struct function *f);

#endif
