/* Several fluids in a cell at one pressure: their densities and shares, and what each half of the cell holds.
 * theory 4.15 */
#include "ice/ice.h"

#include "core/parallel.h"
#include "eos/eos.h"

#include <math.h>
#include <string.h>

/* a fluid with more than this share of a cell fills it */
static const double full = 0.999;

enum { BLOCK = 64 };

/* what the fluids of a stretch of cells add up to */
struct sums {
  double volume[BLOCK], softness[BLOCK], mass[BLOCK], softest[BLOCK]; /* m3; m3/Pa; kg; 1/Pa */
};

/* densities of fluid k, its volume in place of its share, and the sums; cells [c0, c0 + n) */
static void add_fluid(const struct sim *sim, struct ice *ice, int k, long c0, int n, struct sums *sums)
{
  const struct fluid *fluid = scene_fluid(sim->scene, k);
  long                own = k * sim->grid.size + c0;
  double              kappa[BLOCK];
  fluid->eos->density(fluid->eos_params, n, ice->P_cc + c0, NULL, ice->rho_cc + own);
  fluid->eos->compressibility(fluid->eos_params, n, ice->P_cc + c0, NULL, kappa);
  for (int i = 0; i < n; i++) {
    double m = ice->mass_cc[own + i], volume = m / ice->rho_cc[own + i];
    ice->alpha_cc[own + i] = volume;
    sums->volume[i] += volume;
    sums->softness[i] += volume * kappa[i];
    sums->mass[i] += m;
    if (m > 0) sums->softest[i] = fmax(sums->softest[i], kappa[i]);
  }
}

static void mix_stretch(const struct sim *sim, struct ice *ice, long c0, int n)
{
  double      V = grid_cell_volume(&sim->grid);
  struct sums sums = {{0}, {0}, {0}, {0}};
  for (int k = 0; k < ice->n_fluids; k++) add_fluid(sim, ice, k, c0, n, &sums);
  for (int i = 0; i < n; i++) {
    double room = ice->porosity_cc[c0 + i] * V, volume = sums.volume[i];
    ice->defect_cc[c0 + i] = volume / room - 1;
    ice->mixture_cc[c0 + i] = sums.mass[i] / room;
    ice->soft_cc[c0 + i] = sums.softest[i];
    ice->kappa_cc[c0 + i] = sums.softness[i] / volume;
    for (int k = 0; k < ice->n_fluids; k++) ice->alpha_cc[k * sim->grid.size + c0 + i] /= volume;
  }
}

static unsigned char only_fluid(const struct grid *g, const struct ice *ice, long c)
{
  for (int k = 0; k < ice->n_fluids && ice->pore_cc[c] > 0; k++)
    if (ice->alpha_cc[k * g->size + c] > full) return (unsigned char)(k + 1);
  return 0;
}

void ice_find_only(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         all = grid_all(g);
  FOR_BOX(g, all, c) ice->only[c] = only_fluid(g, ice, c);
}

/* whether the plane of a cell is worth looking at */
bool ice_is_cut(const struct ice *ice, long c)
{
  return ice->pore_cc[c] > 0 && plic_mixed(ice->alpha_cc[c]) && !plic_is_spray(&ice->plic, c);
}

double ice_lower_share(const struct grid *g, const struct ice *ice, int axis, long c)
{
  struct plane plane;
  (void)g;
  if (!ice_is_cut(ice, c)) return 0.5 * ice->alpha_cc[c];
  plic_reconstruct(&ice->plic, ice->alpha_cc, c, &plane);
  return plic_slab(&plane, axis, false, 0.5);
}

/* a cell with a surface: each half has its own share of the first fluid; the others are as dense everywhere */
static void cut_cell(const struct grid *g, struct ice *ice, long c)
{
  double       share = ice->alpha_cc[c], room = ice->porosity_cc[c] * grid_cell_volume(g);
  double       first = ice->mass_cc[c] / room, dense = first / share, thin = (ice->mixture_cc[c] - first) / (1 - share);
  struct plane plane;
  plic_reconstruct(&ice->plic, ice->alpha_cc, c, &plane);
  for (int axis = 0; axis < g->dim; axis++) {
    double s = plic_slab(&plane, axis, false, 0.5);
    ice->lower_fc[axis * g->size + c] = s * dense + (0.5 - s) * thin;
    if (ice->cut_fc) ice->cut_fc[axis * g->size + c] = s;
  }
}

static void halve_cells(struct sim *sim, struct ice *ice)
{
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  plic_begin(&ice->plic, ice->alpha_cc);
  FOR_BOX(g, cells, c)
  {
    if (ice_is_cut(ice, c))
      cut_cell(g, ice, c);
    else
      for (int axis = 0; axis < g->dim; axis++) {
        ice->lower_fc[axis * g->size + c] = 0.5 * ice->mixture_cc[c];
        if (ice->cut_fc) ice->cut_fc[axis * g->size + c] = 0.5 * ice->alpha_cc[c];
      }
  }
  ice_fill_faces(sim, ice->lower_fc);
  if (ice->cut_fc) ice_fill_faces(sim, ice->cut_fc);
}

enum status ice_mix_fluids(struct sim *sim, double dt)
{
  (void)dt;
  struct ice        *ice = ice_of(sim);
  const struct grid *g = &sim->grid;
  struct box         cells = grid_cells(g);
  PARALLEL_FOR
  for (long r = 0; r < box_rows(&cells); r++) {
    long c0 = box_row(g, &cells, r);
    for (int i = 0; i < g->n[0]; i += BLOCK) mix_stretch(sim, ice, c0 + i, g->n[0] - i < BLOCK ? g->n[0] - i : BLOCK);
  }
  for (int k = 0; k < ice->n_fluids; k++) {
    grid_fill_periodic(g, 1, ice->rho_cc + k * g->size);
    grid_fill_periodic(g, 1, ice->mass_cc + k * g->size);
    grid_fill_periodic(g, 1, ice->alpha_cc + k * g->size);
  }
  grid_fill_periodic(g, 1, ice->P_cc);
  grid_fill_periodic(g, 1, ice->mixture_cc);
  grid_fill_periodic(g, g->dim, ice->vel_cc);
  ice_open_rooms(sim, ice);
  halve_cells(sim, ice);
  ice_find_only(sim, ice);
  memcpy(ice->vel_start_cc, ice->vel_cc, (size_t)(g->size * g->dim) * sizeof(double));
  return ice_check_range(sim, ice);
}
