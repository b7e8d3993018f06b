/* Time of every stage of a scene's plan without output: least and median over a number of steps, after some that are
 * not counted. One thread is timed by its own clock, which stands still while other programs have the core. Prints
 * JSON. usage: bench_stages SCENE THREADS STEPS [SKIP [PATH]] */
#include "core/parallel.h"
#include "run/options.h"
#include "run/plan.h"
#include "run/scene_read.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { MAX_STEPS = 4096 };

struct clock {
  int    n;
  double seconds[MAX_STAGES + 1][MAX_STEPS]; /* the last: the whole step */
};

static double now_s(int threads)
{
  struct timespec t;
  clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static enum status step(const struct plan *plan, struct sim *sim, struct clock *clock)
{
  const char *by;
  int         threads = parallel_threads();
  double      before = now_s(threads), start = before;
  sim->dt = sim_dt_limit(sim, plan, &by);
  for (int i = 0; i < plan->n_stages; i++) {
    TRY(plan->stages[i]->run(sim, sim->dt));
    double now = now_s(threads);
    clock->seconds[i][clock->n] = now - before;
    before = now;
  }
  clock->seconds[plan->n_stages][clock->n++] = before - start;
  sim->t += sim->dt;
  sim->step++;
  return OK;
}

static int ascending(const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static void print_row(const char *name, int n, double *seconds, const char *end)
{
  qsort(seconds, (size_t)n, sizeof *seconds, ascending);
  printf("  \"%s\": {\"least_s\": %.9g, \"median_s\": %.9g}%s\n", name, seconds[0], seconds[n / 2], end);
}

static void print(const struct plan *plan, const struct sim *sim, struct clock *clock)
{
  printf("{\"points_solid\": %ld, \"points_fluid\": %ld, \"steps\": %d, \"threads\": %d, \"field_bytes\": %zu,\n",
         sim->points[SET_SOLID] ? sim->points[SET_SOLID]->n : 0, sim->points[SET_WATER] ? sim->points[SET_WATER]->n : 0,
         clock->n, parallel_threads(), sim_field_bytes(sim->scene, plan));
  printf(" \"stages\": {\n");
  for (int i = 0; i < plan->n_stages; i++) print_row(plan->stages[i]->name, clock->n, clock->seconds[i], ",");
  print_row("step", clock->n, clock->seconds[plan->n_stages], "}}");
}

static enum status measure(const struct run_options *options, int skip, int steps)
{
  static struct clock  clock; /* too big for the stack */
  struct loaded_scene *loaded;
  struct plan          plan;
  struct sim          *sim;
  TRY(scene_load(options, &loaded));
  TRY(plan_build(&loaded->scene, &plan));
  TRY(sim_create(&loaded->scene, &plan, &sim));
  for (int i = 0; i < skip + steps; i++) {
    if (i == skip) clock.n = 0;
    if (clock.n == MAX_STEPS) clock.n = 0;
    TRY(step(&plan, sim, &clock));
  }
  print(&plan, sim, &clock);
  sim_destroy(&sim);
  scene_unload(&loaded);
  return OK;
}

int main(int argc, char **argv)
{
  if (argc < 4) {
    fprintf(stderr, "usage: bench_stages SCENE THREADS STEPS [SKIP [PATH]]\n");
    return EXIT_FAILURE;
  }
  struct run_options options = {.argument = argv[1], .until = INFINITY, .fluid = argc > 5 ? argv[5] : NULL};
  int                steps = atoi(argv[3]), skip = argc > 4 ? atoi(argv[4]) : 1;
  if (steps < 1 || steps > MAX_STEPS) return EXIT_FAILURE;
  parallel_set_threads(atoi(argv[2]));
  if (measure(&options, skip, steps) == OK) return EXIT_SUCCESS;
  fprintf(stderr, "bench_stages: %s\n", status_message());
  return EXIT_FAILURE;
}
