/* Fluid path: one liquid as a second set of material points, explicit and weakly compressible. docs/theory_twopoint.md
 */
#ifndef TWOPOINT_TWOPOINT_H
#define TWOPOINT_TWOPOINT_H

#include "core/sim.h"
#include "mpm/mpm.h"

struct coupling;

struct twopoint_params {
  int    averaging_interval; /* steps between two averages of the pressure; 0: never */
  bool   average_increment;  /* the increment of ln J is averaged in every step */
  bool   tension;            /* water pulls even where it does not fill the space */
  double max_expansion;      /* J is at most 1 + this */
  double shifting;           /* share of the excess at a node that shifts points in a step, roughly; 0: none do */
  bool   shear;              /* viscosity resists shear */
  double surface_fill;       /* nodes with less of their room filled have pressure 0 in averages; 0: none */
  bool   as_printed;         /* the paper's forms, for comparison */
  double jitter;             /* spacings: largest random displacement of a point at the start, along each axis */
};

struct twopoint {
#define FIELD FIELD_MEMBER
#include "twopoint/fields.def"
#undef FIELD
  const struct twopoint_params *params;
  const struct kernels         *kernels;
  struct points                *points;
  struct coupling              *coupling;     /* NULL: no skeleton */
  struct mpm                   *mpm;          /* NULL: no skeleton that moves */
  struct side_condition         sides[SIDES]; /* of the water; borrowed functions; a pressure side is open */
  struct kernel_grid            kernel_grid;
  struct kernel_grid            average_grid; /* walls extrapolate: averages keep linear fields up to the wall */
  unsigned char                *water_bound, *solid_bound; /* [size][dim] 1: a wall prescribes this component */
  double                       *run_speed, *run_change;    /* [n_runs] m/s, fastest point; largest |J - 1| */
  double                        mass_floor;                /* kg: a node with less water has no velocity */
  double                        rho0;                      /* kg/m3 at P = 0 */
  double                        fast_wave;                 /* m/s, c_f */
  struct mpm                   *shade;                     /* the water as mpm/walls.h sees it; NULL: no obstacles */
  bool                          grains_held; /* some skeleton does not move and takes its share of forces */
  struct twopoint_numbers {
    double              speed;                         /* m/s, fastest point of the last step */
    double              put_back, deleted, flowed_out; /* points that left the grid, since the start */
    double              mass_out, energy_out;          /* kg, J: of those deleted and flowed out, since the start */
    double              momentum_out[3];               /* kg m/s; these two also lost when points were put back */
    double              density_change;                /* largest |rho_0/rho - 1| of all points, since the start */
    struct wall_numbers wall[SIDES + MAX_OBSTACLES];   /* what obstacles did to the water */
  } now;
};

extern const struct module module_twopoint;

static inline struct twopoint *twopoint_of(const struct sim *sim) { return sim_state(sim, &module_twopoint); }

enum { WATER_BATCH = 128 }; /* points or nodes that are handed to a law at once */

/** Scene: refuses what this path cannot do. */
enum status twopoint_check(const struct scene *scene) MUST_CHECK;
enum status twopoint_create(struct sim *sim, void *state) MUST_CHECK;
void        twopoint_destroy(void *state);
void        twopoint_measure(const struct sim *sim, struct ledger *ledger);

enum status twopoint_sort_points(struct sim *sim, double dt);
enum status twopoint_find_porosity(struct sim *sim, double dt);
enum status twopoint_find_fill(struct sim *sim, double dt);
enum status twopoint_points_to_nodes(struct sim *sim, double dt);
enum status twopoint_predict_nodes(struct sim *sim, double dt);
enum status twopoint_resist_nodes(struct sim *sim, double dt);
enum status twopoint_exchange_momentum(struct sim *sim, double dt);
enum status twopoint_meet_walls(struct sim *sim, double dt);
enum status twopoint_expel_points(struct sim *sim, double dt);
double      twopoint_walls_dt(const struct sim *sim);
enum status twopoint_strain_water(struct sim *sim, double dt);
enum status twopoint_nodes_to_points(struct sim *sim, double dt);
enum status twopoint_gather_water(struct sim *sim, double dt);
enum status twopoint_update_pressure(struct sim *sim, double dt);
enum status twopoint_average_and_update(struct sim *sim, double dt);
enum status twopoint_average_pressure(struct sim *sim, double dt);
enum status twopoint_shift_points(struct sim *sim, double dt);
enum status twopoint_find_surface(struct sim *sim, double dt);
enum status twopoint_find_porosity_printed(struct sim *sim, double dt);
enum status twopoint_strain_solid_printed(struct sim *sim, double dt);
enum status twopoint_update_pressure_printed(struct sim *sim, double dt);
enum status twopoint_average_push_printed(struct sim *sim, double dt);
double      twopoint_speed_limit(const struct sim *sim);
double      twopoint_shear_limit(const struct sim *sim);
double      twopoint_wave_limit(const struct sim *sim);

/** m/s: fast wave of water and a skeleton that drag has not locked yet, largest eigenvalue of R^-1 S. n: porosity;
 *  E_oed Pa; rho_s, rho kg/m3; K Pa. A skeleton that is held: rho_s = INFINITY. */
double twopoint_fast_wave(double n, double E_oed, double rho_s, double rho, double K);

/** Sorts the water now, whether needed or not; points outside the grid are dealt with. */
enum status twopoint_sort_now(struct sim *sim, struct twopoint *w) MUST_CHECK;
/** Porosity at the points at the start, from the volumes that they have. */
void twopoint_start_porosity(struct sim *sim, struct twopoint *w);
/** Volumes, and with a skeleton pores, gathered at nodes; increment [n] of the points: likewise, into average_nc. */
void twopoint_gather_volumes(struct sim *sim, struct twopoint *w, const double *increment);
/** J_w and volume_w from P_w, by the law. */
void twopoint_volume_of_pressure(const struct sim *sim, struct twopoint *w);
/** Replaces q [n] of the points by its average over volume, point -> node -> point; gradient [n][dim]: of q at the
 * points, used so that linear fields stay as they are, then replaced by that of the average; NULL: zeroth order.
 * pressure: q is 0 at surface nodes, where the scene has them found. */
void twopoint_average(struct sim *sim, struct twopoint *w, double *q, double *gradient, bool pressure);
/** What was gathered in average_nc becomes a mean: weight [size] m3. */
void twopoint_finish_average(struct sim *sim, struct twopoint *w, const struct kernel_grid *kg, const double *weight);
/** Excess of volume at nodes; whether there is any. Then, with slope_w gathered, points of a run go down it. */
bool twopoint_find_excess(struct sim *sim, struct twopoint *w);
void twopoint_shift_run(const struct sim *sim, struct twopoint *w, long begin, long end);
/** Fastest point. ERR_DIVERGED if it has no finite velocity. */
enum status twopoint_find_speed(struct sim *sim, struct twopoint *w) MUST_CHECK;
/** Adds mass, momentum and energy of point p. */
void twopoint_measure_point(const struct sim *sim, const struct twopoint *w, long p, struct ledger *l);

/** Whether obstacles stand in the water at some time. */
bool twopoint_walled(const struct scene *scene);
/** The fluid's region without the obstacles that are there at the start; parts [1 + MAX_OBSTACLES] is its store. */
struct shape twopoint_region(const struct scene *scene, struct shape *parts);
/** What mpm/walls.h must know of the water, and rooms of nodes beside obstacles. */
enum status twopoint_create_walls(struct sim *sim, struct twopoint *w) MUST_CHECK;
void        twopoint_destroy_walls(struct twopoint *w);

/** Whether the solid or a held skeleton takes its share of the forces at a node. */
bool twopoint_shares(const struct twopoint *w, long node);
/** Sets a node field [size][n] to zero. */
void twopoint_clear(const struct sim *sim, int n, double *field);

#endif
