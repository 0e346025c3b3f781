# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests of the report share: the first arguments of each are WRITE_MADE_UP PYTHON_FOLDER (the program that makes results up, the folder of the
Python package)."""

import contextlib
import os
import re
import resource
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

WRITE_MADE_UP, PYTHON = sys.argv.pop(1), sys.argv.pop(1)
sys.path.insert(0, PYTHON)

import h5py  # noqa: E402
import numpy as np  # noqa: E402

from fretwork.report import run_data  # noqa: E402
from fretwork.report.build import build  # noqa: E402
from made_up_tables import add_tables, change_summary  # noqa: E402

VOID = {"meta", "path", "rect", "circle", "image", "polyline", "br", "i"}


@contextlib.contextmanager
def archive_to_change(folder):
    """results.h5 to be changed, with the checksum that fits in the end."""
    path = folder / "results.h5"
    with h5py.File(path, "r+") as file:
        yield file
    block = path.read_bytes()[: run_data.USER_BLOCK]
    with open(path, "r+b") as file:
        file.write(re.sub(rb"[0-9a-f]{64}", run_data.checksum(path).encode(), block))


class Checker(HTMLParser):
    """Counts elements, collects links and checks that elements close in order."""

    def __init__(self):
        super().__init__()
        self.stack, self.links, self.problems, self.counts = [], [], [], {}

    def handle_starttag(self, tag, attributes):
        self.counts[tag] = self.counts.get(tag, 0) + 1
        self.links += [value for name, value in attributes if name in ("src", "href", "xlink:href")]
        self.problems += [f"{tag} {name}={value}" for name, value in attributes if value and re.search(r"\b(nan|inf)\b", value)]
        if tag not in VOID:
            self.stack.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in VOID:
            self.stack.pop()

    def handle_endtag(self, tag):
        if tag not in VOID and (not self.stack or self.stack.pop() != tag):
            self.problems.append(f"</{tag}> closes nothing")


def made_up(folder, contacts, outputs, structures=1, wear=False):
    arguments = [WRITE_MADE_UP, folder, str(contacts), str(outputs), str(structures)] + (["wear"] if wear else [])
    subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL)


def time_of_children():
    """Processor time, s: of a machine that does other things too."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run_report(*arguments):
    """(exit status, what it printed) of the report as a program of its own."""
    done = subprocess.run([sys.executable, "-m", "fretwork.report", *arguments], env={**os.environ, "PYTHONPATH": PYTHON}, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


class ReportCase(unittest.TestCase):
    """A folder of results and its report."""

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory(prefix="fretwork_report_")
        self.folder = Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def report(self):
        """The report, checked: well formed, all in one file, no number that is none."""
        text = build(self.folder)
        checker = Checker()
        checker.feed(text)
        self.assertEqual(checker.problems, [])
        self.assertEqual(checker.stack, [])
        self.assertTrue(all(link.startswith("data:image/png;base64,") for link in checker.links), checker.links)
        self.assertNotIn("@import", text)
        self.assertNotIn("url(http", text)
        self.counts = checker.counts
        return text

    def headings(self, text):
        return re.findall(r"<h2>(.*?)</h2>", text)

    def change(self, change):
        change_summary(self.folder, change)

    def archive(self):
        return archive_to_change(self.folder)

    def flow_files(self):
        places = np.linspace(0.0, 2.0, 9)
        rows = "".join(f'"T1","{"foot" if s < 1 else "bend"}",{s},{s * (2 - s)},{740 - 100 * s},{0.1 * s},700,1.1\n' for s in places)
        head = "tube,zone,s [m],velocity [m/s],density [kg/m3],void_fraction [1],fluid_inside [kg/m3],mass [kg/m]\n"
        (self.folder / "flow.csv").write_text(head + rows)
        spectrum = "".join(f'"apex <1>","displacement y",m2/Hz,{f},{1e-12 / (1 + f**2)},{6e-13 / (1 + f**2)},{2e-12 / (1 + f**2)}\n' for f in range(50))
        force = "".join(f'"T1, bend","force per length",N2/m2/Hz,{f},{2.0 / f},{2.0 / f},{2.0 / f}\n' for f in range(1, 50))
        (self.folder / "spectra.csv").write_text("name,quantity,unit,frequency [Hz],density,low_95,high_95\n" + spectrum + force)
        add_tables(self.folder)
