# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of observed nodes: histories of their displacement."""

import numpy as np

from .drawing import Plot, unit_for

KINDS = ("force", "friction", "third")  # of x, y, z: blue, orange, black


def history(run, node, size=(480, 200)):
    """Displacement along the global axes against time; axes that do not move are left out."""
    moved = np.where(np.isfinite(node.displacement), node.displacement, np.nan)
    largest = float(np.nanmax(np.abs(moved))) if np.isfinite(moved).any() else 0.0
    factor, unit = unit_for(largest, "m")
    low, high = (factor * float(f(moved)) if largest > 0 else 0.0 for f in (np.nanmin, np.nanmax))
    margin = 0.05 * (high - low)
    plot = Plot(size, (0.0, float(run.time[-1])), (low - margin, high + margin))
    plot.axes("time [s]", f"displacement [{unit}]", x_most=6, y_most=4)
    for axis, kind in enumerate(KINDS):
        if largest > 0 and np.nanmax(np.abs(moved[:, axis]), initial=0.0) > 1e-9 * largest:
            plot.series(run.time, factor * moved[:, axis], kind)
    return plot.svg(f"Displacement of {node.name}")
