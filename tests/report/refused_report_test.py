# SPDX-License-Identifier: GPL-3.0-or-later
"""What the report refuses, and what it says then."""

import json
import sys
import unittest

from report_case import ReportCase, made_up, run_report  # first: it makes the package known

from fretwork.report import run_data
from fretwork.report import build as build_module


class Refused(ReportCase):
    def test_refuses_tables_that_were_changed(self):
        made_up(self.folder, 2, 100)
        self.flow_files()
        for name in ("flow.csv", "spectra.csv"):
            file = self.folder / name
            whole = file.read_bytes()
            file.write_bytes(whole.replace(b"1", b"2", 1))
            with self.assertRaisesRegex(run_data.NoResults, f"{name} is not as it was written"):
                run_data.load(self.folder)
            file.write_bytes(whole)

    def test_tells_what_is_missing_or_damaged(self):
        status, said = run_report(self.folder)
        self.assertEqual(status, 1)
        self.assertIn("summary.json does not exist; give the folder that `fretwork run` wrote", said)
        made_up(self.folder, 1, 50)
        data = (self.folder / "results.h5").read_bytes()
        (self.folder / "results.h5").write_bytes(data[: len(data) // 2])
        status, said = run_report(self.folder)
        self.assertEqual(status, 1)
        self.assertIn("results.h5 is not as it was written (its checksum does not fit)", said)
        self.assertNotIn("Traceback", said)

    def test_refuses_a_summary_that_was_changed(self):
        made_up(self.folder, 1, 50)
        file = self.folder / "summary.json"
        file.write_text(file.read_text().replace('"ranks": ', '"ranks": 1'))
        status, said = run_report(self.folder)
        self.assertEqual(status, 1)
        self.assertIn("summary.json is not as it was written", said)

    def test_refuses_results_of_another_run(self):
        made_up(self.folder, 1, 50)
        self.change(lambda summary: summary.update(input_sha256="b" * 64))
        status, said = run_report(self.folder)
        self.assertEqual(status, 1)
        self.assertIn("summary.json and results.h5 are of different runs", said)

    def test_shows_no_markup_of_a_summary(self):
        """Every text and number in turn is replaced by markup, with the checksum that fits: it is escaped or refused, never a traceback."""
        made_up(self.folder, 2, 50)
        markup = "<img src=x onerror=alert(1)>"
        original = json.loads((self.folder / "summary.json").read_text())

        def places(value, path=()):
            if isinstance(value, dict):
                return [place for key, item in value.items() for place in places(item, (*path, key))]
            if isinstance(value, list):
                return [place for key, item in enumerate(value[:1]) for place in places(item, (*path, key))]
            return [path]

        found = [path for path in places(original) if path[0] not in ("sha256", "input_sha256")]
        self.assertGreater(len(found), 50)
        arguments = sys.argv
        for path in found:
            changed = json.loads(json.dumps(original))
            holder = changed
            for key in path[:-1]:
                holder = holder[key]
            holder[path[-1]] = markup
            (self.folder / "summary.json").write_text(run_data.with_checksum(json.dumps(changed)))
            sys.argv = ["report", str(self.folder)]
            (self.folder / "report.html").unlink(missing_ok=True)
            try:
                said = build_module.main()
            finally:
                sys.argv = arguments
            text = (self.folder / "report.html").read_text() if said == 0 else ""
            self.assertFalse(said == 0 and "<img src=x" in text, path)

    def test_follows_no_symbolic_link(self):
        made_up(self.folder, 1, 50)
        precious = self.folder / "precious"
        precious.write_text("kept")
        (self.folder / "report.html.part").symlink_to(precious)
        self.assertEqual(run_report(self.folder), (0, ""))
        self.assertEqual(precious.read_text(), "kept")

    def test_names_the_packages_that_are_missing(self):
        found = build_module.importlib.util.find_spec
        build_module.importlib.util.find_spec = lambda name: None if name == "h5py" else found(name)
        arguments, sys.argv = sys.argv, ["report", str(self.folder)]
        try:
            message = build_module.main()
        finally:
            build_module.importlib.util.find_spec, sys.argv = found, arguments
        self.assertRegex(message, r"^the report needs python3-h5py, which .* does not have: apt install python3-h5py$")

    def test_tells_that_it_cannot_write(self):
        made_up(self.folder, 1, 50)
        status, said = run_report(self.folder, "-o", self.folder / "absent" / "a.html")
        self.assertEqual(status, 1)
        self.assertIn("the report cannot be written: ", said)


if __name__ == "__main__":
    unittest.main()
