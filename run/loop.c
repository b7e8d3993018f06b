/* A run: steps, events, gauges, checkpoints, and the summary at its end. */
#include "run/loop.h"

#include "core/memory.h"
#include "core/parallel.h"
#include "mpm/mpm.h"
#include "run/checkpoint.h"
#include "run/events.h"
#include "run/files.h"
#include "run/gauges.h"
#include "run/metrics.h"
#include "run/output.h"
#include "run/plan.h"
#include "run/progress.h"
#include "run/scene_read.h"
#include "run/start_check.h"
#include "run/start_from.h"
#include "run/summary.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>

/* what is counted over the whole run, checkpointed as plain doubles */
struct counts {
  double              next_event, gauge_samples, snapshots;
  double              dt_min, dt_max, dt_sum;
  double              wall_s, cpu_s, energy_growth;
  struct start_motion start;
};

struct run {
  const struct run_options *options;
  struct loaded_scene      *loaded;
  struct plan               plan;
  struct sim               *sim;
  struct output_writer     *output;
  struct gauges            *gauges;
  struct metrics           *metrics;
  struct events             events;
  struct progress           progress;
  char                      folder[1024];
  double                    t_end, gauge_interval, wall_start, cpu_start, checkpoint_wall;
  struct counts             counts;
  long                      strays_before;             /* points that had left the grid when this process began */
  double                   *seconds, *calls, *limited; /* per stage; limited has one more for numerics.dt_max */
};

static double cpu_seconds(void)
{
  struct rusage u;
  getrusage(RUSAGE_SELF, &u);
  return (double)(u.ru_utime.tv_sec + u.ru_stime.tv_sec) + 1e-6 * (double)(u.ru_utime.tv_usec + u.ru_stime.tv_usec);
}

static enum status make_folder(const char *folder)
{
  char path[1024];
  snprintf(path, sizeof path, "%s", folder);
  for (char *at = path + 1;; at++) {
    if (*at != '/' && *at) continue;
    char end = *at;
    *at = 0;
    if (mkdir(path, 0777) && errno != EEXIST)
      return FAIL(ERR_ENVIRONMENT, "%s: cannot make this folder: %s; choose another with --out", path, strerror(errno));
    *at = end;
    if (!end) return OK;
  }
}

enum { FIXED_ITEMS = 5, MAX_ITEMS = FIXED_ITEMS + MAX_MODULES };

/* everything besides the sim that a checkpoint must hold */
static int checkpoint_items(struct run *r, struct checkpoint_item *items)
{
  int     n = 0, n_values;
  double *values = metrics_values(r->metrics, &n_values);
  items[n++] = (struct checkpoint_item){"counts", sizeof r->counts / sizeof(double), (double *)&r->counts};
  items[n++] = (struct checkpoint_item){"stage_seconds", r->plan.n_stages, r->seconds};
  items[n++] = (struct checkpoint_item){"stage_calls", r->plan.n_stages, r->calls};
  items[n++] = (struct checkpoint_item){"limited_by", r->plan.n_stages + 1, r->limited};
  items[n++] = (struct checkpoint_item){"metrics", n_values, values};
  for (int i = 0; i < r->plan.n_modules; i++) {
    const struct module *m = r->plan.modules[i];
    if (m->n_numbers > 0)
      items[n++] =
          (struct checkpoint_item){m->name, m->n_numbers, (double *)((char *)r->sim->states[i] + m->numbers_offset)};
  }
  return n;
}

static void update_clocks(struct run *r)
{
  double wall = progress_clock(), cpu = cpu_seconds();
  r->counts.wall_s += wall - r->wall_start;
  r->counts.cpu_s += cpu - r->cpu_start;
  r->wall_start = wall;
  r->cpu_start = cpu;
}

static enum status save(struct run *r)
{
  struct checkpoint_item items[MAX_ITEMS];
  int                    n = checkpoint_items(r, items);
  r->counts.next_event = r->events.next;
  r->counts.snapshots = (double)output_count(r->output);
  update_clocks(r);
  TRY(gauges_flush(r->gauges));
  TRY(checkpoint_write(r->folder, r->sim, n, items));
  r->checkpoint_wall = progress_clock();
  return OK;
}

static enum status restore(struct run *r)
{
  struct checkpoint_item items[MAX_ITEMS];
  int                    n = checkpoint_items(r, items);
  TRY(checkpoint_read(r->folder, r->sim, n, items));
  while (r->events.next < r->events.n && r->events.event[r->events.next].t <= r->sim->t * (1 + 1e-13)) r->events.next++;
  TRY(output_resume(r->output, (long)r->counts.snapshots));
  return gauges_resume(r->gauges, r->sim->t);
}

/* what the modules hold, but no counts or results, may come from another run's end */
static enum status take_start(struct run *r)
{
  struct checkpoint_item items[MAX_ITEMS];
  int                    n = checkpoint_items(r, items);
  return start_from(r->loaded, r->sim, n - FIXED_ITEMS, items + FIXED_ITEMS);
}

/* one row of the gauges, and with it the ledger */
static enum status sample(struct run *r)
{
  struct ledger                 *l = &r->sim->ledger;
  const double                  *start = r->sim->ledger_start.v;
  static const enum ledger_entry energies[] = {LEDGER_kinetic_solid, LEDGER_kinetic_fluid, LEDGER_potential,
                                               LEDGER_elastic,       LEDGER_compression,   LEDGER_energy_out};
  double                         now, before = 0, scale;
  sim_measure(r->sim, l);
  now = start[LEDGER_work_loads] - l->v[LEDGER_work_loads] + start[LEDGER_work_walls] - l->v[LEDGER_work_walls];
  scale = fabs(now);
  for (size_t i = 0; i < sizeof energies / sizeof *energies; i++) {
    now += l->v[energies[i]];
    before += start[energies[i]];
    scale += fabs(start[energies[i]]);
  }
  if (scale > 0) r->counts.energy_growth = fmax(r->counts.energy_growth, (now - before) / scale);
  return gauges_sample(r->gauges, r->sim);
}

/* unless --threads says how many */
static void choose_threads(const struct run *r)
{
  const struct sim *sim = r->sim;
  long              items = (long)sim->grid.n[0] * sim->grid.n[1] * sim->grid.n[2];
  for (int s = 0; s < N_SETS; s++) items += sim->points[s] ? sim->points[s]->n : 0;
  if (r->options->threads == 0) parallel_choose_threads(items);
}

static enum status open_run(struct run *r)
{
  const struct scene *scene = &r->loaded->scene;
  int                 n_times;
  TRY(plan_build(scene, &r->plan));
  TRY(NEW(&r->seconds, r->plan.n_stages));
  TRY(NEW(&r->calls, r->plan.n_stages));
  TRY(NEW(&r->limited, r->plan.n_stages + 1));
  TRY(sim_create(scene, &r->plan, &r->sim));
  choose_threads(r);
  r->t_end = fmin(scene->time_end, r->options->until);
  r->gauge_interval = gauges_interval(scene);
  r->counts.dt_min = INFINITY;
  TRY(make_folder(r->folder));
  TRY(metrics_create(r->sim, &r->metrics));
  const double *times = metrics_times(r->metrics, &n_times);
  TRY(events_create(scene, output_interval(scene), times, n_times, r->t_end, &r->events));
  TRY(output_create(r->sim, r->folder, &r->output));
  TRY(gauges_create(r->sim, r->folder, mpm_marker_range, &r->gauges));
  r->wall_start = r->checkpoint_wall = progress_clock();
  r->cpu_start = cpu_seconds();
  return OK;
}

static void close_run(struct run *r)
{
  gauges_destroy(&r->gauges);
  output_destroy(&r->output);
  metrics_destroy(&r->metrics);
  events_destroy(&r->events);
  sim_destroy(&r->sim);
  memory_free(&r->seconds);
  memory_free(&r->calls);
  memory_free(&r->limited);
  scene_unload(&r->loaded);
}

static enum status write_plan(const struct run *r)
{
  char path[1100];
  snprintf(path, sizeof path, "%s/plan.txt", r->folder);
  FILE *f = fopen(path, "w");
  if (!f) return FAIL(ERR_ENVIRONMENT, "%s: cannot write: %s; choose another folder with --out", path, strerror(errno));
  plan_explain(&r->plan, f);
  if (fclose(f)) return FAIL(ERR_ENVIRONMENT, "%s: the disk is full; free some space", path);
  return OK;
}

static enum status run_stages(struct run *r, double dt)
{
  double before = progress_clock();
  for (int i = 0; i < r->plan.n_stages; i++) {
    TRY(r->plan.stages[i]->run(r->sim, dt));
    double after = progress_clock();
    r->seconds[i] += after - before;
    r->calls[i]++;
    before = after;
  }
  return OK;
}

static void count_step(struct run *r, double dt, const char *by)
{
  int i = 0;
  while (i < r->plan.n_stages && strcmp(r->plan.stages[i]->name, by)) i++;
  r->limited[i]++;
  r->counts.dt_min = fmin(r->counts.dt_min, dt);
  r->counts.dt_max = fmax(r->counts.dt_max, dt);
  r->counts.dt_sum += dt;
}

/* before the first step, and what the first ones showed */
static void tell_start(struct run *r)
{
  struct start_record start;
  start_check_fill(r->sim, &r->counts.start, &start);
  if (!r->options->quiet) start_check_print(&start, stderr);
}

static enum status step(struct run *r, bool *event)
{
  struct sim *sim = r->sim;
  const char *by;
  double      limit = sim_dt_limit(sim, &r->plan, &by), dt;
  if (!(limit > 0))
    return FAIL(ERR_DIVERGED, "%s: the time step limit is %g s at t = %g s; lower numerics.dt_factor", by, limit,
                sim->t);
  dt = events_step(&r->events, sim->t, limit, event);
  sim->dt = dt;
  sim_poison(sim);
  TRY(run_stages(r, dt));
  count_step(r, dt, by);
  sim->t = *event ? r->events.event[r->events.next].t : sim->t + dt;
  sim->step++;
  start_check_step(sim, &r->counts.start);
  if (sim->step == START_CHECK_STEPS) tell_start(r);
  return OK;
}

static enum status handle_event(struct run *r)
{
  int kinds = r->events.event[r->events.next++].kinds;
  TRY(sample(r));
  if (kinds & EVENT_METRIC) TRY(metrics_sample(r->metrics, r->sim));
  if (kinds & EVENT_OUTPUT) TRY(output_write(r->output, r->sim));
  return OK;
}

/* the first point that leaves the grid is told of at once, also in a quiet run */
static void tell_strays(struct run *r)
{
  const struct mpm        *m = mpm_of(r->sim);
  const struct mpm_strays *s = m ? &m->now.strays : NULL;
  long                     now = s ? (long)(s->put_back + s->deleted + s->flowed_out) : 0;
  if (r->progress.strays < 0) r->progress.strays = r->strays_before = now;
  if (now == r->progress.strays) return;
  if (r->progress.strays == r->strays_before)
    fprintf(stderr,
            "%smpmice: warning: a point of solids.%s left the grid at (%.6g, %.6g, %.6g) at t = %.6g s and was %s "
            "(numerics.mpm.stray); others are only counted\n",
            r->progress.terminal && !r->progress.quiet ? "\r\033[K" : "",
            r->sim->scene->solids[(int)s->last_solid].name, s->last_x[0], s->last_x[1], s->last_x[2], s->last_t,
            mpm_params(r->sim->scene)->stray == STRAY_CLAMP ? "put back" : "deleted");
  r->progress.strays = now;
}

static enum status advance(struct run *r)
{
  tell_strays(r);
  while (r->events.next < r->events.n) {
    bool event;
    TRY(step(r, &event));
    if (event) TRY(handle_event(r));
    bool due = r->sim->t >= r->counts.gauge_samples * r->gauge_interval;
    if (due) r->counts.gauge_samples = floor(r->sim->t / r->gauge_interval) + 1;
    if (due && !event) TRY(sample(r));
    tell_strays(r);
    progress_step(&r->progress, r->sim->t, r->sim->dt, r->sim->step);
    if (progress_stop_asked())
      return FAIL(INTERRUPTED, "interrupted at t = %g s; go on with: mpmice resume %s", r->sim->t, r->folder);
    if (progress_clock() - r->checkpoint_wall > r->sim->scene->output.checkpoint_interval) TRY(save(r));
  }
  return OK;
}

static double relative(double now, double before)
{
  return before != 0 ? fabs(now - before) / fabs(before) : fabs(now);
}

/* with what left the grid */
static double solid_mass(const double *ledger)
{
  return ledger[LEDGER_mass_solid] + ledger[LEDGER_mass_solid_out] + ledger[LEDGER_mass_solid_lost];
}

static void fill_ledger(const struct run *r, struct run_record *record)
{
  const double *now = r->sim->ledger.v, *before = r->sim->ledger_start.v;
  double        momentum = 0, scale = 0;
  for (int d = 0; d < r->sim->grid.dim; d++) {
    double change = now[LEDGER_momentum_x + d] - before[LEDGER_momentum_x + d];
    momentum += change * change;
  }
  scale = sqrt(2 * (now[LEDGER_mass_solid] + now[LEDGER_mass_fluid]) *
               (before[LEDGER_kinetic_solid] + before[LEDGER_kinetic_fluid]));
  record->mass_solid_rel =
      relative(solid_mass(now) - solid_mass(before) + before[LEDGER_mass_solid], before[LEDGER_mass_solid]);
  record->mass_fluid_rel = relative(now[LEDGER_mass_fluid] + now[LEDGER_mass_fluid_out] - before[LEDGER_mass_fluid_out],
                                    before[LEDGER_mass_fluid]);
  record->momentum_rel = scale > 0 ? sqrt(momentum) / scale : 0;
  record->energy_growth_rel = r->counts.energy_growth;
}

static void fill_record(const struct run *r, struct run_record *record)
{
  const struct sim *sim = r->sim;
  struct rusage     usage;
  getrusage(RUSAGE_SELF, &usage);
  *record = (struct run_record){
      .scene = sim->scene->name,
      .fluid_path = sim->scene->fluid.present ? r->loaded->path : "",
      .version = MPMICE_VERSION,
      .threads = parallel_threads(),
      .ranks = 1,
      .cells = (long)sim->grid.n[0] * sim->grid.n[1] * sim->grid.n[2],
      .points_solid = sim->points[SET_SOLID] ? sim->points[SET_SOLID]->n : 0,
      .points_fluid = sim->points[SET_WATER] ? sim->points[SET_WATER]->n : 0,
      .steps = sim->step,
      .t_end = sim->t,
      .dt_min = r->counts.dt_min,
      .dt_mean = sim->step > 0 ? r->counts.dt_sum / (double)sim->step : 0,
      .dt_max = r->counts.dt_max,
      .wall_s = r->counts.wall_s,
      .cpu_s = r->counts.cpu_s,
      .peak_rss_bytes = usage.ru_maxrss * 1024,
      .solves = sim->solver.solves,
      .iterations = sim->solver.iterations,
      .smg = sim->solver.smg,
      .fallbacks = sim->solver.fallbacks,
      .equilibria = sim->solver.equilibria,
      .equilibrium_steps = sim->solver.equilibrium_steps,
      .residual_max = sim->solver.residual_max,
      .defect_rms_max = sim->defect_rms_max,
      .defect_max = sim->defect_max,
  };
  if (mpm_of(sim)) {
    const struct mpm_strays *s = &mpm_of(sim)->now.strays;
    record->points_put_back = (long)s->put_back;
    record->points_deleted = (long)s->deleted;
    record->points_flowed_out = (long)s->flowed_out;
  }
  summary_add_water(sim, record);
  fill_ledger(r, record);
  start_check_fill(sim, &r->counts.start, &record->start);
}

/* t_reached: metrics of later times are left out */
static enum status write_summary(struct run *r, const char *status, double t_reached, bool *missed)
{
  struct run_record     record;
  struct stage_entry    stages[MAX_STAGES];
  struct count_entry    limited[MAX_STAGES + 1];
  struct left_out_entry left_out[MAX_STAGES];
  fill_record(r, &record);
  record.status = status;
  for (int i = 0; i < r->plan.n_stages; i++)
    stages[i] = (struct stage_entry){r->plan.stages[i]->name, (long)r->calls[i], r->seconds[i]};
  for (int i = 0; i <= r->plan.n_stages; i++)
    if (r->limited[i] > 0)
      limited[record.n_limited_by++] =
          (struct count_entry){i < r->plan.n_stages ? r->plan.stages[i]->name : "numerics.dt_max", (long)r->limited[i]};
  for (int i = 0; i < r->plan.n_left_out; i++)
    left_out[i] = (struct left_out_entry){r->plan.left_out[i].name, r->plan.left_out[i].why};
  record.stages = stages;
  record.n_stages = r->plan.n_stages;
  record.limited_by = limited;
  record.left_out = left_out;
  record.n_left_out = r->plan.n_left_out;
  TRY(metrics_finish(r->metrics, r->gauges, r->loaded, t_reached, &record.n_metrics, &record.metrics));
  TRY(metrics_write_references(r->metrics, r->gauges, r->folder));
  for (int i = 0; i < record.n_metrics; i++)
    *missed = *missed || (record.metrics[i].has_limit && !record.metrics[i].pass);
  if (!r->options->quiet) summary_print(&record);
  return summary_write(r->folder, &record);
}

/* the run itself, and what it leaves behind however it ends */
static enum status finish(struct run *r, enum status how)
{
  bool missed = false;
  char message[1024];
  snprintf(message, sizeof message, "%s", status_message());
  progress_end(&r->progress, r->sim->t, r->sim->step);
  update_clocks(r);
  if (how == OK || how == INTERRUPTED) {
    TRY(save(r));
    TRY(write_summary(r, how == OK ? "done" : "interrupted", how == OK ? r->t_end : r->sim->t, &missed));
  } else {
    TRY(gauges_flush(r->gauges));
    TRY(write_summary(r, message, r->sim->t, &missed));
  }
  if (r->options->time) plan_print_times(&r->plan, r->sim, r->calls, r->seconds);
  if (!r->options->quiet) printf("files: %s\n", r->folder);
  if (how != OK) return FAIL(how, "%s", message);
  return missed ? FAIL(ERR_METRIC, "a metric missed its limit; see the table above or %s/summary.json", r->folder) : OK;
}

static enum status run_to_end(struct run *r)
{
  progress_catch_signals();
  progress_start(&r->progress, stderr, r->options->quiet, r->sim->t, r->t_end, r->sim->step);
  return finish(r, advance(r));
}

/* what an earlier run left in the folder must not be mistaken for this one's */
static void remove_old(const struct run *r)
{
  static const char *const old[] = {"fields.*.hdf",   "fields.*.hdf.series", "gauges.csv",
                                    "references.csv", "summary.json",        "checkpoint.h5"};
  for (size_t i = 0; i < sizeof old / sizeof *old; i++) files_remove(r->folder, old[i]);
}

/* the first that a new run writes; everything that can be wrong with it was found before */
static enum status begin(struct run *r)
{
  char used[1100];
  remove_old(r);
  snprintf(used, sizeof used, "%s/scene.used.json", r->folder);
  TRY(scene_write_used(r->loaded, used));
  TRY(write_plan(r));
  tell_start(r);
  TRY(output_write(r->output, r->sim));
  r->counts.gauge_samples = 1;
  return sample(r);
}

enum status run_scene(const struct run_options *options)
{
  struct run r = {.options = options};
  if (options->threads > 0) parallel_set_threads(options->threads);
  enum status status = scene_load(options, &r.loaded);
  if (status == OK) status = scene_out_directory(r.loaded, options, r.folder, sizeof r.folder);
  if (status == OK) status = scene_refuse_used_directory(options, r.folder);
  if (status == OK) status = open_run(&r);
  if (status == OK) status = take_start(&r);
  if (status == OK) status = begin(&r);
  if (status == OK) status = run_to_end(&r);
  close_run(&r);
  return status;
}

enum status run_resume(const struct run_options *options)
{
  struct run         r = {.options = options};
  struct run_options again = *options;
  char               used[1100];
  snprintf(used, sizeof used, "%s/scene.used.json", options->argument);
  snprintf(r.folder, sizeof r.folder, "%s", options->argument);
  again.argument = used;
  if (options->threads > 0) parallel_set_threads(options->threads);
  enum status status = scene_load(&again, &r.loaded);
  if (status == OK) status = open_run(&r);
  if (status == OK) status = restore(&r);
  if (status == OK) status = run_to_end(&r);
  close_run(&r);
  return status;
}
