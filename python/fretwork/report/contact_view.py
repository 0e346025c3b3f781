# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the contacts: orbits in their obstacles, histories of force, and what wears along the tube."""

import math

import numpy as np

from .drawing import Plot, tick_room, unit_for

FREE = np.array([31, 95, 168])  # colour of the free flight
TOUCH = np.array([217, 95, 14])  # colour of the samples in contact
MICRO = 1e6
BARS = 24  # of a histogram
MOST_NAMED = 30  # contacts whose names fit below an axis
SLIVER = 1e-6  # below this ratio the shorter side is round-off
SLIT = 0.25  # a picture of a flat obstacle with sides of a ratio below this has its own scale on each axis
FAR = 20.0  # a gap so many times larger than the orbit is left out of the picture


def in_window(run, contact):
    """Samples of the statistics window with finite positions; all samples where there are none in it."""
    inside = run.time >= run.window
    if inside.sum() < 2:
        inside = np.ones(len(run.time), bool)
    return inside & np.isfinite(contact.y) & np.isfinite(contact.z)


def planes_of(contact):
    """The faces of a plane obstacle: (place, side of the body); none for other obstacles."""
    kind, gap = contact.facts["obstacle"], float(contact.facts["gap"])
    if not kind.startswith(("plane", "stop", "bars")):
        return []
    if int(contact.facts["other"]) >= 0:  # the second node's face, on the other side of the gap
        at = float(contact.facts["rest"][1 if kind.endswith("y") else 2])
        return [(at - math.copysign(gap, at), -math.copysign(1, at))] if at else []
    return [(gap, 1)] + ([(-gap, -1)] if kind.startswith("plane") or _has_second_bar(contact) else [])


def _has_second_bar(contact):
    """Of one bar or two: with two the gap is less than in the middle on both sides."""
    place = contact.y if contact.facts["obstacle"].endswith("y") else contact.z
    if not contact.facts["obstacle"].startswith("bars") or not np.isfinite(place).any():
        return False
    lowest = int(np.nanargmin(place))
    return place[lowest] < 0 and contact.gap[lowest] < float(contact.facts["gap"])


def radius_of(contact):
    """Of a circle in or round which the node moves; None for other obstacles."""
    kind, gap = contact.facts["obstacle"], float(contact.facts["gap"])
    if not kind.startswith(("circle", "drilled")):
        return None
    if int(contact.facts["other"]) < 0:
        return gap
    apart = math.hypot(*contact.facts["rest"][1:])
    return apart - gap if kind == "circle" else apart + gap


def _walls(contact):
    """Points (n, 2) that a picture of the obstacle should show (m)."""
    if contact.outline is not None:
        return contact.outline
    radius = radius_of(contact)
    if radius is not None:
        return radius * np.array([[-1.0, -1.0], [1.0, 1.0]])
    upright = contact.facts["obstacle"].endswith("y")
    return np.array([[place, 0.0] if upright else [0.0, place] for place, _ in planes_of(contact)]).reshape(-1, 2)


def limits(contact, y, z):
    """Middle and half widths of a rectangle that shows the orbit and, unless it is far away, the obstacle (m): a square, but for a flat
    obstacle whose orbit would be a slit in it."""
    low = np.array([y.min(), z.min()])
    high = np.array([y.max(), z.max()])
    flat = bool(planes_of(contact))
    normal = (0 if contact.facts["obstacle"].endswith("y") else 1) if flat else None
    extent = float((high - low).max() if normal is None else (high - low)[normal])
    walls = _walls(contact)
    off = np.abs(walls - (low + high) / 2)
    if extent <= SLIVER * float((high - low).max()) or float((off if normal is None else off[:, normal]).max(initial=0.0)) <= FAR * extent:
        seen = slice(None) if normal is None else slice(normal, normal + 1)
        low[seen] = np.minimum(low[seen], walls.min(axis=0, initial=math.inf)[seen])
        high[seen] = np.maximum(high[seen], walls.max(axis=0, initial=-math.inf)[seen])
    span = high - low
    if not (flat and SLIVER * span.max() < span.min() < SLIT * span.max()):
        span[:] = span.max()
    half = 0.56 * np.where(span > 0, span, span.max()) if span.max() > 0 else np.full(2, 1e-6)
    return (low + high) / 2, half


def _density(plot, y, z, touching):
    """How long the node was at each pixel: dark where long; in the colour of contact where it touched."""
    width, height = (2 * int(length) for length in plot.inner)  # twice the size, for print
    px = 2 * (plot.px(y) - plot.left)
    py = 2 * (plot.py(z) - plot.top)
    parts = np.clip(np.ceil(np.hypot(np.diff(px), np.diff(py))), 1, 24).astype(int)  # of each line between two instants
    share = (np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)) / np.repeat(parts, parts)
    column = (np.repeat(px[:-1], parts) + np.repeat(np.diff(px), parts) * share).astype(int)
    row = (np.repeat(py[:-1], parts) + np.repeat(np.diff(py), parts) * share).astype(int)
    time = 1.0 / np.repeat(parts, parts)  # in intervals between instants
    touch = np.repeat(touching[:-1] & touching[1:], parts) * time
    seen = (column >= 0) & (column < width) & (row >= 0) & (row < height)
    cell = row[seen] * width + column[seen]
    count = np.bincount(cell, weights=time[seen], minlength=width * height)
    met = np.flatnonzero(count)
    count = count[met]
    contact = np.bincount(cell, weights=touch[seen], minlength=width * height)[met]
    top = float(np.quantile(count, 0.98)) if len(met) else 1.0
    strength = np.clip(np.log1p(24 * count) / np.log1p(24 * top), 0, 1)
    mix = (contact / count)[:, None]
    pixels = np.zeros((width * height, 4), np.uint8)
    pixels[met, :3] = FREE * (1 - mix) + TOUCH * mix
    pixels[met, 3] = 60 + 195 * strength
    plot.picture(pixels.reshape(height, width, 4))


def _obstacle(plot, contact):
    if contact.outline is not None:
        closed = MICRO * np.vstack((contact.outline, contact.outline[:1]))
        plot.line(closed[:, 0], closed[:, 1], "wall")
    radius = radius_of(contact)
    if radius is not None:
        centre = float(plot.px(0.0)), float(plot.py(0.0))
        radius = abs(float(plot.px(MICRO * radius)) - centre[0])  # of a square picture
        plot.add(f'<circle class="wall" cx="{centre[0]:.1f}" cy="{centre[1]:.1f}" r="{radius:.1f}"/>')
    upright = contact.facts["obstacle"].endswith("y")
    for place, side in planes_of(contact):
        place *= MICRO
        beyond = side * 2e6 + place
        body = sorted((place, beyond))
        if upright:
            plot.rectangle(body, plot.y, "body")
            plot.line([place, place], plot.y, "wall")
        else:
            plot.rectangle(plot.x, body, "body")
            plot.line(plot.x, [place, place], "wall")


def orbit(run, contact, size=250, labels=True):
    inside = in_window(run, contact)
    y, z = MICRO * contact.y[inside], MICRO * contact.z[inside]
    if len(y) == 0:
        return '<p class="none">no finite motion</p>'
    middle, half = limits(contact, contact.y[inside], contact.z[inside])
    middle, half = MICRO * middle, MICRO * half
    x, upright = zip(middle - half, middle + half)
    left = math.ceil(tick_room(upright, 4)) + 7
    margins = (max(46, left + 13), 10, 10, 36) if labels else (max(34, left), 6, 6, 18)
    inner = size - margins[0] - margins[1]
    plot = Plot((size, inner + margins[2] + margins[3]), x, upright, margins)
    plot.axes("y_loc [µm]" if labels else "", "z_loc [µm]" if labels else "", x_most=4, y_most=4)
    _obstacle(plot, contact)
    _density(plot, y, z, contact.normal[inside] > 0)
    return plot.svg(f"Orbit of {contact.name}")


def _force_axis(largest):
    factor, unit = unit_for(largest, "N")
    return factor, f"force [{unit}]"


def _about_peak(normal, counted):
    """(first, last) index of a stretch about the largest value of `counted`: the interval of force there, and thrice its length on both sides."""
    peak = int(counted.argmax())
    first, last = peak, peak
    while first > 0 and normal[first - 1] > 0:
        first -= 1
    while last + 1 < len(normal) and normal[last + 1] > 0:
        last += 1
    reach = min(max(12, 3 * (last - first + 1)), max(40, len(normal) // 10))
    return max(0, peak - reach), min(len(normal) - 1, peak + reach)


def largest_impact(run, contact):
    """Time (s), normal and tangential force (N) about the largest normal force: at every step of the statistics window, or within steps, where the run kept
    them, else at the output instants (of the whole run where nothing touches in the window). None where nothing touches at all."""
    if contact.largest is not None:
        time, normal, tangential = (contact.largest[name] for name in ("time", "normal_force", "tangential_force"))
        counted = normal
    else:
        normal = np.nan_to_num(contact.normal, nan=0.0, posinf=0.0, neginf=0.0)
        time, tangential = run.time, contact.tangential
        counted = np.where(run.time >= run.window, normal, 0.0)
        counted = counted if len(counted) and counted.max() > 0 else normal
    if len(normal) < 3 or normal.max() <= 0:
        return None
    first, last = _about_peak(normal, counted)
    return time[first:last + 1], normal[first:last + 1], tangential[first:last + 1]


def history(run, contact, size=(410, 210)):
    normal = contact.normal
    zoom = largest_impact(run, contact)
    largest = float(np.nanmax(np.where(np.isfinite(normal), normal, np.nan))) if np.isfinite(normal).any() else 0.0
    if zoom:
        largest = max(largest, float(np.nanmax(zoom[1])))
    factor, label = _force_axis(largest)
    plot = Plot(size, (0.0, float(run.time[-1])), (0.0, 1.08 * factor * largest or 1.0))
    plot.axes("time [s]", label, x_most=6, y_most=4)
    if run.window > 0:
        plot.rectangle((0.0, run.window), plot.y, "before")
    if zoom:
        plot.rectangle((zoom[0][0], zoom[0][-1]), plot.y, "zoomed")
    plot.series(run.time, factor * normal, "force")
    if contact.largest is not None and zoom:  # between the output instants too
        plot.line(zoom[0], factor * zoom[1], "force")
    return plot.svg(f"Normal force of {contact.name}")


def impact(run, contact, size=(262, 210)):
    zoom = largest_impact(run, contact)
    if not zoom:
        return '<p class="none">no contact at any output instant</p>'
    time, normal, tangential = zoom
    largest = float(np.nanmax(normal))
    factor, label = _force_axis(largest)
    plot = Plot(size, (0.0, 1e3 * float(time[-1] - time[0])), (0.0, 1.08 * factor * largest))
    plot.axes(f"time after {time[0]:.4f} s [ms]", label, x_most=4, y_most=4)
    plot.line(1e3 * (time - time[0]), factor * tangential, "friction")
    plot.line(1e3 * (time - time[0]), factor * normal, "force")
    return plot.svg(f"Largest impact of {contact.name}")


def histogram(values, name, unit, size=(320, 180)):
    """How many impacts had a value in each of equal intervals from 0 to the largest."""
    values = values[np.isfinite(values)]
    factor, scaled = unit_for(float(values.max(initial=0.0)), unit)
    top = factor * float(values.max(initial=0.0)) or 1.0
    count, edges = np.histogram(np.clip(factor * values, 0.0, top), bins=BARS, range=(0.0, top))
    plot = Plot(size, (0.0, top), (0.0, 1.08 * count.max() or 1.0))
    plot.axes(f"{name} [{scaled}]", "impacts", x_most=5, y_most=4)
    for first, last, height in zip(edges[:-1], edges[1:], count):
        plot.rectangle((first, last), (0.0, height), "bar")
    return plot.svg(name)


def along(run, values, name, unit, errors=None, size=(480, 210)):
    """A value a contact, as stems against the abscissa or the contact's number, with bars of two standard errors to each side."""
    measured = run.contacts[0].abscissa is not None
    x = [c.abscissa for c in run.contacts] if measured else list(range(1, len(run.contacts) + 1))
    finite = [v for v in values if v is not None and math.isfinite(v)]
    bars = [2 * e if e is not None and math.isfinite(e) else 0.0 for e in errors or [None] * len(values)]
    largest = max((v + b for v, b in zip(values, bars) if v is not None and math.isfinite(v)), default=0.0) if finite else 0.0
    factor, scaled = unit_for(largest, unit) if unit in ("W",) else (1.0, unit)
    length = float(np.linalg.norm(run.nodes[run.lines[:, 1]] - run.nodes[run.lines[:, 0]], axis=1).sum())
    limits = (0.0, length) if measured else (0.4, len(x) + 0.6)
    plot = Plot(size, limits, (0.0, 1.1 * factor * largest or 1.0), (58, 12, 10, 38))
    few = [(i + 1, c.name) for i, c in enumerate(run.contacts)] if not measured and len(x) <= MOST_NAMED else None
    plot.axes("abscissa along the tube [m]" if measured else ("" if few else "contact number"), f"{name} [{scaled}]", few)
    for place, value, bar in zip(x, values, bars):
        if value is not None and math.isfinite(value):
            plot.line([place, place], [0.0, factor * value], "stem")
            if bar > 0:
                plot.line([place, place], [factor * (value - bar), factor * (value + bar)], "errors")
            plot.dot(place, factor * value, "support", 3.5)
    return plot.svg(name)


def energy_bar(energy, size=(980, 44)):
    """One bar: where the input went; None where a share is negative or unknown."""
    kinds = ["stored", "modal_damping", "contact_damping", "friction"]
    parts = [energy[f"{kind}_J"] for kind in kinds]
    if None in parts or energy["input_J"] is None or min(parts) < -1e-6 * sum(map(abs, parts)):
        return None
    parts = [max(0.0, part) for part in parts]  # round-off of a term that is zero
    residual = energy["input_J"] + energy.get("fluid_J", 0.0) - sum(parts)
    total = sum(parts) + abs(residual)
    if total <= 0:
        return None
    plot = Plot(size, (0.0, total), (0.0, 1.0), (2, 2, 2, 2))
    start = 0.0
    for kind, part in zip(kinds + ["residual"], parts + [abs(residual)]):
        plot.rectangle((start, start + part), (0.0, 1.0), "share " + kind)
        start += part
    return plot.svg("Energy balance")
