/* What the command line of a verb says. */
#ifndef RUN_OPTIONS_H
#define RUN_OPTIONS_H

#include <stdbool.h>

enum { MAX_SETS = 64, MAX_LADDERS = 16 };

struct run_options {
  const char *argument; /* SCENE of run, check, explain, compare, study, stress; DIR of resume, plot; FILE of info; NAME
                           of new */
  const char *fluid;    /* --fluid: a path, or A,B,... for compare, study, stress; NULL: the scene's */
  const char *out;      /* --out; NULL: out/<scene>-<path> */
  int         threads;  /* --threads; 0: all */
  double      until;    /* --until, s; INFINITY: time.end of the scene */
  bool        quick, time, quiet, force, markdown;
  int         n_sets; /* --set key.path=value, in order */
  const char *sets[MAX_SETS];
  int         n_ladders; /* --refine of study, --sweep of stress: KEY=VALUE,VALUE,... */
  const char *ladders[MAX_LADDERS];
};

#endif
