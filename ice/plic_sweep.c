/* Transport of the liquid along one axis with fluxes that its planes cut off. theory 4.9, after Weymouth and Yue 2010
 */
#include "ice/plic.h"

#include "core/memory.h"
#include "core/parallel.h"

enum { FILLED = 1, SPRAY = 2 };

enum status plic_create(const struct grid *grid, const double *pore, struct plic *plic)
{
  *plic = (struct plic){.grid = grid, .pore = pore};
  return NEW(&plic->state, grid->size);
}

void plic_destroy(struct plic *plic) { memory_free(&plic->state); }

static inline double lesser(double a, double b) { return a < b ? a : b; }
static inline double within(double lo, double x, double hi) { return x < lo ? lo : x > hi ? hi : x; }

/* more than half full */
static inline bool filled(const struct plic *p, const double *fill, long cell)
{
  return p->pore[cell] > 0 && fill[cell] > 0.5;
}

/* whether a filled cell touches this one, be it at a corner */
static bool touched(const struct plic *p, const double *fill, long cell)
{
  const struct grid *g = p->grid;
  int                layers = g->dim == 3 ? 1 : 0;
  bool               found = false;
  for (int k = -layers; k <= layers; k++)
    for (int j = -1; j <= 1; j++)
      for (int i = -1; i <= 1; i++)
        found = found || filled(p, fill, cell + i * g->stride[0] + j * g->stride[1] + k * g->stride[2]);
  return found;
}

void plic_begin(struct plic *p, double *fill)
{
  const struct grid *g = p->grid;
  struct box         near = grid_cells(g);
  for (int d = 0; d < g->dim; d++) {
    near.lo[d]--;
    near.hi[d]++;
  }
  grid_fill_periodic(g, 1, fill);
  FOR_BOX(g, near, c)
  {
    p->state[c] = filled(p, fill, c) ? FILLED : 0;
    if (p->pore[c] > 0 && plic_mixed(fill[c]) && !touched(p, fill, c)) p->state[c] = SPRAY;
  }
}

bool plic_is_spray(const struct plic *p, long cell) { return p->state[cell] & SPRAY; }

int plic_axis(const struct grid *g, long step, int k)
{
  static const int order[6][3] = {{0, 1, 2}, {2, 1, 0}, {1, 2, 0}, {0, 2, 1}, {2, 0, 1}, {1, 0, 2}};
  return g->dim == 2 ? (int)((step + k) % 2) : order[step % 6][k];
}

/* fluxes of cells without a plane: the share of liquid in the cell that they come from; r = dt/h */
static void pass_mixed(const struct plic *p, int axis, double r, const double *flux, const double *fill, double *passed)
{
  const struct grid *g = p->grid;
  struct box         faces = grid_faces(g, axis);
  long               st = g->stride[axis];
  FOR_BOX(g, faces, f)
  {
    double up = lesser(r * flux[f], p->pore[f - st]), down = lesser(-r * flux[f], p->pore[f]);
    double low = up * within(0, fill[f - st], 1), high = -down * within(0, fill[f], 1);
    passed[f] = flux[f] > 0 ? low : flux[f] < 0 ? high : 0;
  }
}

/* liquid in the slab that leaves a cell through one face: not more than it has, nor less than void leaves over */
static double leaves(const struct plane *q, int axis, bool upper, double width, double fill)
{
  double least = fill + width - 1;
  return within(least > 0 ? least : 0, plic_slab(q, axis, upper, width), lesser(width, fill));
}

/* fluxes of cells with a plane: the liquid in the slab that leaves */
static void pass_cut(const struct plic *p, int axis, double r, const double *flux, const double *fill, double *passed)
{
  const struct grid *g = p->grid;
  struct box         donors = grid_cells(g);
  long               st = g->stride[axis];
  donors.lo[axis]--;
  donors.hi[axis]++;
  FOR_BOX(g, donors, c)
  {
    if (!plic_mixed(fill[c]) || p->state[c] & SPRAY || !(p->pore[c] > 0)) continue;
    double       pore = p->pore[c], down = -r * flux[c] / pore, up = r * flux[c + st] / pore;
    struct plane q;
    if (down <= 0 && up <= 0) continue;
    plic_reconstruct(p, fill, c, &q);
    if (down > 0) passed[c] = -pore * leaves(&q, axis, false, lesser(1, down), fill[c]);
    if (up > 0) passed[c + st] = pore * leaves(&q, axis, true, lesser(1, up), fill[c]);
  }
}

void plic_sweep(const struct plic *p, int axis, double dt, const double *flux, double *fill, double *passed)
{
  const struct grid *g = p->grid;
  struct box         cells = grid_cells(g);
  long               st = g->stride[axis];
  double             r = dt / g->h;
  grid_fill_periodic(g, 1, fill);
  pass_mixed(p, axis, r, flux, fill, passed);
  pass_cut(p, axis, r, flux, fill, passed);
  FOR_BOX(g, cells, c)
  {
    if (!(p->pore[c] > 0)) continue;
    double swept = p->state[c] & FILLED ? r * (flux[c + st] - flux[c]) : 0;
    fill[c] += (swept - (passed[c + st] - passed[c])) / p->pore[c];
  }
  grid_fill_periodic(g, 1, fill);
}
