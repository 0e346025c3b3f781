# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of doc/contact.md from what contact_pictures computes: draw_contact.py <contact_pictures> <folder>."""

import json
import pathlib
import subprocess
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from fretwork.report import drawing  # noqa: E402

MM, UM = 1e3, 1e6
SIDE = 300  # px, of the square that shows an obstacle
ROUNDING = 1e-7  # of the range of a field: less than a picture shows, more than round-off
STRAIGHT = 0.05  # px: a point of a contour this near to the line through its neighbours is left out

# A white panel of its own: readable on white pages and dark ones. No variables: not every renderer knows them.
STYLE = """<style>
text { font: 11px "Inter", "Segoe UI", "Helvetica Neue", "DejaVu Sans", Arial, sans-serif; fill: #1c2733; }
.tick, .label, .note { fill: #5b6b7b; } .title { font-weight: 600; } .mid { text-anchor: middle; } .end { text-anchor: end; }
.panel { fill: #fff; stroke: #dfe5eb; } .grid { stroke: #edf0f4; fill: none; } .axis { stroke: #8e9baa; fill: none; }
polyline { fill: none; stroke-linejoin: round; }
.inside { fill: #fbe3d0; fill-rule: evenodd; } .zero { stroke: #1c2733; stroke-width: 2.6; }
.open { stroke: #8db4dc; } .pressed { stroke: #eba36c; } .arrow { stroke: #44566a; stroke-width: 1.1; fill: none; }
.a { stroke: #7aa6d6; stroke-width: 1.6; } .b { stroke: #1f5fa8; stroke-width: 1.6; } .c { stroke: #d95f0e; stroke-width: 1.6; }
.stick { stroke: #1f5fa8; stroke-width: 1.6; } .slip { stroke: #d95f0e; stroke-width: 1.6; }.spring { stroke: #6aa84f; }
.bound { stroke: #8e9baa; stroke-dasharray: 5 4; }
</style>"""


def contours(x, y, field, level):
    """Marching squares: the lines field = level as arrays of points. A crossing is named by its grid edge: (row, column, 0 along x or 1 along y)."""
    above = field > level - ROUNDING * np.ptp(field)  # a value on the level is above it, whatever its last bits
    links = {}

    def join(a, b):
        links.setdefault(a, []).append(b)
        links.setdefault(b, []).append(a)

    mixed = above[:-1, :-1] + 0 + above[:-1, 1:] + above[1:, :-1] + above[1:, 1:]
    for i, j in zip(*np.nonzero((mixed > 0) & (mixed < 4))):
        low, right, high, left = (i, j, 0), (i, j + 1, 1), (i + 1, j, 0), (i, j, 1)
        corners = above[i, j], above[i, j + 1], above[i + 1, j + 1], above[i + 1, j]
        crossed = [edge for k, edge in enumerate((low, right, high, left)) if corners[k] != corners[(k + 1) % 4]]
        if len(crossed) == 2:
            join(*crossed)
        elif (field[i : i + 2, j : j + 2].mean() > level) == corners[0]:  # a saddle: the first corner's side is whole
            join(low, right), join(high, left)
        else:
            join(low, left), join(high, right)

    def point(edge):
        i, j, along_y = edge
        k, m = (i + 1, j) if along_y else (i, j + 1)
        share = (level - field[i, j]) / (field[k, m] - field[i, j])
        return x[j] + share * (x[m] - x[j]), y[i] + share * (y[k] - y[i])

    lines = []
    left_over = dict.fromkeys(sorted(links, key=lambda edge: len(links[edge])))  # open lines from their ends, then closed ones
    while left_over:
        edge = next(iter(left_over))
        line = []
        while edge is not None:
            del left_over[edge]
            line.append(edge)
            edge = next((other for other in links[edge] if other in left_over), None)
        if len(line) > 2 and line[0] in links[line[-1]]:
            line.append(line[0])
        lines.append(np.array([point(edge) for edge in line]))
    return lines


def thinned(points):
    """Without the points that a straight line makes superfluous."""
    kept = [0]
    for i in range(1, len(points) - 1):
        chord = points[i + 1] - points[kept[-1]]
        between = points[kept[-1] + 1 : i + 1] - points[kept[-1]]
        off = np.abs(between[:, 0] * chord[1] - between[:, 1] * chord[0])
        if not np.all(off <= STRAIGHT * np.hypot(*chord)):
            kept.append(i)
    return points[[*kept, len(points) - 1]]


def finished(plot, title):
    plot.clip = "inside"  # the same name whatever was drawn before
    plot.text(plot.x[0], plot.y[1], title, "title", (0, 16 - plot.top))
    picture = plot.svg(title).replace("<svg ", '<svg xmlns="http://www.w3.org/2000/svg" ', 1)
    panel = f'<rect class="panel" x="0.5" y="0.5" width="{plot.width - 1}" height="{plot.height - 1}" rx="6"/>'
    head, body = picture.split(">", 1)
    return (head + ">" + STYLE + panel + body).replace("><", ">\n<") + "\n"


def obstacle(data):
    half = data["half_width"] * MM
    count = int(np.sqrt(len(data["gap"])))
    gap = np.array(data["gap"]).reshape(count, count) * MM
    at = np.linspace(-half, half, count)
    plot = drawing.Plot((SIDE + 64, SIDE + 80), (-half, half), (-half, half), (52, 12, 42, 38))
    plot.axes("y, mm", "z, mm", y_most=8, x_most=8)
    step = next(size for size in (0.05, 0.1, 0.2, 0.5, 1, 2, 5) if size >= 0.999 * half / 8)

    def traced(at, gap, level):
        """Contours in pixels, each as the points of an SVG line."""
        for line in contours(at, at, gap, level):
            pixels = thinned(np.column_stack((plot.px(line[:, 0]), plot.py(line[:, 1]))))
            yield " ".join(f"{a:.1f},{b:.1f}" for a, b in pixels)

    edged = np.pad(at, 1, mode="edge")  # a rim of free space closes what is shaded at the border of the picture
    rim = np.pad(gap, 1, constant_values=np.abs(gap).max())
    plot.add(f'<path class="inside" d="{"".join(f"M{points}Z" for points in traced(edged, rim, 0.0))}"/>')
    for k in sorted(range(round(gap.min() / step), round(gap.max() / step) + 1), key=lambda k: k == 0):  # 0 on top
        kind = "zero" if k == 0 else "open" if k > 0 else "pressed"
        for points in traced(at, gap, k * step):
            plot.add(f'<polyline class="{kind}" points="{points}"/>')
    shafts = ""
    for y, z, ny, nz in np.array(data["arrows"]).reshape(-1, 4):
        x0, y0, length = float(plot.px(y * MM)), float(plot.py(z * MM)), 7.0
        tip = np.array([x0 + length * ny, y0 - length * nz])
        wings = [tip - 4.0 * np.array([ny + s * 0.5 * nz, -nz + s * 0.5 * ny]) for s in (1, -1)]
        shafts += f"M{x0 - length * ny:.1f} {y0 + length * nz:.1f}L{tip[0]:.1f} {tip[1]:.1f}"
        shafts += f"M{wings[0][0]:.1f} {wings[0][1]:.1f}L{tip[0]:.1f} {tip[1]:.1f}L{wings[1][0]:.1f} {wings[1][1]:.1f}"
    plot.add(f'<path class="arrow" d="{shafts}"/>')
    plot.text(-half, half, f"gap every {step:g} mm, thick 0, shaded < 0; arrows n", "note", (0, 32 - plot.top))
    return finished(plot, data["title"])


def impacts(data):
    deepest = max(max(impact["penetration"]) for impact in data["impacts"]) * MM
    strongest = max(max(impact["force"]) for impact in data["impacts"])
    plot = drawing.Plot((420, 320), (0, 1.05 * deepest), (0, 1.08 * strongest), (52, 12, 26, 38))
    plot.axes("penetration p, mm", "normal force F_N, N")
    for k, (impact, kind) in enumerate(zip(data["impacts"], "abc")):
        plot.line(np.array(impact["penetration"]) * MM, impact["force"], kind)
        plot.line(np.array([0.04, 0.1]) * deepest, np.full(2, (1.0 - 0.07 * k) * strongest), kind)
        plot.text(0.12 * deepest, (1.0 - 0.07 * k) * strongest, f"{impact['speed']:g} m/s, e = {impact['restitution']:.2f}", shift=(0, 4))
    return finished(plot, data["title"])


def cycles(data):
    x, force, slides = np.array(data["displacement"]) * UM, np.array(data["force"]), np.array(data["slides"])
    reach, bound = 1.06 * np.abs(x).max(), data["static_bound"]
    plot = drawing.Plot((420, 320), (-reach, reach), (-1.3 * bound, 1.3 * bound), (52, 12, 26, 38))
    plot.axes("displacement, µm", "friction force, N", x_most=9, y_most=7)
    for value in sorted({data["dynamic_bound"], bound}):
        for side in (-1, 1):
            plot.line([-reach, reach], [side * value, side * value], "bound")
    plot.line(x, data["spring"], "spring")
    runs = np.concatenate(([0], np.nonzero(np.diff(slides))[0] + 1, [len(x)]))
    for first, end in zip(runs[:-1], runs[1:]):
        plot.line(x[first : end + 1], force[first : end + 1], "slip" if slides[first] else "stick")
    for k, kind in enumerate(("stick", "slip", "spring")):
        plot.line([(0.15 + 0.28 * k) * reach, (0.23 + 0.28 * k) * reach], [1.18 * bound] * 2, kind)
        plot.text((0.25 + 0.28 * k) * reach, 1.18 * bound, kind, shift=(0, 4))
    note = f"K_T = {data['stiffness'] / 1e6:g} N/µm, C_T = {data['damping']:g} N s/m, {data['frequency']:g} Hz, dashed: µ F_N"
    plot.text(-0.97 * reach, -1.18 * bound, note, shift=(0, 4))
    return finished(plot, data["title"])


def main(program, folder):
    data = json.loads(subprocess.run([program], check=True, capture_output=True).stdout)
    for kind, draw in (("obstacles", obstacle), ("impacts", impacts), ("cycles", cycles)):
        for name, numbers in data[kind].items():
            pathlib.Path(folder, name + ".svg").write_text(draw(numbers), encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
