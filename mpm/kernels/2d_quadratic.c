#define DIM 2
#define BASIS quadratic
#define BASIS_ENUM BASIS_QUADRATIC
#define IS_QUADRATIC
#include "mpm/kernels/kernels.tmpl.h"
