# SPDX-License-Identifier: GPL-3.0-or-later
"""The sections of the report on the flow: profile along tubes, stability, linear response, spectra."""

import html

from . import flow_view, live
from .drawing import short
from .page import figure, section, table, warning
from .sections import with_error

MOST_MODE_ROWS = 40
MOST_POINT_ROWS = 60
MOST_SPECTRA = 24

PROFILES = (
    ("velocity [m/s]", "gap velocity [m/s]"),
    ("density [kg/m3]", "density [kg/m³]"),
    ("void_fraction [1]", "void fraction"),
    ("mass [kg/m]", "mass [kg/m]"),
)


def profiles(run):
    if not run.flows:
        return ""
    parts = []
    for flow in run.flows:
        shown = [plot for plot in PROFILES if flow.columns[plot[0]].max() > 0]
        panels = "".join(figure(flow_view.profile(flow, *plot)) for plot in shown)
        zones = ", ".join(html.escape(zone) for zone in dict.fromkeys(flow.zones) if zone)
        parts.append(f'<h3>{html.escape(flow.tube)}</h3><p class="soft">Zones: {zones}; red: where one ends.</p><div class="grid2">{panels}</div>')
    return section("Flow along the tubes", *parts)


def _worst(assessment):
    return max(assessment["cases"], key=lambda case: max((v or 0.0 for v in case["ratios"]), default=0.0))


def _constants(case):
    return ", ".join(f"{html.escape(zone)} {short(k)}" for zone, k in case["connors_constants"].items())


def _direction(mode):
    """Along what a mode moves the tube, with its share where that is below 95 %."""
    along, share = mode.get("direction"), mode.get("direction_share")
    if along is None:
        return "–"
    return along.replace("_", " ") + (f" ({100 * share:.0f} %)" if share < 0.95 else "")


def _mode_rows(assessment, case):
    rows = zip(assessment["modes"], case["critical_velocities_m_s"], case["ratios"])
    return [
        [f"{i}", short(m["frequency_hz"]), _direction(m), short(100 * m["damping"], 3), short(m["effective_velocity_m_s"], 3), short(v, 3), short(r, 3),
         short(None if r is None else 1 - r, 3)]
        for i, (m, v, r) in enumerate(rows, 1)
    ]


def _mode_of_law(law, number):
    """A mode of the diagram; of several tubes with its tube."""
    if number is None:
        return "lag"
    mode = law["modes"][number - 1]
    return html.escape(f'{mode["tube"]}:{mode["mode"]}') if len(law.get("tubes", [])) > 1 else f"{number}"


def _crossing_rows(law):
    return [
        [short(c["factor"]), short(c["velocity_m_s"]), short(c["frequency_hz"]), short(c["reduced_velocity"], 3),
         _mode_of_law(law, c["mode"]), c["becomes"] + (" (divergence)" if c["frequency_hz"] == 0 else "")
         + (", outside the law’s range" if c["outside_range"] else "")]
        for c in law["crossings"]
    ]


def _unstable_under_law(law):
    """At the velocities given: more roots have become unstable up to there than stable again."""
    return law["factors"][-1] >= 1.0 and sum(1 if c["becomes"] == "unstable" else -1 for c in law["crossings"] if c["factor"] < 1.0) > 0


def _verdict(case, law):
    """Warnings of an assessment that is unstable at the velocities given, each by its criterion."""
    found = []
    if case["margin"] is not None and case["margin"] <= 0.0:
        found.append(f"Fluid-elastically unstable by Connors: V/Vc = {1.0 - case['margin']:.3g}.")
    if law is not None and _unstable_under_law(law):
        found.append(f"Fluid-elastically unstable under the fluidelastic law: critical velocity {law['critical_velocity_m_s']:.4g} m/s, "
                     f"factor {law['critical_factor']:.4g} of the velocities given.")
    return "".join(warning(text, bad=True) for text in found)


def _law(law):
    """The stability diagram of a flow with a fluidelastic law."""
    if law is None:
        return ""
    critical = law["critical_factor"]
    last = law["factors"][-1]
    found = (f'critical velocity {short(law["critical_velocity_m_s"])} m/s, factor {short(critical)}' if critical is not None
             else f"stable up to {short(last)} times the velocity")
    tubes = law.get("tubes", [])
    of = f" of {len(tubes)} tubes" if len(tubes) > 1 else ""
    note = (f'<p class="soft">Fluidelastic law{of}, with the damping of the assessment: {found}. A line a mode, over the factor of {short(law["velocity_m_s"])} m/s; grey: the velocities given, '
            "orange marks below: Connors’ critical factors of the modes, dots: zero damping.</p>")
    pictures = figure(flow_view.law_damping(law)) + figure(flow_view.law_frequencies(law))
    heads = ["factor", "velocity [m/s]", "frequency [Hz]", "V/(f D)", "mode", "becomes"]
    crossings = table(heads, _crossing_rows(law)) if law["crossings"] else ""
    return note + f'<div class="grid2">{pictures}</div>' + crossings


def _assessment(assessment):
    title = f'<h3>{html.escape(assessment["name"])}, {html.escape(assessment["tube"])}</h3>'
    if not assessment["modes"]:
        return title + "<p>No modes.</p>"
    case = _worst(assessment)
    if case["critical_mode"] is None:
        return title + "<p>Not assessed by Connors: no mode moves in a velocity across the tube.</p>" + _verdict(case, assessment.get("law")) + _law(assessment.get("law"))
    pinned = ", ".join(map(html.escape, assessment["pinned"])) or "nothing"
    pinned += "".join(f", {word}" for word in ("elastic", "sticking") if assessment.get(word))
    facts = (f'<p class="soft">Pinned at: {pinned}. Constants K of the case shown, the worst of {len(assessment["cases"])}: {_constants(case)}. '
             f'Margin 1 − V/Vc: {short(case["margin"], 3)}, factor of all velocities at the limit: {short(case["critical_scale"], 3)}.</p>')
    pictures = (figure(flow_view.ratios(case), "V/Vc of the modes; unstable above the red line.")
                + figure(flow_view.critical_velocities(assessment, case), "Bars: critical velocity Vc, cut where it is far above; dots: effective velocity V.")
                + figure(flow_view.damping(assessment)))
    heads = ["mode", "frequency [Hz]", "moves", "damping [%]", "effective velocity [m/s]", "critical velocity [m/s]", "V/Vc", "margin"]
    rows = _mode_rows(assessment, case)
    connors = f'<div class="grid2">{pictures}</div>' + table(heads, rows[:MOST_MODE_ROWS]) + _first(MOST_MODE_ROWS, rows, "modes", "stability.csv")
    law = assessment.get("law")
    return title + _verdict(case, law) + facts + _law(law) + connors


def _first(most, rows, things, file):
    """A line below a table that has only the first rows."""
    return f'<p class="soft">The first {most} of {len(rows)} {things}; all are in {file}.</p>' if len(rows) > most else ""


def _laws_at_work(laws):
    """What fluidelastic laws make of the modes of a run without its contacts."""
    heads = ["tubes", "growth [1/s]", "frequency [Hz]", "damping [%]", "V/(f D)", "critical velocity [m/s]", "critical factor"]
    rows = [[html.escape(", ".join(law["tubes"])), short(law["growth_per_s"], 4), short(law["frequency_hz"], 4), short(100 * law["damping"], 3),
             short(law["reduced_velocity"], 3), short(law["critical_velocity_m_s"], 4), short(law["critical_factor"], 4)] for law in laws]
    note = '<p class="soft">The root that grows fastest, or the vibration of least damping, of the modes of the run without contacts at the velocities given, with the damping of the transient.</p>'
    return "<h3>Fluidelastic laws of the run</h3>" + note + table(heads, rows)


def _motion_row(law):
    """Where the tubes of a law move most."""
    motion = law["motion"]
    place, growth = motion["place"], motion["growth"]
    cells = [html.escape(", ".join(law["tubes"]))]
    if place is None:
        cells += ["at rest, or no contact or observed node"] + 5 * ["–"]
    else:
        axis = place["axis"] + ("_loc" if place["kind"] == "contact" else "")
        cells += [f'{place["kind"]} {html.escape(place["name"])}, {axis}', short(1e3 * place["rms_m"]), short(1e3 * place["largest_m"]),
                  short(100 * place["largest_of_diameter"], 3), short(place["frequency_hz"]), short(place["reduced_velocity"], 3)]
    return cells + ["–" if growth is None else with_error(growth["rate_per_s"], growth["standard_error_per_s"]) + (", grows" if growth["grows"] else "")]


POWERS = ("fluid", "loads", "modal_damping", "contact_damping", "friction", "stored")


def _power_rows(motions):
    """Powers of tubes that run together, once."""
    balances = {tuple(motion["power_tubes"]): motion["power_W"] for motion in motions}
    return [[html.escape(", ".join(tubes))] + [with_error(power[term]["mean"], power[term]["standard_error"], 1e3) for term in POWERS]
            for tubes, power in balances.items()]


def _motions(laws):
    """The motion that the run found past the threshold."""
    unstable = [law for law in laws if law.get("motion")]
    if not unstable:
        return ""
    grows = any(law["motion"]["growth"] and law["motion"]["growth"]["grows"] for law in unstable)
    bad = warning("The motion still grows: statistics are of no steady state.", bad=True) if grows else ""
    later = short(unstable[0]["motion"]["later_from_s"])
    note = ('<p class="soft">Tubes that are unstable without contacts: where they move most about their mean, in the window of the statistics. '
            f"Dominant frequency, and growth of the amplitude with its standard error, from {later} s on.</p>")
    heads = ["tubes", "moves most", "rms [mm]", "largest [mm]", "of the diameter [%]", "frequency [Hz]", "V/(f D)", "growth [1/s]"]
    powers = '<p class="soft">Mean powers in the window, with standard errors: fluid + loads = damping + friction + stored.</p>'
    return ("<h3>Motion past the threshold</h3>" + bad + note + table(heads, [_motion_row(law) for law in unstable], (0, 1)) + powers
            + table(["tubes", *(f'{term.replace("_", " ")} [mW]' for term in POWERS)], _power_rows([law["motion"] for law in unstable])))


def stability(run):
    laws, assessments = run.summary.get("fluidelastic", []), run.summary.get("stability", [])
    parts = ([_laws_at_work(laws), _motions(laws)] if laws else []) + [*map(_assessment, assessments)]
    return section("Fluid-elastic stability", *parts) if parts else ""


def _micro(value):
    return short(None if value is None else 1e6 * value, 4)


def _response(response):
    rows = [
        [html.escape(p["name"]), p["direction"], _micro(p["rms_m"]), short(1e3 * p["rms_velocity_m_s"], 4),
         short(p["up_crossings_per_second"], 4), _micro(p["maximum_m"])]
        for p in response["points"]
    ]
    pinned = ", ".join(map(html.escape, response["pinned"])) or "nothing"
    note = (f'<p class="soft">{response["modes"]} modes, pinned at: {pinned}. Largest value in {short(response["duration_s"])} s that is not exceeded with '
            f'probability {short(response["probability"])}.</p>')
    heads = ["node or contact", "along", "rms [µm]", "rms velocity [mm/s]", "up-crossings [1/s]", "largest [µm]"]
    return f'<h3>{html.escape(response["name"])}</h3>' + note + table(heads, rows[:MOST_POINT_ROWS], (0, 1)) + _first(MOST_POINT_ROWS, rows, "displacements", "response.csv")


def response(run):
    responses = run.summary.get("response", [])
    return section("Linear response to turbulence", *map(_response, responses)) if responses else ""


def spectra(run):
    if not run.spectra:
        return ""
    shown = run.spectra[:MOST_SPECTRA]
    panels = "".join(
        f'<div><h3>{html.escape(s.name)}</h3>{live.figure(flow_view.spectrum(s), live.spectrum(s), html.escape(s.quantity))}</div>' for s in shown
    )
    note = (
        '<p class="soft">One-sided in Hz. Force per length: spectrum of the turbulence where the zone is fastest. Others: Welch’s estimate from the output '
        "instants in the statistics window, with its 95 % band; motion above half the output rate is folded back.</p>"
    )
    left = f'<p class="soft">The first {MOST_SPECTRA} of {len(run.spectra)}; all are in spectra.csv.</p>' if len(run.spectra) > MOST_SPECTRA else ""
    return section("Spectra", note, f'<div class="grid3">{panels}</div>', left)
