/* What a start at rest left: how far from balance it was found, and how fast the solid is after the first steps. */
#include "run/start_check.h"

#include "mpm/at_rest.h"
#include "mpm/mpm.h"

#include <math.h>

/* share of the velocity of free fall that the fastest point may have */
static const double fastest = 0.05;

void start_check_step(const struct sim *sim, struct start_motion *motion)
{
  const struct mpm *m = mpm_of(sim);
  double            up[3], g;
  if (!m || !m->rest.computed || sim->step > START_CHECK_STEPS) return;
  motion->speed = fmax(motion->speed, m->now.speed);
  if (sim->step < START_CHECK_STEPS) return;
  at_rest_up(sim->scene, up, &g);
  motion->fall = g * sim->t;
}

static bool zero(const struct function velocity[3])
{
  for (int d = 0; d < 3; d++)
    if (velocity[d].expression || velocity[d].constant != 0) return false;
  return true;
}

/* no obstacle moves, and none comes or goes until t s: a gate that opens lets the solid go */
static bool obstacles_stand(const struct scene *scene, double t)
{
  for (int i = 0; i < scene->n_obstacles; i++) {
    const struct obstacle *o = &scene->obstacles[i];
    if (!zero(o->velocity) || o->until <= t || (o->from > 0 && o->from <= t)) return false;
  }
  return true;
}

/* nothing pushes, no wall moves until t s, gravity stays as it is, nothing starts with a velocity */
static bool stands_still(const struct scene *scene, double t)
{
  if (scene->n_loads > 0 || !zero(scene->fluid.velocity)) return false;
  for (int d = 0; d < scene->dim; d++)
    if (scene->gravity[d].expression) return false;
  for (int s = 0; s < scene->n_solids; s++)
    if (!zero(scene->solids[s].velocity)) return false;
  for (int side = 0; side < 2 * scene->dim; side++)
    if (!zero(scene->solid_side[side].velocity) || scene->fluid_side[side].kind == SIDE_VELOCITY) return false;
  return obstacles_stand(scene, t);
}

void start_check_fill(const struct sim *sim, const struct start_motion *motion, struct start_record *record)
{
  const struct mpm *m = mpm_of(sim);
  double            up[3], g;
  at_rest_up(sim->scene, up, &g);
  *record = (struct start_record){0};
  if (!m || !m->rest.computed) return;
  *record = (struct start_record){.computed = true,
                                  .settled = m->rest.settled,
                                  .still = stands_still(sim->scene, motion->fall / g),
                                  .steps = m->rest.steps,
                                  .column = m->rest.column,
                                  .unbalanced = m->rest.unbalanced,
                                  .motion = *motion};
  record->moves = record->still && motion->speed > fastest * motion->fall && motion->fall > 0;
}

void start_check_print(const struct start_record *r, FILE *out)
{
  if (!r->computed) return;
  if (r->motion.fall > 0 && r->still) {
    fprintf(out, "start at rest: largest velocity of the solid after %d steps %.2g m/s, %.2g of free fall%s\n",
            START_CHECK_STEPS, r->motion.speed, r->motion.speed / r->motion.fall,
            r->moves ? "; WARNING: this is no state of rest" : "");
    return;
  }
  if (r->motion.fall > 0 || (r->settled && r->steps == 0)) return;
  fprintf(out, "start at rest: columns leave %.2g of the weight out of balance, ", r->column);
  if (r->steps == 0)
    fprintf(out, "and numerics.rest_steps is 0\n");
  else if (r->settled)
    fprintf(out, "%d steps of the static solve %.2g\n", r->steps, r->unbalanced);
  else
    fprintf(out,
            "%d steps of the static solve still %.2g; WARNING: nothing holds this solid, or numerics.rest_steps are "
            "too few: it moves from the start\n",
            r->steps, r->unbalanced);
}
