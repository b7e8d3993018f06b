/* From a scene file to a struct scene: load, override, check, fill in defaults. Only run/ knows JSON. */
#ifndef RUN_SCENE_READ_H
#define RUN_SCENE_READ_H

#include "core/scene.h"
#include "run/files.h"
#include "run/options.h"

struct cJSON;

struct loaded_scene {
  struct scene  scene;              /* scene.name: "terzaghi_column" or "terzaghi_column+ramp1ms" */
  struct cJSON *json;               /* overrides applied, every default filled in; no variants, quick, paths */
  char          file[LONGEST_PATH]; /* the scene file; of a scene.used.json the one it was made from */
  char          path[NAME_LENGTH];  /* fluid path, "solid" for a scene without fluid */
  char          variant[256];       /* key of expected.json: "base", "quick", "ramp1ms", "ramp1ms+quick" */
  struct cJSON *expected;           /* of this variant and path; NULL: nothing expected */
};

/** Reads options->argument (a file, or the name of a shipped case; with +variant...) and applies, in this order:
 *  paths.<path>, variants, quick, --set. Everything wrong with a scene is found here: ERR_INPUT. */
enum status scene_load(const struct run_options *options, struct loaded_scene **scene) MUST_CHECK;
void        scene_unload(struct loaded_scene **scene);
/** The merged scene with every default, itself a valid scene. */
enum status scene_write_used(const struct loaded_scene *scene, const char *file) MUST_CHECK;

/* What expected.json says about one metric of this variant and path. */
struct expectation {
  bool   has_value, has_limit;
  double value, limit;
  char   unit[NAME_LENGTH], reference[256];
};

/** Finds what expected.json, beside the scene, says of this variant and path; the order of variants does not matter.
 *  ERR_INPUT: it speaks of a metric that the scene does not have. Part of scene_load. */
enum status scene_find_expected(struct loaded_scene *scene) MUST_CHECK;
/** Metrics without an entry: has_value and has_limit are false. */
void scene_expected(const struct loaded_scene *scene, const char *metric, struct expectation *expectation);

/** --out, or out/<scene>-<path>. */
enum status scene_out_directory(const struct loaded_scene *scene, const struct run_options *options, char *directory,
                                size_t size) MUST_CHECK;
/** Refuses a folder that holds a run (summary.json or checkpoint.h5), unless options->force. Makes nothing. */
enum status scene_refuse_used_directory(const struct run_options *options, const char *directory) MUST_CHECK;

#endif
