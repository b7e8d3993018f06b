/* Expressions of place and time: parsed once into a postfix program, evaluated on a small stack. Tables over time. */
#include "core/function.h"

#include "core/memory.h"

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* values on the stack at once, nested brackets, and characters shown of a wrong text */
enum { STACK = 32, NESTING = 64, SHOWN = 200 };

enum code {
  CODE_NUMBER,
  CODE_X,
  CODE_Y,
  CODE_Z,
  CODE_T,
  CODE_ADD,
  CODE_SUB,
  CODE_MUL,
  CODE_DIV,
  CODE_POW,
  CODE_NEG,
  CODE_MIN,
  CODE_MAX,
  CODE_ABS,
  CODE_SQRT,
  CODE_EXP,
  CODE_LOG,
  CODE_SIN,
  CODE_COS,
  CODE_TAN,
  CODE_TANH,
  CODE_FLOOR,
  CODE_STEP
};

struct op {
  enum code code;
  double    value; /* CODE_NUMBER */
};

struct expression {
  char      *text;
  struct op *ops;
  int        n;
  int        rows; /* of a table, which has no program */
  double    *t, *v;
};

struct word {
  const char *name;
  enum code   code;
};

static const struct word variables[] = {{"x", CODE_X}, {"y", CODE_Y}, {"z", CODE_Z}, {"t", CODE_T}};
static const struct word calls[] = {{"min", CODE_MIN}, {"max", CODE_MAX},   {"abs", CODE_ABS},     {"sqrt", CODE_SQRT},
                                    {"exp", CODE_EXP}, {"log", CODE_LOG},   {"sin", CODE_SIN},     {"cos", CODE_COS},
                                    {"tan", CODE_TAN}, {"tanh", CODE_TANH}, {"floor", CODE_FLOOR}, {"step", CODE_STEP}};
enum { N_VARIABLES = sizeof variables / sizeof *variables, N_CALLS = sizeof calls / sizeof *calls };

struct parser {
  const char *text, *at;
  struct op  *ops; /* as many as the text has characters: no character makes more than one */
  int         n, height, nesting;
  bool        varies; /* a variable occurs */
};

static enum status parse_sum(struct parser *p);

static double apply(enum code code, double a, double b)
{
  switch (code) {
  case CODE_ADD:
    return a + b;
  case CODE_SUB:
    return a - b;
  case CODE_MUL:
    return a * b;
  case CODE_DIV:
    return a / b;
  case CODE_POW:
    return pow(a, b);
  case CODE_MIN:
    return a < b ? a : b;
  default:
    return a > b ? a : b;
  }
}

static double apply_one(enum code code, double a)
{
  switch (code) {
  case CODE_NEG:
    return -a;
  case CODE_ABS:
    return fabs(a);
  case CODE_SQRT:
    return sqrt(a);
  case CODE_EXP:
    return exp(a);
  case CODE_LOG:
    return log(a);
  case CODE_SIN:
    return sin(a);
  case CODE_COS:
    return cos(a);
  case CODE_TAN:
    return tan(a);
  case CODE_TANH:
    return tanh(a);
  case CODE_FLOOR:
    return floor(a);
  default:
    return a >= 0 ? 1 : 0;
  }
}

static bool is_operand(enum code code) { return code <= CODE_T; }
static bool is_binary(enum code code) { return code >= CODE_ADD && code <= CODE_MAX && code != CODE_NEG; }

/** Value of n operations; the parser has bounded the stack. */
static double evaluate(const struct op *ops, int n, const double x[3], double t)
{
  double stack[STACK] = {0};
  int    top = -1;
  for (int i = 0; i < n; i++) {
    enum code code = ops[i].code;
    if (is_operand(code)) {
      stack[++top] = code == CODE_NUMBER ? ops[i].value : code == CODE_T ? t : x[code - CODE_X];
    } else if (is_binary(code)) {
      top--;
      stack[top] = apply(code, stack[top], stack[top + 1]);
    } else {
      stack[top] = apply_one(code, stack[top]);
    }
  }
  return stack[0];
}

static void skip_space(struct parser *p)
{
  while (isspace((unsigned char)*p->at)) p->at++;
}

static enum status fail_at(const struct parser *p, const char *expected)
{
  int column = (int)(p->at - p->text) + 1;
  if (*p->at == '\0')
    return FAIL(ERR_INPUT, "expression \"%.*s\" ends at column %d; expected %s", SHOWN, p->text, column, expected);
  return FAIL(ERR_INPUT, "expression \"%.*s\", column %d: found '%c'; expected %s", SHOWN, p->text, column, *p->at,
              expected);
}

static enum status emit(struct parser *p, enum code code, double value)
{
  p->ops[p->n++] = (struct op){code, value};
  if (is_operand(code)) p->height++;
  if (is_binary(code)) p->height--;
  if (p->height > STACK) return fail_at(p, "fewer nested terms");
  return OK;
}

static enum status expect(struct parser *p, char c, const char *expected)
{
  skip_space(p);
  if (*p->at != c) return fail_at(p, expected);
  p->at++;
  return OK;
}

/** Length of a decimal number at s: strtod alone would take hexadecimal, "inf" and "nan" too. */
static size_t number_length(const char *s)
{
  size_t n = strspn(s, "0123456789");
  size_t digits = n;
  if (s[n] == '.') {
    size_t fraction = strspn(s + n + 1, "0123456789");
    digits += fraction;
    n += 1 + fraction;
  }
  if (digits == 0) return 0;
  if (s[n] == 'e' || s[n] == 'E') {
    size_t sign = s[n + 1] == '+' || s[n + 1] == '-';
    size_t exponent = strspn(s + n + 1 + sign, "0123456789");
    if (exponent > 0) n += 1 + sign + exponent;
  }
  return n;
}

static enum status parse_number(struct parser *p, size_t length)
{
  double value = strtod(p->at, NULL);
  if (!isfinite(value)) return fail_at(p, "a number that a double can hold");
  p->at += length;
  return emit(p, CODE_NUMBER, value);
}

static const struct word *find_word(const struct word *words, int n, const char *name, size_t length)
{
  for (int i = 0; i < n; i++)
    if (strlen(words[i].name) == length && strncmp(words[i].name, name, length) == 0) return &words[i];
  return NULL;
}

static enum status parse_call(struct parser *p, enum code code)
{
  int  arguments = 1;
  bool pair = code == CODE_MIN || code == CODE_MAX;
  TRY(expect(p, '(', "\"(\" after the name of a function"));
  TRY(parse_sum(p));
  if (!pair) {
    TRY(expect(p, ')', "\")\""));
    return emit(p, code, 0);
  }
  for (skip_space(p); *p->at == ','; skip_space(p)) {
    p->at++;
    TRY(parse_sum(p));
    TRY(emit(p, code, 0));
    arguments++;
  }
  if (arguments < 2) return fail_at(p, "\",\" and a second argument of min or max");
  return expect(p, ')', "\",\" or \")\"");
}

static enum status parse_name(struct parser *p)
{
  const char *start = p->at;
  size_t      length = 0;
  while (isalnum((unsigned char)start[length]) || start[length] == '_') length++;
  const struct word *variable = find_word(variables, N_VARIABLES, start, length);
  const struct word *call = find_word(calls, N_CALLS, start, length);
  bool               is_pi = length == 2 && strncmp(start, "pi", 2) == 0;
  if (!variable && !call && !is_pi)
    return fail_at(p, "x, y, z, t, pi, or min max abs sqrt exp log sin cos tan tanh floor step");
  p->at += length;
  if (call) return parse_call(p, call->code);
  if (is_pi) return emit(p, CODE_NUMBER, acos(-1.0));
  p->varies = true;
  return emit(p, variable->code, 0);
}

static enum status parse_primary(struct parser *p)
{
  skip_space(p);
  size_t length = number_length(p->at);
  if (length > 0) return parse_number(p, length);
  if (isalpha((unsigned char)*p->at)) return parse_name(p);
  if (*p->at != '(') return fail_at(p, "a number, x, y, z, t, pi, a function or \"(\"");
  p->at++;
  TRY(parse_sum(p));
  return expect(p, ')', "an operator or \")\"");
}

static enum status parse_signed(struct parser *p);

/** a ^ b: binds tighter than a sign before it, and to the right. */
static enum status parse_power(struct parser *p)
{
  TRY(parse_primary(p));
  skip_space(p);
  if (*p->at != '^') return OK;
  p->at++;
  TRY(parse_signed(p));
  return emit(p, CODE_POW, 0);
}

static enum status parse_signed(struct parser *p)
{
  if (++p->nesting > NESTING) return fail_at(p, "fewer nested brackets and signs");
  skip_space(p);
  bool negative = *p->at == '-';
  if (negative || *p->at == '+') {
    p->at++;
    TRY(parse_signed(p));
  } else {
    TRY(parse_power(p));
  }
  p->nesting--;
  return negative ? emit(p, CODE_NEG, 0) : OK;
}

static enum status parse_product(struct parser *p)
{
  TRY(parse_signed(p));
  for (skip_space(p); *p->at == '*' || *p->at == '/'; skip_space(p)) {
    enum code code = *p->at++ == '*' ? CODE_MUL : CODE_DIV;
    TRY(parse_signed(p));
    TRY(emit(p, code, 0));
  }
  return OK;
}

static enum status parse_sum(struct parser *p)
{
  TRY(parse_product(p));
  for (skip_space(p); *p->at == '+' || *p->at == '-'; skip_space(p)) {
    enum code code = *p->at++ == '+' ? CODE_ADD : CODE_SUB;
    TRY(parse_product(p));
    TRY(emit(p, code, 0));
  }
  return OK;
}

static enum status parse_all(struct parser *p)
{
  TRY(parse_sum(p));
  skip_space(p);
  if (*p->at != '\0') return fail_at(p, "an operator or the end");
  return OK;
}

/** A constant keeps its value only; what varies keeps text and program. */
static enum status keep(const struct parser *p, struct function *f)
{
  const double origin[3] = {0, 0, 0};
  if (!p->varies) {
    f->constant = evaluate(p->ops, p->n, origin, 0);
    if (!isfinite(f->constant))
      return FAIL(ERR_INPUT, "expression \"%.*s\" is not finite; expected a number", SHOWN, p->text);
    return OK;
  }
  TRY(NEW(&f->expression, 1));
  TRY(NEW(&f->expression->ops, p->n));
  TRY(NEW(&f->expression->text, strlen(p->text) + 1));
  memcpy(f->expression->ops, p->ops, (size_t)p->n * sizeof *p->ops);
  memcpy(f->expression->text, p->text, strlen(p->text) + 1);
  f->expression->n = p->n;
  return OK;
}

enum status function_parse(const char *text, struct function *f)
{
  struct parser p = {.text = text, .at = text};
  *f = (struct function){0, NULL};
  TRY(NEW(&p.ops, strlen(text) + 1));
  enum status status = parse_all(&p);
  if (status == OK) status = keep(&p, f);
  memory_free(&p.ops);
  if (status != OK) function_destroy(f);
  return status;
}

static enum status fill_table(int n, const double *t, const double *v, struct expression *e)
{
  TRY(NEW(&e->t, n));
  TRY(NEW(&e->v, n));
  memcpy(e->t, t, (size_t)n * sizeof *t);
  memcpy(e->v, v, (size_t)n * sizeof *v);
  e->rows = n;
  return OK;
}

enum status function_table(int n, const double *t, const double *v, struct function *f)
{
  *f = (struct function){0, NULL};
  TRY(NEW(&f->expression, 1));
  enum status status = fill_table(n, t, v, f->expression);
  if (status != OK) function_destroy(f);
  return status;
}

/** The row is found by halving. */
static double table_value(const struct expression *e, double t)
{
  int low = 0, high = e->rows - 1;
  if (t <= e->t[low]) return e->v[low];
  if (t >= e->t[high]) return e->v[high];
  while (high - low > 1) {
    int middle = (low + high) / 2;
    *(e->t[middle] <= t ? &low : &high) = middle;
  }
  double part = (t - e->t[low]) / (e->t[high] - e->t[low]);
  return e->v[low] + part * (e->v[high] - e->v[low]);
}

void function_destroy(struct function *f)
{
  if (f->expression) {
    memory_free(&f->expression->ops);
    memory_free(&f->expression->text);
    memory_free(&f->expression->t);
    memory_free(&f->expression->v);
  }
  memory_free(&f->expression);
  f->constant = 0;
}

double function_value(const struct function *f, const double x[3], double t)
{
  if (!f->expression) return f->constant;
  if (f->expression->rows > 0) return table_value(f->expression, t);
  return evaluate(f->expression->ops, f->expression->n, x, t);
}

bool function_varies_in_space(const struct function *f)
{
  for (int i = 0; f->expression && i < f->expression->n; i++)
    if (f->expression->ops[i].code >= CODE_X && f->expression->ops[i].code <= CODE_Z) return true;
  return false;
}

int function_rows(const struct function *f, const double **t, const double **v)
{
  if (!f->expression || f->expression->rows == 0) return 0;
  *t = f->expression->t;
  *v = f->expression->v;
  return f->expression->rows;
}

const char *function_text(const struct function *f) { return f->expression ? f->expression->text : NULL; }
