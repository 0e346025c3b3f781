#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables and pictures of doc/benchmarks.md from what bench_precision prints (needs matplotlib, python3-matplotlib).

bench/plots.py precision FILE [picture.png]   table (Markdown) of the work for an error of 1e-3; error against work
bench/plots.py energy FILE [picture.png]      table of the energy kept; its drift against the step
"""
import csv
import math
import sys

import matplotlib

matplotlib.use("agg")
matplotlib.rcParams.update({"font.size": 9, "axes.grid": True, "savefig.dpi": 85,
                            "grid.color": "#dddddd", "lines.markersize": 3.5, "lines.linewidth": 1.2})
from matplotlib import pyplot  # noqa: E402  (after the backend is chosen)

COLOURS = {"splitting": "#0072b2", "collocation": "#d55e00", "energy_conserving": "#009e73", "euler": "#777777",
           "devogelaere": "#cc79a7", "runge_kutta_54": "#000000"}
TARGET = 1e-3


def read(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file, delimiter=";"))


def scenes_of(rows):
    return list(dict.fromkeys(row["scene"] for row in rows))


def schemes_of(rows):
    return [scheme for scheme in COLOURS if any(row["scheme"] == scheme for row in rows)]


def cheapest(rows, work):
    """Least work of the runs from which on, at finer steps, the displacement stays within the target."""
    best = None
    for row in sorted(rows, key=lambda row: float(row["step or tolerance"])):
        if float(row["displacement"]) > TARGET:
            break
        best = row if best is None or float(row[work]) < float(best[work]) else best
    return best


def precision_table(rows):
    print(f"Evaluations, and milliseconds, for an error of the displacements of {TARGET:g} at all 20 instants:\n")
    schemes = schemes_of(rows)
    print("| scene | " + " | ".join(schemes) + " | error of the reference |")
    print("| --- |" + " --- |" * (len(schemes) + 1))
    for scene in scenes_of(rows):
        cells = []
        for scheme in schemes:
            row = cheapest([r for r in rows if r["scene"] == scene and r["scheme"] == scheme], "microseconds")
            cells.append(f"{int(row['evaluations'])}, {1e-3 * float(row['microseconds']):.2g}" if row else "-")
        reference = next(r for r in rows if r["scene"] == scene and r["scheme"] == "reference")
        print(f"| {scene} | " + " | ".join(cells) + f" | {float(reference['displacement']):.0e} |")


def precision_picture(rows, path):
    scenes = scenes_of(rows)
    columns = [("evaluations", "displacement"), ("microseconds", "displacement"), ("microseconds", "force")]
    figure, axes = pyplot.subplots(len(scenes), 3, figsize=(10.0, 2.5 * len(scenes)), layout="constrained")
    for line, scene in enumerate(scenes):
        for column, (work, error) in enumerate(columns):
            axis = axes[line][column]
            for scheme in schemes_of(rows):
                points = [(float(r[work]), float(r[error])) for r in rows if r["scene"] == scene and r["scheme"] == scheme]
                points = [(x, y) for x, y in points if 0.0 < y < 2.0]
                if points:
                    axis.loglog(*zip(*points), marker="o", color=COLOURS[scheme], label=scheme)
            if not axis.lines:  # a force that is given does not err
                axis.set_axis_off()
                continue
            axis.minorticks_off()
            axis.set_title(f"{scene}: {error}", fontsize=9)
            if line == len(scenes) - 1:
                axis.set_xlabel("evaluations of the contact forces" if work == "evaluations" else "time, microseconds")
    axes[0][0].set_ylabel("largest relative error")
    axes[0][0].legend(fontsize=7)
    figure.savefig(path)


def energy_table(rows):
    steps = list(dict.fromkeys(row["w_c h"] for row in rows))
    for scene in scenes_of(rows):
        print(f"\nLargest departure of the energy from its start, {scene}:\n")
        print("| scheme \\ w_c h | " + " | ".join(steps) + " |")
        print("| --- |" + " --- |" * len(steps))
        for scheme in schemes_of(rows):
            values = {r["w_c h"]: float(r["largest departure"]) for r in rows
                      if r["scene"] == scene and r["scheme"] == scheme}
            print(f"| `{scheme}` | " + " | ".join("lost" if math.isinf(values[s]) else f"{values[s]:.1e}" for s in steps) + " |")


def energy_picture(rows, path):
    scenes = scenes_of(rows)
    figure, axes = pyplot.subplots(1, len(scenes), figsize=(5.0 * len(scenes), 3.5), layout="constrained", sharey=True)
    for axis, scene in zip(axes, scenes):
        for scheme in schemes_of(rows):
            points = [(float(r["w_c h"]), float(r["largest departure"])) for r in rows
                      if r["scene"] == scene and r["scheme"] == scheme and math.isfinite(float(r["largest departure"]))]
            axis.loglog(*zip(*points), marker="o", color=COLOURS[scheme], label=scheme)
        axis.minorticks_off()
        axis.set_title(scene)
        axis.set_xlabel("w_c h")
    axes[0].set_ylabel("largest departure of the energy")
    axes[0].legend(fontsize=7)
    figure.savefig(path)


def main():
    if len(sys.argv) not in (3, 4) or sys.argv[1] not in ("precision", "energy"):
        sys.exit(__doc__)
    table, picture = {"precision": (precision_table, precision_picture), "energy": (energy_table, energy_picture)}[sys.argv[1]]
    rows = read(sys.argv[2])
    table(rows)
    if len(sys.argv) == 4:
        picture(rows, sys.argv[3])


if __name__ == "__main__":
    main()
