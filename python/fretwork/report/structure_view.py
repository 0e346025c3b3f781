# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the structure and of its modes."""

import math

import numpy as np

from .drawing import Plot

AMPLITUDE = 0.08  # largest displacement of a drawn mode, as a share of the structure's size
FLAT = 0.02  # a direction shorter than this share of the longest is not worth a view in depth
AXES = "xyz"


class View:
    """A projection: along a global axis where the points lie (nearly) in its plane, else in depth."""

    def __init__(self, points):
        extent = np.ptp(points, axis=0) if len(points) else np.ones(3)
        thin = int(np.argmin(extent))
        if extent[thin] <= FLAT * extent.max():
            flat = [axis for axis in range(3) if axis != thin]
            # the longest direction lies across the page, unless z can stand upright at a good size
            if flat[1] != 2 or extent[2] < 0.3 * extent[flat[0]]:
                flat.sort(key=lambda axis: -extent[axis])
            if extent[flat[0]] == 0:
                flat = flat[::-1]
            self.matrix = np.eye(3)[flat]
            self.name = f"{AXES[flat[0]]}–{AXES[flat[1]]} plane"
        else:
            turn, tilt = math.radians(-35), math.radians(25)
            c, s = math.cos(turn), math.sin(turn)
            self.matrix = np.array([[c, s, 0], [-s * math.sin(tilt), c * math.sin(tilt), math.cos(tilt)]])
            self.name = "in depth"

    def __call__(self, points):
        return np.asarray(points) @ self.matrix.T


def _plot(flat_points, width, heights):
    """Equal scales, margins round the points, a height that suits them."""
    low, high = flat_points.min(axis=0), flat_points.max(axis=0)
    extent = float((high - low).max()) or 1.0
    flat = high[0] - low[0] >= high[1] - low[1]
    span = np.maximum(high - low, [extent if flat else 1e-9 * extent, 1e-9 * extent])
    margins = (14, 14, 22, 14)
    inner = width - 28
    height = float(np.clip(inner * span[1] / span[0], *heights))
    scale = min(inner / span[0], height / span[1]) * 0.94
    middle = (low + high) / 2
    half = np.array([inner, height]) / scale / 2
    return Plot(
        (width, int(height) + 36),
        (middle[0] - half[0], middle[0] + half[0]),
        (middle[1] - half[1], middle[1] + half[1]),
        margins,
    )


def _segments(plot, flat_points, lines, kind):
    a, b = flat_points[lines[:, 0]], flat_points[lines[:, 1]]
    x0, y0, x1, y1 = plot.px(a[:, 0]), plot.py(a[:, 1]), plot.px(b[:, 0]), plot.py(b[:, 1])
    path = []
    pen = None
    for line, p, q, r, s in zip(lines, x0, y0, x1, y1):
        path.append(f"L{r:.1f} {s:.1f}" if pen == line[0] else f"M{p:.1f} {q:.1f}L{r:.1f} {s:.1f}")
        pen = line[1]
    plot.add(f'<path class="{kind}" d="{"".join(path)}"/>')


def _beside(run, view, middle, contact):
    """The side of a support on which its name stands: "left" or "right", outwards, where the beam goes up; else None."""
    node = int(contact.facts["node"])
    at_node = run.lines[(run.lines == node).any(axis=1)]
    if not len(at_node):
        return None
    along = np.abs(view(run.nodes[at_node[:, 1]] - run.nodes[at_node[:, 0]])).sum(axis=0)
    if along[1] <= along[0]:
        return None
    return "left" if view(contact.position)[0] < middle[0] else "right"


_PLACES = {"above": ("note mid", (0, -9)), "below": ("note mid", (0, 17)), "left": ("note end", (-9, 4)), "right": ("note", (9, 4))}
_LETTER, _LINE = 6.5, 11  # px: widest mean letter and height of a line of a name


def _box(spot, name, place):
    """Left, top, right and bottom (px) of a name at a place beside a spot."""
    kind, (right, down) = _PLACES[place]
    width = _LETTER * len(name)
    left = spot[0] + right - (width if kind.endswith("end") else width / 2 if kind.endswith("mid") else 0)
    return left, spot[1] + down - _LINE + 2, left + width, spot[1] + down + 2


def _overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def _supports(contacts):
    """Contacts of one support (points of its thickness, name@k) as one: name and contacts, in their order."""
    found: dict[str, list] = {}
    for contact in contacts:
        found.setdefault(contact.name.split("@")[0], []).append(contact)
    return found.items()


def _name_supports(plot, supports, drawn=np.empty((0, 2))):
    """A dot and a name each: at the side asked for or another where it touches no other name and covers least of the points that are drawn.
    Names for which there is no room, which are left out."""
    drawn = np.column_stack((plot.px(drawn[:, 0]), plot.py(drawn[:, 1])))
    written: list[tuple] = []
    left_out: list[str] = []
    for name, places, side in supports:
        for at in places:
            plot.dot(at[0], at[1], "support", 4)
        at = np.mean(places, axis=0)
        spot = float(plot.px(at[0])), float(plot.py(at[1]))
        free = []
        for place in {"left": ["left", "right", "above", "below"], "right": ["right", "left", "above", "below"]}.get(side, list(_PLACES)):
            box = _box(spot, name, place)
            inside = box[0] >= 0 and box[2] <= plot.width and box[1] >= 0 and box[3] <= plot.height
            if inside and not any(_overlap(box, other) for other in written):
                covered = ((drawn >= box[:2]) & (drawn <= box[2:])).all(axis=1).sum()
                free.append((covered, place, box))
        if free:
            _, place, box = min(free, key=lambda found: found[0])
            plot.text(at[0], at[1], name, *_PLACES[place])
            written.append(box)
        else:
            left_out.append(name)
    return left_out


def structure(run, width=980):
    """The mesh with its supports, how it is looked at, and the names for which there was no room."""
    view = View(run.nodes)
    points = view(run.nodes)
    plot = _plot(points, width, (70, 420))
    _segments(plot, points, run.lines, "beam")
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    supports = [(name, [view(c.position) for c in points], _beside(run, view, middle, points[0])) for name, points in _supports(run.contacts)]
    along = np.linspace(0.0, 1.0, 9)[:, None, None]  # of each line
    drawn = ((1 - along) * points[run.lines[:, 0]] + along * points[run.lines[:, 1]]).reshape(-1, 2)
    left_out = _name_supports(plot, supports, drawn)
    return plot.svg("The structure and its supports"), view.name, left_out


def shares(mode):
    """Share of each global direction in the translations of a mode; None where it only turns."""
    squares = (mode.displacement**2).sum(axis=0)
    turning = float((mode.rotation**2).sum())
    if squares.sum() <= 1e-12 * turning or squares.sum() == 0:
        return None
    return squares / squares.sum()


def direction(mode):
    found = shares(mode)
    if found is None:
        return "turning only"
    order = np.argsort(-found)
    return ", ".join(f"{AXES[i]} {100 * found[i]:.0f} %" for i in order if found[i] >= 0.05)


def mode_picture(run, mode, width=310):
    size = float(np.ptp(run.nodes[mode.nodes], axis=0).max()) if len(mode.nodes) else 1.0
    largest = float(np.linalg.norm(mode.displacement, axis=1).max())
    moved = run.nodes.copy()
    if shares(mode) is not None:
        moved[mode.nodes] += mode.displacement * (AMPLITUDE * (size or 1.0) / largest)
    both = np.vstack((run.nodes, moved))
    mirrored = np.vstack((both, 2 * run.nodes - moved))
    view = View(mirrored)
    plot = _plot(view(mirrored), width, (60, 190))
    own = np.isin(run.lines[:, 0], mode.nodes)
    _segments(plot, view(run.nodes), run.lines, "rest")
    if own.any():
        _segments(plot, view(moved), run.lines[own], "moved")
    else:
        for node in mode.nodes:
            at = view(moved[node])
            plot.dot(at[0], at[1], "support")
    return plot.svg(f"Mode at {mode.frequency:.4g} Hz"), view.name
