/* What the tests of this path share: a scene from its text, a simulation of it, and steps. */
#ifndef TESTS_TWOPOINT_WATER_H
#define TESTS_TWOPOINT_WATER_H

#include "core/memory.h"
#include "core/parallel.h"
#include "run/plan.h"
#include "run/scene_read.h"
#include "twopoint/twopoint.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct water_run {
  struct loaded_scene *loaded;
  struct plan          plan;
  struct sim          *sim;
  struct twopoint     *water;
};

static void water_ok(enum status s) { ck_assert_msg(s == OK, "%s", status_message()); }

/** Loads a scene and creates its simulation; what fails is handed up. */
static enum status water_try(const char *text, struct water_run *run)
{
  char file[] = "/tmp/check_twopoint_XXXXXX.json";
  int  handle = mkstemps(file, 5);
  ck_assert_int_ge(handle, 0);
  ck_assert_int_eq(write(handle, text, strlen(text)), (long)strlen(text));
  close(handle);
  struct run_options options = {.argument = file, .until = INFINITY};
  *run = (struct water_run){0};
  enum status status = scene_load(&options, &run->loaded);
  unlink(file);
  TRY(status);
  TRY(plan_build(&run->loaded->scene, &run->plan));
  TRY(sim_create(&run->loaded->scene, &run->plan, &run->sim));
  run->water = twopoint_of(run->sim);
  return OK;
}

static inline void water_open(const char *text, struct water_run *run)
{
  parallel_set_threads(1); /* small runs are faster so */
  water_ok(water_try(text, run));
}

static void water_close(struct water_run *run)
{
  sim_destroy(&run->sim);
  scene_unload(&run->loaded);
}

/** One step of the largest length; stages up to and with `last` (NULL: all). Returns its length. */
static inline double water_step(struct water_run *run, const char *last)
{
  const char *by;
  struct sim *sim = run->sim;
  double      dt = sim_dt_limit(sim, &run->plan, &by);
  bool        done = false;
  sim->dt = dt;
  for (int i = 0; i < run->plan.n_stages && !done; i++) {
    water_ok(run->plan.stages[i]->run(sim, dt));
    done = last && strcmp(run->plan.stages[i]->name, last) == 0;
  }
  ck_assert(done || !last);
  if (last) return dt;
  sim->t += dt;
  sim->step++;
  return dt;
}

/** Runs a suite of one case: the main of a test program. */
static inline int water_main(Suite *suite)
{
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif
