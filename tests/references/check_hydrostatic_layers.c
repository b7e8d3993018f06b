/* Layers at rest: figures, and Runge and Kutta down through the equations of state of the program. */
#include "eos/eos.h"
#include "tests/references/reference_test.h"

static const struct reference *layers(void) { return reference_find("hydrostatic_layers"); }

/* a metre of air over a metre of water; M's air is 1.176624 at 300 K */
static void *air_over_water(void)
{
  void *prm = defaults(layers());
  set(layers(), prm, "top", 2);
  set(layers(), prm, "interface", 1);
  set(layers(), prm, "upper_density", 101325 / (287.05 * 300));
  return prm;
}

static double at(const void *prm, const char *quantity, double y) { return value_at(layers(), prm, quantity, 0, y, 0); }

START_TEST(air_and_water)
{
  void *prm = air_over_water();
  CLOSE(at(prm, "interface_pressure", 0), 101336.54, 0.005);
  CLOSE(at(prm, "base_pressure", 0), 111146.57, 0.005);
  CLOSE(at(prm, "P", 2), 101325, 1e-9);
  CLOSE(at(prm, "P", 1), at(prm, "interface_pressure", 0), 1e-9);
  CLOSE(at(prm, "density", 1.999999), 1.176624, 1e-6);
  CLOSE(at(prm, "density", 0), 1000 * (1 + 9821.57 / 2.2e9), 1e-6);
  CLOSE(at(prm, "upper_mass", 0), 1.176691, 1e-6);
  free(prm);
}
END_TEST

/* a law of the program with the parameters of the layer */
static const struct eos *law(const char *word, double density, double *prm)
{
  const struct eos *e = eos_find(strcmp(word, "gas") == 0    ? "isothermal_gas"
                                 : strcmp(word, "tait") == 0 ? word
                                                             : "linear_water");
  for (const struct param *p = e->params; p->name; p++) {
    double v = strcmp(p->name, "reference_density") == 0    ? density
               : strcmp(p->name, "bulk_modulus") == 0       ? 2e6
               : strcmp(p->name, "gamma") == 0              ? 3
               : strcmp(p->name, "reference_pressure") == 0 ? 1e5
                                                            : strtod(p->fallback, NULL);
    memcpy((char *)prm + p->offset, &v, sizeof v);
  }
  return e;
}

/* Pa at the depth d below the pressure P; mass adds what it passed, kg/m2 */
static double down(const struct eos *e, const double *prm, double P, double d, double *mass)
{
  enum { N = 200 };
  double h = d / N, rho[4], p;
  *mass = 0;
  for (int i = 0; i < N; i++) {
    for (int k = 0; k < 4; k++) {
      p = P + (k == 0 ? 0 : k < 3 ? 0.5 : 1) * h * 9.81 * (k == 0 ? 0 : rho[k - 1]);
      e->density(prm, 1, &p, NULL, &rho[k]);
    }
    double mean = (rho[0] + 2 * rho[1] + 2 * rho[2] + rho[3]) / 6;
    P += h * 9.81 * mean;
    *mass += h * mean;
  }
  return P;
}

/* soft liquids and gases, 200 m deep: they are 1.5 to 2.7 times as dense below as above */
START_TEST(runge_kutta)
{
  static const char *const words[3] = {"linear", "tait", "gas"};
  for (int i = 0; i < 9; i++) {
    const char *upper = words[i / 3], *lower = words[i % 3];
    double      rho[2] = {i / 3 == 2 ? 5 : 500, i % 3 == 2 ? 5 : 900}, own[16], mass;
    void       *prm = defaults(layers());
    for (int k = 0; k < 2; k++) {
      set(layers(), prm, k ? "lower_density" : "upper_density", rho[k]);
      set(layers(), prm, k ? "lower_bulk_modulus" : "upper_bulk_modulus", 2e6);
      set(layers(), prm, k ? "lower_gamma" : "upper_gamma", 3);
      set(layers(), prm, k ? "lower_reference_pressure" : "upper_reference_pressure", 1e5);
    }
    set_word(layers(), prm, "upper_law", upper);
    set_word(layers(), prm, "lower_law", lower);
    set(layers(), prm, "top", 50);
    set(layers(), prm, "interface", -30);
    set(layers(), prm, "base", -150);
    set(layers(), prm, "top_pressure", 1.2e5);
    double P = down(law(upper, rho[0], own), own, 1.2e5, 80, &mass);
    CLOSE(at(prm, "interface_pressure", 0), P, 1e-9 * P);
    CLOSE(at(prm, "upper_mass", 0), mass, 1e-8 * mass);
    P = down(law(lower, rho[1], own), own, P, 120, &mass);
    CLOSE(at(prm, "base_pressure", 0), P, 1e-9 * P);
    CLOSE(at(prm, "P", -150), P, 1e-9 * P);
    CLOSE(at(prm, "lower_mass", 0), mass, 1e-8 * mass);
    free(prm);
  }
}
END_TEST

/* incompressible: rho g d; gamma 1 is linear, and near it nearly; what cannot be is told */
START_TEST(limits)
{
  void        *prm = air_over_water();
  const double x[1][3] = {{0}};
  double       v, linear = at(prm, "base_pressure", 0);
  set_word(layers(), prm, "lower_law", "tait");
  set(layers(), prm, "lower_gamma", 1);
  CLOSE(at(prm, "base_pressure", 0), linear, 1e-9);
  set(layers(), prm, "lower_gamma", 1 + 1e-9);
  CLOSE(at(prm, "base_pressure", 0), linear, 1e-7);
  set(layers(), prm, "lower_bulk_modulus", INFINITY);
  CLOSE(at(prm, "base_pressure", 0), at(prm, "interface_pressure", 0) + 9810, 1e-9);
  CLOSE(at(prm, "density", 0.3), 1000, 1e-12);
  set(layers(), prm, "upper_reference_pressure", 0);
  ck_assert_int_eq(layers()->value(prm, 0, 1, x, 0, &v), ERR_INPUT);
  set(layers(), prm, "top", 0);
  ck_assert_int_eq(layers()->value(prm, 0, 1, x, 0, &v), ERR_INPUT);
  free(prm);
}
END_TEST

RUN_TESTS("hydrostatic_layers", air_and_water, runge_kutta, limits)
