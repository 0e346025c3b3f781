# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package: package_test.py WRITE_MADE_UP PYTHON_FOLDER FRETWORK EXAMPLES"""

import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

WRITE_MADE_UP, PYTHON, FRETWORK, EXAMPLES = (sys.argv.pop(1) for _ in range(4))
sys.path.insert(0, PYTHON)
os.environ["FRETWORK"] = FRETWORK
os.environ["MPLBACKEND"] = "Agg"

import h5py  # noqa: E402
import numpy as np  # noqa: E402

import fretwork  # noqa: E402


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="fretwork_package_")
        cls.folder = Path(cls.temporary.name) / "made_up"
        subprocess.run([WRITE_MADE_UP, cls.folder, "3", "100", "1", "wear"], check=True, stdout=subprocess.DEVNULL)
        cls.results = fretwork.Results(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_imports_no_pandas_before_it_is_needed(self):
        script = "import sys, fretwork, fretwork.report.build; sys.exit(any(m in sys.modules for m in ('pandas', 'xarray', 'matplotlib')))"
        self.assertEqual(subprocess.run([sys.executable, "-c", script], env={**os.environ, "PYTHONPATH": PYTHON}, check=False).returncode, 0)

    def test_gives_statistics_with_units(self):
        table = self.results.contacts
        summary = self.results.summary["contacts"]
        self.assertEqual(list(table.index), [c["name"] for c in summary])
        self.assertEqual(table.loc["tsp2", "normal_force.max"], summary[1]["normal_force"]["max"])
        units = table.attrs["units"]
        self.assertEqual([units[c] for c in ("work_rate", "normal_force.max", "position.y.std", "impact_velocity.mean", "impacts")], ["W", "N", "m", "m/s", "1"])

    def test_gives_series_as_they_are_in_the_file(self):
        data = self.results.series("tsp2")
        with h5py.File(self.folder / "results.h5") as file:
            np.testing.assert_array_equal(data["normal_force"], file["contacts/tsp2/normal_force"][...])
            np.testing.assert_array_equal(data["displacement"].sel(displacement_axis="z_loc"), file["contacts/tsp2/displacement"][:, 2])
            np.testing.assert_array_equal(data["time"], file["time"][...])
        self.assertEqual((data["normal_force"].attrs["units"], data["time"].attrs["units"]), ("N", "s"))
        node = self.results.summary["nodes"][0]["name"]
        self.assertEqual(list(self.results.series(node)["displacement"].coords["displacement_axis"].values), ["x", "y", "z"])
        with self.assertRaisesRegex(KeyError, "no series of 'tsp9'; there are: .*tsp1"):
            self.results.series("tsp9")

    def test_gives_impacts_modes_and_wear(self):
        impacts = self.results.impacts
        with h5py.File(self.folder / "results.h5") as file:
            self.assertEqual(len(impacts), sum(len(c["impacts/start"]) for c in file["contacts"].values()))
        self.assertEqual(set(impacts["contact"]), {"tsp1", "tsp2", "tsp3"})
        shapes = self.results.mode_shapes()
        self.assertEqual(shapes.dims, ("mode", "node", "component"))
        np.testing.assert_array_equal(self.results.modes["frequency"], shapes["frequency"][: len(self.results.modes)])
        self.assertEqual(len(self.results.wear), len(self.results.summary["wear"]["supports"]))
        self.assertIsNone(self.results.spectra)

    def test_plots(self):
        from fretwork import plots

        line = plots.force(self.results, "tsp1").lines[0]
        np.testing.assert_array_equal(line.get_ydata(), self.results.series("tsp1")["normal_force"])
        self.assertEqual(plots.orbit(self.results, "tsp1").get_xlabel(), "y_loc [µm]")
        self.assertEqual(len(plots.work_rates(self.results).get_xticklabels()), 3)
        with self.assertRaisesRegex(KeyError, "no spectrum of 'apex'"):
            plots.spectrum(self.results, "apex")

    def test_refuses_a_folder_without_results(self):
        with self.assertRaisesRegex(Exception, "summary.json does not exist; give the folder"):
            fretwork.Results(self.folder / "absent")

    def test_writes_studies_that_read_back(self):
        study = {"title": 'a "b" \\ <c>', "modes": {"count": 3, "damping": [0.1, 1e-9]}, "contacts": [{"name": "x", "active": True, "gap": np.float64(2e-4)}]}
        file = fretwork.write_study(study, self.folder.parent / "written.toml")
        self.assertEqual(fretwork.read_study(file), study)
        example = fretwork.read_study(Path(EXAMPLES) / "u_bend/study.toml")
        self.assertEqual(tomllib.loads(fretwork.write_study(example, file).read_text()), example)
        with self.assertRaisesRegex(TypeError, "not set"):
            fretwork.write_study({"a": {1, 2}}, file)

    def test_runs_a_study_with_overrides(self):
        folder = self.folder.parent / "oscillator"
        shutil.copytree(Path(EXAMPLES) / "oscillator", folder, ignore=shutil.ignore_patterns("*.results"))
        results = fretwork.run(folder / "study.toml", {"title": "of a test"}, output=folder / "out", progress=False)
        self.assertEqual(results.summary["study"], "of a test")
        self.assertTrue(results.report(folder / "again.html").exists())
        with self.assertRaisesRegex(fretwork.RunFailed, "modes.cuont"):
            fretwork.run(folder / "study.toml", {"modes.cuont": 3}, output=folder / "out", progress=False)

    def test_runs_on_two_ranks(self):
        folder = self.folder.parent / "two_tubes"
        shutil.copytree(Path(EXAMPLES) / "two_tubes", folder, ignore=shutil.ignore_patterns("*.results"))
        short = {"transient.duration": 0.02, "modes.count": 9}
        one, two = (fretwork.run(folder / "study.toml", short, ranks=ranks, output=folder / str(ranks), progress=False) for ranks in (1, 2))
        self.assertEqual([results.summary["ranks"] for results in (one, two)], [1, 2])
        for name in one.contacts.index:
            np.testing.assert_array_equal(one.series(name)["normal_force"], two.series(name)["normal_force"])
        with self.assertRaisesRegex(fretwork.RunFailed, "modes.cuont"):
            fretwork.run(folder / "study.toml", {"modes.cuont": 3}, ranks=2, output=folder / "out", progress=False)


if __name__ == "__main__":
    unittest.main()
