/* How much of a cell, of a face or of the way to a neighbour lies inside a shape. theory 4.1, 4.12 */
#ifndef ICE_SHARES_H
#define ICE_SHARES_H

#include "core/grid.h"
#include "core/shape.h"

/** Share of the cube of width h about x (a square where the grid is 2D) that lies inside; axis >= 0: of its section
 * across that axis through x. Second order in h where the shape is curved; edges and corners are resolved to h/8. */
double share_inside(const struct grid *grid, const struct shape *shape, const double x[3], int axis);
/** Way in h from x along an axis, towards larger (sign 1) or smaller (-1) coordinates, until the shape ends, at most
 * `most`; 0 where x lies outside. */
double share_way_out(const struct grid *grid, const struct shape *shape, const double x[3], int axis, int sign,
                     double most);

#endif
