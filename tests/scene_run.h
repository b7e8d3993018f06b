/* What tests of whole scenes share: a simulation from the text of a scene, steps of it, and the main of a program. */
#ifndef TESTS_SCENE_RUN_H
#define TESTS_SCENE_RUN_H

#include "core/memory.h"
#include "core/parallel.h"
#include "run/plan.h"
#include "run/scene_read.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct scene_run {
  struct loaded_scene *loaded;
  struct plan          plan;
  struct sim          *sim;
};

static inline void must(enum status s) { ck_assert_msg(s == OK, "%s", status_message()); }

/** Scene from its text; sets: "key.path=value" that change it, NULL at the end, or NULL. */
static inline void scene_open_with(const char *text, const char *const *sets, struct scene_run *run)
{
  char               file[] = "/tmp/check_scene_XXXXXX.json";
  int                handle = mkstemps(file, 5);
  struct run_options options = {.argument = file, .until = INFINITY};
  ck_assert_int_ge(handle, 0);
  ck_assert_int_eq(write(handle, text, strlen(text)), (long)strlen(text));
  close(handle);
  while (sets && sets[options.n_sets]) {
    options.sets[options.n_sets] = sets[options.n_sets];
    options.n_sets++;
  }
  *run = (struct scene_run){0};
  parallel_set_threads(1); /* small runs are faster so */
  enum status status = scene_load(&options, &run->loaded);
  unlink(file);
  must(status);
  must(plan_build(&run->loaded->scene, &run->plan));
  must(sim_create(&run->loaded->scene, &run->plan, &run->sim));
}

static inline void scene_open(const char *text, struct scene_run *run) { scene_open_with(text, NULL, run); }

static inline void scene_close(struct scene_run *run)
{
  sim_destroy(&run->sim);
  scene_unload(&run->loaded);
}

/** One step of length dt, at most the limit; stages up to and with `last` (NULL: all, and time goes on). Returns its
 * length. */
static inline double scene_step_to(struct scene_run *run, double dt, const char *last)
{
  const char *by;
  struct sim *sim = run->sim;
  double      limit = sim_dt_limit(sim, &run->plan, &by);
  bool        done = false;
  sim->dt = fmin(dt, limit);
  sim_poison(sim);
  for (int i = 0; i < run->plan.n_stages && !done; i++) {
    must(run->plan.stages[i]->run(sim, sim->dt));
    done = last && strcmp(run->plan.stages[i]->name, last) == 0;
  }
  ck_assert(done || !last);
  if (last) return sim->dt;
  sim->t += sim->dt;
  sim->step++;
  return sim->dt;
}

static inline double scene_step(struct scene_run *run, double dt) { return scene_step_to(run, dt, NULL); }

static inline void scene_steps(struct scene_run *run, int n, double dt)
{
  for (int i = 0; i < n; i++) scene_step(run, dt);
}

static inline struct ledger scene_ledger(const struct scene_run *run)
{
  struct ledger l;
  sim_measure(run->sim, &l);
  return l;
}

/** Runs a suite: the main of a test program. */
static inline int run_suite(Suite *suite)
{
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif
