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
  const char *rungs[GRIDS]; /* variants of the scene, coarse to fine, in place of `grids` */
};

/* runs a scene into a folder of its own and reads one metric of its summary */
static double error_of(const struct ladder *ladder, int rung)
{
  char               folder[] = "/tmp/check_order_XXXXXX", path[128], command[128], scene[128];
  const char        *variant = ladder->rungs[rung];
  cJSON             *summary;
  struct run_options options = {.argument = scene,
                                .fluid = ladder->fluid,
                                .out = folder,
                                .threads = 1,
                                .until = INFINITY,
                                .quiet = true,
                                .force = true,
                                .n_sets = variant ? 0 : 1,
                                .sets = {grids[rung]}};
  snprintf(scene, sizeof scene, "%s%s", ladder->scene, variant ? variant : "");
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
  printf("%s, %s, %s\n", ladder->scene, ladder->sets[0] ? ladder->sets[0] : "as it is", ladder->metric);
  for (int i = 0; i < GRIDS; i++) {
    double error = error_of(ladder, i);
    printf("  %s  error %.3e", ladder->rungs[i] ? ladder->rungs[i] : grids[i], error);
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

/* theta = 1/2 leaves pressure that swings */
#define SOUND "numerics.theta=0.5", "metrics.p_rms_0.5.scale=1e9", "metrics.p_rms_1.scale=1e9"

static const struct ladder ladders[] = {
    {"bar_vibration", NULL, "u_end_rms", 1.8, {"numerics.basis=quadratic", SLOW}, {NULL}},
    {"bar_vibration", NULL, "u_end_rms", 1.8, {"numerics.basis=cubic", SLOW}, {NULL}},
    {"bar_vibration", NULL, "u_end_rms", 1.8, {"numerics.basis=gimp", SLOW}, {NULL}},
    {"bar_vibration", NULL, "u_rms", 1.8, {"numerics.basis=quadratic", SLOW}, {NULL}},
    {"terzaghi_column", "ice", "p_rms_0.1", 1.8, {"numerics.basis=quadratic", LIGHT, CREEPING}, {NULL}},
    {"terzaghi_column", "ice", "p_rms_0.1", 1.8, {"numerics.basis=cubic", LIGHT, CREEPING}, {NULL}},
    {"terzaghi_column", "twopoint", "p_rms_0.1", 1.8, {"numerics.basis=cubic", LIGHT, RINGING}, {NULL}},
    {"heated_bar", NULL, "t_rms_0.1", 1.8, {"numerics.basis=linear", STEADY}, {NULL}},
    {"heated_bar", NULL, "t_rms_0.1", 1.8, {"numerics.basis=gimp", STEADY}, {NULL}},
    {"heated_bar", NULL, "t_rms_0.1", 1.8, {"numerics.basis=quadratic", STEADY}, {NULL}},
    {"heated_bar", NULL, "t_rms_0.1", 1.8, {"numerics.basis=cubic", STEADY}, {NULL}},
    {"heated_bar+fixed", NULL, "t_rms_0.05", 1.8, {"numerics.basis=quadratic", STEADY}, {NULL}},
    {"heated_bar+fixed", NULL, "t_rms_0.05", 1.8, {"numerics.basis=cubic", STEADY}, {NULL}},
    {"heated_bar+flux", NULL, "t_max_0.1", 1.8, {"numerics.basis=quadratic", STEADY}, {NULL}},
    {"heated_bar+flux", NULL, "t_max_0.1", 1.8, {"numerics.basis=cubic", STEADY}, {NULL}},
    {"taylor_green", "ice", "kinetic_1", 1.9, {NULL}, {"+n16", "+n32", ""}},
    {"taylor_green", "ice", "vel_rms_1", 1.9, {NULL}, {"+n16", "+n32", ""}},
    {"taylor_green", "ice", "vel_rms_1", 1.9, {SOUND}, {"+box+n16", "+box+n32", "+box"}},
    {"poiseuille", "ice", "rms_1", 1.8, {"time.end=1"}, {"+n16", "", "+n64"}},
    {"acoustic_pulse", "ice", "p_rms", 1.8, {NULL}, {"+h200", "", "+h800"}},
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
