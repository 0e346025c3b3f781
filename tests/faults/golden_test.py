# SPDX-License-Identifier: GPL-3.0-or-later
"""The same results as ever: golden_test.py FRETWORK EXAMPLES [--renew] [--compare OTHER]

The examples, shortened, give the hashes of golden.json, which has a row for each instruction set. Hashed are the datasets of results.h5, not
its attributes: no time, no path, no text of the study. They hold for Debian 12's g++ and libraries. A change of numerics changes them:
--renew writes the row of this machine; commit it with the change that explains it. A machine without a row skips (status 77).
--compare: the numbers of another build of the program (another compiler) agree before small differences have grown.
"""

import argparse
import hashlib
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy

SKIPPED = 77
TABLE = Path(__file__).with_name("golden.json")
AGREE = 1e-9  # relative to the largest value of a series: round-off of other compilers, before impacts amplify it
BEFORE_CHAOS = {"cantilever_stop": 0.1, "oscillator": 1.0, "straight_tube": 0.02, "two_tubes": 0.02, "u_bend": 0.01}  # s
DURATION = {"bundle": 0.05, "bundle_flow": 0.02, "cantilever_stop": 0.1, "oscillator": 1.0, "straight_tube": 0.05, "tube_in_flow": 0.02, "two_tubes": 0.02, "u_bend": 0.01, "u_bend_flow": 0.02}  # s
# LAPACK's kernels follow the processor, whatever the program was compiled for: one that all of x86-64 has
ENVIRONMENT = dict(os.environ, OPENBLAS_CORETYPE="Prescott", OMP_NUM_THREADS="1")


def results_of(fretwork, study, duration, folder):
    command = [fretwork, "run", study, "--no-report", "-o", folder]
    for key in (f"transient.duration={duration}", "output.statistics_from=0", f"output.every={duration / 100}"):
        command += ["--set", key]
    done = subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, timeout=120, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    data = {}
    with h5py.File(Path(folder) / "results.h5") as file:
        file.visititems(lambda name, item: data.update({name: item[...]}) if isinstance(item, h5py.Dataset) else None)
    return data, json.loads((Path(folder) / "summary.json").read_text())["vector_width"]


def digest(data):
    sha = hashlib.sha256()
    for name in sorted(data):
        sha.update(f"{name} {data[name].dtype} {data[name].shape}\n".encode())
        sha.update(numpy.ascontiguousarray(data[name]).tobytes())
    return sha.hexdigest()


def hashes(options):
    found, width = {}, ""
    for name, duration in DURATION.items():
        with tempfile.TemporaryDirectory(prefix="fretwork_golden_") as folder:
            data, width = results_of(options.fretwork, options.examples / name / "study.toml", duration, folder)
            found[name] = digest(data)
    return width, found


def compare(options):
    """Series of contacts and nodes against those of the other build. Modes differ by rounding within groups of equal frequencies."""
    wrong = 0
    for name, duration in BEFORE_CHAOS.items():
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as two:
            study = options.examples / name / "study.toml"
            ours, _ = results_of(options.fretwork, study, duration, one)
            others, _ = results_of(options.compare, study, duration, two)
        worst = 0.0
        for key in (key for key in ours if key.endswith(("displacement", "normal_force")) and not key.startswith("modal")):
            scale = float(numpy.abs(ours[key]).max(initial=0.0))
            if scale > 0.0:
                worst = max(worst, float(numpy.abs(ours[key] - others[key]).max()) / scale)
        print(f"| {name} | {duration} | {worst:.1e} |")
        wrong += worst > AGREE
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("fretwork")
    parser.add_argument("examples", type=Path)
    parser.add_argument("--renew", action="store_true")
    parser.add_argument("--compare", help="another build of the program")
    options = parser.parse_args()
    if options.compare:
        return compare(options)
    width, found = hashes(options)
    table = json.loads(TABLE.read_text()) if TABLE.exists() else {}
    if options.renew:
        TABLE.write_text(json.dumps({**table, width: found}, indent=2, sort_keys=True) + "\n")
        return 0
    if width not in table:
        print(f"golden.json has no row for {width}: golden_test.py --renew on this machine adds it")
        return SKIPPED
    for name in sorted(found.keys() - table[width].keys()):
        print(f"{name}: golden.json has no hash for {width}: golden_test.py --renew on this machine adds it")
    changed = [name for name in found if found[name] != table[width].get(name, found[name])]
    for name in changed:
        print(f"{name}: other results than those of golden.json; where that is meant, golden_test.py --renew writes their hashes")
    return 1 if changed else 0


if __name__ == "__main__":
    sys.exit(main())
