/* Where scenes are: the SCENE of a command line, and the shipped cases. */
#ifndef RUN_SCENE_FIND_H
#define RUN_SCENE_FIND_H

#include "run/overrides.h"

/* A SCENE argument taken apart. */
struct scene_place {
  char file[LONGEST_PATH];
  char name[NAME_LENGTH]; /* of the case or file, with the variants: "terzaghi_column+ramp1ms" */
  int  n_variants;
  char variants[MAX_VARIANTS][NAME_LENGTH];
};

/** A path to a .json or to a folder with scene.json, or the name of a shipped case; with +variant[+variant]. */
enum status scene_find(const char *argument, struct scene_place *place) MUST_CHECK;
/** The i-th place where shipped cases are looked for; false: past the last. */
bool scene_cases_folder(int i, char folder[LONGEST_PATH]);
/** The i-th shipped case in alphabetical order; false: past the last. */
bool scene_case_name(int i, char name[NAME_LENGTH]);

#endif
