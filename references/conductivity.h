/* How permeable a skeleton is: given as hydraulic conductivity, or by Kozeny and Carman from the grains. */
#ifndef REFERENCES_CONDUCTIVITY_H
#define REFERENCES_CONDUCTIVITY_H

/* Parameters that a reference of a saturated column holds first among its own. */
struct conductivity {
  double permeability;            /* m/s; 0: from the grains */
  double diameter, kozeny_factor; /* m; A in kappa = D2 n3/(A (1-n)2) */
  double porosity, density, viscosity, gravity;
};

/** m/s; kappa rho g/mu. 0 if neither permeability nor grains are given. */
static inline double conductivity(const struct conductivity *c)
{
  double n = c->porosity, s = 1.0 - n;
  if (c->permeability > 0.0) return c->permeability;
  return c->diameter * c->diameter * n * n * n / (c->kozeny_factor * s * s) * c->density * c->gravity / c->viscosity;
}

#define CONDUCTIVITY_PARAMS(type, member)                                                                              \
  {"porosity", PARAM_NUMBER, offsetof(type, member.porosity), "-", 1e-3, 0.999, NULL, NULL, "porosity"},               \
      {"permeability",                                                                                                 \
       PARAM_NUMBER,                                                                                                   \
       offsetof(type, member.permeability),                                                                            \
       "m/s",                                                                                                          \
       0,                                                                                                              \
       1e3,                                                                                                            \
       "0",                                                                                                            \
       NULL,                                                                                                           \
       "hydraulic conductivity; 0: from the grain diameter"},                                                          \
      {"grain_diameter",                                                                                               \
       PARAM_NUMBER,                                                                                                   \
       offsetof(type, member.diameter),                                                                                \
       "m",                                                                                                            \
       0,                                                                                                              \
       1e3,                                                                                                            \
       "0",                                                                                                            \
       NULL,                                                                                                           \
       "grain diameter, used without permeability"},                                                                   \
      {"kozeny_factor", PARAM_NUMBER, offsetof(type, member.kozeny_factor), "-", 1, 1e4,                               \
       "180",           NULL,         "A in kappa = D2 n3/(A (1-n)2)"},                                                \
      {"density", PARAM_NUMBER, offsetof(type, member.density), "kg/m3", 1e-3, 1e5,                                    \
       "1000",    NULL,         "density of the liquid"},                                                              \
      {"viscosity", PARAM_NUMBER, offsetof(type, member.viscosity), "Pa s", 1e-12, 1e6,                                \
       "1e-3",      NULL,         "viscosity of the liquid"},                                                          \
  {                                                                                                                    \
    "gravity", PARAM_NUMBER, offsetof(type, member.gravity), "m/s2", 1e-3, 1e3, "9.81", NULL,                          \
        "the g in which the hydraulic conductivity is meant"                                                           \
  }

#endif
