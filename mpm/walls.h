/* Rigid walls that the solid meets at their surface: obstacles, and sides of the grid with friction. theory 3.11 */
#ifndef MPM_WALLS_H
#define MPM_WALLS_H

#include "mpm/mpm.h"

enum { MAX_WALLS = SIDES + MAX_OBSTACLES };

/* A side with friction is the half-space beyond it. */
struct wall {
  struct obstacle body;    /* as in the scene, which owns what it points at */
  int             account; /* its place in now.wall */
};

/* A node at which a body touches a wall, and the pressures that act there. */
struct touch {
  long   node;
  double normal[3]; /* out of the wall */
  double area;      /* m2 (m in 2D) of the body's surface that faces the wall */
  double closing;   /* m/s: how fast the gap may close to be closed at the end of the step */
  double ease[3];   /* 1/kg: change of velocity by a unit impulse; 0 where a side of the grid holds it */
  int    pressure[8];
  double share[8];
};

/* Pressure and friction on the surface of a wall around one node of the grid, times dt: impulses per area, N s/m2. */
struct pressure {
  long   node;
  double normal, along[3];
  double ease;             /* change of area times velocity by a unit pressure */
  double excess, slide[3]; /* area times velocity into the wall, and along it */
  double change, change_along[3];
};

struct touch_list; /* mpm/touches.c */

/* Where the touches and pressures of a body begin: those of wall i are [i] up to [i + 1]. */
struct touch_range {
  long touch[MAX_WALLS + 1], pressure[MAX_WALLS + 1];
};

/* Walls of a scene, and where bodies touch them in this step. */
struct walls_state {
  bool                liquid; /* who meets them are the points of a liquid: one body without a material */
  int                 n_walls;
  struct wall         wall[MAX_WALLS];
  struct touch_list  *list;
  struct touch       *touches;
  struct pressure    *pressures;
  struct touch_range *of; /* [bodies] */
};

/** Whether the scene has such walls. */
bool        walls_present(const struct scene *scene);
enum status walls_create(struct sim *sim, struct mpm *m) MUST_CHECK;
/** Obstacles alone, smooth, that the points of a liquid meet: m says where its points and nodes are: points, x_p,
 * vel_p, mass_p, volume_p, skin_p, kernels, kernel_grid, sides, mass_floor and one body. */
enum status walls_create_liquid(struct sim *sim, struct mpm *m) MUST_CHECK;
void        walls_destroy(struct mpm *m);
/** New nodal velocities of all bodies meet the walls, which then move. */
enum status walls_meet(struct sim *sim, struct mpm *m, double dt) MUST_CHECK;
/** s: half a cell of motion. */
double walls_dt(const struct sim *sim, const struct walls_state *s);
/** Points inside walls are put back on their surface. */
void walls_expel(const struct sim *sim, struct mpm *m, double dt);
/** Rooms of nodes, m3 [size], without what obstacles that are there at time t fill: the points of the lattice inside
 * them. taken_nc [size] is scratch. At least a hundredth stays. */
void walls_find_rooms(const struct sim *sim, const struct mpm *m, double t, double *taken_nc, double *room_nc);

/** Whether a wall is there at time t; before t = 0, while the start is sought: as at 0. */
bool wall_present(const struct obstacle *body, double t);
/** m/s, of the whole wall at time t; none before t = 0. */
void wall_velocity(const struct obstacle *body, double t, double vel[3]);
/** m: signed distance of x from wall i where it is now, negative inside; normal: out of it (NULL: not wanted). */
double wall_distance(const struct mpm *m, int i, const double x[3], double normal[3]);

/** m: the least that a point of a block may be away from wall i, before the points are sorted again. */
double wall_distance_of_block(const struct sim *sim, const struct mpm *m, int i, const struct kernel_run *run);

/** Bodies lie on the walls that are there at the start: the lattice of a body that ends on a wall begins anywhere up to
 *  a spacing above it, not half of one, and in steps on an oblique wall. Its lowest points reach down to it, skin_p. */
void touches_lay_down(const struct sim *sim, struct mpm *m);
/** Finds where which body touches which wall, at the places of the points and with the masses of the nodes. */
enum status touches_find(struct sim *sim, struct mpm *m) MUST_CHECK;
/** MUSL: the velocities that were gathered again meet the walls again, with the impulses of the step in stock. */
void walls_meet_again(const struct sim *sim, struct mpm *m, int body);
/** Predicted velocities vel_nc [size][dim] of the only body meet the walls, before a fluid hears of them: pressure
 * would else be made for a skeleton that slides where friction holds it. mpm.meet_walls comes later and keeps the
 * account. Several bodies: nothing is done, their predicted velocities are one. */
enum status walls_meet_predicted(struct sim *sim, struct mpm *m, double *vel_nc) MUST_CHECK;
enum status touches_create(const struct sim *sim, const struct mpm *m, struct walls_state *s) MUST_CHECK;
void        touches_destroy(struct walls_state *s);

#endif
