#define DIM 3
#define BASIS gimp
#define BASIS_ENUM BASIS_GIMP
#define IS_GIMP
#include "mpm/kernels/kernels.tmpl.h"
