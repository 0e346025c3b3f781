# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs compared."""

import math
import re
import tempfile
import unittest
from pathlib import Path

import numpy as np

from report_case import Checker, archive_to_change, made_up  # first: it makes the package known

from fretwork.report import compare, compare_data
from made_up_tables import change_summary


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

    def test_overrides_by_number_are_those_of_the_entry(self):
        change_summary(self.folders[1], lambda summary: summary.update(overrides=[{"key": "contacts.1.gap", "value": 5e-4}]))
        self.assertEqual(self.table("Inputs").rows, [["contacts.tsp2.gap", "0.0003", "0.0005"]])

    def test_large_changes_are_factors(self):
        self.assertEqual([compare_data.change(value, 2.0) for value in (21.0, 30.0, 1e6, 0.0)], ["+950 %", "times 15", "times 500000", "-100 %"])

    def test_figures_are_written_in_full_and_lives_without_end_named(self):
        self.assertEqual([compare_data.number(v, 3) for v in (7062.4, 0.5, 2.5e-7, 3e6, None)], ["7060", "0.5", "2.5e-07", "3e+06", "-"])
        change_summary(self.folders[1], lambda summary: summary["wear"]["supports"][0].update(life_years={"end": "never", "value": None, "low": None, "high": None}))
        self.assertEqual(self.table("Wear").rows[0][-1], "never")

    def test_shows_damping_where_it_differs(self):
        _, found = compare_data.tables(self.folders)
        self.assertFalse([table for table in found if table.title.startswith("Damping")])

        def change(summary):
            summary["modes"]["damping"][1] = 0.03

        change_summary(self.folders[0], lambda summary: summary["modes"]["damping"].__setitem__(1, 0.02))
        change_summary(self.folders[1], change)
        self.assertEqual(self.table("Damping").rows[1][1:], ["2", "3", "+50 %"])

    def test_shows_the_stability_of_both_runs(self):
        def case(margin):
            return {"margin": margin, "critical_mode": 1}

        entry = {"name": "all", "tube": "a", "cases": [case(0.5), case(0.2)]}
        change_summary(self.folders[0], lambda summary: summary.update(stability=[entry]))
        change_summary(self.folders[1], lambda summary: summary.update(stability=[{**entry, "cases": [case(-0.2)]}, {**entry, "name": "none", "cases": []}]))
        self.assertEqual(self.table("Stability").rows, [["all", "0.8", "1.2", "+50 %"], ["none", "-", "-", "-"]])

    def test_has_no_velocity_ratio_where_the_flow_moves_no_mode(self):
        entry = {"name": "all", "tube": "a", "cases": [{"margin": 1.0, "critical_mode": None}]}
        change_summary(self.folders[0], lambda summary: summary.update(stability=[{**entry, "cases": [{"margin": 0.5, "critical_mode": 1}]}]))
        change_summary(self.folders[1], lambda summary: summary.update(stability=[entry]))
        self.assertEqual(self.table("Stability").rows, [["all", "0.5", "-", "-"]])

    def test_says_after_how_many_years_the_wear_is(self):
        def change(summary):
            for support, years in zip(summary["wear"]["supports"], (10, 10, 40)):
                support["years"] = years

        self.assertEqual(self.table("Wear").title, "Wear after 40 years")
        self.assertEqual(self.table("Wear of the supports").title, "Wear of the supports themselves after 40 years")
        change_summary(self.folders[0], change)
        self.assertEqual(self.table("Wear").title, "Wear after 10 and 40 years")
        self.assertEqual(self.table("Wear of the supports").title, "Wear of the supports themselves after 10 and 40 years")

    def test_shows_changes_of_frequencies(self):
        rows = self.table("Frequencies").rows
        self.assertEqual([rows[0][3], rows[1][3]], ["+1 %", "0 %"])

    def test_tells_significant_differences_from_scatter(self):
        said = {row[0]: row[-1] for row in self.table("Work rates").rows}
        self.assertEqual(said["tsp1"], "equal")
        self.assertIn("within scatter", said["tsp2"])
        self.assertIn("significant", said["tsp3"])
        self.assertEqual(compare_data.significance(compare_data.chance((1.0, None, None), (2.0, 0.1, 20))), "scatter unknown")

    def test_shows_impacts_and_forces_with_what_is_more_than_scatter(self):
        def change(summary):
            for contact, factor in zip(summary["contacts"], (1.0, 1.001, 3.0)):
                contact["impacts_per_second"] *= factor
                contact["normal_force"]["rms"] *= factor
                contact["normal_force"]["max"] *= factor

        change_summary(self.folders[1], change)
        for title in ("Impacts per second", "Normal force, rms"):
            changes = [row[-1] for row in self.table(title).rows]
            self.assertEqual(changes, ["0 %", "+0.1 %", "+200 %, significant"])
        self.assertEqual(self.table("Normal force, largest").rows[2][0], "tsp3")
        self.assertEqual(self.table("Normal force, largest").rows[2][-1][:6], "+200 %")
        self.assertRegex(self.table("Impacts per second").rows[0][1], r"^[0-9.]+ \+- [0-9.]+$")

    def test_shows_the_contacts_with_the_largest_work_rates_of_many(self):
        def many(summary):
            entry = summary["contacts"][0]
            summary["contacts"] = [{**entry, "name": f"c{i}", "work_rate": float(i)} for i in range(30)]

        for folder in self.folders:
            change_summary(folder, many)
        table = self.table("Impacts per second")
        self.assertEqual([row[0] for row in table.rows], [f"c{i}" for i in range(10, 30)])
        self.assertEqual(table.note, "the 20 of 30 contacts with the largest work rates")

    def test_shows_the_intervals_of_wear(self):
        supports = [{"value": 1e-4, "low": 0.9e-4, "high": 1.1e-4}, {"value": 1e-4, "low": 1e-4, "high": 1e-4}, None]
        lives = [{"end": "reached", "value": 12.5, "low": 11.0, "high": None}, {"end": "never", "value": None, "low": None, "high": None}, None]

        def change(summary):
            for support, depth, life in zip(summary["wear"]["supports"], supports, lives):
                support.update(depth_m=depth, life_years=life)

        change_summary(self.folders[1], change)
        rows = self.table("Intervals of wear").rows
        self.assertEqual([[row[2], row[4]] for row in rows], [["0.09 to 0.11", "above 11"], ["-", "-"], ["-", "-"]])
        self.assertRegex(rows[0][1], r"^[0-9.]+ to [0-9.]+$")

    def test_round_off_does_not_differ(self):
        one, other = (compare_data._work({"work_rate": rate, "standard_error": {"work_rate": 1e-46}}) for rate in (5e-46, 1.5e-45))
        self.assertEqual(compare_data.significance(compare_data.chance(one, other)), "equal")

    def test_chances_are_those_of_student_with_welch_s_degrees_of_freedom(self):
        for freedom in (2.0, 4.0):  # closed forms
            for t in (0.0, 0.1, 1.0, 4.0, 30.0):
                x = t / math.sqrt(t * t + freedom)
                tail = 1.0 - x if freedom == 2.0 else (1.0 - x) ** 2 * (1.0 + 0.5 * x)
                self.assertAlmostEqual(compare_data.outside_student(t, freedom) / tail, 1.0, 9)
        self.assertAlmostEqual(compare_data.outside_student(2.085963, 20.0), 0.05, 6)  # tables
        self.assertAlmostEqual(compare_data.outside_student(1.959964, 1e6), 0.05, 6)
        self.assertAlmostEqual(compare_data.outside_student(2.0, 900.0), compare_data.outside_student(2.0, 1e6), 3)
        # two alike: twice the degrees of freedom of one, which are those of its batches and of its own relative error (doc/wear.md, 3.2)
        one, other = (1.0, 0.05, 21), (1.2, 0.05 * 1.2, 21)
        freedom = 1.0 / (1.0 / 20.0 + 0.5 * 0.05**2)
        expected = (0.05**2 + 0.06**2) ** 2 / ((0.05**4 + 0.06**4) / freedom)
        self.assertAlmostEqual(compare_data.chance(one, other), compare_data.outside_student(0.2 / math.hypot(0.05, 0.06), expected), 12)
        self.assertEqual(compare_data.chance(one, (1.2, None, None)), "scatter unknown")

    def test_many_differences_are_judged_together(self):
        chances = [0.04, 0.3, 0.01, 0.9]
        self.assertEqual(compare_data.holm(chances), 0.01)  # 0.05/4, but not 0.04: above 0.05/3
        self.assertEqual(compare_data.holm([0.04]), 0.04)
        self.assertLess(compare_data.holm([0.04] * 2), 0.0)
        self.assertEqual(compare_data.holm([0.04, 0.001]), 0.04)
        self.assertEqual((compare_data.significance(0.04, 0.01), compare_data.significance(1e-12, 0.01)), ("within scatter, p = 0.04", "significant, p < 1e-09"))
        # of alike runs with a hundred contacts one pair in twenty has a significant difference, where five contacts of each would be beyond 5 %
        rng, false, single = np.random.default_rng(1), 0, 0
        for _ in range(200):
            a, b = rng.normal(1.0, 0.05, (2, 100))
            found = [compare_data.chance((x, 0.05, None), (y, 0.05, None)) for x, y in zip(a, b)]
            false += compare_data.holm(found) >= 0.0
            single += sum(p <= 0.05 for p in found)
        self.assertLessEqual(false, 0.05 * 200 + 3 * math.sqrt(0.05 * 0.95 * 200))
        self.assertGreater(single, 4 * 200)

    def test_the_table_says_how_it_judges(self):
        table = self.table("Work rates")
        judged = [row[-1] for row in table.rows if ", p " in row[-1]]
        self.assertEqual(len(judged), 2)  # tsp2 and tsp3; the others are equal
        self.assertIn("any of 2 differences in at most 5 % of comparisons (Holm)", table.note)
        runs, found = compare_data.tables(self.folders)
        self.assertIn(f"Work rates, W\n  {table.note}\n", compare.as_texts(runs, ["a", "b"], found))
        self.assertIn(table.note, compare.as_page(runs, ["a", "b"], found))
        self.assertLessEqual(len(table.note) + 2, compare.WIDTH)

    def test_shows_wear(self):
        self.assertEqual(len(self.table("Wear").rows), 3)

    def test_shows_the_wear_of_supports_themselves(self):
        def change(summary):
            for support, (value, life) in zip(summary["wear"]["supports"], ((1e-4, {"end": "reached", "value": 12.5}), (2e-4, None), (0.0, None))):
                support["support_depth_m"]["value"], support["support_life_years"] = value, life

        for folder, factor in zip(self.folders, (1.0, 2.0)):
            change_summary(folder, change)
            change_summary(folder, lambda summary, factor=factor: summary["wear"]["supports"][0]["support_depth_m"].update(value=factor * 1e-4))
        change_summary(self.folders[1], lambda summary: summary["wear"]["supports"][0].update(support_life_years={"end": "never", "value": None}))
        rows = self.table("Wear of the supports").rows
        self.assertEqual([row[0] for row in rows], ["tsp1", "tsp2"])  # the third loses nothing and has no limit
        self.assertEqual(rows[0][1:], ["0.1", "0.2", "+100 %", "12.5", "never"])
        self.assertEqual(rows[1][-2:], ["-", "-"])

    def test_two_runs_are_one_table_with_their_names(self):
        runs, found = compare_data.tables(self.folders)
        text = compare.as_texts(runs, ["a", "b"], found)
        self.assertIn("change, b", text)
        self.assertNotIn("run 1", text)

    def test_tables_of_many_runs_fit_a_line(self):
        runs, _ = compare_data.tables(self.folders)
        runs, names = [runs[0], runs[1], runs[1], runs[1]], [f"a_folder_with_a_long_name_{k}.results" for k in range(1, 5)]
        text = compare.as_texts(runs, names, compare_data.differences(runs, names))
        self.assertLessEqual(max(map(len, text.splitlines())), compare.WIDTH)
        self.assertIn("  run 1  a_folder_with_a_long_name_1.results, the reference\n", text)
        for k in (2, 3, 4):
            self.assertEqual(len(re.findall(f"change, run {k} +significance", text)), 1)
        self.assertEqual(text.count("all contacts"), 3)  # parts, each with the reference

    def test_is_a_page_too(self):
        runs, found = compare_data.tables(self.folders)
        text = compare.as_page(runs, ["a", "b"], found)
        checker = Checker()
        checker.feed(text)
        self.assertEqual((checker.problems, checker.stack), ([], []))
        self.assertEqual(text.count('aria-label="Orbit of'), 6)


if __name__ == "__main__":
    unittest.main()
