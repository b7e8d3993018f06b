/* The solid's face towards the fluids: its stages, when each is needed, its fields. Read this first. */
#include "coupling/stages.h"

#include "constitutive/constitutive.h"
#include "core/parallel.h"
#include "mpm/mpm.h"

#include <math.h>

static bool needed(const struct scene *sc) { return sc->fluid.present && sc->n_solids > 0; }
static bool on_faces(const struct scene *sc) { return sc->fluid.path->meets_at == AT_FACE; }

static int count_media(const struct scene *sc, int *last)
{
  bool used[256] = {false};
  int  n = 0;
  for (int s = 0; s < sc->n_solids; s++) used[sc->solids[s].material] = true;
  for (int m = 0; m < sc->n_materials; m++)
    if (used[m] && sc->materials[m].porosity > 0) {
      n++;
      *last = m;
    }
  return n;
}

static bool several_media(const struct scene *sc)
{
  int last;
  return count_media(sc, &last) > 1;
}

static const struct field fields[] = {
#define FIELD(...) FIELD_ROW(struct coupling, __VA_ARGS__)
#include "coupling/fields.def"
#undef FIELD
};

static const struct stage stages[] = {
    {"coupling.gather_volumes", SLOT_volumes, "x_p volume_p volume_solid_p room_nc", "solid_nc bulk_nc", "2.1",
     "always with a fluid", NULL, coupling_gather_volumes, NULL},
    {"coupling.gather_media", SLOT_volumes, "x_p volume_p", "conductance_nc fineness_nc", "2.1",
     "only with several porous materials", several_media, coupling_gather_media, NULL},
    {"coupling.fill_cells", SLOT_volume_fractions, "solid_nc bulk_nc room_nc fluid_fill_nc fluid_reach_nc",
     "grains_share_nc fill_nc porosity_cc porosity_fc fill_fc medium_porosity_fc", "2.1",
     "only when the fluid lives in cells", on_faces, coupling_fill_cells, NULL},
    {"coupling.push_solid", SLOT_push_solid, "dmom_nc", "force_nc", "2.4", "only when a solid moves", mpm_solid_moves,
     coupling_push_solid, NULL},
};

static enum status create(struct sim *sim, void *state)
{
  struct coupling  *c = state;
  const struct mpm *m = mpm_of(sim);
  struct box        all = grid_all(&sim->grid);
  int               last = 0;
  c->several_media = count_media(sim->scene, &last) > 1;
  c->permeability = coupling_permeability(sim->scene, &sim->scene->materials[last]);
  c->diameter = sim->scene->materials[last].grain_diameter;
  FOR_BOX_SERIAL(&sim->grid, all, n) c->room_nc[n] = boundary_room(&m->kernel_grid, sim->scene->numerics.basis, n);
  coupling_find_rooms(sim, c, 0);
  TRY(coupling_gather_volumes(sim, 0));
  if (c->several_media) TRY(coupling_gather_media(sim, 0));
  return OK;
}

const struct module module_coupling = {
    .name = "coupling",
    .needed = needed,
    .fields = fields,
    .n_fields = sizeof fields / sizeof *fields,
    .stages = stages,
    .n_stages = sizeof stages / sizeof *stages,
    .state_size = sizeof(struct coupling),
    .create = create,
};
