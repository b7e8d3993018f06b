/* A rigid block from rest on a plane with Coulomb friction. docs/references.md, "Sliding block". */
#include "references/reference.h"

struct block {
  double angle_deg, friction, gravity, mass;
};

static const struct param params[] = {
    {"angle_deg", PARAM_NUMBER, offsetof(struct block, angle_deg), "deg", 0, 89, NULL, NULL, "angle of the plane"},
    {"friction", PARAM_NUMBER, offsetof(struct block, friction), "-", 0, 1e6, NULL, NULL, "Coulomb coefficient"},
    {"mass", PARAM_NUMBER, offsetof(struct block, mass), "kg", 1e-12, 1e12, "1", NULL, "mass"},
    {"gravity", PARAM_NUMBER, offsetof(struct block, gravity), "m/s2", 1e-9, 1e6, "9.81", NULL, "gravity"},
    PARAM_END,
};

enum { DISTANCE, SPEED, NORMAL, TANGENTIAL, IMPULSE_X, IMPULSE_Y, LOST };

/* what the plane gives, N: along its normal, and up the plane; the block stays where friction can hold it */
static void forces(const struct block *b, double *normal, double *up)
{
  double angle = b->angle_deg * M_PI / 180, pull = b->mass * b->gravity * sin(angle);
  *normal = b->mass * b->gravity * cos(angle);
  *up = fmin(pull, b->friction * *normal);
}

static double one(const struct block *b, int quantity, double t)
{
  double angle = b->angle_deg * M_PI / 180, normal, up;
  forces(b, &normal, &up);
  double speed = (b->gravity * sin(angle) - up / b->mass) * t;
  switch (quantity) {
  case DISTANCE:
    return 0.5 * speed * t;
  case SPEED:
    return speed;
  case NORMAL:
    return normal * t;
  case TANGENTIAL:
    return -up * t;
  case IMPULSE_X:
    return (normal * sin(angle) - up * cos(angle)) * t;
  case IMPULSE_Y:
    return (normal * cos(angle) + up * sin(angle)) * t;
  default:
    return up * 0.5 * speed * t;
  }
}

static enum status value(const void *prm, int quantity, int n, const double (*x)[3], double t, double *v)
{
  (void)x;
  for (int i = 0; i < n; i++) v[i] = one(prm, quantity, t);
  return OK;
}

const struct reference reference_sliding_block = {
    .name = "sliding_block",
    .source = "Coulomb friction",
    .params = params,
    .param_size = sizeof(struct block),
    .quantities = "distance|speed|normal_impulse|tangential_impulse|impulse_x|impulse_y|lost",
    .value = value,
};
