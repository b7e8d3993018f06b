/* checkpoint.h5: everything a run needs to go on bitwise. */
#include "run/checkpoint.h"

#include "core/memory.h"
#include "run/fields.h"
#include "run/h5.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { FORMAT = 1, N_WHOLE = 8, N_REAL = 6, SCENE_LIMIT = 1 << 26 };

static const char *const set_name[N_SETS] = {[SET_SOLID] = "points/solid", [SET_WATER] = "points/water"};

/* The same reading or writing for every entry: what to do with one array. */
struct transfer_file {
  struct h5 *h;
  bool       writing;
};

static enum status transfer(const struct transfer_file *f, const char *name, enum h5_type type, long n, void *data)
{
  return f->writing ? h5_write(f->h, name, type, n, 0, data) : h5_read(f->h, name, type, n, 0, data);
}

/* FNV-1a over the bytes: tells apart scenes, not adversaries. */
static enum status hash_scene(const char *folder, long *hash)
{
  char     path[LONGEST_PATH], *text;
  size_t   n;
  uint64_t h = 14695981039346656037u;
  TRY(files_path(folder, "scene.used.json", path));
  TRY(files_read(path, SCENE_LIMIT, &text, &n));
  for (size_t i = 0; i < n; i++) h = (h ^ (unsigned char)text[i]) * 1099511628211u;
  memory_free(&text);
  memcpy(hash, &h, sizeof h);
  return OK;
}

/* ---- parts of the file ---- */

static enum status transfer_numbers(const struct transfer_file *f, struct sim *sim)
{
  struct solver_report *r = &sim->solver;
  long                  whole[N_WHOLE] = {sim->step, sim->n_markers, r->solves,     r->iterations,
                                          r->smg,    r->fallbacks,   r->equilibria, r->equilibrium_steps};
  double real[N_REAL] = {sim->t, sim->dt, sim->dt_limit, r->residual_max, sim->defect_rms_max, sim->defect_max};
  TRY(transfer(f, "sim/whole", H5_LONG, N_WHOLE, whole));
  TRY(transfer(f, "sim/real", H5_DOUBLE, N_REAL, real));
  TRY(transfer(f, "sim/ledger", H5_DOUBLE, N_LEDGER, sim->ledger.v));
  TRY(transfer(f, "sim/ledger_start", H5_DOUBLE, N_LEDGER, sim->ledger_start.v));
  if (f->writing) return OK;
  if (whole[1] != sim->n_markers)
    return FAIL(ERR_INPUT, "%s: %ld markers, but the scene has %d; resume with the scene of the run", f->h->path,
                whole[1], sim->n_markers);
  sim->step = whole[0];
  *r = (struct solver_report){whole[2], whole[3], whole[4], whole[5], whole[6], whole[7], real[3]};
  sim->t = real[0];
  sim->dt = real[1];
  sim->dt_limit = real[2];
  sim->defect_rms_max = real[4];
  sim->defect_max = real[5];
  return OK;
}

/* n, then the order of the points; a set may have lost points since it was created, never gained any. */
static enum status transfer_points(const struct transfer_file *f, const char *set, struct points *p)
{
  char name[NAME_LENGTH];
  long n = p->n;
  snprintf(name, sizeof name, "%s/n", set);
  TRY(transfer(f, name, H5_LONG, 1, &n));
  if (n < 0 || n > p->n)
    return FAIL(ERR_INPUT, "%s: %s is %ld, but the scene makes %ld points; resume with the scene of the run",
                f->h->path, name, n, p->n);
  p->n = n;
  snprintf(name, sizeof name, "%s/group", set);
  TRY(transfer(f, name, H5_BYTE, n, p->group));
  snprintf(name, sizeof name, "%s/start", set);
  return transfer(f, name, H5_LONG, p->n_runs + 1, p->start);
}

static enum status transfer_fields(const struct transfer_file *f, const struct sim *sim)
{
  char              own[3 * NAME_LENGTH], name[5 * NAME_LENGTH];
  struct field_view v;
  for (int cursor = 0; fields_next(sim, &cursor, &v);) {
    if (v.field->kind != STATE) continue;
    fields_copy_name(sim->scene, v.field->name, v.copy, own);
    snprintf(name, sizeof name, "fields/%s/%s", v.module->name, own);
    TRY(transfer(f, name, H5_DOUBLE, fields_length(sim, &v), v.data));
  }
  return OK;
}

static enum status transfer_items(const struct transfer_file *f, int n, const struct checkpoint_item *items)
{
  char name[3 * NAME_LENGTH];
  for (int i = 0; i < n; i++) {
    snprintf(name, sizeof name, "run/%s", items[i].name);
    TRY(transfer(f, name, H5_DOUBLE, items[i].n, items[i].v));
  }
  return OK;
}

static enum status transfer_all(const struct transfer_file *f, struct sim *sim, int n_items,
                                const struct checkpoint_item *items)
{
  TRY(transfer_numbers(f, sim));
  for (int s = 0; s < N_SETS; s++)
    if (sim->points[s]) TRY(transfer_points(f, set_name[s], sim->points[s]));
  TRY(transfer_fields(f, sim));
  return transfer_items(f, n_items, items);
}

/* ---- which scene and which layout the file is of ---- */

static enum status write_identity(struct h5 *h, const char *folder)
{
  long format = FORMAT, hash;
  TRY(hash_scene(folder, &hash));
  TRY(h5_group(h, "mpmice"));
  TRY(h5_set(h, "mpmice", "format", H5_LONG, 1, &format));
  return h5_set(h, "mpmice", "scene_hash", H5_LONG, 1, &hash);
}

static enum status check_identity(struct h5 *h, const char *folder)
{
  long format, hash, wanted;
  TRY(hash_scene(folder, &wanted));
  TRY(h5_get(h, "mpmice", "format", H5_LONG, 1, &format));
  TRY(h5_get(h, "mpmice", "scene_hash", H5_LONG, 1, &hash));
  if (format != FORMAT)
    return FAIL(ERR_INPUT, "%s: format %ld, this program reads %d; run the scene again", h->path, format, FORMAT);
  if (hash != wanted)
    return FAIL(ERR_INPUT, "%s: made with another scene.used.json than the one beside it; put that file back", h->path);
  return OK;
}

/* ---- the whole ---- */

enum status checkpoint_write(const char *folder, const struct sim *sim, int n_items,
                             const struct checkpoint_item *items)
{
  char                 path[LONGEST_PATH];
  struct h5            h;
  struct sim           written = *sim;
  struct transfer_file f = {&h, true};
  TRY(files_path(folder, "checkpoint.h5", path));
  TRY(h5_create(path, &h));
  enum status s = write_identity(&h, folder);
  if (s == OK) s = transfer_all(&f, &written, n_items, items);
  if (s == OK) return h5_commit(&h);
  h5_abandon(&h);
  return s;
}

enum status checkpoint_read(const char *folder, struct sim *sim, int n_items, const struct checkpoint_item *items)
{
  char                 path[LONGEST_PATH];
  struct h5            h;
  struct transfer_file f = {&h, false};
  TRY(files_path(folder, "checkpoint.h5", path));
  if (!files_exists(path)) return FAIL(ERR_INPUT, "%s: no checkpoint to go on from; run the scene instead", path);
  TRY(h5_open(path, &h));
  enum status s = check_identity(&h, folder);
  if (s == OK) s = transfer_all(&f, sim, n_items, items);
  h5_close(&h);
  return s;
}

enum status checkpoint_start(const char *folder, struct sim *sim, int n_items, const struct checkpoint_item *items)
{
  struct sim other = *sim; /* its own numbers; the arrays are the sim's */
  return checkpoint_read(folder, &other, n_items, items);
}
