/* A scene as plain data in SI units: what is there, before anything is planned. Made by run/scene_read.c. */
#ifndef CORE_SCENE_H
#define CORE_SCENE_H

#include "core/function.h"
#include "core/module.h"
#include "core/param.h"
#include "core/shape.h"

#include <stdbool.h>

struct constitutive_model;
struct eos;
struct drag_law;
struct reference;

enum { MAX_MODULES = 16, MAX_FLUIDS = 16, SIDES = 6 };
/* sides: x_min x_max y_min y_max z_min z_max */
enum side { X_MIN, X_MAX, Y_MIN, Y_MAX, Z_MIN, Z_MAX };

struct material {
  char                             name[NAME_LENGTH];
  const struct constitutive_model *model;
  void                            *model_params;   /* read by the law's own table: young, poisson, ... */
  double                           density;        /* kg/m3, of the grains */
  double                           porosity;       /* -, at the start */
  double                           permeability;   /* m/s, hydraulic conductivity; 0: not given */
  double                           grain_diameter; /* m; 0: not given */
  double                           lateral_ratio;  /* -, lateral over vertical stress at rest; < 0: the law's */
  double                           heat_capacity;  /* J/(kg K), of the grains; 0: heat is not solved */
  double                           conductivity;   /* W/(m K), of the grains */
  double                           work_to_heat;   /* share of plastic work that heats */
};

struct solid {
  char            name[NAME_LENGTH];
  int             material;
  char            part_of[NAME_LENGTH]; /* solids with the same word are one body; "": a body of its own */
  int             body;                 /* 0 in a scene without contact */
  struct shape    shape;
  struct function velocity[3]; /* m/s at the start */
  struct function temperature; /* K at the start */
};

struct fluid {
  char                   name[NAME_LENGTH]; /* "": the first one */
  bool                   present;
  const struct module   *path;
  double                 density;      /* kg/m3 at the reference pressure */
  double                 bulk_modulus; /* Pa; INFINITY: incompressible */
  double                 viscosity;    /* Pa s */
  double                 exchange;     /* kg/m3/s: momentum between fluids of a scene; INFINITY: one velocity */
  const struct eos      *eos;
  void                  *eos_params;
  const struct drag_law *drag;
  void                  *drag_params;
  struct shape           region;
  struct function        velocity[3];   /* m/s at the start; of a prescribed motion always, times */
  struct function        strength;      /* -, of t, from -1 to 1 */
  int                    prescribed;    /* 1: that velocity carries the fluid, which has no pressure */
  struct function        pressure;      /* Pa (gauge) at the start, where the start is not at rest */
  struct function        temperature;   /* K at the start; the number 0: energy is not solved */
  double                 conductivity;  /* W/(m K) */
  double                 heat_exchange; /* W/(m3 K), with the grains, per volume of medium */
};

/** Whether the fluid's energy is solved. */
static inline bool fluid_has_energy(const struct fluid *f)
{
  return f->present && (f->temperature.expression || f->temperature.constant != 0);
}

/* what a side does to the solid or to the fluid */
enum side_kind {
  SIDE_SLIP,
  SIDE_NO_SLIP,
  SIDE_SYMMETRY,
  SIDE_VELOCITY,
  SIDE_PRESSURE,
  SIDE_OPEN,
  SIDE_PERIODIC,
  SIDE_ABSORBING
};
#define SIDE_WORDS "slip|no_slip|symmetry|velocity|pressure|open|periodic|absorbing"

struct side_condition {
  int             kind;
  bool            rubs;        /* SIDE_SLIP, SIDE_VELOCITY: the solid presses on it and slides, with */
  double          friction;    /* its Coulomb coefficient; it may leave the side */
  bool            shear_only;  /* SIDE_ABSORBING: the normal component is held, as at SIDE_SLIP; with a fluid */
  struct function velocity[3]; /* m/s, SIDE_VELOCITY */
  struct function pressure;    /* Pa (gauge), SIDE_PRESSURE */
};

/* what a side does to the heat of solids that reach it */
enum heat_kind { HEAT_INSULATED, HEAT_TEMPERATURE, HEAT_FLUX };

struct heat_side {
  int             kind;
  struct function value; /* K; or W/m2 into the solid */
};

/* A traction on a surface that rides on the solid: a flat patch (a box with one axis of zero width) or a 2D arc. */
struct load {
  char            name[NAME_LENGTH];
  struct shape    patch;       /* SHAPE_BOX; or SHAPE_BALL: the arc of that circle inside the grid */
  struct function traction[3]; /* Pa = N/m2, force on the solid per area */
  struct function pressure;    /* Pa, pushes against the outward normal of an arc or patch side */
};

enum { MAX_OBSTACLES = 16 };

/* A rigid body that the solid meets: it does not yield, and moves as it is told. */
struct obstacle {
  char            name[NAME_LENGTH];
  struct shape    shape;       /* where it is at t = 0 */
  double          friction;    /* Coulomb coefficient; INFINITY: rough */
  struct function velocity[3]; /* m/s, of t */
  double          from, until; /* s, when it is there */
};

/* A massless point that moves with the solid. */
struct tracer {
  char   name[NAME_LENGTH];
  double x[3];
};

enum gauge_kind {
  GAUGE_POINT,
  GAUGE_LINE,
  GAUGE_INTEGRAL,
  GAUGE_MEAN,
  GAUGE_TRACER,
  GAUGE_LOAD,
  GAUGE_WALL,
  GAUGE_EXTENT,
  GAUGE_LEVEL,
  GAUGE_LEVELS
};
#define GAUGE_WORDS "point|line|integral|mean|tracer|load|wall|extent|level|levels"

struct gauge {
  char   name[NAME_LENGTH];
  int    kind;
  char   of[NAME_LENGTH];    /* output name of a field, with _x _yy ... for a component; or a ledger entry, or energy */
  char   on[NAME_LENGTH];    /* its tracer, load, side or obstacle; GAUGE_EXTENT: a solid, "water"; "": every solid */
  char   minus[NAME_LENGTH]; /* another gauge, whose number is taken off; "": none */
  double x[3], to[3];        /* m: the point, the ends of the line, or where a tracer's distance is taken from */
  int    n;                  /* samples of a line */
  bool   connected;          /* GAUGE_EXTENT: of the largest cluster */
  struct shape region;       /* of integrals and means */
};

/** Whether a gauge has a column for every sample of a line. */
static inline bool gauge_is_line(const struct gauge *g) { return g->kind == GAUGE_LINE || g->kind == GAUGE_LEVELS; }

struct reference_use {
  char                    name[NAME_LENGTH];
  const struct reference *reference;
  void                   *params;
};

/* One number of a run that is compared with a reference. */
enum metric_measure {
  MEASURE_RMS,
  MEASURE_MAX,
  MEASURE_VALUE,
  MEASURE_MEAN,
  MEASURE_FREQUENCY,
  MEASURE_DECAY,      /* Hz, 1/s: of the damped oscillation of a gauge */
  MEASURE_DRIFT,      /* largest departure of a gauge from its first value in the span, over that value */
  MEASURE_CHANGE,     /* of a gauge from the first to the last sample in the span, over the first */
  MEASURE_GAIN,       /* of a gauge from the first to the last sample in the span */
  MEASURE_REACH,      /* s: when a gauge has come a share of its way from the first to the last sample in the span */
  MEASURE_PEAK,       /* of a gauge: maximum of the cubic through the samples in the span ... */
  MEASURE_PEAK_TIME,  /* ... and s, when */
  MEASURE_RISE,       /* largest rise of a gauge above its least value so far in the span */
  MEASURE_EXCESS,     /* most by which a gauge exceeds what is expected in the span, 0 if it never does */
  MEASURE_FIT,        /* rms of a gauge at the rows of a table, after the time shift that makes it least */
  MEASURE_PROFILE,    /* rms of a line gauge at the rows of a table of places, mean over the times of the table */
  MEASURE_MISFIT,     /* of a cell field that is 1 in the region: sum of |field - share in it| over the sum of shares */
  MEASURE_THICKNESS,  /* of the border of a cell field from 0 to 1: cells in between per cell length of it */
  MEASURE_SCATTER,    /* rms of a field of points about a plane through the 4 cells around along each axis */
  MEASURE_ROUGHNESS,  /* standard deviation of h2 times the Laplacian of a field */
  MEASURE_L1,         /* mean size of the difference of a field */
  MEASURE_CREST,      /* the highest value of a field of cells along a line, by a parabola ... */
  MEASURE_CREST_PLACE /* m: ... and where it is */
};
#define MEASURE_WORDS                                                                                                  \
  "rms|max|value|mean|frequency|decay|drift|change|gain|reach|peak|peak_time|rise|excess|fit|profile|misfit|"          \
  "thickness|scatter|"                                                                                                 \
  "roughness|l1|crest|crest_place"

/* measured or computed elsewhere: n values at times t s and places x m along a line; rows of one time stand together */
struct profile {
  int     n;
  double *t, *x, *v;
};

struct metric {
  char            name[NAME_LENGTH];
  int             measure;
  char            field[NAME_LENGTH];     /* of cells or points at one time ... */
  char            gauge[NAME_LENGTH];     /* ... or of a gauge over a span of time */
  char            over[NAME_LENGTH];      /* a gauge whose number at the same time the result is divided by; "": none */
  char            reference[NAME_LENGTH]; /* "name.quantity"; empty: the value itself */
  struct function expected;               /* used when reference is empty */
  struct shape    region;
  double          at, from, to; /* s, or in units of the reference's time scale; INFINITY: the end */
  bool            scaled_time;
  double          scale;   /* result is divided by it; 0: by the reference's scale of that quantity */
  double          offset;  /* added to the gauge before comparing */
  double          share;   /* MEASURE_REACH: of the way */
  double          shift;   /* s, MEASURE_FIT: the largest */
  struct profile  profile; /* MEASURE_PROFILE */
};

/* Bodies that meet: each has its own velocities at the nodes. */
enum contact_normal { NORMAL_WEIGHTED, NORMAL_DIFFERENCE };
enum contact_detection { DETECT_REACH, DETECT_APPROACH };
struct contact {
  bool   present;
  double friction; /* Coulomb coefficient; INFINITY: bodies that touch stick */
  int    normal, detection;
};

enum { FOLDER_LENGTH = 1024 };

enum start_kind { START_AT_REST, START_ZERO };
enum basis { BASIS_LINEAR, BASIS_GIMP, BASIS_QUADRATIC, BASIS_CUBIC };
#define BASIS_WORDS "linear|gimp|quadratic|cubic"
enum transfer { TRANSFER_PIC, TRANSFER_FLIP, TRANSFER_APIC, TRANSFER_AFLIP };
#define TRANSFER_WORDS "pic|flip|apic|aflip"
enum stress_timing { STRESS_LAST, STRESS_MUSL };
enum wall_basis { WALL_MIRRORED, WALL_MODIFIED };
enum pressure_solver { SOLVER_AUTO, SOLVER_HYPRE, SOLVER_DIRECT };

struct numerics {
  int    basis, transfer, stress_timing, wall_basis, pressure_solver;
  double aflip_beta, points_per_cell; /* points per cell: a square or cube number, or nx x ny x nz below */
  int    points_per_axis[3];          /* their number along each axis */
  double dt_factor, dt_max;           /* s; INFINITY: none */
  double theta;
  double rest_tolerance;     /* a start at rest: rms acceleration that is left, over that of the weight */
  int    rest_steps;         /* most steps of its static solve */
  double pressure_tolerance; /* residual over the largest right-hand side */
};

struct output {
  double interval, gauge_interval; /* s; 0: from time.end */
  double times[64];
  int    n_times;
  double checkpoint_interval; /* s of wall time */
};

struct scene {
  char                  name[NAME_LENGTH], title[256];
  int                   dim;
  double                min[3], max[3], h;
  int                   cells[3];
  bool                  one_cell[3]; /* the scene gave null: this axis is one cell wide whatever h is */
  double                time_end;
  struct function       gravity[3];
  int                   start;                     /* enum start_kind */
  char                  start_from[FOLDER_LENGTH]; /* folder of the run whose end is this one's start; "": none */
  int                   seed;
  int                   n_materials, n_solids, n_loads, n_tracers, n_gauges, n_references, n_metrics;
  int                   n_bodies; /* velocity fields of the solid: 1 without contact */
  struct contact        contact;
  int                   n_history; /* doubles of history per solid point, the most that a law of the scene wants */
  struct material      *materials;
  struct solid         *solids;
  struct load          *loads;
  int                   n_obstacles;
  struct obstacle      *obstacles;
  struct tracer        *tracers;
  struct gauge         *gauges;
  struct reference_use *references;
  struct metric        *metrics;
  struct fluid          fluid;              /* the first one, the liquid */
  int                   n_others, n_fluids; /* n_fluids counts the first one too; 0: a dry scene */
  struct fluid         *others;             /* in the order of the scene; they fill what earlier ones leave */
  struct side_condition solid_side[SIDES], fluid_side[SIDES];
  struct heat_side      heat_side[SIDES];
  struct numerics       numerics;
  void                 *module_params[MAX_MODULES]; /* in the order of run/modules.def */
  struct output         output;
};

/** What a point of the solid is made of: points are grouped by the solid they come from. */
static inline const struct material *scene_material(const struct scene *scene, int group)
{
  return &scene->materials[scene->solids[group].material];
}

/** Fluid i < n_fluids; 0 is the liquid. */
static inline const struct fluid *scene_fluid(const struct scene *scene, int i)
{
  return i == 0 ? &scene->fluid : &scene->others[i - 1];
}

/** Parameters of a module, as its table filled them. */
const void *scene_module_params(const struct scene *scene, const struct module *module);

#endif
