# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes report.html of a sweep, one file that needs nothing else, from its summary and its table: python3 -m fretwork.report.sweep DIR"""

import html
import json
import sys
from pathlib import Path

PRINCIPAL = ("worst.years", "worst.wear_depth", "worst.velocity_ratio", "worst.work_rate", "total.work_rate", "worst.normal_rms", "worst.normal_max")
MEASURES = ("total.work_rate", "worst.work_rate", "worst.normal_max")  # that pictures are about

MOST_PRINCIPAL = 8
ROUND_OFF = 1e-12  # of displacements, m, and forces, N


class Sweep:
    """What the folder holds: summary, columns of inputs and outputs by name."""

    def __init__(self, directory):
        import h5py

        from .run_data import verify

        self.directory = directory
        verify(directory, "table.h5")
        self.summary = json.loads((directory / "summary.json").read_text(encoding="utf-8"))
        with h5py.File(directory / "table.h5", "r") as file:
            self.inputs = {name.replace("%2F", "/"): column[...] for name, column in file["inputs"].items()}
            self.names = {key.removeprefix("values of ").replace("%2F", "/"): text.split("\n") for key, text in file.attrs.items() if key.startswith("values of ")}
            self.outputs = {name.replace("%2F", "/"): column[...] for name, column in file["outputs"].items()}
            self.cases = file["case/number"][...].astype(int)

    def abscissae(self):
        """m along the tube of each contact; none where one has none: the mesh is no open chain."""
        places = [contact.get("abscissa_m") for contact in self.summary.get("contacts", [])]
        return None if None in places else places

    @property
    def statistics(self):
        return self.summary.get("statistics")

    def unit(self, name):
        return self.summary["units"].get(name, "")

    def value(self, name, case):
        """The value of a variable as text."""
        number = float(self.inputs[name][case])
        return html.escape(self.names[name][int(number)].strip('"')) if name in self.names else figure_of(number)

    def principal(self):
        found = [name for name in PRINCIPAL if name in self.outputs]
        return found or [name for name, values in self.outputs.items() if not name.endswith(".error") and (abs(values) > ROUND_OFF).any()][:MOST_PRINCIPAL]  # without contacts


def figure_of(value):
    from . import drawing

    return html.escape(value) if isinstance(value, str) else drawing.short(value, 3)


def interval(entry):
    """With its interval: "3.2 (2.9 to 3.6)", with one end "3.2 (above 2.9)". An end that is a text (never) leaves the other side without a bound."""
    value, low, high = figure_of(entry["value"]), entry["low"], entry["high"]
    if low is not None and high is not None:
        return f"{value} ({figure_of(low)} to {figure_of(high)})"
    if low is not None and not isinstance(low, str):
        return f"{value} (above {figure_of(low)})"
    if high is not None and not isinstance(high, str):
        return f"{value} (below {figure_of(high)})"
    return value if isinstance(low, str) else f"{value} (no interval)"


def key_figures(sweep):
    from . import page

    entries = [("cases", sweep.summary["cases"]), ("done", sweep.summary["done"]), ("without a result", sweep.summary["rows"] - sweep.summary["done"])]
    out = page.cards([(name, f"{value}") for name, value in entries] + [("design", html.escape(sweep.summary["design"]))])
    if sweep.summary["rows"] < sweep.summary["cases"]:
        out += page.warning(f"{sweep.summary['cases'] - sweep.summary['rows']} cases have not been computed: the same command without --gather goes on.")
    return out + "".join(page.warning(text) for text in sweep.summary["warnings"])


def quantiles(sweep):
    from . import page

    if not sweep.statistics:
        return ""
    percent = round(100 * sweep.summary["confidence"], 6)
    first = sweep.statistics["outputs"][sweep.principal()[0]]["quantiles"]
    heads = ["output", *(f"{100 * q['probability']:g} %" for q in first), "windows"]
    rows = []
    for name in sweep.principal():
        output = sweep.statistics["outputs"][name]
        share = output.get("share_of_windows")
        label = html.escape(f"{name} [{sweep.unit(name)}]" if sweep.unit(name) else name)
        rows.append([label, *(interval(q) for q in output["quantiles"]), f"{100 * share:.0f} %" if share is not None else "–"])
    note = (
        f"<p class=soft>Quantiles over the cases. In brackets the interval at {percent:g} % confidence: what more draws would narrow. The distance "
        "between the quantiles is the uncertain input, which draws do not change. Windows: the part of the variance that the finite duration of the runs makes; "
        "longer runs would reduce it; at 100 % and more all that is seen is the finite duration.</p>"
    )
    return page.section("Quantiles", page.table(heads, rows), note, limits(sweep), convergence(sweep)) + first_supports(sweep)


def first_supports(sweep):
    """Which support is first, by shares of the cases."""
    from . import page

    found = sweep.statistics.get("first_support")
    if not found or not found["supports"] and not found.get("not_judged"):
        return ""
    percent = round(100 * sweep.summary["confidence"], 6)
    rows = [
        [html.escape(first["support"]), html.escape(first["body"]), f"{first['hits']}",
         f"{100 * first['share']:.0f} % ({100 * first['low']:.0f} to {100 * first['high']:.0f})"]
        for first in found["supports"]
    ]
    never = f" In {found['never']} of them nothing does." if found["never"] else ""
    if found.get("not_judged"):
        names = ", ".join(f"{html.escape(life['support'])}{' (the support)' if life['body'] == 'support' else ''} in {life['cases']}" for life in found["unknown"])
        never += (
            f" {found['not_judged']} of them are not judged: a life has no value there, outside its law or beyond its geometry ({names}). The upper ends of "
            "the intervals include these cases."
        )
    note = (
        f"<p class=soft>Where a limit of wear is reached first, over {found['cases']} cases.{never} In brackets the interval of the share at {percent:g} % "
        "confidence. The body is the tube, or the support itself.</p>"
    )
    return page.section("First to its limit", page.table(["support", "body", "cases", "share"], rows, (0, 1)), note)


def limits(sweep):
    out = ""
    for limit in sweep.statistics["limits"]:
        if "probability" in limit:
            side = "above" if limit["above"] else "below"
            out += (
                f"<p>Probability of {html.escape(limit['output'])} {side} {limit['value']:g} {html.escape(sweep.unit(limit['output']))}: "
                f"<b>{limit['probability']:.3g}</b> ({limit['low']:.3g} to {limit['high']:.3g}), {limit['hits']} of {limit['cases']} cases.</p>"
            )
    return out


def convergence(sweep):
    c = sweep.statistics["convergence"]
    quantile = f"{100 * c['quantile']:g} % quantile of {html.escape(c['output'])}"
    needed = f" About {c['cases_needed']} cases would make it {100 * c['relative_error']:g} %." if c["cases_needed"] and not c["reached"] else ""
    if c["error"] is None:
        return f"<p>Convergence: {c['cases']} cases give no interval of the {quantile}.{needed}</p>"
    return f"<p>Convergence: the {quantile} is known to ±{100 * c['error']:.2g} % with {c['cases']} cases.{needed}</p>"


def distributions(sweep):
    from . import page, sweep_view

    pictures = []
    for name in sweep.principal():
        known = sweep_view.finite(sweep.outputs[name])
        if len(known) < 2:
            continue
        lines = []
        if sweep.statistics:
            lines = [q["value"] for q in sweep.statistics["outputs"][name]["quantiles"] if isinstance(q["value"], float)]
        pictures.append(page.figure(sweep_view.histogram(known, sweep.unit(name), lines, name)))
    return page.section("Distributions", f'<div class="grid3">{"".join(pictures)}</div>') if pictures else ""


def measure(sweep):
    """The output that pictures are about: where nothing slides the largest force, of a study without contacts the first one."""
    if sweep.statistics:
        return sweep.statistics["convergence"]["output"]
    known = [name for name in MEASURES if name in sweep.outputs] or sweep.principal()[:2]
    moving = [name for name in known if (sweep.outputs[name] > 0).any()]
    return moving[0] if moving else (sweep.principal() or list(sweep.outputs))[0]


def sensitivities(sweep):
    from . import page, sweep_view

    of = measure(sweep)
    parts = []
    found = sweep.statistics["sensitivities"].get(of) if sweep.statistics else None
    if found:
        sobol = sweep.statistics["method"] == "sobol"
        entries = [(name, entry["value"], entry["low"], entry["high"]) for name, entry in found.items()]
        label = f"Sobol' index of first order of {of}" if sobol else f"rank correlation with {of}"
        parts.append(page.figure(sweep_view.tornado(entries, label), "The lines are intervals of confidence. Of true and false, true is the larger value; other listed texts have the order of their list."))
    pictures = [page.figure(sweep_view.scatter(x, sweep.outputs[of], (name, of), sweep.unit(of), sweep.names.get(name))) for name, x in sweep.inputs.items()]
    return page.section("Sensitivity", *parts, f'<div class="grid3">{"".join(pictures)}</div>')


def along(sweep):
    import numpy as np

    from . import page, sweep_view

    suffix = ".work_rate"
    names = [contact["name"] for contact in sweep.summary.get("contacts", [])]
    if not names:
        return ""
    values = np.column_stack([sweep.outputs[name + suffix] for name in names])
    if not np.isfinite(values).any():
        return ""
    note = "The line is the median over the cases, the bands hold 50 and 90 % of them. A contact that is inactive in a case does not count in it."
    by_name = page.figure(sweep_view.bands(names, values), note)
    abscissae = sweep.abscissae()
    if abscissae is None:
        return page.section("Work rate by contact", by_name)
    together = "Contacts at one place of the tube are taken together."
    picture = page.figure(sweep_view.bands_along(abscissae, values), f"{note} {together}")
    return page.section("Work rate along the tube", picture, page.figure(sweep_view.bands(names, values), "Contact by contact.") if len(names) > 1 else "")


def worst(sweep):
    import numpy as np

    from . import page

    of = sweep.summary.get("worst_by") or measure(sweep)
    values = sweep.outputs[of]
    order = [i for i in np.argsort(-np.nan_to_num(values, nan=-np.inf), kind="stable") if np.isfinite(values[i])][:10]
    rows = []
    for i in order:
        case = int(sweep.cases[i])
        kept = case in (sweep.summary.get("worst") or [])
        name = f'<a href="runs/case_{case}/report.html">case {case}</a>' if kept else f"case {case}"
        rows.append([name, figure_of(float(values[i])), *(sweep.value(variable, i) for variable in sweep.inputs)])
    heads = ["case", html.escape(f"{of} [{sweep.unit(of)}]"), *map(html.escape, sweep.inputs)]
    return page.section("Worst cases", page.table(heads, rows)) if rows else ""


def failures(sweep):
    from . import page

    rows = [[str(f["case"]), html.escape(f["outcome"]), html.escape(f["message"])] for f in sweep.summary["failures"]]
    return page.section("Cases without a result", page.table(["case", "outcome", "message"], rows, (0, 1, 2))) if rows else ""


def study(sweep):
    from . import page

    return page.section("Study", f"<pre>{html.escape(sweep.summary['study'])}</pre>")


def build(directory):
    """The report as HTML text."""
    from . import page

    sweep = Sweep(directory)
    parts = [key_figures, quantiles, distributions, sensitivities, along, worst, failures, study]
    title = sweep.summary["title"] or directory.resolve().stem
    subtitle = f"Sweep: results of Fretwork {html.escape(sweep.summary['version'])}"
    return page.page(title, subtitle, "".join(part(sweep) for part in parts))


def main():
    from . import build as run_report
    from . import run_data

    missing = run_report.missing_packages()
    if missing:
        return f"the report needs {' and '.join(missing)}, which {sys.executable} does not have: apt install {' '.join(missing)}"
    directory = Path(sys.argv[1])
    try:
        run_report.write_whole(directory / "report.html", build(directory))
    except (KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
        return f"{directory}: the results are not those of a sweep ({type(error).__name__}: {str(error)[:200]})"
    except run_data.NoResults as error:
        return str(error)
    except OSError as error:
        return f"the report cannot be written: {error}"
    return 0


if __name__ == "__main__":
    sys.exit(main())
