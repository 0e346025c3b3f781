# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of a sweep: report_test.py FRETWORK STUDY. It is whole HTML, shows every section, and holds names of the user as text only."""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2] / "python"))
from fretwork.report import sweep, sweep_view  # noqa: E402

FRETWORK, STUDY = sys.argv.pop(1), sys.argv.pop(1)
HOSTILE = "<script>alert(1)</script>&"
VARIABLES = f"""
[[sweep.variables]]
name = "{HOSTILE}"
key = "initial.0.velocity.0"
uniform = {{ from = 0.5, to = 1.5 }}
[[sweep.variables]]
name = "gap"
key = "contacts.stop.gap"
values = [0.0, 1e-3, -1.0]
"""
VOID = {"meta", "path", "rect", "circle", "polyline", "br"}


class Checker(HTMLParser):
    def __init__(self):
        super().__init__()
        self.stack, self.problems, self.counts, self.links = [], [], {}, []

    def handle_starttag(self, tag, attributes):
        self.counts[tag] = self.counts.get(tag, 0) + 1
        self.links += [value for name, value in attributes if name == "href"]
        if tag not in VOID:
            self.stack.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.counts[tag] = self.counts.get(tag, 0) + 1

    def handle_endtag(self, tag):
        if not self.stack or self.stack.pop() != tag:
            self.problems.append(tag)


class Report(unittest.TestCase):
    def report_of(self, text, base=STUDY, variables=VARIABLES, *overrides):
        folder = tempfile.TemporaryDirectory(prefix="fretwork_sweep_")
        self.addCleanup(folder.cleanup)
        self.directory = Path(folder.name) / "out"
        study = Path(folder.name) / "sweep.toml"
        study.write_text(f'[sweep]\nstudy = "{base}"\n{text}{variables}')
        settings = [word for text in overrides for word in ("--set", text)]
        done = subprocess.run([FRETWORK, "sweep", str(study), "-o", str(self.directory), *settings], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.page = (self.directory / "report.html").read_text()
        checker = Checker()
        checker.feed(self.page)
        self.assertEqual((checker.problems, checker.stack), ([], []))
        return checker

    def test_statistics_pictures_worst_cases_and_failures(self):
        checker = self.report_of('draws = 60\nkeep = "worst 2"\nlimits = [{ output = "stop.normal_max", above = 1e4 }]\n')
        for title in ("Quantiles", "Distributions", "Sensitivity", "Work rate by contact", "Worst cases", "Cases without a result", "Study"):
            self.assertIn(f"<h2>{title}</h2>", self.page)
        self.assertEqual(checker.counts["script"], 1)  # the page's own: no interactive picture
        self.assertEqual(self.page.count('class="grid3"'), 2)  # on paper a row does not wrap: six histograms would be too small to read
        self.assertNotIn(HOSTILE, self.page)
        self.assertIn("&lt;script&gt;", self.page)
        kept = json.loads((self.directory / "summary.json").read_text())["worst"]
        self.assertEqual([link for link in checker.links if link.startswith("runs/")], [f"runs/case_{case}/report.html" for case in kept])
        for case in kept:
            self.assertTrue((self.directory / f"runs/case_{case}/report.html").exists())

    def test_work_rate_along_a_tube_is_shown_by_abscissa(self):
        tube = Path(STUDY).parent.parent / "straight_tube/study.toml"
        variables = '[[sweep.variables]]\nname = "gap"\nkey = "contacts.support.gap"\nuniform = { from = 1e-4, to = 3e-4 }\n'
        self.report_of("draws = 5\n", tube, variables, "transient.duration=0.1", "output.statistics_from=0")
        self.assertIn("<h2>Work rate along the tube</h2>", self.page)
        self.assertIn("abscissa along the tube [m]", self.page)
        contacts = json.loads((self.directory / "summary.json").read_text())["contacts"]
        self.assertEqual([contact["name"] for contact in contacts], [f"support[{i}]" for i in range(8)])
        for i, contact in enumerate(contacts):
            self.assertAlmostEqual(contact["abscissa_m"], 1.0 + i)  # one each metre

    def test_shares_of_the_support_that_is_first(self):
        tube = Path(STUDY).parent.parent / "tube_study/study.toml"
        variables = '[[sweep.variables]]\nkey = "turbulence.*.seed"\nseeds = 1\n'
        self.report_of("draws = 6\n", tube, variables, "transient.duration=0.1", "output.statistics_from=0")
        self.assertIn("<h2>First to its limit</h2>", self.page)
        found = json.loads((self.directory / "summary.json").read_text())["statistics"]["first_support"]
        self.assertEqual(found["cases"], 6)
        rows = [line.split(",") for line in (self.directory / "table.csv").read_text().splitlines()]
        lives = [i for i, head in enumerate(rows[0]) if head.split(" ")[0].endswith(".years") and not head.startswith("worst.")]
        firsts = [min(lives, key=lambda i: float(row[i])) for row in rows[1:] if any(float(row[i]) < float("inf") for i in lives)]
        for first in found["supports"]:
            place = next(i for i in lives if rows[0][i].startswith(first["support"] + ".years"))
            self.assertEqual((first["hits"], first["body"]), (firsts.count(place), "tube"))
            self.assertIn(f'<td class="text">{first["support"]}</td>', self.page)
        self.assertEqual(sum(first["hits"] for first in found["supports"]) + found["never"], 6)

    def test_cases_whose_lives_are_not_all_known_are_not_judged(self):
        """support[1] wears outside of its law; where support[0] is inactive it has no life, which leaves nothing unknown."""
        tube = Path(STUDY).parent.parent / "straight_tube/study.toml"
        own = tempfile.TemporaryDirectory(prefix="fretwork_sweep_")
        self.addCleanup(own.cleanup)
        study = Path(own.name) / "tube.toml"
        wears = "".join(f'[[wear]]\nname = "{number}"\ncontacts = ["support[{number}]"]\nlength = 0.02\n{law}\n'
                        for number, law in enumerate(("coefficient = 1e-13", 'law = "edf_mz"\nstates = [{ share = 1, work_rate = 1e-4 }]', "coefficient = 2e-13")))
        study.write_text(re.sub(r'file = "(.*)"', rf'file = "{tube.parent}/\1"', tube.read_text()) + wears)
        variables = '[[sweep.variables]]\nname = "out"\nkey = "contacts.support.inactive"\nvalues = [["support[0]"], ["support[1]"], ["support[0]", "support[1]"]]\n'
        self.report_of("draws = 12\nseed = 3\n", study, variables, "transient.duration=0.1", "output.statistics_from=0")
        table = [line.split(",") for line in (self.directory / "table.csv").read_text().splitlines()]
        place = next(i for i, head in enumerate(table[0]) if head.startswith("support[1].work_rate"))
        acting = sum(row[place] != "nan" for row in table[1:])
        self.assertTrue(0 < acting < 12)
        found = json.loads((self.directory / "summary.json").read_text())["statistics"]["first_support"]
        self.assertEqual((found["cases"], found["not_judged"]), (12, acting))
        self.assertEqual(found["unknown"], [{"support": "support[1]", "body": "tube", "cases": acting}])
        self.assertEqual(sum(first["hits"] for first in found["supports"]) + found["never"], 12 - acting)
        self.assertIn(f"{acting} of them are not judged", self.page)

    def test_intervals_of_one_end_are_in_words(self):
        self.assertEqual(sweep.interval({"value": 3.0, "low": None, "high": 5.97}), "3 (below 5.97)")
        self.assertEqual(sweep.interval({"value": 3.0, "low": 1.5, "high": None}), "3 (above 1.5)")
        self.assertEqual(sweep.interval({"value": "never", "low": "never", "high": None}), "never")
        self.assertEqual(sweep.interval({"value": 3.0, "low": None, "high": "never"}), "3 (no interval)")
        self.report_of("draws = 8\nquantiles = [0.1, 0.5, 0.95]\n")
        self.assertNotIn("(– to", self.page)
        self.assertIn("(below ", self.page)
        self.assertIn("(above ", self.page)

    def test_contacts_at_one_place_are_taken_together(self):
        nan = float("nan")
        values = np.array([[1.0, 2.0, nan], [1.0, nan, nan]])
        pictures = sweep_view.bands_along([0.5, 0.5, 2.0], values), sweep_view.bands_along([0.5, 2.0], np.array([[3.0, nan], [1.0, nan]]))
        page, of_sums = (re.sub(r"clip\d+", "clip", picture) for picture in pictures)
        self.assertEqual(page, of_sums)
        self.assertEqual(page.count('class="band"'), 1)  # no band where no case has a number

    def test_listed_texts_are_shown_as_they_are(self):
        variables = '[[sweep.variables]]\nname = "on"\nkey = "contacts.stop.active"\nvalues = [true, false]\n'
        self.report_of("draws = 8\n", STUDY, variables)
        rows = [line.split(",") for line in (self.directory / "table.csv").read_text().splitlines()]
        shown = re.findall(r"<td class=\"text\">(?:<a[^>]*>)?case (\d+)(?:</a>)?</td><td>[^<]*</td><td>(\w+)</td>", self.page)
        self.assertGreater(len(shown), 0)
        for case, value in shown:
            self.assertEqual(value, dict((row[0], row[3]) for row in rows)[case])
        picture = sweep_view.scatter(np.array([0.0, 1.0]), np.array([2e-3, 1e-3]), ("on", "work"), "W", ["false", "true"])
        self.assertIn(">true</text>", picture)
        self.assertIn("work [mW]", picture)

    def test_the_report_command_writes_it_again(self):
        self.report_of("draws = 5\n")
        (self.directory / "report.html").unlink()
        subprocess.run([FRETWORK, "report", str(self.directory)], check=True, capture_output=True, timeout=60)
        self.assertEqual((self.directory / "report.html").read_text(), self.page)

    def test_refuses_what_was_changed(self):
        self.report_of("draws = 3\n")
        for name in ("summary.json", "table.h5"):
            file = self.directory / name
            whole = file.read_bytes()
            place = len(whole) // 2
            file.write_bytes(whole[:place] + bytes([whole[place] ^ 1]) + whole[place + 1 :])
            done = subprocess.run([FRETWORK, "report", str(self.directory)], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 1, name)
            self.assertIn(f"{name} is not as it was written", done.stderr)
            file.write_bytes(whole)

    def test_draws_that_are_cut_off_are_refused(self):
        """As on a full disk: the helper ends with status 0, and its file of numbers or its answer is short."""
        for answer in ('{"rows": 4, "columns": 2}', '{"rows": 4'):
            with tempfile.TemporaryDirectory(prefix="fretwork_sweep_") as name:
                helper, study = Path(name) / "python", Path(name) / "sweep.toml"
                helper.write_text(f"#!/bin/sh\nprintf 12345678 > \"$3/values.bin\"\necho '{answer}' > \"$3/answer.json\"\n")
                helper.chmod(0o755)
                study.write_text(f'[sweep]\nstudy = "{STUDY}"\ndraws = 4\n{VARIABLES}')
                done = subprocess.run([FRETWORK, "sweep", str(study), "-o", f"{name}/out"], capture_output=True, text=True, timeout=120,
                                      env=dict(os.environ, FRETWORK_PYTHON=str(helper)))  # fmt: skip
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn("set TMPDIR to another", done.stderr)

    def test_few_cases_have_no_interval(self):
        self.report_of("draws = 3\n")
        self.assertIn("give no interval", self.page)


if __name__ == "__main__":
    unittest.main()
