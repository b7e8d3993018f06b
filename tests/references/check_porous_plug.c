/* Flow through a plug: fifteen points for three laws against a table, and each law against its own closed form. */
#include "tests/references/reference_test.h"

static const struct reference *plug(void) { return reference_find("porous_plug"); }

static void *column(const char *law, double porosity, double drop)
{
  void *prm = defaults(plug());
  set_word(plug(), prm, "law", law);
  set(plug(), prm, "porosity", porosity);
  set(plug(), prm, "grain_diameter", 1e-3);
  set(plug(), prm, "density", 998);
  set(plug(), prm, "viscosity", 1e-3);
  set(plug(), prm, "length", 1.0);
  set(plug(), prm, "inlet", 0.5);
  set(plug(), prm, "pressure_drop", drop);
  if (strcmp(law, "ergun") == 0) set(plug(), prm, "kozeny_factor", 150);
  return prm;
}

/* porous_flow: grain fraction, drop in atm, pore velocity by Kozeny-Carman 180, Beetstra, Ergun (150, 1.75). The last
 * column belongs to a liquid of 1000 kg/m3, the others to 998. */
static const double      table[15][5] = {{0.60, 0.25, 0.0625462963, 0.04953013244, 0.05311383027},
                                         {0.60, 0.5, 0.1250925926, 0.08419478157, 0.08879156378},
                                         {0.60, 1, 0.2501851852, 0.1387545636, 0.1424330634},
                                         {0.62, 0.25, 0.05286496271, 0.04393033563, 0.04738355737},
                                         {0.62, 0.5, 0.1057299254, 0.0754864826, 0.08051796023},
                                         {0.62, 1, 0.2114598508, 0.1255385181, 0.1310144228},
                                         {0.66, 0.25, 0.03734685874, 0.03375938604, 0.03671476901},
                                         {0.66, 0.5, 0.07469371748, 0.05960156335, 0.06457261102},
                                         {0.66, 1, 0.149387435, 0.1010529088, 0.1085054293},
                                         {0.68, 0.25, 0.03116493656, 0.02913369381, 0.03183410348},
                                         {0.68, 0.5, 0.06232987313, 0.05237304965, 0.05697428908},
                                         {0.68, 1, 0.1246597463, 0.08979276123, 0.09745194909},
                                         {0.70, 0.25, 0.02584821429, 0.02480513553, 0.02729324974},
                                         {0.70, 0.5, 0.05169642857, 0.04556493535, 0.04969015618},
                                         {0.70, 1, 0.1033928571, 0.07918509915, 0.08658586687}};
static const char *const laws[3] = {"kozeny_carman", "beetstra", "ergun"};

START_TEST(forty_five_points)
{
  for (int i = 0; i < 15; i++)
    for (int law = 0; law < 3; law++) {
      void  *prm = column(laws[law], 1 - table[i][0], 101325 * table[i][1]);
      double wanted = table[i][2 + law];
      if (law == 2) set(plug(), prm, "density", 1000);
      CLOSE(value_at(plug(), prm, "vel_x", 1.0, 0, 0) / wanted, 1, 2e-9);
      CLOSE(value_at(plug(), prm, "flux", 1.0, 0, 0) / (wanted * (1 - table[i][0])), 1, 2e-9);
      free(prm);
    }
}
END_TEST

/* Ergun solved as a quadratic: 150 mu (1-n)^2/(D^2 n^2) U + 1.75 rho (1-n)/(D n) U^2 = drop/L, U pore velocity */
START_TEST(ergun_is_a_quadratic)
{
  for (double n = 0.2; n < 0.9; n += 0.1) {
    void  *prm = column("ergun", n, 3e4);
    double a = 1.75 * 998 * (1 - n) / 1e-3 / n, b = 150 * 1e-3 * (1 - n) * (1 - n) / 1e-6 / (n * n);
    CLOSE(value_at(plug(), prm, "vel_x", 1.0, 0, 0), (-b + sqrt(b * b + 4 * a * 3e4)) / (2 * a), 1e-12);
    free(prm);
  }
}
END_TEST

/* Beetstra's F(phi, Re) by a fixed point in U */
START_TEST(beetstra_is_a_fixed_point)
{
  double s = 0.62, n = 0.38, U = 0.05;
  void  *prm = column("beetstra", n, 5e4);
  for (int i = 0; i < 200; i++) {
    double Re = n * 998 * 1e-3 * U / 1e-3;
    double F0 = 10 * s / pow(1 - s, 2) + pow(1 - s, 2) * (1 + 1.5 * sqrt(s));
    double F1 = 0.413 * Re / (24 * pow(1 - s, 2)) * (1 / (1 - s) + 3 * s * (1 - s) + 8.4 * pow(Re, -0.343)) /
                (1 + pow(10, 3 * s) * pow(Re, -(1 + 4 * s) / 2));
    U = 0.5 * (U + n * 5e4 / (18 * s * (1 - s) * 1e-3 / 1e-6 * (F0 + F1)));
  }
  CLOSE(value_at(plug(), prm, "vel_x", 1.0, 0, 0), U, 1e-12);
  CLOSE(value_at(plug(), prm, "reynolds", 1.0, 0, 0), n * 998 * U, 1e-9);
  free(prm);
}
END_TEST

START_TEST(darcy_and_pressure)
{
  void        *prm = column("darcy", 0.4, 1e4);
  const double x[1][3] = {{1}};
  double       v;
  ck_assert_int_eq(plug()->value(prm, 0, 1, x, 0, &v), ERR_INPUT);
  set(plug(), prm, "permeability", 0.01);
  CLOSE(value_at(plug(), prm, "flux", 1, 0, 0), 0.01 * 1e4 / (998 * 9.81), 1e-12);
  ck_assert_double_eq(value_at(plug(), prm, "P", 0.2, 0, 0), 1e4);
  CLOSE(value_at(plug(), prm, "P", 0.75, 0, 0), 7.5e3, 1e-9);
  ck_assert_double_eq(value_at(plug(), prm, "P", 1.9, 0, 0), 0);
  CLOSE(value_at(plug(), prm, "vel_x", 0.2, 0, 0), value_at(plug(), prm, "flux", 1, 0, 0), 1e-15);
  free(prm);
}
END_TEST

RUN_TESTS("porous_plug", forty_five_points, ergun_is_a_quadratic, beetstra_is_a_fixed_point, darcy_and_pressure)
