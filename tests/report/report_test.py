# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the report: report_test.py WRITE_MADE_UP PYTHON_FOLDER (the program that makes results up, the folder of the Python package)."""

import contextlib
import json
import os
import re
import resource
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path
import subprocess

WRITE_MADE_UP, PYTHON = sys.argv.pop(1), sys.argv.pop(1)
sys.path.insert(0, PYTHON)

import h5py  # noqa: E402
import numpy as np  # noqa: E402

from fretwork.report import compare, compare_data, contact_view, drawing, run_data, sections, structure_view, wear_section, wear_view  # noqa: E402
from fretwork.report import build as build_module  # noqa: E402
from fretwork.report.build import build  # noqa: E402
from made_up_tables import add_tables, change_summary  # noqa: E402

LONGEST = 8.0  # s for 22 contacts and 10 000 outputs: the goal is 4 s on an idle machine, twice that beside other tests
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


class Report(unittest.TestCase):
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

    def test_has_all_sections_for_a_few_contacts(self):
        made_up(self.folder, 5, 400)
        text = self.report()
        self.assertEqual(
            self.headings(text),
            ["Structure", "Modes", "Along the tube", "Contacts", "Table of contacts", "Observed nodes", "Impacts", "Energy balance", "How it was computed",
             "Study"],
        )
        self.assertEqual(self.counts["image"], 5)  # an orbit each
        for word in ("tsp1", "circle", "plane_y", "stop_z", "plane_z", "18446744073709551615", "PETSc 3.18.5", "a" * 64,
                     "0.5 / contact frequency", "overlaps its obstacle", "made up for a test", "&lt;made up&gt;", "Straight tube on loose supports"):
            self.assertIn(word, text)

    def test_shows_orbits_of_all_and_histories_of_some_of_many_contacts(self):
        made_up(self.folder, 13, 300)
        text = self.report()
        self.assertIn("Orbits", self.headings(text))
        self.assertIn("The 6 contacts that wear most", self.headings(text))
        self.assertEqual(self.counts["image"], 13 + 6)
        self.assertEqual(text.count('aria-label="Normal force of'), 6)
        self.assertEqual(text.count('aria-label="peak force"'), 6)

    def test_shows_losses_and_paths_of_contacts(self):
        made_up(self.folder, 2, 100)
        text = self.report()
        for cell in ("4.2", "6.4", "310", "4.5", "27", "17 / 44"):  # of the made-up statistics, in the table's units
            self.assertIn(f"<td>{cell}</td>", text)

    def test_losses_that_are_round_off_are_zero(self):
        made_up(self.folder, 2, 100)

        def add(summary):
            summary["energy"]["input_J"] = 50.0
            summary["contacts"][0]["energy"] = {"damping_J": -4e-14, "friction_J": 4.2e-3}

        self.change(add)
        losses = self.report()
        losses = losses[losses.index("lost in dampers"):]
        self.assertIn('<td class="text">tsp1</td><td>0</td><td>4.2</td>', losses)

    def test_shows_the_strongest_impacts_first(self):
        made_up(self.folder, 2, 400)
        with self.archive() as file:
            impacts = file["contacts/tsp2/impacts"]
            for name, value in {"start": 1.2345, "duration": 2.5e-3, "peak_force": 9876.0, "impulse": 0.125, "velocity_before": 0.75,
                                "velocity_after": np.nan, "energy_lost": 3.5e-3, "rebounds": 3}.items():
                impacts[name][2] = value
            impacts.attrs["left_out"] = 77
        text = self.report()
        table = text[text.index("<h2>Impacts</h2>"):]
        first = re.search(r"<tbody><tr>(.*?)</tr>", table).group(1)
        self.assertEqual(re.findall(r"<td[^>]*>(.*?)</td>", first), ["tsp2", "1.2345", "2.5", "9876", "125", "750 / –", "3.5", "3"])
        self.assertIn("77 later ones in no row", table)

    def test_works_without_tables_of_impacts(self):
        made_up(self.folder, 2, 100)
        with self.archive() as file:
            for contact in file["contacts"].values():
                del contact["impacts"]
        self.assertNotIn("Impacts", self.headings(self.report()))

    def test_shows_flat_obstacles_apart_and_the_static_flexibility(self):
        made_up(self.folder, 2, 100)

        def change(summary):
            first, second = summary["contacts"]
            first["position"]["radial"]["max"] = second["position"]["radial"]["max"] = 7.77e-3
            first["static_flexibility"] = {"exact": 3e-6, "basis": 2.5e-6, "missing": 5e-7}
            second["position"]["z"].update(min=-1.25e-4, max=0.75e-4)
            second["position"]["y"].update(min=-2e-4, max=5e-4)
            second["penetration"]["max"] = 5.25e-6

        self.change(change)
        with self.archive() as file:
            file["contacts/tsp1"].attrs["obstacle"] = "circle"
            file["contacts/tsp1"].attrs["normal_stiffness"] = 1e6
            file["contacts/tsp2"].attrs["obstacle"] = "bars_z"
        text = self.report()
        self.assertEqual(text.count("<td>7770</td>"), 1)  # flat obstacles have no radius
        self.assertIn("<td>−125 – 75</td>", text)
        self.assertIn("<td>700</td>", text)
        self.assertIn("<td>5.25</td>", text)
        self.assertIn("<td>5·10<sup>−7</sup></td><td>0.5</td>", text)

    def test_shows_observed_nodes(self):
        made_up(self.folder, 1, 100)
        text = self.report()
        nodes = text[text.index("<h2>Observed nodes</h2>"):]
        summary = json.loads((self.folder / "summary.json").read_text())
        for node in summary["nodes"]:
            self.assertIn(f'aria-label="Displacement of {node["name"]}"', nodes)
            self.assertIn(f'<td>{drawing.short(1e6 * node["displacement"]["y"]["max"])}</td>', nodes)
            self.assertEqual(nodes.count(f'{node["name"]}</td>'), 3, "each row has its name, however the table is sorted")

    def test_nodes_do_not_move_by_round_off(self):
        made_up(self.folder, 1, 100)
        self.change(lambda summary: [node["displacement"].update(x=dict.fromkeys(("mean", "std", "min", "max"), 3e-21)) for node in summary["nodes"]])
        self.assertNotIn("3·10<sup>−15", self.report().split("<h2>Observed nodes</h2>")[1].split("</table>")[0])

    def test_shows_the_largest_impact_at_every_step(self):
        made_up(self.folder, 1, 100)
        with self.archive() as file:
            largest = file["contacts/tsp1"].require_group("largest_impact")
            for name in list(largest):
                del largest[name]
            time = 0.5 + 1e-4 * np.arange(60)  # an output interval of 0.02 s has none of it
            normal = np.where((time > 0.501) & (time < 0.504), 4321.0 * np.sin(np.pi * (time - 0.501) / 0.003), 0.0)
            for name, values in {"time": time, "normal_force": normal, "tangential_force": 0.3 * normal}.items():
                largest[name] = values
        self.report()
        run = run_data.load(self.folder)
        time, normal, _ = contact_view.largest_impact(run, run.contacts[0])
        self.assertGreater((normal > 0).sum(), 25)
        self.assertAlmostEqual(normal.max(), 4321.0, delta=15.0)
        picture = contact_view.impact(run, run.contacts[0])
        self.assertIn("time after 0.5", picture)
        self.assertIn("kN", picture)

    def test_draws_obstacles_of_every_kind(self):
        two_nodes = ("circle", "circle_inside", "plane_y", "plane_z")
        one_node = ("circle", "plane_y", "plane_z", "stop_y", "stop_z", "profile", "drilled", "broached", "egg_crate", "bars_y", "bars_z")
        for other, kinds in ((7, two_nodes), (-1, one_node)):
            made_up(self.folder, len(kinds), 100)
            with self.archive() as file:
                for contact, kind in zip(file["contacts"].values(), kinds):
                    contact.attrs["obstacle"] = kind
                    contact.attrs["other"] = other
                    contact.attrs["rest"] = (0.0, 4e-4, -3e-4)
                    if kind == "bars_z":  # two of them; bars_y is one
                        contact["gap"][...] = contact.attrs["gap"] - np.abs(contact["displacement"][:, 2] - 3e-4)
                    if kind in ("profile", "broached", "egg_crate"):
                        contact["outline"] = np.array([[2e-4, 0.0], [0.0, 2e-4], [-2e-4, 0.0], [0.0, -2e-4]])
            self.assertEqual(self.report().count('class="wall"'), len(kinds) + (3 if other < 0 else 0))  # three pairs

    def flow_files(self):
        places = np.linspace(0.0, 2.0, 9)
        rows = "".join(f'"T1","{"foot" if s < 1 else "bend"}",{s},{s * (2 - s)},{740 - 100 * s},{0.1 * s},700,1.1\n' for s in places)
        head = "tube,zone,s [m],velocity [m/s],density [kg/m3],void_fraction [1],fluid_inside [kg/m3],mass [kg/m]\n"
        (self.folder / "flow.csv").write_text(head + rows)
        spectrum = "".join(f'"apex <1>","displacement y",m2/Hz,{f},{1e-12 / (1 + f**2)},{6e-13 / (1 + f**2)},{2e-12 / (1 + f**2)}\n' for f in range(50))
        force = "".join(f'"T1, bend","force per length",N2/m2/Hz,{f},{2.0 / f},{2.0 / f},{2.0 / f}\n' for f in range(1, 50))
        (self.folder / "spectra.csv").write_text("name,quantity,unit,frequency [Hz],density,low_95,high_95\n" + spectrum + force)
        add_tables(self.folder)

    def test_shows_no_table_that_the_run_has_not_written(self):
        made_up(self.folder, 2, 100)
        self.flow_files()
        change_summary(self.folder, lambda summary: summary.update(files_sha256={}))
        self.assertEqual((run_data.load(self.folder).flows, run_data.load(self.folder).spectra), ([], []))

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

    def test_shows_the_flow_and_spectra(self):
        made_up(self.folder, 2, 100)
        self.flow_files()
        text = self.report()
        self.assertEqual(self.headings(text)[2], "Flow along the tubes")
        self.assertIn("Spectra", self.headings(text))
        for word in ("gap velocity [m/s] along T1", "void fraction along T1", "foot, bend", "apex &lt;1&gt;", "force per length"):
            self.assertIn(word, text)
        flow = run_data.load(self.folder).flows[0]
        self.assertEqual(flow.zones[:4], ["foot"] * 4)
        self.assertAlmostEqual(flow.columns["velocity [m/s]"].max(), 1.0)
        spectra = run_data.load(self.folder).spectra
        self.assertEqual([(s.name, s.quantity, len(s.frequency)) for s in spectra],
                         [("apex <1>", "displacement y", 50), ("T1, bend", "force per length", 49)])
        self.assertAlmostEqual(spectra[0].high[3] / spectra[0].density[3], 2.0)

    def test_shows_stability_and_the_linear_response(self):
        made_up(self.folder, 2, 100)

        def add(summary):
            case = {"connors_constants": {"bend": 2.4}, "critical_mode": 2, "margin": -0.2, "critical_scale": 0.8333, "ratios": [0.5, 1.2, None],
                    "critical_velocities_m_s": [2.0, 1.1, None], "sweep": []}
            stable = {**case, "margin": 0.5, "ratios": [0.4, 0.5, None]}
            modes = [{"frequency_hz": f, "damping": 0.02, "decrement": 0.12, "effective_velocity_m_s": 1.0} for f in (10, 20, 30)]
            summary["stability"] = [{"name": "all <bars>", "tube": "T1", "pinned": ["tsp1"], "modes": modes, "cases": [stable, case]}]
            point = {"name": "apex", "direction": "y", "rms_m": 1.5e-5, "rms_velocity_m_s": 2e-3, "up_crossings_per_second": 21.0, "irregularity": 0.9,
                     "maximum_m": None, "share_outside": 0.0, "share_above": 0.0}
            summary["response"] = [{"name": "free", "pinned": [], "modes": 12, "duration_s": 60.0, "probability": 0.5, "points": [point]}]

        self.change(add)
        text = self.report()
        self.assertIn("Fluid-elastic stability", self.headings(text))
        self.assertIn("Linear response to turbulence", self.headings(text))
        self.assertIn("<b>−0.2</b><span>smallest stability margin by Connors, 1 − V/Vc</span>", text)
        for word in ("all &lt;bars&gt;", "the worst of 2: bend 2.4", "unstable by Connors: V/Vc = 1.2", "Bars: critical velocity", "apex</td>", ">15<", ">21<"):
            self.assertIn(word, text)

    def test_shows_the_stability_diagram_of_a_law(self):
        made_up(self.folder, 2, 100)
        case = {"connors_constants": {}, "critical_mode": 1, "margin": 0.5, "critical_scale": 2.0, "ratios": [0.5, 0.1], "critical_velocities_m_s": [2.0, 9.0],
                "sweep": []}
        modes = [{"frequency_hz": f, "damping": 0.01, "decrement": 0.06, "effective_velocity_m_s": 1.0} for f in (10, 20)]
        law = {"velocity_m_s": 4.0, "diameter_m": 0.019, "range": [2, 40], "critical_factor": 1.25, "critical_velocity_m_s": 5.0, "factors": [0.0, 1.0, 2.0],
               "crossings": [{"factor": 1.25, "velocity_m_s": 5.0, "frequency_hz": 10.5, "reduced_velocity": 25.0, "mode": 1, "becomes": "unstable",
                              "outside_range": False},
                             {"factor": 1.9, "velocity_m_s": 7.6, "frequency_hz": 0.0, "reduced_velocity": None, "mode": None, "becomes": "unstable",
                              "outside_range": False}],
               "modes": [{"frequencies_hz": [10, 10.4, 11], "dampings": [0.01, 0.004, -0.01], "critical_factor": 1.25, "connors_factor": 2.0},
                         {"frequencies_hz": [20, 19, None], "dampings": [0.01, 0.02, None], "critical_factor": None, "connors_factor": None}]}

        def add(summary):
            summary["stability"] = [{"name": "loose", "tube": "T1", "pinned": ["tsp1"], "elastic": True, "sticking": False, "modes": modes, "cases": [case],
                                     "law": law}]
            summary["fluidelastic"] = [{"tubes": ["T1"], "unknowns": 6, "growth_per_s": 0.75, "frequency_hz": 10.4, "damping": -0.012, "velocity_m_s": 4.0,
                                        "reduced_velocity": 20.2, "critical_factor": 0.875, "critical_velocity_m_s": 3.5}]

        self.change(add)
        text = self.report()
        section = text[text.index("<h2>Fluid-elastic stability</h2>"):]
        for word in ("Fluidelastic laws of the run", "T1</td>", ">0.75<", ">20.2<", ">3.5<", ">0.875<"):
            self.assertIn(word, section)
        for word in ("Pinned at: tsp1, elastic.", "critical velocity 5 m/s, factor 1.25", ">25<", "unstable (divergence)", ">lag<"):
            self.assertIn(word, section)
        for title in ("damping of the modes over the velocity", "frequency of the modes over the velocity"):
            picture = section[section.index(f'aria-label="{title}"'):]
            picture = picture[:picture.index("</svg>")]
            self.assertEqual(picture.count("<polyline class=\"mode"), 2)
            self.assertEqual(picture.count("<circle"), 2)
        self.assertNotIn("Fluid-elastically unstable", section)
        for crossing, factor in zip(law["crossings"], (0.5, 0.75)):  # unstable and stable again: at the velocities given stable
            crossing.update(factor=factor, becomes="unstable" if factor == 0.5 else "stable")
        law.update(critical_factor=0.5, critical_velocity_m_s=2.0)
        self.change(add)
        self.assertNotIn("Fluid-elastically unstable", self.report())
        law["crossings"][1]["factor"] = 1.9
        self.change(add)
        section = self.report()
        self.assertIn("Fluid-elastically unstable under the fluidelastic law: critical velocity 2 m/s, factor 0.5", section)
        self.assertNotIn("unstable by Connors", section)  # whose margin is above 0
        law["tubes"] = ["T1", "T2"]
        for mode, tube in zip(law["modes"], law["tubes"]):
            mode.update(tube=tube, mode=1)
        law["crossings"][1]["mode"] = 2
        self.assertNotIn("Motion past the threshold", section)
        self.change(add)
        section = self.report()
        self.assertIn("Fluidelastic law of 2 tubes", section)
        self.assertIn(">T2:1<", section)
        law["crossings"], law["critical_factor"], law["critical_velocity_m_s"] = [], None, None
        self.change(add)
        self.assertIn("stable up to 2 times the velocity", self.report())

    def test_shows_the_motion_past_the_threshold(self):
        made_up(self.folder, 2, 100)
        terms = ("loads", "fluid", "modal_damping", "contact_damping", "friction", "stored")
        powers = {term: {"mean": 1e-3 * (k + 1), "standard_error": 1e-5 if k else None} for k, term in enumerate(terms)}
        place = {"kind": "contact", "name": "stop<1>", "axis": "z", "rms_m": 4.6e-4, "largest_m": 6.7e-4, "largest_of_diameter": 0.035, "frequency_hz": 42.25,
                 "frequency_resolution_hz": 1.0, "reduced_velocity": 4.97}

        def law(tube, motion):
            return {"tubes": [tube], "unknowns": 6, "growth_per_s": 0.75, "frequency_hz": 10.4, "damping": -0.012, "velocity_m_s": 4.0, "reduced_velocity": 20.2,
                    "critical_factor": 0.875, "critical_velocity_m_s": 3.5, "motion": motion}

        def motion(place, growth):
            return {"place": place, "later_from_s": 4.0, "growth": growth, "power_tubes": ["T1", "T2"], "power_W": powers}

        def growth(grows):
            return {"rate_per_s": 1.25, "standard_error_per_s": 0.02, "rms_ratio": 1.9, "grows": grows}

        def section_of(laws):
            self.change(lambda summary: summary.update(fluidelastic=laws))
            text = self.report()
            return text[text.index("<h2>Fluid-elastic stability</h2>"):text.index("<h2>How it was computed</h2>")]

        section = section_of([law("T1", motion(place, growth(False))), law("T2", motion(None, None)), law("T3", None)])
        for cell in ("contact stop&lt;1&gt;, z_loc", ">0.46<", ">0.67<", ">3.5<", ">42.25<", ">4.97<", ">1.25 ± 0.02<", "at rest", ">1<", ">2 ± 0.01<"):
            self.assertIn(cell, section)
        self.assertEqual(section.count(">6 ± 0.01<"), 1)  # powers of tubes that run together, once
        self.assertNotIn("still grows", section)
        self.assertIn("The motion still grows", section_of([law("T1", motion(place, growth(True)))]))
        self.assertNotIn("Motion past the threshold", section_of([law("T3", None)]))

    def test_says_how_many_modes_and_displacements_its_tables_leave_out(self):
        made_up(self.folder, 2, 100)

        def add(summary):
            modes = [{"frequency_hz": f, "damping": 0.01, "decrement": 0.06, "effective_velocity_m_s": 1.0} for f in range(1, 51)]
            case = {"connors_constants": {}, "critical_mode": 1, "margin": 0.5, "critical_scale": 2.0, "ratios": [0.5] * 50, "critical_velocities_m_s": [2.0] * 50,
                    "sweep": []}
            summary["stability"] = [{"name": "all", "tube": "T1", "pinned": [], "modes": modes, "cases": [case]}]
            point = {"name": "apex", "direction": "y", "rms_m": 1.5e-5, "rms_velocity_m_s": 2e-3, "up_crossings_per_second": 21.0, "irregularity": 0.9,
                     "maximum_m": None, "share_outside": 0.0, "share_above": 0.0}
            summary["response"] = [{"name": "free", "pinned": [], "modes": 12, "duration_s": 60.0, "probability": 0.5, "points": [point] * 61}]

        self.change(add)
        text = self.report()
        self.assertIn("The first 40 of 50 modes; all are in stability.csv.", text)
        self.assertIn("The first 60 of 61 displacements; all are in response.csv.", text)

    def test_shows_the_scars_of_several_sides_below_their_support(self):
        made_up(self.folder, 2, 100, wear=True)
        with h5py.File(self.folder / "results.h5", "a") as file:
            sides = file["wear/tsp1"].create_group("sides")
            file.copy(file["wear/tsp2"], sides, "-y")
            supports = [run_data._support_wear(file["wear"][name]) for name in ("tsp1", "tsp2")]
        self.assertEqual(list(supports[0]["sides"]), ["-y"])
        self.assertEqual(supports[1]["sides"], {})
        rows = [re.findall(r"<td[^>]*>(.*?)</td>", row) for row in re.findall(r"<tr>(.*?)</tr>", wear_section._supports(supports))[1:]]
        self.assertEqual([row[0] for row in rows], ["tsp1", "tsp1, side -y", "tsp2"])
        self.assertEqual(rows[1][1:7], rows[2][1:7])
        self.assertEqual(len(rows[1]), len(rows[2]))

    def test_shows_wear(self):
        made_up(self.folder, 5, 200, wear=True)
        text = self.report()
        self.assertEqual(self.headings(text)[4:7], ["Table of contacts", "Observed nodes", "Wear"])
        lives = [(s["life_years"][0], s["name"]) for s in run_data.load(self.folder).wear]
        years, name = min(life for life in lives if life[0] == life[0])  # not the one outside the law
        self.assertIn(f"<b>{drawing.short(years, 3)}</b><span>years to the limit of wear, {name} (1 of 5 supports have no figure)</span>", text)
        wear = text[text.index("<h2>Wear</h2>"):text.index("<h2>Impacts</h2>")]
        first = re.search(r"<tbody><tr>(.*?)</tr>", wear).group(1)
        cells = re.findall(r"<td[^>]*>(.*?)</td>", first)
        self.assertEqual(cells[:2], ["tsp1", "0.1 (0.085 – 0.115)"])  # mW
        self.assertEqual(cells[2], "2.52 (2.14 – 2.9)")  # 2e-14 m2/N x 1e-4 W x 40 years in mm3
        self.assertEqual(cells[6], "500 (435 – 588)")
        self.assertIn("690_405 on flat_bar: made up", cells[8])
        self.assertEqual(cells[10], "this run: 75 %; state 2: 25 %")
        self.assertIn("outside the law", wear)
        self.assertIn("tsp3: edf_mz does not apply: V0 is below S", wear)
        self.assertIn("never (124 – never)", wear)
        self.assertIn("Gaps opened by wear in 2 stages up to 12.5 years: a tube has lost its limit.", wear)
        self.assertIn(">0.2 → 0.25<", wear)
        for kind, count in (("Depth of wear of", 5), ("Scar of", 4), ("Work by angle of", 5), ("worn volume", 1)):
            self.assertEqual(wear.count(f'aria-label="{kind}'), count, kind)
        self.assertEqual(wear.count('class="band"'), 4)  # none outside the law
        self.assertEqual(wear.count('class="limit"'), 5)
        self.assertEqual(wear.count('class="worn"'), 4)

    def test_shows_pictures_of_the_shortest_lives_of_many_supports(self):
        made_up(self.folder, 20, 100, wear=True)
        wear = self.report()
        wear = wear[wear.index("<h2>Wear</h2>"):]
        shown = re.findall(r'aria-label="Depth of wear of (.*?)"', wear)
        self.assertEqual(shown, [f"tsp{i}" for i in range(20, 14, -1)])

    def test_has_no_wear_that_the_study_does_not_ask_for(self):
        made_up(self.folder, 2, 100)
        self.assertNotIn("Wear", self.headings(self.report()))

    def test_works_without_a_transient(self):
        made_up(self.folder, 2, 0)
        self.assertEqual(self.headings(self.report()), ["Structure", "Modes", "How it was computed", "Study"])

    def test_works_without_contacts(self):
        made_up(self.folder, 0, 100)
        self.assertEqual(self.headings(self.report()), ["Structure", "Modes", "Observed nodes", "Energy balance", "How it was computed", "Study"])

    def test_names_the_structure_of_each_mode_where_there_are_several(self):
        made_up(self.folder, 3, 100, 2)
        text = self.report()
        self.assertIn(">structure</th>", text)
        self.assertIn("Contact by contact", self.headings(text))

    def test_says_that_a_run_diverged_and_writes_dashes(self):
        made_up(self.folder, 2, 100)

        def diverge(summary):
            summary["transient"]["outcome"] = "diverged"
            summary["energy"] = dict.fromkeys(summary["energy"])
            for key, value in summary["contacts"][0].items():
                summary["contacts"][0][key] = None if isinstance(value, float) else value
            summary["contacts"][0]["normal_force"] = {"mean": None, "rms": None, "max": None}

        self.change(diverge)
        with self.archive() as file:
            for name in ("displacement", "normal_force", "gap"):
                file[f"contacts/tsp1/{name}"][50:] = np.nan
                file[f"contacts/tsp2/{name}"][...] = np.inf
        text = self.report()
        self.assertIn("diverged", text)
        self.assertIn(">–<", text)
        self.assertNotRegex(text, r"[>\s](nan|inf)[<\s]")

    def test_names_only_the_marks_that_the_structure_has(self):
        made_up(self.folder, 2, 100)
        self.assertIn("restraints (black), loads (green)", self.report())
        with self.archive() as file:
            file.attrs["study"] = file.attrs["study"].split("[[loads]]")[0]
        text = self.report()
        self.assertIn("restraints (black)<", text)
        self.assertNotIn("loads (green)", text)

    def test_contacts_without_friction_have_no_tangential_force(self):
        made_up(self.folder, 2, 100)

        def remove_friction(summary):
            for contact in summary["contacts"]:
                contact["tangential_force"]["max"] = 5e-14 * contact["normal_force"]["max"]

            summary["energy"]["contact_damping_J"] = -1e-14 * summary["energy"]["input_J"]

        self.change(remove_friction)
        text = self.report()
        for title in ("Table of contacts", "Energy balance"):
            self.assertNotIn("10<sup>−1", text.split(f"<h2>{title}")[1].split("</table>")[0], title)

    def test_survives_a_run_that_stopped_at_once(self):
        made_up(self.folder, 2, 1)
        self.change(lambda summary: summary["transient"].update(end_time_s=0.0))
        self.report()

    def test_escapes_names(self):
        made_up(self.folder, 1, 50)
        self.change(lambda summary: summary.update(study="<script>x</script>"))
        self.assertNotIn("<script>", self.report())

    def test_is_quick_for_many_contacts_and_outputs(self):
        made_up(self.folder, 22, 10000)
        start = time_of_children()
        status, said = run_report(self.folder)
        self.assertEqual((status, said), (0, ""))
        self.assertLess(time_of_children() - start, LONGEST)
        self.assertLess((self.folder / "report.html").stat().st_size, 5e6)

    def test_writes_where_it_is_told_and_nothing_else(self):
        made_up(self.folder, 1, 50)
        self.assertEqual(run_report(self.folder, "-o", self.folder / "other.html"), (0, ""))
        self.assertEqual({p.name for p in self.folder.iterdir()}, {"summary.json", "results.h5", "other.html"})

    def test_gives_the_same_bytes_twice(self):
        made_up(self.folder, 3, 100)
        run_report(self.folder, "-o", self.folder / "a.html")
        run_report(self.folder, "-o", self.folder / "b.html")
        self.assertEqual((self.folder / "a.html").read_bytes(), (self.folder / "b.html").read_bytes())

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


class Comparison(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="fretwork_compare_")
        self.addCleanup(temporary.cleanup)
        self.folders = [Path(temporary.name) / name for name in "ab"]
        for folder in self.folders:
            made_up(folder, 3, 100, wear=True)
            with archive_to_change(folder) as file:
                file.attrs["study"] = '[modes]\ncount = 40\n[[contacts]]\nname = "tsp1"\ngap = 2e-4\n[[contacts]]\nname = "tsp2"\ngap = 3e-4\n'

        def change(summary):
            summary["overrides"] = [{"key": "contacts.tsp2.gap", "value": 5e-4}]
            summary["modes"]["frequencies_hz"][0] *= 1.01
            for contact, factor in zip(summary["contacts"], (1.0, 1.001, 2.0)):
                contact["work_rate"] *= factor

        change_summary(self.folders[1], change)

    def table(self, title):
        _, found = compare_data.tables(self.folders)
        return next(table for table in found if table.title.startswith(title))

    def test_shows_the_inputs_that_differ_with_overrides(self):
        self.assertEqual(self.table("Inputs").rows, [["contacts.tsp2.gap", "0.0003", "0.0005"]])

    def test_shows_inputs_as_a_study_has_them_and_none_of_a_sweep(self):
        with archive_to_change(self.folders[1]) as file:
            file.attrs["study"] += 'active = false\nbars = [0.1, 0.2]\n[sweep]\ndraws = 30\n'
        self.assertEqual(self.table("Inputs").rows[0], ["contacts.tsp2.active", "-", "false"])
        self.assertEqual(self.table("Inputs").rows[1], ["contacts.tsp2.bars", "-", "[0.1, 0.2]"])
        self.assertEqual(len(self.table("Inputs").rows), 3)

    def test_figures_are_written_in_full_and_lives_without_end_named(self):
        self.assertEqual([compare_data.number(v, 3) for v in (7062.4, 0.5, 2.5e-7, 3e6, None)], ["7060", "0.5", "2.5e-07", "3e+06", "-"])
        change_summary(self.folders[1], lambda summary: summary["wear"]["supports"][0].update(life_years={"end": "never", "value": None, "low": None, "high": None}))
        self.assertEqual(self.table("Wear").rows[0][-1], "never")

    def test_shows_changes_of_frequencies(self):
        rows = self.table("Frequencies").rows
        self.assertEqual([rows[0][3], rows[1][3]], ["+1 %", "0 %"])

    def test_tells_significant_differences_from_scatter(self):
        said = {row[0]: row[-1] for row in self.table("Work rates").rows}
        self.assertEqual(said["tsp1"], "equal")
        self.assertIn("within scatter", said["tsp2"])
        self.assertIn("significant", said["tsp3"])
        self.assertEqual(compare_data.significance((1.0, None), (2.0, 0.1)), "scatter unknown")

    def test_round_off_does_not_differ(self):
        one, other = (compare_data._work({"work_rate": rate, "standard_error": {"work_rate": 1e-46}}) for rate in (5e-46, 1.5e-45))
        self.assertEqual(compare_data.significance(one, other), "equal")

    def test_shows_wear(self):
        self.assertEqual(len(self.table("Wear").rows), 3)

    def test_is_a_page_too(self):
        runs, found = compare_data.tables(self.folders)
        text = compare.as_page(runs, ["a", "b"], found)
        checker = Checker()
        checker.feed(text)
        self.assertEqual((checker.problems, checker.stack), ([], []))
        self.assertEqual(text.count('aria-label="Orbit of'), 6)


class Parts(unittest.TestCase):
    def test_histograms_count_every_finite_value(self):
        picture = contact_view.histogram(np.array([0.0, 1.0, 1.01, 24.0, np.nan]), "peak force", "N")
        heights = [float(height) for height in re.findall(r'class="bar"[^>]*height="([\d.]+)"', picture)]
        self.assertEqual(len(heights), contact_view.BARS)
        self.assertAlmostEqual(heights[1], 2 * heights[0], delta=0.2)  # written to a tenth of a pixel
        self.assertEqual(heights[-1], heights[0])
        self.assertEqual(sum(heights[2:-1]), 0.0)
        for empty in (np.array([]), np.array([np.nan]), np.array([0.0])):
            self.assertNotIn("nan", contact_view.histogram(empty, "peak force", "N"))

    def test_contact_points_lie_opposite_to_the_normal(self):
        class Touching:
            y, z = np.array([1e-3, -2e-4, 3e-4]), np.array([1e-3, 1e-4, 0.0])
            normal = np.array([1.0, 2.0, 0.0])

        everywhere = np.ones(3, bool)
        for kind, other, expected in (("circle", -1, [0.25, 0.852416]), ("circle", 3, [-0.75, -0.147584]), ("circle_inside", 3, [0.25, 0.852416]),
                                      ("plane_y", -1, [0.0, -1.0]), ("bars_z", -1, [0.5, 0.5])):
            Touching.facts = {"obstacle": kind, "other": other}
            angles = wear_view.contact_angles(Touching, everywhere) / np.pi
            self.assertEqual(angles.round(6).tolist(), expected, kind)

    def test_scars_are_drawn_as_deep_as_they_are(self):
        x = np.array([0.0])
        support = {"radius": 9.5e-3, "clearance": 2e-4}
        for kind in ("flat_bar", "ring", "drilled_hole", "lands"):
            support["geometry"] = kind
            self.assertAlmostEqual(float(wear_view._worn_surface(support, x, 3e-4)[0]), 9.2e-3, delta=1e-15, msg=kind)
        support["geometry"] = "tube_on_tube"
        self.assertIsNone(wear_view._worn_surface(support, x, 3e-4))

    def test_tick_labels_stay_inside_the_picture(self):
        for low, high in ((-1200.0, -900.0), (-0.00125, 0.001), (-5.0, 5.0)):
            plot = drawing.Plot((184, 168), (low, high), (low, high), (34, 6, 6, 18))
            plot.axes("", "", x_most=4, y_most=4)
            for label in re.findall(r'class="tick end" x="([\d.]+)"[^>]*>([^<]*)<', plot.svg("")):
                self.assertGreaterEqual(float(label[0]), drawing.label_width(label[1]), label)
            for at, label in re.findall(r'class="tick mid" x="([\d.]+)"[^>]*>([^<]*)<', plot.svg("")):
                self.assertLessEqual(float(at) + drawing.label_width(label) / 2, plot.width + 0.1, label)

    def test_flat_obstacles_have_their_own_scale_on_each_axis(self):
        class Bar:
            facts = {"obstacle": "bars_z", "gap": 1e-4, "other": -1, "rest": (0.0, 0.0, 0.0)}
            outline = None
            y, z = np.linspace(-5e-3, 5e-3, 50), 9e-5 * np.sin(np.arange(50.0))
            gap = 1e-4 - np.abs(z)

        _, half = contact_view.limits(Bar, Bar.y, Bar.z)
        self.assertAlmostEqual(half[0], 0.56 * 1e-2, delta=1e-9)
        self.assertLess(half[1], 2e-4)
        self.assertGreater(half[1], 1e-4)
        Bar.y = 1e-4 * np.cos(np.arange(50.0))
        _, half = contact_view.limits(Bar, Bar.y, Bar.z)
        self.assertEqual(half[0], half[1])
        Bar.y, Bar.z = np.linspace(-2e-3, 2e-3, 50), 1e-17 * np.sin(np.arange(50.0))  # no motion to the bars: they are shown
        _, half = contact_view.limits(Bar, Bar.y, Bar.z)
        self.assertGreater(half[1], 1e-4)
        self.assertLess(half[1], 2e-4)
        Bar.z = 9e-5 * np.sin(np.arange(50.0))
        Bar.y = 1e-16 * Bar.z  # nothing slides: round-off has no scale
        _, half = contact_view.limits(Bar, Bar.y, Bar.z)
        self.assertEqual(half[0], half[1])

    def test_an_axis_has_two_ticks_at_least(self):
        self.assertEqual(drawing.ticks(-415.0, 415.0, 4), [-400.0, -200.0, 0.0, 200.0, 400.0])
        self.assertEqual(drawing.ticks(0.0, 10.0, 5), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0])

    def test_round_off_is_zero(self):
        self.assertEqual(sections.quantity(5.4e-45, "W"), "0 W")
        self.assertEqual(sections.quantity(1e-12, "W"), "1 pW")
        self.assertEqual(wear_section._bounds((5.4e-45, 4.5e-45, 6e-45), 1e3), "0")
        self.assertEqual(wear_section._bounds((9.8e42, 8e42, 1.3e43)), "never")

    def test_supports_are_named_once_without_overlap(self):
        class Point:
            def __init__(self, name):
                self.name = name

        found = dict(structure_view._supports([Point("a@1"), Point("a@2"), Point("b")]))
        self.assertEqual({name: len(points) for name, points in found.items()}, {"a": 2, "b": 1})
        plot = drawing.Plot((400, 400), (0.0, 1.0), (0.0, 1.0))
        supports = [(f"support{i}", [np.array([0.5, 0.5 + 0.005 * i])], "left") for i in range(4)]
        left_out = structure_view._name_supports(plot, supports)
        text = plot.svg("")
        self.assertEqual(left_out, ["support3"])  # one at each side and one above, none over the other
        self.assertEqual(text.count('class="note end"'), 1)
        self.assertEqual(text.count('class="note"'), 1)
        self.assertEqual(text.count('class="note mid"'), 1)
        self.assertEqual(text.count('class="support"'), 4)
        plot = drawing.Plot((400, 400), (0.0, 1.0), (0.0, 1.0))
        upright = np.column_stack((np.full(99, 0.5), np.linspace(0.0, 1.0, 99)))
        structure_view._name_supports(plot, [("support", [np.array([0.5, 0.5])], None)], upright)
        self.assertIn('class="note end"', plot.svg(""))  # beside the beam, not across it

    def test_names_below_an_axis_are_slanted_where_they_would_touch(self):
        plot = drawing.Plot((480, 210), (0.4, 20.6), (0.0, 1.0), (58, 12, 10, 38))
        plot.axes("", "work rate", [(i, f"support{i}") for i in range(1, 21)])
        self.assertEqual(plot.svg("").count("rotate(-45)"), 20)
        plot = drawing.Plot((480, 210), (0.4, 3.6), (0.0, 1.0), (58, 12, 10, 38))
        plot.axes("", "work rate", [(i, f"tsp{i}") for i in range(1, 4)])
        self.assertNotIn("rotate(-45)", plot.svg(""))

    def test_ticks_are_round_and_inside(self):
        self.assertEqual(drawing.ticks(0.0, 1.0, 5), [0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0])
        self.assertEqual(drawing.ticks(-210.0, 230.0, 4), [-200.0, 0.0, 200.0])
        self.assertEqual(drawing.ticks(3.0, 3.0), [3.0])

    def test_units_keep_one_to_three_digits_before_the_point(self):
        for value, unit in ((0.302, "mW"), (2.0, "W"), (999.0, "W"), (1000.0, "kW"), (4.5e-7, "nW"), (0.0, "W")):
            self.assertEqual(drawing.unit_for(value, "W")[1], unit)

    def test_numbers_are_short(self):
        self.assertEqual(drawing.short(0.123456), "0.1235")
        self.assertEqual(drawing.short(-2.5), "−2.5")
        self.assertEqual(drawing.short(1000.0, 3), "1000")
        self.assertEqual(drawing.short(3e-11), "3·10<sup>−11</sup>")
        for none in (None, float("nan"), float("inf")):
            self.assertEqual(drawing.short(none), "–")

    def test_envelopes_keep_every_extreme(self):
        y = np.sin(np.arange(100000) * 0.37)
        y[54321] = 9.0
        _, kept = drawing.envelope(np.arange(100000.0), y, 300)
        self.assertEqual(len(kept), 600)
        self.assertEqual((kept.max(), kept.min()), (9.0, y.min()))

    def test_abscissae_follow_the_chain_not_the_numbers(self):
        nodes = np.array([[0.0, 0, 0], [3.0, 4.0, 0], [3.0, 0, 0]])
        abscissa = run_data._chain_abscissae(nodes, np.array([[2, 1], [0, 2]]))
        self.assertEqual(abscissa.tolist(), [0.0, 7.0, 3.0])
        ring = np.array([[0, 1], [1, 2], [2, 0]])
        self.assertIsNone(run_data._chain_abscissae(nodes, ring))

    def test_views_lie_in_the_plane_of_the_structure(self):
        plane = np.array([[0.0, 0, 0], [1.0, 0, 0], [1.0, 0, 3.0]])
        self.assertEqual(structure_view.View(plane).name, "x–z plane")
        self.assertEqual(structure_view.View(plane[:, [1, 0, 2]]).name, "y–z plane")
        self.assertEqual(structure_view.View(np.eye(3)).name, "in depth")
        self.assertEqual(structure_view.View(np.zeros((1, 3))).matrix.shape, (2, 3))

    def test_pixels_become_a_png(self):
        uri = drawing.png(np.full((3, 5, 4), 200, np.uint8))
        data = drawing.base64.b64decode(uri.split(",")[1])
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(drawing.struct.unpack(">II", data[16:24]), (5, 3))


if __name__ == "__main__":
    unittest.main()
