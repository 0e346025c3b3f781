# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots with matplotlib; each takes the results and returns its axes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib.pyplot as plt

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .results import Results


def _axes(axes: Axes | None, size: tuple[float, float] | None = None) -> Axes:
    return axes if axes is not None else plt.subplots(figsize=size, layout="constrained")[1]


def force(results: Results, contact: str, axes: Axes | None = None) -> Axes:
    """Normal force of a contact at the output instants."""
    axes = _axes(axes)
    data = results.series(contact, "contact")
    axes.plot(data["time"], data["normal_force"], linewidth=0.7)
    axes.set(xlabel="time [s]", ylabel="normal force [N]", title=contact)
    return axes


def orbit(results: Results, contact: str, axes: Axes | None = None) -> Axes:
    """Displacement of a contact's node from rest in the contact's plane; orange where it touches."""
    axes = _axes(axes)
    data = results.series(contact, "contact")
    y, z = (1e6 * data["displacement"].sel(displacement_axis=axis).values for axis in ("y_loc", "z_loc"))
    touching = data["normal_force"].values > 0
    axes.plot(y, z, linewidth=0.4, color="tab:gray")
    axes.plot(y[touching], z[touching], ".", markersize=2, color="tab:orange")
    axes.set(xlabel="y_loc [µm]", ylabel="z_loc [µm]", title=contact)
    axes.set_aspect("equal", adjustable="datalim")  # a motion along one line keeps its picture
    return axes


def work_rates(results: Results, axes: Axes | None = None) -> Axes:
    """Work rate of each contact, with two standard errors to each side where the run has them."""
    table = results.contacts
    if "work_rate" not in table:
        raise KeyError("no work rates: this run has no transient with contacts")
    axes = _axes(axes, (max(6.4, 0.2 * len(table)), 4.8))
    errors = 2 * table["standard_error.work_rate"].astype(float) if "standard_error.work_rate" in table else None
    axes.errorbar(range(len(table)), table["work_rate"].astype(float), yerr=errors, fmt="o", capsize=3)
    axes.set_xticks(range(len(table)), table.index, rotation=60, ha="right")
    axes.set(ylabel="work rate [W]")
    return axes


def spectrum(results: Results, name: str, axes: Axes | None = None) -> Axes:
    """Power spectra of a point, each quantity with its 95 % band."""
    table = results.spectra
    if table is None:
        raise KeyError(f"no spectrum of {name!r}: this run has no spectra.csv, which runs with [[turbulence]] have")
    if name not in set(table["name"]):
        raise KeyError(f"no spectrum of {name!r}; spectra.csv has: {', '.join(table['name'].unique())}")
    axes = _axes(axes)
    for (quantity, unit), rows in table[table["name"] == name].groupby(["quantity", "unit"]):
        rows = rows[(rows["frequency [Hz]"] > 0) & (rows["density"] > 0)]
        if not len(rows):  # no motion in this direction
            continue
        axes.loglog(rows["frequency [Hz]"], rows["density"], label=f"{quantity} [{unit}]")
        axes.fill_between(rows["frequency [Hz]"], rows["low_95"], rows["high_95"], alpha=0.2)
    axes.set(xlabel="frequency [Hz]", ylabel="one-sided spectral density", title=name)
    axes.legend()
    return axes
