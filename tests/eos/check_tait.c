/* Tait's liquid: figures of its formula, its limits, and the work of a compression. */
#include "tests/eos/law.h"

static double prm[LAW_DOUBLES];

static const struct eos *water(void)
{
  const struct eos *law = law_find("tait", prm);
  law_set(law, prm, "reference_density", 1000.0);
  law_set(law, prm, "bulk_modulus", 2.2e9);
  return law;
}

/* (1 + 7.15 P/2.2e9)^(1/7.15), twenty digits elsewhere; linear water would be 0.5 % denser at 100 MPa */
START_TEST(compressed)
{
  const struct eos *law = water();
  LAW_CLOSE(law_density(law, prm, 1e8, 283.15), 1040.14318954984, 1e-14);
  LAW_CLOSE(law_density(law, prm, 1e9, 283.15), 1224.29637512490, 1e-14);
  LAW_CLOSE(law_density(law, prm, -1e8, 283.15), 946.512604613788, 1e-14);
  LAW_CLOSE(law_pressure(law, prm, 1040.14318954984, 283.15), 1e8, 1e-12);
}
END_TEST

/* K + 7.15 P, and c of it */
START_TEST(bulk_modulus_grows)
{
  const struct eos *law = water();
  LAW_CLOSE(1.0 / law_compressibility(law, prm, 1e8, 283.15), 2.2e9 + 7.15e8, 1e-14);
  LAW_CLOSE(law_sound_speed(law, prm, 0.0, 283.15), 1483.2397, 1e-7);
  LAW_CLOSE(law_sound_speed(law, prm, 1e8, 283.15), sqrt(2.915e9 / 1040.14318954984), 1e-13);
}
END_TEST

START_TEST(with_gamma_1_it_is_linear_water)
{
  double            other[LAW_DOUBLES];
  const struct eos *law = water(), *linear = law_find("linear_water", other);
  law_set(law, prm, "gamma", 1.0);
  law_set(linear, other, "reference_density", 1000.0);
  law_set(linear, other, "bulk_modulus", 2.2e9);
  law_set(law, prm, "expansion", 2e-4);
  law_set(linear, other, "expansion", 2e-4);
  for (double P = -2.1e9; P < 1e10; P += 3e8)
    for (double T = 250.0; T < 400.0; T += 50.0) {
      double rho = law_density(linear, other, P, T);
      LAW_CLOSE(law_density(law, prm, P, T), rho, 1e-13);
      LAW_CLOSE(law_compressibility(law, prm, P, T), law_compressibility(linear, other, P, T), 1e-12);
      LAW_CLOSE(law_expansion(law, prm, P, T), law_expansion(linear, other, P, T), 1e-12);
      ck_assert_double_eq_tol(law_energy(law, prm, rho, T), law_energy(linear, other, rho, T), 1e-7);
      ck_assert_int_eq(law_outside(law, prm, P, T), law_outside(linear, other, P, T));
    }
}
END_TEST

/* kept warm from 1000 to 1040 kg/m3: the work is the integral of P/rho^2, 1813.4586 J/kg by quadrature */
START_TEST(energy_of_compression)
{
  const struct eos *law = water();
  double            work = law_energy(law, prm, 1040.0, 283.15) - law_energy(law, prm, 1000.0, 283.15);
  LAW_CLOSE(work, 1813.4586140033, 1e-10);
  LAW_CLOSE(law_energy(law, prm, 1040.0, 284.15) - law_energy(law, prm, 1040.0, 283.15), 4186.0, 1e-10);
}
END_TEST

/* the bulk modulus is a tenth at -2.2e9 * 0.9/7.15 = -276.9 MPa */
START_TEST(tension)
{
  const struct eos *law = water();
  ck_assert_int_eq(law_outside(law, prm, -2.769e8, 283.15), 0);
  ck_assert_int_eq(law_outside(law, prm, -2.770e8, 283.15), 1);
  ck_assert_double_gt(law_density(law, prm, -1e12, 283.15), 0.0);
}
END_TEST

LAW_TESTS("eos/tait", compressed, bulk_modulus_grows, with_gamma_1_it_is_linear_water, energy_of_compression, tension)
