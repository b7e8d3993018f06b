/* Choosing and checking the stages of a scene. */
#include "run/plan.h"

#include "core/points.h"

#include <math.h>
#include <string.h>

#define MODULE(name) extern const struct module module_##name;
#include "run/modules.def"
#undef MODULE

const struct module *const all_modules[] = {
#define MODULE(name) &module_##name,
#include "run/modules.def"
#undef MODULE
    NULL};

static const char *const slot_names[] = {
#define SLOT(name, sentence) #name,
#include "core/step_order.def"
#undef SLOT
};

const struct module *module_find(const char *name)
{
  for (int i = 0; all_modules[i]; i++)
    if (!strcmp(all_modules[i]->name, name)) return all_modules[i];
  return NULL;
}

const void *scene_module_params(const struct scene *scene, const struct module *module)
{
  for (int i = 0; all_modules[i]; i++)
    if (all_modules[i] == module) return scene->module_params[i];
  return NULL;
}

/* calls visit for every word of a list of field names; stops at the first that is refused */
static enum status each_word(const char *list, enum status (*visit)(const char *word, void *context), void *context)
{
  char word[NAME_LENGTH];
  for (const char *at = list; at && *at;) {
    size_t n = strcspn(at, " ");
    if (n > 0 && n < sizeof word) {
      memcpy(word, at, n);
      word[n] = 0;
      TRY(visit(word, context));
    }
    at += n + strspn(at + n, " ");
  }
  return OK;
}

/* a name that ends with ? counts only where another stage plans the field */
static bool is_optional(const char *word) { return word[strlen(word) - 1] == '?'; }

static const struct field *find_field(const struct plan *plan, const char *name)
{
  for (int i = 0; i < plan->n_modules; i++)
    for (int f = 0; f < plan->modules[i]->n_fields; f++)
      if (!strcmp(plan->modules[i]->fields[f].name, name)) return &plan->modules[i]->fields[f];
  return NULL;
}

struct check {
  const struct plan  *plan;
  const struct stage *stage;
  const char         *written[MAX_PLAN_FIELDS];
  int                 n_written;
};

static enum status check_read(const char *word, void *context)
{
  struct check       *c = context;
  const struct field *f = find_field(c->plan, word);
  if (is_optional(word)) return OK;
  if (!f)
    return FAIL(ERR_INPUT, "plan: stage %s reads the unknown field %s; declare it in a fields.def", c->stage->name,
                word);
  if (f->kind == STATE) return OK;
  for (int i = 0; i < c->n_written; i++)
    if (!strcmp(c->written[i], f->name)) return OK;
  return FAIL(ERR_INPUT,
              "plan: stage %s reads %s before any stage writes it; a module's stage is missing for this scene",
              c->stage->name, word);
}

static enum status note_written(const char *word, void *context)
{
  struct check       *c = context;
  const struct field *f = find_field(c->plan, word);
  if (is_optional(word)) return OK;
  if (!f)
    return FAIL(ERR_INPUT, "plan: stage %s writes the unknown field %s; declare it in a fields.def", c->stage->name,
                word);
  c->written[c->n_written++ % MAX_PLAN_FIELDS] = f->name;
  return OK;
}

static enum status check_fields(const struct plan *plan)
{
  struct check c = {.plan = plan};
  for (int i = 0; i < plan->n_stages; i++) {
    c.stage = plan->stages[i];
    TRY(each_word(c.stage->reads, check_read, &c));
    TRY(each_word(c.stage->writes, note_written, &c));
  }
  return OK;
}

static void leave_out(struct plan *plan, const char *name, const char *why)
{
  if (plan->n_left_out < MAX_STAGES) plan->left_out[plan->n_left_out++] = (struct left_out){name, why};
}

static void choose_stages(const struct scene *scene, struct plan *plan)
{
  for (int slot = 0; slot < N_SLOTS; slot++)
    for (int i = 0; i < plan->n_modules; i++)
      for (int s = 0; s < plan->modules[i]->n_stages; s++) {
        const struct stage *stage = &plan->modules[i]->stages[s];
        if ((int)stage->slot != slot) continue;
        if (stage->needed && !stage->needed(scene))
          leave_out(plan, stage->name, stage->when);
        else if (plan->n_stages < MAX_STAGES)
          plan->stages[plan->n_stages++] = stage;
      }
}

enum status plan_build(const struct scene *scene, struct plan *plan)
{
  *plan = (struct plan){0};
  for (int i = 0; all_modules[i]; i++) {
    const struct module *m = all_modules[i];
    if (m->is_fluid_path ? scene->fluid.present && scene->fluid.path == m : !m->needed || m->needed(scene))
      plan->modules[plan->n_modules++] = m;
    else
      leave_out(plan, m->name, m->is_fluid_path ? "only when it is fluid.path" : "only when the scene needs it");
  }
  choose_stages(scene, plan);
  return check_fields(plan);
}

struct search {
  const char *name;
  bool        found;
};

static enum status compare_word(const char *word, void *context)
{
  struct search *s = context;
  s->found = s->found || !strcmp(word, s->name);
  return OK;
}

bool plan_uses(const struct plan *plan, const char *field)
{
  struct search s = {.name = field};
  for (int i = 0; i < plan->n_stages && !s.found; i++) {
    if (each_word(plan->stages[i]->reads, compare_word, &s) != OK) return false;
    if (each_word(plan->stages[i]->writes, compare_word, &s) != OK) return false;
  }
  return s.found;
}

void plan_explain(const struct plan *plan, FILE *out)
{
  for (int i = 0; i < plan->n_stages; i++) {
    const struct stage *s = plan->stages[i];
    fprintf(out, "%2d  %-16s %-32s %s -> %s   theory %s\n", i + 1, slot_names[s->slot], s->name,
            s->reads ? s->reads : "", s->writes ? s->writes : "", s->source);
  }
  for (int i = 0; i < plan->n_left_out; i++)
    fprintf(out, "    left out         %-32s %s\n", plan->left_out[i].name, plan->left_out[i].why);
}

void plan_print_times(const struct plan *plan, const struct sim *sim, const double *calls, const double *seconds)
{
  double total = 0, steps = fmax(1, (double)sim->step);
  double cells = (double)sim->grid.n[0] * sim->grid.n[1] * sim->grid.n[2];
  for (int i = 0; i < plan->n_stages; i++) total += seconds[i];
  printf("%-34s %10s %12s %8s\n", "stage", "calls", "us per call", "share");
  for (int i = 0; i < plan->n_stages; i++)
    printf("%-34s %10.0f %12.3f %7.1f%%\n", plan->stages[i]->name, calls[i], 1e6 * seconds[i] / fmax(1, calls[i]),
           total > 0 ? 100 * seconds[i] / total : 0);
  printf("per step %.3f us", 1e6 * total / steps);
  if (sim->points[SET_SOLID])
    printf(", %.1f ns per solid point", 1e9 * total / steps / (double)sim->points[SET_SOLID]->n);
  if (sim->points[SET_WATER])
    printf(", %.1f ns per water point", 1e9 * total / steps / (double)sim->points[SET_WATER]->n);
  printf(", %.1f ns per cell\n", 1e9 * total / steps / cells);
}
