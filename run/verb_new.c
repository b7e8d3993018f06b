/* `mpmice new`: a starter scene that runs and explains itself. */
#include "core/scene.h"
#include "run/files.h"
#include "run/verbs.h"

#include <stdio.h>
#include <string.h>

static const char starter[] =
    "{\n"
    "  \"//\": \"A saturated column that consolidates under a load. Keys that start with // are comments. Units are "
    "SI.\",\n"
    "  \"title\": \"Consolidating column\",\n"
    "\n"
    "  \"// grid\": \"two numbers: 2D (plane strain), three: 3D; null in max: one cell wide; above the soil is "
    "room\",\n"
    "  \"grid\": {\"min\": [0, 0], \"max\": [null, 1.2], \"h\": 0.05},\n"
    "  \"time\": {\"end\": 0.1},\n"
    "  \"// gravity\": \"numbers, or expressions of t such as -9.81*min(1, t); without it the column starts "
    "unstressed\",\n"
    "  \"gravity\": [0, 0],\n"
    "  \"start\": \"zero\",\n"
    "\n"
    "  \"materials\": {\n"
    "    \"sand\": {\"model\": \"linear_elastic\", \"young\": 1e7, \"poisson\": 0.3, \"density\": 2650, \"porosity\": "
    "0.3,\n"
    "             \"// permeability\": \"hydraulic conductivity in m/s\", \"permeability\": 1e-3}\n"
    "  },\n"
    "  \"// solids\": \"shapes: box, circle, sphere, polygon, half_space, union, difference, intersection, "
    "everywhere\",\n"
    "  \"solids\": {\n"
    "    \"column\": {\"material\": \"sand\", \"shape\": {\"box\": {\"min\": [null, 0], \"max\": [null, 1]}}}\n"
    "  },\n"
    "  \"// fluid\": \"path: the method that moves the water; leave the whole fluid out for a dry scene\",\n"
    "  \"fluid\": {\"path\": \"ice\", \"density\": 1000, \"bulk_modulus\": 2.2e9, \"viscosity\": 1e-3, \"drag\": "
    "\"darcy\",\n"
    "            \"region\": {\"box\": {\"min\": [null, 0], \"max\": [null, 1]}}},\n"
    "\n"
    "  \"// boundary\": \"sides that are not named are smooth and closed (slip)\",\n"
    "  \"boundary\": {\"solid\": {\"y_min\": \"no_slip\"}, \"fluid\": {\"y_max\": {\"pressure\": 0}}},\n"
    "  \"// loads\": \"a traction in Pa on a surface of the soil; it moves with the soil\",\n"
    "  \"loads\": {\"top\": {\"on\": {\"box\": {\"min\": [null, 1], \"max\": [null, 1]}}, \"traction\": [0, -1e4]}},\n"
    "\n"
    "  \"// gauges\": \"written to gauges.csv\",\n"
    "  \"gauges\": {\n"
    "    \"base_pressure\": {\"kind\": \"point\", \"at\": [null, 0.02], \"of\": \"P\"},\n"
    "    \"settlement\": {\"kind\": \"load\", \"on\": \"top\", \"of\": \"displacement_y\"}\n"
    "  },\n"
    "  \"numerics\": {\"basis\": \"quadratic\", \"points_per_cell\": 4},\n"
    "  \"output\": {\"interval\": 0.02, \"gauge_interval\": 0.001},\n"
    "\n"
    "  \"// variants\": \"overrides: mpmice run NAME.json+loose, --quick, or one value with --set "
    "materials.sand.young=2e7\",\n"
    "  \"variants\": {\"loose\": {\"materials.sand.young\": 5e6}},\n"
    "  \"quick\": {\"grid.h\": 0.1}\n"
    "}\n";

enum status verb_new(const struct run_options *options)
{
  char   file[LONGEST_PATH];
  size_t n = strlen(options->argument);
  bool   ends = n > 5 && strcmp(options->argument + n - 5, ".json") == 0;
  if (snprintf(file, sizeof file, "%s%s", options->argument, ends ? "" : ".json") >= LONGEST_PATH - 8)
    return FAIL(ERR_INPUT, "%.40s...: the name is too long; shorten it", options->argument);
  if (files_exists(file) && !options->force)
    return FAIL(ERR_INPUT, "%s: the file is there already; choose another name or overwrite it with --force", file);
  TRY(files_replace(file, starter, strlen(starter)));
  printf("%s: run it with mpmice run %s\n", file, file);
  return OK;
}
