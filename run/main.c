/* The program: the only place that prints errors and exits. */
#include "run/arguments.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

/** Threads that wait shall sleep, not spin: on shared cores spinning costs 20 times the run. OpenMP reads this before
 *  main, so the program starts once more; should that fail, it goes on as it is. */
static void start_with_patient_threads(char *argv[])
{
  char    path[PATH_MAX];
  ssize_t n = getenv("OMP_WAIT_POLICY") ? -1 : readlink("/proc/self/exe", path, sizeof path - 1);
  if (n <= 0 || setenv("OMP_WAIT_POLICY", "passive", 1)) return;
  path[n] = '\0';
  execv(path, argv);
}

int main(int argc, char *argv[])
{
  start_with_patient_threads(argv);
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
