# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the flow: profiles along a tube, stability of modes, power spectra."""

import math

import numpy as np

from .drawing import Plot

DECADES = 6  # of a spectrum: below, nothing is to be seen


def profile(flow, head, label, size=(480, 190)):
    """A quantity along the tube; ends of zones as broken lines."""
    s, values = flow.columns["s [m]"], flow.columns[head]
    top = 1.08 * float(values.max()) or 1.0
    plot = Plot(size, (0.0, float(s[-1])), (0.0, top))
    plot.axes("s [m]", label, y_most=4)
    for k in range(1, len(s)):
        if flow.zones[k] != flow.zones[k - 1]:
            middle = 0.5 * (s[k] + s[k - 1])
            plot.line([middle, middle], [0.0, top], "limit")
    plot.line(s, values, "moved")
    return plot.svg(f"{label} along {flow.tube}")


def _bars(plot, values):
    for mode, value in enumerate(values, 1):
        if value is not None and math.isfinite(value):
            plot.rectangle((mode - 0.4, mode + 0.4), (0.0, value), "bar")


def ratios(case, size=(480, 210)):
    """V/Vc of each mode; unstable above the red line."""
    values = [v if v is not None else 0.0 for v in case["ratios"]]
    plot = Plot(size, (0.4, len(values) + 0.6), (0.0, 1.15 * max(1.0, *values)))
    plot.axes("mode", "V/Vc", y_most=4)
    _bars(plot, values)
    plot.line([0.4, len(values) + 0.6], [1.0, 1.0], "limit")
    return plot.svg("V/Vc of modes")


def critical_velocities(assessment, case, size=(480, 210)):
    """Critical velocity of each mode (bars) and the effective velocity of the flow (orange)."""
    effective = [m["effective_velocity_m_s"] or 0.0 for m in assessment["modes"]]
    critical = [v or 0.0 for v in case["critical_velocities_m_s"]]
    shown = 3.0 * max(effective, default=0.0) or max(critical, default=1.0) or 1.0
    plot = Plot(size, (0.4, len(critical) + 0.6), (0.0, shown))
    plot.axes("mode", "velocity [m/s]", y_most=4)
    _bars(plot, critical)
    for mode, value in enumerate(effective, 1):
        plot.dot(mode, value, "support")
    return plot.svg("critical and effective velocities of modes")


def damping(assessment, size=(480, 210)):
    """Damping ratio of each mode against its frequency."""
    frequency = [m["frequency_hz"] for m in assessment["modes"]]
    ratio = [100.0 * m["damping"] for m in assessment["modes"]]
    plot = Plot(size, (0.0, 1.05 * max(frequency, default=1.0)), (0.0, 1.15 * max(ratio, default=1.0) or 1.0))
    plot.axes("frequency [Hz]", "damping [%]", y_most=4)
    for f, xi in zip(frequency, ratio):
        plot.dot(f, xi, "support")
    return plot.svg("damping and frequency of modes")


HUES = 5  # classes mode0 to mode4 of the page


def _clear_factors(law):
    """Where a broken line stands: the velocities given, and Connors' critical ones of the modes; within the factors of the diagram."""
    low, high = law["factors"][0], law["factors"][-1]
    connors = [m["connors_factor"] for m in law["modes"] if m["connors_factor"] is not None]
    return [f for f in (1.0,) if low <= f <= high], [f for f in connors if low <= f <= high]


def _over_factor(law, key, scale, interval, ylabel, title, size):
    """A quantity of the modes over the factor of all velocities."""
    plot = Plot(size, (law["factors"][0], law["factors"][-1]), interval)
    plot.axes("factor of all velocities", ylabel, y_most=5)
    given, connors = _clear_factors(law)
    for factor in given:
        plot.line([factor, factor], interval, "rest")
    for factor in connors:
        plot.line([factor, factor], [interval[0], interval[0] + 0.06 * (interval[1] - interval[0])], "friction")
    for number, mode in enumerate(law["modes"]):
        values = [math.nan if v is None else scale * v for v in mode[key]]
        plot.line(law["factors"], values, f"mode{number % HUES}")
    return plot, title


def law_damping(law, size=(480, 240)):
    """Damping of the modes over the factor; below the red line they are unstable. Lines are cut where damping is past three times its largest value at rest."""
    values = np.array([m["dampings"] for m in law["modes"]], float) * 100.0
    rest = 3.0 * float(np.nanmax(np.abs(values[:, 0]), initial=0.1))
    interval = (max(float(np.nanmin(values)), -2.0 * rest) - 0.1 * rest, min(float(np.nanmax(values)), 2.0 * rest) + 0.1 * rest)
    plot, title = _over_factor(law, "dampings", 100.0, interval, "damping [%]", "damping of the modes over the velocity", size)
    plot.line([law["factors"][0], law["factors"][-1]], [0.0, 0.0], "limit")
    for crossing in law["crossings"]:
        plot.dot(crossing["factor"], 0.0, "support")
    return plot.svg(title)


def law_frequencies(law, size=(480, 240)):
    """Frequency of the modes over the factor; crossings of zero damping as dots."""
    top = max((v for m in law["modes"] for v in m["frequencies_hz"] if v is not None), default=1.0)
    plot, title = _over_factor(law, "frequencies_hz", 1.0, (0.0, 1.05 * top), "frequency [Hz]", "frequency of the modes over the velocity", size)
    for crossing in law["crossings"]:
        plot.dot(crossing["factor"], crossing["frequency_hz"], "support")
    return plot.svg(title)


def _powers(plot, ylabel):
    """Axes of logarithms to the base 10."""
    low, high = plot.x
    marks = [math.log10(m * 10.0**k) for k in range(math.floor(low), math.ceil(high) + 1) for m in (1, 2, 5)]
    plot.axes("frequency [Hz]", ylabel, [(at, f"{10**at:.3g}") for at in marks if low <= at <= high], y_most=DECADES)


def spectrum(one, size=(330, 210)):
    """Density against frequency in logarithms, with its 95 % band."""
    keep = (one.frequency > 0) & (one.density > 0)
    if keep.sum() < 2:
        return '<p class="none">no spectrum</p>'
    f, g = np.log10(one.frequency[keep]), np.log10(one.density[keep])
    low, high = np.log10(one.low[keep]), np.log10(one.high[keep])
    top = float(high.max()) + 0.2
    plot = Plot(size, (float(f[0]), float(f[-1])), (max(float(low.min()), top - DECADES), top))
    _powers(plot, f"log10 of {one.unit}".replace("2", "²"))
    if (high > low).any():
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(plot.px(np.concatenate((f, f[::-1]))),
                                                             plot.py(np.concatenate((low, high[::-1])))))
        plot.add(f'<path class="band" d="M{points}Z"/>')
    plot.line(f, g, "force")
    return plot.svg(f"spectrum of {one.name}, {one.quantity}")
