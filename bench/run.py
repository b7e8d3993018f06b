#!/usr/bin/env python3
"""Times the stages of the scenes of bench/ and prints nanoseconds per point, cell and step beside what the machine can do.

usage: run.py BUILD_FOLDER [--steps N] [scene ...]
A scene is a file of bench/ without .json, with +VARIANT if it has one; all, if none is named. Times are the least of N steps
(20); one thread is timed by its own clock, and steps on one and on all threads follow one another by turns. Writes
out/bench/results.json. On a shared machine only figures of one call may be compared with one another.
"""
import glob
import json
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SKIP = 30  # steps before those that count: the points have yielded, memory has been touched


def all_scenes():
    """Names of the scenes and their variants."""
    names = []
    for path in sorted(glob.glob(f"{ROOT}/bench/*.json")):
        with open(path) as file:
            scene = json.load(file)
        name = os.path.basename(path)[:-5]
        names += [name] + [f"{name}+{variant}" for variant in scene.get("variants", {})]
    return names


def paths_of(name):
    with open(f"{ROOT}/bench/{name.split('+')[0]}.json") as file:
        return ["ice", "twopoint"] if "fluid" in json.load(file) else ["solid"]


def measure(program, name, path, threads, steps):
    """What bench_stages prints of a scene."""
    file, plus, variant = name.partition("+")
    command = [program, f"{ROOT}/bench/{file}.json{plus}{variant}", str(threads), str(steps), str(SKIP)]
    return json.loads(subprocess.run(command + ([] if path == "solid" else [path]), check=True, capture_output=True, text=True).stdout)


def kind(stage):
    """What a stage's time is counted under."""
    folder, what = stage.split(".")
    if folder == "mpm" and what.startswith("points_to_nodes"):
        return "points to nodes"
    if folder == "mpm" and what.startswith(("move_and_strain", "nodes_to_points", "update_stress")):
        return "nodes to points and stress"
    return "solid, the rest" if folder == "mpm" else folder


def costs(result, run, clock):
    """ns per point or cell and step of every kind of stage; cells for what a path does in cells."""
    per = {"twopoint": result["points_fluid"], "ice": result["cells"], "coupling": result["cells"]}
    ns = {}
    for stage, seconds in run["stages"].items():
        if stage != "step":
            ns[kind(stage)] = ns.get(kind(stage), 0) + 1e9 * seconds[clock] / max(per.get(kind(stage), result["points_solid"]), 1)
    return ns


def report(name, path, result):
    one, last = result["runs"][0], result["runs"][-1]
    ns = costs(result, one, "least_s")
    result["ns"] = ns
    moved = sum(value for what, value in ns.items() if what in ("points to nodes", "nodes to points and stress"))
    print(f"{name:18s} {path:9s}" + ", ".join(f"{what} {value:.1f}" for what, value in ns.items()) + f" ns; the first two {moved:.1f}")
    line = f"{'':28s}{result['points_solid']} solid points, {100 * result['yielding']:.0f} % yield"
    if path == "solid":
        line += f"; {result['resident_bytes'] / result['points_solid']:.0f} bytes a point, {result['field_bytes'] / result['points_solid']:.0f} of fields"
    if last is not one:
        result["speed_up"] = one["stages"]["step"]["least_wall_s"] / last["stages"]["step"]["least_wall_s"]
        line += f"; {last['threads']} threads are {result['speed_up']:.2f} times as fast"
    print(line, flush=True)


def main(build, arguments):
    steps = 20
    if arguments[:1] == ["--steps"]:
        steps, arguments = int(arguments[1]), arguments[2:]
    machine = json.loads(subprocess.run([f"{build}/bench/bench_machine"], check=True, capture_output=True, text=True).stdout)
    print("machine: triad {triad_one_GB_s} GB/s on one thread, {triad_all_GB_s} on {threads}; {fma_one_Gflop_s} Gflop/s on one".format(**machine))
    results = {"machine": machine, "scenes": []}
    for name in arguments or all_scenes():
        for path in paths_of(name):
            result = measure(f"{build}/bench/bench_stages", name, path, machine["threads"], steps)
            report(name, path, result)
            results["scenes"].append({"scene": name, "path": path, **result})
    os.makedirs(f"{ROOT}/out/bench", exist_ok=True)
    with open(f"{ROOT}/out/bench/results.json", "w") as file:
        json.dump(results, file, indent=1)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
