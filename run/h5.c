/* Files of arrays. The only file that knows HDF5. */
#include "run/h5.h"

#include <hdf5.h>
#include <stdbool.h>
#include <string.h>
#include <unistd.h>

enum { COMPRESSION = 1, CHUNK = 65536, TEXT_LENGTH = 256 };

static hid_t memory_type(enum h5_type type)
{
  return type == H5_DOUBLE ? H5T_NATIVE_DOUBLE : type == H5_LONG ? H5T_NATIVE_LONG : H5T_NATIVE_UCHAR;
}

static hid_t file_type(enum h5_type type)
{
  return type == H5_DOUBLE ? H5T_IEEE_F64LE : type == H5_LONG ? H5T_STD_I64LE : H5T_STD_U8LE;
}

/* The reason nearest to the system is the first one walking upward; of a long one only what the system said, such as
 * "No space left on device". */
static herr_t take_reason(unsigned n, const H5E_error2_t *error, void *reason)
{
  static const char before[] = "error message = '";
  const char       *desc = error->desc ? error->desc : "unknown", *said = strstr(desc, before);
  if (said) desc = said + strlen(before);
  if (n == 0) snprintf(reason, TEXT_LENGTH, "%.*s", (int)strcspn(desc, "'\n"), desc);
  return 0;
}

static enum status fail(enum status code, const struct h5 *h, const char *what, const char *name)
{
  char reason[TEXT_LENGTH] = "unknown";
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_reason, reason);
  return FAIL(code, "%s: cannot %s %s: %s", h->path, what, name, reason);
}

/* Locking off, or a reader could stop a writer. */
static hid_t access_properties(void)
{
  H5dont_atexit(); /* at exit it would trip over a file that a full disk kept it from closing */
  hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_file_locking(access, false, true);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  return access;
}

static void name_of_made(const struct h5 *h, char made[LONGEST_PATH + 4])
{
  snprintf(made, LONGEST_PATH + 4, "%s.tmp", h->path);
}

enum status h5_create(const char *path, struct h5 *h)
{
  char  made[LONGEST_PATH + 4];
  hid_t access = access_properties();
  snprintf(h->path, sizeof h->path, "%s", path);
  name_of_made(h, made);
  h->file = H5Fcreate(made, H5F_ACC_TRUNC, H5P_DEFAULT, access);
  H5Pclose(access);
  return h->file < 0 ? fail(ERR_ENVIRONMENT, h, "create", "the file") : OK;
}

enum status h5_commit(struct h5 *h)
{
  bool flushed = H5Fflush(h->file, H5F_SCOPE_GLOBAL) >= 0;
  if (!flushed || H5Fclose(h->file) < 0) {
    enum status s = fail(ERR_ENVIRONMENT, h, "write", "the file");
    h5_abandon(h);
    return s;
  }
  h->file = -1;
  return files_commit(h->path);
}

/* On a full disk the file can only be closed after its room is given back. */
void h5_abandon(struct h5 *h)
{
  char made[LONGEST_PATH + 4];
  name_of_made(h, made);
  bool emptied = truncate(made, 0) == 0;
  h5_close(h);
  if (emptied) unlink(made);
}

enum status h5_open(const char *path, struct h5 *h)
{
  hid_t access = access_properties();
  snprintf(h->path, sizeof h->path, "%s", path);
  h->file = H5Fopen(path, H5F_ACC_RDONLY, access);
  H5Pclose(access);
  return h->file < 0 ? fail(ERR_INPUT, h, "open", "the file") : OK;
}

void h5_close(struct h5 *h)
{
  if (h->file >= 0) H5Fclose(h->file);
  h->file = -1;
}

static hid_t space_of(long rows, long columns)
{
  hsize_t dims[2] = {(hsize_t)rows, (hsize_t)columns};
  return H5Screate_simple(columns > 0 ? 2 : 1, dims, NULL);
}

static hid_t create_properties(enum h5_type type, long rows, long columns)
{
  hid_t   create = H5Pcreate(H5P_DATASET_CREATE);
  hsize_t chunk[2] = {(hsize_t)(rows < CHUNK ? rows : CHUNK), (hsize_t)columns};
  if (type != H5_DOUBLE && rows > 1) {
    H5Pset_chunk(create, columns > 0 ? 2 : 1, chunk);
    H5Pset_shuffle(create);
    H5Pset_deflate(create, COMPRESSION);
  }
  return create;
}

static hid_t create_link(void)
{
  hid_t link = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(link, 1);
  return link;
}

enum status h5_write(struct h5 *h, const char *name, enum h5_type type, long rows, long columns, const void *data)
{
  hid_t       link = create_link(), create = create_properties(type, rows, columns), space = space_of(rows, columns);
  hid_t       set = H5Dcreate2(h->file, name, file_type(type), space, link, create, H5P_DEFAULT);
  bool        bad = set < 0 || (rows > 0 && H5Dwrite(set, memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0);
  enum status s = bad ? fail(ERR_ENVIRONMENT, h, "write", name) : OK;
  if (set >= 0 && H5Dclose(set) < 0 && s == OK) s = fail(ERR_ENVIRONMENT, h, "write", name);
  H5Sclose(space);
  H5Pclose(create);
  H5Pclose(link);
  return s;
}

static bool has_size(hid_t set, long rows, long columns)
{
  hsize_t dims[2] = {0, 0};
  hid_t   space = H5Dget_space(set);
  int     rank = H5Sget_simple_extent_ndims(space);
  if (rank == 1 || rank == 2) H5Sget_simple_extent_dims(space, dims, NULL);
  H5Sclose(space);
  return rank == (columns > 0 ? 2 : 1) && dims[0] == (hsize_t)rows && dims[1] == (hsize_t)columns;
}

enum status h5_read(struct h5 *h, const char *name, enum h5_type type, long rows, long columns, void *data)
{
  hid_t set = H5Dopen2(h->file, name, H5P_DEFAULT);
  if (set < 0) return fail(ERR_INPUT, h, "read", name);
  enum status s = OK;
  if (!has_size(set, rows, columns))
    s = FAIL(ERR_INPUT, "%s: %s does not have %ld x %ld values; the file belongs to another scene", h->path, name, rows,
             columns > 0 ? columns : 1);
  else if (rows > 0 && H5Dread(set, memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0)
    s = fail(ERR_INPUT, h, "read", name);
  H5Dclose(set);
  return s;
}

enum status h5_group(struct h5 *h, const char *name)
{
  hid_t link = create_link(), group = H5Gcreate2(h->file, name, link, H5P_DEFAULT, H5P_DEFAULT);
  H5Pclose(link);
  if (group < 0) return fail(ERR_ENVIRONMENT, h, "write", name);
  H5Gclose(group);
  return OK;
}

static enum status set_attribute(struct h5 *h, const char *object, const char *name, hid_t stored, hid_t given,
                                 hid_t space, const void *data)
{
  hid_t       a = H5Acreate_by_name(h->file, object, name, stored, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  bool        bad = a < 0 || H5Awrite(a, given, data) < 0;
  enum status s = bad ? fail(ERR_ENVIRONMENT, h, "write", name) : OK;
  if (a >= 0) H5Aclose(a);
  return s;
}

enum status h5_set_text(struct h5 *h, const char *object, const char *name, const char *text)
{
  hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
  H5Tset_size(type, *text ? strlen(text) : 1);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_ASCII);
  enum status s = set_attribute(h, object, name, type, type, space, text);
  H5Sclose(space);
  H5Tclose(type);
  return s;
}

enum status h5_set(struct h5 *h, const char *object, const char *name, enum h5_type type, long n, const void *data)
{
  hid_t       space = space_of(n, 0);
  enum status s = set_attribute(h, object, name, file_type(type), memory_type(type), space, data);
  H5Sclose(space);
  return s;
}

enum status h5_get(struct h5 *h, const char *object, const char *name, enum h5_type type, long n, void *data)
{
  hid_t a = H5Aopen_by_name(h->file, object, name, H5P_DEFAULT, H5P_DEFAULT);
  if (a < 0) return fail(ERR_INPUT, h, "read", name);
  hid_t       space = H5Aget_space(a);
  bool        bad = H5Sget_simple_extent_npoints(space) != n || H5Aread(a, memory_type(type), data) < 0;
  enum status s = bad ? FAIL(ERR_INPUT, "%s: %s does not have %ld values", h->path, name, n) : OK;
  H5Sclose(space);
  H5Aclose(a);
  return s;
}

/* what h5_list hands to its callbacks */
struct listing {
  FILE *out;
  bool  of_array;
};

static void list_numbers(hid_t a, hid_t type, hssize_t n, FILE *out)
{
  double v[64];
  long   whole[64];
  if (n > 64) {
    fprintf(out, "%lld values", (long long)n);
  } else if (H5Tget_class(type) == H5T_FLOAT && H5Aread(a, H5T_NATIVE_DOUBLE, v) >= 0) {
    for (hssize_t i = 0; i < n; i++) fprintf(out, "%s%.10g", i ? " " : "", v[i]);
  } else if (H5Tget_class(type) == H5T_INTEGER && H5Aread(a, H5T_NATIVE_LONG, whole) >= 0) {
    for (hssize_t i = 0; i < n; i++) fprintf(out, "%s%ld", i ? " " : "", whole[i]);
  }
}

static void list_text(hid_t a, hid_t type, FILE *out)
{
  char text[TEXT_LENGTH] = "";
  if (H5Tis_variable_str(type) > 0 || H5Tget_size(type) >= sizeof text) return;
  if (H5Aread(a, type, text) >= 0) fprintf(out, "%s", text);
}

static herr_t list_attribute(hid_t object, const char *name, const H5A_info_t *info, void *data)
{
  const struct listing *l = data;
  hid_t                 a = H5Aopen(object, name, H5P_DEFAULT), type = H5Aget_type(a), space = H5Aget_space(a);
  (void)info;
  fprintf(l->out, l->of_array ? "  %s: " : "    %s: ", name);
  if (H5Tget_class(type) == H5T_STRING)
    list_text(a, type, l->out);
  else
    list_numbers(a, type, H5Sget_simple_extent_npoints(space), l->out);
  fprintf(l->out, l->of_array ? "" : "\n");
  H5Sclose(space);
  H5Tclose(type);
  H5Aclose(a);
  return 0;
}

static void list_size(hid_t set, FILE *out)
{
  hsize_t dims[H5S_MAX_RANK];
  hid_t   space = H5Dget_space(set), type = H5Dget_type(set);
  int     rank = H5Sget_simple_extent_dims(space, dims, NULL);
  fprintf(out, " %s", H5Tget_class(type) == H5T_FLOAT ? "real" : "whole");
  for (int i = 0; i < rank; i++) fprintf(out, "%s%llu", i ? " x " : " ", (unsigned long long)dims[i]);
  H5Tclose(type);
  H5Sclose(space);
}

static herr_t list_object(hid_t root, const char *name, const H5O_info_t *info, void *data)
{
  struct listing *l = data;
  if (strcmp(name, ".") == 0) return 0;
  hid_t object = H5Oopen(root, name, H5P_DEFAULT);
  l->of_array = info->type == H5O_TYPE_DATASET;
  fprintf(l->out, "%s%s%s", l->of_array ? "  " : "", name, l->of_array ? ":" : "/\n");
  if (l->of_array) list_size(object, l->out);
  H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, NULL, list_attribute, l);
  if (l->of_array) fprintf(l->out, "\n");
  H5Oclose(object);
  return 0;
}

enum status h5_list(struct h5 *h, FILE *out)
{
  struct listing l = {.out = out};
  if (H5Ovisit2(h->file, H5_INDEX_NAME, H5_ITER_INC, list_object, &l, H5O_INFO_BASIC) < 0)
    return fail(ERR_INPUT, h, "list", "the file");
  return OK;
}
