#!/usr/bin/env python3
"""Runs the scenes of bench/ and prints nanoseconds per point, cell and step beside what the machine can do.

usage: run.py BUILD_FOLDER [scene ...]
Writes out/bench/results.json. On a shared machine only runs of one call may be compared with one another.
"""
import glob
import json
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def measure(program, scene, path, threads):
    """summary.json of one run."""
    folder = f"{ROOT}/out/bench/{os.path.basename(scene)[:-5]}-{path}-{threads}"
    command = [program, "run", scene, "--quiet", "--force", "--threads", str(threads), "--out", folder]
    subprocess.run(command + ([] if path == "solid" else ["--fluid", path]), check=True)
    with open(f"{folder}/summary.json") as file:
        return json.load(file)


def costs(summary):
    """ns per point or cell and step, by the folder that the stage belongs to; and the share of every stage."""
    seconds = {}
    for stage in summary["stages"]:
        folder = stage["name"].split(".")[0]
        seconds[folder] = seconds.get(folder, 0) + stage["seconds"]
    per = {"mpm": summary["points_solid"], "twopoint": summary["points_fluid"], "ice": summary["cells"], "coupling": summary["cells"]}
    total = sum(seconds.values())
    return ({folder: 1e9 * s / max(per[folder], 1) / summary["steps"] for folder, s in seconds.items()},
            {stage["name"]: stage["seconds"] / total for stage in summary["stages"]})


def main(build, wanted):
    machine = json.loads(subprocess.run([f"{build}/bench/bench_machine"], check=True, capture_output=True, text=True).stdout)
    print("machine: triad {triad_one_GB_s} GB/s on one thread, {triad_all_GB_s} on {threads}; {fma_one_Gflop_s} Gflop/s on one".format(**machine))
    results = {"machine": machine, "runs": []}
    unit = {"mpm": "solid point", "twopoint": "water point", "ice": "cell", "coupling": "cell"}
    for scene in sorted(glob.glob(f"{ROOT}/bench/*.json")):
        name = os.path.basename(scene)[:-5]
        if wanted and name not in wanted:
            continue
        with open(scene) as file:
            paths = ["ice", "twopoint"] if "fluid" in json.load(file) else ["solid"]
        for path in paths:
            for threads in sorted({1, machine["threads"]}):
                summary = measure(f"{build}/mpmice", scene, path, threads)
                cost, share = costs(summary)
                results["runs"].append({"scene": name, "path": path, "threads": threads, "ns": cost, "share": share, "steps": summary["steps"],
                                        "bytes": summary["peak_rss_bytes"], "points_solid": summary["points_solid"]})
                parts = ", ".join(f"{folder} {ns:.0f} ns per {unit[folder]}" for folder, ns in cost.items())
                print(f"{name:12s} {path:9s} {threads} thread{'s' if threads > 1 else ' '}  {parts}", flush=True)
    with open(f"{ROOT}/out/bench/results.json", "w") as file:
        json.dump(results, file, indent=1)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
