# SPDX-License-Identifier: GPL-3.0-or-later
"""The section of the report on section forces, stresses and reactions."""

import html

import numpy as np

from .drawing import Plot, of_sum, short
from .page import count, section, table

MEGA = 1e-6
MOST_GROUPS = 8  # with pictures
AXES = "xyz"


def _curves(s):
    """Slices of the sections of a group that follow each other along one curve."""
    starts = [0, *(int(k) for k in np.flatnonzero(np.diff(s) < 0) + 1), len(s)]
    return [slice(first, last) for first, last in zip(starts, starts[1:])]


def envelope(sections, largest, std, factor, label, size=(480, 190)):
    """The largest of a quantity along the curves of a group (blue), and its standard deviation (orange)."""
    s, values = sections.s, factor * getattr(sections, largest)
    top = 1.08 * float(np.nanmax(values, initial=0.0)) or 1.0
    plot = Plot(size, (0.0, float(s.max()) or 1.0), (0.0, top))
    plot.axes("s [m]", label, y_most=4)
    for curve in _curves(s):
        plot.line(s[curve], values[curve], "force")
        if std:
            plot.line(s[curve], factor * getattr(sections, std)[curve], "friction")
    return plot.svg(f"{label} along {sections.name}")


def _at(entry, factor=1.0):
    return f"{short(factor * of_sum(entry['largest']), 3)} at {short(entry['s'])}" if entry and entry["largest"] is not None else "–"


def _sections(run):
    groups = run.summary.get("section_forces", [])
    if not groups:
        return ""
    heads = ["group", "stress [MPa] at s [m]", "at time [s]", "deviation [MPa] at s [m]", "moment [N m] at s [m]", "shear force [N] at s [m]", "axial force [N]", "torsion [N m]"]
    rows = []
    for group in groups:
        stress = group["stress"]
        std = stress["std"] if stress else None
        error = std and std["standard_error"]
        scatter = "–" if not std else f"{short(MEGA * std['largest'], 3)}{f' ± {short(MEGA * error, 2)}' if error is not None else ''} at {short(std['s'])}"
        rows.append([html.escape(group["group"]), _at(stress, MEGA), short(stress["time"]) if stress else "–", scatter, _at(group["moment"]), _at(group["shear_force"]),
                     short(of_sum(group["axial_force"]["largest"], group["shear_force"]["largest"]), 3), short(of_sum(group["torsion"]["largest"], group["moment"]["largest"]), 3)])
    panels = []
    for sections in run.sections[:MOST_GROUPS]:
        known = np.isfinite(sections.stress).all()
        picture = envelope(sections, "stress", "stress_std", MEGA, "stress [MPa]") if known else envelope(sections, "moment", None, 1.0, "moment [N m]")
        panels.append(f'<div class="panel"><h3>{html.escape(sections.name)}</h3><figure>{picture}</figure></div>')
    left = f'<p class="soft">Pictures of the first {MOST_GROUPS} of {len(run.sections)} groups.</p>' if len(run.sections) > MOST_GROUPS else ""
    note = (
        '<p class="soft">Largest normal stress at the outer fibre (blue) and its standard deviation at the fibre where this is largest (orange), over every step of the '
        "window, along the beams of the group from the start of each curve. Torsion and shear, the preload and stress concentrations are not in it.</p>"
    )
    return f'<div class="grid2">{"".join(panels)}</div>' + note + left + table(heads, rows)


def _reactions(run):
    reactions = run.summary.get("reactions", [])
    if not reactions:
        return ""
    heads = ["restraint", "of", "mean", "deviation", "± standard error", "least", "largest"]
    rows = []
    for entry in reactions:
        for kind, unit in (("force", "N"), ("moment", "N m")):
            beside = entry[f"largest_{kind}"]
            for axis in AXES:
                found = entry[kind][axis]
                if found is not None:
                    error = entry["standard_error"][kind][axis]["std"]
                    rows.append([html.escape(entry["name"]), f"{kind} {axis} [{unit}]", *(short(of_sum(found[key], beside)) for key in ("mean", "std")),
                                 short(of_sum(error, beside), 2), *(short(of_sum(found[key], beside)) for key in ("min", "max"))])
    note = f'<p class="soft">On the structure, global axes; components that are free are left out. {count(len(reactions))} restrained nodes.</p>'
    return table(heads, rows, (0, 1)) + note


def forces(run):
    parts = [part for part in (_sections(run), _reactions(run)) if part]
    return section("Section forces and reactions", *parts) if parts else ""
