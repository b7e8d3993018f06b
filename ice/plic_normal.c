/* Planes from the fill of the cells around. In 2D the best of seven normals, in 3D the better of two. theory 4.9 */
#include "ice/plic.h"

#include <math.h>

enum {
  MOST = 27,    /* cells of a stencil */
  LANES = 8,    /* seven candidates in 2D and one twice: loops over them become vectors */
  PER_AXIS = 3, /* of them from the columns along one axis */
};

/* the cells around one; closed ones count for nothing */
struct stencil {
  int    dim, centre;
  double fill[MOST], open[MOST]; /* open: 1 or 0; fill of closed cells is 0 */
};
static const int step[3] = {1, 3, 9};

/* normals that may be chosen, 2D */
struct candidates {
  double x[LANES], y[LANES], error[LANES];
};

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
static void slopes(const struct stencil *s, int a, int t, bool liquid_low, double slope[PER_AXIS])
{
  int    c = s->centre;
  bool   lower = s->open[c - t] > 0, upper = s->open[c + t] > 0;
  double h = height(s, c, a, liquid_low), down = lower ? h - height(s, c - t, a, liquid_low) : 0,
         up = upper ? height(s, c + t, a, liquid_low) - h : 0;
  slope[0] = lower && upper ? 0.5 * (down + up) : down + up;
  slope[1] = lower ? down : up;
  slope[2] = upper ? up : down;
}

/* direction out of the liquid along an axis from the gradient of the fill */
static inline double outward(double gradient) { return gradient < 0 ? 1 : gradient > 0 ? -1 : 0; }

/* ---- 2D ---- */

/* area below the line at distance a <= 1/2 from the corner; n_x >= n_y >= 0 after reflection */
static inline double area(double less, double inverse_less, double inverse_more, double a)
{
  return (a < less ? 0.5 * a * a * inverse_less : a - 0.5 * less) * inverse_more;
}

/* square of what the line with this offset from a neighbour's centre misses there */
static inline double misfit(double less, double inverse_less, double inverse_more, double offset, double fill)
{
  double a = 0.5 - fabs(offset), v = area(less, inverse_less, inverse_more, a > 0 ? a : 0);
  double miss = (offset > 0 ? 1 - v : v) - fill;
  return miss * miss;
}

/* how far each candidate misses the fill of the four cells beside this one */
static void judge(const struct stencil *s, struct candidates *c)
{
  double own = s->fill[4], v = own > 0.5 ? 1 - own : own, sign = own > 0.5 ? 1 : -1;
  for (int i = 0; i < LANES; i++) {
    double size = fabs(c->x[i]) + fabs(c->y[i]), x = c->x[i] / size, y = c->y[i] / size;
    double less = fabs(x) < fabs(y) ? fabs(x) : fabs(y), more = 1 - less;
    double corner = sqrt(2 * less * more * v), flat = more * v + 0.5 * less;
    double d = sign * (0.5 - (flat < less ? corner : flat)), il = 1 / less, im = 1 / more;
    c->error[i] =
        (s->open[3] * misfit(less, il, im, d + x, s->fill[3]) + s->open[5] * misfit(less, il, im, d - x, s->fill[5])) +
        (s->open[1] * misfit(less, il, im, d + y, s->fill[1]) + s->open[7] * misfit(less, il, im, d - y, s->fill[7]));
    c->x[i] = x;
    c->y[i] = y;
  }
}

/* The best candidate; the mean of equally good ones, so that a symmetric fill keeps its symmetry. */
static void choose(const struct candidates *c, double normal[3])
{
  int best = 0;
  for (int i = 1; i < LANES; i++)
    if (c->error[i] < c->error[best]) best = i;
  normal[0] = normal[1] = normal[2] = 0;
  for (int i = best; i < LANES; i++) {
    if (!(c->error[i] <= c->error[best]) || c->x[i] * c->x[best] + c->y[i] * c->y[best] <= 0) continue;
    normal[0] += c->x[i];
    normal[1] += c->y[i];
  }
}

/* Youngs' normal, first and last, and those of the columns along both axes. Where the fill has no gradient along an
 * axis its columns have no top; one without any direction has no error that compares. */
static void normal_2d(const struct stencil *s, const double g[3], double normal[3])
{
  struct candidates c;
  double            along_x[PER_AXIS], along_y[PER_AXIS];
  bool              flat = fabs(g[0]) + fabs(g[1]) < 1e-12;
  slopes(s, step[0], step[1], g[0] <= 0, along_x);
  slopes(s, step[1], step[0], g[1] <= 0, along_y);
  c.x[0] = c.x[LANES - 1] = flat ? 0 : -g[0];
  c.y[0] = c.y[LANES - 1] = flat ? 1 : -g[1];
  for (int i = 0; i < PER_AXIS; i++) {
    c.x[1 + i] = outward(g[0]);
    c.y[1 + i] = -along_x[i];
    c.x[1 + PER_AXIS + i] = -along_y[i];
    c.y[1 + PER_AXIS + i] = outward(g[1]);
  }
  judge(s, &c);
  c.error[LANES - 1] = INFINITY;
  choose(&c, normal);
}

/* ---- 3D ---- */

static double largest(const double n[3]) { return fmax(fabs(n[0]), fmax(fabs(n[1]), fabs(n[2]))); }

/* Of the centred columns those whose normal is most along them; Youngs' normal where that is less so, unless closed
 * cells leave gaps in it. Aulisa et al. 2007 */
static void normal_3d(const struct stencil *s, const double g[3], double normal[3])
{
  double most = 0, open = 0;
  normal[0] = normal[2] = 0;
  normal[1] = 1;
  for (int a = 0; a < 3; a++) {
    int    t = (a + 1) % 3, u = (a + 2) % 3;
    double across[PER_AXIS], n[3];
    n[a] = outward(g[a]);
    slopes(s, step[a], step[t], g[a] <= 0, across);
    n[t] = -across[0];
    slopes(s, step[a], step[u], g[a] <= 0, across);
    n[u] = -across[0];
    if (n[a] == 0) continue;
    plic_normalise(n);
    if (fabs(n[a]) <= most) continue;
    most = fabs(n[a]);
    for (int d = 0; d < 3; d++) normal[d] = n[d];
  }
  double youngs[3] = {-g[0], -g[1], -g[2]};
  for (int i = 0; i < MOST; i++) open += s->open[i];
  if (largest(youngs) < 1e-12 || open < MOST) return;
  plic_normalise(youngs);
  if (largest(youngs) < most)
    for (int d = 0; d < 3; d++) normal[d] = youngs[d];
}

void plic_reconstruct(const struct plic *p, const double *fill, long cell, struct plane *plane)
{
  struct stencil s;
  double         g[3];
  gather(p, fill, cell, &s);
  for (int d = 0; d < s.dim; d++) g[d] = gradient(&s, d);
  (s.dim == 3 ? normal_3d : normal_2d)(&s, g, plane->normal);
  plic_normalise(plane->normal);
  plane->offset = plic_offset(plane->normal, s.fill[s.centre]);
}
