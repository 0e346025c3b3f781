# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python package: package_test.py WRITE_MADE_UP PYTHON_FOLDER FRETWORK EXAMPLES"""

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import tomllib
import unittest
import unittest.mock
from pathlib import Path

WRITE_MADE_UP, PYTHON, FRETWORK, EXAMPLES = (sys.argv.pop(1) for _ in range(4))
sys.path.insert(0, PYTHON)
os.environ["FRETWORK"] = FRETWORK
os.environ["MPLBACKEND"] = "Agg"

import h5py  # noqa: E402
import numpy as np  # noqa: E402
import pandas  # noqa: E402

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

    def test_tells_a_node_from_a_contact_of_the_same_name(self):
        folder = self.folder.parent / "twins"
        shutil.copytree(Path(EXAMPLES) / "oscillator", folder, ignore=shutil.ignore_patterns("*.results"))
        study = fretwork.read_study(folder / "study.toml")
        contact = study["contacts"][0]
        study["output"] = {"nodes": [contact["group"]]}
        contact["name"] = contact["group"]
        results = fretwork.run(fretwork.write_study(study, folder / "study.toml"), progress=False)
        self.assertEqual(results.series(contact["name"]).attrs["kind"], "contact")
        node = results.series(contact["name"], "node")
        self.assertEqual((node.attrs["kind"], "acceleration" in node, "normal_force" in node), ("node", True, False))
        with self.assertRaisesRegex(KeyError, "no series of the node 'x'; there are: "):
            results.series("x", "node")
        with self.assertRaisesRegex(ValueError, '"contact", "node" or "reaction" is expected'):
            results.series("x", "nodes")

    def test_gives_section_forces_and_reactions(self):
        folder = self.folder.parent / "forces"
        shutil.copytree(Path(EXAMPLES) / "straight_tube", folder, ignore=shutil.ignore_patterns("*.results"))
        study = fretwork.read_study(folder / "study.toml")
        study["output"] = {"section_forces": ["tube"], "reactions": ["ends"]}
        study["transient"].update(duration=0.5, step=1e-4)  # an output a step: statistics are of the steps
        results = fretwork.run(fretwork.write_study(study, folder / "study.toml"), progress=False)
        sections, summary = results.section_forces("tube"), results.summary["section_forces"][0]
        self.assertEqual(sections["largest_stress"].max(), summary["stress"]["largest"])
        self.assertEqual(sections["stress_std"].max(), summary["stress"]["std"]["largest"])
        self.assertEqual([sections.attrs["units"][column] for column in ("s", "largest_stress", "Vy.std", "Mz.max")], ["m", "Pa", "N", "N m"])
        reactions = results.reactions
        self.assertEqual(list(reactions.index), ["ends[0]", "ends[1]"])
        self.assertEqual([reactions.attrs["units"][column] for column in ("force.y.std", "largest_moment")], ["N", "N m"])
        series = results.series("ends[1]")["force"]
        self.assertEqual((series.sizes["time"], list(series.coords["force_axis"].values[:3])), (5001, ["x", "y", "z"]))
        self.assertLessEqual(float(np.abs(series.sel(force_axis="y")).max()), 1.001 * max(-reactions["force.y.min"].iloc[1], reactions["force.y.max"].iloc[1]))
        with self.assertRaisesRegex(KeyError, "no section forces of 'x'; there are: tube"):
            results.section_forces("x")
        page = results.report().read_text(encoding="utf-8")
        self.assertIn('aria-label="stress [MPa] along tube"', page)
        self.assertIn("<td class=\"text\">ends[1]</td><td class=\"text\">force y [N]</td>", page)

    def test_completes_its_names(self):
        self.assertLessEqual({"Results", "run", "read_study", "write_study", "plots"}, set(dir(fretwork)))

    def test_gives_units_of_nodes(self):
        units = self.results.nodes.attrs["units"]
        self.assertEqual({units[column] for column in units if column.startswith("displacement")}, {"m"})
        self.assertEqual({units[column] for column in units if column.endswith("batches")} - {"1"}, set())

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
        with self.assertRaisesRegex(KeyError, "no spectrum of 'apex': this run has no spectra.csv"):
            plots.spectrum(self.results, "apex")

    def test_an_orbit_along_a_line_keeps_its_picture(self):
        from fretwork import plots

        displacement = np.zeros((50, 3))
        displacement[:, 1] = np.linspace(-1e-4, 1e-4, 50)
        data = self.results.series("tsp1").isel(time=slice(0, 50))
        with unittest.mock.patch.object(fretwork.Results, "series", lambda *_: data.assign(displacement=(data["displacement"].dims, displacement))):
            axes = plots.orbit(self.results, "tsp1")
        axes.figure.canvas.draw()
        self.assertGreater(axes.get_window_extent().height, 0.5 * axes.figure.bbox.height)
        self.assertAlmostEqual(np.ptp(axes.get_xlim()) / axes.get_window_extent().width, np.ptp(axes.get_ylim()) / axes.get_window_extent().height)

    def test_labels_of_many_contacts_stay_apart_and_on_the_figure(self):
        from fretwork import plots

        many = fretwork.Results(self.folder)
        many.summary["contacts"] = [{**many.summary["contacts"][0], "name": f"support[{i}]"} for i in range(60)]
        axes = plots.work_rates(many)
        axes.figure.canvas.draw()
        labels = [label.get_window_extent() for label in axes.get_xticklabels()]
        self.assertGreater(min(box.y0 for box in labels), 0.0)
        self.assertGreater(min(b.x1 - a.x1 for a, b in zip(labels, labels[1:])), 10.0)  # px
        with self.assertRaisesRegex(KeyError, "no transient with contacts"):
            many.summary["contacts"] = []
            del many.__dict__["contacts"]
            plots.work_rates(many)

    def test_wear_has_units_sides_and_curves(self):
        units = self.results.wear.attrs["units"]
        found = [units[c] for c in ("depth_m.value", "volume_m3.low", "life_years.value", "work_rate.value", "work_rate.has_interval", "coefficient_m2_per_N", "law")]
        self.assertEqual(found, ["m", "m3", "a", "W", "1", "m2/N", ""])
        name = self.results.wear.index[0]
        curves = self.results.wear_series(name)
        self.assertEqual((curves["depth"].dims, curves["depth"].attrs["units"], curves["time"].attrs["units"]), (("time", "bound"), "m", "s"))
        self.assertEqual(float(curves["depth"].sel(bound="value")[-1]), self.results.wear.loc[name, "depth_m.value"])
        self.assertEqual(float(curves["angle"][0]), -180 + 180 / len(curves["angle"]))
        self.assertEqual(list(curves["sector_work_rate"]), self.results.summary["wear"]["supports"][0]["sectors"]["work_rate"])
        with self.assertRaisesRegex(KeyError, f"no wear of 'x'; there is that of: .*{name}"):
            self.results.wear_series("x")
        with self.assertRaisesRegex(KeyError, "no side '\\+y'; there are: none"):
            self.results.wear_series(name, "+y")
        self.assertIsNone(self.results.wear_sides)

    def test_wear_of_sides_and_stages_are_tables(self):
        results = fretwork.Results(self.folder)
        support = results.summary["wear"]["supports"][0]
        figure = {"value": 1.0, "low": 0.5, "high": 2.0}
        support["sides"] = [{"name": side, "work_rate": figure, "depth_m": figure} for side in ("+y", "-y")]
        results.summary["wear"]["gap_opening"] = {"years": [10.0, 20.0], "supports": [{"name": support["name"], "gap_m": [1e-4, 2e-4], "life_years": None,
                                                  **{key: [figure, figure] for key in ("work_rate", "depth_m", "support_depth_m")}}]}
        self.assertEqual(list(results.wear_sides["side"]), ["+y", "-y"])
        self.assertEqual(results.wear_sides.attrs["units"]["depth_m.high"], "m")
        stages = results.gap_opening
        self.assertEqual((list(stages["years"]), list(stages["gap_m"]), stages.index[1]), ([10.0, 20.0], [1e-4, 2e-4], support["name"]))
        self.assertEqual([stages.attrs["units"][c] for c in ("years", "gap_m", "work_rate.low", "stage")], ["a", "m", "W", "1"])

    def test_response_is_a_table_with_units(self):
        results = fretwork.Results(self.folder)
        self.assertIsNone(results.response)
        point = {"name": "apex", "direction": "y", "rms_m": 1.5e-5, "rms_velocity_m_s": 2e-3, "up_crossings_per_second": 21.0, "irregularity": 0.9, "maximum_m": None}
        results.summary["response"] = [{"name": "free", "points": [point, {**point, "direction": "z", "maximum_m": 1e-4}]}]
        del results.__dict__["response"]
        table = results.response
        self.assertEqual((list(table["response"]), list(table["direction"])), (["free", "free"], ["y", "z"]))
        self.assertTrue(np.isnan(table["maximum_m"].iloc[0]))
        self.assertEqual([table.attrs["units"][c] for c in ("rms_m", "rms_velocity_m_s", "up_crossings_per_second", "irregularity", "direction")],
                         ["m", "m/s", "1/s", "1", ""])

    def test_refuses_a_folder_without_results(self):
        with self.assertRaisesRegex(fretwork.NoResults, "does not exist; give the folder"):
            fretwork.Results(self.folder / "absent")

    def test_writes_studies_that_read_back(self):
        study = {"title": 'a "b" \\ <c>', "modes": {"count": 3, "damping": [0.1, 1e-9]}, "contacts": [{"name": "x", "active": True, "gap": np.float64(2e-4)}]}
        file = fretwork.write_study(study, self.folder.parent / "written.toml")
        self.assertEqual(fretwork.read_study(file), study)
        example = fretwork.read_study(Path(EXAMPLES) / "u_bend/study.toml")
        self.assertEqual(tomllib.loads(fretwork.write_study(example, file).read_text()), example)
        with self.assertRaisesRegex(TypeError, r"modes.count = None: .* leave the key out"):
            fretwork.write_study({"modes": {"count": None}}, file)

    def test_writes_studies_that_people_read(self):
        study = {"title": "größer 𝜋", "mesh": {"file": Path("tube.geo")}, "flow": [{"name": "a b", "zones": [{"s": np.int64(1)}, {}]}, {"name": "c"}], "m": {"x y": {"e": np.array([1.5, 2])}}}
        file = fretwork.write_study(study, self.folder.parent / "written.toml")
        expected = """title = "größer 𝜋"

[mesh]
file = "tube.geo"

[[flow]]
name = "a b"

[[flow.zones]]
s = 1

[[flow.zones]]

[[flow]]
name = "c"

[m."x y"]
e = [1.5, 2.0]
"""
        self.assertEqual(file.read_text(encoding="utf-8"), expected)
        self.assertEqual(fretwork.read_study(file)["flow"][0]["zones"], [{"s": 1}, {}])

    def test_says_what_is_missing_for_a_run(self):
        study = Path(EXAMPLES) / "oscillator/study.toml"
        with unittest.mock.patch.dict(os.environ, {"FRETWORK": "/nowhere/fretwork"}), self.assertRaisesRegex(fretwork.RunFailed, "FRETWORK = /nowhere/fretwork is no program"):
            fretwork.run(study, progress=False)
        with unittest.mock.patch.dict(os.environ, {"PATH": "/nowhere"}), self.assertRaisesRegex(fretwork.RunFailed, "ranks = 2 needs mpirun.*install openmpi-bin"):
            fretwork.run(study, ranks=2, progress=False)
        with self.assertRaisesRegex(TypeError, "write_study"):
            fretwork.run({"title": "no file"})
        with self.assertRaisesRegex(ValueError, "ranks = 0"):
            fretwork.run(study, ranks=0, progress=False)

    def test_installs_as_the_manual_says(self):
        manual = (Path(PYTHON).parent / "doc/python.md").read_text(encoding="utf-8")
        with tempfile.TemporaryDirectory() as name:
            shutil.copytree(PYTHON, Path(name) / "python", ignore=shutil.ignore_patterns("__pycache__"))
            environment = {**os.environ, "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"}
            commands = re.search(r"```sh\n(.*?)```", manual, flags=re.S)[1]
            done = subprocess.run(["bash", "-e"], input=commands, cwd=name, env=environment, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            environment.pop("PYTHONPATH", None)
            command = [f"{name}/venv/bin/python", "-c", "import sys, fretwork; print(fretwork.__file__, fretwork.Results(sys.argv[1]).report(sys.argv[2]))"]
            done = subprocess.run([*command, self.folder, f"{name}/report.html"], cwd=name, env=environment, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(done.stdout.startswith(f"{name}/venv/lib"), done.stdout)
            self.assertTrue(Path(f"{name}/report.html").exists())

    def test_an_interrupt_ends_the_program_with_a_checkpoint(self):
        folder = self.folder.parent / "interrupted"
        shutil.copytree(Path(EXAMPLES) / "oscillator", folder, ignore=shutil.ignore_patterns("*.results"))
        script = "import fretwork, sys; fretwork.run(sys.argv[1], {'transient.duration': 1e6, 'output.every': 1e3, 'output.checkpoint': 0.05})"
        # a session of its own: an interrupt reaches Python only, as in a notebook
        with subprocess.Popen([sys.executable, "-c", script, folder / "study.toml"], env={**os.environ, "PYTHONPATH": PYTHON}, start_new_session=True,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
            lock, checkpoint = folder / "study.results/.lock", folder / "study.results/checkpoint.h5"
            until = time.monotonic() + 60
            while not checkpoint.exists() and process.poll() is None and time.monotonic() < until:  # of the transient
                time.sleep(0.05)
            os.kill(process.pid, signal.SIGINT)
            self.assertIn("KeyboardInterrupt", process.stderr.read())
        self.assertFalse(lock.exists())  # the program ended by itself
        self.assertTrue(checkpoint.exists())

    def test_runs_a_study_with_overrides(self):
        folder = self.folder.parent / "oscillator"
        shutil.copytree(Path(EXAMPLES) / "oscillator", folder, ignore=shutil.ignore_patterns("*.results"))
        results = fretwork.run(folder / "study.toml", {"title": "of a test"}, output=folder / "out", progress=False)
        self.assertEqual(results.summary["study"], "of a test")
        self.assertTrue(results.report(folder / "again.html").exists())
        with self.assertRaisesRegex(fretwork.RunFailed, "modes.cuont"):
            fretwork.run(folder / "study.toml", {"modes.cuont": 3}, output=folder / "out", progress=False)

    def test_gives_stability_diagrams_of_laws(self):
        folder = self.folder.parent / "u_bend_flow"
        short = {"transient.duration": 0.01, "output.statistics_from": 0.0}
        results = fretwork.run(Path(EXAMPLES) / "u_bend_flow/study.toml", short, output=folder, progress=False)
        found = results.stability_diagrams()
        laws = [a for a in results.summary["stability"] if "law" in a]
        self.assertEqual([d.attrs["assessment"] for d in found], [a["name"] for a in laws])
        first, law = found[0], laws[0]["law"]
        self.assertEqual(first["frequency"].dims, ("factor", "mode"))
        self.assertEqual(first["growth"].attrs["units"], "1/s")
        self.assertEqual(set(first["tube"].values), {"tube"})
        for mode, curves in enumerate(law["modes"]):
            np.testing.assert_allclose(first["damping"][:, mode], curves["dampings"], rtol=1e-12)
            np.testing.assert_allclose(first["growth"][:, mode], curves["growths_per_s"], rtol=1e-12)
        np.testing.assert_allclose(first["velocity"], law["velocity_m_s"] * np.array(law["factors"]), rtol=1e-12)
        self.assertEqual((list(first["mode"].values), list(first["number"].values)), (list(range(1, len(law["modes"]) + 1)), [m["mode"] for m in law["modes"]]))
        np.testing.assert_array_equal(first["critical_factor"], np.array([mode["critical_factor"] for mode in law["modes"]], float))
        table, csv = results.stability, pandas.read_csv(folder / "stability.csv")
        for column, head in (("frequency_hz", "frequency [Hz]"), ("critical_velocity_m_s", "critical_velocity [m/s]"), ("margin", "margin [1]")):
            np.testing.assert_allclose(table[column], csv[head], rtol=1e-12, atol=1e-12)
        self.assertEqual(table.attrs["units"]["critical_velocity_m_s"], "m/s")
        self.assertEqual(results.flow.attrs["units"]["velocity [m/s]"], "m/s")
        now = results.summary["fluidelastic"][0]
        self.assertEqual(now["tubes"], ["tube"])
        self.assertGreater(now["growth_per_s"], 0.0)  # unstable in the clearances
        row = results.fluidelastic.iloc[0]
        self.assertEqual(row["growth_per_s"], now["growth_per_s"])
        self.assertEqual(row["motion.power_W.fluid.mean"], now["motion"]["power_W"]["fluid"]["mean"])
        units = {"growth_per_s": "1/s", "velocity_m_s": "m/s", "motion.later_from_s": "s", "motion.power_W.fluid.standard_error": "W", "damping": "1"}
        self.assertEqual({column: results.fluidelastic.attrs["units"][column] for column in units}, units)
        self.assertIsNone(self.results.fluidelastic)
        self.assertEqual(self.results.stability_diagrams(), [])

    def test_computes_a_sweep_whose_table_has_units(self):
        folder = self.folder.parent / "swept"
        folder.mkdir()
        study = {"sweep": {"study": (Path(EXAMPLES) / "oscillator/study.toml").resolve(), "design": "grid", "keep": "worst 1", "variables": [
            {"name": "gap", "key": "contacts.stop.gap", "values": [1e-3, 0.0, -1.0]}, {"name": "scheme", "key": "transient.scheme", "values": ["splitting", "devogelaere"]},
            {"name": "on", "key": "contacts.stop.active", "values": [True]}]}}
        file = fretwork.write_study(study, folder / "study.toml")
        short = {"transient.duration": 0.2}
        sweep = fretwork.sweep(file, short, progress=False)
        self.assertEqual(sweep.directory, folder / "study.sweep")
        table = sweep.table
        self.assertEqual(list(table["gap"]), [1e-3, 1e-3, 0.0, 0.0, -1.0, -1.0])
        self.assertEqual(list(table["scheme"]), 3 * ["splitting", "devogelaere"])
        self.assertEqual(list(table["on"]), 6 * [True])
        self.assertEqual(list(table["outcome"]), 4 * ["done"] + 2 * ["refused"])
        csv = pandas.read_csv(folder / "study.sweep/table.csv", index_col="case", float_precision="round_trip")
        self.assertEqual(list(csv["scheme"]), list(table["scheme"]))
        np.testing.assert_array_equal(table["stop.normal_max"], csv["stop.normal_max [N]"])
        units = table.attrs["units"]
        self.assertEqual([units[c] for c in ("stop.normal_max", "stop.contact_time_ratio", "gap")], ["N", "1", ""])
        one = fretwork.run(Path(EXAMPLES) / "oscillator/study.toml", {**short, "contacts.stop.gap": 1e-3, "transient.scheme": "devogelaere"}, output=folder / "one", progress=False)
        self.assertEqual(one.contacts.loc["stop", "normal_force.max"], table.loc[1, "stop.normal_max"])
        kept = sweep.summary["worst"][0]
        self.assertEqual(sweep.case(kept).contacts.loc["stop", "normal_force.max"], table.loc[kept, "stop.normal_max"])
        with self.assertRaisesRegex(KeyError, f"has not kept case 7; it has: {kept}"):
            sweep.case(7)
        with self.assertRaisesRegex(fretwork.NoResults, "no table of a sweep .*give the folder that `fretwork sweep` wrote"):
            fretwork.Sweep(self.folder)
        with self.assertRaisesRegex(TypeError, "sweep takes a file; write it first, sweep"):
            fretwork.sweep(study)

    def test_runs_on_two_ranks(self):
        folder = self.folder.parent / "two_tubes"
        shutil.copytree(Path(EXAMPLES) / "two_tubes", folder, ignore=shutil.ignore_patterns("*.results"))
        short = {"transient.duration": 0.02, "modes.count": 9}
        one, two = (fretwork.run(folder / "study.toml", short, ranks=ranks, output=folder / str(ranks), progress=False) for ranks in (1, 2))
        self.assertEqual([results.summary["ranks"] for results in (one, two)], [1, 2])
        for name in one.contacts.index:
            np.testing.assert_array_equal(one.series(name)["normal_force"], two.series(name)["normal_force"])
        with self.assertRaisesRegex(fretwork.RunFailed, "modes.cuont") as failed:
            fretwork.run(folder / "study.toml", {"modes.cuont": 3}, ranks=2, output=folder / "out", progress=False)
        self.assertNotIn("mpirun", str(failed.exception))


if __name__ == "__main__":
    unittest.main()
