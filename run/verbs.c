/* The table of verbs. */
#include "run/verbs.h"

#include "run/arguments.h"
#include "run/loop.h"
#include "run/schema.h"

enum status verb_schema(const struct run_options *options)
{
  (void)options;
  return schema_print(stdout);
}

const struct verb verbs[] = {
    {"run", "SCENE", "--fluid --set --out --threads --until --quick --time --quiet --force", "runs a scene",
     "Overrides apply in the order: scene, paths.<path>, variants, quick, --set. The output folder then holds "
     "summary.json,\n"
     "gauges.csv, fields.*.hdf, checkpoint.h5, scene.used.json and plan.txt.\n",
     run_scene},
    {"resume", "DIR", "--threads --until --time --quiet", "goes on from the last checkpoint of a run",
     "The result is bitwise that of the uninterrupted run.\n", run_resume},
    {"compare", "SCENE", "--fluid --set --out --threads --until --quick --quiet --force",
     "runs a scene on several fluid paths and compares them",
     "Without --fluid A,B,... on every path. The folder (default out/<scene>-compare) holds a run per path, "
     "compare.json, and report.html: errors, costs, gauges and fields of all paths side by side.\n",
     verb_compare},
    {"study", "SCENE", "--refine --fluid --set --out --threads --until --quick --quiet --force",
     "runs a scene over ladders of a parameter: error against run time",
     "--refine h=0.04,0.02,0.01 or any key of the scene; h, dt, ppc, basis, transfer, K, mu are short for the usual "
     "ones.\n"
     "Prints every metric with its fitted order. The folder (default out/<scene>-study) holds the runs and "
     "study.json;\n"
     "mpmice plot makes the picture.\n",
     verb_study},
    {"stress", "SCENE", "--sweep --fluid --set --out --threads --until --quick --force",
     "maps where a scene stays stable",
     "Runs the product of all --sweep KEY=V,V,... (default: time step factor times stiffness of the fluid). Stable: "
     "finite to\n"
     "the end, masses kept, no energy gained, volume defect bounded. The folder (default out/<scene>-stress) holds "
     "the\n"
     "runs and stress.json; mpmice plot makes the picture.\n",
     verb_stress},
    {"info", "FILE", NULL, "prints what is in a file of an output folder",
     "Snapshots and checkpoints: arrays, sizes, units. gauges.csv: columns and their ranges. .json: the tree.\n",
     verb_info},
    {"plot", "DIR", NULL, "makes the standard pictures of a run, or of all runs below a folder",
     "gauges.png and fields.png beside each run; isochrones.png where the scene names Terzaghi's theory. Needs Python "
     "with\nh5py and matplotlib.\n",
     verb_plot},
    {"check", "SCENE", "--fluid --set --quick", "validates a scene and prints what would run",
     "Every variant is validated too. Per fluid path: points, memory, time step, steps. Writes nothing.\n", verb_check},
    {"explain", "SCENE", "--fluid --set --quick", "prints the plan: stages in order, and those left out",
     "The number, the slot of core/step_order.def, the stage, what it reads and writes, its section of "
     "docs/theory.md.\n",
     verb_explain},
    {"list", NULL, "--markdown", "prints shipped cases, laws, stages and every parameter", "", verb_list},
    {"schema", NULL, NULL, "prints the JSON Schema of a scene",
     "Draft 2020-12. Keep it beside your scenes, name it in \"$schema\", and an editor completes and checks keys.\n",
     verb_schema},
    {"new", "NAME", "--force", "writes a commented starter scene",
     "NAME.json in the present folder: a saturated column under a load. Keys that start with // are comments.\n",
     verb_new},
    {.name = NULL}};
