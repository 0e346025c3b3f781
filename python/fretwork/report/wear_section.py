# SPDX-License-Identifier: GPL-3.0-or-later
"""The section of the report on wear: table of supports, depth against time, scars, work by angle, wear along the tube."""

import html
import math

import numpy as np

from . import wear_view
from .drawing import ROUND_OFF, of_sum, short
from .page import figure, section, table, warning

MANY_SUPPORTS = 12  # above, pictures are shown of a few
PICTURES_OF_MANY = 6
LEAST_SHARE = 0.05  # of the volume of a support, of a side worth a row


def _bounds(bounds, factor=1.0, digits=3):
    """0.12 (0.11 – 0.13)"""
    value, low, high = bounds
    text = _one(value, factor, digits)
    first, last = _one(low, factor, digits), _one(high, factor, digits)
    if math.isnan(value) or not low < high or first == last:
        return text
    return f"{text} ({first} – {last})"


def _one(value, factor, digits):
    return "never" if value > 1 / ROUND_OFF else short(of_sum(factor * value), digits)


def _life(support, of=""):
    """Of the tube, or with of="support_" of the support."""
    end = support[f"{of}life_end"]
    if end in ("outside_law", ""):
        return "outside the law" if end else "–"
    return _bounds(support[f"{of}life_years"])


def _law(support):
    text = html.escape(support["law"])
    if math.isfinite(support["coefficient"]):
        text += f", K = {short(support['coefficient'], 3)} m²/N"
    return f"{text}<br>({html.escape(support['source'])})"


def _scar(support):
    width, length = (1e3 * support[key] for key in ("scar_width", "scar_length"))
    return f"{short(of_sum(width), 3)} × {short(length, 3)}" if math.isfinite(width) else "–"


def _states(support):
    return "; ".join(f"{html.escape(name)}: {short(100 * share, 3)} %" for name, share in support["states"])


def _supports(supports):
    several = any(len(support["states"]) > 1 for support in supports)
    heads = ["support", "work rate [mW]", "worn volume [mm³]", "depth [mm]", "support's depth [mm]", "scar width × length [mm]",
             "years to the limit", "limit [mm]", "law", "geometry"] + (["operating states"] if several else [])

    def scar(name, s):
        return [html.escape(name), _bounds(s["work_rate"], 1e3), _bounds(s["volume"][-1], 1e9), _bounds(s["depth"][-1], 1e3),
                _bounds(s["support_depth"][-1], 1e3), _scar(s), _life(s)]

    def of_study(s):
        return [short(1e3 * s["limit"], 3), _law(s), html.escape(s["geometry"])] + ([_states(s)] if several else [])

    def by_life(s):
        years = wear_view.first_life(s)[0][0]
        return (1, 0.0, -s["work_rate"][0]) if math.isnan(years) else (0, years, -s["work_rate"][0])

    rows = []
    for s in sorted(supports, key=by_life):
        rows.append(scar(s["name"], s) + of_study(s))
        rows += [scar(f"{s['name']}, {side if side.startswith(('land ', 'facet ')) else 'side ' + side}", one) + [""] * (3 + several)
                 for side, one in s["sides"].items() if not one["volume"][-1, 0] < LEAST_SHARE * s["volume"][-1, 0]]
    return table(heads, rows, (0, 8, 9, *((10,) if several else ())))


def _initial_depths(supports):
    """What the depths of tubes begin at that were worn before, by support: of each of its scars."""
    worn = {s["name"]: [scar["initial_depth"] for scar in (s["sides"].values() or [s]) if scar["initial_depth"] > 0] for s in supports}
    depths = [1e3 * depth for of_support in worn.values() for depth in of_support]
    if not depths:
        return ""
    least, most = (short(depth, 3) for depth in (min(depths), max(depths)))
    count = sum(bool(of_support) for of_support in worn.values())
    at = "" if count == len(worn) else f" at {count} of {len(worn)} supports"
    return f" Depths begin at {least if least == most else f'{least} to {most}'} mm (initial_wear){at}."


def _supports_themselves(supports):
    """What supports lose that wear or have a limit."""
    worn = [s for s in supports if s["support_volume"][-1, 0] > 0 or math.isfinite(s["support_limit"])]
    rows = [[html.escape(s["name"]), f"{short(s['support_coefficient'], 3)}", _bounds(s["support_volume"][-1], 1e9), _bounds(s["support_depth"][-1], 1e3),
             _life(s, "support_"), short(1e3 * s["support_limit"], 3) if math.isfinite(s["support_limit"]) else "–"] for s in worn]
    heads = ["the support itself", "K [m²/N]", "worn volume [mm³]", "depth [mm]", "years to its limit", "limit [mm]"]
    return table(heads, rows) if rows else ""


def _tubes(run):
    def bounds(entry):
        return tuple(math.nan if entry[key] is None else entry[key] for key in ("value", "low", "high"))

    def life(tube):  # summary.json has no infinity
        return _bounds(bounds(tube["life_years"])) if tube["life_years"]["value"] is not None else "–"

    def _first(tube):
        unknown = tube.get("unknown_lives", 0)
        return (html.escape(tube["first_support"] or "–") + (" (the support)" if tube.get("first_body") == "support" else "")
                + (f"; {unknown} {'life' if unknown == 1 else 'lives'} unknown" if unknown else ""))

    tubes = run.summary.get("wear", {}).get("tubes", [])
    rows = [
        [f"{t['tube']}", f"{t['supports']}", _bounds(bounds(t["work_rate"]), 1e3), _bounds(bounds(t["volume_m3"]), 1e9),
         _bounds(bounds(t["depth_m"]), 1e3), html.escape(t["deepest_support"] or "–"), life(t), _first(t)]
        for t in tubes
    ]
    heads = ["tube", "supports", "work rate [mW]", "worn volume [mm³]", "largest depth [mm]", "at", "shortest life [years]", "of"]
    return table(heads, rows, (0, 5, 7)) if rows else ""


_ENDS = {"life_reached": "a tube has lost its limit", "geometry_stands": "the geometry stands", "horizon_reached": "the end of the years",
         "stages_used": "no more stages", "beyond_geometry": "beyond the geometry", "stage_failed": "a stage failed",
         "stage_refused": "a stage was refused"}


def _gap_opening(run):
    """First and last stage of each support."""
    opening = run.summary.get("wear", {}).get("gap_opening")
    if not opening or not opening["years"]:
        return ""

    def bounds(figure, absent=math.nan):
        return tuple(absent if figure[key] is None else figure[key] for key in ("value", "low", "high"))

    def life(figure):  # summary.json has no infinity
        known = figure["end"] in ("reached", "never")
        return _bounds(bounds(figure, math.inf)) if known else figure["end"].replace("_", " the ")

    rows = [
        [html.escape(s["name"]), f"{short(1e3 * s['gap_m'][0])} → {short(1e3 * s['gap_m'][-1])}",
         f"{_bounds(bounds(s['work_rate'][0]), 1e3)} → {_bounds(bounds(s['work_rate'][-1]), 1e3)}", _bounds(bounds(s["depth_m"][-1]), 1e3),
         life(s["life_years"])]
        for s in opening["supports"]
    ]
    worn = [
        [html.escape(s["name"]), _bounds(bounds(s["support_depth_m"][-1]), 1e3), life(s["support_life_years"]) if s.get("support_life_years") else "no limit"]
        for s in opening["supports"]
        if s.get("support_life_years") or s["support_depth_m"][-1]["value"] != 0
    ]
    note = (
        f'<p class="soft">Gaps opened by wear in {len(opening["years"])} stages up to {short(opening["years"][-1])} years: {_ENDS[opening["end"]]}. '
        "From the first stage to the last; all else of this section is the first stage.</p>"
    )
    supports = table(["the support itself", "depth at the end [mm]", "years to its limit"], worn, (0,)) if worn else ""
    return note + table(["support", "gap [mm]", "work rate [mW]", "depth at the end [mm]", "years to the limit"], rows, (0,)) + supports


def _angles(run, support):
    window = run.time >= run.window
    parts = [wear_view.contact_angles(run.contacts[c], window) for c in support["contacts"] if run.contacts[c].normal is not None]
    return np.concatenate(parts) if parts else np.array([])


def _panel(run, support):
    return (
        f'<div class="panel"><h3>{html.escape(support["name"])}</h3><div class="row">'
        + figure(wear_view.depth_history(support))
        + figure(wear_view.scar(support))
        + figure(wear_view.polar(support, _angles(run, support)))
        + "</div></div>"
    )


def _place(run, support):
    return run.contacts[support["contacts"][0]].abscissa


def _shown(supports):
    if len(supports) <= MANY_SUPPORTS:
        return supports
    def life(support):
        years = wear_view.first_life(support)[0][0]
        return math.inf if math.isnan(years) else years

    return sorted(supports, key=life)[:PICTURES_OF_MANY]


_EXPLANATION = (
    '<p class="soft">Left: depth of the tube (blue; band: interval of the work rate; orange: depth of the support) and their limits (red). Middle: the '
    "wall of the tube across the scar, orange what is worn off. Right: contact point by angle from y_loc to z_loc; blue areas: work of sliding by "
    "sector, over every step; orange: time in contact at the output instants; the largest sector of each reaches the rim.</p>"
)


def wear(run):
    if not run.wear:
        return ""
    years = run.wear[0]["time"][-1] / wear_view.YEAR
    note = (
        f'<p class="soft">Volume, depth and scar after {short(years)} years; in brackets the ends of the interval of the work rate.{_initial_depths(run.wear)} Laws, geometries and '
        "their limits: doc/wear.md. Coefficients of one pair of materials differ by decades with geometry and source.</p>"
    )
    along = ""
    if len(run.wear) > 1:
        places = [_place(run, support) for support in run.wear]
        along = '<div class="grid2">' + "".join(
            figure(wear_view.along(run.wear, places, *plot))
            for plot in (("volume", 1e9, "worn volume [mm³]"), ("depth", 1e3, "depth [mm]"))
        ) + "</div>"
    outside = "".join(warning(f"{s['name']}: {s['outside_law']}") for s in run.wear if s["outside_law"])
    panels = [_panel(run, support) for support in _shown(run.wear)]
    left = f'<p class="soft">The {PICTURES_OF_MANY} of {len(run.wear)} supports with the shortest lives.</p>' if len(panels) < len(run.wear) else ""
    return section("Wear", note, outside, _supports(run.wear), _supports_themselves(run.wear), _tubes(run), _gap_opening(run), along, left + _EXPLANATION, *panels)
