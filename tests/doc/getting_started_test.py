# SPDX-License-Identifier: GPL-3.0-or-later
"""The study of doc/getting-started.md runs as it is printed: getting_started_test.py FRETWORK ROOT (the program, of the tree)."""

import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(sys.argv.pop())
FRETWORK = sys.argv.pop()
TEXT = (ROOT / "doc/getting-started.md").read_text(encoding="utf-8")


class GettingStarted(unittest.TestCase):
    def test_the_smallest_study_runs(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "tube.geo").write_text(re.search(r"```\n(Point.*?)```", TEXT, flags=re.S)[1], encoding="utf-8")
            (folder / "study.toml").write_text(re.search(r"```toml\n(.*?)```", TEXT, flags=re.S)[1], encoding="utf-8")
            command = [FRETWORK, "run", str(folder / "study.toml"), "--set", "contacts.support.gap=3e-4"]
            done = subprocess.run(command, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            summary = json.loads((folder / "study.results/summary.json").read_text(encoding="utf-8"))
        self.assertGreater(summary["contacts"][0]["impacts"], 0)
        self.assertLess(summary["energy"]["residual_relative"], 0.01)

    def test_the_examples_named_exist(self):
        named = re.findall(r"`(examples/\w+)`", TEXT)
        self.assertGreater(len(named), 5)
        for example in named:
            self.assertTrue((ROOT / example / "study.toml").exists(), example)


if __name__ == "__main__":
    unittest.main()
