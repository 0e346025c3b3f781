# SPDX-License-Identifier: GPL-3.0-or-later
"""The sections of the report, each a piece of HTML."""

import html
import math

from . import contact_view, live, node_view, structure_view, wear_view
from .drawing import of_sum, short, unit_for
from .page import cards, count, figure, section, table, warning

MOST_MODES = 6  # pictures
MOST_MODE_ROWS = 40
MANY_CONTACTS = 12  # above, orbits are small multiples and histories are shown of a few
HISTORIES_OF_MANY = 6
MOST_IMPACT_ROWS = 12


def quantity(value, unit):
    if value is None or not math.isfinite(value):
        return "–"
    value = of_sum(value)
    factor, scaled = unit_for(abs(value), unit)
    return f"{short(factor * value, 3)} {scaled}"


def _known(values):
    return [v for v in values if v is not None]


def _error(contact, *keys):
    """The standard error of an estimate of a contact; None where the run has none."""
    found = contact.summary.get("standard_error") or {}
    for key in keys:
        found = found.get(key) if isinstance(found, dict) else None
    return found


def with_error(value, error, factor=1.0, digits=4):
    """A value with its standard error."""
    text = _times(value, factor, digits)
    return text if value is None or error is None else f"{text} ± {_times(error, factor, 2)}"


def _work(contact):
    value = contact.summary["work_rate"] if contact.summary else None
    return value if value is not None else 0.0


def _verdicts(run):
    """The shortest time to a limit of wear and the smallest stability margin, where the run has them."""
    out = []
    firsts = [(*wear_view.first_life(s), s["name"]) for s in run.wear]
    lives = [(years[0], body, name) for years, body, name in firsts if not math.isnan(years[0])]
    if lives:
        years, body, name = min(lives, key=lambda life: life[0])
        where = f", {html.escape(name)}{' (the support)' if body == 'support' else ''}" if math.isfinite(years) else ""
        unknown = f" ({len(run.wear) - len(lives)} of {len(run.wear)} supports have no figure)" if len(lives) < len(run.wear) else ""
        out.append((f"years to the limit of wear{where}{unknown}", short(years, 3) if math.isfinite(years) else "never"))
    assessments = run.summary.get("stability", [])
    margins = [(case["margin"], one["name"]) for one in assessments for case in one["cases"] if case["margin"] is not None]
    if margins:
        margin, name = min(margins)
        of_which = f", of {html.escape(name)}" if len(assessments) > 1 else ""
        out.append((f"smallest stability margin by Connors, 1 − V/Vc{of_which}", short(margin, 3)))
    return out


def key_figures(run):
    model, transient = run.summary["model"], run.transient
    entries = [("nodes", count(model["nodes"])), ("mass", f"{short(model['mass_kg'], 4)} kg")]
    if run.modes:
        entries.append((f"{len(run.modes)} modes, from" if len(run.modes) > 1 else "one mode", f"{short(run.modes[0].frequency)} Hz"))
    if transient:
        entries.append(("simulated", f"{short(transient['duration_s'])} s"))
    if transient and run.contacts:
        statistics = [c.summary for c in run.contacts]
        work = _known(s["work_rate"] for s in statistics)
        entries += [
            ("work rate, all contacts", quantity(sum(work), "W")),
            ("largest work rate, one contact", quantity(max(work, default=None), "W")),
            ("largest normal force", quantity(max(_known(s["normal_force"]["max"] for s in statistics), default=None), "N")),
            ("impacts", count(sum(s["impacts"] for s in statistics))),
        ]
    out = cards(entries + _verdicts(run))
    if transient and transient["outcome"] != "done":
        end = quantity(transient["end_time_s"], "s")
        out += warning(f"The run diverged at {end}: its numbers are of no use. Take a smaller step.", bad=True)
    return out + "".join(warning(text) for text in run.summary.get("warnings", []))


def structure(run):
    picture, view, unnamed = structure_view.structure(run)
    supports = f"; {len(run.contacts)} contacts (orange)" if run.contacts else ""
    scene = live.scene(run)
    drawn = [text for kind, text in (("restraints", "restraints (black)"), ("loads", "loads (green)")) if scene and scene[kind]]
    marks = f"; {', '.join(drawn)}" if drawn else ""
    facts = f"{count(run.summary['model']['elements'])} beams, {count(run.summary['model']['dofs'])} free degrees of freedom{supports}<span class=screen>{marks}</span>. View on paper: {view}."
    if unnamed:
        facts += f" Without room for a name: {html.escape(', '.join(unnamed))}."
    return section("Structure", live.figure(picture, scene, facts))


def modes(run):
    if not run.modes:
        return section("Modes", "<p>The structure has no mode.</p>")
    several = run.structures > 1
    heads = ["mode", "frequency [Hz]", "damping [%]", "residual", "direction"] + (["structure"] if several else [])
    rows = [
        [f"{i + 1}", short(m.frequency, 6), short(100 * m.damping, 3), short(m.residual, 1), structure_view.direction(m)]
        + ([f"{m.structure}"] if several else [])
        for i, m in enumerate(run.modes[:MOST_MODE_ROWS])
    ]
    panels = []
    for i, mode in enumerate(run.modes[:MOST_MODES]):
        picture, view = structure_view.mode_picture(run, mode)
        caption = f"<b>mode {i + 1}</b>, {short(mode.frequency, 5)} Hz, {structure_view.direction(mode)} · {view}"
        panels.append(f'<div class="panel">{figure(picture, caption)}</div>')
    left = f'<p class="soft">The first {MOST_MODE_ROWS} of {len(run.modes)} modes.</p>' if len(run.modes) > MOST_MODE_ROWS else ""
    note = '<p class="soft">Grey: at rest; blue: the mode, its amplitude chosen for the eye. Direction: share in the squared translations.</p>'
    return section("Modes", '<div class="grid3">' + "".join(panels) + "</div>", note, table(heads, rows, (0, 4)), left)


def _contact_line(contact):
    s = contact.summary
    return (
        f"{html.escape(contact.facts['obstacle'])}, gap {quantity(float(contact.facts['gap']), 'm')} · "
        f"{count(s['impacts'])} impacts, in contact {short(100 * (s['contact_time_ratio'] or 0), 3)} % of the time · "
        f"work rate {quantity(s['work_rate'], 'W')}"
    )


def _panel(run, contact):
    return (
        f'<div class="panel"><h3>{html.escape(contact.name)}</h3><p class="soft">{_contact_line(contact)}</p><div class="row">'
        + live.figure(contact_view.orbit(run, contact), live.orbit(run, contact))
        + live.figure(contact_view.history(run, contact), live.force(run, contact))
        + live.figure(contact_view.impact(run, contact), live.impact(run, contact))
        + "</div></div>"
    )


_EXPLANATION = (
    '<p class="soft">Left: position of the node from the obstacle’s centre at true scale (each axis with its own at flat obstacles), in the statistics window; dark where it stays long, '
    "orange where it touches; black: the obstacle’s reach. Middle: normal force (on paper: grey before the statistics window, orange the stretch shown at "
    "the right). Right: the largest impact. Normal force blue, tangential force orange. Drag to zoom, double-click to show all. Orbits and histories show the output instants, the largest impact every step, with splitting the forces within steps; statistics see every step.</p>"
)


def contacts(run):
    if not run.contacts or run.time is None or not len(run.time):
        return ""
    seen = [contact for contact in run.contacts if contact.normal is not None]  # the study may leave series out
    if len(seen) <= MANY_CONTACTS:
        return section("Contacts", _EXPLANATION, *[_panel(run, contact) for contact in seen]) if seen else ""
    small = "".join(
        f"<div><h3>{html.escape(c.name)}</h3>{figure(contact_view.orbit(run, c, 184, labels=False))}</div>" for c in seen
    )
    worst = sorted(seen, key=_work, reverse=True)[:HISTORIES_OF_MANY]
    return section(
        "Orbits",
        '<p class="soft">y_loc across, z_loc upwards, µm from the obstacle’s centre, at true scale (each axis with its own at flat obstacles), in the statistics window. Dark where the node stays '
        "long, orange where it touches; black: the obstacle’s reach.</p>",
        f'<div class="small">{small}</div>',
    ) + section(f"The {HISTORIES_OF_MANY} contacts that wear most", _EXPLANATION, *[_panel(run, contact) for contact in worst])


def along_the_tube(run):
    if len(run.contacts) < 2 or not run.transient:
        return ""
    statistics = [c.summary for c in run.contacts]
    length = run.window_length
    rates = [s["impacts"] / length if length else None for s in statistics]
    errors = [[_error(c, key) for c in run.contacts] for key in ("work_rate", "friction_power", "impacts_per_second")]
    ratio = [100 * s["contact_time_ratio"] if s["contact_time_ratio"] is not None else None for s in statistics]
    plots = [
        ([s["work_rate"] for s in statistics], "work rate", "W", errors[0]),
        ([s["friction_power"] for s in statistics], "friction power", "W", errors[1]),
        (ratio, "time in contact", "%"),
        (rates, "impact rate", "1/s", errors[2]),
    ]
    panels = "".join(figure(contact_view.along(run, *plot)) for plot in plots)
    note = (
        '<p class="soft">Work rate: mean over time of the normal force times the sliding speed while the contact slides (Archard’s input). Friction '
        "power: energy that the sliders dissipate in a second. Bars: two standard errors of this window to each side.</p>"
    )
    where = "Along the tube" if run.contacts[0].abscissa is not None else "Contact by contact"
    return section(where, f'<div class="grid2">{panels}</div>', note)


def _times(value, factor, digits=4):
    return short(None if value is None else factor * value, digits)


def _losses(run):
    """Table of what impacts and sliding take of each contact over the statistics window."""
    heads = ["contact", "lost in dampers [mJ]", "lost in friction [mJ]", "path while sliding [mm]", "impulse [N s]", "sticking [% of contact]",
             "departure speed mean / max [mm/s]"]
    rows = []
    input_energy = (run.summary.get("energy") or {}).get("input_J")
    for c in run.contacts:
        s = c.summary
        speed = s["departure_velocity"]
        lost = [_times(of_sum(s["energy"][f"{kind}_J"], input_energy), 1e3) for kind in ("damping", "friction")]
        rows.append([
            html.escape(c.name), *lost, _times(s["sliding_distance_m"], 1e3),
            short(s["impulse_Ns"]), _times(s["sticking_ratio"], 100, 3), f"{_times(speed['mean'], 1e3, 3)} / {_times(speed['max'], 1e3, 3)}",
        ])
    return table(heads, rows)


_NOTHING = {"rms": None, "max": None}


def _flat_axes(contact):
    """The keys of the normal axis and of the one across it at a flat obstacle (plane, stop, bars); None at others."""
    return {"_y": ("y", "z"), "_z": ("z", "y")}.get(contact.facts["obstacle"][-2:])


def _gaps(contact, normal):
    """In um; where both sides of planes or bars differ at rest the negative and the positive one. @param normal  key of the axis"""
    gap = float(contact.facts["gap"])
    rest = float(contact.facts["rest"]["xyz".index(normal)])
    if len(contact.summary.get("sides", {})) != 2 or abs(rest) <= 1e-3 * gap:
        return short(1e6 * gap)
    return f"{short(1e6 * (gap + rest))} and {short(1e6 * (gap - rest))}"


def _flat(run):
    """Table of flat obstacles: position along the normal and sliding across it, apart."""
    heads = ["flat obstacle", "kind", "gap [µm]", "normal position from – to [µm]", "its deviation [µm]", "range of sliding [µm]", "its deviation [µm]"]
    rows = []
    for c in run.contacts:
        axes = _flat_axes(c)
        if not axes:
            continue
        normal, across = (c.summary["position"][axis] for axis in axes)
        span = None if None in (across["max"], across["min"]) else across["max"] - across["min"]
        rows.append([
            html.escape(c.name), html.escape(c.facts["obstacle"]), _gaps(c, axes[0]),
            f"{_times(normal['min'], 1e6)} – {_times(normal['max'], 1e6)}", _times(normal["std"], 1e6, 3), _times(span, 1e6), _times(across["std"], 1e6, 3),
        ])
    return table(heads, rows, (0, 1)) if rows else ""


def _flexibility(run):
    """Table of the static flexibility at contacts, of their modes, and of what these lack."""
    heads = ["contact", "static flexibility [m/N]", "of the modes [m/N]", "missing [m/N]", "K<sub>N</sub> × missing"]
    rows = []
    for c in run.contacts:
        found = c.summary.get("static_flexibility")
        if found:
            lack = None if found["missing"] is None else found["missing"] * float(c.facts["normal_stiffness"])
            rows.append([html.escape(c.name), short(found["exact"]), short(found["basis"]), short(found["missing"], 3), short(lack, 3)])
    return table(heads, rows) if rows else ""


def nodes(run):
    """Observed nodes: statistics of their displacement, and its history."""
    if not run.nodes_observed:
        return ""
    heads = ["node", "along", "mean [µm]", "deviation [µm]", "± standard error", "least [µm]", "largest [µm]"]
    rows = []
    for node in run.nodes_observed:
        errors = node.summary.get("standard_error", {}).get("displacement", {})
        found = node.summary["displacement"]
        largest = max((abs(value) for axis in "xyz" for value in _known(found[axis].values())), default=0.0)
        for axis in "xyz":
            d = found[axis]
            error = errors.get(axis, {}).get("std")
            mean, deviation, least, most = (_times(of_sum(d[kind], largest), 1e6) for kind in ("mean", "std", "min", "max"))
            rows.append([html.escape(node.name), axis, mean, deviation, _times(of_sum(error, largest), 1e6, 2), least, most])
    shown = run.nodes_observed[:HISTORIES_OF_MANY]
    panels = "".join(
        f'<div class="panel"><h3>{html.escape(node.name)}</h3>{live.figure(node_view.history(run, node), live.node(run, node))}</div>' for node in shown if node.displacement is not None
    )
    note = '<p class="soft">Displacement from rest, global axes; x blue, y orange, z black. Statistics over every step.</p>'
    left = f'<p class="soft">Histories of the first {len(shown)} of {len(run.nodes_observed)} nodes.</p>' if len(shown) < len(run.nodes_observed) else ""
    return section("Observed nodes", f'<div class="grid2">{panels}</div>', note, left, table(heads, rows, (0, 1)))


def contact_table(run):
    if not run.contacts or not run.transient:
        return ""
    heads = ["contact", "impacts", "in contact [%]", "F<sub>N</sub> mean [N]", "F<sub>N</sub> rms [N]", "F<sub>N</sub> max [N]",
             "F<sub>T</sub> max [N]", "radial rms [µm]", "radial max [µm]", "penetration max [µm]", "work rate [mW]", "friction power [mW]",
             "impact speed mean / max [mm/s]", "contact mean / max [ms]"]
    rows = []
    for c in run.contacts:
        s = c.summary
        force, radial = s["normal_force"], _NOTHING if _flat_axes(c) else s["position"]["radial"]
        speed, long = s["impact_velocity"], s["contact_duration"]
        rows.append([
            html.escape(c.name), count(s["impacts"]), _times(s["contact_time_ratio"], 100, 3), short(force["mean"]), with_error(force["rms"], _error(c, "normal_force", "rms")),
            short(force["max"]), short(of_sum(s["tangential_force"]["max"], force["max"])), _times(radial["rms"], 1e6), _times(radial["max"], 1e6), _times(s["penetration"]["max"], 1e6, 3),
            with_error(s["work_rate"], _error(c, "work_rate"), 1e3), with_error(s["friction_power"], _error(c, "friction_power"), 1e3),
            f"{_times(speed['mean'], 1e3, 3)} / {_times(speed['max'], 1e3, 3)}", f"{_times(long['mean'], 1e3, 3)} / {_times(long['max'], 1e3, 3)}",
        ])
    note = (
        f'<p class="soft">Statistics over every step from {short(run.window)} s on. Forces over all time; radial: distance of the node from the '
        "obstacle’s centre in the contact’s plane, none at flat obstacles. ±: standard error of the estimate over this window.</p>"
    )
    return section("Table of contacts", table(heads, rows), _flat(run), _losses(run), _flexibility(run), note)


def _strongest(contacts):
    """Table of the impacts with the largest forces, whatever their contact."""
    heads = ["contact", "start [s]", "duration [ms]", "peak force [N]", "impulse [mN s]", "speed before / after [mm/s]", "energy lost [mJ]", "rebounds"]
    every = [(float(c.impacts["peak_force"][i]), c, i) for c in contacts for i in range(len(c.impacts["start"]))]
    rows = []
    for peak, c, i in sorted(every, key=lambda entry: -entry[0])[:MOST_IMPACT_ROWS]:
        value = {name: float(column[i]) for name, column in c.impacts.items()}
        rows.append([
            html.escape(c.name), short(value["start"], 6), _times(value["duration"], 1e3, 3), short(peak), _times(value["impulse"], 1e3),
            f"{_times(value['velocity_before'], 1e3, 3)} / {_times(value['velocity_after'], 1e3, 3)}", _times(of_sum(value["energy_lost"], value["impulse"] * value["velocity_before"]), 1e3, 3),
            f"{value['rebounds']:.0f}",
        ])
    return table(heads, rows)


def impacts(run):
    hit = [c for c in run.contacts if c.impacts is not None and len(c.impacts["start"])]
    if not hit:
        return ""
    shown = hit if len(hit) <= MANY_CONTACTS else sorted(hit, key=_work, reverse=True)[:HISTORIES_OF_MANY]
    panels = []
    for c in shown:
        left_out = f", {c.impacts_left_out} later ones in no row" if c.impacts_left_out else ""
        panels.append(
            f'<div class="panel"><h3>{html.escape(c.name)}</h3><p class="soft">{len(c.impacts["start"])} impacts{left_out}</p><div class="row">'
            + figure(contact_view.histogram(c.impacts["velocity_before"], "impact speed", "m/s"))
            + figure(contact_view.histogram(c.impacts["peak_force"], "peak force", "N"))
            + "</div></div>"
        )
    note = (
        '<p class="soft">One row of results.h5 each, with its rebounds (openings shorter than output.rest_time). Speeds along the normal, before the first touch '
        "and after the last opening. The table: the strongest of all.</p>"
    )
    return section("Impacts", note, _strongest(hit), '<div class="grid2">' + "".join(panels) + "</div>")


_SHARES = ("#7aa6d6", "#1f5fa8", "#f0a868", "#d95f0e", "#b3141e")  # as in the style of the bar


def energy(run):
    energy = run.summary.get("energy")
    if not energy:
        return ""
    bar = contact_view.energy_bar(energy)
    residual = None
    parts = [energy[f"{kind}_J"] for kind in ("stored", "modal_damping", "contact_damping", "friction")]
    if energy["input_J"] is not None and None not in parts:
        residual = energy["input_J"] + energy.get("fluid_J", 0.0) - sum(parts)  # fluid_J: only with a law
    names = ["stored at the end", "modal damping", "contact damping", "friction", "residual"]
    swatches = [f'<span class="swatch" style="background:{colour}"></span>{name}' for colour, name in zip(_SHARES, names)]
    values = [energy["input_J"], *(of_sum(part, energy["input_J"]) for part in (energy["initial_J"], *parts)), residual]
    rows = [["energy [J]"] + [short(value) for value in values]]
    if energy["input_J"]:
        shares = [None if value is None else 100 * value / energy["input_J"] for value in values]
        rows.append(["share of the input [%]"] + [short(share, 3) for share in shares])
    note = f'<p class="soft">Input = stored + modal damping + contact damping + friction + residual. Largest relative residual: {short(energy["residual_relative"], 2)}.</p>'
    return section("Energy balance", figure(bar) if bar else "", table(["", "input", "of it at t = 0", *swatches], rows), note)


def computation(run):
    summary, transient = run.summary, run.transient
    rows = []
    if transient:
        step = short(transient["step_min_s"])
        if transient["step_max_s"] != transient["step_min_s"]:
            step += " to " + short(transient["step_max_s"])
        rows += [
            ["scheme", html.escape(transient["scheme"])],
            ["time step", f"{step} s ({count(transient['steps'])} steps, {count(transient['force_evaluations'])} evaluations of the contact forces)"],
            ["why this step", html.escape(transient["step_reason"])],
            ["highest contact frequency", f"{short(transient['contact_frequency_rad_s'])} rad/s"],
            ["steps not converged", count(transient["unconverged_steps"])],
        ]
    modes = summary["modes"]
    rows.append(["orthogonality of the modes", short(modes["orthogonality"], 2)])
    seconds = {name: value for name, value in summary["timings_s"].items() if value}
    rows.append(["time of computation", ", ".join(f"{html.escape(name)} {short(value, 3)} s" for name, value in seconds.items())])
    rows.append(["ranks, vector unit", f"{count(summary['ranks'])}, {html.escape(summary['vector_width'])}"])
    if summary["seeds"]:
        rows.append(["random seeds", ", ".join(count(seed) for seed in summary["seeds"])])
    libraries = ", ".join(f"{html.escape(n)} {html.escape(v)}" for n, v in summary["libraries"].items())
    rows.append(["versions", f"Fretwork {html.escape(summary['version'])}" + (f", {libraries}" if libraries else "")])
    rows.append(["SHA-256 of the input", f"<code>{html.escape(summary['input_sha256'])}</code>"])
    notes = "".join(f'<p class="soft">{html.escape(text)}</p>' for text in summary.get("notes", []))
    return section("How it was computed", table(["", ""], rows, (0, 1)), notes)


def study(run):
    return section("Study", f"<pre>{html.escape(run.attributes['study'])}</pre>")
