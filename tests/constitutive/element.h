/* One material point that a test leads along a path of strain or of mixed strain and stress. */
#ifndef TESTS_CONSTITUTIVE_ELEMENT_H
#define TESTS_CONSTITUTIVE_ELEMENT_H

#include "constitutive/constitutive.h"
#include "core/tensor.h"

#include <check.h>
#include <stdio.h>
#include <stdlib.h>

enum { ELEMENT_HISTORY = 16 };

struct element {
  const struct constitutive_model *law;
  const void                      *prm;
  double                           dt; /* s of a step */
  double                           F[9], stress[6], history[ELEMENT_HISTORY];
  double                           strain[3]; /* logarithmic, of steps along the axes */
  double                           work;      /* plastic, of the last step, J/m3 */
};

/** Starts under a stress xx yy zz. */
static inline struct element element_start(const char *law, const void *prm, double xx, double yy, double zz)
{
  struct element e = {.law = constitutive_find(law), .prm = prm, .dt = 1.0, .stress = {xx, yy, zz}};
  for (int k = 0; k < 9; k += 4) e.F[k] = 1.0;
  if (e.law->start) e.law->start(prm, 1, e.stress, e.history);
  return e;
}

static inline void element_step(struct element *e, const double dF[9])
{
  tensor_product(dF, e->F, e->F);
  ck_assert_int_eq(e->law->update(e->prm, 1, e->dt, dF, e->F, e->stress, e->history, &e->work), 0);
}

/** One step of logarithmic strains along the axes. */
static inline void element_stretch(struct element *e, double xx, double yy, double zz)
{
  const double dF[9] = {exp(xx), 0, 0, 0, exp(yy), 0, 0, 0, exp(zz)};
  element_step(e, dF);
  e->strain[0] += xx, e->strain[1] += yy, e->strain[2] += zz;
}

/** One step of the strain yy that keeps the stress xx at `lateral`; the strain zz is `share` of that of xx. */
static inline void element_compress(struct element *e, double yy, double lateral, double share)
{
  enum { HALVINGS = 60 };
  double low = -4.0 * fabs(yy), high = 4.0 * fabs(yy);
  for (int i = 0; i < HALVINGS; i++) {
    struct element tried = *e;
    double         middle = 0.5 * (low + high);
    element_stretch(&tried, middle, yy, share * middle);
    *(tried.stress[XX] < lateral ? &low : &high) = middle;
  }
  element_stretch(e, 0.5 * (low + high), yy, share * 0.5 * (low + high));
}

/** Triaxial test, and biaxial test in plane strain. */
static inline void element_triaxial(struct element *e, double yy, double lateral)
{
  element_compress(e, yy, lateral, 1.0);
}

static inline void element_biaxial(struct element *e, double yy, double lateral)
{
  element_compress(e, yy, lateral, 0.0);
}

/** Mean pressure p, and q = sigma_xx - sigma_yy: positive in triaxial compression along y. */
static inline double element_p(const struct element *e) { return -(e->stress[XX] + e->stress[YY] + e->stress[ZZ]) / 3; }
static inline double element_q(const struct element *e) { return e->stress[XX] - e->stress[YY]; }

/** sqrt(J2) */
static inline double element_size(const struct element *e)
{
  const double *s = e->stress;
  double        a = s[XX] - s[YY], b = s[YY] - s[ZZ], c = s[ZZ] - s[XX];
  return sqrt((a * a + b * b + c * c) / 6.0 + s[XY] * s[XY] + s[YZ] * s[YZ] + s[XZ] * s[XZ]);
}

/** The main of a test program. */
static inline int element_run(Suite *suite)
{
  SRunner *runner = srunner_create(suite);
  srunner_run_all(runner, CK_NORMAL);
  int failed = srunner_ntests_failed(runner);
  srunner_free(runner);
  return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif
