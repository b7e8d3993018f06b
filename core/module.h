/* A module: a folder's stages, fields and parameters. All that run/ knows of mpm, coupling, ice, ... */
#ifndef CORE_MODULE_H
#define CORE_MODULE_H

#include "core/field.h"
#include "core/param.h"
#include "core/stage.h"

struct ledger;

struct module {
  const char *name; /* the folder; for a fluid path also its word in fluid.path */
  bool        is_fluid_path;
  bool        several_fluids; /* a fluid path: it takes more than one fluid */
  enum where  meets_at;       /* a fluid path: where it wants the solid, AT_NODE or AT_FACE */
  bool (*needed)(const struct scene *);
  const struct param *params; /* numerics.<name>.*; ends with PARAM_END; may be NULL */
  size_t              params_size;
  const struct field *fields; /* made from fields.def */
  int                 n_fields;
  const struct stage *stages;
  int                 n_stages;
  size_t              state_size;
  /** Number of points the module wants in each set, n [N_COUNTS], and their groups [N_SETS]; NULL: none. */
  enum status (*count)(const struct scene *, long n[], int groups[]);
  /** Fills the initial state; every planned field is allocated and zero. */
  enum status (*create)(struct sim *, void *state);
  void (*destroy)(void *state);
  /* numbers of the state that are not fields but are checkpointed: doubles at this offset */
  size_t numbers_offset;
  int    n_numbers;
  /** Adds what the module holds now (masses, momenta, energies) to the ledger. */
  void (*measure)(const struct sim *, struct ledger *);
};

#endif
