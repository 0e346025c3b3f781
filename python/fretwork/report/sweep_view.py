# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of a sweep: histograms, scatter against a variable, tornado of sensitivities, quantile bands by contact."""

import math

import numpy as np

from .drawing import Plot, label_width, unit_for

SAME_PLACE = 6  # decimals, m: contacts nearer than a micrometre are at one place
MOST_DOTS = 2000  # of a scatter plot: more are thinned evenly


def finite(values):
    return values[np.isfinite(values)]


def _scaled(values, unit):
    """The factor and the unit of an axis."""
    return unit_for(float(np.abs(values).max()), unit) if unit in ("W", "N", "m") else (1.0, unit)


def histogram(values, unit, quantiles, title, size=(340, 190)):
    """Cases by value, with lines at quantiles (numbers in the unit of the values)."""
    known = finite(values)
    factor, scaled = _scaled(known, unit)
    counts, edges = np.histogram(factor * known, bins=max(5, min(40, int(math.sqrt(len(known))) * 2)))
    plot = Plot(size, (edges[0], edges[-1]), (0.0, 1.05 * counts.max()))
    plot.axes(f"{title} [{scaled}]" if scaled else title, "cases", x_most=5, y_most=4)
    for count, low, high in zip(counts, edges, edges[1:]):
        if count:
            plot.rectangle((low, high), (0.0, count), "rose")
    for value in quantiles:
        plot.line([factor * value] * 2, [0.0, 1.05 * counts.max()], "limit")
    return plot.svg(f"Distribution of {title}")


def scatter(x, y, titles, unit, names=None, size=(300, 190)):
    """A dot a case. titles: of both axes; unit: of y; names: of x = 0, 1 ... where it stands for texts."""
    keep = np.flatnonzero(np.isfinite(x) & np.isfinite(y))
    keep = keep[:: max(1, len(keep) // MOST_DOTS)]
    if not len(keep):
        return ""
    factor, scaled = _scaled(y[keep], unit)
    x, y = x[keep], factor * y[keep]
    low, high = (-0.5, len(names) - 0.5) if names else (x.min(), x.max())
    margin = 0.03 * (high - low)
    plot = Plot(size, (low - margin, high + margin), (min(0.0, y.min()), 1.05 * y.max()))
    ticks = [(place, name.strip('"')) for place, name in enumerate(names)] if names else None
    plot.axes(titles[0], f"{titles[1]} [{scaled}]" if scaled else titles[1], ticks, x_most=4, y_most=4)
    for a, b in zip(x, y):
        plot.dot(a, b, "bar", radius=2.0)
    return plot.svg(f"{titles[1]} against {titles[0]}")


def tornado(entries, label, width=640):
    """Bars by size, the largest on top, with the interval of each: entries of (name, value, low, high)."""
    entries = sorted(entries, key=lambda entry: abs(entry[1]))
    room = math.ceil(max(label_width(name) for name, *_ in entries)) + 14
    numbers = [number for _, *three in entries for number in three if number is not None]
    margin = 0.03 * (max(0.0, *numbers) - min(0.0, *numbers))
    plot = Plot((width, 26 * len(entries) + 48), (min(0.0, *numbers) - margin, max(0.0, *numbers) + margin), (0.4, len(entries) + 0.6), (room, 12, 8, 38))
    plot.axes(label, "", y_most=0.1)  # no tick of the rows
    for row, (name, value, low, high) in enumerate(entries, 1):
        plot.rectangle(sorted((0.0, value)), (row - 0.32, row + 0.32), "rose")
        if low is not None and high is not None:
            plot.line([low, high], [row, row], "beam")
        plot.text(plot.x[0], row, name, "tick end", (-8, 4))
    return plot.svg("Sensitivities")


LEVELS = (0.05, 0.25, 0.5, 0.75, 0.95)


def _boxes(places, half, values, limits, axis, title, size):
    """At each place the median, the bands from 5 to 95 % and from 25 to 75 % of the cases. values: cases x places, W; axis: label, ticks"""
    known = [column[np.isfinite(column)] for column in values.T]
    levels = [np.quantile(column, LEVELS) if len(column) else None for column in known]
    largest = max(level[-1] for level in levels if level is not None)
    factor, unit = unit_for(float(largest), "W")
    plot = Plot(size, limits, (0.0, 1.05 * factor * float(largest)))
    plot.axes(axis[0], f"work rate [{unit}]", x_ticks=axis[1])
    for place, level in zip(places, levels):
        if level is not None:
            five, quarter, median, three, most = factor * level
            plot.rectangle((place - half, place + half), (five, most), "band")
            plot.rectangle((place - half, place + half), (quarter, three), "rose")
            plot.line([place - half, place + half], [median, median], "beam")
    return plot.svg(title)


def bands(names, values, size=(940, 300)):
    """By contact. values: cases x contacts, W"""
    limits, ticks = (-0.6, len(names) - 0.4), list(enumerate(names))
    return _boxes(range(len(names)), 0.3, values, limits, ("", ticks), "Work rate by contact", size)


def bands_along(abscissae, values, size=(940, 300)):
    """By place on the tube, the contacts of one place together. abscissae: m, of each contact; values: cases x contacts, W"""
    numbers = np.round(abscissae, SAME_PLACE)
    places = np.unique(numbers)
    known = np.isfinite(values)
    present = np.column_stack([known[:, numbers == place].any(axis=1) for place in places])
    sums = np.column_stack([np.where(known, values, 0.0)[:, numbers == place].sum(axis=1) for place in places])
    span = float(np.ptp(places)) or 1.0
    nearest = float(np.diff(places).min()) if len(places) > 1 else span
    half = min(0.35 * nearest, 0.012 * span)
    axis = ("abscissa along the tube [m]", None)
    return _boxes(places, half, np.where(present, sums, np.nan), (places[0] - 2 * half, places[-1] + 2 * half), axis, "Work rate along the tube", size)
