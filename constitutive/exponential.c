/* Taylor's series after reduction to |r| <= ln(2)/2, and of artanh to sqrt(1/2) <= m < sqrt(2). Whole numbers live in
 * the low bits of a double as large as 1.5 * 2^52. */
#include "constitutive/exponential.h"

static const double shift = 6755399441055744.0;
static const double ln2_high = 0x1.62e42fefa38p-1, ln2_low = 0x1.ef35793c7673p-45;

void vector_exp(const VECTOR *x, VECTOR *exponential, VECTOR *less_one)
{
  enum { TERMS = 14 };
  VECTOR most = VECTOR_ALL(EXPONENT_MOST), cut = VECTOR_MIN(*x, most);
  cut = VECTOR_MAX(cut, -most);
  VECTOR shifted = cut * M_LOG2E + shift, n = shifted - shift, r = (cut - n * ln2_high) - n * ln2_low;
  VECTOR sum = VECTOR_ALL(1.0);
  for (int k = TERMS; k >= 2; k--) sum = 1.0 + r * sum * (1.0 / k);
  VECTOR power = (VECTOR)(((MASK)shifted - (MASK)VECTOR_ALL(shift) + 1023) << 52); /* 2^n */
  *less_one = power * (r * sum) + (power - 1.0);
  *exponential = power * (r * sum) + power;
}

void vector_log(const VECTOR *x, VECTOR *result)
{
  enum { TERMS = 11 };
  const long one = 0x3ff0000000000000, fraction = 0x000fffffffffffff;
  MASK       bits = (MASK)*x, exponent = (bits >> 52) - 1023;
  VECTOR     m = (VECTOR)((bits & fraction) | one);
  MASK       upper = (MASK)(m > M_SQRT2);
  m = VECTOR_SELECT(upper, 0.5 * m, m);
  exponent -= upper; /* true is -1 */
  VECTOR e = (VECTOR)(exponent + (MASK)VECTOR_ALL(shift)) - shift, s = (m - 1.0) / (m + 1.0), square = s * s;
  VECTOR sum = VECTOR_ALL(1.0 / (2 * TERMS - 1));
  for (int k = TERMS - 2; k >= 0; k--) sum = 1.0 / (2 * k + 1) + square * sum;
  *result = e * ln2_high + (2.0 * s * sum + e * ln2_low);
}
