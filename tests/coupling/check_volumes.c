/* Volume fractions: a uniform medium has its own porosity everywhere, up to walls and at a surface that it shares with
 * the water; volumes add up. */
#include "coupling/coupling.h"
#include "ice/ice.h"
#include "mpm/mpm.h"
#include "tests/scene_run.h"

#define SCENE(grid, shape, region)                                                                                     \
  "{\"grid\": {" grid "}, \"time\": {\"end\": 1}, \"gravity\": [0, -9.81],"                                            \
  "\"materials\": {\"m\": {\"model\": \"linear_elastic\", \"young\": 1e6, \"poisson\": 0.3, \"density\": 2650,"        \
  "\"porosity\": 0.3, \"permeability\": 1e-3, \"grain_diameter\": 1e-3}},"                                             \
  "\"solids\": {\"b\": {\"material\": \"m\", \"shape\": " shape "}},"                                                  \
  "\"fluid\": {\"path\": \"ice\", \"region\": " region "}"
#define FLAT "\"min\": [0, 0], \"max\": [0.6, 1.2], \"h\": 0.1"
#define DEEP "\"min\": [0, 0, 0], \"max\": [0.6, 1.2, 0.5], \"h\": 0.1"
#define BELOW(y) "{\"box\": {\"min\": [null, null], \"max\": [null, " y "]}}"
#define BELOW3(y) "{\"box\": {\"min\": [null, null, null], \"max\": [null, " y ", null]}}"

static const char *const bases[] = {"numerics.basis=linear", "numerics.basis=gimp", "numerics.basis=quadratic",
                                    "numerics.basis=cubic"};
static const char *const walls[] = {"numerics.wall_basis=mirrored", "numerics.wall_basis=modified"};
static const char *const densities[] = {"numerics.points_per_cell=4", "numerics.points_per_cell=9",
                                        "numerics.points_per_cell=1"};

/* Share of a spline that reaches past the node beyond a surface, from a lattice of n points per cell and axis. There
 * the next nodes inside have that much fewer grains, and water instead: what they hold weighs as much as what fills
 * their room, which keeps the load on the column whole. */
static double spline_tail(int basis, int n)
{
  double sum = 0;
  for (int i = 0; i < n; i++) {
    double z = 1 + (i + 0.5) / n;
    if (basis == BASIS_CUBIC) sum += (2 - z) * (2 - z) * (2 - z) / 6 / n;
    if (basis == BASIS_QUADRATIC && z < 1.5) sum += 0.5 * (1.5 - z) * (1.5 - z) / n;
  }
  return sum;
}

/* every wet cell, and every face of one: porosity 0.3, full of skeleton of porosity 0.3; next to the surface at y = top
 * and one cell below grains are short of a share `tail` */
static void uniform(const struct scene_run *run, double top, double tail)
{
  const struct coupling *c = coupling_of(run->sim);
  const struct ice      *ice = ice_of(run->sim);
  const struct grid     *g = &run->sim->grid;
  struct box             cells = grid_cells(g);
  double                 worst = 0, medium = 0, near_surface = 0, x[3];
  int                    met = 0;
  FOR_BOX_SERIAL(g, cells, i)
  {
    if (!(ice->wet_cc[i] > 0)) continue;
    grid_centre(g, i, x);
    double *at = x[1] > top - 1.7 * g->h ? &near_surface : &worst;
    *at = fmax(*at, fabs(c->porosity_cc[i] - 0.3));
    for (int d = 0; d < g->dim; d++)
      for (int high = 0; high < 2; high++) {
        long q = d * g->size + i + high * g->stride[d];
        *at = fmax(*at, fabs(c->porosity_fc[q] - 0.3));
        medium = fmax(medium, fabs(c->fill_fc[q] - 1));
        medium = fmax(medium, fabs(c->medium_porosity_fc[q] - 0.3));
        met++;
      }
  }
  ck_assert_int_gt(met, 100);
  ck_assert_double_lt(worst, 1e-14);
  ck_assert_double_lt(medium, 1e-14);
  ck_assert_double_eq_tol(near_surface, 0.7 * tail, 1e-14);
}

static const struct {
  const char *text;
  double      top; /* m: a common surface; infinite: none */
  bool        three;
} media[] = {
    {SCENE(FLAT, "\"everywhere\"", "\"everywhere\"") "}", INFINITY, false},
    {SCENE(FLAT, BELOW("0.8"), BELOW("0.8")) "}", 0.8, false},
    {SCENE(FLAT, "\"everywhere\"", "\"everywhere\"") ", \"boundary\": {\"solid\": {\"x_min\": \"periodic\", \"x_max\": "
                                                     "\"periodic\"}, \"fluid\": {\"x_min\": \"periodic\", \"x_max\": "
                                                     "\"periodic\"}}}",
     INFINITY, false},
    {SCENE(DEEP, BELOW3("0.8"), BELOW3("0.8")) "}", 0.8, true},
};
enum { MEDIA = sizeof media / sizeof *media };

static void check_medium(const char *text, const char *const *sets, double top, double tail)
{
  struct scene_run run;
  scene_open_with(text, sets, &run);
  uniform(&run, top, isinf(top) ? 0 : tail);
  scene_step_to(&run, 1e-9, "coupling.fill_cells"); /* a step finds the same */
  uniform(&run, top, isinf(top) ? 0 : tail);
  scene_close(&run);
}

START_TEST(uniform_media)
{
  static const int per_axis[] = {2, 3, 1};
  for (int basis = 0; basis < 4; basis++)
    for (int wall = 0; wall < 2; wall++)
      for (int n = 0; n < (media[_i].three ? 1 : 3); n++) {
        const char *sets[] = {bases[basis], walls[wall], media[_i].three ? "gravity=[0, -9.81, 0]" : densities[n],
                              NULL};
        check_medium(media[_i].text, sets, media[_i].top, spline_tail(basis, per_axis[n]));
      }
}
END_TEST

/* water stands above the soil: the fractions of a column add up to the volume of its skeleton and grains */
START_TEST(volumes_add_up)
{
  for (int basis = 0; basis < 4; basis++) {
    const char      *sets[] = {bases[basis], NULL};
    struct scene_run run;
    scene_open_with(SCENE(FLAT, BELOW("0.55"), BELOW("1.2")) "}", sets, &run);
    const struct coupling *c = coupling_of(run.sim);
    const struct grid     *g = &run.sim->grid;
    struct box             cells = grid_cells(g), faces = grid_faces(g, 1);
    double                 grains = 0, fill = 0;
    FOR_BOX_SERIAL(g, cells, i) grains += 0.01 * (1 - c->porosity_cc[i]);
    FOR_BOX_SERIAL(g, faces, f)
    {
      int place[3];
      grid_place(g, f, place);
      fill += 0.01 * c->fill_fc[g->size + f] * (place[1] == 0 || place[1] == g->n[1] ? 0.5 : 1);
    }
    ck_assert_double_eq_tol(grains, 0.7 * 0.6 * 0.55, 1e-14);
    ck_assert_double_eq_tol(fill, 0.6 * 0.55, 1e-14);
    scene_close(&run);
  }
}
END_TEST

/* a face in the middle of the soil's surface: its share is skeleton of the soil's own porosity */
START_TEST(medium_of_a_partly_filled_face)
{
  struct scene_run run;
  scene_open(SCENE(FLAT, BELOW("0.5"), BELOW("1.2")) "}", &run);
  const struct coupling *c = coupling_of(run.sim);
  const struct grid     *g = &run.sim->grid;
  long                   f = g->size + grid_at(g, 3, 5, 0);
  ck_assert_double_eq_tol(c->fill_fc[f], 0.5, 1e-14);
  ck_assert_double_eq_tol(c->porosity_fc[f], 0.65, 1e-14);
  ck_assert_double_eq_tol(c->medium_porosity_fc[f], 0.3, 1e-14);
  f = g->size + grid_at(g, 3, 9, 0); /* water */
  ck_assert_double_eq(c->fill_fc[f], 0);
  ck_assert_double_eq(c->porosity_fc[f], 1);
  scene_close(&run);
}
END_TEST

/* the increment that a path returns becomes a force */
START_TEST(push_becomes_force)
{
  struct scene_run run;
  scene_open(SCENE(FLAT, BELOW("0.8"), BELOW("0.8")) "}", &run);
  scene_step_to(&run, 1e-4, "ice.push_solid");
  const struct coupling *c = coupling_of(run.sim);
  const struct mpm      *m = mpm_of(run.sim);
  const struct grid     *g = &run.sim->grid;
  long                   n = grid_at(g, 2, 3, 0);
  double                 before = m->force_nc[2 * n + 1];
  c->dmom_nc[2 * n + 1] = 5;
  for (int i = 0; i < run.plan.n_stages; i++)
    if (!strcmp(run.plan.stages[i]->name, "coupling.push_solid")) must(run.plan.stages[i]->run(run.sim, 0.1));
  ck_assert_double_eq_tol(m->force_nc[2 * n + 1] - before, 50, 1e-11);
  scene_close(&run);
}
END_TEST

int main(void)
{
  Suite *suite = suite_create("volumes");
  TCase *tcase = tcase_create("fractions");
  tcase_add_loop_test(tcase, uniform_media, 0, MEDIA);
  tcase_add_test(tcase, volumes_add_up);
  tcase_add_test(tcase, medium_of_a_partly_filled_face);
  tcase_add_test(tcase, push_becomes_force);
  suite_add_tcase(suite, tcase);
  return run_suite(suite);
}
