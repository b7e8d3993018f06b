/* Starting a script of report/. */
#include "run/scripts.h"

#include "run/files.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* The script in the source tree, or where it was installed. */
static enum status find_script(const char *name, char path[LONGEST_PATH])
{
  TRY(files_path(MPMICE_SOURCE_DIR "/report", name, path));
  if (files_exists(path)) return OK;
  TRY(files_path(MPMICE_DATA_DIR "/report", name, path));
  return files_exists(path) ? OK : FAIL(ERR_ENVIRONMENT, "%s: not found; install mpmice again", path);
}

/* Debian's own Python sees h5py and matplotlib; elsewhere the first of the path. */
static void become(const char *script, const char *folder)
{
  const char *python = access("/usr/bin/python3", X_OK) == 0 ? "/usr/bin/python3" : "python3";
  execlp(python, python, script, folder, (char *)NULL);
  fprintf(stderr, "mpmice: %s: cannot be started: %s\n", python, strerror(errno));
  _exit(127);
}

enum status script_run(const char *name, const char *folder)
{
  char script[LONGEST_PATH];
  int  how = 0;
  TRY(find_script(name, script));
  fflush(stdout);
  pid_t child = fork();
  if (child < 0) return FAIL(ERR_ENVIRONMENT, "%s: cannot start a process: %s", name, strerror(errno));
  if (child == 0) become(script, folder);
  if (waitpid(child, &how, 0) < 0 || !WIFEXITED(how)) return FAIL(ERR_ENVIRONMENT, "%s did not finish", script);
  if (WEXITSTATUS(how) == 0) return OK;
  return FAIL(WEXITSTATUS(how) == 2 ? ERR_INPUT : ERR_ENVIRONMENT, "%s made nothing of %s; see above", name, folder);
}
