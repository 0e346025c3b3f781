# SPDX-License-Identifier: GPL-3.0-or-later
"""The formulas of the manual show without a network: formulas_test.py MANUAL (folder of HTML) CHROMIUM"""

import re
import subprocess
import sys
import unittest
from pathlib import Path

MANUAL, CHROMIUM = Path(sys.argv.pop(1)), sys.argv.pop(1)
PAGE = MANUAL / "contact.html"  # formulas in the text, displayed ones, and aligned ones
FORMULA = re.compile(r'class="math ')
DRAWN = re.compile(r'class="MathJax_SVG"')
PROGRESS_MS = 20000  # of the page's clock, which runs as fast as the browser works


def drawn(page):
    command = [CHROMIUM, "--headless=new", "--no-sandbox", "--disable-gpu", "--host-resolver-rules=MAP * ~NOTFOUND",
               f"--virtual-time-budget={PROGRESS_MS}", "--dump-dom", page.as_uri()]
    return subprocess.run(command, check=True, capture_output=True, text=True, timeout=120).stdout


class Formulas(unittest.TestCase):
    def test_every_formula_of_a_page_is_drawn(self):
        written = len(FORMULA.findall(PAGE.read_text(encoding="utf-8")))
        self.assertGreater(written, 20)
        page = drawn(PAGE)
        self.assertEqual(written, len(DRAWN.findall(page)))
        self.assertNotRegex(page, r'<[^>]*class="[^"]*merror')  # what MathJax shows in place of TeX that it cannot read

    def test_no_page_needs_the_network(self):
        for page in MANUAL.glob("*.html"):
            with self.subTest(page.name):
                self.assertNotRegex(page.read_text(encoding="utf-8"), r'<(?:script|link)[^>]*(?:src|href)="(?:https?:)?//')


if __name__ == "__main__":
    unittest.main()
