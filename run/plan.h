/* A scene compiled to a plan: the modules and stages it needs, in order, and what was left out. */
#ifndef RUN_PLAN_H
#define RUN_PLAN_H

#include "core/sim.h"

#include <stdio.h>

enum { MAX_STAGES = 128, MAX_PLAN_FIELDS = 256 };

/** Every module of run/modules.def; NULL-terminated. */
extern const struct module *const all_modules[];
const struct module              *module_find(const char *name);

struct left_out {
  const char *name, *why;
};

struct plan {
  int                  n_modules, n_stages, n_left_out;
  const struct module *modules[MAX_MODULES];
  const struct stage  *stages[MAX_STAGES];
  struct left_out      left_out[MAX_STAGES];
};

/** Chooses modules and stages and checks their fields. ERR_INPUT: a stage names an unknown field, reads a scratch field
 *  that nobody wrote before it, or the scene has a fluid whose path gives nothing to the solid. */
enum status plan_build(const struct scene *scene, struct plan *plan) MUST_CHECK;
/** Whether some planned stage names the field. */
bool plan_uses(const struct plan *plan, const char *field);
/** The plan as a table: number, slot, stage, reads -> writes, theory; then what was left out and why. */
void plan_explain(const struct plan *plan, FILE *out);
/** Prints calls [n_stages] and seconds [n_stages] of the stages so far, and the cost per step, point and cell. */
void plan_print_times(const struct plan *plan, const struct sim *sim, const double *calls, const double *seconds);

/** Grid, points, fields and initial state. The plan and the scene are borrowed. */
enum status sim_create(const struct scene *scene, const struct plan *plan, struct sim **sim) MUST_CHECK;
void        sim_destroy(struct sim **sim);
/** Number of points of each set (and of markers), and of groups, that a scene would have. */
enum status sim_count_points(const struct scene *scene, const struct plan *plan, long n[N_COUNTS],
                             int groups[N_SETS]) MUST_CHECK;
/** Smallest time step limit of the planned stages and numerics.dt_max, s; *by: its stage's name. sim->dt_limit becomes
 * what the stages allow at factor one, whatever dt_factor and dt_max are. */
double sim_dt_limit(struct sim *sim, const struct plan *plan, const char **by);
/** Fills every scratch field with NaN in debug builds, before a step. */
void sim_poison(struct sim *sim);
/** What is in the run now. */
void sim_measure(const struct sim *sim, struct ledger *ledger);
/** Bytes of all fields. */
size_t sim_field_bytes(const struct scene *scene, const struct plan *plan);

#endif
