/* Errors of whole runs against exact solutions on finer and finer grids: printed, and their order is held. Loads are so
 * small that the motion is linear, as the exact solutions are. */
#include "run/json.h"
#include "run/loop.h"
#include "tests/scene_run.h"

enum { GRIDS = 3, SETS = 12 };
static const char *const grids[GRIDS] = {"grid.h=0.04", "grid.h=0.02", "grid.h=0.01"};

struct ladder {
  const char *scene, *fluid, *metric;
  double      least_order;
  const char *sets[SETS];
};

/* runs a scene into a folder of its own and reads one metric of its summary */
static double error_of(const struct ladder *ladder, const char *grid)
{
  char               folder[] = "/tmp/check_order_XXXXXX", path[128], command[128];
  cJSON             *summary;
  struct run_options options = {.argument = ladder->scene,
                                .fluid = ladder->fluid,
                                .out = folder,
                                .threads = 1,
                                .until = INFINITY,
                                .quiet = true,
                                .force = true,
                                .n_sets = 1,
                                .sets = {grid}};
  for (int i = 0; i < SETS && ladder->sets[i]; i++) options.sets[options.n_sets++] = ladder->sets[i];
  ck_assert_ptr_nonnull(mkdtemp(folder));
  must(run_scene(&options));
  snprintf(path, sizeof path, "%s/summary.json", folder);
  must(json_load(path, &summary));
  snprintf(path, sizeof path, "metrics.%s.value", ladder->metric);
  const cJSON *value = json_find(summary, path);
  ck_assert(cJSON_IsNumber(value));
  double error = fabs(value->valuedouble);
  cJSON_Delete(summary);
  snprintf(command, sizeof command, "rm -r '%s'", folder);
  ck_assert_int_eq(system(command), 0);
  return error;
}

static void climb(const struct ladder *ladder)
{
  double last = 0, lowest = INFINITY;
  printf("%s, %s, %s\n", ladder->scene, ladder->sets[0], ladder->metric);
  for (int i = 0; i < GRIDS; i++) {
    double error = error_of(ladder, grids[i]);
    printf("  %s  error %.3e", grids[i], error);
    if (i > 0) printf("  order %.2f", log2(last / error));
    printf("\n");
    if (i > 0) lowest = fmin(lowest, log2(last / error));
    last = error;
  }
  fflush(stdout);
  ck_assert_double_ge(lowest, ladder->least_order);
}

#define SLOW "solids.bar.velocity=[\"1e-5*sin(pi*x/2)\", 0]", "references.theory.velocity=1e-5", "output.interval=1"
#define LIGHT                                                                                                          \
  "loads.top.traction=[0, -10]", "references.theory.load=10", "references.waves.load=10", "output.interval=10"
/* permeability: so low that inertia, which Terzaghi leaves out, is below the error; to T_v = 0.1 */
#define CREEPING "materials.sand.permeability=1e-4", "time.end=0.73"

/* the exact solution rings as the explicit path does; to T_v = 0.1 */
#define RINGING "metrics.p_rms_0.1.reference=waves.P", "time.end=0.07287429"

/* steps of the same share of their limit on every grid: no snapshots in between */
#define STEADY "output.interval=1565625"

static const struct ladder ladders[] = {
    {"bar_vibration", NULL, "u_end_rms", 1.8, {"numerics.basis=quadratic", SLOW}},
    {"bar_vibration", NULL, "u_end_rms", 1.8, {"numerics.basis=cubic", SLOW}},
    {"bar_vibration", NULL, "u_end_rms", 1.8, {"numerics.basis=gimp", SLOW}},
    {"bar_vibration", NULL, "u_rms", 1.8, {"numerics.basis=quadratic", SLOW}},
    {"terzaghi_column", "ice", "p_rms_0.1", 1.8, {"numerics.basis=quadratic", LIGHT, CREEPING}},
    {"terzaghi_column", "ice", "p_rms_0.1", 1.8, {"numerics.basis=cubic", LIGHT, CREEPING}},
    {"terzaghi_column", "twopoint", "p_rms_0.1", 1.8, {"numerics.basis=cubic", LIGHT, RINGING}},
    {"heated_bar", NULL, "t_rms_0.1", 1.8, {"numerics.basis=linear", STEADY}},
    {"heated_bar", NULL, "t_rms_0.1", 1.8, {"numerics.basis=gimp", STEADY}},
    {"heated_bar", NULL, "t_rms_0.1", 1.8, {"numerics.basis=quadratic", STEADY}},
    {"heated_bar", NULL, "t_rms_0.1", 1.8, {"numerics.basis=cubic", STEADY}},
    {"heated_bar+fixed", NULL, "t_rms_0.05", 1.8, {"numerics.basis=quadratic", STEADY}},
    {"heated_bar+fixed", NULL, "t_rms_0.05", 1.8, {"numerics.basis=cubic", STEADY}},
    {"heated_bar+flux", NULL, "t_max_0.1", 1.8, {"numerics.basis=quadratic", STEADY}},
    {"heated_bar+flux", NULL, "t_max_0.1", 1.8, {"numerics.basis=cubic", STEADY}},
};
enum { LADDERS = sizeof ladders / sizeof *ladders };

START_TEST(order) { climb(&ladders[_i]); }
END_TEST

int main(void)
{
  Suite *suite = suite_create("order");
  TCase *tcase = tcase_create("ladders");
  tcase_add_loop_test(tcase, order, 0, LADDERS);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
