/* Planes from the fill of the cells around: of Youngs' normal and those of columns the one whose plane fits best.
 * theory 4.9 */
#include "ice/plic.h"

#include "ice/plic_cell.h"

enum {
  MOST = 27,  /* cells of a stencil */
  SLOPES = 3, /* of columns across one axis */
};
static const double steep = 0.8; /* share of the steepest gradient from which on columns along an axis are tried */

/* the cells around one; closed ones count for nothing */
struct stencil {
  int    dim, centre;
  double fill[MOST], open[MOST]; /* open: 1 or 0; fill of closed cells is 0 */
};
static const int step[3] = {1, 3, 9};

static void gather(const struct plic *p, const double *fill, long cell, struct stencil *s)
{
  const struct grid *g = p->grid;
  int                layers = g->dim == 3 ? 1 : 0, n = 0;
  for (int k = -layers; k <= layers; k++)
    for (int j = -1; j <= 1; j++)
      for (int i = -1; i <= 1; i++, n++) {
        long   c = cell + i * g->stride[0] + j * g->stride[1] + k * g->stride[2];
        double f = fill[c];
        s->open[n] = p->pore[c] > 0;
        s->fill[n] = p->pore[c] > 0 ? (f < 0 ? 0 : f > 1 ? 1 : f) : 0;
      }
  s->dim = g->dim;
  s->centre = n / 2;
}

/* sum of the changes of fill between open cells along a line through `at`, and their number */
struct change {
  double sum, n;
};

static inline struct change along(const struct stencil *s, int at, int a)
{
  double low = s->open[at - a] * s->open[at], high = s->open[at] * s->open[at + a];
  double to_low = s->fill[at] - s->fill[at - a], to_high = s->fill[at + a] - s->fill[at];
  return (struct change){low * to_low + high * to_high, low + high};
}

static inline struct change both(struct change a, struct change b) { return (struct change){a.sum + b.sum, a.n + b.n}; }
static inline struct change around(const struct stencil *s, int t, int a)
{
  return both(along(s, s->centre - t, a), along(s, s->centre + t, a));
}

/* Youngs' gradient of the fill: changes along the lines of the stencil, weight 4 : 2 : 1 for the middle, edges,
 * corners. Opposite lines are added first, so that the result has the symmetry of the cells to the last bit. */
static double gradient(const struct stencil *s, int axis)
{
  int           a = step[axis], t = step[(axis + 1) % s->dim];
  struct change middle = along(s, s->centre, a), edges = around(s, t, a), corners = {0, 0};
  if (s->dim == 3) {
    int u = step[(axis + 2) % 3];
    edges = both(edges, around(s, u, a));
    corners = both(around(s, t + u, a), around(s, t - u, a));
  }
  double n = 4 * middle.n + 2 * edges.n + corners.n;
  return n > 0 ? (4 * middle.sum + 2 * edges.sum + corners.sum) / n : 0;
}

/* liquid in the column of three along a; a closed cell counts as full on the liquid's side */
static inline double height(const struct stencil *s, int at, int a, bool liquid_low)
{
  double low = s->fill[at - a] + (liquid_low ? 1 - s->open[at - a] : 0);
  double high = s->fill[at + a] + (liquid_low ? 0 : 1 - s->open[at + a]);
  return low + high + s->fill[at];
}

/* Slopes across t of the columns along a: centred, towards the lower, towards the upper side. Beside a closed cell all
 * are those of the other side. */
static void slopes(const struct stencil *s, int a, int t, bool liquid_low, double slope[SLOPES])
{
  int    c = s->centre;
  bool   lower = s->open[c - t] > 0, upper = s->open[c + t] > 0;
  double h = height(s, c, a, liquid_low), down = lower ? h - height(s, c - t, a, liquid_low) : 0,
         up = upper ? height(s, c + t, a, liquid_low) - h : 0;
  slope[0] = lower && upper ? 0.5 * (down + up) : down + up;
  slope[1] = lower ? down : up;
  slope[2] = upper ? up : down;
}

/* Squares of what a plane misses of the fill of the cells beside this one; only a part of them beyond `enough`. Cells
 * at edges and corners, which the plane need not reach, would round off corners and tips. */
static double misfit(const struct stencil *s, const double n[3], double enough)
{
  struct sorted m = sort(n);
  double        total = 0, offset = offset_of(&m, s->fill[s->centre]);
  for (int d = 0; d < s->dim && total <= enough; d++) {
    int    low = s->centre - step[d], high = s->centre + step[d];
    double to_low = volume_of(&m, offset + n[d]) - s->fill[low], to_high = volume_of(&m, offset - n[d]) - s->fill[high];
    total += s->open[low] * (to_low * to_low) + s->open[high] * (to_high * to_high);
  }
  return total;
}

/* the best normal so far */
struct choice {
  double normal[3], misfit;
};

/* takes a normal that fits better; adds one that fits as well, so that a symmetric fill keeps its symmetry */
static void try_normal(const struct stencil *s, double n[3], struct choice *best)
{
  plic_normalise(n);
  double *b = best->normal, e = misfit(s, n, best->misfit);
  bool    better = e < best->misfit, equal = e == best->misfit && n[0] * b[0] + n[1] * b[1] + n[2] * b[2] > 0;
  if (!better && !equal) return;
  for (int d = 0; d < 3; d++) b[d] = n[d] + (better ? 0 : b[d]);
  best->misfit = e;
}

/* normals of the columns along an axis; gradient: of the fill along it */
static void try_columns(const struct stencil *s, int axis, double gradient, struct choice *best)
{
  int    t = (axis + 1) % s->dim, u = (axis + 2) % 3;
  double along_t[SLOPES], along_u[SLOPES] = {0};
  bool   liquid_low = gradient < 0, space = s->dim == 3;
  slopes(s, step[axis], step[t], liquid_low, along_t);
  if (space) slopes(s, step[axis], step[u], liquid_low, along_u);
  for (int i = 0; i < SLOPES; i++)
    for (int j = 0; j < (space ? SLOPES : 1); j++) {
      double n[3] = {0, 0, 0};
      if (space) n[u] = -along_u[j];
      n[t] = -along_t[i];
      n[axis] = liquid_low ? 1 : -1;
      try_normal(s, n, best);
    }
}

void plic_reconstruct(const struct plic *p, const double *fill, long cell, struct plane *plane)
{
  struct stencil s;
  struct choice  best = {{0, 1, 0}, INFINITY}; /* of a cell whose neighbours do not say */
  double         g[3] = {0, 0, 0}, most = 0;
  gather(p, fill, cell, &s);
  for (int d = 0; d < s.dim; d++) {
    g[d] = gradient(&s, d);
    most = greater(most, fabs(g[d]));
  }
  if (most > 1e-12) {
    double youngs[3] = {-g[0], -g[1], -g[2]};
    try_normal(&s, youngs, &best);
    for (int d = 0; d < s.dim; d++)
      if (fabs(g[d]) >= steep * most) try_columns(&s, d, g[d], &best);
  }
  for (int d = 0; d < 3; d++) plane->normal[d] = best.normal[d];
  plic_normalise(plane->normal);
  plane->offset = plic_offset(plane->normal, s.fill[s.centre]);
}
