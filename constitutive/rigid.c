/* A skeleton that is held in its place: it has no stress and sets no mechanical limit of the time step. */
#include "constitutive/constitutive.h"

#include <string.h>

static const struct param params[] = {PARAM_END};

static int update(const void *prm, int n, double dt, const double *dF, const double *F, double *stress, double *history,
                  double *work)
{
  (void)prm, (void)dt, (void)dF, (void)F, (void)history;
  memset(stress, 0, 6 * (size_t)n * sizeof *stress);
  if (work) memset(work, 0, (size_t)n * sizeof *work);
  return 0;
}

static double wave_speed(const void *prm, int n, const double *rb, const double *stress, const double *history)
{
  (void)prm, (void)n, (void)rb, (void)stress, (void)history;
  return 0.0;
}

static void energy(const void *prm, int n, const double *F, const double *stress, const double *history, double *energy)
{
  (void)prm, (void)F, (void)stress, (void)history;
  memset(energy, 0, (size_t)n * sizeof *energy);
}

static double oedometer_modulus(const void *prm)
{
  (void)prm;
  return INFINITY;
}

static double lateral_ratio(const void *prm)
{
  (void)prm;
  return 0.0;
}

const struct constitutive_model constitutive_rigid = {
    .name = "rigid",
    .source = "1, Skeleton models",
    .params = params,
    .held = true,
    .update = update,
    .wave_speed = wave_speed,
    .energy = energy,
    .oedometer_modulus = oedometer_modulus,
    .lateral_ratio = lateral_ratio,
};
