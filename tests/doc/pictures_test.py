# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of doc/contact.md are those of the code: pictures_test.py CONTACT_PICTURES DOC_FOLDER (the program that computes them, the folder doc)."""

import re
import sys
import tempfile
import unittest
from pathlib import Path
from xml.etree import ElementTree

PROGRAM, DOC = sys.argv.pop(1), Path(sys.argv.pop(1))
sys.path.insert(0, str(DOC / "pictures"))
import draw_contact  # noqa: E402

NEAR = 0.15  # px: coordinates are written to 0.1, and the last bit of an arithmetic may round one the other way
LARGEST = 60_000  # bytes: a page with all of them opens at once
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


def difference(one, other):
    """What tells two pictures apart: the largest difference of their numbers (px), infinite if they differ in anything else."""
    if NUMBER.sub("#", one) != NUMBER.sub("#", other):
        return float("inf")
    return max(abs(float(a) - float(b)) for a, b in zip(NUMBER.findall(one), NUMBER.findall(other)))


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            draw_contact.main(PROGRAM, folder)
            cls.drawn = {path.name: path.read_text(encoding="utf-8") for path in Path(folder).iterdir()}
        cls.committed = {path.name: path.read_text(encoding="utf-8") for path in (DOC / "pictures").glob("*.svg")}

    def test_committed_pictures_are_those_of_the_code(self):
        self.assertEqual(sorted(self.committed), sorted(self.drawn))
        for name, picture in self.drawn.items():
            with self.subTest(name):
                self.assertLess(difference(picture, self.committed[name]), NEAR, "draw it again: doc/pictures/README.md")

    def test_a_moved_line_is_noticed(self):
        circle = self.committed["circle.svg"]
        x = re.search(r'class="zero" points="([\d.]+)', circle)
        moved = f"{float(x[1]) + 0.5:.1f}"
        self.assertGreater(difference(circle, circle[: x.start(1)] + moved + circle[x.end(1) :]), NEAR)
        self.assertEqual(difference(circle, circle.replace("circle, g", "ring, g")), float("inf"))

    def test_the_page_shows_every_picture_and_no_other(self):
        shown = re.findall(r"!\[[^]]*\]\(pictures/([^)]+)\)", (DOC / "contact.md").read_text(encoding="utf-8"))
        self.assertEqual(sorted(shown), sorted(self.committed))

    def test_pictures_are_small_and_well_formed(self):
        for name, picture in self.committed.items():
            with self.subTest(name):
                self.assertLess(len(picture.encode()), LARGEST)
                self.assertNotRegex(picture, r"\b(nan|inf)\b")
                ElementTree.fromstring(picture)

    def test_contours_of_a_plane_and_of_a_saddle_are_exact(self):
        at = draw_contact.np.linspace(-1.0, 1.0, 5)
        y, z = draw_contact.np.meshgrid(at, at)
        (line,) = draw_contact.contours(at, at, y + 2.0 * z, 0.3)
        self.assertLess(abs(line[:, 0] + 2.0 * line[:, 1] - 0.3).max(), 1e-12)  # linear in a square's edge: round-off
        self.assertEqual(len(draw_contact.contours(at, at, y * z, 0.1)), 2)  # two branches
        (ring,) = draw_contact.contours(at, at, draw_contact.np.hypot(y, z), 0.8)
        self.assertEqual(ring[0].tolist(), ring[-1].tolist())  # closed


if __name__ == "__main__":
    unittest.main()
