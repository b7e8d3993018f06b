#!/usr/bin/env python3
"""Whether two output folders hold the same run bit by bit: gauges, and every field of the snapshots at the same time.

usage: same_run.py FOLDER FOLDER
"""
import glob
import json
import sys

import h5py


def arrays(path):
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()].tobytes()}) if isinstance(item, h5py.Dataset) else None)
    return found


def snapshots(folder):
    """{(set, time): file}"""
    found = {}
    for series in glob.glob(f"{folder}/fields.*.hdf.series"):
        with open(series) as file:
            for entry in json.load(file)["files"]:
                found[entry["name"].split(".")[1], entry["time"]] = f"{folder}/{entry['name']}"
    return found


def main(a, b):
    faults = []
    with open(f"{a}/gauges.csv") as left, open(f"{b}/gauges.csv") as right:
        left, right = left.read(), right.read()
    if left != right or left.count("\n") < 3:
        faults.append("gauges.csv")
    left, right = snapshots(a), snapshots(b)
    if len(left.keys() & right.keys()) < 2 or left.keys() ^ right.keys():
        faults.append(f"times of snapshots {sorted(left)} and {sorted(right)}")
    for key in sorted(left.keys() & right.keys()):
        one, other = arrays(left[key]), arrays(right[key])
        faults += [f"{key}: {name}" for name in sorted(one.keys() | other.keys()) if one.get(name) != other.get(name)]
    for fault in faults[:20]:
        print(f"same_run.py: differs: {fault}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3]))
