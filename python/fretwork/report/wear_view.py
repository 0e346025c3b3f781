# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of wear: depth against time, work by angle, the scar in the wall, what is worn along the tube."""

import math

import numpy as np

from .drawing import Plot

MILLI = 1e3
YEAR = 31536000.0  # s


def first_life(support):
    """Years (value, low, high) of what reaches its limit first, "tube" or "support", and which; the value is no number where neither has a figure."""
    own = support.get("support_life_years", np.full(3, math.nan))
    tube = support["life_years"]
    if math.isnan(tube[0]) or own[0] < tube[0]:
        return (own, "support") if not math.isnan(own[0]) else (tube, "tube")
    return tube, "tube"


def _area(plot, x, y, kind):
    """A closed region; points that are no numbers are left out."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    keep = np.isfinite(x) & np.isfinite(y)
    if keep.sum() < 3:
        return
    points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(plot.px(x[keep]), plot.py(y[keep])))
    plot.add(f'<path class="{kind}" d="M{points}Z"/>')


def _largest(*values):
    finite = [float(v[np.isfinite(v)].max()) for v in map(np.atleast_1d, values) if np.isfinite(v).any()]
    return max(finite, default=0.0)


def depth_history(support, size=(330, 220)):
    """Depth of the tube against time, its interval as a band, the limit as a broken line."""
    years = support["time"] / YEAR
    value, low, high = MILLI * support["depth"].T
    limit = MILLI * support["limit"]
    top = 1.08 * _largest(value, high, limit) or 1.0
    plot = Plot(size, (0.0, float(years[-1])), (0.0, top))
    plot.axes("years", "depth [mm]", x_most=5, y_most=4)
    _area(plot, np.concatenate((years, years[::-1])), np.concatenate((low, high[::-1])), "band")
    plot.line(years, [limit] * len(years), "limit")
    plot.line(years, value, "moved")
    if np.any(support["support_depth"][:, 0] > 0):
        plot.line(years, MILLI * support["support_depth"][:, 0], "friction")
    if MILLI * support["support_limit"] <= top:  # not where there is none
        plot.line(years, [MILLI * support["support_limit"]] * len(years), "limit")
    return plot.svg(f"Depth of wear of {support['name']}")


def contact_angles(contact, window):
    """Angles (rad) of the contact point at the output instants with a normal force: opposite to the normal of the contact."""
    touching = window & (np.nan_to_num(contact.normal) > 0) & np.isfinite(contact.y) & np.isfinite(contact.z)
    y, z = contact.y[touching], contact.z[touching]
    kind = contact.facts["obstacle"]
    if kind.startswith(("plane", "stop", "bars")):
        zero = np.zeros_like(y)
        y, z = (y, zero) if kind.endswith("y") else (zero, z)
    if kind == "circle" and int(contact.facts["other"]) >= 0:  # side by side: towards the second body
        y, z = -y, -z
    angles = np.arctan2(z, y)
    return np.where(angles >= math.pi, -math.pi, angles)  # the half turn, which planes have: in the first sector, as the work


def _rose(plot, shares, kind, outline=False):
    """Sectors from -180 degrees on, their areas as the shares."""
    n = len(shares)
    for k, share in enumerate(shares):
        if not (math.isfinite(share) and share > 0):
            continue
        begin, end = math.pi * (2 * k / n - 1), math.pi * (2 * (k + 1) / n - 1)
        arc = np.linspace(begin, end, max(2, int(72 / n) + 2))
        radius = math.sqrt(share)
        x, y = radius * np.cos(arc), radius * np.sin(arc)
        if outline:
            plot.line(x, y, kind)
        else:
            _area(plot, np.append(x, 0.0), np.append(y, 0.0), kind)


def polar(support, angles, size=230):
    """Work by sector (filled) and time in contact by angle (outline): areas in proportion, the largest sector of each to the rim."""
    work = np.asarray(support["sector_work_rate"], float)
    plot = Plot((size, size), (-1.3, 1.3), (-1.3, 1.3), (4, 4, 4, 4))
    centre, rim = (float(plot.px(0.0)), float(plot.py(0.0))), float(plot.px(1.0) - plot.px(0.0))
    for radius in (rim / 2, rim):
        plot.add(f'<circle class="grid" cx="{centre[0]:.1f}" cy="{centre[1]:.1f}" r="{radius:.1f}"/>')
    plot.line([-1.05, 1.05], [0, 0], "grid")
    plot.line([0, 0], [-1.05, 1.05], "grid")
    if work.size and np.isfinite(work).all() and work.max() > 0:
        _rose(plot, work / work.max(), "rose")
    count = np.histogram(angles, bins=len(work) or 36, range=(-math.pi, math.pi))[0] if len(angles) else np.zeros(1)
    if count.max() > 0:
        _rose(plot, count / count.max(), "friction", outline=True)
    plot.text(1.08, 0.0, "y", "tick", (2, 4))
    plot.text(0.0, 1.08, "z", "tick mid", (0, -2))
    return plot.svg(f"Work by angle of {support['name']}")


def _worn_surface(support, x, depth):
    """Height of the worn surface over the tube's axis where the tube has none of its own left; None for a geometry without a picture."""
    radius, kind = support["radius"], support["geometry"]
    if kind == "flat_bar":
        return np.full_like(x, radius - depth)
    if kind == "ring":
        return np.sqrt(np.clip((radius - depth) ** 2 - x**2, 0, None))
    if kind in ("drilled_hole", "lands"):
        clearance = support["clearance"]
        hole = radius + clearance
        return np.sqrt(np.clip(hole**2 - x**2, 0, None)) - clearance - depth
    return None


def scar(support, width=330):
    """The wall of the tube in its cross-section at the scar, at true scale, with what is worn off after the years asked for."""
    depth = float(support["depth"][-1, 0])
    radius, wall, across = support["radius"], support["wall"], support["scar_width"]
    if not math.isfinite(depth) or not math.isfinite(across) or depth <= 0:
        return '<p class="none">no scar</p>'
    half = min(0.98 * radius, max(0.75 * across, 2.5 * wall))
    x = np.linspace(-half, half, 241)
    outer, inner = np.sqrt(radius**2 - x**2), np.sqrt(np.clip((radius - wall) ** 2 - x**2, 0, None))
    worn = _worn_surface(support, x, depth)
    if worn is None:
        return '<p class="none">no picture of this geometry</p>'
    low, high = float(inner[np.abs(x) < 0.8 * half].min()) - 0.15 * wall, radius + 0.25 * wall
    margins = (46, 8, 8, 36)
    inside = width - margins[0] - margins[1]
    height = int(np.clip(inside * (high - low) / (2 * half), 60, 260))
    plot = Plot((width, height + margins[2] + margins[3]), (-MILLI * half, MILLI * half), (MILLI * (low - radius), MILLI * (high - radius)), margins)
    plot.axes("across the tube [mm]", "height [mm]", x_most=5, y_most=4)
    left = np.minimum(outer, worn)
    _area(plot, MILLI * np.concatenate((x, x[::-1])), MILLI * (np.concatenate((left, inner[::-1])) - radius), "tube")
    gone = worn < outer
    if gone.any():
        _area(plot, MILLI * np.concatenate((x[gone], x[gone][::-1])), MILLI * (np.concatenate((outer[gone], worn[gone][::-1])) - radius), "worn")
    return plot.svg(f"Scar of {support['name']}")


def along(supports, places, field, factor, label, size=(480, 210)):
    """The last value of a curve for each support as a stem with its interval, against the abscissa or the number of the support."""
    measured = all(place is not None for place in places)
    x = places if measured else list(range(1, len(supports) + 1))
    values = [factor * support[field][-1] for support in supports]
    top = 1.1 * _largest(*values) or 1.0
    limits = (min(0.0, min(x)), 1.03 * max(x) or 1.0) if measured else (0.4, len(x) + 0.6)
    plot = Plot(size, limits, (0.0, top), (58, 12, 10, 38))
    few = [(i + 1, support["name"]) for i, support in enumerate(supports)] if not measured and len(x) <= 6 else None
    plot.axes("abscissa along the tube [m]" if measured else ("" if few else "support number"), label, few)
    for place, (value, low, high) in zip(x, values):
        if math.isfinite(value):
            plot.line([place, place], [0.0, value], "stem")
            plot.line([place, place], [low, high], "friction")
            plot.dot(place, value, "support", 3.5)
    return plot.svg(label)
