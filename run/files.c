/* Small files as a whole: read at once, replaced at once. */
#include "run/files.h"

#include "core/memory.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <fnmatch.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum status files_path(const char *folder, const char *name, char path[LONGEST_PATH])
{
  /* room for the ".tmp" of a file in the making */
  if (snprintf(path, LONGEST_PATH, "%s/%s", folder, name) >= LONGEST_PATH - 4)
    return FAIL(ERR_INPUT, "%.40s...: the path is longer than %d characters; choose a shorter output folder", folder,
                LONGEST_PATH - 5);
  return OK;
}

int files_exists(const char *path)
{
  struct stat s;
  return stat(path, &s) == 0 && S_ISREG(s.st_mode);
}

static enum status read_open(FILE *file, const char *path, size_t limit, char **text, size_t *n)
{
  struct stat s;
  if (fstat(fileno(file), &s) != 0 || !S_ISREG(s.st_mode)) return FAIL(ERR_INPUT, "%s: not a regular file", path);
  if ((size_t)s.st_size > limit)
    return FAIL(ERR_INPUT, "%s: %zu bytes are more than the %zu allowed", path, (size_t)s.st_size, limit);
  TRY(NEW(text, s.st_size + 1));
  *n = fread(*text, 1, (size_t)s.st_size, file);
  if (*n == (size_t)s.st_size) return OK;
  memory_free(text);
  return FAIL(ERR_INPUT, "%s: cannot be read: %s", path, strerror(errno));
}

enum status files_read(const char *path, size_t limit, char **text, size_t *n)
{
  FILE *file = fopen(path, "rb");
  *text = NULL;
  if (!file) return FAIL(ERR_INPUT, "%s: cannot be opened: %s", path, strerror(errno));
  enum status s = read_open(file, path, limit, text, n);
  fclose(file);
  return s;
}

static enum status write_failed(const char *path)
{
  return FAIL(ERR_ENVIRONMENT, "%s: cannot be written: %s", path, strerror(errno));
}

enum status files_commit(const char *path)
{
  char made[LONGEST_PATH];
  snprintf(made, sizeof made, "%s.tmp", path);
  int fd = open(made, O_RDONLY);
  if (fd < 0) return write_failed(path);
  int synced = fsync(fd);
  close(fd);
  if (synced != 0 || rename(made, path) != 0) return write_failed(path);
  return OK;
}

enum status files_replace(const char *path, const char *text, size_t n)
{
  char made[LONGEST_PATH];
  snprintf(made, sizeof made, "%s.tmp", path);
  FILE *file = fopen(made, "wb");
  if (!file) return write_failed(path);
  size_t written = fwrite(text, 1, n, file);
  if (fclose(file) != 0 || written != n) {
    enum status s = write_failed(path);
    unlink(made);
    return s;
  }
  return files_commit(path);
}

void files_remove(const char *folder, const char *pattern)
{
  char           path[LONGEST_PATH];
  DIR           *directory = opendir(folder);
  struct dirent *entry;
  while (directory && (entry = readdir(directory)))
    if (fnmatch(pattern, entry->d_name, 0) == 0 && files_path(folder, entry->d_name, path) == OK) remove(path);
  if (directory) closedir(directory);
}
