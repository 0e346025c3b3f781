# SPDX-License-Identifier: GPL-3.0-or-later
"""`check` and `run` agree: mutations_test.py FRETWORK EXAMPLES [--studies N] [--seed S] [--keep FOLDER]

Studies of the examples, shortened, with one to three mutations each: keys and tables removed, values out of range or of another type, names
of groups and of choices misspelt or exchanged, keys that do not exist, entries given twice. For each of them
- both refuse it with the same message, but for how long the run would take, or
- both take it, and `run` warns of all that `check` warns of; what becomes known in the course of the run (the energy balance, the size of
  the errors) `run` may warn of alone; or
- `check` takes it and it has no [transient]: it is for `modes`, `stability` and `response` alone; or
- `check` takes it and the computation itself fails (status 2: divergence, no convergence) or turns out to take too long; or
- `check` expects a little more than transient.max_hours, and `run` ends within it: times are measured.
Anything else, a crash or a hang is a disagreement."""

import argparse
import copy
import json
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import tomllib
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
from fretwork import write_study  # noqa: E402

LONGEST = 60  # s of processor time: a command that takes more hangs; max_hours ends the transient after some seconds
PATIENCE = 1200  # s on the clock, on a loaded machine
EXAMPLES = ["bundle", "bundle_flow", "cantilever_stop", "fuel_rod", "oscillator", "straight_tube", "tube_in_flow", "tube_study", "two_tubes", "u_bend", "u_bend_flow"]
MISSPELT, WORDS = ["x", "", "tub", "0", "a b", "ends"], ["auto", "all", "none", "circle", "plane_y", "stop_z", "splitting", "euler", "flow", "wall", "static", "rest"]
NUMBERS = [0, 0.0, -1.0, 1, -1, 1e-300, 1e300, 1e12, 1e-12, float("nan"), float("inf"), 7, 0.5, 2**62]
TYPES = ["text", True, [], [1.0], [1.0, 2.0, 3.0], [[0.0, 1.0], [1.0, 2.0]], {}, {"rms": 1.0}, 3, 2.5]
OF_VALUES = 0.75  # of the mutations: those that reach beyond the reading of the study
# said of runs as they turned out, which no check can know
OF_THE_RUN = ("the energy balance", "the coupled contact forces", "is off by", "error", "batches", "gave", "unstable", "verify", "steps", "samples", "beyond", "left out")


def short(study):
    """The study in a second or so."""
    modes, transient = study.setdefault("modes", {}), study["transient"]
    if modes.get("count", 0) > 60:
        modes["count"] = 60
    transient["duration"] = min(transient["duration"], 0.05)
    transient["max_hours"] = 0.002
    output = study.setdefault("output", {})
    output["every"] = min(output.get("every", 1e-3), 1e-3)
    output["statistics_from"] = min(output.get("statistics_from", 0.0), 0.01)
    return study


def places(value, path=()):
    """All (container, key, path) of a study."""
    for key in list(value) if isinstance(value, dict) else range(len(value)):
        yield value, key, (*path, key)
        if isinstance(value[key], (dict, list)):
            yield from places(value[key], (*path, key))


def groups_of(study):
    return [container[key] for container, key, _ in places(study) if key in ("group", "other", "from") and isinstance(container[key], str)]


def mutate(draw, study):
    """Changes one thing; says what."""
    # each table as likely as a long row of numbers
    by_depth = [place for place in places(study) if not (isinstance(place[1], int) and place[1] > 2)]
    container, key, path = draw.choice(by_depth)
    value, where = container[key], ".".join(map(str, path))
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    rough = ["remove", "type", "unknown"] + ["twice"] * isinstance(container, list)
    fine = ["number"] + ["scale"] * 5 if number else ["word", "group", "group"] if isinstance(value, str) else ["remove"]
    kind = draw.choice(fine if draw.random() < OF_VALUES else rough)
    if kind == "remove":
        del container[key]
        return f"{where} removed"
    if kind == "unknown":
        target = value if isinstance(value, dict) else container
        if not isinstance(target, dict):
            return mutate(draw, study)
        names = sorted({k for c, k, _ in places(study) if isinstance(k, str)})
        name = draw.choice([*names, draw.choice(names) + "s"])
        target[name] = draw.choice(NUMBERS + TYPES)
        return f"{name} = {target[name]!r} beside {where}"
    if kind == "twice":
        container.append(copy.deepcopy(value))
        return f"{where} given twice"
    if kind == "type":
        container[key] = copy.deepcopy(draw.choice(TYPES))
    elif kind == "number":
        container[key] = draw.choice(NUMBERS)
    elif kind == "scale":
        container[key] = value * draw.choice([-1.0, 0.0, 1e-6, 1e-3, 0.1, 0.5, 0.9, 2.0, 10.0, 1e3, 1e6])
    elif kind == "word":
        container[key] = draw.choice([value + "s", value[:-1], *MISSPELT, *WORDS])
    else:
        container[key] = draw.choice(groups_of(study) or MISSPELT)
    return f"{where} = {container[key]!r}"


def mutated(examples, seed, number):
    """The example, the changed study and what was changed: of the seed and the number alone."""
    draw = random.Random(f"{seed} {number}")
    example = EXAMPLES[number % len(EXAMPLES)]
    study = short(tomllib.loads((examples / example / "study.toml").read_text()))
    changes = [mutate(draw, study) for _ in range(draw.choice([1, 1, 1, 2, 3]))]
    return example, study, changes


def command(fretwork, *arguments):
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (LONGEST, LONGEST))

    return subprocess.run([fretwork, *map(str, arguments)], capture_output=True, text=True, timeout=PATIENCE, check=False, preexec_fn=limit)


def first_message(text):
    found = re.search(r"fretwork: .*", text, re.S)
    message = found.group().strip() if found else text.strip()
    # measured: each time another, and of the first steps or, where these were about the limit, of those after them
    return re.sub(r"transient: [^:]* would take \S+ (s|min|h),", "transient: a run would take #,", message)


def is_about_the_limit(message):
    """Whether it refuses a run that would take less than twice the time that it may."""
    found = re.search(r"would take (\S+) (s|min|h), more than transient.max_hours = ([^;]+);", message)
    return bool(found) and float(found[1]) * {"s": 1, "min": 60, "h": 3600}[found[2]] < 2 * 3600 * float(found[3])


def judge(fretwork, study, results):
    """(kind, detail)"""
    try:
        checked = command(fretwork, "check", study)
        run = command(fretwork, "run", study, "--no-report", "-o", results)
    except subprocess.TimeoutExpired as expired:
        return "disagree", f"{expired.cmd[1]} hangs"
    said = f"check {checked.returncode}: {checked.stderr[-300:]}\nrun {run.returncode}: {run.stderr[-300:]}"
    if not {checked.returncode, run.returncode} <= {0, 1, 2}:
        return "disagree", said
    if run.returncode == 0 and is_about_the_limit(checked.stderr):
        return "the computation fails", checked.stderr.strip()  # nearly
    if checked.returncode != 0:
        same = checked.returncode == run.returncode and first_message(checked.stderr) == first_message(run.stderr)
        return ("both refuse", "") if same else ("disagree", said)
    if run.returncode == 2 or "more than transient.max_hours" in run.stderr:
        return "the computation fails", first_message(run.stderr)
    if run.returncode == 1:
        return ("for modes alone", "") if "the study has no [transient]" in run.stderr else ("disagree", said)
    warnings = [line.removeprefix("  warning: ") for line in checked.stdout.splitlines() if line.startswith("  warning: ")]
    told = json.loads((results / "summary.json").read_text())["warnings"]
    return compare_warnings(warnings, told)


def words(text):
    return re.sub(r'"[^"]*"|[0-9.e+-]+', "#", text)


def compare_warnings(checked, run):
    checked_words, run_words = {words(text) for text in checked}, {words(text) for text in run}
    lost = [text for text in checked if words(text) not in run_words and "..." not in text and " contacts" not in text]
    late = [text for text in run if words(text) not in checked_words and not any(part in text for part in OF_THE_RUN)]
    if lost:
        return "disagree", f"run does not warn of: {lost}"
    return ("both take", "") if not late else ("both take, run warns more", str(late))


def one(options, number):
    example, study, changes = mutated(options.examples, options.seed, number)
    with tempfile.TemporaryDirectory(prefix="fretwork_mutation_") as name:
        folder = Path(name) / example
        shutil.copytree(options.examples / example, folder, ignore=shutil.ignore_patterns("*.results"))
        file = write_study(study, folder / "study.toml")
        kind, detail = judge(options.fretwork, file, folder / "results")
        if kind == "disagree" and options.keep:
            shutil.copytree(folder, Path(options.keep) / f"{options.seed}_{number}_{example}", dirs_exist_ok=True)
    return kind, f"{number} {example}: {'; '.join(changes)}\n{detail}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("fretwork")
    parser.add_argument("examples", type=Path)
    parser.add_argument("--studies", type=int, default=24)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int, help="one study")
    parser.add_argument("--keep", help="a folder for the studies that they disagree about")
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    numbers = range(options.studies) if options.only is None else [options.only]
    with ThreadPoolExecutor(2) as pool:
        outcomes = list(pool.map(lambda number: one(options, number), numbers))
    counts = Counter(kind for kind, _ in outcomes)
    for kind, detail in outcomes:
        if kind == "disagree" or options.verbose:
            print(f"{kind}: {detail}")
    print(f"{len(outcomes)} mutated studies of seed {options.seed}: " + ", ".join(f"{count} {kind}" for kind, count in sorted(counts.items())))
    return 1 if counts["disagree"] else 0


if __name__ == "__main__":
    sys.exit(main())
