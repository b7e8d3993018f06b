/* Fluid path: fluids in cells, implicit pressure (ICE). theory 4 */
#ifndef ICE_ICE_H
#define ICE_ICE_H

#include "core/linear.h"
#include "core/sim.h"
#include "ice/heat_phase.h"
#include "ice/plic.h"

/* what a face is to the fluid */
enum face_kind {
  FACE_CLOSED,   /* wall, or outside the grid */
  FACE_INNER,    /* between two wet cells */
  FACE_SURFACE,  /* between a wet cell and void: P = 0 at the surface */
  FACE_PRESSURE, /* side of the grid with a given pressure */
  FACE_INLET,    /* side of the grid with a given velocity */
  FACE_VOID      /* between two void cells; where drops fly, they fall freely */
};

struct ice_params {
  bool   advection;        /* the liquid carries its momentum, and its surface goes where it flows */
  bool   shocks;           /* a fluid at any speed, that fills the grid */
  double acoustic_courant; /* cells that a wave may go per step; 0: the step does not know of sound */
  bool   shear;            /* viscous stress between cells */
  double memory;           /* share of what a face had beyond the mean of its cells that it keeps */
  double smagorinsky;      /* C of the eddies' viscosity */
  double defect_share;     /* share of the volume defect that is made good per step */
  double defect_tolerance; /* volume that the defect's solve may leave, over a cell's */
};

struct obstacles; /* ice/obstacles.h */

/* where an obstacle is */
struct body_place {
  double present, moved[3]; /* 1: it is there; m since the start */
};

struct ice {
#define FIELD FIELD_MEMBER
#include "ice/fields.def"
#undef FIELD
  const struct ice_params *params;
  struct linear           *linear;
  unsigned char           *kind; /* [dim][size] enum face_kind */
  struct plic              plic;
  struct heat              heat; /* where the fluid's energy is solved */
  double                  *rim;  /* [dim][size] h: a surface's distance beyond the fill's; NULL: none has */
  double                  *one;  /* [dim][size] ones: porosity without a skeleton */
  double                  *fill; /* [size] saturation when the ledger is measured; NULL without advection */
  const double            *porosity_cc, *porosity_fc;
  const double *open_cc, *open_fc; /* share that obstacles leave open of a cell at the start of the step, of a
                                      face at its end */
  struct obstacles *obstacles;     /* NULL: none stands in the liquid */
  const double     *filling_cc;    /* kg/m3: density of what fills a cell, rho_cc or of several fluids mixture_cc */
  int               n_fluids;
  double            ambient; /* Pa: beyond open sides */
  unsigned char
      *only;    /* [size] of several fluids 1 + the one that fills a cell beside traces of others, 0: none does */
  bool several; /* n_fluids > 1: every cell is full and has a pressure */
  bool skeleton, moves; /* there is a skeleton; it moves */
  bool advects;         /* params->advection, in scenes without params->shocks */
  bool surface;         /* some face is FACE_SURFACE */
  bool closed;          /* no face has a given pressure */
  bool singular;        /* incompressible and closed: pressure up to a constant */
  struct ice_numbers {
    double speed;  /* m/s, fastest fluid of the last step */
    double change; /* m/s2, fastest change that pressure and weight now give a face; with a surface that moves */
    double mass_out, others_out;   /* kg through open sides, net, since the start: first fluid, others */
    double squeeze;                /* 1/s, fastest change of volume of the last step; with params->shocks */
    double heat_out;               /* J that went with it */
    double shear[3];               /* N s, of viscous stress on the sides since the start */
    double viscosity;              /* m2/s, largest with eddies */
    double heat_sides;             /* J conducted in through sides since the start */
    double heat_side[SIDES];       /* W through each side in the last step */
    double heat_step;              /* s that the change of temperatures in the last step would allow; 0: none yet */
    double drag_rate;              /* 1/s, the least K/(n rho) of all faces that answer to pressure, in the last step */
    double defect_rms, defect_max; /* of the last step, over the pore volume */
    struct body_place obstacle[MAX_OBSTACLES], before[MAX_OBSTACLES]; /* now, and a step ago */
  } now;
};

extern const struct module module_ice;

static inline struct ice *ice_of(const struct sim *sim) { return sim_state(sim, &module_ice); }

/** Temperatures of the cells from `cell` on as an equation of state wants them; NULL: energy is not solved. */
static inline const double *ice_temperature(const struct ice *ice, long cell)
{
  return ice->T_cc ? ice->T_cc + cell : NULL;
}

/** Whether fluid at a face answers to a pressure gradient. */
static inline bool ice_face_active(enum face_kind kind)
{
  return kind == FACE_INNER || kind == FACE_SURFACE || kind == FACE_PRESSURE;
}

/** Whether a wet cell has a surface: such a cell is only filled more or less, which is no volume defect. */
bool ice_has_surface(const struct grid *g, const struct ice *ice, long cell);
/** How high the liquid stands in a cell, as a share: its saturation, and where an obstacle cuts the cell what that
 * makes of the height of what is left, so that still water is level there. */
double ice_level(const struct ice *ice, long cell);
/** Growth of the room that walls which move leave a cell in this step, over a cell's volume, 1/s. */
double      ice_wall_rate(const struct ice *ice, long cell, double dt);
enum status ice_move_obstacles(struct sim *sim, double dt);
double      ice_obstacles_dt(const struct sim *sim);
/** For ice_liquid_centre, from mass and pressure as they are. */
void ice_measure_fill(const struct sim *sim, const struct ice *ice);
/** m: middle of the liquid of a cell: below its plane where it has a surface. */
void ice_liquid_centre(const struct sim *sim, const struct ice *ice, long cell, double x[3]);
/** Distance between the pressures of a face, in h: 1 between cells, to the surface or the side else. */
double ice_face_distance(const struct sim *sim, const struct ice *ice, int axis, long face);
/** Pressure beyond a face where there is no wet cell: the side's at time t, or zero at a surface, Pa. */
double ice_outside_pressure(const struct sim *sim, const struct ice *ice, int axis, long face, double t);
/** What carrying will do in the first step; before and after carrying in every step, for the next. */
void ice_start_forecast(struct sim *sim, struct ice *ice);
void ice_begin_forecast(struct sim *sim, struct ice *ice);
void ice_end_forecast(struct sim *sim, struct ice *ice, double dt);
/** Mean of what is forecast for the cells of a smooth face along its axis, m/s2; 0 at others. */
double ice_face_forecast(const struct sim *sim, const struct ice *ice, int axis, long f);
/** Copies owned values of a face field into the ghosts of periodic axes: the nodes of a seam have faces on both sides.
 */
void ice_fill_faces(const struct sim *sim, double *field);
/** m/s2: what the pressure of now, and weight at time t, would do to the liquid at a face, at most. */
double ice_fastest_change(const struct sim *sim, const struct ice *ice, double t);
/** h^(dim-1), m2. */
double ice_face_area(const struct grid *g);
/** Density of what a face has on both sides, kg/m3: mean of its wet cells, which is the harmonic mean of specific
 * volumes M(45), so that hydrostatics stay exact; of several fluids what lies in the two halves of cells that it has.
 */
double ice_face_density(const struct grid *g, const struct ice *ice, int axis, long face);
/** kg: all fluids of a cell. */
static inline double ice_cell_mass(const struct grid *g, const struct ice *ice, long c)
{
  double m = ice->mass_cc[c];
  for (int k = 1; k < ice->n_fluids; k++) m += ice->mass_cc[k * g->size + c];
  return m;
}
/** The fluid that fills a cell, beside traces of others; -1: several. */
static inline int ice_only_fluid(const struct ice *ice, long c) { return ice->only[c] - 1; }
/** Finds that fluid in every cell, ghosts included. */
void ice_find_only(struct sim *sim, struct ice *ice);
/** Densities, shares, compressibility of a cell's fluids, volume defect; what the halves of cells hold. */
enum status ice_mix_fluids(struct sim *sim, double dt);
/** Pressures of several fluids after the volume equation. */
void ice_advance_pressures(struct sim *sim, struct ice *ice);
/** Share of the first fluid that lies in the lower half of a cell along an axis, over its pore volume. */
double ice_lower_share(const struct grid *g, const struct ice *ice, int axis, long c);
/** Fails where the pressure of a cell is none that the equations of state of its fluids are meant for. */
enum status ice_check_range(const struct sim *sim, const struct ice *ice) MUST_CHECK;
/** Starts and pressures at rest of several fluids. */
enum status ice_fill_several(struct sim *sim, struct ice *ice) MUST_CHECK;
enum status ice_rest_several(struct sim *sim, struct ice *ice) MUST_CHECK;
/** Axis along which gravity acts, as 2 axis (downwards) or 2 axis + 1 (upwards); -1: none or oblique. g: m/s2. */
int ice_gravity_axis(const struct sim *sim, double *g);
/** Pore volumes of the cells, and what would flow in behind open sides. */
void ice_open_rooms(struct sim *sim, struct ice *ice);
/** What several fluids carry through the faces of an axis after a sweep of the first: their masses and velocities. */
void ice_pass_fluids(struct sim *sim, struct ice *ice, int axis, double dt);

/** Velocity of the fluid at a face from its wet cells: mean of their momentum over what the face holds, so that a
 * steady flux through a change of porosity stays what it is. */
double ice_mean_velocity(const struct sim *sim, const struct ice *ice, int axis, long f);
/** Of several fluids: mean of both cells by the mass of the halves that the face has of them. */
double ice_mean_velocity_of(const struct grid *g, const struct ice *ice, int axis, long f);
/** Gradient of a cell potential at a face, zero beyond surfaces and pressure sides, 1/m. */
double ice_face_gradient(const struct sim *sim, const struct ice *ice, const double *q, int axis, long f);
/** Whether a cell has a plane that separates the first fluid from the others. */
bool ice_is_cut(const struct ice *ice, long c);
/** Density of the grains at a face; 0: there are none. */
double ice_grain_density(const struct sim *sim, int axis, long f);
/** kg of fluid k in a volume of the fluids beside the first that leaves a cell: no more than there is. */
double      ice_mass_of_rest(const struct grid *g, const struct ice *ice, int k, long from, double volume);
enum status ice_predict_each(struct sim *sim, double dt);
enum status ice_eliminate_each(struct sim *sim, double dt);
enum status ice_correct_each(struct sim *sim, double dt);
/** Kinds of all faces from wet cells and sides. */
void ice_classify_faces(struct sim *sim, struct ice *ice);
/** Component of the velocity that the side prescribes at one of its faces, m/s. */
double ice_inlet_velocity(const struct sim *sim, int axis, int component, long f, double t);
/** Velocities of all faces, when the scene prescribes them. */
void        ice_create_prescribed(struct sim *sim, struct ice *ice);
enum status ice_carry_prescribed(struct sim *sim, double dt);
double      ice_prescribed_dt(const struct sim *sim);
enum status ice_update_properties(struct sim *sim, double dt);
enum status ice_find_surface(struct sim *sim, double dt);
enum status ice_advect(struct sim *sim, double dt);
enum status ice_diffuse_momentum(struct sim *sim, double dt);
enum status ice_measure_eddies(struct sim *sim, double dt);
enum status ice_centre_diffusion(struct sim *sim, double dt);
double      ice_viscous_dt(const struct sim *sim);
enum status ice_predict_faces(struct sim *sim, double dt);
enum status ice_predict_solid(struct sim *sim, double dt);
enum status ice_resist_faces(struct sim *sim, double dt);
enum status ice_eliminate_drag(struct sim *sim, double dt);
enum status ice_solve_pressure(struct sim *sim, double dt);
enum status ice_correct_faces(struct sim *sim, double dt);
enum status ice_move_defect(struct sim *sim, double dt);
enum status ice_accelerate_cells(struct sim *sim, double dt);
enum status ice_update_cells(struct sim *sim, double dt);
enum status ice_push_solid(struct sim *sim, double dt);
double      ice_dt_limit(const struct sim *sim);
/** s in which a wave goes numerics.ice.acoustic_courant cells; INFINITY: the scene does not ask. */
double ice_sound_dt(const struct sim *sim);

/** Wet cells, masses, pressures and face kinds at the start. */
enum status ice_create(struct sim *sim, void *state) MUST_CHECK;

#endif
