/* Time of every stage of a scene's plan without output: least and median over a number of steps, after some that are
 * not counted. Steps on one thread and on all follow one another by turns, so that what else the machine does meets
 * both. One thread is timed by its own clock too, which stands still while other programs have the core. Prints JSON.
 * usage: bench_stages SCENE THREADS STEPS [SKIP [PATH]] */
#include "core/parallel.h"
#include "mpm/mpm.h"
#include "run/options.h"
#include "run/plan.h"
#include "run/scene_read.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { MAX_STEPS = 4096, CPU = 0, WALL = 1 };

/* of one number of threads; the last stage is the whole step */
struct clock {
  int    threads, n;
  double seconds[2][MAX_STAGES + 1][MAX_STEPS];
};

static void now_s(double now[2])
{
  static const clockid_t clocks[2] = {CLOCK_THREAD_CPUTIME_ID, CLOCK_MONOTONIC};
  for (int c = 0; c < 2; c++) {
    struct timespec t;
    clock_gettime(clocks[c], &t);
    now[c] = (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
  }
}

static enum status step(const struct plan *plan, struct sim *sim, struct clock *clock)
{
  const char *by;
  double      start[2], before[2], now[2];
  parallel_set_threads(clock->threads);
  now_s(start);
  memcpy(before, start, sizeof before);
  sim->dt = sim_dt_limit(sim, plan, &by);
  for (int i = 0; i < plan->n_stages; i++) {
    TRY(plan->stages[i]->run(sim, sim->dt));
    now_s(now);
    for (int c = 0; c < 2; c++) clock->seconds[c][i][clock->n] = now[c] - before[c];
    memcpy(before, now, sizeof before);
  }
  for (int c = 0; c < 2; c++) clock->seconds[c][plan->n_stages][clock->n] = now[c] - start[c];
  clock->n++;
  sim->t += sim->dt;
  sim->step++;
  return OK;
}

static int ascending(const void *a, const void *b)
{
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static void print_row(const char *name, struct clock *clock, int stage, const char *end)
{
  int     n = clock->n;
  double *cpu = clock->seconds[CPU][stage], *wall = clock->seconds[WALL][stage];
  qsort(cpu, (size_t)n, sizeof *cpu, ascending);
  qsort(wall, (size_t)n, sizeof *wall, ascending);
  double *own = clock->threads == 1 ? cpu : wall;
  printf("  \"%s\": {\"least_s\": %.9g, \"median_s\": %.9g, \"least_wall_s\": %.9g}%s\n", name, own[0], own[n / 2],
         wall[0], end);
}

static void print_clock(const struct plan *plan, struct clock *clock, const char *end)
{
  printf(" {\"threads\": %d, \"steps\": %d, \"stages\": {\n", clock->threads, clock->n);
  for (int i = 0; i < plan->n_stages; i++) print_row(plan->stages[i]->name, clock, i, ",");
  print_row("step", clock, plan->n_stages, end);
}

/* bytes that the program has in memory */
static long resident(void)
{
  long  pages = 0;
  FILE *file = fopen("/proc/self/statm", "r");
  if (!file) return 0;
  if (fscanf(file, "%*d %ld", &pages) != 1) pages = 0;
  fclose(file);
  return pages * sysconf(_SC_PAGESIZE);
}

/* one more step; share of the solid points whose history a law has changed in it */
static enum status survey_yielding(const struct plan *plan, struct sim *sim, double *share)
{
  const struct mpm *m = sim->points[SET_SOLID] ? mpm_of(sim) : NULL;
  const char       *by;
  long              n = m && m->history_p ? m->points->n * sim->scene->n_history : 0, changed = 0;
  double           *before = malloc((size_t)(n + 1) * sizeof *before);
  if (!before) return FAIL(ERR_ENVIRONMENT, "no room for a copy of the history");
  sim->dt = sim_dt_limit(sim, plan, &by);
  for (int i = 0; i < plan->n_stages; i++) {
    bool strains = n > 0 && plan->stages[i]->writes && strstr(plan->stages[i]->writes, "history_p");
    if (strains) memcpy(before, m->history_p, (size_t)n * sizeof *before);
    TRY(plan->stages[i]->run(sim, sim->dt));
    for (long q = 0; strains && q < n; q += sim->scene->n_history) changed += before[q] != m->history_p[q];
  }
  free(before);
  *share = n > 0 ? (double)changed / (double)m->points->n : 0;
  return OK;
}

/* steps by turns on one thread and on `threads` */
static enum status take_steps(const struct plan *plan, struct sim *sim, int threads, int skip, int steps)
{
  static struct clock clocks[2]; /* too big for the stack */
  double              yielding = 0;
  int                 n = threads > 1 ? 2 : 1;
  clocks[0].threads = 1;
  clocks[1].threads = threads;
  for (int i = 0; i < skip + steps; i++)
    for (int c = 0; c < n; c++) {
      if (i == skip) clocks[c].n = 0;
      TRY(step(plan, sim, &clocks[c]));
    }
  TRY(survey_yielding(plan, sim, &yielding));
  printf(
      "{\"points_solid\": %ld, \"points_fluid\": %ld, \"cells\": %ld, \"field_bytes\": %zu, \"resident_bytes\": %ld, "
      "\"yielding\": %.3f, \"runs\": [\n",
      sim->points[SET_SOLID] ? sim->points[SET_SOLID]->n : 0, sim->points[SET_WATER] ? sim->points[SET_WATER]->n : 0,
      (long)sim->grid.n[0] * sim->grid.n[1] * sim->grid.n[2], sim_field_bytes(sim->scene, plan), resident(), yielding);
  for (int c = 0; c < n; c++) print_clock(plan, &clocks[c], c + 1 < n ? "}}," : "}}]}");
  return OK;
}

static enum status measure(const struct run_options *options, int threads, int skip, int steps)
{
  struct loaded_scene *loaded;
  struct plan          plan;
  struct sim          *sim;
  TRY(scene_load(options, &loaded));
  TRY(plan_build(&loaded->scene, &plan));
  TRY(sim_create(&loaded->scene, &plan, &sim));
  TRY(take_steps(&plan, sim, threads, skip, steps));
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
  int                threads = atoi(argv[2]), steps = atoi(argv[3]), skip = argc > 4 ? atoi(argv[4]) : 1;
  if (threads < 1 || steps < 1 || skip < 0 || skip + steps > MAX_STEPS) return EXIT_FAILURE;
  parallel_set_threads(threads);
  if (measure(&options, threads, skip, steps) == OK) return EXIT_SUCCESS;
  fprintf(stderr, "bench_stages: %s\n", status_message());
  return EXIT_FAILURE;
}
