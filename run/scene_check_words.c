/* Whether gauges and metrics speak of quantities that this scene has. */
#include "core/ledger.h"
#include "run/fields.h"
#include "run/plan.h"
#include "run/scene_check.h"

#include <stdio.h>
#include <string.h>

enum { WORD = 5 * NAME_LENGTH, MOST = 256 };

/* Names of what may be asked for, with room for them. */
struct words {
  struct names names;
  char         text[MOST][WORD];
};

static void add_word(struct words *words, const char *set, const char *name, const char *suffix)
{
  int n = words->names.n;
  if (n == MOST) return;
  snprintf(words->text[n], WORD, "%s%s%s%s%s", set, *set ? "." : "", name, *suffix ? "_" : "", suffix);
  names_add(&words->names, words->text[n]);
}

static bool takes_part(const struct scene *scene, const struct module *m)
{
  if (m->is_fluid_path) return scene->fluid.present && scene->fluid.path == m;
  return !m->needed || m->needed(scene);
}

static void add_copy(const struct scene *scene, struct words *words, bool with_set, const struct field *f, int copy)
{
  char name[3 * NAME_LENGTH];
  fields_copy_name(scene, f->output, copy, name);
  for (int c = 0; c < field_components(f, scene); c++)
    add_word(words, with_set ? fields_set(f->at) : "", name, fields_suffix(f, scene, c));
}

/** Every component of every written field, as "P", "vel_x", and as "solid.vel_x". */
static void add_fields(const struct scene *scene, struct words *words, bool with_set)
{
  for (int i = 0; all_modules[i]; i++)
    for (int k = 0; takes_part(scene, all_modules[i]) && k < all_modules[i]->n_fields; k++) {
      const struct field *f = &all_modules[i]->fields[k];
      if (!f->output || !fields_set(f->at)) continue;
      for (int copy = 0; copy < field_copies(f, scene); copy++) add_copy(scene, words, with_set, f, copy);
    }
}

static void add_ledger(struct words *words)
{
  static const char *const entries[] = {
#define LEDGER(name, unit, meaning) #name,
#include "core/ledger.def"
#undef LEDGER
  };
  for (int i = 0; i < N_LEDGER; i++) add_word(words, "", entries[i], "");
  add_word(words, "", "energy", "");
  add_word(words, "", "balance", "");
  add_word(words, "", "released", "");
}

static void add_marker(const struct scene *scene, struct words *words)
{
  static const char *const axes[] = {"x", "y", "z"};
  for (int d = 0; d < scene->dim; d++) {
    add_word(words, "", "displacement", axes[d]);
    add_word(words, "", "position", axes[d]);
  }
  add_word(words, "", "distance", "");
}

static void add_wall(const struct scene *scene, const char *on, struct words *words)
{
  static const char *const axes[] = {"x", "y", "z"}, *const quantities[] = {"force", "impulse", "displacement"};
  bool obstacle = false;
  for (int i = 0; i < scene->n_obstacles; i++) obstacle = obstacle || strcmp(scene->obstacles[i].name, on) == 0;
  for (int q = 0; q < (obstacle ? 3 : 2); q++)
    for (int d = 0; d < scene->dim; d++) add_word(words, "", quantities[q], axes[d]);
  if (!obstacle && fluid_has_energy(&scene->fluid)) names_add(&words->names, "heat");
}

static void add_axes(const struct scene *scene, struct words *words)
{
  static const char *const axes[] = {"x", "y", "z"};
  for (int d = 0; d < scene->dim; d++) add_word(words, "", axes[d], "");
}

static void add_ends(const struct scene *scene, struct words *words)
{
  static const char *const ends[] = {"x", "y", "z"};
  for (int d = 0; d < scene->dim; d++) {
    add_word(words, "", ends[d], "max");
    add_word(words, "", ends[d], "min");
  }
}

static enum status check_word(struct reader *reader, const char *word, const struct words *words,
                              const struct words *more)
{
  for (int i = 0; i < words->names.n; i++)
    if (strcmp(words->names.name[i], word) == 0) return OK;
  for (int i = 0; more && i < more->names.n; i++)
    if (strcmp(more->names.name[i], word) == 0) return OK;
  return reader_unknown(reader, "quantity", word, &words->names);
}

static enum status check_gauge(struct reader *reader, const struct scene *scene, const struct gauge *g)
{
  struct words words = {0}, with_set = {0};
  bool         marker = g->kind == GAUGE_TRACER || g->kind == GAUGE_LOAD, wall = g->kind == GAUGE_WALL;
  snprintf(reader->path, sizeof reader->path, "gauges.%s.of", g->name);
  if (marker) add_marker(scene, &words);
  if (wall) add_wall(scene, g->on, &words);
  bool level = g->kind == GAUGE_LEVEL || g->kind == GAUGE_LEVELS;
  if (g->kind == GAUGE_EXTENT) add_ends(scene, &words);
  if (level) add_axes(scene, &words);
  if (!marker && !wall && !level && g->kind != GAUGE_EXTENT) {
    add_fields(scene, &words, false);
    add_fields(scene, &with_set, true);
  }
  if (g->kind == GAUGE_INTEGRAL) add_ledger(&words);
  return check_word(reader, g->of, &words, &with_set);
}

static enum status check_metric(struct reader *reader, const struct scene *scene, const struct metric *m)
{
  struct words words = {0}, with_set = {0};
  snprintf(reader->path, sizeof reader->path, "metrics.%s.field", m->name);
  add_fields(scene, &words, false);
  add_fields(scene, &with_set, true);
  return *m->field ? check_word(reader, m->field, &words, &with_set) : OK;
}

enum status scene_check_words(struct reader *reader, const struct scene *scene)
{
  for (int i = 0; i < scene->n_gauges; i++) TRY(check_gauge(reader, scene, &scene->gauges[i]));
  for (int i = 0; i < scene->n_metrics; i++) TRY(check_metric(reader, scene, &scene->metrics[i]));
  return OK;
}
