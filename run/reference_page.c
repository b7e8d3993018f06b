/* The reference of every parameter of a scene, from its tables: `mpmice list`, docs/parameters.md. */
#include "core/scene.h"
#include "run/plan.h"
#include "run/scene_tables.h"
#include "run/schema.h"

#include <string.h>

enum { CELL = 400 };

struct page {
  FILE *out;
  bool  markdown;
};

static void print_heading(const struct page *page, const char *path, const char *meaning)
{
  fprintf(page->out, page->markdown ? "\n## %s\n\n%s\n\n" : "\n%s: %s\n", *path ? path : "scene", meaning);
  if (page->markdown)
    fprintf(page->out, "| key | value | unit | range | default | meaning |\n|---|---|---|---|---|---|\n");
}

/** Copies text and keeps | out of a Markdown table. */
static void escape(const struct page *page, const char *text, char cell[CELL])
{
  size_t n = 0;
  for (const char *c = text; *c && n + 2 < CELL; c++) {
    if (*c == '|' && page->markdown) cell[n++] = '\\';
    cell[n++] = *c;
  }
  cell[n] = '\0';
}

static void print_row(const struct page *page, const char *key, const char *value, const char *unit, const char *range,
                      const char *fallback, const char *meaning)
{
  char cells[2][CELL];
  escape(page, value, cells[0]);
  escape(page, meaning, cells[1]);
  const char *given = fallback ? (*fallback ? fallback : "empty") : "required";
  bool        has_unit = unit && strcmp(unit, "-") != 0;
  if (page->markdown)
    fprintf(page->out, "| `%s` | %s | %s | %s | %s | %s |\n", key, cells[0], unit ? unit : "-", range, given, cells[1]);
  else
    fprintf(page->out, "  %-20s %s%s%s%s%s; %s%s; %s\n", key, cells[0], *range ? " " : "", range, has_unit ? " " : "",
            has_unit ? unit : "", fallback ? "default " : "", given, cells[1]);
}

static const char *type_name(const struct param *p)
{
  switch (p->type) {
  case PARAM_NUMBER:
    return "number";
  case PARAM_INTEGER:
    return "whole number";
  case PARAM_FLAG:
    return "true or false";
  case PARAM_TEXT:
    return "text";
  case PARAM_VECTOR:
    return "number per axis";
  case PARAM_FUNCTION:
    return "number or expression";
  case PARAM_FUNCTION3:
    return "number or expression per axis";
  default:
    return p->words;
  }
}

static void print_param(const struct page *page, const struct param *p)
{
  char range[96] = "";
  bool ranged = p->type == PARAM_NUMBER || p->type == PARAM_INTEGER || p->type == PARAM_VECTOR;
  if (ranged) snprintf(range, sizeof range, "[%.4g, %.4g]", p->min, p->max);
  print_row(page, p->name, type_name(p), p->unit, range, p->fallback, p->meaning);
}

static void print_table(const struct page *page, const struct param *table, const char *const *skip)
{
  for (const struct param *p = table; p && p->name; p++) {
    bool given = false;
    for (int i = 0; skip && skip[i]; i += 2) given = given || strcmp(skip[i], p->name) == 0;
    if (!given) print_param(page, p);
  }
}

static void print_words(const struct page *page, const struct choice *choice)
{
  char       words[CELL] = "";
  size_t     n = 0;
  struct row row;
  for (int i = 0; choice->row(i, &row) && n < sizeof words; i++)
    n += (size_t)snprintf(words + n, sizeof words - n, "%s%s", i ? "|" : "", row.name);
  print_row(page, choice->key, words, "-", "", choice->fallback, choice->meaning);
}

static void print_entry(const struct page *page, const struct entry *e)
{
  char fallback[64], meaning[CELL];
  snprintf(meaning, sizeof meaning, "%s%s%s%s", e->meaning, e->only ? "; with " : "", e->only ? e->only : "",
           e->only_3d ? "; 3D only" : "");
  snprintf(fallback, sizeof fallback, e->fallback3 ? "%s, in 3D %s" : "%s", e->fallback ? e->fallback : "",
           e->fallback3 ? e->fallback3 : "");
  print_row(page, e->name, e->value->name, e->unit, "", e->fallback ? fallback : NULL, meaning);
}

static void print_section(const struct page *page, const char *path, const struct section *section);

static void print_inner(const struct page *page, const char *path, const struct section *section)
{
  for (const struct entry *e = section->entries; e && e->name; e++) {
    char inner[256];
    if (e->kind == ENTRY_VALUE) continue;
    snprintf(inner, sizeof inner, "%s%s%s%s", path, *path ? "." : "", e->name, e->kind == ENTRY_MAP ? ".<name>" : "");
    print_section(page, inner, e->section);
  }
}

/** A heading and table for every law with parameters of its own. */
static void print_rows(const struct page *page, const char *path, const struct choice *choice)
{
  struct row row;
  for (int i = 0; choice->row(i, &row); i++) {
    char heading[320], meaning[200];
    snprintf(heading, sizeof heading, "%s, %s \"%s\"", path, choice->key, row.name);
    snprintf(meaning, sizeof meaning, "beside the keys above%s%s%s%s", row.source ? "; " : "",
             row.source ? choice->document : "", row.source ? ": " : "", row.source ? row.source : "");
    if (!row.params || !row.params->name) continue;
    print_heading(page, heading, meaning);
    print_table(page, row.params, choice->given);
  }
}

static void print_modules(const struct page *page, const char *path)
{
  for (int i = 0; all_modules[i]; i++) {
    char                 inner[256];
    const struct section section = {.meaning = "choices of this module", .params = all_modules[i]->params};
    snprintf(inner, sizeof inner, "%s.%s", path, all_modules[i]->name);
    if (section.params && section.params->name) print_section(page, inner, &section);
  }
}

static void print_section(const struct page *page, const char *path, const struct section *section)
{
  print_heading(page, path, section->meaning);
  if (section->choice) print_words(page, section->choice);
  print_table(page, section->params, NULL);
  for (const struct entry *e = section->entries; e && e->name; e++)
    if (e->kind == ENTRY_VALUE) print_entry(page, e);
  if (section->choice) print_rows(page, path, section->choice);
  print_inner(page, path, section);
  if (section->modules) print_modules(page, path);
}

static void print_shapes(const struct page *page)
{
  print_heading(page, "shapes", "a shape is \"everywhere\" or an object with one of these keys");
  for (const struct shape_word *w = shape_words; w->name; w++)
    print_row(page, w->name, w->params ? "object" : "list", "-", "", "", w->meaning);
  for (const struct shape_word *w = shape_words; w->name; w++) {
    if (!w->params) continue;
    print_heading(page, w->name, w->meaning);
    print_table(page, w->params, NULL);
  }
}

void reference_print(FILE *out, bool markdown)
{
  const struct page page = {out, markdown};
  if (markdown)
    fprintf(out,
            "# Parameters of a scene\n\nMade by `mpmice list --markdown` from the tables that read a scene. A number "
            "per axis is a list of two or three; keys that start with `//` are comments; expressions know x, y, z, t, "
            "pi, + - * / ^ and min max abs sqrt exp log sin cos tan tanh floor step.\n");
  print_section(&page, "", &scene_section);
  print_shapes(&page);
}
