# SPDX-License-Identifier: GPL-3.0-or-later
"""What differs between runs: inputs, frequencies, damping, stability, work rates, wear; each as rows of a table, the first run being the reference."""

import json
import math
import tomllib
from dataclasses import dataclass, field

import numpy as np

from . import run_data
from .drawing import ROUND_OFF, of_sum

FAMILY = 0.05  # chance that scatter makes any of the differences of a table significant
NORMAL = 1000.0  # degrees of freedom above which Student's distribution is the normal one
LEAST_FREEDOM = 2.0
SMALLEST_P = 1e-9  # that is shown
FREQUENCIES = 10
MOST_CONTACTS = 20  # in a table of impacts or forces
NO_CHANGE = 1e-6  # per cent
LARGE_CHANGE = 1000  # per cent, above which a change is given as a factor


@dataclass
class Table:
    title: str
    heads: list
    rows: list  # lists of texts
    runs: list = field(default_factory=list)  # for each column but the first, the number of the run that it is of
    note: str = ""


def number(value, digits=4):
    """As text, in full up to 10^6."""
    if value is None or not math.isfinite(value):
        return "never" if value == math.inf else "-"  # infinite: a life
    text = f"{value:.{digits}g}"
    return f"{float(text):.0f}" if "e" in text and 1 <= abs(value) < 1e6 else text


def with_error(value, error):
    if value is None or error is None or not math.isfinite(error):
        return number(value)
    return f"{number(value, 3)} +- {number(error, 1)}"


def _interval(figure, scale=1.0):
    """Ends of a figure of wear, {value, low, high}: "0.522 to 0.59"; an end without value is open."""
    low, high = ((None, None) if figure is None else (figure.get("low"), figure.get("high")))
    if figure is not None and figure.get("end") == "never" or (low is None and high is None):
        return "-"
    if low == high:
        return "-"
    if high is None:
        return f"above {number(scale * low, 3)}"
    return f"{number(scale * low, 3)} to {number(scale * high, 3)}" if low is not None else f"below {number(scale * high, 3)}"


def change(value, reference):
    """Of a value against that of the first run, per cent; a large one as the factor."""
    if value is None or not reference:
        return "-"
    per_cent = 100 * (value / reference - 1)
    if abs(per_cent) < NO_CHANGE:
        return "0 %"
    if per_cent > LARGE_CHANGE:
        return f"times {number(value / reference, 3)}"
    return f"{per_cent:+.0f} %" if abs(per_cent) >= 10 else f"{per_cent:+.2g} %"


def outside_student(t, freedom):
    """Chance that a variable of Student's distribution leaves +-t; with t = sqrt(freedom) cot(angle) it is the integral of sin(angle)^(freedom - 1)."""
    if freedom > NORMAL:
        return math.erfc(t / math.sqrt(2.0))
    half = 0.5 * math.atan2(math.sqrt(freedom), t)
    nodes, weights = np.polynomial.legendre.leggauss(64)
    integral = half * float(weights @ np.sin(half * (nodes + 1.0)) ** (freedom - 1.0))
    return 2.0 / math.sqrt(math.pi) * math.exp(math.lgamma(0.5 * freedom + 0.5) - math.lgamma(0.5 * freedom)) * integral


def _freedom(value, error, batches):
    """Degrees of freedom of a standard error (doc/wear.md, 3.2)."""
    if value == 0.0:
        return LEAST_FREEDOM
    inverse = (1.0 / (batches - 1.0) if batches else 0.0) + 0.5 * (error / value) ** 2
    return max(LEAST_FREEDOM, 1.0 / inverse) if inverse > 0.0 else math.inf


def chance(one, other):
    """p: the chance of a difference as large by scatter (B. L. Welch, Biometrika 34 (1947) 28), of two (value, standard error, batches behind it);
    a text where it is not known."""
    (a, a_error, a_batches), (b, b_error, b_batches) = one, other
    if None in (a, b):
        return "-"
    if a == b:
        return "equal"
    errors = [error for error in (a_error, b_error) if error is not None and math.isfinite(error)]
    if len(errors) < 2 or math.hypot(*errors) == 0:
        return "scatter unknown"
    parts = [(error * error / sum(e * e for e in errors), _freedom(value, error, batches)) for value, error, batches in (one, other) if error > 0.0]
    inverse = sum(share * share / freedom for share, freedom in parts)
    return outside_student(abs(b - a) / math.hypot(*errors), 1.0 / inverse if inverse > 0.0 else math.inf)


def holm(chances):
    """The largest p that is significant among those of differences that are judged at once; below 0: none is (S. Holm, Scand. J. Stat. 6 (1979) 65)."""
    found = -1.0
    for number, p in enumerate(sorted(chances)):
        if p > FAMILY / (len(chances) - number):
            break
        found = p
    return found


def significance(p, largest=FAMILY):
    """In words. largest: the p up to which differences are significant."""
    if isinstance(p, str):
        return p
    return ("significant" if p <= largest else "within scatter") + (f", p = {p:.1g}" if p >= SMALLEST_P else f", p < {SMALLEST_P:.0e}")


def _names(entries):
    """Of the entries of an array of tables: name or group; the number where that is none of its own."""
    names = [str(item.get("name", item.get("group", i))) for i, item in enumerate(entries)]
    return [name if names.count(name) == 1 else str(i) for i, name in enumerate(names)]


def _is_tables(value):
    return isinstance(value, list) and bool(value) and all(isinstance(item, dict) for item in value)


def _key(study, address):
    """An address of --set as _flat names it: loads.0.direction is loads.tube.direction."""
    parts, here = address.split("."), study
    for k, part in enumerate(parts):
        if _is_tables(here):
            names = _names(here)
            if part.isdecimal() and int(part) < len(here):
                parts[k] = names[int(part)]
            here = here[names.index(parts[k])] if parts[k] in names else None
        else:
            here = here.get(part) if isinstance(here, dict) else None
    return ".".join(parts)


def _flat(value, path=""):
    """Keys and values of a study; entries of arrays of tables by _names."""
    if isinstance(value, dict):
        return {key: item for name, inner in value.items() for key, item in _flat(inner, f"{path}.{name}" if path else name).items()}
    if _is_tables(value):
        return {key: item for name, inner in zip(_names(value), value) for key, item in _flat(inner, f"{path}.{name}").items()}
    return {path: value}


def inputs(run):
    """All keys of the study with overrides; what a sweep would vary is no input of a run."""
    study = tomllib.loads(run.attributes["study"])
    keys = _flat(study)
    for override in run.summary.get("overrides", []):
        key = _key(study, override["key"])
        keys.pop(key, None)
        keys.update(_flat(override["value"], key))
    return {key: value for key, value in keys.items() if not key.startswith("sweep.")}


def _as_written(value):
    """As a study has it, texts without their quotes."""
    return "-" if value is None else value if isinstance(value, str) else json.dumps(value, default=str, ensure_ascii=False)


def differing_inputs(runs, names):
    studies = [inputs(run) for run in runs]
    rows = []
    for key in sorted(set().union(*studies)):
        values = [study.get(key) for study in studies]
        if any(value != values[0] for value in values):
            rows.append([key, *map(_as_written, values)])
    return Table("Inputs that differ", ["key", *names], rows, [*range(len(names))])


def frequencies(runs, names):
    lists = [run.summary["modes"]["frequencies_hz"] for run in runs]
    rows = []
    for i in range(min(FREQUENCIES, max(map(len, lists)))):
        values = [found[i] if i < len(found) else None for found in lists]
        rows.append([f"{i + 1}", *(number(v, 6) for v in values), *(change(v, values[0]) for v in values[1:])])
    return Table("Frequencies, Hz", ["mode", *names, *(f"change, {name}" for name in names[1:])], rows, [*range(len(names)), *range(1, len(names))])


def damping(runs, names):
    """Ratios of the lowest modes, where those of some runs differ."""
    lists = [[math.inf if ratio is None else 100 * ratio for ratio in run.summary["modes"]["damping"]] for run in runs]
    rows = []
    for i in range(min(FREQUENCIES, max(map(len, lists)))):
        values = [found[i] if i < len(found) else None for found in lists]
        rows.append([f"{i + 1}", *(number(v) for v in values), *(change(v, values[0]) for v in values[1:])])
    differ = any(len(set(row[1 : 1 + len(names)])) > 1 for row in rows)
    return Table("Damping of the modes, % of critical", ["mode", *names, *(f"change, {name}" for name in names[1:])], rows if differ else [],
                 [*range(len(names)), *range(1, len(names))])


def _velocity_ratios(run):
    """By assessment, the largest V/Vc over its modes and constants, none where the flow moves no mode; with several tubes by tube too."""
    found = run.summary.get("stability", [])
    several = len({entry["tube"] for entry in found}) > 1
    return {entry["name"] + (f", {entry['tube']}" if several else ""): max((1 - case["margin"] for case in entry["cases"] if case["margin"] is not None and case["critical_mode"] is not None), default=None)
            for entry in found}


def stability(runs, names):
    """V/Vc by Connors of the assessments of each run."""
    tables = [_velocity_ratios(run) for run in runs]
    rows = []
    for name in dict.fromkeys(name for found in tables for name in found):
        values = [found.get(name) for found in tables]
        rows.append([name, *(number(v) for v in values), *(change(v, values[0]) for v in values[1:])])
    return Table("Stability, V/Vc (1 and above: unstable)", ["assessment", *names, *(f"change, {name}" for name in names[1:])], rows,
                 [*range(len(names)), *range(1, len(names))])


def _work(entry):
    """Value, standard error and the batches behind it."""
    error = entry.get("standard_error", {})
    return of_sum(entry["work_rate"]), of_sum(error.get("work_rate")), error.get("work_rate_batches")


def work_rates(runs, names):
    """Of all contacts together, then of each, by name; contacts that some run has not are left to it."""
    tables = [{"all contacts": run.summary["contact_sums"], **{c["name"]: c for c in run.summary["contacts"]}}
              if "contact_sums" in run.summary else {} for run in runs]
    order = list(dict.fromkeys(name for found in tables for name in found))
    works = {name: [_work(found[name]) if name in found else (None, None, None) for found in tables] for name in order}
    chances = {name: [chance(values[0], value) for value in values[1:]] for name, values in works.items()}
    judged = [p for ps in chances.values() for p in ps if not isinstance(p, str)]
    largest = holm(judged)
    rows = []
    for name, values in works.items():
        rows.append([name, *(with_error(value, error) for value, error, _ in values)]
                    + [text for value, p in zip(values[1:], chances[name]) for text in (change(value[0], values[0][0]), significance(p, largest))])
    heads = ["contact", *names] + [text for name in names[1:] for text in (f"change, {name}", "significance")]
    counted = f"{len(judged)} difference{'s' if len(judged) > 1 else ''}"
    note = f"significant: by scatter any of {counted} in at most {100 * FAMILY:g} % of comparisons (Holm); p: of one alone" if judged else ""
    return Table("Work rates, W", heads, rows, [*range(len(names)), *(k for k in range(1, len(names)) for _ in range(2))], note)


def _statistic(contact, *keys):
    """Value, standard error and the batches behind it."""
    value, error = contact, contact.get("standard_error", {})
    for key in keys:
        value, error = value[key], error.get(key) if isinstance(error, dict) else None
    return of_sum(value), of_sum(error), contact.get("standard_error", {}).get("batches")


def _statistics(runs, names, title, *keys):
    """Of contacts by name, those with the largest work rates in any run; a change that is more than scatter is called significant (as work rates are judged)."""
    tables = [{c["name"]: c for c in run.summary.get("contacts", [])} for run in runs]
    every = list(dict.fromkeys(name for found in tables for name in found))
    shown = sorted(every, key=lambda name: -max(found[name]["work_rate"] or 0.0 for found in tables if name in found))[:MOST_CONTACTS]
    figures = {name: [_statistic(found[name], *keys) if name in found else (None, None, None) for found in tables] for name in every if name in shown}
    chances = {name: [chance(values[0], value) for value in values[1:]] for name, values in figures.items()}
    largest = holm([p for ps in chances.values() for p in ps if not isinstance(p, str)])
    rows = []
    for name, values in figures.items():
        changes = [change(value[0], values[0][0]) + (", significant" if not isinstance(p, str) and p <= largest else "") for value, p in zip(values[1:], chances[name])]
        rows.append([name, *(with_error(value, error) for value, error, _ in values), *changes])
    note = f"the {len(shown)} of {len(every)} contacts with the largest work rates" if len(shown) < len(every) else ""
    return Table(title, ["contact", *names, *(f"change, {name}" for name in names[1:])], rows, [*range(len(names)), *range(1, len(names))], note)


def impact_rates(runs, names):
    return _statistics(runs, names, "Impacts per second", "impacts_per_second")


def rms_forces(runs, names):
    return _statistics(runs, names, "Normal force, rms, N", "normal_force", "rms")


def largest_forces(runs, names):
    return _statistics(runs, names, "Normal force, largest, N", "normal_force", "max")


def _wear(run, of=""):
    """Depth, m, and life by support; of: "support_", what the supports themselves lose, of those that wear."""

    def life(support):
        life = support[f"{of}life_years"] or {"end": None, "value": None}
        years = life["value"]
        return math.inf if life["end"] == "never" or (years is not None and years > 1 / ROUND_OFF) else years

    def wears(support):
        worn = support["support_depth_m"]  # its value is none beyond the geometry
        return not of or support["support_life_years"] or (worn and worn["value"] != 0)

    depth = f"{of}depth_m"
    return {s["name"]: (of_sum(s[depth]["value"]) if s[depth] else None, life(s)) for s in run.summary.get("wear", {}).get("supports", []) if wears(s)}


def _after(runs, of=""):
    """The years of the depths compared: " after 10 and 40 years"."""
    years = sorted({support["years"] for run in runs for support in run.summary.get("wear", {}).get("supports", []) if support["name"] in _wear(run, of)})
    figures = [number(value) for value in years]
    return f" after {' and '.join(filter(None, [', '.join(figures[:-1]), figures[-1]]))} years" if figures else ""


def wear(runs, names):
    return _worn("Wear" + _after(runs), [_wear(run) for run in runs], names)


def wear_of_supports(runs, names):
    return _worn("Wear of the supports themselves" + _after(runs, "support_"), [_wear(run, "support_") for run in runs], names)


def _intervals(runs, names, title, of=""):
    """Of depth and life, of the supports whose wear is compared; none where no run has intervals."""
    tables = []
    for run in runs:
        found = {s["name"]: s for s in run.summary.get("wear", {}).get("supports", [])}
        tables.append({name: found[name] for name in _wear(run, of)})
    rows = []
    for name in dict.fromkeys(name for found in tables for name in found):
        entries = [found.get(name, {}) for found in tables]
        rows.append([name, *(_interval(entry.get(f"{of}depth_m"), 1e3) for entry in entries), *(_interval(entry.get(f"{of}life_years")) for entry in entries)])
    if all(cell == "-" for row in rows for cell in row[1:]):
        rows = []
    return Table(title, ["support", *(f"depth mm, {n}" for n in names), *(f"life years, {n}" for n in names)], rows, [*range(len(names)), *range(len(names))])


def wear_intervals(runs, names):
    return _intervals(runs, names, "Intervals of wear")


def wear_intervals_of_supports(runs, names):
    return _intervals(runs, names, "Intervals of wear of the supports themselves", "support_")


def _worn(title, tables, names):
    order = list(dict.fromkeys(name for found in tables for name in found))
    rows = []
    for name in order:
        values = [found.get(name, (None, None)) for found in tables]
        depths = [None if depth is None else 1e3 * depth for depth, _ in values]
        rows.append([name, *(number(d, 3) for d in depths), *(change(d, depths[0]) for d in depths[1:]), *(number(life, 3) for _, life in values)])
    heads = ["support", *(f"depth mm, {n}" for n in names), *(f"change, {n}" for n in names[1:]), *(f"life years, {n}" for n in names)]
    return Table(title, heads, rows, [*range(len(names)), *range(1, len(names)), *range(len(names))])


def short_names(directories):
    """The last part of each folder's path, the whole path where that is the same for two."""
    last = [directory.resolve().name for directory in directories]
    return [name if last.count(name) == 1 else str(directory) for name, directory in zip(last, directories)]


def tables(directories):
    """The runs, and what differs.

    @param directories  pathlib.Path of each   @throws run_data.NoResults
    """
    runs = [run_data.load(directory) for directory in directories]
    return runs, differences(runs, short_names(directories))


def differences(runs, names):
    found = [compare(runs, names) for compare in (differing_inputs, frequencies, damping, stability, work_rates, impact_rates, rms_forces, largest_forces, wear, wear_intervals, wear_of_supports, wear_intervals_of_supports)]
    return [table for table in found if table.rows or table.title == "Inputs that differ"]
