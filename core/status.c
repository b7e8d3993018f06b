/* The last error message, the only mutable global of the program. */
#include "core/status.h"

#include <stdarg.h>
#include <stdio.h>

static char message[1024];

enum status status_fail(enum status code, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  vsnprintf(message, sizeof message, format, args);
  va_end(args);
  return code;
}

const char *status_message(void) { return message; }

int status_exit(enum status code)
{
  static const int exit_status[] = {
#define STATUS(name, value, meaning) [name] = value,
#include "core/status.def"
#undef STATUS
  };
  return exit_status[code];
}
