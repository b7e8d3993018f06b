/* The sharp surface of the liquid: planes in cells, their normals from the fill of the cells around, and the fluxes
 * that they cut off. theory 4.9 */
#ifndef ICE_PLIC_H
#define ICE_PLIC_H

#include "core/grid.h"
#include "core/status.h"

/* Liquid of a cell: normal.x <= offset. x from the cell's centre in cell widths; the normal points out of the liquid,
 * |n_x| + |n_y| + |n_z| = 1, so -1/2 <= offset <= 1/2 where the plane cuts the cell. In 2D n_z = 0. */
struct plane {
  double normal[3], offset;
};

/** Divides a normal by the sum of its absolute components. */
void plic_normalise(double normal[3]);
/** Share of the unit cell in normal.x <= offset; a normal of any length but 0. */
double plic_volume(const double normal[3], double offset);
/** Offset that leaves a share of the unit cell, 0 to 1; a normal of any length but 0. */
double plic_offset(const double normal[3], double volume);
/** Liquid within a width, 0 to 1, of the lower or upper face of an axis, as a share of the cell. */
double plic_slab(const struct plane *plane, int axis, bool upper, double width);
/** Centroid of the liquid from the cell's centre, in cell widths; 0 without liquid. */
void plic_centroid(const struct plane *plane, double centroid[3]);

/* Where liquid may be, and the state of a step. Cells with pore = 0 are closed: nothing flows there and nobody looks at
 * their fill. Ghosts behind a wall are closed; behind an open side they hold pore and fill of what flows in. */
struct plic {
  const struct grid *grid;
  const double      *pore;  /* [size] pore volume over a cell's volume */
  unsigned char     *state; /* [size] filled, spray, or neither at the start of the step */
};

enum status plic_create(const struct grid *grid, const double *pore, struct plic *plic) MUST_CHECK;
void        plic_destroy(struct plic *plic);

/** Whether a cell holds a surface. */
static inline bool plic_mixed(double fill) { return fill > 1e-8 && fill < 1 - 1e-8; }
/** The plane of a cell, from the fill [size], liquid over pore volume, of the cells around it, corners included. */
void plic_reconstruct(const struct plic *plic, const double *fill, long cell, struct plane *plane);

/** Starts a step: which cells are filled and which are spray. Fills periodic ghosts of `fill`. */
void plic_begin(struct plic *plic, double *fill);
/** Whether a cell is spray since plic_begin. */
bool plic_is_spray(const struct plic *plic, long cell);
/** Axis of the k-th sweep, k < dim, of a step. Orders alternate. */
int plic_axis(const struct grid *grid, long step, int k);
/** Moves liquid along one axis. flux [size] m/s: volume flux of liquid and void through the axis' faces per area, 0 at
 * closed ones; periodic faces filled. fill [size]: in and out. passed [size]: liquid through the faces over a cell's
 * volume, never more than the cell held. After all axes pore fill has changed by -sum of passed and, where fill > 1/2
 * at the start, by the divergence of the flux; content that is kept by `passed` alone is exact. */
void plic_sweep(const struct plic *plic, int axis, double dt, const double *flux, double *fill, double *passed);

#endif
