# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of the tree that documents name exist, and so do the sections of links: paths_test.py ROOT (of the tree)."""

import re
import runpy
import sys
import unittest
from pathlib import Path

ROOT = Path(sys.argv.pop(1))
DOCUMENTS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(ROOT.glob("doc/*.md")), *sorted(ROOT.glob("transient/**/README.md")), *sorted(ROOT.glob("[a-z]*/README.md"))]
FOLDERS = "app bench contact core doc examples fem flow kernels mesh modal post python results signals study sweep tests tools transient vibration wear".split()
# a path of the tree in code quotes: folder/.../file.ending, with {a,b} and * as in a shell
PATH = re.compile(r"`((?:" + "|".join(FOLDERS) + r")/[\w./*-]*\.(?:cpp|hpp|py|sh|md|json|toml|geo|ipynb|txt|cmake|svg|png|\*))`")
LINK = re.compile(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)")


def missing(document, text):
    paths = [path for path in PATH.findall(text) if not list(ROOT.glob(path))]
    return paths + [link for link in LINK.findall(text) if not (document.parent / link).exists()]


class Paths(unittest.TestCase):
    def test_files_named_by_documents_exist(self):
        for document in DOCUMENTS:
            with self.subTest(document):
                self.assertEqual([], missing(document, document.read_text(encoding="utf-8")))

    def test_picture_of_the_architecture_is_drawn_by_its_script(self):
        script = runpy.run_path(str(ROOT / "doc/pictures/draw_architecture.py"))
        self.assertEqual((ROOT / "doc/architecture.svg").read_text(encoding="utf-8"), script["picture"]())

    def test_missing_files_are_found(self):
        text = "`contact/support.hpp` `contact/nowhere.hpp` [a](doc/nothing.md) [b](README.md)"
        self.assertEqual(["contact/nowhere.hpp", "doc/nothing.md"], missing(ROOT / "README.md", text))


if __name__ == "__main__":
    unittest.main()
