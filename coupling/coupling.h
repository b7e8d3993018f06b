/* The solid's face towards the fluids: volume fractions and drag. Knows no path. */
#ifndef COUPLING_COUPLING_H
#define COUPLING_COUPLING_H

#include "core/sim.h"
#include "coupling/drag.h"

struct coupling {
#define FIELD FIELD_MEMBER
#include "coupling/fields.def"
#undef FIELD
  double permeability, diameter; /* m2, m: of the only porous material; several media have fields */
  bool   several_media;
};

extern const struct module module_coupling;

static inline struct coupling *coupling_of(const struct sim *sim) { return sim_state(sim, &module_coupling); }

/** Porosities of nodes, cells and faces from the volumes and fluid_fill_nc: a path that meets the solid at faces calls
 * it when it starts. */
enum status coupling_fill_cells(struct sim *sim, double dt) MUST_CHECK;

enum { DRAG_BATCH = 128 };

/** Resistance of n <= DRAG_BATCH places, K [n] kg/m3/s per volume of *space*, so that the force on the fluid per volume
 * is K (U_s - U_f). porosity [n]: of the space; fill, medium_porosity [n]; slip [n] m/s: |U_s - U_f|, velocities of the
 *  space's own porosity; permeability m2 and diameter m [n]. The skeleton resists the superficial velocity
 *  porosity*slip with its own law, over its share of the space: places in series add up exactly. theory 2.2 */
void coupling_drag(const struct scene *scene, const struct fluid *fluid, int n, const double *porosity,
                   const double *fill, const double *medium_porosity, const double *slip, const double *permeability,
                   const double *diameter, double *K);

/** Intrinsic permeability of a material, m2, from its hydraulic conductivity: k mu/(rho 9.81); 0: not given. */
double coupling_permeability(const struct scene *scene, const struct material *material);

#endif
