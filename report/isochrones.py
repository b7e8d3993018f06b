#!/usr/bin/env python3
"""Pressure over height at several times of a consolidation, every run below a folder against Terzaghi's theory.

usage: isochrones.py FOLDER [PICTURE]
"""
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import snapshots

TIMES = (0.1, 0.2, 0.3, 0.5, 0.7, 1.0)  # T_v
MARKERS = {"ice": "o", "twopoint": "x"}


class Theory:
    """Terzaghi with the water's storage, references/terzaghi.c: here only for the line in the picture."""

    def __init__(self, scene):
        get = lambda key: snapshots.value(scene, f"references.theory.{key}")
        young, nu = get("young"), get("poisson")
        modulus = young * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
        self.softening = 1 + modulus * get("porosity") / get("bulk_modulus")
        self.height, self.load = get("height"), get("load")
        weight = get("density") * get("gravity")
        k = get("permeability") or self.kozeny_carman(get) * weight / get("viscosity")
        self.time = self.height**2 * weight / (k * modulus)  # s: T_v = 1

    @staticmethod
    def kozeny_carman(get):
        """m2, from the grains"""
        n = get("porosity")
        return get("grain_diameter") ** 2 * n**3 / (get("kozeny_factor") * (1 - n) ** 2)

    def pressure(self, height, T_v):
        odd = 2 * np.arange(200) + 1
        depth = (1 - height)[:, None]
        modes = 4 / (np.pi * odd) * np.sin(odd * np.pi / 2 * depth) * np.exp(-((odd * np.pi / 2) ** 2) * T_v / self.softening)
        return self.load / self.softening * modes.sum(axis=1)


def consolidation(run):
    """Whether the run has Terzaghi's theory to be drawn against."""
    return snapshots.scene(run).get("references", {}).get("theory", {}).get("kind") == "terzaghi"


def nearest(series, time):
    return min(series, key=lambda entry: abs(entry[0] - time))


def draw_run(axes, run, theory):
    """Points of one run; False where it holds no pressures."""
    path = snapshots.summary(run)["fluid_path"]
    series = snapshots.series(run, "water") or snapshots.series(run, "cells")
    drawn = False
    for i, T_v in enumerate(TIMES):
        time, file = nearest(series, T_v * theory.time)
        if abs(time - T_v * theory.time) > 1e-3 * theory.time:
            continue
        places, P = snapshots.read(file, "P")
        inside = places[:, 1] <= theory.height
        axes.plot(P[inside] / theory.load, places[inside, 1] / theory.height, MARKERS.get(path, "+"), color=f"C{i}", ms=4,
                  mfc="none", label=None if drawn else path)
        drawn = True
    return drawn


def main(folder, picture):
    found = snapshots.runs(folder)
    if not found:
        sys.exit(f"isochrones.py: {folder}: no run here, for there is no summary.json")
    runs = [run for run in found if consolidation(run)]
    if not runs:
        sys.exit(f"isochrones.py: {folder}: the scene has no references.theory of kind terzaghi to draw against; mpmice plot draws the fields")
    runs = [run for run in runs if snapshots.summary(run)["status"] == "done"] or runs
    theory = Theory(snapshots.scene(runs[0]))
    figure, axes = plt.subplots(figsize=(7, 5), layout="constrained")
    height = np.linspace(0, 1, 201)
    for i, T_v in enumerate(TIMES):
        axes.plot(theory.pressure(height, T_v) / theory.load, height, "-", color=f"C{i}", lw=1)
        axes.annotate(f"$T_v$ = {T_v}", (theory.pressure(height[:1], T_v)[0] / theory.load, 0), (0, -11), color=f"C{i}",
                      textcoords="offset points", ha="center", fontsize=8)
    for run in runs:
        draw_run(axes, run, theory)
    axes.plot([], [], "k-", lw=1, label="Terzaghi")
    axes.set(xlabel="excess pore pressure / load", ylabel="height / column height", xlim=(0, 1), ylim=(-0.06, 1), title=snapshots.scene(runs[0])["title"])
    axes.legend()
    axes.grid(alpha=0.3)
    figure.savefig(picture, dpi=150)
    print(f"picture: {os.path.abspath(picture)}")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2] if len(sys.argv) == 3 else os.path.join(sys.argv[1], "isochrones.png"))
