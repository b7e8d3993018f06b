/* How much of a cell, of a face or of the way to a neighbour lies inside shapes. theory 4.1, 4.14 */
#ifndef ICE_SHARES_H
#define ICE_SHARES_H

#include "core/grid.h"
#include "core/shape.h"

enum { MOST_PLACES = 16, SHARE_PARTS = 8 /* of a cut cell along each axis */ };

/* Space that shapes take together, each where it has moved to. */
struct places {
  int                 n;
  const struct shape *shape[MOST_PLACES];
  double              moved[MOST_PLACES][3]; /* m */
};

/** One shape where it stands. */
struct places places_of(const struct shape *shape);
/** Signed distance of the union, m; normal: of the nearest (NULL: not wanted). */
double places_distance(const struct places *p, const double x[3], double normal[3]);

/** Share of the cube of width h about x (a square where the grid is 2D) that lies inside; axis >= 0: of its section
 * across that axis through x. Second order in h where a shape is curved; edges and corners are resolved to h/8. */
double share_inside(const struct grid *grid, const struct places *places, const double x[3], int axis);
/** The same of what `without` leaves over of the cube, and what it leaves over of each of its slices along an axis,
 * over the volume of the cube. places NULL: the share that is left over. */
double share_left(const struct grid *grid, const struct places *without, const struct places *places, const double x[3],
                  int axis, double slice[SHARE_PARTS]);
/** Way in h from x along an axis, towards larger (sign 1) or smaller (-1) coordinates, until the shapes end, at most
 * `most`; 0 where x lies outside. */
double share_way_out(const struct grid *grid, const struct places *places, const double x[3], int axis, int sign,
                     double most);

#endif
