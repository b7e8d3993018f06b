/* The program: the only place that prints errors and exits. */
#include "run/arguments.h"

#include <stdio.h>
#include <string.h>

static enum status run_verb(int n, char *const words[])
{
  const struct verb *verb;
  struct run_options options;
  bool               help;
  TRY(arguments_find_verb(words[0], &verb));
  TRY(arguments_read(verb, n - 1, words + 1, &options, &help));
  if (!help) return verb->run(&options);
  arguments_help(verb, stdout);
  return OK;
}

/** Output that did not reach the disk or pipe is a failure too. */
static enum status flush_output(enum status status)
{
  if (fflush(stdout) == 0 && !ferror(stdout)) return status;
  return status == OK ? FAIL(ERR_ENVIRONMENT, "standard output cannot be written; make room for it") : status;
}

int main(int argc, char *argv[])
{
  const char *first = argc > 1 ? argv[1] : "--help";
  enum status status = OK;
  if (strcmp(first, "--version") == 0)
    printf("mpmice %s\n", MPMICE_VERSION);
  else if (strcmp(first, "--help") == 0 || strcmp(first, "help") == 0)
    arguments_help_all(stdout);
  else
    status = run_verb(argc - 1, argv + 1);
  status = flush_output(status);
  if (status != OK && *status_message()) fprintf(stderr, "mpmice: %s\n", status_message());
  return status_exit(status);
}
