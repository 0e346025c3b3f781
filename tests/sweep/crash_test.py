# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases whose process ends: crash_test.py FRETWORK STUDY. A signal ends the processes that compute one case of a sweep; the sweep goes on, and the
case has its outcome. What ends a process once, from outside, is no outcome."""

import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

FRETWORK, STUDY = sys.argv.pop(1), sys.argv.pop(1)
ENDLESS = 1.0e7  # s, of the case that is ended: minutes of processor time
# s of processor time: a process takes a third of that to start, a case but the endless one a hundredth
BUSY = 1.2
SWEEP = f"""
[sweep]
study = "{STUDY}"
design = "grid"
[[sweep.variables]]
name = "duration"
key = "transient.duration"
values = [0.5, 0.6, {ENDLESS}, 0.7, 0.8, 0.9]
"""


class Crashes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="fretwork_crash_")
        self.addCleanup(self.folder.cleanup)
        self.study = Path(self.folder.name) / "sweep.toml"
        self.study.write_text(SWEEP)

    def start(self, directory, ranks, *more):
        command = [FRETWORK, "sweep", str(self.study), "-o", str(directory), "--no-report", "--set", "output.every=0.1", *more]
        if ranks:
            command = ["mpirun", "--oversubscribe", "-n", str(ranks), *command]
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def workers(self, directory):
        """Processes that compute cases, with their processor time in s."""
        found = subprocess.run(["pgrep", "-f", "--", f"sweep-cases .*{directory}/"], capture_output=True, text=True).stdout.split()
        out = {}
        for pid in map(int, found):
            try:
                fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
            except (FileNotFoundError, ProcessLookupError):
                continue
            out[pid] = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        return out

    def end_busy_workers(self, process, directory, by):
        """Until the sweep ends. Returns how many processes were ended."""
        ended = set()
        while process.poll() is None:
            for pid, seconds in self.workers(directory).items():
                if seconds > BUSY and pid not in ended:
                    os.kill(pid, by)
                    ended.add(pid)
            time.sleep(0.05)
        return len(ended)

    def swept(self, name, ranks, by):
        directory = Path(self.folder.name) / name
        process = self.start(directory, ranks)
        ended = self.end_busy_workers(process, directory, by)
        out, _ = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0, out)
        self.assertEqual(ended, 2, out)  # a case is tried once more, by itself
        self.assertIn("6 (grid), 5 done, 1 without a result", out)
        return directory

    def test_a_case_that_crashes_is_an_outcome_for_any_number_of_ranks(self):
        alone, two = self.swept("alone", 0, signal.SIGSEGV), self.swept("two", 2, signal.SIGSEGV)
        rows = (alone / "table.csv").read_text().splitlines()[1:]
        self.assertEqual([row.split(",")[1] for row in rows], ["done", "done", "crashed", "done", "done", "done"])
        self.assertIn("its process ended: signal 11 (SIGSEGV)", rows[2])
        for file in ("table.csv", "table.h5", "summary.json"):
            self.assertEqual((alone / file).read_bytes(), (two / file).read_bytes(), file)
        begin = (alone / "shards/1_of_1/rank_0.rows").read_bytes()
        again = self.start(alone, 0)  # the outcome is there: the case is not tried again
        out, _ = again.communicate(timeout=60)
        self.assertEqual(again.returncode, 0, out)
        self.assertEqual((alone / "shards/1_of_1/rank_0.rows").read_bytes(), begin)

    def test_a_process_that_is_killed_for_memory_is_an_outcome(self):
        self.assertIn("crashed", (self.swept("killed", 0, signal.SIGKILL) / "table.csv").read_text())

    def test_a_process_that_ends_once_changes_nothing(self):
        directory = Path(self.folder.name) / "once"
        shorter = ("--set", "sweep.variables.duration.values=[0.5, 2.0e5, 0.7]")  # of which the second takes some seconds
        process = self.start(directory, 0, *shorter)
        ended = 0
        while process.poll() is None:
            for pid, seconds in self.workers(directory).items():
                if ended == 0 and seconds > BUSY:
                    os.kill(pid, signal.SIGABRT)
                    ended += 1
            time.sleep(0.02)
        out, _ = process.communicate(timeout=60)
        self.assertEqual((process.returncode, ended), (0, 1), out)
        undisturbed = Path(self.folder.name) / "undisturbed"
        self.assertEqual(self.start(undisturbed, 0, *shorter).wait(), 0)
        self.assertEqual((directory / "table.csv").read_bytes(), (undisturbed / "table.csv").read_bytes())


if __name__ == "__main__":
    unittest.main()
