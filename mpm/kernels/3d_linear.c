#define DIM 3
#define BASIS linear
#define BASIS_ENUM BASIS_LINEAR
#define IS_LINEAR
#include "mpm/kernels/kernels.tmpl.h"
