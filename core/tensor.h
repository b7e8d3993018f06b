/* Small dense algebra: 3 x 3 matrices row by row, symmetric tensors as xx yy zz xy yz xz. */
#ifndef CORE_TENSOR_H
#define CORE_TENSOR_H

#include <math.h>
#include <string.h>

enum { XX, YY, ZZ, XY, YZ, XZ };

static inline void tensor_product(const double a[9], const double b[9], double c[9])
{
  double r[9];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) r[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
  memcpy(c, r, sizeof r);
}

static inline void tensor_transpose(const double a[9], double b[9])
{
  double r[9] = {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]};
  memcpy(b, r, sizeof r);
}

static inline double tensor_determinant(const double a[9])
{
  return a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) + a[2] * (a[3] * a[7] - a[4] * a[6]);
}

static inline void tensor_inverse(const double a[9], double b[9])
{
  double d = 1 / tensor_determinant(a);
  double r[9] = {a[4] * a[8] - a[5] * a[7], a[2] * a[7] - a[1] * a[8], a[1] * a[5] - a[2] * a[4],
                 a[5] * a[6] - a[3] * a[8], a[0] * a[8] - a[2] * a[6], a[2] * a[3] - a[0] * a[5],
                 a[3] * a[7] - a[4] * a[6], a[1] * a[6] - a[0] * a[7], a[0] * a[4] - a[1] * a[3]};
  for (int i = 0; i < 9; i++) b[i] = d * r[i];
}

static inline void tensor_from_symmetric(const double s[6], double a[9])
{
  double r[9] = {s[XX], s[XY], s[XZ], s[XY], s[YY], s[YZ], s[XZ], s[YZ], s[ZZ]};
  memcpy(a, r, sizeof r);
}

static inline void tensor_to_symmetric(const double a[9], double s[6])
{
  s[XX] = a[0];
  s[YY] = a[4];
  s[ZZ] = a[8];
  s[XY] = 0.5 * (a[1] + a[3]);
  s[YZ] = 0.5 * (a[5] + a[7]);
  s[XZ] = 0.5 * (a[2] + a[6]);
}

#endif
