"""Pictures of mpmice study (error against run time and against the parameter) and of mpmice stress (maps of stability)."""
import itertools
import json
import os

import matplotlib.pyplot as plt
import numpy as np

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7")


def load(folder, name):
    with open(os.path.join(folder, name)) as file:
        return json.load(file)


def curves(ladder):
    """{metric: {path: (values, |metric|, run times)}}: of the runs that were done and gave a number"""
    found = {}
    for path, here in ladder["paths"].items():
        for run in here["runs"]:
            for metric, number in run["metrics"].items():
                if number:
                    found.setdefault(metric, {}).setdefault(path, []).append((run["value"], abs(number), run["wall_s"]))
    return {metric: {path: list(zip(*points)) for path, points in paths.items()} for metric, paths in found.items()}


def draw_row(axes, metric, paths, ladder):
    for colour, (path, (values, errors, times)) in zip(COLOURS, paths.items()):
        order = ladder["paths"][path]["orders"].get(metric)
        label = path if order is None else f"{path}, order {order:.2f}"
        axes[0].plot(values, errors, "o-", color=colour, label=label)
        axes[1].plot(times, errors, "o-", color=colour, label=path)
        for value, error, time in zip(values, errors, times):
            axes[1].annotate(str(value), (time, error), fontsize=7, xytext=(3, 3), textcoords="offset points")
    numeric = all(isinstance(value, (int, float)) for points in paths.values() for value in points[0])
    axes[0].set(xlabel=ladder["key"], ylabel=f"|{metric}|", yscale="log", xscale="log" if numeric else "linear")
    axes[1].set(xlabel="run time [s]", yscale="log", xscale="log")
    for ax in axes:
        ax.grid(alpha=0.3, which="both")
        ax.legend(fontsize=8)


def draw_study(folder):
    """[figure] per ladder: a row per metric, left the error over the parameter, right over run time"""
    study = load(folder, "study.json")
    figures = []
    for ladder in study["ladders"]:
        metrics = curves(ladder)
        if not metrics:
            continue
        figure, axes = plt.subplots(len(metrics), 2, squeeze=False, figsize=(9, 0.6 + 2.8 * len(metrics)), layout="constrained")
        figure.suptitle(f"{study['scene']}: {ladder['key']}")
        for row, (metric, paths) in zip(axes, metrics.items()):
            draw_row(row, metric, paths, ladder)
        figures.append(figure)
    return figures


def word(value):
    return f"{value:g}" if isinstance(value, (int, float)) else str(value)


def draw_map(ax, runs, axes, rest):
    """One map: rows the last axis but one, columns the last; `rest`: the place on the others"""
    columns = axes[-1]["values"]
    rows = axes[-2]["values"] if len(axes) > 1 else [""]
    table = np.full((len(rows), len(columns)), np.nan)
    for run in runs:
        at = run["at"]
        if tuple(at[:-2]) == rest:
            table[at[-2] if len(axes) > 1 else 0, at[-1]] = run["stable"]
    ax.imshow(table, cmap="RdYlGn", vmin=-0.2, vmax=1.2, aspect="auto")
    ax.set(xticks=range(len(columns)), xlabel=axes[-1]["key"], yticks=range(len(rows)), ylabel=axes[-2]["key"] if len(axes) > 1 else "")
    ax.set_xticklabels(map(word, columns))
    ax.set_yticklabels(map(word, rows))


def draw_stress(folder):
    """One figure: a row of maps per path"""
    stress = load(folder, "stress.json")
    axes = stress["axes"]
    rests = list(itertools.product(*(range(len(axis["values"])) for axis in axes[:-2])))
    figure, panels = plt.subplots(len(stress["paths"]), len(rests), squeeze=False, layout="constrained",
                                  figsize=(1 + 3.6 * len(rests), 0.6 + 3 * len(stress["paths"])))
    figure.suptitle(f"{stress['scene']}: stable (green), not (red)")
    for row, (path, here) in zip(panels, stress["paths"].items()):
        for ax, rest in zip(row, rests):
            draw_map(ax, here["runs"], axes, rest)
            ax.set_title(", ".join([path] + [f"{axis['key']} {word(axis['values'][i])}" for axis, i in zip(axes, rest)]), fontsize=8)
    return [figure]
