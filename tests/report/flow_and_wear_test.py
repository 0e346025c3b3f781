# SPDX-License-Identifier: GPL-3.0-or-later
"""What the report shows of flow, stability and wear."""

import math
import re
import types
import unittest

from report_case import ReportCase, made_up  # first: it makes the package known

import h5py

from fretwork.report import drawing, run_data, sections, wear_section, wear_view
from made_up_tables import change_summary


class FlowAndWear(ReportCase):
    def test_shows_no_table_that_the_run_has_not_written(self):
        made_up(self.folder, 2, 100)
        self.flow_files()
        change_summary(self.folder, lambda summary: summary.update(files_sha256={}))
        self.assertEqual((run_data.load(self.folder).flows, run_data.load(self.folder).spectra), ([], []))

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
            modes[0].update(direction="out_of_plane", direction_share=0.99)
            modes[1].update(direction="in_plane", direction_share=0.8)
            modes[2].update(direction=None, direction_share=None)
            summary["stability"] = [{"name": "all <bars>", "tube": "T1", "pinned": ["tsp1"], "modes": modes, "cases": [stable, case]}]
            point = {"name": "apex", "direction": "y", "rms_m": 1.5e-5, "rms_velocity_m_s": 2e-3, "up_crossings_per_second": 21.0, "irregularity": 0.9,
                     "maximum_m": None, "share_outside": 0.0, "share_above": 0.0}
            summary["response"] = [{"name": "free", "pinned": [], "modes": 12, "duration_s": 60.0, "probability": 0.5, "points": [point]}]

        self.change(add)
        text = self.report()
        self.assertIn("Fluid-elastic stability", self.headings(text))
        self.assertIn("Linear response to turbulence", self.headings(text))
        self.assertIn("<b>−0.2</b><span>smallest stability margin by Connors, 1 − V/Vc</span>", text)
        for word in ("all &lt;bars&gt;", "the worst of 2: bend 2.4", "unstable by Connors: V/Vc = 1.2", "Bars: critical velocity", "out of plane<", "in plane (80 %)<", "apex</td>", ">15<", ">21<"):
            self.assertIn(word, text)
        self.change(lambda summary: summary["stability"].insert(0, {**summary["stability"][0], "name": "safe", "cases": summary["stability"][0]["cases"][:1]}))
        self.assertIn("<span>smallest stability margin by Connors, 1 − V/Vc, of all &lt;bars&gt;</span>", self.report())

    def test_says_that_axial_flow_is_not_assessed(self):
        made_up(self.folder, 2, 100)
        case = {"connors_constants": {}, "critical_mode": None, "margin": None, "critical_scale": None, "ratios": [0.0], "critical_velocities_m_s": [None], "sweep": []}
        modes = [{"frequency_hz": 10, "damping": 0.02, "decrement": 0.12, "effective_velocity_m_s": 0.0}]
        self.change(lambda summary: summary.update(stability=[{"name": "all", "tube": "T1", "pinned": [], "modes": modes, "cases": [case]}]))
        text = self.report()
        self.assertIn("Not assessed by Connors: no mode moves in a velocity across the tube.", text)
        self.assertNotIn("smallest stability margin", text)

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
        self.assertEqual([row[0] for row in rows], ["tsp2", "tsp1", "tsp1, side -y"])  # by life
        self.assertEqual(rows[0][1:7], rows[2][1:7])
        self.assertEqual(len(rows[0]), len(rows[2]))

    def test_tells_what_depths_begin_at(self):
        def support(name, depth, *sides):
            return {"name": name, "initial_depth": depth, "sides": {str(side): {"initial_depth": side} for side in sides}}

        new, worn = support("tsp1", 0.0), support("tsp2", 1.5e-4)
        self.assertEqual(wear_section._initial_depths([new]), "")
        self.assertEqual(wear_section._initial_depths([worn, worn]), " Depths begin at 0.15 mm (initial_wear).")
        sides = support("tsp3", 0.0, 2e-4, 0.0, 1e-4)
        self.assertEqual(wear_section._initial_depths([new, worn, sides]), " Depths begin at 0.1 to 0.2 mm (initial_wear) at 2 of 3 supports.")
        made_up(self.folder, 4, 100, wear=True)
        self.assertIn("Depths begin at 0.1 mm (initial_wear) at 1 of 4 supports.", self.report())

    def test_shows_the_wear_of_supports_beside_the_tubes(self):
        made_up(self.folder, 5, 200, wear=True)
        supports = run_data.load(self.folder).wear
        table = wear_section._supports_themselves(supports)
        rows = {row[0]: row for row in (re.findall(r"<td[^>]*>(.*?)</td>", row) for row in re.findall(r"<tr>(.*?)</tr>", table)[1:])}
        self.assertEqual(rows["tsp1"][2], "1.26 (1.07 – 1.45)")  # half of the tube's
        self.assertEqual(rows["tsp1"][4:], ["–", "–"])
        self.assertEqual(rows["tsp4"][4:], ["77 (66 – 88)", "1"])
        tsp4 = next(s for s in supports if s["name"] == "tsp4")  # its tube never reaches its limit
        self.assertEqual((wear_view.first_life(tsp4)[0][0], wear_view.first_life(tsp4)[1]), (77.0, "support"))
        for s in supports:
            s["support_volume"][:] = 0.0
            s["support_limit"] = math.nan
        self.assertEqual(wear_section._supports_themselves(supports), "")
        for s in supports:
            s["life_years"][:] = 100.0
        run = types.SimpleNamespace(wear=supports, summary={})
        self.assertEqual(sections._verdicts(run)[0], ("years to the limit of wear, tsp4 (the support)", "77"))

    def test_shows_wear(self):
        made_up(self.folder, 5, 200, wear=True)
        text = self.report()
        self.assertEqual(self.headings(text)[4:7], ["Table of contacts", "Observed nodes", "Wear"])
        lives = [(s[life][0], s["name"]) for s in run_data.load(self.folder).wear for life in ("life_years", "support_life_years")]
        years, name = min(life for life in lives if life[0] == life[0])  # not the one outside the law
        self.assertEqual(name, "tsp4")  # whose tube never loses its limit
        self.assertIn(f"<b>{drawing.short(years, 3)}</b><span>years to the limit of wear, {name} (the support) (1 of 5 supports have no figure)</span>", text)
        wear = text[text.index("<h2>Wear</h2>"):text.index("<h2>Impacts</h2>")]
        rows = [re.findall(r"<td[^>]*>(.*?)</td>", row) for row in re.findall(r"<tr>(.*?)</tr>", wear[wear.index("<tbody>"):wear.index("</tbody>")])]
        self.assertEqual(rows[0][0], name)  # the shortest life first
        cells = next(row for row in rows if row[0] == "tsp1")
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


if __name__ == "__main__":
    unittest.main()
