# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the contacts: orbits in their obstacles, histories of force, and what wears along the tube."""

import math

import numpy as np

from drawing import Plot, unit_for

FREE = np.array([31, 95, 168])  # colour of the free flight
TOUCH = np.array([217, 95, 14])  # colour of the samples in contact
MICRO = 1e6
FAR = 20.0  # a gap so many times larger than the orbit is left out of the picture


def _window(run, contact):
    """Samples of the statistics window with finite positions; all samples where there are none in it."""
    inside = run.time >= run.window
    if inside.sum() < 2:
        inside = np.ones(len(run.time), bool)
    return inside & np.isfinite(contact.y) & np.isfinite(contact.z)


def _limits(contact, y, z):
    """Middle and half width of a square that shows the orbit and, unless it is far away, the obstacle (m)."""
    low = np.array([y.min(), z.min()])
    high = np.array([y.max(), z.max()])
    gap = float(contact.facts["gap"])
    extent = float((high - low).max())
    if gap <= FAR * max(extent, 1e-30) or extent == 0:
        wall = {"circle": (-1, 1, -1, 1), "plane_y": (-1, 1, 0, 0), "plane_z": (0, 0, -1, 1),
                "stop_y": (0, 1, 0, 0), "stop_z": (0, 0, 0, 1)}[contact.facts["obstacle"]]
        low = np.minimum(low, gap * np.array([wall[0], wall[2]]))
        high = np.maximum(high, gap * np.array([wall[1], wall[3]]))
    half = 0.56 * float((high - low).max()) or 1e-6
    return (low + high) / 2, half


def _density(plot, y, z, touching):
    """How long the node was at each pixel: dark where long; in the colour of contact where it touched."""
    width, height = (2 * int(length) for length in plot.inner)  # twice the size, for print
    px = 2 * (plot.px(y) - plot.left)
    py = 2 * (plot.py(z) - plot.top)
    longest = float(np.hypot(np.diff(px), np.diff(py)).max()) if len(px) > 1 else 0.0
    parts = int(np.clip(math.ceil(longest), 1, 24))
    share = np.arange(parts) / parts
    along_x = (px[:-1, None] + np.diff(px)[:, None] * share).ravel()
    along_y = (py[:-1, None] + np.diff(py)[:, None] * share).ravel()
    weight = np.repeat(touching[:-1] & touching[1:], parts)
    column, row = along_x.astype(int), along_y.astype(int)
    seen = (column >= 0) & (column < width) & (row >= 0) & (row < height)
    cell = row[seen] * width + column[seen]
    count = np.bincount(cell, minlength=width * height).astype(float)
    contact = np.bincount(cell, weights=weight[seen], minlength=width * height)
    top = np.quantile(count[count > 0], 0.98) if (count > 0).any() else 1.0
    strength = np.clip(np.log1p(count) / np.log1p(top), 0, 1)
    mix = np.divide(contact, count, out=np.zeros_like(count), where=count > 0)[:, None]
    pixels = np.zeros((width * height, 4), np.uint8)
    pixels[:, :3] = FREE * (1 - mix) + TOUCH * mix
    pixels[:, 3] = np.where(count > 0, 60 + 195 * strength, 0)
    plot.picture(pixels.reshape(height, width, 4))


def _obstacle(plot, contact):
    gap = MICRO * float(contact.facts["gap"])
    kind = contact.facts["obstacle"]
    if kind == "circle":
        centre = float(plot.px(0.0)), float(plot.py(0.0))
        radius = float(plot.px(gap)) - centre[0]
        plot.add(f'<circle class="wall" cx="{centre[0]:.1f}" cy="{centre[1]:.1f}" r="{radius:.1f}"/>')
        return
    upright = kind.endswith("y")
    for place, side in [(gap, 1)] + ([(-gap, -1)] if kind.startswith("plane") else []):
        beyond = side * 2e6 + place
        body = sorted((place, beyond))
        if upright:
            plot.rectangle(body, plot.y, "body")
            plot.line([place, place], plot.y, "wall")
        else:
            plot.rectangle(plot.x, body, "body")
            plot.line(plot.x, [place, place], "wall")


def orbit(run, contact, size=250, labels=True):
    inside = _window(run, contact)
    y, z = MICRO * contact.y[inside], MICRO * contact.z[inside]
    if len(y) == 0:
        return '<p class="none">no finite motion</p>'
    middle, half = _limits(contact, contact.y[inside], contact.z[inside])
    middle, half = MICRO * middle, MICRO * half
    margins = (46, 10, 10, 36) if labels else (34, 6, 6, 18)
    inner = size - margins[0] - margins[1]
    plot = Plot(
        (size, inner + margins[2] + margins[3]),
        (middle[0] - half, middle[0] + half),
        (middle[1] - half, middle[1] + half),
        margins,
    )
    plot.axes("y_loc [µm]" if labels else "", "z_loc [µm]" if labels else "", x_most=4, y_most=4)
    _obstacle(plot, contact)
    _density(plot, y, z, contact.normal[inside] > 0)
    return plot.svg(f"Orbit of {contact.name}")


def _force_axis(largest):
    factor, unit = unit_for(largest, "N")
    return factor, f"force [{unit}]"


def largest_impact(run, contact):
    """(first, last) sample of a stretch round the largest normal force of the statistics window (of the whole run where nothing
    touches in it); None where nothing touches at all."""
    normal = np.nan_to_num(contact.normal, nan=0.0, posinf=0.0, neginf=0.0)
    if len(normal) < 3 or normal.max() <= 0:
        return None
    counted = np.where(run.time >= run.window, normal, 0.0)
    peak = int((counted if counted.max() > 0 else normal).argmax())
    first, last = peak, peak
    while first > 0 and normal[first - 1] > 0:
        first -= 1
    while last + 1 < len(normal) and normal[last + 1] > 0:
        last += 1
    reach = min(max(12, 3 * (last - first + 1)), max(40, len(normal) // 10))
    return max(0, peak - reach), min(len(normal) - 1, peak + reach)


def history(run, contact, size=(410, 210)):
    normal = contact.normal
    zoom = largest_impact(run, contact)
    largest = float(np.nanmax(np.where(np.isfinite(normal), normal, np.nan))) if np.isfinite(normal).any() else 0.0
    factor, label = _force_axis(largest)
    plot = Plot(size, (0.0, float(run.time[-1])), (0.0, 1.08 * factor * largest or 1.0))
    plot.axes("time [s]", label, x_most=6, y_most=4)
    if run.window > 0:
        plot.rectangle((0.0, run.window), plot.y, "before")
    if zoom:
        plot.rectangle((run.time[zoom[0]], run.time[zoom[1]]), plot.y, "zoomed")
    plot.series(run.time, factor * normal, "force")
    return plot.svg(f"Normal force of {contact.name}")


def impact(run, contact, size=(262, 210)):
    zoom = largest_impact(run, contact)
    if not zoom:
        return '<p class="none">no contact at any output instant</p>'
    part = slice(zoom[0], zoom[1] + 1)
    time = 1e3 * (run.time[part] - run.time[zoom[0]])
    factor, label = _force_axis(float(np.nanmax(contact.normal[part])))
    plot = Plot(size, (0.0, float(time[-1])), (0.0, 1.08 * factor * float(np.nanmax(contact.normal[part]))))
    plot.axes(f"time after {run.time[zoom[0]]:.4f} s [ms]", label, x_most=4, y_most=4)
    plot.line(time, factor * contact.tangential[part], "friction")
    plot.line(time, factor * contact.normal[part], "force")
    return plot.svg(f"Largest impact of {contact.name}")


def along(run, values, name, unit, size=(480, 210)):
    """A value a contact, as stems against the abscissa or the contact's number."""
    measured = run.contacts[0].abscissa is not None
    x = [c.abscissa for c in run.contacts] if measured else list(range(1, len(run.contacts) + 1))
    finite = [v for v in values if v is not None and math.isfinite(v)]
    largest = max(finite, default=0.0)
    factor, scaled = unit_for(largest, unit) if unit in ("W",) else (1.0, unit)
    length = float(np.linalg.norm(run.nodes[run.lines[:, 1]] - run.nodes[run.lines[:, 0]], axis=1).sum())
    limits = (0.0, length) if measured else (0.4, len(x) + 0.6)
    plot = Plot(size, limits, (0.0, 1.1 * factor * largest or 1.0), (58, 12, 10, 38))
    few = [(i + 1, c.name) for i, c in enumerate(run.contacts)] if not measured and len(x) <= 6 else None
    plot.axes("abscissa along the tube [m]" if measured else ("" if few else "contact number"), f"{name} [{scaled}]", few)
    for place, value in zip(x, values):
        if value is not None and math.isfinite(value):
            plot.line([place, place], [0.0, factor * value], "stem")
            plot.dot(place, factor * value, "support", 3.5)
    return plot.svg(name)


def energy_bar(energy, size=(980, 44)):
    """One bar: where the input went; None where a share is negative or unknown."""
    kinds = ["stored", "modal_damping", "contact_damping", "friction"]
    parts = [energy[f"{kind}_J"] for kind in kinds]
    if None in parts or energy["input_J"] is None or min(parts) < -1e-6 * sum(map(abs, parts)):
        return None
    parts = [max(0.0, part) for part in parts]  # round-off of a term that is zero
    residual = energy["input_J"] - sum(parts)
    total = sum(parts) + abs(residual)
    if total <= 0:
        return None
    plot = Plot(size, (0.0, total), (0.0, 1.0), (2, 2, 2, 2))
    start = 0.0
    for kind, part in zip(kinds + ["residual"], parts + [abs(residual)]):
        plot.rectangle((start, start + part), (0.0, 1.0), "share " + kind)
        start += part
    return plot.svg("Energy balance")
