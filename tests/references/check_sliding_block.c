/* Sliding block: tabulated distances, balances of momentum and energy, sticking. */
#include "tests/references/reference_test.h"

#include <math.h>

static const struct reference *theory(double friction, void **prm)
{
  const struct reference *r = reference_find("sliding_block");
  *prm = defaults(r);
  set(r, *prm, "angle_deg", 30);
  set(r, *prm, "friction", friction);
  set(r, *prm, "mass", 40);
  return r;
}

/* m after 1 s and m/s after 0.05 s, worked out by hand */
START_TEST(tabulated)
{
  static const double friction[] = {0, 0.2, 0.4, 0.6}, distance[] = {2.4525, 1.6029291, 0.7533582, 0},
                      speed[] = {0.24525, 0.16029291, 0.07533582, 0};
  for (int i = 0; i < 4; i++) {
    void                   *prm;
    const struct reference *r = theory(friction[i], &prm);
    ck_assert_double_eq_tol(value_at(r, prm, "distance", 0, 0, 1), distance[i], 1e-7);
    ck_assert_double_eq_tol(value_at(r, prm, "speed", 0, 0, 0.05), speed[i], 1e-8);
    free(prm);
  }
}
END_TEST

/* what the plane gives and the weight make the momentum; what is lost is the fall less the speed */
START_TEST(balances)
{
  for (double friction = 0; friction < 1; friction += 0.1) {
    void                   *prm;
    const struct reference *r = theory(friction, &prm);
    double t = 0.7, v = value_at(r, prm, "speed", 0, 0, t), s = value_at(r, prm, "distance", 0, 0, t), c = sqrt(0.75);
    double weight = 40 * 9.81 * t;
    ck_assert_double_eq_tol(value_at(r, prm, "impulse_x", 0, 0, t), 40 * v * c, 1e-12 * weight);
    ck_assert_double_eq_tol(value_at(r, prm, "impulse_y", 0, 0, t) - weight, -40 * v * 0.5, 1e-12 * weight);
    ck_assert_double_eq_tol(value_at(r, prm, "normal_impulse", 0, 0, t), weight * c, 1e-12 * weight);
    ck_assert_double_eq_tol(value_at(r, prm, "tangential_impulse", 0, 0, t) + weight * 0.5, 40 * v, 1e-12 * weight);
    ck_assert_double_eq_tol(value_at(r, prm, "lost", 0, 0, t), 40 * 9.81 * s * 0.5 - 20 * v * v, 1e-10);
    free(prm);
  }
}
END_TEST

/* it moves beyond the angle of friction only */
START_TEST(holds_below_its_angle)
{
  void                   *prm;
  const struct reference *r = theory(tan(30.001 * acos(-1) / 180), &prm);
  ck_assert_double_eq_tol(value_at(r, prm, "distance", 0, 0, 5), 0, 1e-12);
  set(r, prm, "friction", tan(29.999 * acos(-1) / 180));
  ck_assert_double_gt(value_at(r, prm, "distance", 0, 0, 5), 1e-4);
  free(prm);
}
END_TEST

RUN_TESTS("sliding_block", tabulated, balances, holds_below_its_angle)
