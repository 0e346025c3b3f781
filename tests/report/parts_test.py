# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of the report: pictures, scales, texts of figures."""

import re
import unittest

import report_case  # noqa: F401  first: it makes the package known

import numpy as np

from fretwork.report import contact_view, drawing, run_data, sections, structure_view, wear_section, wear_view


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
