/* Isothermal gas: air that keeps its temperature. */
#include "tests/eos/law.h"

static double prm[LAW_DOUBLES];

static const struct eos *air(void)
{
  const struct eos *law = law_find("isothermal_gas", prm);
  law_set(law, prm, "reference_density", 1.1766);
  return law;
}

START_TEST(boyle)
{
  const struct eos *law = air();
  for (double P = 1.0; P < 1e8; P *= 7.0) {
    LAW_CLOSE(law_density(law, prm, P, 300.0) / P, 1.1766 / 101325.0, 1e-14);
    LAW_CLOSE(law_compressibility(law, prm, P, 300.0), 1.0 / P, 1e-14);
    LAW_CLOSE(law_sound_speed(law, prm, P, 300.0), 293.456602, 1e-8);
    LAW_CLOSE(law_adiabatic_speed(law, prm, P, 300.0), 293.456602, 1e-8);
    ck_assert_double_eq(law_density(law, prm, P, 300.0), law_density(law, prm, P, 500.0));
    ck_assert_double_eq(law_expansion(law, prm, P, 300.0), 0.0);
  }
}
END_TEST

/* the ideal gas at its reference temperature */
START_TEST(is_the_ideal_gas_at_300_K)
{
  double            other[LAW_DOUBLES];
  const struct eos *law = air(), *ideal = law_find("ideal_gas", other);
  law_set(ideal, other, "reference_density", 1.1766);
  for (double P = -10.0; P < 1e7; P = 3.0 * P + 29.0)
    LAW_CLOSE(law_density(law, prm, P, 350.0), law_density(ideal, other, P, 300.0), 1e-14);
}
END_TEST

/* work of halving the volume: a ln 2, a = 101325/1.1766 */
START_TEST(work)
{
  const struct eos *law = air();
  double            work = law_energy(law, prm, 2.3532, 300.0) - law_energy(law, prm, 1.1766, 300.0);
  LAW_CLOSE(work, 101325.0 / 1.1766 * log(2.0), 1e-13);
}
END_TEST

LAW_TESTS("eos/isothermal_gas", boyle, is_the_ideal_gas_at_300_K, work)
