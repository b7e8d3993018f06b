#!/usr/bin/env python3
"""Runs cases in full against their references and writes down what came out.

usage: validate.py --program PROGRAM --out FOLDER [--record] [CASE ...]

CASE is the name of a case (all its variants) or case+variant; without any, everything that cases/*/expected.json has limits for,
quick variants excepted. --record writes the values, to three digits, beside the limits of cases/*/expected.json. FOLDER/results.json keeps the figures of cases that did not run this time; FOLDER/README.md shows all.
"""
import argparse
import glob
import json
import math
import os
import platform
import subprocess
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def jobs(wanted):
    """[(scene, path)] in the order of the folders."""
    found = []
    for file in sorted(glob.glob(os.path.join(ROOT, "cases", "*", "expected.json"))):
        case = os.path.basename(os.path.dirname(file))
        with open(file) as text:
            expected = json.load(text)
        for variant, paths in expected.items():
            scene = case if variant == "base" else f"{case}+{variant}"
            if "quick" not in variant.split("+") and (not wanted or case in wanted or scene in wanted):
                found += [(scene, path) for path in paths]
    return found


def run(program, scene, path):
    """One run's figures; None for its metrics if it failed."""
    folder = os.path.join(ROOT, "out", "validate", f"{scene}-{path}")
    command = [program, "run", scene, "--quiet", "--force", "--out", folder] + ([] if path == "solid" else ["--fluid", path])
    started = time.monotonic()
    result = subprocess.run(command, stderr=subprocess.PIPE, text=True)
    record = {"exit": result.returncode, "message": result.stderr.strip(), "wall_s": round(time.monotonic() - started, 2)}
    if result.returncode in (0, 1):
        with open(os.path.join(folder, "summary.json")) as file:
            summary = json.load(file)
        record.update({key: summary[key] for key in ("steps", "cells", "points_solid", "points_fluid", "threads", "version", "ledger", "metrics")})
        record["dt_mean"] = summary["dt"]["mean"]
    return record


def number(value):
    return "" if value is None else f"{value:.3g}"


def rows(scene, path, record):
    if "metrics" not in record:
        return [f"| {scene} | {path} | **failed** | {record['message'].replace('|', '/')} | | | | | |"]
    lines = []
    for name, m in record["metrics"].items():
        verdict = "" if m["limit"] is None else "ok" if m["pass"] else "**missed**"
        lines.append(f"| {scene} | {path} | {name} | {number(m['value'])} | {number(m['limit'])} | {m['unit']} | {verdict} | "
                     f"{record['steps']} x {number(record['dt_mean'])} s | {record['wall_s']} s |")
    return lines


def judge(case, relation, runs):
    """What a relation between runs of a case comes to; None where a run is missing. "ratio": of the metric "of" in two variants; "order": the
    smallest ratio of neighbours; "exponent": of a power law through {variant: number}, by least squares of logarithms."""
    def value(variant):
        scene = case if variant == "base" else f"{case}+{variant}"
        record = runs.get(f"{scene} {relation.get('path', 'solid')}", {})
        return record.get("metrics", {}).get(relation["of"], {}).get("value")

    kind = next(key for key in ("ratio", "order", "exponent") if key in relation)
    values = [value(variant) for variant in relation[kind]]
    if None in values:
        return None
    if kind == "exponent":
        x, y = [math.log(number) for number in relation[kind].values()], [math.log(v) for v in values]
        mx, my = sum(x) / len(x), sum(y) / len(y)
        return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)
    if kind == "ratio":
        return values[0] / values[1]
    return min(after / before for before, after in zip(values, values[1:]))


def relations(runs):
    """{"case relation": figures} of cases/*/relations.json"""
    found = {}
    for file in sorted(glob.glob(os.path.join(ROOT, "cases", "*", "relations.json"))):
        case = os.path.basename(os.path.dirname(file))
        with open(file) as text:
            for name, relation in json.load(text).items():
                value = judge(case, relation, runs)
                if value is None:
                    continue
                within = abs(value - relation["expected"]) <= relation["limit"] if "expected" in relation else \
                    relation.get("least", -math.inf) <= value <= relation.get("most", math.inf)
                wanted = f"{relation['expected']} +- {relation['limit']}" if "expected" in relation else \
                    " and ".join(f"{word} {relation[word]}" for word in ("least", "most") if word in relation)
                found[f"{case} {name}"] = {"value": value, "wanted": wanted, "pass": within}
    return found


def page(results):
    lines = ["# Validation", "",
             "Written by `./dev validate`: every case in full on every path it has limits for. `value` is compared with `limit`; what each metric is",
             "stands in the case's README. Run times are wall times of the machine named in `results.json`.", "",
             "| case | path | metric | value | limit | unit | | steps | run time |", "|---|---|---|---|---|---|---|---|---|"]
    for key in sorted(results["runs"]):
        scene, path = key.rsplit(" ", 1)
        lines += rows(scene, path, results["runs"][key])
    found = relations(results["runs"])
    if found:
        lines += ["", "Relations between runs (`cases/<case>/relations.json`):", "", "| case | relation | value | wanted | |", "|---|---|---|---|---|"]
        lines += [f"| {key.split()[0]} | {key.split()[1]} | {r['value']:.4g} | {r['wanted']} | {'ok' if r['pass'] else '**missed**'} |" for key, r in found.items()]
    return "\n".join(lines) + "\n"


def record_values(runs):
    """Puts what was measured beside each limit of cases/*/expected.json."""
    for file in sorted(glob.glob(os.path.join(ROOT, "cases", "*", "expected.json"))):
        case = os.path.basename(os.path.dirname(file))
        with open(file) as text:
            expected = json.load(text)
        blocks = []
        for variant, paths in expected.items():
            inner = []
            for path, metrics in paths.items():
                measured = runs.get(f"{case if variant == 'base' else case + '+' + variant} {path}", {}).get("metrics", {})
                lines = []
                for name, entry in metrics.items():
                    value = measured.get(name, {}).get("value", entry.get("value"))
                    entry = {key: entry[key] for key in entry if key != "value"}
                    if value is not None:
                        entry = {"value": float(f"{value:.3g}"), **entry}
                    lines.append(f"      {json.dumps(name)}: {json.dumps(entry)}")
                inner.append(f"    {json.dumps(path)}: {{\n" + ",\n".join(lines) + "\n    }")
            blocks.append(f"  {json.dumps(variant)}: {{\n" + ",\n".join(inner) + "\n  }")
        with open(file, "w") as text:
            text.write("{\n" + ",\n".join(blocks) + "\n}\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", required=True)
    parser.add_argument("--out", required=True)
    parser.add_argument("--record", action="store_true")
    parser.add_argument("case", nargs="*")
    options = parser.parse_args()
    selected = jobs(options.case)
    if not selected:
        sys.exit(f"validate.py: no case {', '.join(options.case)} in cases/*/expected.json")
    os.makedirs(options.out, exist_ok=True)
    store = os.path.join(options.out, "results.json")
    results = {"runs": {}}
    if os.path.exists(store):
        with open(store) as file:
            results = json.load(file)
    results["machine"] = f"{platform.machine()}, {os.cpu_count()} cores"
    missed = 0
    for scene, path in selected:
        record = run(options.program, scene, path)
        results["runs"][f"{scene} {path}"] = record
        missed += record["exit"] != 0
        print(f"{scene:40s} {path:10s} {'ok' if record['exit'] == 0 else 'MISSED' if record['exit'] == 1 else 'FAILED':7s}{record['wall_s']:10.1f} s", flush=True)
        with open(store, "w") as file:
            json.dump(results, file, indent=1, sort_keys=True)
            file.write("\n")
        with open(os.path.join(options.out, "README.md"), "w") as file:
            file.write(page(results))
    if options.record:
        record_values(results["runs"])
    apart = [key for key, r in relations(results["runs"]).items() if not r["pass"] and (not options.case or key.split()[0] in options.case)]
    for key in apart:
        print(f"relation missed: {key}")
    print(f"{len(selected) - missed} of {len(selected)} within their limits; written: {options.out}/README.md")
    return 1 if missed or apart else 0


if __name__ == "__main__":
    sys.exit(main())
