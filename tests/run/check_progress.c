/* Asking a run to stop: told twice at once it is one request, a later one ends the program. */
#include "run/progress.h"
#include "tests/scene_run.h"

#include <signal.h>
#include <sys/wait.h>

/* Waits `s` on its own: a signal that is handled here cuts no sleep short. */
static void wait_for(double s)
{
  for (double start = progress_clock(); progress_clock() < start + s;) usleep(10000);
}

/* Exit status of a child that is asked twice, `pause` s apart; 0: it heard that and went on. */
static int ask_twice(double pause)
{
  int   how;
  pid_t child = fork();
  if (child == 0) {
    progress_catch_signals();
    bool before = progress_stop_asked();
    raise(SIGINT);
    wait_for(pause);
    raise(SIGTERM);
    _exit(!before && progress_stop_asked() ? 0 : 1);
  }
  ck_assert_int_eq(waitpid(child, &how, 0), child);
  ck_assert(WIFEXITED(how));
  return WEXITSTATUS(how);
}

START_TEST(the_same_request) { ck_assert_int_eq(ask_twice(0), 0); }
END_TEST

START_TEST(a_later_request) { ck_assert_int_eq(ask_twice(1.1), 128 + SIGTERM); }
END_TEST

int main(void)
{
  Suite *suite = suite_create("progress");
  TCase *tests = tcase_create("stop");
  tcase_add_test(tests, the_same_request);
  tcase_add_test(tests, a_later_request);
  suite_add_tcase(suite, tests);
  return run_suite(suite);
}
