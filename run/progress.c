/* Tells how far a run is and when it will end, and hears when it is asked to stop. */
#include "run/progress.h"

#include <signal.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* s between two looks of a terminal and between two plain lines */
#define TERMINAL_PERIOD 0.2
#define PLAIN_PERIOD 10.0

/* s; a second request so soon is the first one told twice, as timeout(1) tells its child and then the whole group */
#define SAME_REQUEST 1.0

/* A signal can only reach us through globals; these two are the ones that are allowed. */
static volatile sig_atomic_t stop_asked;
static volatile double       first_asked; /* progress_clock */

static void on_signal(int number)
{
  double now = progress_clock(); /* may be called by a signal's handler */
  if (stop_asked && now > first_asked + SAME_REQUEST) _exit(128 + number);
  if (!stop_asked) first_asked = now;
  stop_asked = 1;
}

void progress_catch_signals(void)
{
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, NULL);
  sigaction(SIGTERM, &action, NULL);
}

bool progress_stop_asked(void) { return stop_asked != 0; }

double progress_clock(void)
{
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void progress_start(struct progress *progress, FILE *out, bool quiet, double t, double t_end, long step)
{
  double now = progress_clock();
  *progress = (struct progress){.out = out,
                                .quiet = quiet,
                                .terminal = isatty(fileno(out)) != 0,
                                .t_first = t,
                                .t_end = t_end,
                                .wall_first = now,
                                .wall_shown = now,
                                .step_first = step,
                                .step_shown = step,
                                .strays = -1};
}

/* "2 min 03 s": what is left, or has gone by */
static void print_span(FILE *out, double s)
{
  if (s < 60)
    fprintf(out, "%.0f s", s);
  else if (s < 3600)
    fprintf(out, "%d min %02d s", (int)(s / 60), (int)s % 60);
  else
    fprintf(out, "%d h %02d min", (int)(s / 3600), (int)(s / 60) % 60);
}

static void print_state(const struct progress *p, double now, double t, double dt, long step)
{
  double part = p->t_end > p->t_first ? (t - p->t_first) / (p->t_end - p->t_first) : 1;
  double spent = now - p->wall_first, since = now - p->wall_shown;
  fprintf(p->out, "Progress %.1f%%  t = %.6g s, dt = %.3g s, %.0f steps/s", 100 * t / p->t_end, t, dt,
          since > 0 ? (double)(step - p->step_shown) / since : 0);
  if (p->strays > 0) fprintf(p->out, ", %ld points left the grid", p->strays);
  if (part > 0) {
    fprintf(p->out, ", left ");
    print_span(p->out, spent * (1 - part) / part);
  }
}

static void print_finish(const struct progress *p, double now, double t)
{
  char      text[32];
  struct tm local;
  double    part = (t - p->t_first) / (p->t_end - p->t_first);
  if (!(part > 0)) return;
  time_t finish = time(NULL) + (time_t)((now - p->wall_first) * (1 - part) / part);
  localtime_r(&finish, &local);
  strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &local);
  fprintf(p->out, ", estimated finish %s", text);
}

void progress_step(struct progress *progress, double t, double dt, long step)
{
  struct progress *p = progress;
  if (p->quiet) return;
  double now = progress_clock();
  if (now - p->wall_shown < (p->terminal ? TERMINAL_PERIOD : PLAIN_PERIOD)) return;
  if (p->terminal) fprintf(p->out, "\r");
  print_state(p, now, t, dt, step);
  if (!p->terminal) print_finish(p, now, t);
  fprintf(p->out, p->terminal ? "\033[K" : "\n");
  fflush(p->out);
  p->wall_shown = now;
  p->step_shown = step;
}

void progress_end(struct progress *progress, double t, long step)
{
  const struct progress *p = progress;
  if (p->quiet) return;
  if (p->terminal) fprintf(p->out, "\r\033[K");
  fprintf(p->out, "Reached t = %.6g s after %ld steps in ", t, step - p->step_first);
  print_span(p->out, progress_clock() - p->wall_first);
  if (p->strays > 0) fprintf(p->out, "; %ld points left the grid", p->strays);
  fprintf(p->out, "\n");
  fflush(p->out);
}
