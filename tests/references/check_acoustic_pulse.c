/* Sound pulse: the exact one, and its fate in the theta scheme against the scheme itself: pressures in N cells of a
 * closed box of 1 m, velocities at their faces. Water, c 1483.24 m/s. */
#include "tests/references/reference_test.h"

enum { N = 400 };

static const struct reference *sound(void) { return reference_find("acoustic_pulse"); }

static void *water(double theta, double courant)
{
  void *prm = defaults(sound());
  set(sound(), prm, "density", 1000);
  set(sound(), prm, "bulk_modulus", 2.2e9);
  set(sound(), prm, "amplitude", 1000);
  set(sound(), prm, "centre", 0.3);
  set(sound(), prm, "width", 0.03);
  set(sound(), prm, "cell", 1.0 / N);
  set(sound(), prm, "theta", theta);
  set(sound(), prm, "time_step", courant / (N * sqrt(2.2e6)));
  return prm;
}

static double at(const void *prm, const char *quantity, double x, double t)
{
  return value_at(sound(), prm, quantity, x, 0, t);
}

/* P [N] Pa, u [N + 1] m/s, closed at both ends; in units c = h = 1, P/(rho c) for P: one step of length C */
static void step(double theta, double C, double *P, double *u)
{
  double flux[N + 1] = {0}, star[N + 1] = {0}, super[N], dP[N], a = theta * theta * C * C;
  for (int f = 1; f < N; f++) {
    star[f] = u[f] - C * (P[f] - P[f - 1]);
    flux[f] = theta * star[f] + (1 - theta) * u[f];
  }
  for (int i = 0; i < N; i++) {
    double below = i > 0 ? a : 0, above = i < N - 1 ? a : 0;
    double pivot = 1 + below + above - (i > 0 ? below * super[i - 1] : 0);
    super[i] = above / pivot;
    dP[i] = (C * (flux[i] - flux[i + 1]) + (i > 0 ? below * dP[i - 1] : 0)) / pivot;
  }
  for (int i = N - 2; i >= 0; i--) dP[i] += super[i] * dP[i + 1];
  for (int f = 1; f < N; f++) u[f] = star[f] - theta * C * (dP[f] - dP[f - 1]);
  for (int i = 0; i < N; i++) P[i] += dP[i];
}

START_TEST(exact)
{
  void  *prm = water(1, 1);
  double c = at(prm, "sound_speed", 0, 0);
  CLOSE(c, 1483.2397, 1e-4);
  CLOSE(at(prm, "position", 0, 0.4 / c), 0.7, 1e-14);
  for (int i = 0; i <= 20; i++) {
    double x = 0.55 + 0.015 * i, P = 1000 * exp(-(x - 0.7) * (x - 0.7) / 9e-4);
    CLOSE(at(prm, "P", x, 0.4 / c), P, 1e-9);
    CLOSE(at(prm, "vel_x", x, 0.4 / c), P / (1000 * c), 1e-15);
  }
  set(sound(), prm, "cell", 0);
  set(sound(), prm, "time_step", 0);
  for (int i = 0; i <= 50; i++) CLOSE(at(prm, "P_scheme", 0.02 * i, 2e-4), at(prm, "P", 0.02 * i, 2e-4), 1e-9);
  CLOSE(at(prm, "position_scheme", 0, 2e-4), 0.3 + 2e-4 * c, 1e-8);
  CLOSE(at(prm, "speed", 0, 0), c, 1e-9);
  free(prm);
}
END_TEST

/* until the bell is at 0.7: every cell and face */
START_TEST(scheme)
{
  static const double ways[5][2] = {{0.5, 0.2}, {0.5, 1}, {0.5, 5}, {1, 0.2}, {0.75, 1}}; /* theta, Courant number */
  for (int i = 0; i < 5; i++) {
    double theta = ways[i][0], C = ways[i][1], P[N], u[N + 1] = {0}, most = 0;
    void  *prm = water(theta, C);
    int    steps = (int)(0.4 * N / C + 0.5);
    double t = steps * C / (N * sqrt(2.2e6)), unit = 1000 * sqrt(2.2e6);
    for (int k = 0; k < N; k++) P[k] = at(prm, "P", (k + 0.5) / N, 0) / unit;
    for (int f = 1; f < N; f++) u[f] = at(prm, "vel_x", (double)f / N, 0);
    for (int k = 0; k < steps; k++) step(theta, C, P, u);
    for (int k = 40; k < N - 40; k += 3) { /* walls come to know of it, implicitly */
      CLOSE(at(prm, "P_scheme", (k + 0.5) / N, t), P[k] * unit, 1e-6);
      CLOSE(at(prm, "vel_x_scheme", (k + 1.0) / N, t), u[k + 1], 1e-12);
    }
    for (int k = 0; k < N; k++) most = fmax(most, P[k] * unit);
    double peak = at(prm, "peak_scheme", 0, t), summit = at(prm, "position_scheme", 0, t);
    ck_assert_msg(peak >= most - 1e-7 && peak < most * 1.01, "peak %g, in cells %g", peak, most);
    CLOSE(at(prm, "P_scheme", summit, t), peak, 1e-9);
    free(prm);
  }
}
END_TEST

/* a standing wave of five half waves is two travelling ones: it becomes amplification^n cos(n phase) times itself */
START_TEST(single_wave)
{
  static const double ways[4][2] = {{0.5, 1}, {1, 1}, {1, 100}, {0.6, 10}};
  for (int i = 0; i < 4; i++) {
    double theta = ways[i][0], C = ways[i][1], P[N], u[N + 1] = {0};
    void  *prm = water(theta, C);
    set(sound(), prm, "wavelength", 0.4);
    double factor = at(prm, "amplification", 0, 0), phase = at(prm, "phase", 0, 0);
    for (int k = 0; k < N; k++) P[k] = cos(5 * M_PI * (k + 0.5) / N);
    for (int n = 1; n <= 7; n++) {
      step(theta, C, P, u);
      for (int k = 0; k < N; k += 7)
        CLOSE(P[k], pow(factor, n) * cos(n * phase) * cos(5 * M_PI * (k + 0.5) / N), 1e-11);
    }
    CLOSE(at(prm, "speed", 0, 0), phase / (5 * M_PI * C / N) * sqrt(2.2e6), 1e-9);
    free(prm);
  }
}
END_TEST

/* theta 1, Courant number 1: the bell of width w keeps w/sqrt(w^2 + 2 c^2 dt t) of its height, nearly */
START_TEST(decay)
{
  void  *prm = water(1, 1);
  double t = 0.4 / sqrt(2.2e6), diffused = 1000 / sqrt(1 + 2 * 0.4 / N / 9e-4);
  CLOSE(at(prm, "peak_scheme", 0, t), diffused, 0.01 * diffused);
  set(sound(), prm, "theta", 0.5);
  set(sound(), prm, "wavelength", 0.1);
  CLOSE(at(prm, "amplification", 0, 0), 1, 1e-15);
  set(sound(), prm, "theta", 1);
  CLOSE(at(prm, "amplification", 0, 0), 1 / sqrt(1 + 4 * pow(sin(M_PI / 40), 2)), 1e-14);
  free(prm);
}
END_TEST

RUN_TESTS("acoustic_pulse", exact, scheme, single_wave, decay)
