# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of a run with contacts, or without."""

import json
import re
import unittest

from report_case import ReportCase, made_up, run_report, time_of_children  # first: it makes the package known

import numpy as np

from fretwork.report import contact_view, drawing, run_data

LONGEST = 8.0  # s for 22 contacts and 10 000 outputs: the goal is 4 s on an idle machine, twice that beside other tests


class Report(ReportCase):
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
            gap, rest = 1e6 * float(file["contacts/tsp2"].attrs["gap"]), file["contacts/tsp2"].attrs["rest"]
            rest[2] = 3e-5
            file["contacts/tsp2"].attrs["rest"] = rest
        text = self.report()
        self.assertIn(f">{gap:g}</td><td>−125", text)  # one bar
        sides = {"work_rate": 0.0, "standard_error": {"work_rate": None, "work_rate_batches": None}}
        self.change(lambda summary: summary["contacts"][1].update(sides={"+z": sides, "-z": sides}))
        self.assertIn(f">{gap + 30:g} and {gap - 30:g}</td><td>−125", self.report())
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


if __name__ == "__main__":
    unittest.main()
