#!/usr/bin/env python3
"""The standard pictures of every run at or below a folder: gauges.png, fields.png, and isochrones.png for consolidations;
of the folder of a study study.png, of a stability map stress.png.

usage: plot.py FOLDER
Exit status: 0 done, 2 no run there.
"""
import csv
import os
import sys

import matplotlib

matplotlib.use("Agg")
import h5py
import matplotlib.pyplot as plt
import numpy as np

import isochrones
import snapshots
import studies

SETS = ("cells", "solid", "water")
MOST_FIELDS = 4  # panels per set
PANEL = 170  # points: about the side of a map
SKIPPED = {"group", "mass", "volume", "mass_fluid", "density", "defect", "wet"}  # of little interest to the eye


def columns(run, name="gauges.csv"):
    """{"t [s]": values, "name [unit]": values, ...} of gauges.csv or references.csv"""
    with open(os.path.join(run, name)) as file:
        rows = list(csv.reader(file))
    values = np.array(rows[1:], dtype=float).reshape(len(rows) - 1, len(rows[0]))
    return dict(zip(rows[0], values.T))


def by_gauge(table):
    """[(label, [(column, values)])]: the samples of a line, name.0 ..., share a panel"""
    panels = {}
    for label, values in table.items():
        name, _, unit = label.partition(" [")
        stem, _, number = name.rpartition(".")
        panels.setdefault(f"{stem if number.isdigit() and stem else name} [{unit}", []).append((name, values))
    return list(panels.items())


def draw_gauges(run):
    table = columns(run)
    t = table.pop("t [s]")
    panels = by_gauge(table)
    if not panels:
        return None
    figure, axes = plt.subplots(len(panels), squeeze=False, sharex=True, figsize=(7, 1 + 2 * len(panels)), layout="constrained")
    for ax, (label, lines) in zip(axes[:, 0], panels):
        for i, (_, values) in enumerate(lines):
            ax.plot(t, values, lw=1, color=plt.cm.viridis(i / max(1, len(lines) - 1)))
        ax.set_ylabel(label)
        ax.grid(alpha=0.3)
    axes[-1, 0].set_xlabel("t [s]")
    return figure


def scalars(file):
    """[(label, name, function of the stored array)] of what is worth a panel: scalars, speeds, vertical stress"""
    found = []
    with h5py.File(file, "r") as h5:
        data = h5["VTKHDF"].get("PointData") or h5["VTKHDF"].get("CellData") or {}
        for name, array in data.items():
            unit = array.attrs["unit"].decode()
            if name in SKIPPED:
                continue
            if array.ndim == 1:
                found.append((f"{name} [{unit}]", name, lambda a: a))
            elif array.shape[1] == 3:
                found.append((f"|{name}| [{unit}]", name, lambda a: np.linalg.norm(a, axis=1)))
            elif array.shape[1] == 6:
                found.append((f"{name}_yy [{unit}]", name, lambda a: a[:, 1]))
    return found[:MOST_FIELDS]


def draw_panel(ax, places, values, cells, h):
    """A curve over the only axis that has more than two layers of cells, else a map (in 3D of the middle slice)."""
    width = np.ptp(places, axis=0)
    wide = [axis for axis in range(3) if width[axis] > 2 * h]
    if len(wide) == 3:
        middle = np.abs(places[:, 2] - np.median(places[:, 2])) <= 0.5 * h
        places, values, wide = places[middle], values[middle], [0, 1]
    if len(wide) < 2:
        axis = wide[0] if wide else 1
        ax.plot(values, places[:, axis], ".", ms=3)
        ax.set_ylabel("xyz"[axis] + " [m]")
        ax.grid(alpha=0.3)
        return
    apart = h if cells else np.sqrt(width[wide[0]] * width[wide[1]] / len(values))
    side = PANEL * apart / max(width[wide[0]], width[wide[1]])
    picture = ax.scatter(places[:, wide[0]], places[:, wide[1]], side**2, values, marker="s" if cells else "o", linewidths=0)
    ax.set(aspect="equal", xlabel="xyz"[wide[0]] + " [m]", ylabel="xyz"[wide[1]] + " [m]")
    ax.figure.colorbar(picture, ax=ax, shrink=0.8)


def draw_fields(run):
    scene = snapshots.scene(run)
    h = snapshots.value(scene, "grid.h")
    last = {name: snapshots.series(run, name)[-1] for name in SETS if snapshots.series(run, name)}
    panels = [(name, time, file, *what) for name, (time, file) in last.items() for what in scalars(file)]
    if not panels:
        return None
    across = min(3, len(panels))
    down = -(-len(panels) // across)
    figure, axes = plt.subplots(down, across, squeeze=False, figsize=(4.5 * across, 3.6 * down), layout="constrained")
    for ax in axes.flat[len(panels):]:
        ax.set_visible(False)
    for ax, (name, time, file, label, field, reduce) in zip(axes.flat, panels):
        places, values = snapshots.read(file, field)
        draw_panel(ax, places, reduce(values), name == "cells", h)
        ax.set_title(f"{name}: {label}, t = {time:.4g} s", fontsize=9)
    return figure


def save(figure, run, name):
    if figure is None:
        return
    path = os.path.join(run, name)
    figure.savefig(path, dpi=120)
    plt.close(figure)
    print(f"picture: {os.path.abspath(path)}")


def main(folder):
    for name, draw in (("study", studies.draw_study), ("stress", studies.draw_stress)):
        if os.path.exists(os.path.join(folder, name + ".json")):
            for i, figure in enumerate(draw(folder)):
                save(figure, folder, f"{name}{i + 1 if i else ''}.png")
            return 0
    runs = snapshots.runs(folder)
    if not runs:
        print(f"plot.py: {folder}: no run here, for there is no summary.json", file=sys.stderr)
        return 2
    for run in runs:
        save(draw_gauges(run), run, "gauges.png")
        save(draw_fields(run), run, "fields.png")
    if all(isochrones.consolidation(run) for run in runs):
        isochrones.main(folder, os.path.join(folder, "isochrones.png"))
    return 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
