/* Submerged soil: against a table from an independent integration, against the balances it must satisfy, and against
 * closed forms. Soil 10 m, water 12 m, E 5 MPa, nu 0.3, n 0.4. */
#include "tests/references/reference_test.h"

static const struct reference *soil(void) { return reference_find("submerged_column"); }

static void *column(const char *law, const char *liquid, double bulk_modulus)
{
  void *prm = defaults(soil());
  set_word(soil(), prm, "law", law);
  set_word(soil(), prm, "liquid", liquid);
  set(soil(), prm, "young", 5e6);
  set(soil(), prm, "poisson", 0.3);
  set(soil(), prm, "porosity", 0.4);
  set(soil(), prm, "solid_density", 2650);
  set(soil(), prm, "bulk_modulus", bulk_modulus);
  set(soil(), prm, "height", 10);
  set(soil(), prm, "water", 12);
  return prm;
}

/* submerged_summary: settlement m, surface m, P and effective stress at the base Pa, to its ten digits */
START_TEST(summary)
{
  static const struct {
    const char *law, *liquid;
    double      K, settlement, surface, P, stress;
  } rows[] = {
      {"engineering_strain", "linear", INFINITY, 0.07214554286, 12, 117720, -97119},
      {"log_rate", "linear", INFINITY, 0.07179979234, 12, 117720, -97119},
      {"neo_hookean", "linear", INFINITY, 0.07150600329, 12, 117720, -97119},
      {"engineering_strain", "logarithmic", 2e7, 0.07202982153, 11.98541413, 117923.8814, -96915.1186},
      {"log_rate", "logarithmic", 2e7, 0.071685269, 11.98541337, 117923.8739, -96915.12613},
      {"neo_hookean", "logarithmic", 2e7, 0.07139249282, 11.98541272, 117923.8675, -96915.13252},
      {"engineering_strain", "linear", 2e7, 0.07203000308, 11.98544165, 117923.4707, -96915.52926},
      {"log_rate", "linear", 2e7, 0.07168544855, 11.98544089, 117923.4632, -96915.53676},
      {"neo_hookean", "linear", 2e7, 0.07139267067, 11.98544025, 117923.4569, -96915.54313},
      {"log_rate", "logarithmic", 2.2e9, 0.07179875165, 11.99986751, 117721.8498, -97117.15018},
      {"neo_hookean", "logarithmic", 2.2e9, 0.07150497182, 11.9998675, 117721.8498, -97117.15023},
  };
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
    void *prm = column(rows[i].law, rows[i].liquid, rows[i].K);
    CLOSE(value_at(soil(), prm, "settlement", 0, 0, 0), rows[i].settlement, 2e-10);
    CLOSE(value_at(soil(), prm, "displacement_y", 0, 10, 0), -rows[i].settlement, 2e-10);
    CLOSE(value_at(soil(), prm, "surface", 0, 0, 0), rows[i].surface, 1e-8);
    CLOSE(value_at(soil(), prm, "base_pressure", 0, 0, 0), rows[i].P, 1e-4);
    CLOSE(value_at(soil(), prm, "base_stress", 0, 0, 0), rows[i].stress, 1e-4);
    free(prm);
  }
}
END_TEST

/* submerged_finite_log_rate and _neohooke: rows Y 0.5 of the given shape, P and stress where it has come to lie */
START_TEST(profiles)
{
  void *log_rate = column("log_rate", "logarithmic", 2e7), *neo = column("neo_hookean", "logarithmic", 2e7);
  CLOSE(value_at(soil(), log_rate, "P", 0, 0.4930294, 0), 113059.2455, 5e-4);
  CLOSE(value_at(soil(), log_rate, "stress_yy", 0, 0.4930293738, 0), -92076.21991, 2e-4);
  CLOSE(value_at(soil(), log_rate, "stress_yy", 0, 9.528430066, 0), -3882.150576, 2e-4);
  CLOSE(value_at(soil(), log_rate, "P", 0, 9.928314731, 0), 20190.32543, 2e-4);
  CLOSE(value_at(soil(), log_rate, "displacement_y", 0, 0.5, 0), 0.4930293738 - 0.5, 1e-9);
  CLOSE(value_at(soil(), neo, "P", 0, 0.4930709489, 0), 113058.829, 2e-4);
  CLOSE(value_at(soil(), neo, "stress_yy", 0, 0.4930709489, 0), -92076.22627, 2e-4);
  free(log_rate), free(neo);
}
END_TEST

/* stretch from a stress by bisection of the law, written anew */
static double stretch(bool neo_hookean, double stress)
{
  double M = 5e6 * 0.7 / (1.3 * 0.4), G = 5e6 / 2.6, low = 0.9, high = 1.1;
  for (int i = 0; i < 60; i++) {
    double J = 0.5 * (low + high), s = neo_hookean ? ((M - 2 * G) * log(J) + G * (J * J - 1)) / J : M * log(J);
    if (s < stress)
      low = J;
    else
      high = J;
  }
  return low;
}

/* In the settled place: d stress/dy = (1 - n)(rho_s - rho) g and dP/dy = -rho g by differences; grains and liquid
 * are as much as there were. */
static void balances(bool neo_hookean, const char *liquid)
{
  enum { CELLS = 400 };
  void  *prm = column(neo_hookean ? "neo_hookean" : "log_rate", liquid, 2e7);
  double top = 10 - value_at(soil(), prm, "settlement", 0, 0, 0), surface = value_at(soil(), prm, "surface", 0, 0, 0);
  double grains = 0, mass = 0, h = surface / CELLS, e = 1e-3;
  for (int i = 0; i < CELLS; i++) {
    double a = i * h, y = a + 0.5 * h, P = value_at(soil(), prm, "P", 0, y, 0);
    double rho = 1000 * (strcmp(liquid, "linear") == 0 ? 1 + P / 2e7 : exp(P / 2e7));
    double part = fmin(fmax((top - a) / h, 0), 1), middle = a + 0.5 * part * h;
    double s = part > 0 ? 0.6 / stretch(neo_hookean, value_at(soil(), prm, "stress_yy", 0, middle, 0)) * part : 0;
    grains += s * h, mass += (1 - s) * rho * h;
    double slope = (value_at(soil(), prm, "P", 0, y + e, 0) - value_at(soil(), prm, "P", 0, y - e, 0)) / (2 * e);
    CLOSE(slope, -rho * 9.81, 1e-3);
    if (part < 1 || a + h + e > top) continue;
    slope =
        (value_at(soil(), prm, "stress_yy", 0, y + e, 0) - value_at(soil(), prm, "stress_yy", 0, y - e, 0)) / (2 * e);
    CLOSE(slope, s * (2650 - rho) * 9.81, 1e-2);
  }
  CLOSE(grains, 6, 1e-7);
  CLOSE(mass, 6000, 1e-3);
  free(prm);
}

START_TEST(log_rate_balances) { balances(false, "logarithmic"); }
END_TEST
START_TEST(neo_hookean_balances) { balances(true, "linear"); }
END_TEST

/* P = rho g (12 - y), stress = -(1 - n)(rho_s - rho) g (10 - y), u = -gamma'(10 y - y^2/2)/M: submerged_small_strain */
START_TEST(small_strain)
{
  void *prm = column("small_strain", "linear", 2e7);
  CLOSE(value_at(soil(), prm, "P", 0, 1, 0), 107910, 1e-6);
  CLOSE(value_at(soil(), prm, "stress_yy", 0, 1, 0), -87407.1, 1e-6);
  CLOSE(value_at(soil(), prm, "displacement_y", 0, 1, 0), -0.01370765314, 1e-11);
  CLOSE(value_at(soil(), prm, "settlement", 0, 1, 0), 0.072145543, 1e-9);
  free(prm);
}
END_TEST

/* The given shape in equilibrium: nothing settles, P starts at the given surface, gradients as above */
START_TEST(placed)
{
  void  *prm = column("placed", "linear", 2e7);
  double e = 1e-3;
  CLOSE(value_at(soil(), prm, "settlement", 0, 0, 0), 0, 1e-15);
  CLOSE(value_at(soil(), prm, "surface", 0, 0, 0), 12, 1e-15);
  CLOSE(value_at(soil(), prm, "P", 0, 0, 0), 2e7 * (exp(117720 / 2e7) - 1), 1e-6);
  for (double y = 0.5; y < 10; y += 0.5) {
    double rho = 1000 * (1 + value_at(soil(), prm, "P", 0, y, 0) / 2e7);
    double up = value_at(soil(), prm, "stress_yy", 0, y + e, 0), down = value_at(soil(), prm, "stress_yy", 0, y - e, 0);
    CLOSE((up - down) / (2 * e), 0.6 * (2650 - rho) * 9.81, 1e-3);
  }
  CLOSE(value_at(soil(), prm, "stress_yy", 0, 10, 0), 0, 1e-12);
  set(soil(), prm, "base", 3);
  CLOSE(value_at(soil(), prm, "P", 0, 15, 0), 0, 1e-12);
  set(soil(), prm, "water", 9);
  const double x[1][3] = {{0}};
  double       v;
  ck_assert_int_eq(soil()->value(prm, 0, 1, x, 0, &v), ERR_INPUT);
  free(prm);
}
END_TEST

RUN_TESTS("submerged_column", summary, profiles, log_rate_balances, neo_hookean_balances, small_strain, placed)
