# SPDX-License-Identifier: GPL-3.0-or-later
"""Sweeps that are killed: resume_test.py FRETWORK STUDY [KILLS]. Each is killed at a random moment, goes on with another number of ranks, and
has the same bytes in the end as one that nobody disturbed."""

import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

FRETWORK, STUDY = sys.argv.pop(1), sys.argv.pop(1)
KILLS = int(sys.argv.pop(1)) if len(sys.argv) > 1 else 4
CASES = 400
SWEEP = f"""
[sweep]
study = "{STUDY}"
design = "monte_carlo"
draws = {CASES}
[[sweep.variables]]
name = "speed"
key = "initial.0.velocity.0"
uniform = {{ from = 0.5, to = 1.5 }}
"""


class Sweeps(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="fretwork_sweep_")
        self.addCleanup(self.folder.cleanup)
        self.study = Path(self.folder.name) / "sweep.toml"
        self.study.write_text(SWEEP)

    def start(self, directory, ranks, *more):
        command = ["mpirun", "--oversubscribe", "-n", str(ranks), FRETWORK, "sweep", str(self.study), "-o", str(directory), "--no-report", *more]
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)

    def run_whole(self, directory, ranks, *more):
        process = self.start(directory, ranks, *more)
        out, _ = process.communicate(timeout=600)
        self.assertEqual(process.returncode, 0, out)
        return out

    def rows(self, directory):
        return sum(len(file.read_bytes().splitlines()) for file in directory.glob("shards/*/*.rows"))

    def kill(self, process, directory):
        """All processes of a sweep, ranks first: they hold the folder."""
        ranks = subprocess.run(["pgrep", "-f", "--", f"fretwork sweep .*{directory}"], capture_output=True, text=True).stdout.split()
        for pid in [*ranks, str(process.pid)]:
            try:
                os.kill(int(pid), signal.SIGKILL)
            except ProcessLookupError:
                pass
        process.communicate()
        for pid in ranks:
            while os.path.exists(f"/proc/{pid}") and "Z" not in Path(f"/proc/{pid}/stat").read_text().split(")")[-1].split()[0]:
                time.sleep(0.01)

    def assert_same(self, one, two):
        for name in ("table.csv", "table.h5", "summary.json"):
            self.assertEqual((one / name).read_bytes(), (two / name).read_bytes(), name)

    def test_killed_sweeps_go_on_and_have_the_same_bytes(self):
        whole, killed = (Path(self.folder.name) / name for name in ("whole", "killed"))
        begin = time.monotonic()
        self.run_whole(whole, 1)
        duration = time.monotonic() - begin
        moments = random.Random(1)
        for kill in range(KILLS):
            process = self.start(killed, 1 + kill % 3)
            time.sleep(moments.uniform(0.1, 0.9) * duration)
            self.kill(process, killed)
        self.run_whole(killed, 2)
        self.assert_same(whole, killed)

    def test_a_sweep_that_is_ended_says_how_far_it_came(self):
        for by, name, more, cases in ((signal.SIGTERM, "SIGTERM", [], "100 000"), (signal.SIGINT, "Ctrl-C (SIGINT)", [], "100 000"),
                                      (signal.SIGTERM, "SIGTERM", ["--shard", "2/4"], "25 000")):
            directory = Path(self.folder.name) / f"{name} of {cases}"
            command = [FRETWORK, "sweep", str(self.study), "-o", str(directory), "--no-report", "--set", "sweep.draws=100000", *more]
            process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            while self.rows(directory) < 5 and process.poll() is None:
                time.sleep(0.01)
            process.send_signal(by)
            out, _ = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 2, out)
            self.assertRegex(out, f"ended by {re.escape(name)}: [0-9 ]+ of {cases} cases are there; the same command goes on")
            said = int(re.search(r": ([0-9 ]+) of", out)[1].replace(" ", ""))
            self.assertLessEqual(abs(self.rows(directory) - said), 1)

    def test_a_corrupt_row_is_found_and_computed_again(self):
        whole, damaged = (Path(self.folder.name) / name for name in ("whole", "damaged"))
        self.run_whole(whole, 1, "--set", "sweep.draws=20")
        self.run_whole(damaged, 2, "--set", "sweep.draws=20")
        file = max(damaged.glob("shards/*/*.rows"), key=lambda rows: rows.stat().st_size)  # on a busy machine a rank may have one row
        lines = file.read_bytes().splitlines(keepends=True)
        lines[1] = lines[1].replace(b" done ", b" done 1", 1)
        lines[2] = lines[2][:40]  # and the end of one
        file.write_bytes(b"".join(lines))
        out = self.run_whole(damaged, 3, "--set", "sweep.draws=20")
        self.assertIn("not as written", out)
        self.assertIn(f"{file}:2", out)
        self.assert_same(whole, damaged)

    def test_nothing_is_computed_twice(self):
        directory = Path(self.folder.name) / "once"
        self.run_whole(directory, 2, "--set", "sweep.draws=30")
        self.run_whole(directory, 1, "--set", "sweep.draws=30")
        self.assertEqual(self.rows(directory), 30)
        self.run_whole(directory, 2, "--set", "sweep.draws=45")  # more draws: the first ones are there
        self.assertEqual(self.rows(directory), 45)


if __name__ == "__main__":
    unittest.main()
