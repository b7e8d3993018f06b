#!/usr/bin/env python3
"""The JSON Schema that the program prints, against the shipped cases and against scenes with one fault.

usage: schema.py PROGRAM CASES"""
import copy
import json
import pathlib
import subprocess
import sys

import jsonschema


def put(scene, path, value):
    """A copy of the scene with `value` at a path; None removes the key."""
    scene = copy.deepcopy(scene)
    at = scene
    for key in path[:-1]:
        at = at[key]
    if value is None:
        del at[path[-1]]
    else:
        at[path[-1]] = value
    return scene


FAULTS = [
    (["gird"], {}),
    (["grid", "h"], "0.02"),
    (["grid", "h"], -1),
    (["grid", "h"], None),
    (["grid", "min"], [0]),
    (["start"], "rest"),
    (["materials", "sand", "yuong"], 1e7),
    (["materials", "sand", "young"], None),
    (["materials", "sand", "model"], "linear"),
    (["materials", "sand", "porosity"], 1.5),
    (["solids", "column", "shape"], {"bocks": {}}),
    (["solids", "column", "shape"], {"box": {"min": [0, 0]}}),
    (["solids", "column", "material"], None),
    (["fluid", "eos"], {"law": "linear_water", "bulk_modulus": 1e9}),
    (["fluid", "drag"], {"law": "darcy", "factor": 2}),
    (["fluid", "bulk_modulus"], "huge"),
    (["boundary", "fluid", "y_max"], {"presure": 0}),
    (["boundary", "solid", "y_max"], {"pressure": 0}),
    (["boundary", "heat"], {"y_max": {"pressure": 0}}),
    (["gauges", "base_pressure", "region"], "everywhere"),
    (["gauges", "base_pressure", "at"], None),
    (["numerics", "theta"], 0.4),
    (["numerics", "points_per_cell"], [2]),
    (["metrics", "p_rms_0.1", "measure"], "mode"),
    (["output", "times"], "0.1"),
]


def main(program, cases):
    schema = json.loads(subprocess.run([program, "schema"], check=True, capture_output=True, text=True).stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    failures = []
    scenes = sorted(pathlib.Path(cases).glob("*/scene.json"))
    for scene in scenes:
        for error in validator.iter_errors(json.loads(scene.read_text())):
            failures.append(f"{scene}: {error.json_path}: {error.message}")
    good = json.loads((pathlib.Path(cases) / "terzaghi_column" / "scene.json").read_text())
    for path, value in FAULTS:
        if validator.is_valid(put(good, path, value)):
            failures.append(f"{'.'.join(path)} = {value} was let pass")
    print("\n".join(failures) if failures else f"{len(scenes)} scenes are valid, {len(FAULTS)} faults are found")
    return 1 if failures or not scenes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
