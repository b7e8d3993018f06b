/* summary.json: what a run did, in numbers. */
#ifndef RUN_SUMMARY_H
#define RUN_SUMMARY_H

#include "core/status.h"
#include "run/start_check.h"

#include <stdbool.h>

struct count_entry {
  const char *name;
  long        count;
};

struct stage_entry {
  const char *name;
  long        calls;
  double      seconds;
};

struct left_out_entry {
  const char *name, *why;
};

struct metric_entry {
  const char *name, *unit, *reference; /* reference: "theory.P", ""; what it is compared with */
  double      value, limit;
  bool        has_limit, pass; /* without a limit a metric passes when it is finite */
};

/* Borrowed pointers; everything as it goes into the file. */
struct run_record {
  const char                  *scene, *fluid_path, *version; /* fluid_path: "" without fluid */
  const char                  *status;                       /* "done", "interrupted", or what went wrong */
  int                          threads, ranks;
  long                         cells, points_solid, points_fluid, steps;
  long                         points_put_back, points_deleted, points_flowed_out; /* that left the grid */
  double                       density_change; /* of water points: largest |rho_0/rho - 1|; < 0: there are none */
  double                       t_end;          /* s: time reached */
  double                       dt_min, dt_mean, dt_max;
  int                          n_limited_by; /* steps whose length that stage decided */
  const struct count_entry    *limited_by;
  double                       wall_s, cpu_s;
  long                         peak_rss_bytes;
  int                          n_stages, n_left_out, n_metrics;
  const struct stage_entry    *stages;
  const struct left_out_entry *left_out;
  const struct metric_entry   *metrics;
  long                         solves, iterations, smg, fallbacks, equilibria, equilibrium_steps;
  double                       residual_max;
  double                       defect_rms_max, defect_max;
  struct start_record          start;
  double                       mass_solid_rel, mass_fluid_rel, momentum_rel, energy_growth_rel;
};

/** Writes <folder>/summary.json; it appears complete or not at all. */
enum status summary_write(const char *folder, const struct run_record *record) MUST_CHECK;
/** The metrics as a table on standard output; nothing when there are none. */
/** What water points tell of themselves. */
void summary_add_water(const struct sim *sim, struct run_record *record);
void summary_print(const struct run_record *record);

#endif
