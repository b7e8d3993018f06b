/* A heavy elastic beam that is let go: a finite-element solution. docs/references.md, "Cantilever". */
#ifndef REFERENCES_CANTILEVER_H
#define REFERENCES_CANTILEVER_H

#include "core/status.h"

/* A block held at x = 0, of length x height, plane strain, neo-Hookean; weight along -y from t = 0 on. Spectral
 * elements: n[0] x n[1] rectangles of polynomials of this order. */
struct cantilever {
  double length, height;          /* m */
  double young, poisson, density; /* Pa, -, kg/m3 */
  double gravity;                 /* m/s2 */
  int    n[2], order;
};

struct cantilever_sample {
  double t, tip[2]; /* s; m: displacement of the middle of the free end */
  double energy;    /* J per metre: kinetic, elastic and of the weight; 0 at the start */
};

/** Samples at t = 0, interval, 2 interval, ... ERR_DIVERGED: an element turned inside out. */
enum status cantilever_solve(const struct cantilever *c, double interval, int n_samples,
                             struct cantilever_sample *samples) MUST_CHECK;

#endif
