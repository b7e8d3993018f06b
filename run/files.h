/* Small files as a whole: read at once, replaced at once. */
#ifndef RUN_FILES_H
#define RUN_FILES_H

#include "core/status.h"

#include <stddef.h>

enum { LONGEST_PATH = 1024 };

/** folder/name into path. ERR_INPUT: too long. */
enum status files_path(const char *folder, const char *name, char path[LONGEST_PATH]) MUST_CHECK;
/** The whole file, with a 0 after it; memory_free it. ERR_INPUT: not readable, or longer than limit bytes. */
enum status files_read(const char *path, size_t limit, char **text, size_t *n) MUST_CHECK;
/** Writes path.tmp, brings it to the disk and renames it: the file is the old one or the new one, never a part. */
enum status files_replace(const char *path, const char *text, size_t n) MUST_CHECK;
/** Second half of that for a path.tmp written by others: to the disk, then renamed to path. */
enum status files_commit(const char *path) MUST_CHECK;
/** Removes the files of a folder whose names match a pattern of the shell; none is no error. */
void files_remove(const char *folder, const char *pattern);
/** A readable regular file? */
int files_exists(const char *path);

#endif
