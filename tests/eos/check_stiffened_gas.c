/* Stiffened gas: water of gamma 4.4, p_inf 600 MPa; its limit, the ideal gas; a shock. */
#include "tests/eos/law.h"

static double prm[LAW_DOUBLES];

static const struct eos *water(void)
{
  const struct eos *law = law_find("stiffened_gas", prm);
  law_set(law, prm, "reference_density", 1000.0);
  law_set(law, prm, "bulk_modulus", 6e8);
  return law;
}

/* c = sqrt(4.4 * 6e8/1000) = 1624.8 m/s at constant entropy, a factor sqrt(4.4) less at constant temperature */
START_TEST(sound)
{
  const struct eos *law = water();
  LAW_CLOSE(law_adiabatic_speed(law, prm, 0.0, 283.15), 1624.807681, 1e-9);
  LAW_CLOSE(law_sound_speed(law, prm, 0.0, 283.15), 774.596669, 1e-9);
  LAW_CLOSE(1.0 / law_compressibility(law, prm, 1e8, 350.0), 7e8, 1e-14);
}
END_TEST

/* P = (gamma - 1) rho e - gamma p_inf, whatever c_v is */
START_TEST(energy)
{
  const struct eos *law = water();
  for (double P = 1e5; P < 1e10; P *= 10.0)
    for (double rho = 500.0; rho < 1600.0; rho += 250.0) {
      double e = (P + 4.4 * 6e8) / (3.4 * rho), T = law_temperature(law, prm, rho, e);
      ck_assert_double_eq_tol(law_pressure(law, prm, rho, T), P, 1e-14 * (P + 6e8));
      LAW_CLOSE(law_energy(law, prm, rho, T), e, 1e-14);
      LAW_CLOSE(law_adiabatic_speed(law, prm, P, T), sqrt(4.4 * (P + 6e8) / rho), 1e-12);
    }
  LAW_CLOSE(law->heat_capacity(prm), 6e8 / (3.4 * 1000.0 * 283.15), 1e-14);
}
END_TEST

/* jump over a shock into water at rest, pushed by u: D^2 - (gamma + 1)/2 u D = c0^2 is its speed, mass and momentum
 * give density and P1 = rho0 D u, and energy must jump by P1/2 (1/rho0 - 1/rho1) */
START_TEST(shock)
{
  const struct eos *law = water();
  double            u = 200.0, c0 = sqrt(4.4 * 6e8 / 1000.0), half = 0.25 * (4.4 + 1.0) * u;
  double            D = half + sqrt(half * half + c0 * c0), P1 = 1000.0 * D * u, rho1 = 1000.0 * D / (D - u);
  double            T0 = 283.15, e0 = law_energy(law, prm, 1000.0, T0), e1 = e0 + 0.5 * P1 * (1e-3 - 1.0 / rho1);
  LAW_CLOSE(law_pressure(law, prm, rho1, law_temperature(law, prm, rho1, e1)), P1, 1e-12);
}
END_TEST

START_TEST(without_stiffness_it_is_an_ideal_gas)
{
  double            other[LAW_DOUBLES];
  const struct eos *law = law_find("stiffened_gas", prm), *ideal = law_find("ideal_gas", other);
  law_set(law, prm, "reference_density", 1.1766);
  law_set(law, prm, "bulk_modulus", 101325.0);
  law_set(law, prm, "reference_pressure", 101325.0);
  law_set(law, prm, "reference_temperature", 300.0);
  law_set(law, prm, "gamma", 1.4);
  law_set(ideal, other, "reference_density", 1.1766);
  law_set(ideal, other, "heat_capacity", law->heat_capacity(prm));
  for (double P = -1.0; P < 1e7; P = 3.0 * P + 4.0)
    for (double T = 100.0; T < 1000.0; T += 300.0) {
      double rho = law_density(ideal, other, P, T);
      LAW_CLOSE(law_density(law, prm, P, T), rho, 1e-14);
      LAW_CLOSE(law_energy(law, prm, rho, T), law_energy(ideal, other, rho, T), 1e-14);
      LAW_CLOSE(law_adiabatic_speed(law, prm, P, T), law_adiabatic_speed(ideal, other, P, T), 1e-12);
    }
}
END_TEST

LAW_TESTS("eos/stiffened_gas", sound, energy, shock, without_stiffness_it_is_an_ideal_gas)
