/* Vortices that decay by viscosity in an incompressible liquid, on a square pattern, carried along by a uniform
 * velocity. docs/references.md, "Decaying vortices". */
#include "references/reference.h"

struct vortices {
  double speed, wavelength, density, viscosity, mean_pressure, area, drift[3], origin[3];
};

static const struct param params[] = {
    {"speed", PARAM_NUMBER, offsetof(struct vortices, speed), "m/s", -1e6, 1e6, "1", NULL,
     "U, largest velocity at the start"},
    {"wavelength", PARAM_NUMBER, offsetof(struct vortices, wavelength), "m", 1e-9, 1e9, "1", NULL,
     "2 pi/k, twice the size of a vortex"},
    {"density", PARAM_NUMBER, offsetof(struct vortices, density), "kg/m3", 1e-9, 1e9, NULL, NULL, "density"},
    {"viscosity", PARAM_NUMBER, offsetof(struct vortices, viscosity), "Pa s", 0, 1e9, NULL, NULL, "dynamic viscosity"},
    {"mean_pressure", PARAM_NUMBER, offsetof(struct vortices, mean_pressure), "Pa", -1e12, 1e12, "0", NULL,
     "mean of P"},
    {"area", PARAM_NUMBER, offsetof(struct vortices, area), "m2", 1e-12, 1e12, "1", NULL,
     "whole vortices that the kinetic energy counts (per metre of thickness)"},
    {"drift", PARAM_VECTOR, offsetof(struct vortices, drift), "m/s", -1e6, 1e6, "0", NULL,
     "uniform velocity that carries the vortices; its own energy is no part of kinetic"},
    {"origin", PARAM_VECTOR, offsetof(struct vortices, origin), "m", -1e9, 1e9, "0", NULL,
     "corner of four vortices at t = 0"},
    PARAM_END,
};

enum { VEL_X, VEL_Y, P, KINETIC, VEL_MAX, P_AMPLITUDE };

/* 1/m */
static double wavenumber(const struct vortices *w) { return 2 * M_PI / w->wavelength; }

/* m/s: the largest velocity at time t */
static double strength(const struct vortices *w, double t)
{
  double k = wavenumber(w);
  return w->speed * exp(-2 * w->viscosity / w->density * k * k * t);
}

static double one(const struct vortices *w, int quantity, const double x[3], double t)
{
  double U = strength(w, t), k = wavenumber(w);
  double a = k * (x[0] - w->origin[0] - w->drift[0] * t), b = k * (x[1] - w->origin[1] - w->drift[1] * t);
  switch (quantity) {
  case VEL_X:
    return w->drift[0] + U * sin(a) * cos(b);
  case VEL_Y:
    return w->drift[1] - U * cos(a) * sin(b);
  case P:
    return w->mean_pressure + 0.25 * w->density * U * U * (cos(2 * a) + cos(2 * b));
  case KINETIC:
    return 0.25 * w->density * U * U * w->area;
  case VEL_MAX:
    return fabs(U);
  default:
    return 0.5 * w->density * U * U;
  }
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  for (int i = 0; i < n; i++) v[i] = one(prm, quantity, x[i], t);
  return OK;
}

/* of the start */
static double scale(const void *prm, int quantity)
{
  const struct vortices *w = prm;
  double                 U = w->speed != 0 ? fabs(w->speed) : 1, energy = 0.5 * w->density * U * U;
  return quantity == KINETIC ? 0.5 * energy * w->area : quantity == P || quantity == P_AMPLITUDE ? energy : U;
}

const struct reference reference_taylor_green = {
    .name = "taylor_green",
    .source = "exact solution of the Navier-Stokes equations",
    .params = params,
    .param_size = sizeof(struct vortices),
    .quantities = "vel_x|vel_y|P|kinetic|vel_max|P_amplitude",
    .value = value,
    .scale = scale,
};
