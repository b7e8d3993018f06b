"""What the plots read from output folders: snapshots, their times, the scene that ran."""
import glob
import json
import os

import h5py
import numpy as np


def runs(folder):
    """Output folders at or below a folder, sorted."""
    found = glob.glob(os.path.join(folder, "**", "summary.json"), recursive=True)
    return sorted(os.path.dirname(path) for path in found)


def summary(run):
    with open(os.path.join(run, "summary.json")) as file:
        return json.load(file)


def scene(run):
    with open(os.path.join(run, "scene.used.json")) as file:
        return json.load(file)


def value(scene_, key):
    """A number of a scene; "=key.path" stands for the number found there, "infinite" for an infinite one."""
    here = scene_
    for word in key.split("."):
        here = here[word]
    if here == "infinite":
        return np.inf
    return value(scene_, here[1:]) if isinstance(here, str) and here.startswith("=") else here


def series(run, name):
    """[(time s, file)] of a set of snapshots: solid, water or cells; empty if there is none."""
    path = os.path.join(run, f"fields.{name}.hdf.series")
    if not os.path.exists(path):
        return []
    with open(path) as file:
        return [(entry["time"], os.path.join(run, entry["name"])) for entry in json.load(file)["files"]]


def read(path, name):
    """Places [n, 3] m and values [n] or [n, k] of a field: at points, or at the centres of cells. None: no such field."""
    with h5py.File(path, "r") as file:
        data = file["VTKHDF"]
        points = data["Points"][()]
        if f"PointData/{name}" in data:
            return points, data[f"PointData/{name}"][()]
        if f"CellData/{name}" not in data:
            return None
        corners = data["Connectivity"][()].reshape(data["NumberOfCells"][()].sum(), -1)
        return np.mean(points[corners], axis=1), data[f"CellData/{name}"][()]
