/* Material points: state of the solid and what other folders may ask of it. */
#ifndef MPM_MPM_H
#define MPM_MPM_H

#include "core/sim.h"
#include "mpm/kernels/kernels.h"

/* What one body has at the nodes. A scene without contact has one body, whose arrays are the fields themselves; with
 * contact the fields hold what all bodies have together. */
struct body_nodes {
  double *mass_nc, *mom_nc, *force_nc, *vel_nc, *vel_new_nc;
};

struct contact_state; /* mpm/contact.c */
struct absorb_state;  /* mpm/absorb.c */
struct sides_state;   /* mpm/sides.c */
struct walls_state;   /* mpm/walls.h */

/* What a rigid wall, a side of the grid or an obstacle, has done to the solid. */
struct wall_numbers {
  double force[3], impulse[3]; /* N over the last step, N s since the start: on the solid */
  double displacement[3];      /* m since the start, of an obstacle or a side with friction */
  double velocity[3];          /* m/s in the last step, likewise */
  double depth;                /* m, the deepest that a point crept in during a step */
};

/* How a start at rest came about (2.5). Out of balance: rms acceleration of the nodes over that of the weight. */
struct mpm_rest {
  bool   computed, settled;  /* settled: below numerics.rest_tolerance */
  double column, unbalanced; /* out of balance as the columns give it, and as the run starts */
  int    steps;              /* of the static solve; 0: the columns balance */
};

enum stray { STRAY_STOP, STRAY_CLAMP, STRAY_DELETE };
#define STRAY_WORDS "stop|clamp|delete"

/* Points that left the grid, since the start. Doubles, as they are checkpointed. */
struct mpm_strays {
  double put_back, deleted, flowed_out; /* points; flowed_out: deleted behind an open side */
  double mass_lost, mass_out;           /* kg of those deleted, of those that flowed out */
  double momentum[3], energy;           /* kg m/s, J: what they took along, or lost when they were put back */
  double last_t, last_x[3], last_solid; /* s, m: the last of them; index of its solid */
};

/* numerics.mpm.* */
struct mpm_params {
  double damping;       /* share of the force on a node that acts against its motion */
  double smoothing;     /* share of the smoothed velocity gradient in what strains the points */
  int    stray;         /* enum stray: what happens to points that leave the grid */
  double max_expansion; /* a point whose volume grew by more carries no stress; INFINITY: all do */
};

struct mpm {
#define FIELD FIELD_MEMBER
#include "mpm/fields.def"
#undef FIELD
  struct kernel_grid    kernel_grid;
  struct kernel_grid    heat_grid; /* without modified functions: sides are mirrors for heat */
  const struct kernels *kernels;
  struct points        *points;
  int                   n_bodies;
  struct body_nodes    *bodies;      /* [n_bodies] */
  int                  *marker_body; /* [markers] */
  struct contact_state *contact;     /* NULL: one body */
  /* what the sides do to the nodes of the solid: those of the scene, but open where one rubs, no fluid is there and
   * mpm.meet_walls stops the solid */
  struct side_condition sides[SIDES];
  struct sides_state   *watched;    /* NULL: no side is watched */
  struct walls_state   *walls;      /* NULL: no obstacles, and no side rubs */
  struct rub_state     *rub;        /* NULL: no side rubs in a fluid */
  struct absorb_state  *absorb;     /* NULL: no side absorbs */
  double                mass_floor; /* kg: a node with less has no velocity */
  struct mpm_numbers {
    double              wave_speed, speed; /* m/s, largest of all points, of the last step */
    double              power;             /* W that the stresses of the last step take up */
    double              work_loads;        /* J, since the start */
    double              plastic;           /* J lost to plastic flow, and by points that part, since the start */
    double              friction;          /* J lost to friction, since the start */
    double              work_walls;        /* J that moving walls did on the solid, since the start */
    double              contact;           /* J stored where bodies overlap */
    double              damping;           /* J lost to local damping, since the start */
    double              heat_sides; /* J that came in through sides, less that of points that left, since the start */
    double              absorbed;   /* J that left by absorbing sides, since the start */
    struct mpm_strays   strays;
    struct wall_numbers wall[SIDES + MAX_OBSTACLES];
  } now;
  double *run_seen;           /* [n_runs][N_SEEN] what they were made of */
  double *row_work;           /* [rows of nodes] J, scratch of sums over nodes */
  double *run_parted;         /* [n_runs][2] J, W that points lost in the step because they have parted */
  double *run_heat;           /* [n_runs] J, gained by points in the step */
  double  heat_given;         /* J that sides with a flux, and sources, gave in the step */
  long   *marker_end;         /* [loads + tracers] markers of item i end here */
  double *marker_area;        /* [markers] m2 (m in 2D); 0: tracer */
  double (*marker_normal)[3]; /* outward, for pressure loads */
  int             n_markers;
  bool            moves; /* some material is not held */
  struct mpm_rest rest;
};

extern const struct module module_mpm;

static inline struct mpm *mpm_of(const struct sim *sim) { return sim_state(sim, &module_mpm); }
/** numerics.mpm of the scene. */
static inline const struct mpm_params *mpm_params(const struct scene *scene)
{
  return scene_module_params(scene, &module_mpm);
}

/** Markers [first, end) of a load or tracer; first = end = 0: no such name. */
void mpm_marker_range(const struct sim *sim, const char *name, long *first, long *end);

/** Which wall a name means, as an index into now.wall: a side of the grid, or SIDES + an obstacle. */
bool mpm_wall_find(const struct sim *sim, const char *name, int *wall);
/** m: signed distance of x from the nearest obstacle that is there at time t, negative inside; INFINITY: none. normal:
 *  out of it, NULL: not wanted. They are where their velocities have brought them by now. */
double mpm_obstacle_distance(const struct sim *sim, const double x[3], double t, double normal[3]);

/** Number of solid points, and where a solid's point is: fills x [n][3] and body [n] when they are not NULL. */
long mpm_place_points(const struct scene *scene, double (*x)[3], int *body);
/** The regular lattice of point places (points_per_axis per cell) clipped to the grid and a shape: used by every set.
 */
long mpm_fill_shape(const struct scene *scene, const struct shape *shape, double (*x)[3]);
/** Bulk volume of one lattice point, m3 (m2 per metre in 2D). */
double mpm_point_volume(const struct scene *scene);

bool mpm_solid_moves(const struct scene *scene);
bool mpm_transfer_affine(const struct scene *scene);
/** Factor on h/c that the basis asks for. A node that a body barely reaches has mass w and answers with (grad w)^2/w,
 * which is 2/h2 for quadratic splines, tends to zero for cubic ones, but is 1/(l h) for GIMP points of half width l:
 * sqrt(2 l/h). */
double mpm_basis_step(const struct scene *scene);
/** Share of the nodal velocity in the update of a point for a step dt, T(30); the blend per step is scaled with dt. */
double mpm_blend(const struct sim *sim, double dt);

/* mpm/boundary.c: walls on nodal fields. sides: the conditions of the phase that lives there. */
/** What fell on ghost nodes goes to their images. n = 1: scalar; n = dim: vector, normal component odd at a wall. */
void boundary_fold(const struct kernel_grid *kg, const struct side_condition *sides, int n, double *field);
/** One side's part of that; sides in their order. */
void boundary_fold_side(const struct kernel_grid *kg, const struct side_condition *sides, int side, int n,
                        double *field);
/** m/s: of a side at x and time t. */
void boundary_speed(const struct side_condition *side, const double x[3], double t, double speed[3]);
/** Values of ghost nodes from inside; velocity fields get the wall's own velocity at time t. */
void boundary_ghosts(const struct kernel_grid *kg, const struct side_condition *sides, int n, double t, double *field);
/** Velocity of nodes on walls: slip, no-slip, prescribed. */
void boundary_velocity(const struct grid *g, const struct side_condition *sides, double t, double *vel_nc);
/** Whether a side holds this component of a node's velocity. */
bool boundary_holds(const struct grid *g, const struct side_condition *sides, long node, int component);
/** Nodes that are advanced: owned ones, and one ghost layer behind open sides. */
struct box boundary_nodes(const struct grid *g, const struct side_condition *sides);
/** Volume of a node, m3: the folded sum of its weight over the lattice of points, what it would hold if all space were
 * filled. */
double boundary_room(const struct kernel_grid *kg, enum basis basis, long node);

#endif
