/* `mpmice list`: what there is. */
#include "run/json.h"
#include "run/plan.h"
#include "run/scene_find.h"
#include "run/scene_tables.h"
#include "run/schema.h"
#include "run/verbs.h"

#include <stdio.h>
#include <string.h>

static void print_case(const char *name)
{
  struct scene_place place;
  cJSON             *json = NULL;
  if (scene_find(name, &place) != OK || json_load(place.file, &json) != OK) {
    printf("  %-20s %s\n", name, status_message());
    return;
  }
  const cJSON *title = json_member(json, "title"), *variants = json_member(json, "variants");
  printf("  %-20s %s\n", name, cJSON_IsString(title) ? title->valuestring : "");
  for (const cJSON *v = variants ? variants->child : NULL; v; v = v->next)
    if (!json_is_comment(v)) printf("  %-20s +%s\n", "", v->string);
  cJSON_Delete(json);
}

static void print_rows(const char *heading, bool (*row)(int i, struct row *row))
{
  struct row r;
  printf("\n%s:\n", heading);
  for (int i = 0; row(i, &r); i++) printf("  %-20s %s\n", r.name, r.source ? r.source : "");
}

static void print_stages(void)
{
  printf("\nstages (docs/theory.md; when):\n");
  for (int i = 0; all_modules[i]; i++)
    for (int s = 0; s < all_modules[i]->n_stages; s++) {
      const struct stage *stage = &all_modules[i]->stages[s];
      printf("  %-32s %s%s%s\n", stage->name, stage->source ? stage->source : "", stage->when ? "; " : "",
             stage->when ? stage->when : "");
    }
}

enum status verb_list(const struct run_options *options)
{
  char name[NAME_LENGTH];
  if (options->markdown) {
    reference_print(stdout, true);
    return OK;
  }
  printf("cases (mpmice run NAME[+variant]):\n");
  for (int i = 0; scene_case_name(i, name); i++) print_case(name);
  printf("\nfluid paths:\n");
  for (int i = 0; all_modules[i]; i++)
    if (all_modules[i]->is_fluid_path) printf("  %s\n", all_modules[i]->name);
  print_rows("skeleton laws (materials.<name>.model; docs/theory.md)", constitutive_row);
  print_rows("equations of state (fluid.eos; docs/theory.md)", eos_row);
  print_rows("drag laws (fluid.drag; docs/theory.md)", drag_row);
  print_rows("references (references.<name>.kind)", reference_row);
  print_stages();
  printf("\nparameters:\n");
  reference_print(stdout, false);
  return OK;
}
