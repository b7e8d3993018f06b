/* What conduction and exchange of heat need of the cells. theory 4.12 */
#ifndef ICE_HEAT_PHASE_H
#define ICE_HEAT_PHASE_H

#include <stdbool.h>

/* The fluid or the grains: what conduction needs of the cells. */
struct heat_phase {
  double *T;            /* [size] K; the fluid's T_cc, the grains' T_solid_cc */
  double *capacity;     /* [size] J/K; 1 where there is nothing to warm, which then conducts nothing either */
  double *conductivity; /* [size] W/(m K), of the phase's share of the space */
  double *conductance;  /* [dim][size] W/K through a face */
  double *outside;      /* [size] W/K to sides of given temperature */
  double *source;       /* [size] W: what these give, times their temperature, and sides with a flux */
  double *share;        /* [size] of the area of a side that this phase gets a flux through */
  double *diagonal, *change, *rest, *search, *image, *eased; /* [size] of the solver */
};

/* Conduction and exchange of one or two phases over a step. */
struct heat {
  int               n_phases;
  struct heat_phase phase[2];
  double           *exchange; /* [size] W/K between the phases */
  double           *centre;   /* [size][dim] m, mean place of a cell's grains, weighted with their capacity */
  double           *row_sum;  /* [rows of cells] */
  bool              held;     /* the grains do not move: they conduct here, else on the nodes of mpm/heat.c */
};

#endif
