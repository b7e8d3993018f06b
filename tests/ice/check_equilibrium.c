/* The common pressure of several fluids in a volume: random states, from any guess. */
#include "ice/equilibrium.h"

#include "eos/eos.h"
#include "tests/scene_run.h"

#define BOX "{\"grid\": {\"min\": [0, 0], \"max\": [0.1, 0.1], \"h\": 0.1}, \"time\": {\"end\": 1}, \"start\": \"zero\""
#define MOVING ", \"numerics\": {\"ice\": {\"advection\": true}}}"

static unsigned long long state = 88172645463325252ull;

/* uniform in (0, 1): xorshift */
static double uniform(void)
{
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return ((double)(state >> 11) + 0.5) / 9007199254740992.0;
}

static double between(double low, double high) { return low * pow(high / low, uniform()); }

/* liquids of 1e5 to 1e10 Pa and gases, each law of the list, densities 1 to 1e4 apart */
static const char *const other[] = {
    "{\"density\": %g, \"eos\": {\"law\": \"ideal_gas\"}}",
    "{\"density\": %g, \"eos\": {\"law\": \"isothermal_gas\"}}",
    "{\"density\": %g, \"bulk_modulus\": %g, \"eos\": {\"law\": \"tait\", \"reference_pressure\": 101325}}",
    "{\"density\": %g, \"bulk_modulus\": %g, \"eos\": {\"law\": \"linear_water\", \"reference_pressure\": 101325}}",
    "{\"density\": %g, \"bulk_modulus\": %g, \"eos\": {\"law\": \"stiffened_gas\", \"reference_pressure\": 101325}}",
};
enum { OTHERS = sizeof other / sizeof *other, STATES = 2000 };

static double volume_at(const struct scene *scene, const double *m, double P)
{
  double sum = 0, rho;
  for (int k = 0; k < scene->n_fluids; k++) {
    const struct fluid *fluid = scene_fluid(scene, k);
    fluid->eos->density(fluid->eos_params, 1, &P, NULL, &rho);
    sum += m[k] / rho;
  }
  return sum;
}

static void open_fluids(int kind, int n_fluids, struct scene_run *run)
{
  char   text[2048], one[256], more[256] = "";
  double first = between(10, 1e4), K = between(1e5, 1e10);
  bool   gas = kind < 2;
  snprintf(one, sizeof one, other[kind], gas ? fmin(100, first * between(1e-4, 1)) : first * between(1e-4, 1),
           between(1e5, 1e10));
  if (n_fluids > 2) snprintf(more, sizeof more, ", \"c\": {\"density\": %g}", between(0.1, 10));
  snprintf(text, sizeof text,
           BOX ", \"fluid\": {\"path\": \"ice\", \"pressure\": 101325, \"density\": %g, \"bulk_modulus\": %g, \"eos\": "
               "{\"law\": \"linear_water\", \"reference_pressure\": 101325}}, \"fluids\": {\"b\": %s%s}" MOVING,
           first, K, one, more);
  scene_open(text, run);
}

/* masses that fill 1 m3 at a pressure are given back that pressure, whatever the guess; traces too */
START_TEST(random_states)
{
  int most = 0;
  for (int s = 0; s < STATES / 40; s++) {
    struct scene_run run;
    open_fluids(_i, s % 2 ? 3 : 2, &run);
    const struct scene *scene = &run.loaded->scene;
    for (int q = 0; q < 40; q++) {
      double exact = between(10, 1e8), guess = q % 4 == 0 ? -between(1, 1e9) : between(1e-3, 1e10), P = guess, m[3],
             rho;
      for (int k = 0; k < scene->n_fluids; k++) {
        const struct fluid *fluid = scene_fluid(scene, k);
        fluid->eos->density(fluid->eos_params, 1, &exact, NULL, &rho);
        m[k] = rho * (q % 3 == 0 ? between(1e-12, 1) : uniform());
      }
      double volume = volume_at(scene, m, exact);
      int    steps = ice_equilibrium(scene, m, NULL, volume, &P);
      ck_assert_msg(steps < MOST_EQUILIBRIUM_STEPS, "%d steps from %g Pa to %g Pa", steps, guess, exact);
      double left = volume_at(scene, m, P) / volume - 1;
      ck_assert_msg(fabs(left) < 1e-14, "from %g Pa: %.17g Pa, should be %.17g, volume off by %g", guess, P, exact,
                    left);
      if (steps > most) most = steps;
    }
    scene_close(&run);
  }
  printf("%s: at most %d steps\n", other[_i], most);
}
END_TEST

/* close to the answer it takes a few steps: water with a bubble, the bubble twice and half as large */
START_TEST(few_steps_nearby)
{
  struct scene_run run;
  open_fluids(0, 2, &run);
  const struct scene *scene = &run.loaded->scene;
  for (int q = 0; q < 2; q++) {
    double P = 101325, m[2] = {0.99 * scene->fluid.density, 0.01 * scene->others[0].density};
    int    steps = ice_equilibrium(scene, m, NULL, q ? 1.01 : 0.995, &P);
    /* the water gives too: 1e5/K of it, over half of the bubble */
    ck_assert_double_eq_tol(P, q ? 0.5 * 101325 : 2 * 101325,
                            0.05 * 101325 + fmin(1e5, 4e12 / scene->fluid.bulk_modulus));
    ck_assert_int_le(steps, 8);
  }
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("ice equilibrium");
  TCase *all = tcase_create("volumes");
  tcase_set_timeout(all, 60);
  tcase_add_loop_test(all, random_states, 0, OTHERS);
  tcase_add_test(all, few_steps_nearby);
  suite_add_tcase(suite, all);
  return run_suite(suite);
}
