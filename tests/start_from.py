#!/usr/bin/env python3
"""Whether a run begins with the very fields that another ended with, and goes on as that one did when it was not stopped.

usage: start_from.py FIRST SECOND WHOLE
"""
import glob
import json
import os
import sys

import h5py
import numpy as np


OF_A_STEP = {"VTKHDF/CellData/defect", "VTKHDF/CellData/density"}  # no state: zero before the first step of any run


def snapshot(folder, name, which):
    """{array: values} of the first (0) or last (-1) snapshot of a set"""
    with open(f"{folder}/fields.{name}.hdf.series") as file:
        path = os.path.join(folder, json.load(file)["files"][which]["name"])
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda key, item: found.update({key: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def compare(what, one, other, limit):
    """Sentences about arrays that differ by more than limit times their largest value."""
    if one.keys() != other.keys() or len(one) < 4:
        return [f"{what}: arrays {sorted(one)} and {sorted(other)}"]
    faults = []
    for key in one.keys() - (OF_A_STEP if limit == 0 else set()):
        a, b = np.asarray(one[key], float), np.asarray(other[key], float)
        off = np.max(np.abs(a - b), initial=0) if a.shape == b.shape else np.inf
        if not off <= limit * np.max(np.abs(a), initial=0):
            faults.append(f"{what}: {key} differs by {off:.3g}, its largest value is {np.max(np.abs(a)):.3g}")
    return faults


def main(first, second, whole):
    names = [os.path.basename(path).split(".")[1] for path in glob.glob(f"{first}/fields.*.hdf.series")]
    faults = [] if len(names) >= 2 else [f"sets {names}"]
    for name in names:
        faults += compare(f"{name}: start", snapshot(first, name, -1), snapshot(second, name, 0), 0)
        faults += compare(f"{name}: end", snapshot(whole, name, -1), snapshot(second, name, -1), 1e-6)
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:4]))
