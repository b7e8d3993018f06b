/* Ideal gas: air, sound, an isentrope, the shock tube's energies. */
#include "tests/eos/law.h"

static double prm[LAW_DOUBLES];

static const struct eos *air(void)
{
  const struct eos *law = law_find("ideal_gas", prm);
  law_set(law, prm, "reference_density", 1.1766);
  return law;
}

/* R = 287.05 J/kg/K; 1.1766 kg/m3 at 300 K are 1.269 at 5 degrees */
START_TEST(density_of_air)
{
  const struct eos *law = air();
  LAW_CLOSE(law_density(law, prm, 101325.0, 300.0), 1.1766, 1e-14);
  LAW_CLOSE(law_pressure(law, prm, 1.0, 1.0), 287.05, 3e-5);
  LAW_CLOSE(law_density(law, prm, 101325.0, 278.15), 1.2690275, 1e-7);
  LAW_CLOSE(law_density(law, prm, 2e5, 300.0), 2.3224278312, 1e-10);
}
END_TEST

/* sqrt(R T) and sqrt(gamma R T), gamma 1.40002 */
START_TEST(sound)
{
  const struct eos *law = air();
  for (double P = 1e3; P < 1e8; P *= 10.0) {
    LAW_CLOSE(law_sound_speed(law, prm, P, 300.0), 293.456602, 1e-8);
    LAW_CLOSE(law_adiabatic_speed(law, prm, P, 300.0), 347.225286, 1e-8);
  }
}
END_TEST

/* compressed to twice the density without heat, de = P/rho^2 drho in 400 steps of Runge and Kutta: P rho^-gamma stays
 */
START_TEST(isentrope)
{
  const struct eos *law = air();
  double            rho = 1.1766, e = law_energy(law, prm, rho, 300.0), d = rho / 400.0;
  for (int i = 0; i < 400; i++) {
    double slope[4], e_at = e, rho_at = rho;
    for (int k = 0; k < 4; k++) {
      slope[k] = law_pressure(law, prm, rho_at, law_temperature(law, prm, rho_at, e_at)) / (rho_at * rho_at);
      rho_at = rho + (k < 2 ? 0.5 : 1.0) * d;
      e_at = e + (k < 2 ? 0.5 : 1.0) * d * slope[k];
    }
    e += d / 6.0 * (slope[0] + 2.0 * slope[1] + 2.0 * slope[2] + slope[3]);
    rho += d;
  }
  double T = law_temperature(law, prm, rho, e);
  LAW_CLOSE(T, 395.85846, 1e-8);
  LAW_CLOSE(law_pressure(law, prm, rho, T), 267402.39, 1e-8);
}
END_TEST

/* R 1, c_v 2.5: e = P/((gamma - 1) rho) = 2.5 and 2 in the two halves of Sod's tube */
START_TEST(shock_tube)
{
  const struct eos *law = law_find("ideal_gas", prm);
  law_set(law, prm, "reference_density", 1.0);
  law_set(law, prm, "reference_pressure", 1.0);
  law_set(law, prm, "reference_temperature", 1.0);
  law_set(law, prm, "heat_capacity", 2.5);
  LAW_CLOSE(law_pressure(law, prm, 1.0, law_temperature(law, prm, 1.0, 2.5)), 1.0, 1e-15);
  LAW_CLOSE(law_pressure(law, prm, 0.125, law_temperature(law, prm, 0.125, 2.0)), 0.1, 1e-15);
  LAW_CLOSE(law_adiabatic_speed(law, prm, 1.0, 1.0), sqrt(1.4), 1e-15);
}
END_TEST

/* down to 0.1 Pa and 0.3 K; beyond it a positive density, and told */
START_TEST(near_vacuum)
{
  const struct eos *law = air();
  ck_assert_int_eq(law_outside(law, prm, 0.102, 300.0), 0);
  ck_assert_int_eq(law_outside(law, prm, 0.101, 300.0), 1);
  ck_assert_int_eq(law_outside(law, prm, 1e5, 0.29), 1);
  LAW_CLOSE(law_density(law, prm, 0.0, 300.0), 0.5 * 1.1766e-6, 1e-12);
  ck_assert_double_gt(law_density(law, prm, -1e5, 300.0), 0.0);
  ck_assert_double_lt(law_density(law, prm, -1e5, 300.0), law_density(law, prm, 0.0, 300.0));
}
END_TEST

LAW_TESTS("eos/ideal_gas", density_of_air, sound, isentrope, shock_tube, near_vacuum)
