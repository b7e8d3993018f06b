/* What a skeleton law costs: ns per point and step on one thread, for points that stay elastic and for points that all
 * yield. `mpm.update_stress` adds the strain and the traffic of the points. */
#include "constitutive/constitutive.h"

#include <omp.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
  BATCH = 64,
  BATCHES = 16,
  N = BATCH * BATCHES,
  STEPS = 10,
  WARM_UP = 50,
  REPEATS = 200,
  MAX_HISTORY = 16,
  SETTINGS = 12
};

struct setting {
  const char *name;
  double      value; /* of a choice: the number of its word */
};

struct job {
  const char    *law, *what;
  double         pressure, strain; /* Pa, at the start; size of a step */
  struct setting settings[SETTINGS];
};

#define SAND                                                                                                           \
  {"young", 1e7}, { "poisson", 0.3 }
#define SOFT                                                                                                           \
  {"residual_friction_angle_deg", 10}, { "softening_end", 1e3 }
#define CLAY                                                                                                           \
  {"kappa", 0.05}, {"lambda", 0.25}, {"M", 0.9}, {"poisson", 0.3}, { "void_ratio", 1.2 }
#define GRAINS                                                                                                         \
  {"mu_s", 0.38}, {"mu_2", 0.64}, {"grain_diameter", 1e-3}, { "density", 2500 }
static const struct job jobs[] = {
    {"linear_elastic", "", 1e5, 1e-9, {SAND}},
    {"mohr_coulomb", "elastic", 1e5, 1e-9, {SAND, {"friction_angle_deg", 30}}},
    {"mohr_coulomb", "elastic, softens", 1e5, 1e-9, {SAND, {"friction_angle_deg", 30}, SOFT}},
    {"mohr_coulomb", "yields", 1e5, 1e-4, {SAND, {"friction_angle_deg", 30}}},
    {"mohr_coulomb",
     "yields, cut-off",
     -1e3,
     1e-4,
     {SAND, {"friction_angle_deg", 30}, {"tension_strength", 0}, {"cohesion", 1e3}}},
    {"mohr_coulomb", "yields, softens", 1e5, 1e-4, {SAND, {"friction_angle_deg", 30}, SOFT}},
    {"mohr_coulomb", "yields, menetrey_willam", 1e5, 1e-4, {SAND, {"friction_angle_deg", 30}, {"flow", 1}}},
    {"mohr_coulomb",
     "yields, menetrey_willam, cohesion",
     1e5,
     1e-4,
     {SAND, {"friction_angle_deg", 30}, {"dilation_angle_deg", 10}, {"cohesion", 1e3}, {"flow", 1}}},
    {"drucker_prager", "elastic", 1e5, 1e-9, {SAND, {"friction_angle_deg", 30}}},
    {"drucker_prager", "yields", 1e5, 1e-4, {SAND, {"friction_angle_deg", 30}}},
    {"von_mises", "elastic", 1e5, 1e-9, {SAND, {"shear_strength", 1e4}}},
    {"von_mises", "yields", 1e5, 1e-4, {SAND, {"shear_strength", 1e4}}},
    {"von_mises", "yields, softens", 1e5, 1e-4, {SAND, {"shear_strength", 1e4}, {"sensitivity", 5}}},
    {"cam_clay", "elastic", 1e5, 1e-9, {CLAY, {"overconsolidation_ratio", 2}}},
    {"cam_clay", "yields", 1e5, 1e-4, {CLAY}},
    {"mu_i", "elastic", 1e5, 1e-9, {SAND, GRAINS}},
    {"mu_i", "yields", 1e5, 1e-4, {SAND, GRAINS}},
};

static double random_number(uint64_t *state)
{
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return (double)(int64_t)*state / 9.223372036854775808e18;
}

static double value_of(const struct job *job, const struct param *p)
{
  for (const struct setting *s = job->settings; s->name; s++)
    if (strcmp(s->name, p->name) == 0) return s->value;
  if (p->type == PARAM_CHOICE) return 0;
  return strcmp(p->fallback, "null") == 0 ? INFINITY : strtod(p->fallback, NULL);
}

static void fill(const struct job *job, const struct param *table, char *prm)
{
  for (const struct param *p = table; p->name; p++) {
    double value = value_of(job, p);
    int    word = (int)value;
    if (p->type == PARAM_CHOICE)
      memcpy(prm + p->offset, &word, sizeof word);
    else
      memcpy(prm + p->offset, &value, sizeof value);
  }
}

static double dF[N][9], stress[N][6], history[N * MAX_HISTORY], work[N];

/* every point has its own strain without change of volume, again and again */
static void start(const struct job *job, const struct constitutive_model *law, const void *prm)
{
  uint64_t seed = 1;
  for (int i = 0; i < N; i++) {
    for (int k = 0; k < 9; k++) dF[i][k] = job->strain * random_number(&seed);
    double mean = (dF[i][0] + dF[i][4] + dF[i][8]) / 3.0;
    for (int k = 0; k < 9; k += 4) dF[i][k] += 1.0 - mean;
    for (int k = 0; k < 6; k++) stress[i][k] = k < 3 ? -job->pressure : 0.0;
  }
  memset(history, 0, sizeof history);
  if (law->start) law->start(prm, N, stress[0], history);
}

/* s of a step of all points */
static double measure(const struct constitutive_model *law, const void *prm)
{
  double begin = omp_get_wtime();
  for (int step = 0; step < STEPS; step++)
    for (int p = 0; p < N; p += BATCH)
      law->update(prm, BATCH, 1e-3, dF[p], dF[p], stress[p], &history[p * law->n_history], &work[p]);
  return (omp_get_wtime() - begin) / STEPS;
}

int main(void)
{
  for (size_t j = 0; j < sizeof jobs / sizeof *jobs; j++) {
    const struct job                *job = &jobs[j];
    const struct constitutive_model *law = constitutive_find(job->law);
    double                           prm[64] = {0}, best = INFINITY;
    int                              yielding = 0;
    fill(job, law->params, (char *)prm);
    start(job, law, prm);
    for (int repeat = 0; repeat < WARM_UP; repeat++) measure(law, prm); /* until all yield */
    for (int repeat = 0; repeat < REPEATS; repeat++) best = fmin(best, measure(law, prm));
    for (int i = 0; i < N; i++) yielding += work[i] > 0.0;
    printf("%-16s %-34s %6.1f ns per point, %3.0f %% yield\n", job->law, job->what, 1e9 * best / N,
           100.0 * yielding / N);
  }
  return 0;
}
