/* Principal stresses of groups: tensors of known values and axes, with values that are equal, nearly equal and apart.
 */
#include "constitutive/principal.h"
#include "tests/battery/battery.h"

#include <float.h>

/* columns: an orthonormal basis, the turn of a random unit quaternion */
static void random_axes(uint64_t *seed, double V[3][3])
{
  double q[4], length = 0.0;
  for (int k = 0; k < 4; k++) q[k] = battery_random(seed), length += q[k] * q[k];
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++) {
      int other = 3 - r - c, sign = (c - r + 3) % 3 == 1 ? -1 : 1;
      V[r][c] = r == c ? 1.0 - 2.0 * (length - q[0] * q[0] - q[r + 1] * q[r + 1]) / length
                       : 2.0 * (q[r + 1] * q[c + 1] + sign * q[0] * q[other + 1]) / length;
    }
}

/* one axis is z, whichever value it has: a stress of the plane xy */
static void axes_in_plane(uint64_t *seed, double V[3][3])
{
  double angle = M_PI * battery_random(seed), c = cos(angle), s = sin(angle);
  int    across = (int)(1.5 + 1.5 * battery_random(seed)) % 3, first = (across + 1) % 3, second = (across + 2) % 3;
  memset(V, 0, 9 * sizeof(double));
  V[2][across] = 1.0;
  V[0][first] = V[1][second] = c;
  V[1][first] = s;
  V[0][second] = -s;
}

static void assemble(double V[3][3], const double value[3], double s[6])
{
  static const int row[6] = {0, 1, 2, 0, 1, 0}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; k++) {
    s[k] = 0.0;
    for (int j = 0; j < 3; j++) s[k] += value[j] * V[row[k]][j] * V[column[k]][j];
  }
}

/* gaps of 1 and of 1e-17 to 1 around a mean of -1 to 1, or of -1e-8 to 1e-8, in either order */
static void random_values(uint64_t *seed, double value[3])
{
  double mean = battery_random(seed) * (battery_random(seed) < 0.0 ? 1.0 : 1e-8);
  double near = pow(10.0, -8.5 + 8.5 * battery_random(seed));
  value[0] = mean;
  value[1] = mean + (battery_random(seed) < 0.0 ? 1.0 : near);
  value[2] = value[1] + (value[1] - mean == near ? 1.0 : near);
}

enum { GROUPS = 20000 };

/* Values are exact to some eps of the largest; other values on the same axes give the stress they should. */
static void split_and_join(uint64_t *seed, double *worst_value, double *worst_stress)
{
  VECTOR           stress[6], values[3], joined[6];
  double           known[LANES][3], moved[LANES][6], size = 0.0;
  struct principal p;
  for (int i = 0; i < LANES; i++) {
    double V[3][3], s[6], other[3];
    if (battery_random(seed) < 0.0)
      axes_in_plane(seed, V);
    else
      random_axes(seed, V);
    random_values(seed, known[i]);
    assemble(V, known[i], s);
    for (int k = 0; k < 6; k++) stress[k][i] = s[k];
    for (int k = 0; k < 3; k++) other[k] = 2.0 * known[i][k] - 3.0;
    assemble(V, other, moved[i]);
  }
  principal_split(stress, &p);
  for (int k = 0; k < 3; k++) values[k] = 2.0 * p.value[k] - 3.0;
  principal_join(&p, values, joined);
  for (int i = 0; i < LANES; i++) {
    size = fmax(fabs(known[i][0]), fabs(known[i][2]));
    for (int k = 0; k < 3; k++) *worst_value = fmax(*worst_value, fabs(p.value[k][i] - known[i][k]) / size);
    for (int k = 0; k < 6; k++) *worst_stress = fmax(*worst_stress, fabs(joined[k][i] - moved[i][k]));
  }
}

START_TEST(known_tensors)
{
  uint64_t seed = 1;
  double   value = 0.0, stress = 0.0;
  for (int i = 0; i < GROUPS; i++) split_and_join(&seed, &value, &stress);
  printf("principal: values to %.1e of the largest, stresses to %.1e\n", value, stress);
  ck_assert_double_le(value, 10.0 * DBL_EPSILON);
  ck_assert_double_le(stress, 30.0 * DBL_EPSILON);
}
END_TEST

/* no deviator: no axes either, and none are needed */
START_TEST(equal_values)
{
  VECTOR           stress[6], joined[6];
  struct principal p;
  for (int k = 0; k < 6; k++) stress[k] = VECTOR_ALL(k < 3 ? -7.0 : 0.0);
  principal_split(stress, &p);
  principal_join(&p, p.value, joined);
  for (int i = 0; i < LANES; i++) {
    for (int k = 0; k < 3; k++) ck_assert(p.value[k][i] == -7.0);
    for (int k = 0; k < 6; k++) ck_assert(joined[k][i] == stress[k][i]);
  }
}
END_TEST

/* a pair that is exactly equal stays so: triaxial states along the axes */
START_TEST(triaxial)
{
  VECTOR           stress[6], joined[6];
  struct principal p;
  for (int side = 0; side < 2; side++) {
    for (int k = 0; k < 6; k++) stress[k] = VECTOR_ALL(k == YY ? (side ? -3e5 : -1e4) : k < 3 ? -1e5 : 0.0);
    principal_split(stress, &p);
    principal_join(&p, p.value, joined);
    double pair = p.value[side ? 2 : 1][0] - p.value[side ? 1 : 0][0];
    ck_assert_double_le(pair, 1e-15 * 1e5);
    for (int k = 0; k < 6; k++) ck_assert_double_eq_tol(joined[k][0], stress[k][0], 1e-10);
  }
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("constitutive/principal");
  TCase *tests = tcase_create("groups");
  tcase_add_test(tests, known_tensors);
  tcase_add_test(tests, equal_values);
  tcase_add_test(tests, triaxial);
  suite_add_tcase(suite, tests);
  return battery_run(suite);
}
