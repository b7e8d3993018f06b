/* Heated bar: against tables, images and finite differences. L 1 m, k 0.4, rho 2500, c 835: L2/alpha = 5 218 750 s. */
#include "tests/references/reference_test.h"

#include <math.h>

static const struct reference *bar(void) { return reference_find("heated_bar"); }

static void *stone(double amplitude, double fixed, double flux)
{
  void *prm = defaults(bar());
  set(bar(), prm, "conductivity", 0.4);
  set(bar(), prm, "heat_capacity", 835);
  set(bar(), prm, "density", 2500);
  set(bar(), prm, "length", 1);
  set(bar(), prm, "start", 300);
  set(bar(), prm, "amplitude", amplitude);
  set(bar(), prm, "fixed", fixed);
  set(bar(), prm, "flux", flux);
  return prm;
}

static double at(const void *prm, double z, double Fo)
{
  return value_at(bar(), prm, "temperature", z, 0, Fo * 5218750.0);
}

/* 5 exp(-pi2 0.1) = 1.8635; with z = 1 insulated and z = 0 at 310: the first mode alone at Fo 0.3 */
START_TEST(table)
{
  void *mode = stone(5, 0, 0), *fixed = stone(0, 310, 0);
  CLOSE(at(mode, 0, 0.1), 301.8635391943, 1e-9);
  CLOSE(at(mode, 1, 0.1), 298.1364608057, 1e-9);
  CLOSE(at(mode, 0.5, 0.2), 300, 1e-12);
  CLOSE(at(fixed, 1, 0.3), 303.9319618512, 1e-6); /* 310 - 40/pi exp(-0.7402) + 40/(3 pi) exp(-6.662) */
  CLOSE(at(fixed, 0, 0.3), 310, 1e-12);
  CLOSE(at(fixed, 0.2, 0), 300, 1e-12);
  CLOSE(bar()->time_scale(mode), 5218750, 1e-6);
  CLOSE(scale_of(bar(), mode, "temperature"), 5, 1e-12);
  CLOSE(scale_of(bar(), fixed, "temperature"), 10, 1e-12);
  free(mode), free(fixed);
}
END_TEST

/* early: a half space, 300 + 10 erfc(z/(2 sqrt Fo)), and q L/k 2 sqrt(Fo) ierfc(z/(2 sqrt Fo)) under a flux */
START_TEST(early_as_a_half_space)
{
  void *fixed = stone(0, 310, 0), *flux = stone(0, 0, 4);
  for (double Fo = 1e-6; Fo < 6e-3; Fo *= 5)
    for (double z = 0; z < 0.5; z += 0.037) {
      double u = z / (2 * sqrt(Fo));
      CLOSE(at(fixed, z, Fo), 300 + 10 * erfc(u), 1e-6);
      CLOSE(at(flux, z, Fo), 300 + 10 * 2 * sqrt(Fo) * (exp(-u * u) / sqrt(M_PI) - u * erfc(u)), 1e-6);
    }
  free(fixed), free(flux);
}
END_TEST

/* heat is the integral of T, and grows by what the end's gradient lets in; T obeys the equation */
static void check_balance(const void *prm)
{
  enum { N = 2000 };
  double c = 2500.0 * 835, e = 1e-3, d = 1e-4;
  for (double Fo = 0.02; Fo < 0.3; Fo += 0.07) {
    double sum = 0, t = Fo * 5218750, slope = (-3 * at(prm, 0, Fo) + 4 * at(prm, e, Fo) - at(prm, 2 * e, Fo)) / (2 * e);
    for (int i = 0; i < N; i++) sum += at(prm, (i + 0.5) / N, Fo) / N;
    CLOSE(value_at(bar(), prm, "heat", 0, 0, t) / c, sum, 1e-5);
    CLOSE(value_at(bar(), prm, "heat_in", 0, 0, t) / c, sum - 300, 1e-5);
    double more = value_at(bar(), prm, "heat", 0, 0, t + 500), less = value_at(bar(), prm, "heat", 0, 0, t - 500);
    CLOSE((more - less) / 1000, -0.4 * slope, 2e-3);
    for (double z = 0.1; z < 1; z += 0.2) {
      double curve = (at(prm, z - e, Fo) - 2 * at(prm, z, Fo) + at(prm, z + e, Fo)) / (e * e);
      CLOSE((at(prm, z, Fo + d) - at(prm, z, Fo - d)) / (2 * d), curve, 1e-2);
    }
    CLOSE(at(prm, 1, Fo), at(prm, 1 - 1e-4, Fo), 1e-5); /* insulated */
  }
}

START_TEST(balance)
{
  void *prm[] = {stone(5, 0, 0), stone(0, 310, 0), stone(5, 310, 0), stone(5, 0, 4)};
  for (int i = 0; i < 4; i++) {
    check_balance(prm[i]);
    free(prm[i]);
  }
}
END_TEST

/* explicit differences from the same start, 100 cells: second order, 2e-3 K */
START_TEST(differences)
{
  enum { N = 100 };
  void  *prm = stone(5, 310, 0);
  double T[N], last[N], dt = 0.25 / (N * N);
  for (int i = 0; i < N; i++) T[i] = 300 + 5 * cos(M_PI * (i + 0.5) / N);
  for (int step = 0; step < 4000; step++) {
    memcpy(last, T, sizeof T);
    for (int i = 0; i < N; i++) {
      double below = i > 0 ? last[i - 1] : 620 - last[0], above = i < N - 1 ? last[i + 1] : last[i];
      T[i] += dt * N * N * (below - 2 * last[i] + above);
    }
  }
  for (int i = 0; i < N; i++) CLOSE(T[i], at(prm, (i + 0.5) / N, 4000 * dt), 2e-3);
  free(prm);
}
END_TEST

RUN_TESTS("heated_bar", table, early_as_a_half_space, balance, differences)
