#define DIM 2
#define BASIS cubic
#define BASIS_ENUM BASIS_CUBIC
#define IS_CUBIC
#include "mpm/kernels/kernels.tmpl.h"
