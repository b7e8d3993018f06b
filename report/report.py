#!/usr/bin/env python3
"""report.html of a comparison: one page with everything in it, from compare.json and the runs beside it.

usage: report.py FOLDER
Exit status: 0 done, 2 no comparison there.
"""
import base64
import html
import io
import json
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import plot
import snapshots
from studies import COLOURS

# what paths store under different names: (title, [(set, field)], how to make a number of it)
LENGTH, VERTICAL = (lambda a: np.linalg.norm(a, axis=1)), (lambda a: a[:, 1])
QUANTITIES = [
    ("pressure of the fluid [Pa]", [("water", "P"), ("cells", "P")], None),
    ("speed of the fluid [m/s]", [("water", "vel"), ("cells", "vel_fluid")], LENGTH),
    ("saturation [-]", [("cells", "saturation")], None),
    ("temperature [K]", [("cells", "temperature")], None),
    ("displacement of the solid [m]", [("solid", "displacement")], LENGTH),
    ("speed of the solid [m/s]", [("solid", "vel")], LENGTH),
    ("vertical effective stress [Pa]", [("solid", "stress")], VERTICAL),
]
TIMES = 3  # snapshots drawn


# ---- fields on the scene's grid ----

def grid_of(scene):
    low = np.array(scene["grid"]["min"], dtype=float)
    h = snapshots.value(scene, "grid.h")
    high = [h + a if b is None or b == "infinite" else b for a, b in zip(low, scene["grid"]["max"])]
    return low, h, np.maximum(1, np.rint((np.array(high, dtype=float) - low) / h).astype(int))


def on_grid(places, values, grid):
    """Mean of the values in every cell, NaN where there is none; in 3D of the middle layer. [n_y, n_x]"""
    low, h, n = grid
    cell = np.floor((places[:, :len(n)] - low) / h + 1e-9).astype(int)
    inside = np.all((cell >= 0) & (cell < n), axis=1) & np.isfinite(values)
    if len(n) == 3:
        inside &= cell[:, 2] == n[2] // 2
    flat = cell[inside, 1] * n[0] + cell[inside, 0]
    count = np.bincount(flat, minlength=n[0] * n[1])
    total = np.bincount(flat, values[inside], n[0] * n[1])
    with np.errstate(invalid="ignore"):
        return (total / count).reshape(n[1], n[0])


def wet_only(file, values):
    """NaN in cells without fluid"""
    wet = snapshots.read(file, "wet")
    return values if wet is None else np.where(wet[1] > 0, values, np.nan)


def quantity(run, names, reduce, time, grid):
    """The quantity at the snapshot nearest to `time` on the grid; None where the run has no such field"""
    for name, field in names:
        series = snapshots.series(run, name)
        if not series:
            continue
        file = min(series, key=lambda entry: abs(entry[0] - time))[1]
        found = snapshots.read(file, field)
        if found is None:
            continue
        places, values = found
        values = reduce(values) if reduce else values
        if name == "cells" and field != "saturation":
            values = wet_only(file, values)
        return on_grid(places, values, grid)
    return None


def snapshot_times(run):
    times = sorted({time for name in plot.SETS for time, _ in snapshots.series(run, name)})
    picks = np.linspace(0, len(times) - 1, min(TIMES + 1, len(times))).round().astype(int)[1:] if len(times) > 1 else [0]
    return [times[i] for i in picks] if times else []


def draw_profiles(axes, maps, grid, title):
    """Columns one or two cells wide: every path over the height; below, what the last has beyond the first"""
    low, h, n = grid
    heights = low[1] + h * (np.arange(n[1]) + 0.5)
    lines = {path: np.nanmean(values, axis=1) if values.shape[1] > 1 else values[:, 0] for path, values in maps.items()}
    for colour, style, (path, values) in zip(COLOURS, ("o-", "s--", "^:", "d-."), lines.items()):
        axes[0].plot(values, heights, style, ms=3, lw=1, color=colour, label=path)
    axes[0].legend(fontsize=8)
    axes[0].set(xlabel=title, ylabel="y [m]")
    if len(axes) > 1:
        axes[1].set_visible(len(lines) > 1)
    if len(lines) > 1:
        first, last = list(lines)[0], list(lines)[-1]
        axes[1].plot(lines[last] - lines[first], heights, "k.-", ms=3, lw=1)
        axes[1].set(xlabel=f"{last} minus {first}", ylabel="y [m]")
    for ax in axes:
        ax.grid(alpha=0.3)
        ax.locator_params(axis="x", nbins=5)


def draw_maps(axes, maps, grid, title):
    """One colour scale for all paths, then the difference of the last and the first"""
    low, h, n = grid
    extent = (low[0], low[0] + h * n[0], low[1], low[1] + h * n[1])
    together = np.concatenate([values[np.isfinite(values)] for values in maps.values()])
    bounds = {"vmin": together.min(), "vmax": together.max()} if len(together) else {}
    for ax, (path, values) in zip(axes, maps.items()):
        picture = ax.imshow(values, origin="lower", extent=extent, aspect="equal", cmap="viridis", **bounds)
        ax.set_title(f"{path}: {title}", fontsize=8)
    axes[0].figure.colorbar(picture, ax=list(axes[:len(maps)]), shrink=0.7)
    if len(maps) > 1:
        first, last = list(maps)[0], list(maps)[-1]
        difference = maps[last] - maps[first]
        finite = np.abs(difference[np.isfinite(difference)])
        most = finite.max() if len(finite) and finite.max() > 0 else 1
        picture = axes[len(maps)].imshow(difference, origin="lower", extent=extent, aspect="equal", cmap="RdBu", vmin=-most, vmax=most)
        axes[len(maps)].set_title(f"{last} minus {first}", fontsize=8)
        axes[len(maps)].figure.colorbar(picture, ax=axes[len(maps)], shrink=0.7)


def draw_fields(runs, time):
    """Every quantity that some path has, at one time"""
    grid = grid_of(snapshots.scene(next(iter(runs.values()))))
    rows = []
    for title, names, reduce in QUANTITIES:
        maps = {path: quantity(run, names, reduce, time, grid) for path, run in runs.items()}
        maps = {path: values for path, values in maps.items() if values is not None and np.isfinite(values).any()}
        if maps and any(np.nanmax(np.abs(values)) > 0 for values in maps.values()):
            rows.append((title, maps))
    if not rows:
        return None
    column = grid[2][0] <= 2
    several = len(runs) > 1
    across, down = (len(rows), 1 + several) if column else (len(runs) + several, len(rows))
    figure, axes = plt.subplots(down, across, squeeze=False, layout="constrained", figsize=(3.4 * across, 3.4 * down) if column else (4.4 * across, 2.6 * down))
    for i, (title, maps) in enumerate(rows):
        if column:
            draw_profiles(axes[:, i], maps, grid, title)
        else:
            draw_maps(axes[i], maps, grid, title)
            for ax in axes[i, len(maps) + (len(maps) > 1):]:
                ax.set_visible(False)
    return figure


# ---- gauges ----

def references_of(run):
    path = os.path.join(run, "references.csv")
    return plot.columns(run, "references.csv") if os.path.exists(path) else {}


def draw_gauges(runs):
    """A panel per gauge: all paths, and what the reference says (dashed)"""
    tables = {path: plot.columns(run) for path, run in runs.items()}
    labels = list(dict.fromkeys(label for table in tables.values() for label in table if label != "t [s]"))[:24]
    if not labels:
        return None
    across = min(2, len(labels))
    down = -(-len(labels) // across)
    figure, axes = plt.subplots(down, across, squeeze=False, figsize=(5.5 * across, 2.4 * down), layout="constrained")
    for ax in axes.flat[len(labels):]:
        ax.set_visible(False)
    theory = references_of(next(iter(runs.values())))
    for ax, label in zip(axes.flat, labels):
        for colour, (path, table) in zip(COLOURS, tables.items()):
            if label in table:
                ax.plot(table["t [s]"], table[label], lw=1.2, color=colour, label=path)
        gauge = label.partition(" [")[0]
        for name, values in theory.items():
            if name.startswith(f"{gauge} ("):
                ax.plot(theory["t [s]"], values, "k--", lw=1, label=name.partition("(")[2].partition(")")[0])
        ax.set_title(label, fontsize=9)
        ax.grid(alpha=0.3)
        ax.legend(fontsize=7)
    return figure


# ---- the page ----

def picture(figure, name):
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=110)
    plt.close(figure)
    return f'<img alt="{name}" src="data:image/png;base64,{base64.b64encode(stream.getvalue()).decode()}">'


def table(head, rows):
    cells = lambda row, tag: "".join(f"<{tag}>{cell}</{tag}>" for cell in row)
    return f"<table><tr>{cells(head, 'th')}</tr>" + "".join(f"<tr>{cells(row, 'td')}</tr>" for row in rows) + "</table>"


def number(value):
    return f"{value:.4g}" if isinstance(value, (int, float)) else html.escape(str(value)) if value is not None else "-"


def look_up(summary, key):
    for word in key.split("."):
        summary = summary.get(word) if isinstance(summary, dict) else None
    return summary


def cost_table(summaries):
    rows = [("status", "status"), ("run time [s]", "wall_s"), ("processor time [s]", "cpu_s"), ("steps", "steps"), ("mean step [s]", "dt.mean"),
            ("largest step [s]", "dt.max"), ("cells", "cells"), ("solid points", "points_solid"), ("fluid points", "points_fluid"), ("memory [B]", "peak_rss_bytes"),
            ("threads", "threads"), ("pressure: solves", "pressure_solver.solves"), ("pressure: iterations", "pressure_solver.iterations_mean"),
            ("pressure: residual", "pressure_solver.residual_max"), ("volume defect, rms", "volume_defect.rms_max"), ("volume defect, largest", "volume_defect.max"),
            ("mass of the solid, change", "ledger.mass_solid_rel"), ("mass of the fluid, change", "ledger.mass_fluid_rel"), ("momentum, change", "ledger.momentum_rel"),
            ("energy, growth", "ledger.energy_growth_rel")]
    found = [[title] + [number(look_up(s, key)) for s in summaries.values()] for title, key in rows]
    limits = [", ".join(f"{name} {count}" for name, count in s["dt"]["limited_by"].items()) for s in summaries.values()]
    return table(["", *summaries], found + [["step limited by (steps)", *limits]])


def metric_table(summaries):
    names = list(dict.fromkeys(name for s in summaries.values() for name in s["metrics"]))
    rows = []
    for name in names:
        row = [name]
        for s in summaries.values():
            m = s["metrics"].get(name)
            verdict = "" if not m or m["limit"] is None else f" (limit {m['limit']:g}: {'ok' if m['pass'] else '<b>missed</b>'})"
            row.append("-" if not m else f"{number(m['value'])} {html.escape(m['unit'])}{verdict}")
        rows.append(row + [next((html.escape(s["metrics"][name]["reference"]) for s in summaries.values() if name in s["metrics"]), "")])
    return table(["metric", *summaries, "reference"], rows)


def stage_table(summary):
    total = sum(stage["seconds"] for stage in summary["stages"]) or 1
    stages = sorted(summary["stages"], key=lambda stage: -stage["seconds"])
    return table(["stage", "calls", "us per call", "share"], [[s["name"], s["calls"], f"{1e6 * s['seconds'] / max(1, s['calls']):.1f}", f"{s['seconds'] / total:.1%}"] for s in stages])


def read_text(run, name):
    with open(os.path.join(run, name)) as file:
        return html.escape(file.read())


def path_details(path, run, summary):
    left = table(["left out", "why"], [[html.escape(entry["name"]), html.escape(entry["why"])] for entry in summary["left_out"]])
    return (f"<h3>{path}</h3>{stage_table(summary)}<details><summary>left out of the plan</summary>{left}</details>"
            f"<details><summary>plan</summary><pre>{read_text(run, 'plan.txt')}</pre></details>"
            f"<details><summary>parameters</summary><pre>{read_text(run, 'scene.used.json')}</pre></details>")


STYLE = """body{font:14px sans-serif;margin:2em;max-width:1200px}table{border-collapse:collapse;margin:.6em 0}td,th{border:1px solid #bbb;padding:.2em .6em;text-align:left}
img{max-width:100%;display:block;margin:.6em 0}pre{background:#f4f4f4;padding:.6em;overflow:auto}b{color:#b00}"""


def page(comparison, runs, summaries):
    first = next(iter(runs.values()))
    scene = snapshots.scene(first)
    parts = [f"<h1>{html.escape(comparison['scene'])}</h1><p>{html.escape(scene.get('title') or '')}</p><p>{html.escape(scene.get('notes') or '')}</p>",
             f"<p>mpmice {html.escape(next(iter(summaries.values()))['version'])}; paths: {', '.join(runs)}</p>",
             "<h2>Errors</h2>", metric_table(summaries), "<h2>Cost and conservation</h2>", cost_table(summaries)]
    for path in comparison["paths"]:
        if path not in runs:
            parts.append(f"<p>{html.escape(path)}: no result</p>")
    gauges = draw_gauges(runs)
    if gauges:
        parts += ["<h2>Gauges</h2>", picture(gauges, "gauges")]
    for time in snapshot_times(first):
        figure = draw_fields(runs, time)
        if figure:
            parts += [f"<h2>Fields at {time:.4g} s</h2>", picture(figure, f"fields at {time:.4g} s")]
    parts += ["<h2>Where the time went</h2>"] + [path_details(path, run, summaries[path]) for path, run in runs.items()]
    return f"<!doctype html><html lang=en><meta charset=utf-8><title>{html.escape(comparison['scene'])}</title><style>{STYLE}</style>" + "\n".join(parts) + "</html>\n"


def main(folder):
    file = os.path.join(folder, "compare.json")
    if not os.path.exists(file):
        print(f"report.py: {folder}: no comparison here, for there is no compare.json", file=sys.stderr)
        return 2
    with open(file) as text:
        comparison = json.load(text)
    summaries = {path: summary for path, summary in comparison["paths"].items() if summary}
    runs = {path: os.path.join(folder, path) for path in summaries}
    if not runs:
        print(f"report.py: {folder}: no path came to a result", file=sys.stderr)
        return 2
    target = os.path.join(folder, "report.html")
    with open(target + ".tmp", "w") as out:
        out.write(page(comparison, runs, summaries))
    os.replace(target + ".tmp", target)
    print(f"report: {os.path.abspath(target)}")
    return 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
