/* Roughness of a field: standard deviation of h2 times its Laplacian. Points are first averaged at nodes with cubic
 * splines, whatever basis the run has, so that runs of different numerics are judged alike. */
#include "run/metric_parts.h"

#include "core/parallel.h"

#include <math.h>

/* share of a full node's points from which on its average counts */
static const double full = 0.7;

/* cubic B-spline of the distance, in h */
static double spline(double z)
{
  double r = fabs(z), q = 2 - r;
  return r < 1 ? 2.0 / 3 - r * r * (1 - 0.5 * r) : r < 2 ? q * q * q / 6 : 0;
}

/* the 4 nodes around x along an axis and their weights; one where the grid is one cell wide */
static int nodes_along(const struct grid *g, int d, double x, int *first, double w[4])
{
  double s = (x - g->min[d]) / g->h;
  *first = d < g->dim && g->n[d] > 1 ? (int)floor(s) - 1 : 0;
  if (d >= g->dim || g->n[d] == 1) {
    w[0] = 1;
    return 1;
  }
  for (int i = 0; i < 4; i++) w[i] = spline(s - *first - i);
  return 4;
}

void metric_spread(const struct grid *g, const double x[3], double value, double *sums)
{
  int    first[3], n[3];
  double w[3][4];
  for (int d = 0; d < 3; d++) n[d] = nodes_along(g, d, x[d], &first[d], w[d]);
  for (int k = 0; k < n[2]; k++)
    for (int j = 0; j < n[1]; j++)
      for (int i = 0; i < n[0]; i++) {
        long   node = grid_at(g, first[0] + i, first[1] + j, first[2] + k);
        double weight = w[0][i] * w[1][j] * w[2][k];
        sums[node] += weight * value;
        sums[g->size + node] += weight;
      }
}

/* a node and all around it hold enough: no wall and no surface cuts off what it averages */
static bool whole(const struct grid *g, const double *weight, double enough, long node)
{
  int reach[3];
  for (int d = 0; d < 3; d++) reach[d] = d < g->dim && g->n[d] > 1;
  for (int k = -reach[2]; k <= reach[2]; k++)
    for (int j = -reach[1]; j <= reach[1]; j++)
      for (int i = -reach[0]; i <= reach[0]; i++)
        if (!(weight[node + i * g->stride[0] + j * g->stride[1] + k * g->stride[2]] >= enough)) return false;
  return true;
}

double *metric_finish_spread(const struct sim *sim, double *sums)
{
  const struct grid *g = &sim->grid;
  const struct box   nodes = grid_nodes(g);
  double             enough = full, *weight = sums + g->size, *mean = sums + 2 * g->size;
  for (int d = 0; d < g->dim; d++) enough *= sim->scene->numerics.points_per_axis[d];
  for (long i = 0; i < g->size; i++) mean[i] = NAN;
  FOR_BOX_SERIAL(g, nodes, i)
  if (whole(g, weight, enough, i)) mean[i] = sums[i] / weight[i];
  return mean;
}

/* h2 times the Laplacian; NaN where a neighbour does not count */
static double laplacian(const struct grid *g, const double *difference, long c)
{
  double sum = 0;
  for (int d = 0; d < g->dim; d++)
    if (g->n[d] > 1) sum += difference[c - g->stride[d]] + difference[c + g->stride[d]] - 2 * difference[c];
  return sum;
}

double metric_roughness(const struct grid *g, double *difference)
{
  const struct box cells = grid_cells(g);
  double           sum = 0, squares = 0;
  long             n = 0;
  grid_fill_periodic(g, 1, difference);
  FOR_BOX_SERIAL(g, cells, c)
  {
    double l = laplacian(g, difference, c);
    if (isnan(l)) continue;
    sum += l, squares += l * l, n++;
  }
  return n > 0 ? sqrt(fmax(squares / n - sum / n * (sum / n), 0)) : NAN;
}
