# SPDX-License-Identifier: GPL-3.0-or-later
"""The data of interactive pictures, as JSON in the page; page.js draws them. Each goes with a static picture, which is what is printed."""

import base64
import json
import tomllib

import numpy as np

from . import contact_view
from .structure_view import View, shares

BUCKETS = 3000  # of a history: the least and the largest value of each
PATH = 5000  # output instants of an orbit
DOTS = 3000  # samples in contact of an orbit
MODES = 12  # shapes in the 3D view
MOST_MARKS = 40  # arrows of one load, blocks of one restraint
MICRO = 1e6
BLUE, ORANGE, BLACK, GREY = "#1f5fa8", "#d95f0e", "#1c2733", "#8e9baa"


def script(data):
    """A data block that no text of the results can end or turn into markup."""
    text = json.dumps(data, ensure_ascii=True, allow_nan=False)
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return f'<script class="live" type="application/json">{text}</script>'


def figure(static, data, caption=""):
    """A static picture and, where there is data, its interactive form."""
    live = script(data) if data else ""
    note = f"<figcaption>{caption}</figcaption>" if caption else ""
    return f'<figure><div class="static">{static}</div>{live}{note}</figure>'


def floats(values):
    return base64.b64encode(np.asarray(values, "<f4").tobytes()).decode()


def least_and_largest(values, buckets=BUCKETS):
    """A series of at most 2 `buckets` values: the least and the largest of each bucket, in their order in time. Values that are not finite are
    left out of their bucket. Returns the values and the number of samples that one of them stands for."""
    values = np.asarray(values, float)
    length = -(-len(values) // buckets)
    if length <= 2:
        return values, 1.0
    padded = np.full(-(-len(values) // length) * length, np.nan)
    padded[: len(values)] = values
    rows = padded.reshape(-1, length)
    finite = np.isfinite(rows)
    low, high = np.where(finite, rows, np.inf), np.where(finite, rows, -np.inf)
    first, last = low.argmin(axis=1), high.argmax(axis=1)
    pair = np.column_stack((low.min(axis=1), high.max(axis=1)))
    pair[first > last] = pair[first > last][:, ::-1]
    pair[~finite.any(axis=1)] = np.nan
    return pair.ravel(), length / 2


def _series(name, colour, values, **more):
    return {"name": name, "colour": colour, "values": floats(values), **more}


def history(time, columns, ylabel):
    """Series against time that share their instants. @param columns  (name, colour, values) each"""
    if len(time) < 2:
        return None
    reduced = [(name, colour, *least_and_largest(values)) for name, colour, values in columns]
    step = float(time[-1] - time[0]) / (len(time) - 1) * reduced[0][3]
    x = {"start": float(time[0]), "step": step, "count": len(reduced[0][2])}
    return {"kind": "lines", "x": x, "xlabel": "time [s]", "ylabel": ylabel, "series": [_series(name, colour, v) for name, colour, v, _ in reduced]}


def force(run, contact):
    """Normal and tangential force at the output instants; the peak of the largest impact, which may lie between them, is kept."""
    normal = np.array(contact.normal)
    if contact.largest is not None and len(contact.largest["time"]):
        peak = int(np.argmax(contact.largest["normal_force"]))
        at = min(len(normal) - 1, int(np.searchsorted(run.time, contact.largest["time"][peak])))
        normal[at] = max(normal[at], float(contact.largest["normal_force"][peak]))
    return history(run.time, [("normal", BLUE, normal), ("tangential", ORANGE, contact.tangential)], "force [N]")


def impact(run, contact):
    zoom = contact_view.largest_impact(run, contact)
    if not zoom:
        return None
    time, normal, tangential = zoom
    return {"kind": "lines", "x": floats(1e3 * (time - time[0])), "xlabel": f"time after {time[0]:.4f} s [ms]", "ylabel": "force [N]",
            "series": [_series("normal", BLUE, normal, width=1.5), _series("tangential", ORANGE, tangential, width=1.5)]}


def node(run, observed):
    moved = MICRO * np.asarray(observed.displacement, float)
    return history(run.time, [(axis, colour, moved[:, i]) for i, (axis, colour) in enumerate(zip("xyz", (BLUE, ORANGE, BLACK)))], "displacement [µm]")


def _outline(contact, middle, half):
    """The obstacle as polylines, µm, with NaN between them."""
    if contact.outline is not None:
        return MICRO * np.vstack((contact.outline, contact.outline[:1]))
    radius = contact_view.radius_of(contact)
    if radius is not None:
        angle = np.linspace(0.0, 2 * np.pi, 181)
        return MICRO * abs(radius) * np.column_stack((np.cos(angle), np.sin(angle)))
    upright = contact.facts["obstacle"].endswith("y")
    parts = []
    for place, _ in contact_view.planes_of(contact):
        axis = 1 if upright else 0
        along = middle[axis] + 3 * half[axis] * np.array([-1.0, 1.0])
        across = np.full(2, MICRO * place)
        parts.append(np.column_stack((across, along) if upright else (along, across)))
        parts.append(np.full((1, 2), np.nan))
    return np.vstack(parts) if parts else np.zeros((0, 2))


def orbit(run, contact):
    """The last output instants as a path, instants in contact as dots, and the obstacle's reach."""
    inside = contact_view.in_window(run, contact)
    y, z = MICRO * contact.y[inside], MICRO * contact.z[inside]
    if len(y) < 2:
        return None
    middle, half = (MICRO * v for v in contact_view.limits(contact, contact.y[inside], contact.z[inside]))
    touching = np.flatnonzero(contact.normal[inside] > 0)
    if len(touching) > DOTS:
        touching = touching[np.linspace(0, len(touching) - 1, DOTS).astype(int)]
    outline = _outline(contact, middle, half)
    paths = [("path", GREY, y[-PATH:], z[-PATH:], {"width": 0.6}), ("in contact", ORANGE, y[touching], z[touching], {"dots": True}),
             ("obstacle", BLACK, *outline.T, {"width": 1.5})]
    series = [{"name": name, "colour": colour, "x": floats(a), "y": floats(b), **more} for name, colour, a, b, more in paths]
    return {"kind": "orbit", "xlabel": "y_loc [µm]", "ylabel": "z_loc [µm]", "series": series,
            "x": [float(middle[0] - half[0]), float(middle[0] + half[0])], "y": [float(middle[1] - half[1]), float(middle[1] + half[1])]}


def spectrum(one):
    keep = (one.frequency > 0) & (one.density > 0)
    if keep.sum() < 2:
        return None
    low, high = np.maximum(one.low[keep], 1e-30), np.maximum(one.high[keep], 1e-30)
    series = [_series("density", BLUE, one.density[keep], width=1.3), _series("low 95 %", "#9dbce0", low, width=0.5), _series("high 95 %", "#9dbce0", high, width=0.5)]
    return {"kind": "lines", "log": True, "x": floats(one.frequency[keep]), "xlabel": "frequency [Hz]", "ylabel": one.unit.replace("2", "²"), "series": series,
            "bands": [[2, 1, "rgba(31,95,168,0.15)"]]}


def _marks(run, key):
    """(entry, nodes) of the entries of a list of the study that name a group of the mesh."""
    try:
        entries = tomllib.loads(run.attributes["study"]).get(key, [])
    except (tomllib.TOMLDecodeError, AttributeError):
        return []
    found = []
    for entry in entries if isinstance(entries, list) else []:
        nodes = run.groups.get(entry.get("group")) if isinstance(entry, dict) else None
        if nodes is not None and len(nodes):
            few = nodes[np.unique(np.linspace(0, len(nodes) - 1, min(MOST_MARKS, len(nodes))).astype(int))]
            found.append((entry, few))
    return found


def _direction(entry):
    direction = entry.get("direction")
    vector = np.asarray(direction, float) if isinstance(direction, list) and len(direction) == 3 else None
    return vector.tolist() if vector is not None and np.linalg.norm(vector) > 0 else None


def _loads(run):
    arrows = []
    for entry, nodes in _marks(run, "loads"):
        try:
            direction = _direction(entry)
        except (TypeError, ValueError):
            direction = None
        if direction:
            few = nodes if len(nodes) <= 5 else nodes[np.linspace(0, len(nodes) - 1, 5).astype(int)]
            arrows += [{"at": run.nodes[n].tolist(), "direction": direction} for n in few]
    return arrows


def scene(run):
    """The structure in 3D with supports, restraints and loads, and its first modes."""
    if not len(run.lines):
        return None
    modes = []
    for number, mode in enumerate(run.modes[:MODES], 1):
        if shares(mode) is None:
            continue
        shape = np.zeros_like(run.nodes)
        shape[mode.nodes] = mode.displacement / np.linalg.norm(mode.displacement, axis=1).max()
        modes.append({"name": f"mode {number}, {mode.frequency:.4g} Hz", "shape": floats(shape)})
    contacts = [{"name": c.name, "at": np.asarray(c.position, float).tolist(), "axis": np.asarray(c.facts["axes"], float)[0].tolist()} for c in run.contacts]
    restraints = [run.nodes[n].tolist() for _, nodes in _marks(run, "restraints") for n in nodes]
    across = View(run.nodes).matrix
    eye = np.cross(across[0], across[1]) if len(across) == 2 else np.array([-0.5, -1.0, 0.5])
    eye = eye / np.linalg.norm(eye) + 0.35 * np.array([0.6, -0.5, 0.6])
    return {"kind": "scene", "height": 460, "nodes": floats(run.nodes), "lines": run.lines.ravel().tolist(), "contacts": contacts, "restraints": restraints,
            "loads": _loads(run), "modes": modes, "eye": eye.tolist()}
