/* Implicit conduction of one or two phases with exchange between them:
 *   (C/dt + K + G) change - G change of the other = W that come in at the old temperatures,
 * K the phase's conductances with its sides, G the exchange. A step's matrix is well conditioned unless the step is
 * very long, so conjugate gradients need no multigrid; cells' 2 x 2 blocks as the preconditioner take care of a stiff
 * exchange. theory 4.12 */
#include "ice/heat.h"

#include "core/parallel.h"

#include <math.h>
#include <string.h>

enum { MOST_STEPS = 20000 };
/* K that the rest would warm its cell in the step: over the largest change, and over the temperature times the
 * stiffness of the step, where round-off ends it */
static const double tolerance = 1e-10, round_off = 1e-15;

/* sum over cells of a.b, row by row */
static double dot(const struct grid *g, struct heat *heat, const double *a, const double *b)
{
  struct box cells = grid_cells(g);
  double     sum = 0;
  PARALLEL_FOR
  for (long r = 0; r < box_rows(&cells); r++) {
    double own = 0;
    for (long c = box_row(g, &cells, r), end = c + box_length(&cells); c < end; c++) own += a[c] * b[c];
    heat->row_sum[r] = own;
  }
  for (long r = 0; r < box_rows(&cells); r++) sum += heat->row_sum[r];
  return sum;
}

/* diagonal of the matrix, W/K */
static void fill_diagonal(const struct grid *g, struct heat *heat, struct heat_phase *p, double dt)
{
  struct box cells = grid_cells(g);
  FOR_BOX(g, cells, c)
  {
    double sum = p->outside[c];
    for (int d = 0; d < g->dim; d++)
      sum += p->conductance[d * g->size + c] + p->conductance[d * g->size + c + g->stride[d]];
    p->diagonal[c] = p->capacity[c] / dt + sum + (heat->n_phases == 2 ? heat->exchange[c] : 0);
  }
}

/* image = matrix times search */
static void apply(const struct grid *g, struct heat *heat)
{
  struct box cells = grid_cells(g);
  for (int k = 0; k < heat->n_phases; k++) grid_fill_periodic(g, 1, heat->phase[k].search);
  for (int k = 0; k < heat->n_phases; k++) {
    struct heat_phase *p = &heat->phase[k];
    const double      *other = heat->n_phases == 2 ? heat->phase[1 - k].search : NULL, *x = p->search;
    FOR_BOX(g, cells, c)
    {
      double sum = 0;
      for (int d = 0; d < g->dim; d++) {
        const double *face = p->conductance + d * g->size;
        long          up = c + g->stride[d];
        sum += face[c] * x[c - g->stride[d]] + face[up] * x[up];
      }
      p->image[c] = p->diagonal[c] * x[c] - sum - (other ? heat->exchange[c] * other[c] : 0);
    }
  }
}

/* eased = rest with the block of every cell inverted */
static void ease(const struct grid *g, struct heat *heat)
{
  struct box         cells = grid_cells(g);
  struct heat_phase *a = &heat->phase[0], *b = &heat->phase[1];
  if (heat->n_phases == 1) {
    FOR_BOX(g, cells, c) a->eased[c] = a->rest[c] / a->diagonal[c];
    return;
  }
  FOR_BOX(g, cells, c)
  {
    double G = heat->exchange[c], det = a->diagonal[c] * b->diagonal[c] - G * G;
    a->eased[c] = (b->diagonal[c] * a->rest[c] + G * b->rest[c]) / det;
    b->eased[c] = (a->diagonal[c] * b->rest[c] + G * a->rest[c]) / det;
  }
}

/* what a step along the search does to change and rest */
static void advance(const struct grid *g, struct heat *heat, double length)
{
  struct box cells = grid_cells(g);
  for (int k = 0; k < heat->n_phases; k++) {
    struct heat_phase *p = &heat->phase[k];
    FOR_BOX(g, cells, c)
    {
      p->change[c] += length * p->search[c];
      p->rest[c] -= length * p->image[c];
    }
  }
}

static void turn(const struct grid *g, struct heat *heat, double keep)
{
  struct box cells = grid_cells(g);
  for (int k = 0; k < heat->n_phases; k++) {
    struct heat_phase *p = &heat->phase[k];
    FOR_BOX(g, cells, c) p->search[c] = p->eased[c] + keep * p->search[c];
  }
}

static double over_phases(const struct grid *g, struct heat *heat, size_t a, size_t b)
{
  double sum = 0;
  for (int k = 0; k < heat->n_phases; k++) {
    char *p = (char *)&heat->phase[k];
    sum += dot(g, heat, *(double **)(p + a), *(double **)(p + b));
  }
  return sum;
}

/* what is left to do, K, over what may be left */
static double left_over(const struct grid *g, const struct heat *heat, double dt)
{
  struct box cells = grid_cells(g);
  double     most = 0, change = 0, unseen = 0;
  for (int k = 0; k < heat->n_phases; k++) {
    const struct heat_phase *p = &heat->phase[k];
    FOR_BOX_SERIAL(g, cells, c)
    {
      double scale = dt / p->capacity[c];
      most = fmax(most, fabs(p->rest[c]) * scale);
      change = fmax(change, fabs(p->change[c]));
      unseen = fmax(unseen, p->diagonal[c] * scale * p->T[c]);
    }
  }
  return most / (tolerance * change + round_off * unseen);
}

#define DOT(a, b) over_phases(g, heat, offsetof(struct heat_phase, a), offsetof(struct heat_phase, b))

enum status heat_solve(const struct grid *g, struct heat *heat, double dt)
{
  for (int k = 0; k < heat->n_phases; k++) {
    memset(heat->phase[k].search, 0, (size_t)g->size * sizeof(double));
    fill_diagonal(g, heat, &heat->phase[k], dt);
  }
  ease(g, heat);
  turn(g, heat, 0);
  double now = DOT(rest, eased), left = left_over(g, heat, dt);
  for (int i = 0; i < MOST_STEPS && left > 1; i++) {
    apply(g, heat);
    advance(g, heat, now / DOT(search, image));
    ease(g, heat);
    double before = now;
    now = DOT(rest, eased);
    turn(g, heat, now / before);
    left = left_over(g, heat, dt);
  }
  if (left <= 1) return OK;
  return FAIL(ERR_SOLVER, "heat: %g times the residual that may be left, after %d iterations; lower numerics.dt_max",
              left, MOST_STEPS);
}
