/* Drag laws: force between a fluid and a skeleton per volume of medium. docs/theory.md, "Drag". */
#ifndef COUPLING_DRAG_H
#define COUPLING_DRAG_H

#include "core/param.h"

/* What a law may need; arrays [n], one entry per node, cell, face or point. */
struct drag_medium {
  const double *porosity;           /* -, of the medium itself (not diluted by clear fluid in the same cell) */
  const double *slip;               /* m/s, |U_s - U_f|, pore velocity */
  const double *permeability;       /* m2, intrinsic, as given by the scene; 0: not given */
  const double *diameter;           /* m; 0: not given */
  double        density, viscosity; /* of the fluid, kg/m3, Pa s, positive */
};

/** Porosity that a law divides by: a medium without pores resists very much, not infinitely. */
static inline double drag_porosity(const struct drag_medium *m, int i) { return fmin(fmax(m->porosity[i], 1e-6), 1.0); }

struct drag_law {
  const char         *name, *source;
  const struct param *params;
  size_t              param_size;
  bool                needs_permeability, needs_diameter;
  /** K [n] kg/m3/s: force on the fluid per volume of medium = K (U_s - U_f). 0 where what the law needs is not given.
   */
  void (*coefficient)(const void *prm, int n, const struct drag_medium *m, double *K);
};

extern const struct drag_law *const drag_laws[];
const struct drag_law              *drag_find(const char *name);

#endif
