/* From the SCENE of a command line to a file. */
#include "run/scene_find.h"

#include <dirent.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/** Folder of the running program; false: unknown. */
static bool program_folder(char folder[LONGEST_PATH])
{
  ssize_t n = readlink("/proc/self/exe", folder, LONGEST_PATH - 1);
  if (n <= 0) return false;
  folder[n] = '\0';
  char *slash = strrchr(folder, '/');
  if (slash) *slash = '\0';
  return slash != NULL;
}

bool scene_cases_folder(int i, char folder[LONGEST_PATH])
{
  static const char *const beside[] = {"../cases", "../share/mpmice/cases"};
  const char              *chosen = getenv("MPMICE_CASES");
  char                     program[LONGEST_PATH] = "";
  if (chosen && *chosen) return i == 0 && snprintf(folder, LONGEST_PATH, "%s", chosen) < LONGEST_PATH;
  if (i < 2) {
    bool known = program_folder(program);
    return snprintf(folder, LONGEST_PATH, "%.*s/%s", known ? LONGEST_PATH - 32 : 1, known ? program : ".", beside[i]) >
           0;
  }
  if (i == 2) snprintf(folder, LONGEST_PATH, "%s/cases", MPMICE_SOURCE_DIR);
  if (i == 3) snprintf(folder, LONGEST_PATH, "%s/cases", MPMICE_DATA_DIR);
  return i < 4;
}

static bool join(const char *folder, const char *name, const char *file, char path[LONGEST_PATH])
{
  return snprintf(path, LONGEST_PATH, "%s/%s/%s", folder, name, file) < LONGEST_PATH;
}

/** The first folder of cases that there is. */
static bool open_cases(char folder[LONGEST_PATH])
{
  for (int i = 0; scene_cases_folder(i, folder); i++)
    if (access(folder, R_OK) == 0) return true;
  return false;
}

bool scene_case_name(int i, char name[NAME_LENGTH])
{
  char            folder[LONGEST_PATH], path[LONGEST_PATH];
  struct dirent **entries = NULL;
  bool            found = false;
  int             n = open_cases(folder) ? scandir(folder, &entries, NULL, alphasort) : 0;
  for (int e = 0; e < n; e++) {
    bool is_case =
        entries[e]->d_name[0] != '.' && join(folder, entries[e]->d_name, "scene.json", path) && files_exists(path);
    if (is_case && i-- == 0) {
      snprintf(name, NAME_LENGTH, "%.*s", NAME_LENGTH - 1, entries[e]->d_name);
      found = true;
    }
    free(entries[e]);
  }
  free(entries);
  return found;
}

static enum status fail_case(const char *word)
{
  char                stored[64][NAME_LENGTH];
  struct names        names = {0};
  const struct reader reader = {.file = word};
  for (int i = 0; i < 64 && scene_case_name(i, stored[i]); i++) names_add(&names, stored[i]);
  return reader_unknown(&reader, "file or case", word, &names);
}

static enum status find_file(const char *word, char file[LONGEST_PATH])
{
  char folder[LONGEST_PATH];
  if (snprintf(file, LONGEST_PATH, "%s", word) >= LONGEST_PATH)
    return FAIL(ERR_INPUT, "%.40s...: the path has more than %d characters; shorten it", word, LONGEST_PATH - 1);
  bool is_path = strchr(word, '/') || (strlen(word) > 5 && strcmp(word + strlen(word) - 5, ".json") == 0);
  if (files_exists(file)) return OK;
  bool fits =
      snprintf(file, LONGEST_PATH, "%s%sscene.json", word, word[strlen(word) - 1] == '/' ? "" : "/") < LONGEST_PATH;
  if (is_path && fits && files_exists(file)) return OK;
  for (int i = 0; !is_path && scene_cases_folder(i, folder); i++)
    if (join(folder, word, "scene.json", file) && files_exists(file)) return OK;
  return is_path ? FAIL(ERR_INPUT, "%s: there is no such file; check the path", word) : fail_case(word);
}

/** Case name: of the folder for scene.json, else of the file. */
static void name_of(const char *file, char name[NAME_LENGTH])
{
  char  full[PATH_MAX];
  char *base;
  if (!realpath(file, full)) snprintf(full, sizeof full, "%s", file);
  base = strrchr(full, '/');
  if (base && strcmp(base, "/scene.json") == 0) {
    *base = '\0';
    base = strrchr(full, '/');
  }
  base = base ? base + 1 : full;
  size_t length = strlen(base);
  if (length > 5 && strcmp(base + length - 5, ".json") == 0) length -= 5;
  snprintf(name, NAME_LENGTH, "%.*s", (int)length, base);
}

/** Splits "a+b" behind the name of the scene. */
static enum status split_variants(const char *argument, const char *plus, struct scene_place *place)
{
  while (plus && *plus == '+') {
    size_t length = strcspn(plus + 1, "+");
    if (length == 0 || length >= NAME_LENGTH)
      return FAIL(ERR_INPUT, "%s: a variant has no name or a very long one; write SCENE+variant", argument);
    if (place->n_variants == MAX_VARIANTS)
      return FAIL(ERR_INPUT, "%s: more than %d variants; leave some out", argument, MAX_VARIANTS);
    snprintf(place->variants[place->n_variants++], NAME_LENGTH, "%.*s", (int)length, plus + 1);
    plus += 1 + length;
  }
  return OK;
}

enum status scene_find(const char *argument, struct scene_place *place)
{
  char        word[LONGEST_PATH];
  const char *slash = strrchr(argument, '/');
  const char *plus = files_exists(argument) ? NULL : strchr(slash ? slash : argument, '+');
  *place = (struct scene_place){.n_variants = 0};
  snprintf(word, sizeof word, "%.*s", plus ? (int)(plus - argument) : LONGEST_PATH - 1, argument);
  if (*word == '\0')
    return FAIL(ERR_INPUT, "no scene is named; give the path of a .json or the name of a shipped case");
  TRY(find_file(word, place->file));
  TRY(split_variants(argument, plus, place));
  name_of(place->file, place->name);
  size_t length = strlen(place->name);
  int    rest = snprintf(place->name + length, NAME_LENGTH - length, "%s", plus ? plus : "");
  if (length + (size_t)rest >= NAME_LENGTH)
    return FAIL(ERR_INPUT, "%s: name and variants have more than %d characters; use fewer variants", argument,
                NAME_LENGTH - 1);
  return OK;
}
