/* Files of arrays. The only file that knows HDF5. */
#ifndef RUN_H5_H
#define RUN_H5_H

#include "core/status.h"
#include "run/files.h"

#include <stdio.h>

/* An open file; one that is being made is called path.tmp until h5_commit. */
struct h5 {
  long long file;
  char      path[LONGEST_PATH];
};

enum h5_type { H5_DOUBLE, H5_LONG, H5_BYTE };

/** Starts path.tmp. */
enum status h5_create(const char *path, struct h5 *h) MUST_CHECK;
/** Closes it, brings it to the disk and renames it to path. */
enum status h5_commit(struct h5 *h) MUST_CHECK;
/** Closes and removes what h5_create started. */
void h5_abandon(struct h5 *h);
/** Opens a file to read. ERR_INPUT: none, or not HDF5. */
enum status h5_open(const char *path, struct h5 *h) MUST_CHECK;
void        h5_close(struct h5 *h);

/** Array [rows][columns], columns 0: a plain [rows]; groups in the name are made. Whole numbers are compressed. */
enum status h5_write(struct h5 *h, const char *name, enum h5_type type, long rows, long columns,
                     const void *data) MUST_CHECK;
/** Reads an array of exactly rows x columns. ERR_INPUT: none of that name and size. */
enum status h5_read(struct h5 *h, const char *name, enum h5_type type, long rows, long columns, void *data) MUST_CHECK;

/** A group without arrays. */
enum status h5_group(struct h5 *h, const char *name) MUST_CHECK;
/** Attributes of a group or array. Text is of fixed length and has no 0 at its end, as VTK wants it. */
enum status h5_set_text(struct h5 *h, const char *object, const char *name, const char *text) MUST_CHECK;
enum status h5_set(struct h5 *h, const char *object, const char *name, enum h5_type type, long n,
                   const void *data) MUST_CHECK;
enum status h5_get(struct h5 *h, const char *object, const char *name, enum h5_type type, long n,
                   void *data) MUST_CHECK;

/** Every array with its size, unit and meaning, every group with its attributes. */
enum status h5_list(struct h5 *h, FILE *out) MUST_CHECK;

#endif
