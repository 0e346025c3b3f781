# SPDX-License-Identifier: GPL-3.0-or-later
"""Faults at every write of a run and of a sweep: faults_test.py FRETWORK LIBRARY STUDY [--long] [--parts PART ...] [--damaged N]

Each call that changes a file of the results folder fails in turn (failing_calls.cpp): once, from then on, as a full disk, as a broken one,
half done, or by the death of the process. After each the command is given again without a fault. A case is
- survived: the run with the fault ended with status 0 and its results are those of the run without,
- told: it ended with another status, a message and no crash; and the next command gave the results of the run without,
- wrong: anything else: other results with status 0 at any of the two, a crash, a hang (which have columns of their own too).
"""

import argparse
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
import tomllib
from collections import Counter
from pathlib import Path

LONGEST = 60  # s: a command that takes longer hangs; it takes a fifth of a second
STATUSES = {1, 2, -signal.SIGKILL}  # input or disk, computation, the fault "kill"; 3 would be a defect of the program
CHECKPOINTS = ["transient.step=1e-6", "output.checkpoint=0.01"]
SHORT = {"duration": 0.02, "kinds": [("ENOSPC", False), ("ENOSPC", True), ("kill", False)], "sweep_kinds": [("ENOSPC", False), ("kill", False)],
         "stride": 2, "damaged": 12, "reports": 3, "kills": 3}  # fmt: skip
ALL_KINDS = [("ENOSPC", False), ("ENOSPC", True), ("EIO", False), ("EIO", True), ("short", False), ("kill", False)]
LONG = {"duration": 0.2, "kinds": ALL_KINDS, "sweep_kinds": ALL_KINDS, "stride": 1, "damaged": 1000, "reports": 10, "kills": 50}
SWEEP = """
[sweep]
study = "{study}"
design = "grid"
[[sweep.variables]]
name = "gap"
key = "contacts.{contact}.gap"
values = [1.0e-4, 2.0e-4, -1.0]
"""


class Trial:
    """A results folder in a fresh place and the command that fills it."""

    def __init__(self, options, form, more=()):
        self.options = options
        self.temporary = tempfile.TemporaryDirectory(prefix="fretwork_faults_")
        self.root = Path(self.temporary.name)
        self.results = self.root / "results"
        self.count = self.root / "calls"
        self.command = [options.fretwork, "run", options.study, "-o", str(self.results)]
        for value in (f"transient.duration={form['duration']}", "output.statistics_from=0", *more):
            self.command += ["--set", value]

    def run(self, kind="", at=0, lasting=False, more=()):
        """Status and messages; a command that hangs is an error."""
        self.count.unlink(missing_ok=True)
        environment = dict(os.environ, LD_PRELOAD=self.options.library, FAULT_FOLDER=str(self.results), FAULT_AT=str(at), FAULT_KIND=kind,
                           FAULT_LASTING="1" if lasting else "0", FAULT_COUNT=str(self.count))  # fmt: skip
        done = subprocess.run([*self.command, *more], env=environment, capture_output=True, text=True, timeout=LONGEST, check=False)
        return done.returncode, done.stdout + done.stderr

    def kill(self, after, delay):
        """Starts the command and kills it `delay` seconds after the file `after` is there, or at once where it ends before."""
        job = subprocess.Popen(self.command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end = time.monotonic() + LONGEST
        while not after.exists() and job.poll() is None and time.monotonic() < end:
            time.sleep(0.001)
        time.sleep(delay)
        job.kill()
        return job.wait()

    def calls(self):
        return self.count.stat().st_size if self.count.exists() else 0

    def content(self):
        """What must be the same: the series to the last bit, the summary without timings."""
        summary = json.loads((self.results / "summary.json").read_text())
        for key in ("timings_s", "sha256", "notes"):
            summary.pop(key)
        return (self.results / "results.h5").read_bytes(), summary


class SweepTrial(Trial):
    """A sweep of three cases, one of which has a negative gap and no result."""

    def __init__(self, options, form):
        super().__init__(options, form)
        study = self.root / "sweep.toml"
        contact = tomllib.loads(Path(options.study).read_text())["contacts"][0]["name"]
        study.write_text(SWEEP.format(study=Path(options.study).resolve(), contact=contact))
        self.command[1:3] = ["sweep", str(study), "--no-report"]

    def content(self):
        """Table and summary, of which one holds no times; no part file is left."""
        left = [path for path in self.results.rglob("*") if ".part" in path.name]
        return [(self.results / name).read_bytes() for name in ("table.csv", "table.h5", "summary.json")], left


def judge(trial, reference, kind, at, lasting):
    try:
        status, said = trial.run(kind, at, lasting)
        if status == 0:
            return "survived" if trial.content() == reference else f"wrong: status 0 and other results: {said[-300:]}"
        if status not in STATUSES or (status > 0 and "fretwork: " not in said):
            return f"wrong: {'it crashed, ' if status < 0 else ''}status {status}: {said[-300:]}"
        status, said = trial.run()
        return "told" if status == 0 and trial.content() == reference else f"wrong: again: status {status}: {said[-300:]}"
    except subprocess.TimeoutExpired:
        return "wrong: it hangs"
    except (OSError, ValueError) as error:
        return f"wrong: {error}"


def count(outcomes, outcome, case, wrong):
    outcomes[outcome.split(":")[0]] += 1
    if outcome.startswith("wrong"):
        wrong.append(f"{case}: {outcome}")
        outcomes["hangs"] += "it hangs" in outcome
        outcomes["crashes"] += "it crashed" in outcome


def failing(make, kinds, form, what, table, wrong):
    """`make` gives trials."""
    trial = make()
    status, said = trial.run()
    if status != 0:
        sys.exit(said)
    reference, calls = trial.content(), trial.calls()
    for kind, lasting in kinds:
        outcomes = Counter()
        for at in range(1, calls + 1, form["stride"]):
            count(outcomes, judge(make(), reference, kind, at, lasting), f"{what}: {kind}{' lasting' if lasting else ''} at call {at} of {calls}", wrong)
        every = "every call" if form["stride"] == 1 else "every second call"
        table.append((f"{what}: {kind} at {every}{', and from then on' if lasting else ''}", outcomes))


def failing_runs(options, form, table, wrong):
    failing(lambda: Trial(options, form), form["kinds"], form, "run", table, wrong)


def failing_sweeps(options, form, table, wrong):
    failing(lambda: SweepTrial(options, form), form["sweep_kinds"], form, "sweep", table, wrong)


def damaged_files(options, form, table, wrong):
    """A byte, a block or the end of each file that is read back is changed; then `run` and `export`."""
    trial = Trial(options, form)
    trial.run()
    reference = trial.content()
    for name in ("modes.h5", "results.h5", "summary.json"):
        file, outcomes = trial.results / name, Counter()
        for case in range(form["damaged"]):
            whole = file.read_bytes()
            file.write_bytes(damaged(whole, case))
            if name == "modes.h5":
                (trial.results / "summary.json").unlink()  # else nothing is computed again, and it is not read
            outcome = judge_damage(trial, reference, name, case % form["reports"] == 0)
            file.write_bytes(whole)
            count(outcomes, outcome, f"{name}, damage {case}", wrong)
        table.append((f"{name} damaged", outcomes))


def random_kills(options, form, table, wrong):
    """A run with checkpoints is killed at random moments and given again: it goes on, to the results of a run without kills."""
    form = dict(form, duration=0.5)
    whole = Trial(options, form, CHECKPOINTS)
    started = time.monotonic()
    whole.run()
    longest = time.monotonic() - started
    reference, draw, outcomes = whole.content(), random.Random(1), Counter()
    for kill in range(form["kills"]):
        trial = Trial(options, form, CHECKPOINTS)
        ended = trial.kill(trial.root, draw.uniform(0.0, longest)) == 0
        try:
            status, said = trial.run()
            same = status == 0 and trial.content() == reference
            outcome = f"wrong: status {status}: {said[-300:]}" if not same else "survived" if ended else "told"
        except subprocess.TimeoutExpired:
            outcome = "wrong: it hangs"
        except (OSError, ValueError) as error:
            outcome = f"wrong: {error}"
        count(outcomes, outcome, f"kill {kill}", wrong)
    table.append(("kill at a random moment", outcomes))


def damaged_checkpoints(options, form, table, wrong):
    """A damaged checkpoint is told of and not used."""
    form = dict(form, duration=0.1)
    whole, trial = Trial(options, form, CHECKPOINTS), Trial(options, form, CHECKPOINTS)
    whole.run()
    reference, outcomes = whole.content(), Counter()
    file = trial.results / "checkpoint.h5"
    for _ in range(20):  # until one is killed between its first checkpoint and its end
        if trial.kill(file, 0.0) != 0 and file.exists():
            break
    content = file.read_bytes()
    for case in range(form["damaged"]):
        for left in ("summary.json", "results.h5"):
            (trial.results / left).unlink(missing_ok=True)
        file.write_bytes(damaged(content, case))
        try:
            status, said = trial.run(more=["--no-report"])
            told = "checkpoint.h5 is damaged" in said.replace("\n", " ")
            outcome = "told" if status == 0 and told and trial.content() == reference else f"wrong: status {status}: {said[-300:]}"
        except subprocess.TimeoutExpired:
            outcome = "wrong: it hangs"
        except (OSError, ValueError) as error:
            outcome = f"wrong: {error}"
        count(outcomes, outcome, f"checkpoint.h5, damage {case}", wrong)
    table.append(("checkpoint.h5 damaged", outcomes))


def damaged(whole, case):
    """A byte, 64 or 4096 of them changed, or the end cut off; spread over the file, the same in every run."""
    place = (case * 7919 * 31 + 13) % len(whole)
    end = min(len(whole), place + (1, 64, 4096, len(whole))[case % 4])
    return whole[:place] + (b"" if case % 4 == 3 else bytes(byte ^ 0x55 for byte in whole[place:end])) + whole[end:]


def judge_damage(trial, reference, name, report):
    """`report`: that it is refused is tried too."""
    try:
        refusing = {"export": "cannot be read"} if name == "results.h5" else {}
        if report and name != "modes.h5":
            refusing["report"] = "is not as it was written"
        for command, reason in refusing.items():
            done = subprocess.run([trial.options.fretwork, command, trial.results], capture_output=True, text=True, timeout=LONGEST, check=False)
            if done.returncode != 1 or reason not in done.stderr:
                return f"wrong: {'it crashed, ' if done.returncode < 0 else ''}{command}: status {done.returncode}: {done.stderr[-300:]}"
        status, said = trial.run(more=["--no-report"])
        if status != 0 or trial.content() != reference:
            return f"wrong: status {status}: {said[-300:]}"
        told = "modes.h5 is damaged" if name == "modes.h5" else f"{name} is not as it was written"
        if told not in said.replace("\n", " "):
            return f"wrong: not told: {said[-300:]}"
        return "told"
    except subprocess.TimeoutExpired:
        return "wrong: it hangs"


PARTS = {"runs": failing_runs, "sweeps": failing_sweeps, "files": damaged_files, "checkpoints": damaged_checkpoints, "kills": random_kills}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("fretwork")
    parser.add_argument("library")
    parser.add_argument("study")
    parser.add_argument("--long", action="store_true", help="every call, every kind of fault, a thousand damaged files of each kind")
    parser.add_argument("--damaged", type=int, help="damaged files of each kind")
    parser.add_argument("--parts", nargs="+", choices=PARTS, default=list(PARTS))
    options = parser.parse_args()
    form, table, wrong = dict(LONG if options.long else SHORT), [], []
    form["damaged"] = options.damaged or form["damaged"]
    for part in options.parts:
        PARTS[part](options, form, table, wrong)
    print("| fault | injected | survived | told | wrong | hangs | crashes |\n| --- | --- | --- | --- | --- | --- | --- |")
    for name, outcomes in table:
        injected = outcomes["survived"] + outcomes["told"] + outcomes["wrong"]
        print(f"| {name} | {injected} |", " | ".join(str(outcomes[key]) for key in ("survived", "told", "wrong", "hangs", "crashes")), "|")
    print("\n".join(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
